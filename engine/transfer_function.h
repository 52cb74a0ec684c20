/* Transfer functions given by knots (the node TransferFunction), baked into textures. No GL. */
#ifndef PLR_ENGINE_TRANSFER_FUNCTION_H
#define PLR_ENGINE_TRANSFER_FUNCTION_H

#include "engine/texture.h"

/* The most texels that a function gets. */
#define PLR_TRANSFER_MAX_TEXELS 4096

/* Whether its keys are physical values, whose place depends on the volume. */
bool plr_transfer_function_is_physical(const plr_node *node);
/* One row of RGBA floats: texel i of N is the function at i / (N - 1). With `physical` keys that is
 * from range[0] to range[1]; equal ends: all keys lie at 0. N is such that every key falls on a
 * texel, if there is such an N. False without memory. Faults of the lists are warnings. */
bool plr_transfer_function_bake(const plr_node *node, const double range[2], plr_image *image,
                                plr_diags *diags);
/* The texture of a node with physical keys, for voxels of this range; one for each range. */
plr_texture *plr_transfer_function_texture(plr_textures *textures, const plr_node *node,
                                           const double range[2]);

#endif
