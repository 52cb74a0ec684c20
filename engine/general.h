/* General programs: no frame waits for a compiler.
 *
 * A specialised program has in its text what the scene has switched on, and nothing else. A general
 * one is made of the same recipe, with what is switched off, too: its effects have a gate, a
 * uniform that says whether they are on (plr_effect.gate, effects/general/Gate.glsl). Switches are
 * `enabled` of styles and clip planes, `on` of lights, `headlight`, `lighting` of styles,
 * segmentEnabled. Everything else that may be edited is data and uniforms in programs of both
 * kinds.
 *
 * A world is made of programs of one kind: view->general says which. A view that is `interactive`
 * looks for the specialised programs after an edit; where some would have to be compiled first, the
 * world is made general, and the specialised programs are built beside (engine/builder.h) and taken
 * over by plr_view_build or a later update. An edit that changes the general programs, too (another
 * style, node or effect), leaves their class and waits for the compiler. */
#ifndef PLR_ENGINE_GENERAL_H
#define PLR_ENGINE_GENERAL_H

#include "engine/view.h"

/* ---- In recipes ---- */

/* Whether a light or plane that is `off` is in the programs of this world, gated: of those, the
 * ones that no effect of an author is on, who may act without being called by it. */
bool plr_general_has(const plr_view *view, bool off, const plr_node *node);
/* In general worlds, the effect that hides a volume, or a shadow of it, while `hidden`. */
void plr_general_hide(plr_view *view, plr_recipe *recipe, bool hidden, size_t volume,
                      size_t attached);
/* How many effects of a kind a general recipe gets more than the `count` that the scene has: as
 * many as an edit may add without leaving the class. None in a specialised one. */
size_t plr_general_spares(plr_view *view, plr_slot_kind kind, size_t count);

/* ---- In views ---- */

/* Makes the world anew after an edit, as seen from view->eye_to_world, of the programs that can be
 * had. */
void plr_general_remake(plr_view *view, plr_diags *diags);

#endif
