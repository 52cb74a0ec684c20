/* What a change of the scene means for a view. */
#ifndef PLR_ENGINE_CHANGES_H
#define PLR_ENGINE_CHANGES_H

#include "engine/view.h"

typedef enum plr_change {
    PLR_CHANGE_NONE,   /* nothing, or uniforms, which are read for each picture */
    PLR_CHANGE_PLACES, /* things move */
    PLR_CHANGE_PARTS   /* anything: parts of the view are made anew */
} plr_change;

/* The most that has changed since the view was made or updated. */
plr_change plr_view_changed(const plr_view *view);
/* Takes things to where they are now. False, and nothing is done, where more has changed than
 * places. */
bool plr_view_move(plr_view *view, const plr_matrix *eye_to_world);

#endif
