/* The lights of a shape under the names that content of other browsers uses:
 * castle_LightSource0Color, castle_LightSource1SpotDirection, ... N counts the lights in the order
 * of their calls. No GL. */
#ifndef PLR_ENGINE_LIGHT_VALUES_H
#define PLR_ENGINE_LIGHT_VALUES_H

#include "engine/recipe.h"

typedef struct plr_light_value plr_light_value;

/* What such a name stands for, and which light of the recipe; NULL if it is none, or if there is no
 * light of that number. */
const plr_light_value *plr_light_value_find(const plr_recipe *recipe, const char *name,
                                            const plr_binding **light);
/* Up to four numbers; places and directions are in eye space. */
void plr_light_value_get(const plr_light_value *value, const plr_binding *light,
                         const plr_matrix *world_to_eye, float out[4]);

/* What the lights' own effects know of them, in eye space: three numbers. A headlight is a
 * DirectionalLight with the defaults. */
void plr_light_direction(const plr_binding *light, const plr_matrix *world_to_eye, float *out);
void plr_light_location(const plr_binding *light, const plr_matrix *world_to_eye, float *out);

#endif
