/* How many textures one program may read. */
#include <string.h>

#include "engine/bind.h"

/* What GL 3.3 promises; a machine may have more. */
enum {
    FEWEST_UNITS = 16
};

static size_t most_samplers(const plr_kitchen *k) {
    GLint units = FEWEST_UNITS;
    if (k->textures->gl)
        k->textures->gl->GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &units);
    return (size_t)units;
}

static void leave_out(plr_kitchen *k, plr_recipe *recipe, const plr_symbol *symbol, size_t most) {
    plr_effect *effect = &recipe->effects.items[symbol->effect];
    plr_diags_add(k->diags, PLR_CODE_LIMIT, effect->builtin ? effect->place : symbol->place,
                  "a shape can read %zu textures at a time; %s is left out", most, effect->name);
    effect->disabled = true;
}

bool plr_bind_check_samplers(plr_kitchen *k, plr_recipe *recipe, const plr_program *program) {
    size_t count = 0, most = most_samplers(k);
    for (size_t i = 0; i < plr_program_symbol_count(program); i++) {
        const plr_symbol *symbol = plr_program_symbol(program, i);
        bool sampler = symbol->kind == PLR_UNIFORM && strstr(symbol->type, "sampler") &&
                       symbol->stages & 1u << PLR_FRAGMENT;
        size_t own = !sampler ? 0 : symbol->array ? symbol->array : 1;
        if (count + own > most && symbol->effect != PLR_NO_EFFECT) {
            leave_out(k, recipe, symbol, most);
            return true;
        }
        count += own;
    }
    return false;
}
