/* Pilot drawings: where no bound of the error is known, it is measured.
 *
 * The steps of casts that are `estimated` are chosen from a ladder of 1, 1/2, 1/4, 1/8 and 1/16
 * voxel (twice the planned step, and so on), when plr_view_desc.error was given. To judge a rung,
 * the whole view is drawn twice into PLR_PILOT_WIDTH x PLR_PILOT_HEIGHT pixels that cover what the
 * casts cover of the picture: by that rung's steps, and by steps that are shorter in the golden
 * ratio, squared, so that no pattern of the voxels fits both. An error that shrinks with the step
 * (order 1) is at most 1.62 times the greatest difference, of order 2 at most 1.17 times it: twice
 * the difference is said, and the rest is for pixels between the pilot's. Rays that end early add
 * an eighth of the error that was asked for.
 *
 * A rung whose estimate is too large tells which ones need not be tried: no rung is better than
 * four times the one before. The first rung that keeps the error is taken; if none does, the last.
 *
 * The same programs draw: only the values of uniforms differ. Pilots cost as many samples as some 7
 * times PLR_PILOT_WIDTH x PLR_PILOT_HEIGHT rays take with the steps that are chosen, at most,
 * whatever the size of the picture; nothing where the plan is `bounded`, where steps were asked
 * for, and where no error was. */
#ifndef PLR_ENGINE_PILOT_H
#define PLR_ENGINE_PILOT_H

#include "engine/view.h"

/* Whether pilots decide about the steps of a cast; no GL. */
bool plr_pilot_serves(const plr_view *view, const plr_cast *cast);
/* The shortest steps of any pilot, to those that are planned. */
double plr_pilot_shortest(const plr_cast *cast);
/* Makes room for what will be said of a cast that they serve, after its plan was put in words. */
void plr_pilot_prepare(plr_view *view, plr_cast *cast);

/* Before a frame is drawn, of which only camera and time matter, and after plr_targets_draw (`here`
 * as there): measures where that has not been done for this frame and scene. In views that are
 * interactive it is left to plr_pilot_rest: steps are those that were found last. Needs GL. */
void plr_pilot_fly(plr_view *view, const plr_frame *frame, const plr_frame *here);
/* Measures, in a view that is interactive, for the frame that was drawn last. The GL state is set
 * back. Needs GL. */
void plr_pilot_rest(plr_view *view);
/* Frees what it made in GL. */
void plr_pilot_finish(plr_view *view);

#endif
