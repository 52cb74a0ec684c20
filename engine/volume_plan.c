/* How the volumes of a cast are sampled: no more than the scene and the wanted error need. */
#include "engine/volume_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/dialect.h"
#include "engine/image_internal.h"
#include "engine/volume_blocks.h"
#include "engine/volume_pass.h"
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

/* The table of a transfer function; NULL: of voxels as they are, or of the default map. */
static plr_table *make_table(plr_view *view, const plr_atlas_place *place, bool reversed) {
    static const float ramps[2][8] = {{0, 0, 0, 0, 1, 1, 1, 1}, {0, 0, 0, 1, 1, 1, 1, 0}};
    if (!place || !place->function)
        return plr_table_make(&view->textures, &view->arena, ramps[reversed], 2);
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
    if (!state->blocks || state->labels || !plr_volume_keeps_clear(state) ||
        (state->authors_act && !state->authors_colour_only) ||
        (state->general && view->general_state.no_tables))
        return false;
    style_search search = {.general = state->general, .left = MOST_LOOKS};
    const plr_node *style = styles->count ? styles->value.nodes[0] : NULL;
    search_styles(style, true, &search);
    bool bare = search.bare || (style && !search.any && !search.styled);
    const plr_atlas_place *place = NULL;
    if (!bare && !(place = plr_style_place(view, search.map, state->grid)))
        return false;
    plr_table *table = make_table(view, place, view->desc.dialect == PLR_DIALECT_2005 && place);
    if (table->walls > 1)
        return false;
    state->table = table;
    state->styled = search.styled || state->authors_act ||
                    plr_pass_fog(view, view->volumes.leaves[state->index]->scope)->node;
    state->integrals = state->table->texture;
    if (state->styled)
        state->places = plr_table_places(table, &view->textures, &view->arena);
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

static bool are_styled(const plr_view *view, const plr_cast *cast) {
    bool styled = false;
    for (size_t i = 0; i < cast->count; i++)
        styled = styled || view->volumes.volumes[cast->members[i]].styled;
    return styled;
}

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
            "of one component first of all, or there are too many together, so no bound is known";
        return;
    }
    plan->method = wanted;
    if (wanted == PLR_METHOD_MIDPOINT)
        return;
    plan->leaps = !desc->no_leaping;
    if (wanted == PLR_METHOD_CELLS && are_styled(view, cast)) {
        plan->method = PLR_METHOD_PREINTEGRATED;
        plan->why = "styles change what transfer functions make visible: they look at one place of "
                    "each segment, so no bound is known";
    }
    if (plan->method != PLR_METHOD_CELLS)
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

void plr_cast_plan(plr_view *view, plr_cast *cast, bool early_end) {
    choose(view, cast, early_end);
}
