/* Volumes of segments with tables: a transfer function for each. */
#ifndef PLR_ENGINE_VOLUME_SEGMENTS_H
#define PLR_ENGINE_VOLUME_SEGMENTS_H

#include "engine/view.h"
#include "engine/volume_table.h"

/* What makes a volume, or a segment, visible. */
typedef struct plr_function {
    const plr_atlas_place *place; /* the transfer function; NULL: voxels as they are */
    double factor;                /* of its opacity */
    bool bare;                    /* only what can be seen of it is wanted */
} plr_function;

/* Makes the table of a SegmentedVolumeData whose segments are opacity maps and constant factors
 * alone; false: they are not, or an author's effect or fog acts on them. */
bool plr_volume_find_segments(plr_view *view, plr_volume_state *state);

/* The table of one function (volume_plan.c). `in_stack`: of several, see plr_table_stack; not
 * `gentle`: as if it were not. */
plr_table *plr_volume_make_table(plr_view *view, const plr_volume_state *state,
                                 const plr_function *function, bool in_stack, bool gentle);
/* How far rays leap over blocks where nothing can be seen; `sees` NULL: of its table. */
plr_texture *plr_volume_make_leaps(plr_view *view, plr_volume_state *state,
                                   bool (*sees)(const void *, size_t), const void *user);

#endif
