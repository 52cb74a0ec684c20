/* How much the values of a grid change: what bounds of errors along any ray through it need. */
#ifndef PLR_ENGINE_VOLUME_BENDS_H
#define PLR_ENGINE_VOLUME_BENDS_H

#include "base/arena.h"
#include "engine/image.h"

/* Of values interpolated trilinearly, which beyond the outermost voxels go on as they are there. */
typedef struct plr_bends {
    double low, high; /* the least and the greatest value */
    double slope[3];  /* along each axis, of neighbours: the greatest difference */
    double jump[3];   /* how much that difference changes at a voxel: the greatest in each layer of
                         voxels, summed over the layers, each of which a ray crosses once */
    double twist[3];  /* the greatest mixed second difference: along y and z, z and x, x and y */
} plr_bends;

/* Of an image of one component. Looks at each voxel some ten times. */
plr_bends *plr_bends_make(plr_arena *arena, const plr_image *image);

#endif
