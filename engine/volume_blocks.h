/* Blocks of voxel cells: the least and the greatest value in each, and how far it is from there to
 * the next block where anything can be seen. */
#ifndef PLR_ENGINE_VOLUME_BLOCKS_H
#define PLR_ENGINE_VOLUME_BLOCKS_H

#include "base/arena.h"
#include "engine/image.h"

/* Cell c lies between the centres of voxels c - 1 and c; the outermost ones reach from a centre to
 * the side of the box. */
typedef struct plr_blocks {
    uint32_t cells;    /* a side of a block */
    uint32_t size[3];  /* blocks along each axis */
    float (*range)[2]; /* of the values in a block, sides included; x runs fastest */
    uint64_t *labels;  /* which of PLR_BLOCK_LABELS are in a block, a bit each; or NULL */
    uint64_t all_labels;
    uint32_t most_label;
} plr_blocks;

/* Labels are told apart up to this one, which stands for all greater ones, too. */
#define PLR_BLOCK_LABELS 63

/* Of an image of one component. */
plr_blocks *plr_blocks_make(plr_arena *arena, const plr_image *image);
/* Labels of the same voxels. */
void plr_blocks_add_labels(plr_arena *arena, plr_blocks *blocks, const plr_image *image);
/* For each block eight numbers of 4 bits: how many blocks a side, itself at a corner, the greatest
 * cube has in which none is `full` (one flag a block), for each octant of directions that it may
 * extend to: 1, 2 and 4 of its number are set where it goes down along x, y and z. What is outside
 * is not full. Codes above 10 stand for 18, 26, ... 50 blocks, or a few more. False: out of memory.
 */
bool plr_blocks_leaps(const plr_blocks *blocks, const bool *full, uint32_t *leaps);
/* The number of blocks for one octant. */
uint32_t plr_blocks_side(uint32_t leaps, uint32_t octant);
size_t plr_blocks_count(const plr_blocks *blocks);

#endif
