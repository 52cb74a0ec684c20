/* What the files of textures share. */
#ifndef PLR_ENGINE_TEXTURE_INTERNAL_H
#define PLR_ENGINE_TEXTURE_INTERNAL_H

#include "engine/texture.h"

#define PLR_TEXTURES_MAX_BYTES ((size_t)4 << 30)

/* Fills everything but GL names from the node. False if it is the node of no texture. */
bool plr_texture_load(plr_textures *textures, plr_texture *texture);
/* Makes the GL objects. False if GL refuses. */
bool plr_texture_upload(plr_textures *textures, plr_texture *texture);
/* The sampler objects of the node's repetition and filters. */
void plr_texture_make_samplers(const plr_textures *textures, plr_texture *texture);

#endif
