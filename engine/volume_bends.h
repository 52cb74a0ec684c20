/* How much the values of a grid change, block by block: what bounds of errors along rays need. */
#ifndef PLR_ENGINE_VOLUME_BENDS_H
#define PLR_ENGINE_VOLUME_BENDS_H

#include "base/arena.h"
#include "engine/image.h"

/* What is known of a block: the greatest found in it, its sides included, in voxels. */
enum {
    PLR_BEND_DEPTH = 0, /* of values, with the other sign */
    PLR_BEND_HEIGHT = 1,
    PLR_BEND_SLOPE = 2, /* 3, along each axis: difference of neighbours */
    PLR_BEND_JUMP = 5,  /* 3: how much that changes at a voxel that is not the first or last one */
    PLR_BEND_TWIST = 8, /* 3: mixed second difference along y and z, z and x, x and y */
    PLR_BENDS = 11
};

/* Of values interpolated trilinearly, which beyond the outermost voxels go on as they are there.
 * Cells are between neighbours; the outermost blocks have half a voxel more. */
typedef struct plr_bends {
    double low, high; /* the least and the greatest value; infinite where one is no number */
    uint32_t size[3]; /* voxels */
    uint32_t cells;   /* along each side of a block, less in the last ones */
    uint32_t blocks[3];
    const float *found[PLR_BENDS]; /* of each block, x runs fastest */
} plr_bends;

/* Of an image of one component. Looks at each voxel some ten times. */
plr_bends *plr_bends_make(plr_arena *arena, const plr_image *image);

size_t plr_bends_count(const plr_bends *bends);

#endif
