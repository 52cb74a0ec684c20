/* How far from the true picture samples in the middle of equal steps can be, whatever the ray:
 * where that is little enough long steps are certain to keep an error, and nothing finer is needed.
 */
#ifndef PLR_ENGINE_VOLUME_CERTAIN_H
#define PLR_ENGINE_VOLUME_CERTAIN_H

#include "engine/volume_bends.h"

/* A volume that a transfer function makes visible. Lengths are in its own coordinates. */
typedef struct plr_certain {
    const plr_bends *bends;
    const float *texels; /* straight RGBA of 0 to 1, interpolated linearly over the values 0 to 1 */
    uint32_t texel_count;
    double voxel[3];  /* how far voxels are apart */
    double longest;   /* ray that can be in it */
    double reference; /* opacities are those of this length */
} plr_certain;

/* A bound on how much a channel of a pixel differs from its true value, where rays through the
 * volumes (which may overlap) are cut into steps of at most steps[i], each sampled in its middle
 * and composed exactly; infinite where none is known. Rounding and early termination are not in it.
 */
double plr_certain_error(const plr_certain *volumes, size_t count, const double *steps);

#endif
