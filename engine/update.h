/* A view in time, from inside. */
#ifndef PLR_ENGINE_UPDATE_H
#define PLR_ENGINE_UPDATE_H

#include "engine/view.h"

/* The viewpoint that is asked for. Once the view is made, another one stands in where that one is
 * hidden for a time; before, there is NULL. */
const plr_viewpoint *plr_view_chosen(const plr_view *view, const plr_flat *flat);
/* Brings the scene to the view's time, as its viewpoint sees it; where the eye is comes out. False
 * if there is no viewpoint as asked for. */
bool plr_view_live(plr_view *view, plr_matrix *eye_to_world, plr_diags *diags);
/* Flattens the scene and makes everything ready for drawing, in the view's arena; with GL, uploads.
 * False if there is no viewpoint as asked for (reported). */
bool plr_view_make(plr_view *view, const plr_matrix *eye_to_world, plr_diags *diags);
/* The same once more, after what was made before is freed; what can be kept is kept. */
void plr_view_remake(plr_view *view, const plr_matrix *eye_to_world, plr_diags *diags);
/* Draws into the framebuffer of the last picture, targets aside. Needs GL. */
void plr_view_draw_again(plr_view *view);
/* The parts of the view that are told while diagnostics are at hand. */
void plr_view_set_diags(plr_view *view, plr_diags *diags);
/* Remembers what textures were loaded from. */
void plr_view_note_textures(plr_view *view);
/* Changes where a field of the node, or of a node in its fields, is set to another value. */
uint64_t plr_deep_revision(const plr_node *node, int depth);

#endif
