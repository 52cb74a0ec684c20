/* Which pixels rays through volumes start from. */
#ifndef PLR_ENGINE_VOLUME_HULL_H
#define PLR_ENGINE_VOLUME_HULL_H

#include "engine/bind.h"

/* The convex hull of the boxes in the picture, a pixel wider, in clip coordinates: of what can be
 * seen of them, where the rest is leapt over; no points if that is nothing. Of what reaches behind
 * the eye, or of no volumes, the whole picture. */
void plr_volume_hull(const plr_volume_state *volumes, const size_t *members, size_t count,
                     const plr_frame *frame, plr_hull *hull);

#endif
