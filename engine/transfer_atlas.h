/* One texture for the transfer functions of all volumes that are drawn together: programs read any
 * number of functions through one sampler. */
#ifndef PLR_ENGINE_TRANSFER_ATLAS_H
#define PLR_ENGINE_TRANSFER_ATLAS_H

#include "engine/texture.h"

/* Where a function lies: the centre of its first texel and how far it is to that of its last one,
 * in texels of the atlas. */
typedef struct plr_atlas_place {
    float rect[4];
    float visible[2];      /* outside of this open interval of S its first row is clear */
    plr_texture *function; /* NULL: the default ramp */
} plr_atlas_place;

typedef struct plr_atlas {
    struct {
        plr_atlas_place **items;
        size_t count, capacity;
    } places;
    uint32_t width, height; /* so far */
    plr_texture *texture;   /* once it is made */
} plr_atlas;

/* A place for a function of two dimensions (NULL: the default ramp), the same for each time it is
 * asked for; NULL where it is no picture, or where there is no room. */
const plr_atlas_place *plr_atlas_add(plr_textures *textures, plr_arena *arena, plr_atlas *atlas,
                                     plr_texture *function);
/* Puts all functions into a texture. `reversed`: the default ramp as it was in 2005, opaque at 0.
 */
void plr_atlas_make(plr_textures *textures, plr_arena *arena, plr_atlas *atlas, bool reversed);

#endif
