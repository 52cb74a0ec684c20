/* Recipes that were composed before: when a scene changes and its parts are made anew, most of them
 * are as they were, and need neither be linked nor compiled. */
#ifndef PLR_ENGINE_MEMO_H
#define PLR_ENGINE_MEMO_H

#include "engine/compose.h"

/* What became of the recipe, and the effects that were left out of it; NULL if it is new. `*key` is
 * then what plr_memo_add wants. */
typedef struct plr_memo_key {
    const char *bytes; /* in the kitchen's arena */
    size_t size;
    uint64_t hash;
} plr_memo_key;
bool plr_memo_find(plr_composer *composer, plr_recipe *recipe, const char *kind, plr_memo_key *key,
                   plr_built **built);
/* Copies what the recipe holds to where it outlives the kitchen's arena: programs refer to it. */
void plr_memo_settle(plr_composer *composer, plr_recipe *recipe);
/* Remembers what became of it; `built` may be NULL. */
void plr_memo_add(plr_composer *composer, const plr_memo_key *key, const plr_recipe *recipe,
                  plr_built *built);

#endif
