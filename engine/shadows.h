/* Shadow maps: which lights have one, what casts into it, and the effect that reads it. */
#ifndef PLR_ENGINE_SHADOWS_H
#define PLR_ENGINE_SHADOWS_H

#include "engine/view.h"

/* One light's map of one world. */
typedef struct plr_shadow {
    plr_node *light;
    const plr_node *map; /* GeneratedShadowMap, or NULL: as the light's own fields say */
    plr_world *world;    /* whose shapes cast; NULL: the scene */
    plr_shadow_values values;
} plr_shadow;

/* Attaches a shadow to each light of the recipe, from effect `from` on, that casts some: that has
 * `shadows` TRUE, or that the appearance (may be NULL) names in receiveShadows or by a
 * GeneratedShadowMap among its textures. */
void plr_recipe_shadows(plr_view *view, plr_recipe *recipe, size_t from, size_t volume,
                        const plr_node *appearance);
/* ---- Of volumes (volume_shadows.c) ---- */

/* The lights of the recipe from effect `from` on stand in the shadow of volumes. */
void plr_recipe_receive(plr_view *view, plr_recipe *recipe, size_t from);
/* Adds what such lights ask, where there are some: after the last of them. `skips_clear`: the light
 * on what is transparent does not matter. */
void plr_recipe_volume_shadows(plr_view *view, plr_recipe *recipe, bool skips_clear);

/* ---- Maps ---- */

/* The shadow that is drawn into a GeneratedShadowMap, made if there is none; NULL without a light.
 */
plr_shadow *plr_shadow_of_map(plr_view *view, const plr_node *map, plr_texture *texture);
/* Composes what draws shapes into shadow maps, where the world has some. */
void plr_casters_prepare(plr_view *view);
void plr_casters_find(plr_view *view);
void plr_casters_finish(plr_view *view);

/* Whether an author's effect may move the vertices of the shape. */
bool plr_model_is_moved(const plr_model *model);
/* Narrows a light's view to what casts shadows on anything. */
void plr_shadow_fit(const plr_view *view, const plr_shadow *shadow, plr_frame *frame);

/* ---- Drawing. Needs GL. ---- */

/* Brings the values to the light's place now; the frames of its faces (1 or 6) come out. */
int plr_shadow_plan(plr_view *view, plr_shadow *shadow, plr_frame frames[6]);
/* Draws what casts into the framebuffer that is bound, over what it holds. */
void plr_casters_draw(plr_view *view, const plr_shadow *shadow, const plr_frame *frame);

#endif
