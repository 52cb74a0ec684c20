/* How the volumes of a cast are sampled: no more than the scene and the wanted error need. */
#include "engine/volume_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/dialect.h"
#include "engine/image_internal.h"
#include "engine/pilot.h"
#include "engine/volume_blocks.h"
#include "engine/volume_pass.h"
#include "engine/volume_table.h"

/* ---- Tables ---- */

enum {
    MOST_LOOKS = 256 /* at styles within styles */
};

/* A look at styles. */
typedef struct map_search {
    const plr_node *map; /* the last one that is on */
    bool general;        /* what is off must be maps, too (engine/general.h) */
    bool any;            /* map, on or off */
    size_t left;
} map_search;

/* Whether a style, and what is inside, is opacity maps alone; the last one counts. */
static bool find_map(const plr_node *style, bool on, map_search *s) {
    if (!s->left)
        return false;
    --s->left;
    if (!style)
        return true;
    on = on && plr_node_bool(style, "enabled");
    if (!on && !s->general)
        return true;
    if (plr_node_is(style, "OpacityMapVolumeStyle")) {
        s->any = true;
        s->map = on ? style : s->map;
        return true;
    }
    if (!plr_node_is(style, "ComposedVolumeStyle"))
        return false;
    const plr_field *styles = plr_node_field(style, "renderStyle");
    for (size_t i = 0; i < styles->count; i++)
        if (!find_map(styles->value.nodes[i], on, s))
            return false;
    return s->any; /* without one, voxels stay as they are */
}

static plr_table *make_table(plr_view *view, const plr_atlas_place *place) {
    static const float ramp[8] = {0, 0, 0, 0, 1, 1, 1, 1}, reversed[8] = {0, 0, 0, 1, 1, 1, 1, 0};
    if (!place->function)
        return plr_table_make(&view->textures, &view->arena,
                              view->desc.dialect == PLR_DIALECT_2005 ? reversed : ramp, 2);
    const plr_image *image = &place->function->image;
    size_t count = (size_t)image->width * image->height;
    float *texels = malloc((count + 1) * 4 * sizeof *texels);
    if (!texels)
        longjmp(*view->arena.out_of_memory, 1);
    plr_image_convert(image, 4, PLR_FLOAT32, texels);
    if (image->width == 1)
        memcpy(texels + 4, texels, 4 * sizeof *texels);
    plr_table *table =
        plr_table_make(&view->textures, &view->arena, texels, image->width > 1 ? image->width : 2);
    free(texels);
    return table;
}

/* Distances between blocks where something can be seen. */
static plr_texture *make_leaps(plr_view *view, plr_volume_state *state) {
    const plr_blocks *blocks = state->blocks;
    size_t count = plr_blocks_count(blocks);
    plr_image image = {.width = blocks->size[0],
                       .height = blocks->size[1],
                       .depth = blocks->size[2],
                       .components = 1,
                       .type = PLR_UINT8};
    bool *full = malloc(count * sizeof *full);
    image.samples = malloc(count);
    if (!full || !image.samples) {
        free(full);
        free(image.samples);
        longjmp(*view->arena.out_of_memory, 1);
    }
    state->full_blocks = 0;
    for (size_t i = 0; i < count; i++) {
        full[i] =
            plr_table_sees(state->table, (double)blocks->range[i][0], (double)blocks->range[i][1]);
        state->full_blocks += full[i];
    }
    plr_blocks_distances(blocks, full, image.samples);
    free(full);
    return plr_textures_make(&view->textures, &image, PLR_TEXTURE_3D_LABELS, false);
}

/* Makes the table of a volume that has one. */
static bool find_table(plr_view *view, plr_volume_state *state) {
    const plr_field *styles = plr_node_field(state->node, "renderStyle");
    map_search search = {.general = state->general, .left = MOST_LOOKS};
    if (state->kind != PLR_VOLUME_FILLED || styles->type != PLR_SFNODE || !state->blocks ||
        (state->general && view->general_state.no_tables) || state->authors_act || state->labels ||
        !find_map(styles->count ? styles->value.nodes[0] : NULL, true, &search))
        return false;
    if (plr_pass_fog(view, view->volumes.leaves[state->index]->scope)->node)
        return false;
    const plr_atlas_place *place = plr_style_place(view, search.map, state->grid);
    if (!place)
        return false;
    plr_table *table = make_table(view, place);
    if (table->walls > 1)
        return false;
    state->table = table;
    state->integrals = state->table->texture;
    state->sums = state->table->sums;
    state->ranges = state->table->ranges;
    plr_table_seen(state->table, state->seen);
    state->leaps = make_leaps(view, state);
    return true;
}

/* ---- Plans ---- */

/* Together volumes need no more textures than every machine has, opaque values of one would have to
 * end the parts of others, and translucent surfaces cut rays elsewhere. */
static bool can_be_cut(plr_view *view, const plr_cast *cast) {
    enum {
        MOST_TOGETHER = 3
    };
    bool walls = false;
    for (size_t i = 0; i < cast->count; i++)
        walls = walls || view->volumes.volumes[cast->members[i]].table->walls > 0;
    return cast->count <= MOST_TOGETHER && !(walls && cast->count > 1) &&
           !plr_cast_is_divided(view, cast);
}

static bool has_tables(plr_view *view, const plr_cast *cast) {
    bool tabled = true;
    for (size_t i = 0; tabled && i < cast->count; i++) {
        plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        tabled = state->table || find_table(view, state);
    }
    return tabled && can_be_cut(view, cast);
}

/* The greatest error asked for that is kept: below, numbers of 32 bits are too coarse. */
#define LEAST_ERROR (1.0 / 4096)

/* Whether opaque values of one volume may lie within another: where they end a ray, the whole part
 * of the other counts that they lie in. */
static bool has_walls_within(const plr_view *view, const plr_cast *cast) {
    bool walls = false;
    for (size_t i = 0; i < cast->count; i++)
        walls = walls || view->volumes.volumes[cast->members[i]].table->walls > 0;
    return walls && cast->count > 1;
}

/* Below this errors were seen of functions that jump. */
#define LEAST_BOUNDED (1.0 / 300)

static bool are_tame(const plr_view *view, const plr_cast *cast) {
    bool tame = true;
    for (size_t i = 0; i < cast->count; i++)
        tame = tame && view->volumes.volumes[cast->members[i]].table->tame;
    return tame;
}

static void choose(plr_view *view, plr_cast *cast, bool early_end) {
    const plr_view_desc *desc = &view->desc;
    plr_plan *plan = &cast->plan;
    bool fixed = desc->step > 0;
    *plan = (plr_plan){.asked = fixed             ? 0
                                : desc->error > 0 ? desc->error
                                                  : 1.0 / 255,
                       .value = -1,
                       .method = PLR_METHOD_MIDPOINT,
                       .step = fixed ? desc->step : 0.5,
                       .why = "the steps were asked for"};
    plr_method wanted = desc->method != PLR_METHOD_AUTO ? desc->method
                        : fixed                         ? PLR_METHOD_MIDPOINT
                                                        : PLR_METHOD_CELLS;
    if (wanted != PLR_METHOD_MIDPOINT && !has_tables(view, cast)) {
        plan->why =
            "samples in the middle of steps: a volume is not made visible by one transfer function "
            "of one component alone, or there are too many together, so no bound is known";
        return;
    }
    plan->method = wanted;
    if (wanted == PLR_METHOD_MIDPOINT)
        return;
    plan->leaps = !desc->no_leaping;
    if (wanted != PLR_METHOD_CELLS)
        return;
    double error = plan->asked > 0 ? plan->asked : 1.0 / 255;
    plan->value = fmax(error, LEAST_ERROR);
    bool walls = has_walls_within(view, cast);
    bool tame = are_tame(view, cast);
    tame = tame && plan->value >= LEAST_BOUNDED;
    plan->bounded = early_end && !walls && tame;
    plan->step = sqrt(3);
    cast->allowed = 0.75 * plan->value;
    plan->why =
        !tame ? "a transfer function is nearly opaque or very steep somewhere: rays are cut as if "
                "the "
                "bound held, but the error is estimated"
        : walls
            ? "volumes are drawn together of which one has opaque values: the error is estimated"
        : early_end
            ? "in each cell of voxels the value is a cubic along the ray; it is cut until what "
              "extinction and colour can differ from their integrals keeps the error"
            : "an effect of an author decides how colours accumulate: the error is estimated";
}

/* ---- In words ---- */

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

static plr_choice say_leaps(plr_view *view, const plr_cast *cast, bool early_end) {
    if (!cast->plan.leaps)
        return say_skips(view, cast, early_end);
    size_t full = 0, all = 0;
    for (size_t i = 0; i < cast->count; i++) {
        const plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        full += state->full_blocks;
        all += plr_blocks_count(state->blocks);
    }
    return (plr_choice){
        "skipping", "by distances between blocks",
        plr_arena_format(
            &view->arena,
            "something can be seen in %.0f %% of %zu blocks of %d cells a side; pictures "
            "stay the same to the bit",
            all ? 100.0 * (double)full / (double)all : 0, all, PLR_BLOCK_CELLS)};
}

static plr_choice say_method(plr_view *view, const plr_plan *plan) {
    static const char *const names[] = {[PLR_METHOD_MIDPOINT] = "midpoint",
                                        [PLR_METHOD_PREINTEGRATED] = "preintegrated",
                                        [PLR_METHOD_CELLS] = "cells"};
    static const char *const costs[] = {
        [PLR_METHOD_MIDPOINT] = "a sample and its styles a step",
        [PLR_METHOD_PREINTEGRATED] = "a sample a step, and an integral where it can be seen",
        [PLR_METHOD_CELLS] = "three samples a cell, and as many integrals as the error asks for"};
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

static void say(plr_view *view, plr_cast *cast, bool early_end) {
    enum {
        CHOICES = 5
    };
    plr_choice *choices = PLR_NEW_ARRAY(&view->arena, CHOICES, plr_choice);
    choices[0] = say_method(view, &cast->plan);
    choices[1] = say_error(view, &cast->plan);
    choices[2] = say_leaps(view, cast, early_end);
    choices[3] = (plr_choice){"early termination", early_end ? "where it can be" : "off",
                              early_end ? "rays end where less than an eighth of the error shines "
                                          "through"
                                        : "an effect of an author decides what accumulates"};
    choices[4] =
        (plr_choice){"storage", storage_words(view, cast), "voxels keep the precision of the data"};
    cast->plan.choices = choices;
    cast->plan.choice_count = CHOICES;
}

void plr_cast_plan(plr_view *view, plr_cast *cast, bool early_end) {
    choose(view, cast, early_end);
    say(view, cast, early_end);
    plr_pilot_prepare(view, cast);
}
