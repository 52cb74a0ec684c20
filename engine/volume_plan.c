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
    plr_table *table = plr_table_make(&view->textures, &view->arena, texels,
                                      image->width > 1 ? image->width : 2);
    free(texels);
    return table;
}

/* Distances between blocks where something can be seen. */
static plr_texture *make_leaps(plr_view *view, const plr_volume_state *state) {
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
    for (size_t i = 0; i < count; i++)
        full[i] = plr_table_sees(state->table, (double)blocks->range[i][0],
                                 (double)blocks->range[i][1]);
    plr_blocks_distances(blocks, full, image.samples);
    free(full);
    return plr_textures_make(&view->textures, &image, PLR_TEXTURE_3D_LABELS, false);
}

/* Makes the table of a volume that has one. */
static bool find_table(plr_view *view, plr_volume_state *state) {
    const plr_field *styles = plr_node_field(state->node, "renderStyle");
    map_search search = {.general = state->general, .left = MOST_LOOKS};
    if (state->kind != PLR_VOLUME_FILLED || styles->type != PLR_SFNODE || !state->blocks ||
        state->authors_see_all || state->labels ||
        !find_map(styles->count ? styles->value.nodes[0] : NULL, true, &search))
        return false;
    const plr_atlas_place *place = plr_style_place(view, search.map, state->grid);
    if (!place)
        return false;
    state->table = make_table(view, place);
    state->integrals = state->table->texture;
    plr_table_seen(state->table, state->seen);
    state->leaps = make_leaps(view, state);
    return true;
}

/* ---- Plans ---- */

void plr_cast_plan(plr_view *view, plr_cast *cast, bool early_end) {
    const plr_view_desc *desc = &view->desc;
    cast->plan = (plr_plan){.asked = desc->step > 0 ? 0 : desc->error > 0 ? desc->error : 1.0 / 255,
                            .value = -1,
                            .method = PLR_METHOD_MIDPOINT,
                            .step = desc->step > 0 ? desc->step : 0.5,
                            .why = ""};
    if (desc->method == PLR_METHOD_AUTO || desc->method == PLR_METHOD_MIDPOINT || !view->engine)
        return;
    bool tabled = true;
    for (size_t i = 0; i < cast->count; i++) {
        plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        tabled = (state->table || find_table(view, state)) && tabled;
    }
    (void)early_end;
    if (!tabled) {
        cast->plan.why = "some volume is made visible by more than one transfer function";
        return;
    }
    cast->plan.method = desc->method;
    cast->plan.leaps = !desc->no_leaping;
}
