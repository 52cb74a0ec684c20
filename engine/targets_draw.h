/* Drawing into one target. Needs GL; changes state of the context. */
#ifndef PLR_ENGINE_TARGETS_DRAW_H
#define PLR_ENGINE_TARGETS_DRAW_H

#include "engine/targets.h"

/* Finds the targets that the picture needs, what is read before what reads it. */
void plr_targets_order(plr_view *view, const plr_frame *here);
/* Whether its `update` has it drawn for this picture. */
bool plr_target_is_due(const plr_view *view, const plr_target *target);
/* To opaque black, or as far as depths go, where the target asks for it. */
void plr_target_clear(plr_view *view, plr_target *target);
/* Draws it, in its world. `here` as in plr_targets_draw. */
void plr_target_draw(plr_view *view, plr_target *target, const plr_frame *here);
/* The frame in which a RenderedTexture is drawn. Sorts the world that it shows. */
void plr_target_plan(plr_view *view, const plr_target *target, const plr_frame *here,
                     plr_frame *frame);

/* ---- ROUTEs from a RenderedTexture ---- */

void plr_targets_find_signals(plr_view *view);
void plr_targets_send_cameras(plr_view *view);
void plr_target_send_rendering(plr_view *view, const plr_target *target, bool rendering);

#endif
