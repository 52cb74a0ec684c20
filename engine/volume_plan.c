/* How the volumes of a cast are sampled: no more than the scene and the wanted error need. */
#include "engine/volume_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/dialect.h"
#include "engine/image_internal.h"
#include "engine/volume_blocks.h"
#include "engine/volume_certain.h"
#include "engine/volume_leaps.h"
#include "engine/volume_maps.h"
#include "engine/volume_pass.h"
#include "engine/volume_segments.h"
#include "engine/volume_table.h"

/* ---- Tables ---- */

enum {
    MOST_LOOKS = 4096 /* at styles within styles */
};

/* A look at styles that keep what is clear (plr_volume_keeps_clear): opacity maps come first. */
typedef struct style_search {
    const plr_node *map; /* the last one that is on */
    bool general;        /* what is off counts, too (engine/general.h) */
    bool any;            /* map, on or off */
    bool styled;         /* something that is no map */
    bool bare;           /* that is on, without a map before it */
    size_t left;
} style_search;

static void search_styles(const plr_node *style, bool on, style_search *s) {
    if (!style || !s->left)
        return;
    --s->left;
    on = on && plr_node_bool(style, "enabled");
    if (!on && !s->general)
        return;
    if (plr_node_is(style, "OpacityMapVolumeStyle")) {
        s->any = true;
        s->map = on ? style : s->map;
    } else if (plr_node_is(style, "ComposedVolumeStyle")) {
        const plr_field *styles = plr_node_field(style, "renderStyle");
        for (size_t i = 0; i < styles->count; i++)
            search_styles(styles->value.nodes[i], on, s);
    } else {
        s->styled = true;
        s->bare = s->bare || !s->map;
    }
}

/* Where none is asked for. */
#define USUAL_ERROR (1.0 / 255)

/* Two units in the last place of voxels: so far from an opaque value one is opaque, too. */
static float find_slack(const plr_grid *grid) {
    return grid->voxels->image.type == PLR_FLOAT32 ? 1.2e-7F : 7.6e-6F;
}

plr_table *plr_volume_make_table(plr_view *view, const plr_volume_state *state,
                                 const plr_function *function, bool in_stack, bool gentle) {
    const plr_atlas_place *place = function->place;
    double factor = function->factor;
    static const float ramps[2][8] = {{0, 0, 0, 0, 1, 1, 1, 1}, {0, 0, 0, 1, 1, 1, 1, 0}};
    bool reversed = view->desc.dialect == PLR_DIALECT_2005 && place;
    const plr_image *image = place && place->function ? &place->function->image : NULL;
    uint32_t width = image && image->width > 1 ? image->width : 2;
    size_t count = image ? (size_t)image->width * image->height + 1 : 2;
    float *texels = malloc(count * 4 * sizeof *texels);
    if (!texels)
        longjmp(*view->arena.out_of_memory, 1);
    if (image)
        plr_image_convert(image, 4, PLR_FLOAT32, texels);
    else
        memcpy(texels, ramps[reversed], sizeof ramps[reversed]);
    if (image && image->width == 1)
        memcpy(texels + 4, texels, 4 * sizeof *texels);
    bool even = true; /* what is cut off at 1 before it is multiplied is not linear */
    for (size_t i = 0; i < width && factor != 1; i++) {
        even = even && texels[4 * i + 3] <= 1;
        texels[4 * i + 3] = (float)((double)texels[4 * i + 3] * factor);
    }
    plr_table_wish wish = {.slack = find_slack(state->grid),
                           .in_stack = in_stack,
                           .bare = function->bare,
                           .error = state->general || !gentle ? 0
                                    : view->desc.error > 0    ? view->desc.error
                                                              : USUAL_ERROR};
    plr_table *table = plr_table_make(&view->textures, &view->arena, texels, width, &wish);
    table->tame = table->tame && even;
    free(texels);
    return table;
}

static bool sees_block(const void *user, size_t block) {
    const plr_volume_state *state = user;
    const float *range = state->blocks->range[block];
    return plr_table_sees(state->table, (double)range[0], (double)range[1]);
}

/* Cell c of an axis lies between the centres of voxels c - 1 and c. */
static void add_visible(plr_volume_state *state, size_t block) {
    const plr_blocks *blocks = state->blocks;
    for (int axis = 0; axis < 3; axis++) {
        double cell = (double)(block % blocks->size[axis] * blocks->cells) - 0.5;
        block /= blocks->size[axis];
        double low = fmax(cell / state->grid->size[axis], 0);
        double high = fmin((cell + blocks->cells) / state->grid->size[axis], 1);
        state->visible[0][axis] = fmin(state->visible[0][axis], low);
        state->visible[1][axis] = fmax(state->visible[1][axis], high);
    }
}

static void see(plr_volume_state *state, double low, double high) {
    for (int axis = 0; axis < 3; axis++) {
        state->visible[0][axis] = low;
        state->visible[1][axis] = high;
    }
}

plr_texture *plr_volume_make_leaps(plr_view *view, plr_volume_state *state,
                                   bool (*sees)(const void *, size_t), const void *user) {
    const plr_blocks *blocks = state->blocks;
    if (!sees) {
        sees = sees_block;
        user = state;
    }
    size_t count = plr_blocks_count(blocks);
    plr_image image = {.width = blocks->size[0],
                       .height = blocks->size[1],
                       .depth = blocks->size[2],
                       .components = 1,
                       .type = PLR_UINT32};
    uint32_t *sides = plr_arena_array(&view->arena, count, sizeof *sides);
    bool *full = malloc(count * sizeof *full);
    image.samples = malloc(count * sizeof *sides);
    state->full_blocks = 0;
    see(state, 1, 0);
    for (size_t i = 0; full && i < count; i++) {
        full[i] = sees(user, i);
        state->full_blocks += full[i];
        if (full[i])
            add_visible(state, i);
    }
    bool made = full && image.samples && plr_blocks_leaps(blocks, full, sides);
    free(full);
    if (!made) {
        free(image.samples);
        longjmp(*view->arena.out_of_memory, 1);
    }
    memcpy(image.samples, sides, count * sizeof *sides);
    state->leap_sides = sides;
    return plr_textures_make(&view->textures, &image, PLR_TEXTURE_3D_LABELS, false);
}

/* Makes the table of a volume that has one; `bare`: for leaping alone. */
static bool find_table(plr_view *view, plr_volume_state *state, bool bare) {
    const plr_field *styles = plr_node_field(state->node, "renderStyle");
    if (plr_node_is(state->node, "SegmentedVolumeData"))
        return plr_volume_find_segments(view, state);
    if (!state->blocks || state->labels || !plr_volume_keeps_clear(state) ||
        (state->authors_act && !state->authors_colour_only) ||
        (state->general && view->general_state.no_tables))
        return false;
    style_search search = {.general = state->general, .left = MOST_LOOKS};
    const plr_node *style = styles->count ? styles->value.nodes[0] : NULL;
    search_styles(style, true, &search);
    plr_style_map found;
    bool plain = plr_style_find_map(style, state->general, &found);
    bool ramp = plain ? found.bare : search.bare || (style && !search.any && !search.styled);
    const plr_node *map = plain ? found.map : search.map;
    const plr_atlas_place *place = NULL;
    if (!ramp && !(place = plr_style_place(view, map, state->grid)))
        return false;
    const plr_function function = {place, plain ? found.factor : 1, bare};
    state->table = plr_volume_make_table(view, state, &function, false, true);
    state->leaps = plr_volume_make_leaps(view, state, NULL, NULL);
    if (bare)
        return true;
    state->styled = !plain || state->authors_act ||
                    plr_pass_fog(view, view->volumes.leaves[state->index]->scope)->node;
    state->integrals = state->table->texture;
    if (state->styled)
        state->places = plr_table_places(state->table, &view->textures, &view->arena);
    state->sums = state->table->sums;
    state->ranges = state->table->ranges;
    plr_table_seen(state->table, state->seen);
    return true;
}

/* ---- Plans ---- */

static bool are_styled(const plr_view *view, const plr_cast *cast) {
    bool styled = false;
    for (size_t i = 0; i < cast->count; i++)
        styled = styled || view->volumes.volumes[cast->members[i]].styled;
    return styled;
}

/* Volumes together need no more textures than there are, and translucent surfaces cut rays
 * elsewhere. Tables between two values are of one function, with one range of opaque values, of one
 * volume. */
static bool can_be_cut(plr_view *view, const plr_cast *cast, plr_method method) {
    enum {
        MOST_TOGETHER = 3,
        MOST_TEXTURES = 15, /* of 16; one is for depths */
        TEXTURES = 4,       /* of a volume: its voxels, two of its table, leaps */
        LABEL_TEXTURES = 2
    };
    int walls = 0, textures = 0;
    bool whole = true;
    for (size_t i = 0; i < cast->count; i++) {
        const plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        walls += state->table->walls;
        whole = whole && state->table->texture;
        textures += TEXTURES + (state->labels ? LABEL_TEXTURES : 0);
    }
    bool segments = method == PLR_METHOD_PREINTEGRATED || are_styled(view, cast);
    return cast->count <= MOST_TOGETHER && textures <= MOST_TEXTURES &&
           !(segments && (!whole || walls > (cast->count > 1 ? 0 : 1))) &&
           !plr_cast_is_divided(view, cast);
}

static bool has_tables(plr_view *view, const plr_cast *cast) {
    bool tabled = true;
    for (size_t i = 0; tabled && i < cast->count; i++) {
        plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        tabled = state->table || find_table(view, state, false);
    }
    return tabled;
}

/* The greatest error asked for that is kept: below, numbers of 32 bits are too coarse. */
#define LEAST_ERROR (1.0 / 4096)

static bool are_tame(const plr_view *view, const plr_cast *cast) {
    bool tame = true;
    for (size_t i = 0; i < cast->count; i++)
        tame = tame && view->volumes.volumes[cast->members[i]].table->tame;
    return tame;
}

/* ---- Steps that are certain to be enough ---- */

enum {
    MOST_CERTAIN = 8, /* volumes */
    MOST_TRIES = 8
};

/* Of the error a part is for where rays end early, and for rounding. */
#define CERTAIN_PART 0.8
/* Cells cost less than shorter steps, in voxels. */
#define LEAST_CERTAIN 0.16
/* Steps so many times as long are worth a try. */
#define WORTH 1.06

static bool describe(const plr_volume_state *state, plr_certain *v) {
    if (!state->table || !state->table->tame || state->styled || state->general || !state->bends ||
        plr_node_is(state->node, "SegmentedVolumeData"))
        return false;
    *v = (plr_certain){.bends = state->bends,
                       .texels = state->table->texels,
                       .texel_count = state->table->texel_count,
                       .reference = state->reference};
    double squared = 0;
    for (int i = 0; i < 3; i++) {
        v->voxel[i] = state->dimensions[i] / state->grid->size[i];
        squared += state->dimensions[i] * state->dimensions[i];
    }
    v->longest = sqrt(squared);
    return true;
}

/* The longest steps, in voxels, in whose middle samples are certain to keep an error; 0: none that
 * are worth it. */
static double find_certain(plr_view *view, const plr_cast *cast, double error) {
    plr_certain volumes[MOST_CERTAIN];
    double steps[MOST_CERTAIN], whole = 0;
    if (cast->count > MOST_CERTAIN)
        return 0;
    for (size_t i = 0; i < cast->count; i++) {
        const plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        if (!describe(state, &volumes[i]))
            return 0;
        whole = fmax(whole, 1.01 * volumes[i].longest / state->voxel);
    }
    double allowed = CERTAIN_PART * error, low = 0, high = whole, length = whole;
    for (int i = 0; i < MOST_TRIES; i++) {
        for (size_t k = 0; k < cast->count; k++)
            steps[k] = length * view->volumes.volumes[cast->members[k]].voxel;
        double found = plr_certain_error(volumes, cast->count, steps);
        low = found <= allowed ? length : low;
        high = found <= allowed ? high : length;
        if (low >= whole || (!(low > 0) && length <= LEAST_CERTAIN))
            break;
        if (low > 0 && high < WORTH * low)
            break;
        /* errors grow with the square of steps, more or less */
        double guess = fmax(length * sqrt(allowed / found), WORTH * low);
        length = !(low > 0)                  ? LEAST_CERTAIN
                 : found > 0 && guess < high ? 0.99 * guess
                                             : sqrt(low * high);
    }
    return low;
}

static bool is_certain(plr_view *view, plr_cast *cast) {
    plr_plan *plan = &cast->plan;
    double error = fmax(plan->asked, LEAST_ERROR);
    double step = find_certain(view, cast, error);
    if (!(step > 0))
        return false;
    plan->method = PLR_METHOD_MIDPOINT;
    plan->bounded = true;
    plan->value = error;
    plan->step = step;
    plan->why = "values and what the transfer function makes of them change so little from voxel "
                "to voxel that samples "
                "in the middle of such steps are certain to keep the error";
    for (size_t i = 0; i < cast->count; i++) {
        plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        state->step = step * state->voxel;
    }
    return true;
}

/* Where something can be seen in so great a part, to look for where costs more than it saves. */
#define DENSE 0.95

static bool are_blocks_full(const plr_volume_state *state) {
    /* general programs serve whatever can be seen */
    return !state->general &&
           (double)state->full_blocks >= DENSE * (double)plr_blocks_count(state->blocks);
}

static bool are_full(const plr_view *view, const plr_cast *cast) {
    bool full = true;
    for (size_t i = 0; i < cast->count; i++)
        full = full && are_blocks_full(&view->volumes.volumes[cast->members[i]]);
    return full;
}

/* Whether leaps cost more than they save. */
static bool are_leaps_short(plr_cast *cast, const plr_volume_state *state, plr_method method) {
    if (state->general) /* it serves whatever can be seen */
        return false;
    double gain = plr_leaps_gain(state->blocks, state->leap_sides, method, cast->plan.step);
    cast->leap_gain = fmax(cast->leap_gain, gain);
    return gain < plr_leaps_least_gain(method);
}

static bool are_all_short(const plr_view *view, plr_cast *cast, plr_method method) {
    bool all = true;
    for (size_t i = 0; i < cast->count; i++)
        all = are_leaps_short(cast, &view->volumes.volumes[cast->members[i]], method) && all;
    return all;
}

/* Whether samples in the middle of steps may be passed over by blocks: where clear ones may be one
 * by one. Of several volumes each leaps or does not. */
static bool can_leap(plr_view *view, plr_cast *cast, bool early_end) {
    bool may = !view->desc.no_leaping && plr_cast_skips(view, cast, early_end) &&
               !plr_cast_is_divided(view, cast);
    bool leaps = false, any_short = false;
    for (size_t i = 0; i < cast->count; i++) {
        plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        bool blocks = may && !state->general && plr_volume_keeps_clear(state) &&
                      (state->table || find_table(view, state, true));
        if (!blocks)
            see(state, 0, 1);
        bool full = blocks && are_blocks_full(state);
        bool is_short = blocks && !full && are_leaps_short(cast, state, PLR_METHOD_MIDPOINT);
        state->leaping = blocks && !full && !is_short;
        leaps = leaps || state->leaping;
        any_short = any_short || is_short;
        cast->dense = cast->count == 1 && full && plr_table_density(state->table) >= DENSE;
    }
    cast->short_leaps = any_short && !leaps;
    return leaps;
}

static void choose(plr_view *view, plr_cast *cast, bool early_end) {
    const plr_view_desc *desc = &view->desc;
    plr_plan *plan = &cast->plan;
    bool fixed = desc->step > 0;
    cast->dense = cast->short_leaps = false;
    cast->leap_gain = 0;
    *plan = (plr_plan){.asked = fixed             ? 0
                                : desc->error > 0 ? desc->error
                                                  : USUAL_ERROR,
                       .value = -1,
                       .method = PLR_METHOD_MIDPOINT,
                       .step = fixed ? desc->step : 0.5,
                       .why = "the steps were asked for"};
    plr_method wanted = desc->method != PLR_METHOD_AUTO ? desc->method
                        : fixed                         ? PLR_METHOD_MIDPOINT
                                                        : PLR_METHOD_CELLS;
    bool tabled = wanted != PLR_METHOD_MIDPOINT && has_tables(view, cast);
    if (tabled && desc->method == PLR_METHOD_AUTO && early_end && is_certain(view, cast)) {
        plan->leaps = can_leap(view, cast, early_end);
        return;
    }
    if (wanted != PLR_METHOD_MIDPOINT && !(tabled && can_be_cut(view, cast, wanted))) {
        plan->why =
            "samples in the middle of steps: a volume is not made visible by one transfer function "
            "of one component first of all, or there are too many together, so no bound is known";
        plan->leaps = can_leap(view, cast, early_end);
        return;
    }
    plan->method = wanted;
    if (wanted == PLR_METHOD_MIDPOINT) {
        plan->leaps = can_leap(view, cast, early_end);
        return;
    }
    if (wanted == PLR_METHOD_CELLS && are_styled(view, cast)) {
        plan->method = PLR_METHOD_PREINTEGRATED;
        plan->why = "styles change what transfer functions make visible: they look at one place of "
                    "each segment, so no bound is known";
    }
    cast->dense = !desc->no_leaping && are_full(view, cast);
    cast->short_leaps =
        !desc->no_leaping && !cast->dense && are_all_short(view, cast, plan->method);
    plan->leaps = !desc->no_leaping && !cast->dense && !cast->short_leaps;
    if (plan->method != PLR_METHOD_CELLS)
        return;
    double error = plan->asked > 0 ? plan->asked : USUAL_ERROR;
    plan->value = fmax(error, LEAST_ERROR);
    bool tame = are_tame(view, cast);
    plan->bounded = early_end && tame;
    plan->step = sqrt(3);
    cast->allowed = 0.75 * plan->value;
    plan->why =
        !tame
            ? "a transfer function is steeper than 32-bit values can tell, or has more texels than "
              "its table, or such beyond 0 and 1: rays are cut as if the bound held, but the error "
              "is "
              "estimated"
        : early_end
            ? "in each cell of voxels the value is a cubic along the ray; it is cut until what "
              "extinction and colour can differ from their integrals keeps the error"
            : "an effect of an author decides how colours accumulate: the error is estimated";
}

void plr_cast_plan(plr_view *view, plr_cast *cast, bool early_end) {
    choose(view, cast, early_end);
    bool exact = cast->plan.leaps || cast->dense || cast->short_leaps;
    for (size_t i = 0; !exact && i < cast->count; i++)
        see(&view->volumes.volumes[cast->members[i]], 0, 1);
}
