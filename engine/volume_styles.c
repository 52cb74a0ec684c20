/* Styles of volumes as effects. What stands around styles - another volume that is blended, a
 * segment, a surface - is an effect with plugs of its own, to which these are attached. */
#include "engine/volume_pass.h"

#include <string.h>

#include "engine/dialect.h"
#include "engine/shadows.h"
#include "engine/transfer_function.h"

enum {
    MOST_STYLES = 1024, /* of one volume: DEF and USE can make a few lines into very many */
    MOST_LOOKS = 4096   /* at styles within one */
};

/* `left` bounds the looks at styles; what is not looked at any more counts as enabled. */
static bool is_any_enabled(const plr_node *node, size_t *left) {
    if (!node || !*left)
        return true;
    --*left;
    if (!plr_node_bool(node, "enabled"))
        return false;
    if (!plr_node_is(node, "ComposedVolumeStyle"))
        return true;
    const plr_field *styles = plr_node_field(node, "renderStyle");
    bool empty = true; /* then voxels stay as they are */
    for (size_t i = 0; styles && i < styles->count; i++) {
        if (styles->value.nodes[i] && is_any_enabled(styles->value.nodes[i], left))
            return true;
        empty = empty && !styles->value.nodes[i];
    }
    return empty;
}

/* Whether anything is drawn with this style; NULL is the default style. */
static bool any_enabled(const plr_node *node) {
    size_t left = MOST_LOOKS;
    return is_any_enabled(node, &left);
}

static bool is_list(const plr_volume_state *state) {
    return plr_node_field(state->node, "renderStyle")->type == PLR_MFNODE;
}

bool plr_volume_has_styles(const plr_volume_state *state) {
    const plr_field *styles = plr_node_field(state->node, "renderStyle");
    if (!is_list(state) || (styles->count == 1 && state->kind == PLR_VOLUME_SURFACES))
        return any_enabled(styles->count ? styles->value.nodes[0] : NULL);
    return true;
}

/* Styles on their way to a recipe. */
typedef struct style_list {
    plr_view *view;
    plr_recipe *recipe;
    const plr_scope *scope; /* of the lights */
    const plr_volume_state *volume;
    size_t attached;
    const plr_grid *grid;
    bool leading; /* only opacity maps so far */
    bool tabled;  /* a table has those */
    bool off;     /* of a general program: what is added now is switched off */
    size_t *count;
    plr_diags *diags;
} style_list;

static void add_styles(style_list *list, plr_node *node);

static bool is_too_many(style_list *list, const plr_node *node) {
    if (*list->count == MOST_STYLES)
        plr_diags_add(list->diags, PLR_CODE_LIMIT, plr_node_place(node),
                      "a volume has more than %d styles; the rest is left out", MOST_STYLES);
    return (*list->count)++ >= MOST_STYLES;
}

static size_t add_effect(style_list *list, const char *path, const char *name, plr_node *node,
                         const plr_define *defines, size_t count) {
    plr_define *extra = PLR_NEW_ARRAY(&list->view->arena, count + 1, plr_define);
    if (count)
        memcpy(extra, defines, count * sizeof *extra);
    extra[count] =
        (plr_define){"voxels_COMPONENTS",
                     plr_arena_format(&list->view->arena, "%u", list->grid->voxels->components)};
    plr_binding binding = {.node = node,
                           .volume = list->volume->index,
                           .grid = list->grid,
                           .gated = list->view->general && node,
                           .closed = list->off};
    return plr_recipe_builtin(&list->view->kitchen, list->recipe, path, name, binding,
                              list->attached, extra, count + 1);
}

/* ---- One style ---- */

/* Styles that are another style with other names. */
static const struct {
    const char *type, *effect;
} same_effects[] = {{"ISOSurfaceVolumeStyle", "ShadedVolumeStyle"}};

static const char *effect_of(const char *type) {
    for (size_t i = 0; i < sizeof same_effects / sizeof *same_effects; i++)
        if (strcmp(type, same_effects[i].type) == 0)
            return same_effects[i].effect;
    return type;
}

/* A style that meets light in a way of its own has its own lights: a light knows one way only. */
static bool has_own_light(const plr_node *node, bool lighting) {
    if (plr_node_is(node, "ToneMappedVolumeStyle") || plr_node_is(node, "StippleVolumeStyle") ||
        (lighting && plr_style_has_shadows(node, true)))
        return true;
    if (!plr_node_is(node, "ShadedVolumeStyle") || !lighting)
        return false;
    const plr_node *material = plr_node_child(node, "material");
    return material && plr_node_is(material, "PhysicalMaterial");
}

static void add_lights(style_list *list, const plr_node *style, size_t attached) {
    size_t from = list->recipe->effects.count;
    plr_pass_lights(list->view, list->recipe, list->scope, attached, list->volume->index);
    if (plr_style_has_shadows(style, true))
        plr_recipe_receive(list->view, list->recipe, from);
    plr_recipe_shadows(list->view, list->recipe, from, list->volume->index, NULL);
}

/* Where a style's transfer function is among those of all volumes; NULL if it has none, or one that
 * needs a texture of its own. An opacity map without one has the default ramp. */
static const plr_atlas_place *place_function(style_list *list, const plr_node *node, bool map) {
    plr_textures *textures = list->view->kitchen.textures;
    const plr_node *given = node ? plr_node_child(node, "transferFunction") : NULL;
    plr_texture *function = plr_textures_in(textures, node, "transferFunction");
    if (function && plr_transfer_function_is_physical(given))
        function = plr_transfer_function_texture(textures, given, list->grid->range);
    if (!function && !map)
        return NULL;
    return plr_atlas_add(textures, &list->view->arena, &list->view->volumes.functions, function);
}

const plr_atlas_place *plr_style_place(plr_view *view, const plr_node *map, const plr_grid *grid) {
    style_list list = {.view = view, .grid = grid};
    return place_function(&list, map, true);
}

static void add_style_lit(style_list *list, plr_node *node, bool lighting) {
    const char *type = node ? plr_node_type(node) : "OpacityMapVolumeStyle";
    bool map = strcmp(type, "OpacityMapVolumeStyle") == 0;
    list->leading = list->leading && map;
    if (list->leading && list->tabled)
        return;
    const plr_atlas_place *function = place_function(list, node, map);
    bool dark = !list->scope, lit = node && !dark && has_own_light(node, lighting);
    plr_define defines[5] = {
        {"LEADING", list->leading ? "1" : "0"},
        {"DIALECT_2005", list->view->desc.dialect == PLR_DIALECT_2005 ? "1" : "0"},
        {"lighting", lighting && !dark ? "1" : "0"}};
    size_t count = 3;
    if (function)
        defines[count++] = (plr_define){"IN_ATLAS", "1"};
    if (node && plr_node_is(node, "ISOSurfaceVolumeStyle"))
        defines[count++] = (plr_define){"HAS_material", "0"};
    size_t done = add_effect(
        list, plr_arena_format(&list->view->arena, "volume/%s volume/style", effect_of(type)), type,
        node, defines, count);
    if (!done) {
        plr_diags_add(list->diags, PLR_CODE_NOT_DRAWN, plr_node_place(node),
                      "%s is not drawn yet; the style is skipped", type);
        return;
    }
    list->recipe->effects.items[done - 1].private_plugs = lit || dark;
    list->recipe->bindings.items[done - 1].function = function;
    if (lit)
        add_lights(list, node, done);
}

/* With and without lighting a style is not the same: a general program has both. */
static void add_style(style_list *list, plr_node *node) {
    bool lighting = node && plr_node_field(node, "lighting") && plr_node_bool(node, "lighting");
    if (!list->view->general || !list->scope || !node || !plr_node_field(node, "lighting")) {
        add_style_lit(list, node, lighting);
        return;
    }
    bool off = list->off;
    for (int lit = 0; lit < 2; lit++) {
        list->off = off || lighting != (lit == 1);
        add_style_lit(list, node, lit == 1);
    }
    list->off = off;
}

/* ---- Styles around styles ---- */

/* An effect around styles; what is added to the result stands inside. */
static style_list open_around(const style_list *list, size_t around) {
    style_list inner = *list;
    if (around)
        list->recipe->effects.items[around - 1].private_plugs = true;
    inner.attached = around;
    inner.leading = true;
    return inner;
}

/* What the draft of the component and the final standard call the same by other names: "ALPHA2" is
 * in the draft alone. `left` bounds the search. */
static bool says_alpha2(const plr_node *node, size_t *left) {
    static const char *const fields[] = {"weightFunction1", "weightFunction2"};
    for (size_t f = 0; f < 2 && plr_node_is(node, "BlendedVolumeStyle"); f++)
        if (strstr(plr_node_string(node, fields[f]), "ALPHA2"))
            return true;
    const plr_field *inner = plr_node_field(node, "renderStyle");
    for (size_t i = 0; inner && i<inner->count && * left> 0; i++, --*left)
        if (inner->value.nodes[i] && says_alpha2(inner->value.nodes[i], left))
            return true;
    return false;
}

static bool has_draft_names(const plr_view *view) {
    size_t left = MOST_STYLES;
    for (size_t i = 0; i < view->flat.volumes.count; i++)
        if (says_alpha2(view->flat.volumes.items[i].node, &left))
            return true;
    return false;
}

static void check_weight(style_list *list, const plr_node *node, const char *name) {
    static const char *const known[] = {"CONSTANT",         "ALPHA0",          "ALPHA1",
                                        "ALPHA2",           "TABLE",           "ONE_MINUS_ALPHA0",
                                        "ONE_MINUS_ALPHA1", "ONE_MINUS_ALPHA2"};
    const char *value = plr_node_string(node, name);
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(value, known[i]) == 0)
            return;
    plr_diags_add_as(list->diags, PLR_WARNING, PLR_CODE_BAD_VALUE,
                     plr_node_field(node, name)->place,
                     "'%s' is no weight function; CONSTANT is taken", value);
}

/* Another volume in the box, in its own styles. A style inside that is disabled is skipped: then
 * there is nothing to blend with, and the colour stays. */
static void add_blended(style_list *list, plr_node *node) {
    plr_node *inside = plr_node_child(node, "renderStyle");
    bool off = list->off, empty = !any_enabled(inside);
    if (empty && !list->view->general)
        return;
    list->leading = false;
    check_weight(list, node, "weightFunction1");
    check_weight(list, node, "weightFunction2");
    const plr_kept_volume *kept =
        plr_node_child(node, "voxels") ? plr_volume_keep(list->view, node, list->diags) : NULL;
    const plr_grid *around_grid = list->grid;
    if (kept) {
        plr_grid *grid = PLR_NEW(&list->view->arena, plr_grid);
        *grid = kept->grid;
        memcpy(grid->dimensions, list->grid->dimensions, sizeof grid->dimensions);
        *PLR_PUSH(&list->view->arena, &list->view->volumes.grids) = grid;
        list->grid = grid;
    }
    const plr_define defines[] = {{"HAS_OTHER", kept ? "1" : "0"},
                                  {"DRAFT_NAMES", has_draft_names(list->view) ? "1" : "0"}};
    list->off = off || empty;
    size_t around = add_effect(list, "volume/BlendedVolumeStyle volume/grid", plr_node_type(node),
                               node, defines, 2);
    list->off = off;
    style_list inner = open_around(list, around);
    list->grid = around_grid;
    if (kept)
        add_styles(&inner, inside);
}

static void add_enabled(style_list *list, plr_node *node) {
    if (node && plr_node_is(node, "ComposedVolumeStyle")) {
        const plr_field *styles = plr_node_field(node, "renderStyle");
        for (size_t i = 0; styles && i < styles->count; i++)
            if (styles->value.nodes[i])
                add_styles(list, styles->value.nodes[i]);
    } else if (node && plr_node_is(node, "BlendedVolumeStyle")) {
        add_blended(list, node);
    } else if (node && plr_node_is(node, "ProjectionVolumeStyle")) {
        if (list->volume->kind != PLR_VOLUME_PROJECTED)
            plr_diags_add_as(list->diags, PLR_WARNING, PLR_CODE_BAD_VALUE, plr_node_place(node),
                             "a projection is a style of a whole volume; here it is skipped");
    } else {
        add_style(list, node);
    }
}

static void add_styles(style_list *list, plr_node *node) {
    bool off = list->off;
    list->off = off || (node && !plr_node_bool(node, "enabled"));
    if ((!list->off || list->view->general) && !is_too_many(list, node ? node : list->volume->node))
        add_enabled(list, node);
    list->off = off;
}

/* ---- Lists of styles ---- */

enum {
    MOST_MAPS = 256 /* of one volume; the same in GLSL */
};

static bool is_segment_enabled(const plr_node *node, size_t segment) {
    const plr_field *enabled = plr_node_field(node, "segmentEnabled");
    return !enabled || segment >= enabled->count || enabled->value.bools[segment];
}

bool plr_volume_draws_segment(const plr_node *node, const plr_node *style, size_t segment) {
    return any_enabled(style) && is_segment_enabled(node, segment);
}

/* How many numbers of segments or surfaces have something of their own; the last one stands for all
 * above. */
static size_t choice_count(const style_list *list, const plr_field *styles) {
    const plr_field *enabled = plr_node_field(list->volume->node, "segmentEnabled");
    if (list->volume->kind == PLR_VOLUME_SURFACES)
        return styles->count;
    return (enabled && enabled->count > styles->count ? enabled->count : styles->count) + 1;
}

/* In a general program all choices are drawn, and one effect behind them hides those that are
 * switched off. Where they are too many the text has the switches, as in a specialised one. */
static bool has_switches(const style_list *list, const plr_field *styles) {
    return list->view->general && choice_count(list, styles) <= MOST_MAPS;
}

static void add_switches(style_list *list, const plr_field *styles) {
    const plr_node *node = list->volume->node;
    bool surfaces = list->volume->kind == PLR_VOLUME_SURFACES;
    size_t count = choice_count(list, styles);
    float(*maps)[4] = plr_arena_alloc(&list->view->arena, count * sizeof *maps);
    for (size_t i = 0; i < count; i++) {
        bool drawn = (i >= styles->count || any_enabled(styles->value.nodes[i])) &&
                     (surfaces || is_segment_enabled(node, i));
        memcpy(maps[i], (float[4]){0, 0, drawn ? 0 : -1, 0}, sizeof maps[i]);
    }
    plr_volume_state *state = &list->view->volumes.volumes[list->volume->index];
    state->maps = maps;
    state->map_count = count;
    const plr_define on_surfaces = {"OF_SURFACES", surfaces ? "1" : "0"};
    add_effect(list, "volume/SegmentSwitches", "Choice", NULL, &on_surfaces, 1);
}

/* The styles of one number; `others`: and of all above. */
static void add_choice(style_list *list, int number, bool others, plr_node *style, bool drawn) {
    const plr_define defines[] = {
        {"OF_SURFACES", list->volume->kind == PLR_VOLUME_SURFACES ? "1" : "0"},
        {"OTHERS", others ? "1" : "0"},
        {"DRAWN", drawn ? "1" : "0"}};
    size_t around = add_effect(list, "volume/Choice", "Choice", NULL, defines,
                               sizeof defines / sizeof *defines);
    list->recipe->bindings.items[around - 1].number = number;
    style_list inner = open_around(list, around);
    if (drawn)
        add_styles(&inner, style);
}

/* The last style is that of all surfaces that have none of their own. */
static void add_surface_styles(style_list *list, const plr_field *styles) {
    if (styles->count < 2) {
        add_styles(list, styles->count ? styles->value.nodes[0] : NULL);
        return;
    }
    bool switches = has_switches(list, styles);
    for (size_t i = 0; i < styles->count; i++) {
        plr_node *style = styles->value.nodes[i];
        add_choice(list, (int)i, i + 1 == styles->count, style, switches || any_enabled(style));
    }
    if (switches)
        add_switches(list, styles);
}

/* Segments whose styles are opacity maps and no more share one effect. False: they are not. */
static bool add_segment_maps(style_list *list, const plr_field *styles) {
    const plr_field *enabled = plr_node_field(list->volume->node, "segmentEnabled");
    size_t count = styles->count;
    if (enabled && enabled->count > count)
        count = enabled->count;
    if ((count == 0 && !list->view->general) || count >= MOST_MAPS)
        return false;
    float(*maps)[4] = plr_arena_alloc(&list->view->arena, (count + 1) * sizeof *maps);
    for (size_t i = 0; i <= count; i++) {
        plr_node *style = i < styles->count ? styles->value.nodes[i] : NULL;
        if (style && !plr_node_is(style, "OpacityMapVolumeStyle"))
            return false;
        const plr_atlas_place *place = place_function(list, style, true);
        if (!place)
            return false;
        memcpy(maps[i], place->rect, sizeof maps[i]);
        if (!plr_volume_draws_segment(list->volume->node, style, i))
            maps[i][2] = -1;
    }
    plr_volume_state *state = &list->view->volumes.volumes[list->volume->index];
    state->maps = maps;
    state->map_count = count + 1;
    add_effect(list, "volume/SegmentMaps", "OpacityMapVolumeStyle", NULL, NULL, 0);
    return true;
}

/* Segments without a style of their own have the default one. */
static void add_segment_styles(style_list *list, const plr_field *styles) {
    const plr_node *node = list->volume->node;
    const plr_field *enabled = plr_node_field(node, "segmentEnabled");
    bool switches = has_switches(list, styles);
    for (size_t i = 0; i < styles->count; i++) {
        plr_node *style = styles->value.nodes[i];
        add_choice(list, (int)i, false, style,
                   switches || (any_enabled(style) && is_segment_enabled(node, i)));
    }
    if (styles->count)
        add_choice(list, (int)styles->count, true, NULL, true);
    else
        add_styles(list, NULL);
    for (size_t i = styles->count; enabled && i < enabled->count && !switches; i++)
        if (!enabled->value.bools[i])
            add_choice(list, (int)i, false, NULL, false);
    if (switches)
        add_switches(list, styles);
}

static void add_all_segments(style_list *list, const plr_field *styles) {
    if (!add_segment_maps(list, styles))
        add_segment_styles(list, styles);
}

void plr_volume_add_styles(plr_view *view, plr_recipe *recipe, size_t volume, size_t attached,
                           const plr_scope *lights, bool tabled, plr_diags *diags) {
    const plr_volume_state *state = &view->volumes.volumes[volume];
    const plr_field *styles = plr_node_field(state->node, "renderStyle");
    size_t count = 0;
    style_list list = {.view = view,
                       .recipe = recipe,
                       .scope = lights,
                       .volume = state,
                       .attached = attached,
                       .grid = state->grid,
                       .leading = true,
                       .tabled = tabled,
                       .count = &count,
                       .diags = diags};
    if (!is_list(state))
        add_styles(&list, styles->count ? styles->value.nodes[0] : NULL);
    else if (state->kind == PLR_VOLUME_SURFACES)
        add_surface_styles(&list, styles);
    else
        add_all_segments(&list, styles);
}
