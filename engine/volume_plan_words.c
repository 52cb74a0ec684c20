/* The plan of a cast in words: each choice, why, what it costs and what bound it gives. */
#include <string.h>

#include "engine/light_strength.h"
#include "engine/volume_blocks.h"
#include "engine/volume_pass.h"
#include "engine/volume_plan.h"

static const char *storage_words(const plr_view *view, const plr_cast *cast) {
    bool floats = false;
    for (size_t i = 0; i < cast->count; i++) {
        const plr_grid *grid = view->volumes.volumes[cast->members[i]].grid;
        floats = floats || grid->voxels->image.type == PLR_FLOAT32;
    }
    return floats ? "32-bit float texels"
                  : "16-bit texels: drivers may filter 8-bit ones in 8-bit arithmetic";
}

/* Where there are no blocks to leap over. */
static plr_choice say_skips(const plr_view *view, const plr_cast *cast, bool early_end) {
    bool authors = false;
    if (cast->dense)
        return (plr_choice){"skipping", "none",
                            "something can be seen nearly everywhere: to look for it would cost "
                            "more than it saves"};
    for (size_t i = 0; i < cast->count; i++)
        authors = authors || view->volumes.volumes[cast->members[i]].authors_see_all;
    if (cast->plan.method == PLR_METHOD_MIDPOINT && plr_cast_skips(view, cast, early_end))
        return (plr_choice){"skipping", "of clear samples",
                            "rays look ahead for what opacity maps do not make clear; the rest has "
                            "no styles, and pictures stay the same"};
    return authors ? (plr_choice){"skipping", "none",
                                  "an effect of an author may make something of what is clear; "
                                  "PLUG-PROMISE: keeps-transparent would say that it does not"}
                   : (plr_choice){"skipping", "none by blocks",
                                  "blocks serve where one transfer function makes a volume visible "
                                  "and nobody asks for single samples"};
}

static plr_choice say_short_leaps(plr_view *view, const plr_cast *cast, bool early_end) {
    bool samples =
        cast->plan.method == PLR_METHOD_MIDPOINT && plr_cast_skips(view, cast, early_end);
    return (plr_choice){
        "skipping", samples ? "of clear samples" : "none",
        plr_arena_format(&view->arena,
                         "with leaps over blocks rays would find what can be seen %.2f times as "
                         "fast: they would cost more than they save",
                         cast->leap_gain)};
}

static plr_choice say_leaps(plr_view *view, const plr_cast *cast, bool early_end) {
    if (cast->short_leaps)
        return say_short_leaps(view, cast, early_end);
    if (!cast->plan.leaps)
        return say_skips(view, cast, early_end);
    size_t full = 0, all = 0;
    unsigned cells = 0;
    for (size_t i = 0; i < cast->count; i++) {
        const plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        if (cast->plan.method == PLR_METHOD_MIDPOINT && !state->leaping)
            continue;
        cells = state->blocks->cells;
        full += state->full_blocks;
        all += plr_blocks_count(state->blocks);
    }
    return (plr_choice){
        "skipping", "by distances between blocks",
        plr_arena_format(
            &view->arena,
            "something can be seen in %.0f %% of %zu blocks of %u cells a side; pictures "
            "stay the same to the bit",
            all ? 100.0 * (double)full / (double)all : 0, all, cells)};
}

static plr_choice say_method(plr_view *view, const plr_plan *plan) {
    static const char *const names[] = {[PLR_METHOD_MIDPOINT] = "midpoint",
                                        [PLR_METHOD_PREINTEGRATED] = "preintegrated",
                                        [PLR_METHOD_CELLS] = "cells"};
    static const char *const costs[] = {
        [PLR_METHOD_MIDPOINT] = "a sample and its styles a step",
        [PLR_METHOD_PREINTEGRATED] = "a sample a step, and an integral where it can be seen",
        [PLR_METHOD_CELLS] =
            "one look at the corners of each cell, or three samples, and as many integrals as the "
            "error asks for"};
    return (plr_choice){"sampling", names[plan->method],
                        plr_arena_format(&view->arena, "%s; costs %s, of at most %.3g voxels",
                                         plan->why, costs[plan->method], plan->step)};
}

static plr_choice say_error(plr_view *view, const plr_plan *plan) {
    return (plr_choice){
        "error", plan->bounded ? "bounded" : "estimated",
        plan->bounded
            ? plr_arena_format(&view->arena, "no channel of a pixel differs by more than %.3g",
                               plan->value)
            : "no bound is known; with `--error`, pilot drawings measure it and choose the "
              "steps"};
}

/* Built-in effects on volumes of the cast that are styles, or else lights (a headlight is no node).
 */
static size_t count_effects(const plr_cast *cast, bool styles) {
    size_t count = 0;
    for (size_t i = 0; i < cast->pass.recipe.effects.count; i++) {
        const plr_effect *effect = &cast->pass.recipe.effects.items[i];
        const char *last = effect->name ? strstr(effect->name, styles ? "Style" : "Light") : NULL;
        count += effect->builtin && last && strlen(last) == strlen("Style");
    }
    return count;
}

static plr_choice say_styles(plr_view *view, const plr_cast *cast) {
    size_t count = count_effects(cast, true);
    bool tabled = cast->plan.method != PLR_METHOD_MIDPOINT;
    return (plr_choice){"styles",
                        count    ? plr_arena_format(&view->arena, "%zu at samples", count)
                        : tabled ? "in tables"
                                 : "none at samples",
                        tabled
                            ? "tables have the opacity maps; what is disabled is not in the program"
                            : "what is disabled is not in the program"};
}

static plr_choice say_lights(plr_view *view, const plr_cast *cast) {
    size_t weak = 0;
    for (size_t i = 0; i < view->lights.count; i++)
        weak += view->lights.items[i].weak && view->lights.items[i].volume;
    return (plr_choice){
        "lights", plr_arena_format(&view->arena, "%zu", count_effects(cast, false)),
        plr_arena_format(&view->arena,
                         "%zu left out that would change no value by a quarter of the error",
                         weak)};
}

static plr_choice say_gradients(const plr_cast *cast) {
    const plr_program *program = cast->pass.program;
    bool held = false;
    for (size_t i = 0; program && i < plr_program_symbol_count(program); i++)
        held = held || strcmp(plr_program_symbol(program, i)->name, "voxelGradients") == 0;
    const char *text = program ? plr_program_text(program, PLR_FRAGMENT, NULL) : NULL;
    if (held)
        return (plr_choice){"gradients", "held",
                            "one look at differences at voxel centres, 16 bytes a voxel"};
    if (text && strstr(text, "gradient_at"))
        return (plr_choice){"gradients", "of samples",
                            "six more samples where one is asked for, exact as voxels are"};
    return (plr_choice){"gradients", "none", "nothing asks for them"};
}

void plr_cast_explain(plr_view *view, plr_cast *cast, bool early_end) {
    const plr_choice choices[] = {
        say_method(view, &cast->plan),
        say_error(view, &cast->plan),
        say_leaps(view, cast, early_end),
        {"early termination", early_end ? "where it can be" : "off",
         early_end ? "rays end where less than an eighth of the error shines through"
                   : "an effect of an author decides what accumulates"},
        say_styles(view, cast),
        say_lights(view, cast),
        say_gradients(cast),
        {"storage", storage_words(view, cast), "voxels keep the precision of the data"}};
    size_t count = sizeof choices / sizeof *choices;
    plr_choice *kept = PLR_NEW_ARRAY(&view->arena, count, plr_choice);
    memcpy(kept, choices, sizeof choices);
    cast->plan.choices = kept;
    cast->plan.choice_count = count;
}
