/* Lights that are too weak to matter are in no program. No GL. */
#ifndef PLR_ENGINE_LIGHT_STRENGTH_H
#define PLR_ENGINE_LIGHT_STRENGTH_H

#include "engine/recipe.h"

struct plr_view;
struct plr_volume_state;

/* What a style or material makes of light. */
typedef enum plr_light_use {
    PLR_LIGHT_PLAIN, /* adds at most twice its strength, and once its ambient part */
    PLR_LIGHT_STEEP, /* nothing is known but that no light adds nothing */
    PLR_LIGHT_COUNTS /* lights count, however strong they are */
} plr_light_use;

typedef struct plr_light_answer {
    const plr_light *light;
    const struct plr_volume_state *volume; /* in whose box it shines; NULL: anywhere */
    plr_light_use use;
    double share; /* of the wanted error */
    bool weak;
} plr_light_answer;

/* The answers that programs were made with. */
typedef struct plr_light_answers {
    plr_light_answer *items;
    size_t count, capacity;
    uint8_t *asked; /* of lights that may shine anywhere, by number of the node: a bit a use */
    bool *authors;  /* whether authors' effects are on volumes of the world `around`; or NULL */
    const plr_leaf *const *around;
} plr_light_answers;

/* Whether the picture is the same to a part of the wanted error without the light: all lights that
 * are left out together change no value by more than a quarter of it. `attached`: the effect that
 * it is for, 0 for the material of a shape, which is in the recipe already. */
bool plr_light_is_weak(struct plr_view *view, const plr_recipe *recipe, const plr_light *light,
                       size_t attached, size_t volume);
/* Whether effects of authors are on a node or on groups around it. */
bool plr_authors_reach(const plr_node *node, const plr_scope *scope);
/* Whether all answers would be the same now that lights or what they shine on have changed. */
bool plr_lights_stay(const struct plr_view *view);

#endif
