/* Cells of voxels whose labels are all the same. */
#ifndef PLR_ENGINE_VOLUME_LABEL_CELLS_H
#define PLR_ENGINE_VOLUME_LABEL_CELLS_H

#include "base/arena.h"
#include "engine/image.h"

/* Of cells whose voxels differ, or have this label or a greater one; the same in GLSL. */
#define PLR_LABELS_DIFFER 255

/* The label that the voxels of each cell have in common, in 8 bits; cells lie between voxels, one
 * fewer than these on each axis, but one at least. The samples are the caller's. */
plr_image plr_label_cells(plr_arena *arena, const plr_image *labels);

#endif
