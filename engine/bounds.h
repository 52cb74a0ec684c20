/* Bounding boxes of nodes, and those that a scene wants to see (bboxDisplay). No GL. */
#ifndef PLR_ENGINE_BOUNDS_H
#define PLR_ENGINE_BOUNDS_H

#include "engine/traverse.h"

typedef struct plr_box {
    double low[3], high[3]; /* low > high: nothing is in it */
} plr_box;

/* What is known while a scene is flattened. */
typedef struct plr_bounds {
    plr_arena *arena;
    plr_scene *scene;
    plr_flat *flat;
    plr_diags *diags;
    plr_box **known; /* of geometry, by number of the node; NULL until one is asked for */
    size_t work;
} plr_bounds;

/* Adds the edges of a node's bounding box to the shapes of the flat: of the box that it gives, else
 * of what is in the lists of the flat from these two places on. `inside`: the coordinates in which
 * the box stands. */
void plr_bounds_show(plr_bounds *bounds, const plr_node *node, const plr_matrix *inside,
                     size_t first_shape, size_t first_volume);

#endif
