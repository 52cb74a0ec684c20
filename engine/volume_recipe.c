/* What a program of volumes is made of: the volumes with their styles, light, fog and planes, and
 * the effects of authors. */
#include "engine/volume_pass.h"

#include <math.h>
#include <string.h>

#include "engine/general.h"
#include "engine/pilot.h"
#include "engine/shadows.h"
#include "engine/volume_table.h"

/* ---- One volume ---- */

static bool is_segmented(const plr_cast *cast) {
    return !cast->picks &&
           (cast->plan.method == PLR_METHOD_PREINTEGRATED || cast->plan.method == PLR_METHOD_CELLS);
}

/* The units of a volume's own effect, by what it does along the ray. */
static const char *const volume_units[] = {
    [PLR_VOLUME_FILLED] = "volume/Volume volume/grid volume/steps",
    [PLR_VOLUME_SURFACES] =
        "volume/Volume volume/grid volume/levels volume/crossings volume/surfaces",
    [PLR_VOLUME_PROJECTED] = "volume/Volume volume/grid volume/projection"};

/* The same of volumes with a table. */
static const char *const segment_units[] = {
    "volume/Volume volume/grid volume/leaps volume/table volume/segments",
    "volume/Volume volume/grid volume/leaps volume/table volume/cells"};

/* Of volumes whose steps lead through blocks where nothing can be seen. */
static const char leaping_units[] = "volume/Volume volume/grid volume/leaps volume/steps";

static size_t add_volume_effect(plr_view *view, plr_recipe *recipe, const plr_volume_state *state,
                                const plr_cast *cast) {
    bool segments = is_segmented(cast), cells = cast->plan.method == PLR_METHOD_CELLS;
    /* segments read bytes so, of one volume, which may be others in general worlds */
    bool quads = segments && plr_volume_has_quads(state) &&
                 (cells || (cast->count == 1 && state->grid->bytes && !state->general));
    bool leaping = !segments && !cast->picks && cast->plan.leaps && state->leaping;
    /* general programs are told by joinReach */
    bool joins = segments && !cells && cast->count == 1 &&
                 (state->general || plr_table_joins(state->table, state->step / state->reference,
                                                    state->step / state->voxel));
    /* where they look twice, rays of light would be walked twice, too; a switch changes nothing */
    bool turns = segments && !cells && state->styled && !plr_volumes_have_shadows(view);
    const plr_define defines[] = {
        {"voxels_COMPONENTS",
         plr_arena_format(&view->arena, "%u", state->grid->voxels->components)},
        {"HAS_LABELS", state->labels ? "1" : "0"},
        {"KEEPS_CLEAR", plr_volume_keeps_clear(state) ? "1" : "0"},
        {"BRICKED", state->grid->brick_sides[0] ? "1" : "0"},
        {"HAS_WALL", segments && (state->general || state->table->walls > 0) ? "1" : "0"},
        {"HAS_GRADIENTS", segments && plr_volume_can_derive(state) ? "1" : "0"},
        {"HAS_QUADS", quads ? "1" : "0"},
        {"HAS_LEAPS", leaping ? "1" : "0"},
        {"JOINS", joins ? "1" : "0"},
        {"TURNS", turns ? "1" : "0"},
        {"GENTLE", segments && state->table->gentle ? "1" : "0"},
        {"CLIPS", segments && state->table->clips ? "1" : "0"},
        {"PROJECTS", state->kind == PLR_VOLUME_FILLED ? "0" : "1"}};
    plr_define *extra = PLR_NEW_ARRAY(&view->arena, sizeof defines / sizeof *defines, plr_define);
    memcpy(extra, defines, sizeof defines);
    const char *units = segments  ? segment_units[cells]
                        : leaping ? leaping_units
                                  : volume_units[state->kind];
    return plr_recipe_builtin(&view->kitchen, recipe, units, plr_node_type(state->node),
                              (plr_binding){.node = state->node,
                                            .to_world = state->to_world,
                                            .place = &state->to_world,
                                            .volume = state->index,
                                            .grid = state->grid},
                              0, extra, sizeof defines / sizeof *defines);
}

static void add_plane(plr_view *view, plr_recipe *recipe, plr_node *plane, const plr_matrix *place,
                      bool off, size_t volume, size_t attached) {
    static const plr_define in_volume = {"VOLUME", "1"};
    if (!plr_general_has(view, off, plane))
        return;
    plr_recipe_builtin(&view->kitchen, recipe, "fog/ClipPlane", "ClipPlane",
                       (plr_binding){.node = plane,
                                     .to_world = *place,
                                     .place = place,
                                     .volume = volume,
                                     .gated = view->general,
                                     .closed = off},
                       attached, &in_volume, 1);
}

void plr_volume_add_planes(plr_view *view, plr_recipe *recipe, size_t volume, size_t attached) {
    const plr_leaf *leaf = view->volumes.leaves[volume];
    const plr_field *own = plr_node_field(leaf->node, "clipPlanes");
    size_t before = recipe->effects.count;
    for (size_t i = 0; own && i < own->count; i++)
        if (own->value.nodes[i])
            add_plane(view, recipe, own->value.nodes[i], &leaf->to_world,
                      !plr_node_bool(own->value.nodes[i], "enabled"), volume, attached);
    bool alone = plr_node_bool(leaf->node, "ignoreClipPlanes");
    for (const plr_scope *scope = alone ? NULL : leaf->scope; scope; scope = scope->outer)
        for (size_t i = 0; i < scope->clip_planes.count; i++) {
            const plr_placed *plane = &scope->clip_planes.items[i];
            add_plane(view, recipe, plane->node, &plane->to_world, plane->off, volume, attached);
        }
    size_t count = recipe->effects.count - before;
    for (size_t i = plr_general_spares(view, PLR_SLOT_PLANE, count); i > 0; i--)
        add_plane(view, recipe, NULL, &leaf->to_world, true, volume, attached);
}

static void add_fog(plr_view *view, plr_recipe *recipe, const plr_leaf *leaf, size_t volume,
                    size_t attached) {
    static const plr_define defines[] = {
        {"HAS_FOG_COORD", "0"}, {"COMPLETE", "0"}, {"VOLUME", "1"}};
    const plr_placed *fog = plr_pass_fog(view, leaf->scope);
    if (fog->node)
        plr_recipe_builtin(&view->kitchen, recipe, "fog/Fog", plr_node_type(fog->node),
                           (plr_binding){.node = fog->node,
                                         .to_world = fog->to_world,
                                         .place = &fog->to_world,
                                         .volume = volume},
                           attached, defines, sizeof defines / sizeof *defines);
}

static void add_volume(plr_view *view, plr_recipe *recipe, size_t index, const plr_cast *cast,
                       size_t *attached, plr_diags *diags) {
    bool segments = is_segmented(cast);
    const plr_volume_state *state = &view->volumes.volumes[index];
    const plr_leaf *leaf = view->volumes.leaves[index];
    *attached = add_volume_effect(view, recipe, state, cast);
    plr_volume_add_planes(view, recipe, index, *attached);
    plr_general_hide(view, recipe, state->hidden, index, *attached);
    if (segments && !state->styled)
        return; /* a table has the styles */
    plr_volume_add_styles(view, recipe, index, *attached, leaf->scope, segments, diags);
    add_fog(view, recipe, leaf, index, *attached);
    size_t from = recipe->effects.count;
    plr_pass_lights(view, recipe, leaf->scope, *attached, index);
    plr_recipe_shadows(view, recipe, from, index, NULL);
}

/* ---- Groups ---- */

static bool scope_has(const plr_scope *scope, const plr_node *effect) {
    for (; scope; scope = scope->outer)
        for (size_t i = 0; i < scope->effects.count; i++)
            if (scope->effects.items[i] == effect)
                return true;
    return false;
}

/* The groups' effects: what is around all volumes of the cast is one effect on the whole, what is
 * around some is one on each of them. */
static void add_group_effects(plr_view *view, plr_cast *cast, const size_t *attached) {
    plr_recipe *recipe = &cast->pass.recipe;
    const plr_leaf *const *leaves = view->volumes.leaves;
    for (size_t i = 0; i < cast->count; i++)
        for (const plr_scope *scope = leaves[cast->members[i]]->scope; scope; scope = scope->outer)
            for (size_t e = 0; e < scope->effects.count; e++) {
                plr_node *effect = scope->effects.items[e];
                bool whole = true;
                for (size_t other = 0; other < cast->count; other++)
                    whole = whole && scope_has(leaves[cast->members[other]]->scope, effect);
                if (!whole)
                    plr_recipe_author(&view->kitchen, recipe, effect, attached[i],
                                      cast->members[i]);
                else if (i == 0)
                    plr_recipe_author(&view->kitchen, recipe, effect,
                                      cast->count == 1 ? attached[0] : 0,
                                      cast->count == 1 ? cast->members[0] : PLR_NO_EFFECT);
            }
}

/* ---- The whole ---- */

static bool has_kind(const plr_view *view, const plr_cast *cast, bool events) {
    for (size_t i = 0; i < cast->count; i++)
        if ((view->volumes.volumes[cast->members[i]].kind != PLR_VOLUME_FILLED) == events)
            return true;
    return false;
}

static bool writes_depth(const plr_volume_state *state) {
    return plr_node_bool(state->node, "writeDepth");
}

/* Whether there are depths to stop at: of surfaces, of the host, of volumes cast before. */
static bool has_depths(const plr_view *view) {
    bool any = view->flat.shapes.count > 0 || view->desc.host_depths;
    for (size_t i = 0; i < view->volumes.count; i++)
        any = any || writes_depth(&view->volumes.volumes[i]);
    return any;
}

static bool any_writes_depth(const plr_view *view, const plr_cast *cast) {
    for (size_t i = 0; i < cast->count; i++)
        if (writes_depth(&view->volumes.volumes[cast->members[i]]))
            return true;
    return false;
}

/* Whether some values are opaque. */
static bool has_wall(const plr_view *view, const plr_cast *cast) {
    bool any = view->general; /* whatever the functions will be */
    for (size_t i = 0; i < cast->count; i++)
        any = any || view->volumes.volumes[cast->members[i]].table->walls > 0;
    return any;
}

static void define_loop(plr_view *view, plr_cast *cast, bool early_end) {
    plr_recipe *recipe = &cast->pass.recipe;
    cast->writes_depth = !cast->picks && any_writes_depth(view, cast);
    cast->divided = !cast->picks && plr_cast_is_divided(view, cast);
    bool events = has_kind(view, cast, true);
    const struct {
        const char *name;
        int value;
    } defines[] = {
        {"SEGMENTS", is_segmented(cast)},
        {"CELLS", cast->plan.method == PLR_METHOD_CELLS},
        {"LEAPS", cast->plan.leaps && !cast->picks},
        {"HAS_WALL", is_segmented(cast) && has_wall(view, cast)},
        {"MIXES", cast->count > 1 || events}, /* else the loop is that of one volume */
        {"MANY_VOLUMES", cast->count > 4},    /* rays enter and leave them every few steps */
        {"HAS_EVENTS", events},
        {"HAS_STEPS", has_kind(view, cast, false)},
        {"HAS_OPAQUE", has_depths(view)},
        {"HAS_PARTS", cast->divided},
        {"WRITES_DEPTH", cast->writes_depth},
        {"PICKS", cast->picks},
        {"EARLY_END", early_end},
        {"CASTLE_GLSL_VERSION_UPGRADE", 1},
    };
    for (size_t i = 0; i < sizeof defines / sizeof *defines; i++)
        plr_recipe_define(&view->kitchen, recipe, defines[i].name, defines[i].value);
}

/* Transfer functions of authors may have physical keys, too: they know the volume's voxels. */
static void add_authors(plr_view *view, plr_recipe *recipe, size_t index, size_t attached) {
    const plr_volume_pass *pass = &view->volumes;
    size_t first = recipe->bindings.count;
    plr_recipe_author_list(&view->kitchen, recipe, pass->leaves[index]->node, attached, index);
    for (size_t i = first; i < recipe->bindings.count; i++)
        recipe->bindings.items[i].grid = pass->volumes[index].grid;
}

void plr_cast_build_recipe(plr_view *view, plr_cast *cast, bool early_end, plr_diags *diags) {
    plr_recipe *recipe = &cast->pass.recipe;
    plr_kitchen *k = &view->kitchen;
    *recipe = (plr_recipe){.base = *plr_catalog_units(k->catalog, "volume/raycaster"),
                           .casts_rays = true};
    define_loop(view, cast, early_end);
    size_t *attached = PLR_NEW_ARRAY(&view->arena, cast->count, size_t);
    for (size_t i = 0; i < cast->count; i++)
        add_volume(view, recipe, cast->members[i], cast, &attached[i], diags);
    bool skips_clear = true;
    for (size_t i = 0; i < cast->count; i++)
        skips_clear = skips_clear && plr_volume_skips_clear(view, cast->members[i]);
    plr_recipe_volume_shadows(view, recipe, skips_clear);
    plr_recipe_builtin(k, recipe, "volume/Composite", "Composite",
                       (plr_binding){.volume = PLR_NO_EFFECT}, 0, NULL, 0);
    plr_recipe_attached_authors(&view->kitchen, recipe, "X3DLightNode");
    for (size_t i = 0; i < cast->count; i++)
        add_authors(view, recipe, cast->members[i], attached[i]);
    add_group_effects(view, cast, attached);
    plr_cast_find_slabs(view, cast, early_end, diags);
    double cut[2];
    plr_viewpoint_cut(view->viewpoint, cut);
    bool slabs = cast->slabs > 1 || (plr_pilot_serves(view, cast) &&
                                     plr_cast_has_slabs(view, cast, plr_pilot_shortest(cast)));
    plr_recipe_define(k, recipe, "HAS_CUT", slabs || cut[0] > 0 || isfinite(cut[1]));
    plr_recipe_define(k, recipe, "SKIPS",
                      !is_segmented(cast) && plr_cast_skips(view, cast, early_end));
}
