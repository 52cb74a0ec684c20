/* The volumes of a scene: which are cast together, and the programs that do it. */
#include "engine/volume_pass.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/dialect.h"
#include "engine/general.h"
#include "engine/pilot.h"
#include "engine/volume_plan.h"

/* ---- Which volumes there are ---- */

static void check_projection(const plr_node *style, plr_diags *diags) {
    static const char *const types[] = {"MAX", "MIN", "AVERAGE"};
    const char *type = plr_node_string(style, "type");
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcmp(type, types[i]) == 0)
            return;
    plr_diags_add_as(diags, PLR_WARNING, PLR_CODE_BAD_VALUE, plr_node_field(style, "type")->place,
                     "'%s' is no type of projection; MAX is taken", type);
}

static void find_kind(plr_view *view, plr_volume_state *state, plr_diags *diags) {
    const plr_node *style = plr_node_child(state->node, "renderStyle");
    if (plr_node_is(state->node, "VolumeData") && style &&
        plr_node_is(style, "ProjectionVolumeStyle")) {
        state->kind = PLR_VOLUME_PROJECTED;
        check_projection(style, diags);
    } else {
        plr_volume_find_surfaces(view, state, diags);
    }
}

/* Keeps the volumes that have data and an enabled style. */
void plr_volume_pass_find(plr_view *view, plr_diags *diags) {
    plr_volume_pass *pass = &view->volumes;
    size_t leaf_count = view->flat.volumes.count;
    pass->volumes = PLR_NEW_ARRAY(&view->arena, leaf_count + 1, plr_volume_state);
    pass->leaves = PLR_NEW_ARRAY(&view->arena, leaf_count + 1, const plr_leaf *);
    for (size_t i = 0; i < leaf_count; i++) {
        const plr_leaf *leaf = &view->flat.volumes.items[i];
        plr_volume_state *state = &pass->volumes[pass->count];
        if (!plr_volume_load(view, leaf, state, diags))
            continue;
        state->general = view->general;
        find_kind(view, state, diags);
        state->hidden = !plr_volume_has_styles(state);
        if (!plr_general_has(view, state->hidden, state->node))
            continue;
        state->index = pass->count;
        pass->leaves[pass->count++] = leaf;
    }
    plr_volume_find_shadows(view, diags);
}

/* ---- Layers ---- */

/* What the effects of authors do to the ray as a whole, found by linking alone. */
typedef struct ray_use {
    bool accumulates; /* some author decides how: then no ray may end early */
    bool *layers;     /* by volume: an effect of its own composites */
} ray_use;

static void note_calls(plr_volume_pass *pass, const plr_program *program, size_t plug,
                       const plr_recipe *recipe, ray_use *use) {
    const plr_plug_info *info = plr_program_plug(program, plug);
    bool composite = strcmp(info->name, "volume_composite") == 0;
    bool ends = strcmp(info->name, "volume_ray_end") == 0;
    for (size_t call = 0; call < info->call_count; call++) {
        plr_place place;
        size_t effect = plr_program_plug_call(program, plug, call, &place);
        if (effect == PLR_NO_EFFECT || recipe->effects.items[effect].builtin)
            continue;
        size_t volume = recipe->bindings.items[effect].volume;
        /* what takes the place of others changes more than what it is given */
        plr_promises promises = {0};
        if (recipe->effects.items[effect].placement != PLR_REPLACE)
            promises = plr_program_promises(program, effect);
        plr_volume_note_call(pass, info->name, volume, promises);
        use->accumulates = use->accumulates || composite || ends;
        if (composite && volume != PLR_NO_EFFECT)
            use->layers[volume] = true;
    }
}

static ray_use find_ray_use(plr_view *view, plr_cast *cast) {
    ray_use use = {.layers = PLR_NEW_ARRAY(&view->arena, view->volumes.count, bool)};
    plr_program *program = plr_link_recipe(&view->composer, &cast->pass.recipe, false, NULL);
    for (size_t i = 0; i < cast->pass.recipe.effects.count; i++) {
        /* what stands at a style, or takes its place, needs that style */
        const plr_effect *effect = &cast->pass.recipe.effects.items[i];
        if (!effect->builtin && effect->target && *effect->target)
            plr_volume_note_call(&view->volumes, "", cast->pass.recipe.bindings.items[i].volume,
                                 (plr_promises){0});
    }
    for (size_t i = 0; program && i < plr_program_plug_count(program); i++)
        note_calls(&view->volumes, program, i, &cast->pass.recipe, &use);
    plr_program_destroy(&program);
    return use;
}

static void world_bounds(const plr_volume_state *state, double bounds[2][3]) {
    for (int axis = 0; axis < 3; axis++) {
        bounds[0][axis] = INFINITY;
        bounds[1][axis] = -INFINITY;
    }
    for (int corner = 0; corner < 8; corner++) {
        double point[3];
        for (int axis = 0; axis < 3; axis++)
            point[axis] = state->dimensions[axis] * ((corner >> axis & 1) - 0.5);
        plr_matrix_point(&state->to_world, point, point);
        for (int axis = 0; axis < 3; axis++) {
            bounds[0][axis] = fmin(bounds[0][axis], point[axis]);
            bounds[1][axis] = fmax(bounds[1][axis], point[axis]);
        }
    }
}

static bool overlaps_another(const plr_volume_pass *pass, size_t index) {
    double own[2][3], other[2][3];
    world_bounds(&pass->volumes[index], own);
    for (size_t i = 0; i < pass->count; i++) {
        bool apart = i == index;
        world_bounds(&pass->volumes[i], other);
        for (int axis = 0; axis < 3; axis++)
            apart = apart || own[1][axis] <= other[0][axis] || other[1][axis] <= own[0][axis];
        if (!apart)
            return true;
    }
    return false;
}

static plr_cast *add_cast(plr_view *view) {
    plr_cast *cast = &view->volumes.casts[view->volumes.cast_count++];
    cast->members = PLR_NEW_ARRAY(&view->arena, view->volumes.count, size_t);
    return cast;
}

/* Takes the volumes that are layers out of the first cast. */
static void split_layers(plr_view *view, const bool *layers, plr_diags *diags) {
    plr_volume_pass *pass = &view->volumes;
    plr_cast *together = &pass->casts[0];
    size_t kept = 0;
    for (size_t m = 0; m < together->count; m++) {
        size_t i = together->members[m];
        bool bricked = pass->volumes[i].grid->brick_sides[0] > 0;
        if (!layers[i] && !bricked) {
            together->members[kept++] = i;
            continue;
        }
        plr_cast *own = add_cast(view);
        own->members[own->count++] = i;
        if (overlaps_another(pass, i))
            plr_diags_add(
                diags, PLR_CODE_LAYERED, plr_node_place(pass->volumes[i].node),
                "%s: it is a layer of its own, not mixed with the volumes that it overlaps",
                bricked ? "this volume is cast in bricks" : "an effect of this volume composites");
    }
    together->count = kept;
    if (!kept)
        *together = pass->casts[--pass->cast_count];
}

static size_t sampler_count(plr_view *view, const plr_cast *cast) {
    plr_program *program = plr_link_recipe(&view->composer, &cast->pass.recipe, false, NULL);
    size_t count = 0;
    for (size_t i = 0; program && i < plr_program_symbol_count(program); i++) {
        const plr_symbol *symbol = plr_program_symbol(program, i);
        if (symbol->kind == PLR_UNIFORM && strstr(symbol->type, "sampler"))
            count += symbol->array ? symbol->array : 1;
    }
    plr_program_destroy(&program);
    return count;
}

/* As many volumes as there are textures too few do without leaps. */
static void drop_leaps(plr_view *view, plr_cast *cast, size_t too_many) {
    cast->plan.leaps = false;
    for (size_t i = cast->count; i-- > 0;) {
        plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        bool drop = state->leaping && too_many > 0;
        too_many -= drop;
        state->leaping = state->leaping && !drop;
        cast->plan.leaps = cast->plan.leaps || state->leaping;
    }
    plr_cast_build_recipe(view, cast, true, NULL);
}

/* Volumes whose textures do not fit into one program with the others are cast apart. */
static void split_by_textures(plr_view *view, plr_cast *cast, plr_diags *diags) {
    GLint most = 16; /* what GL 3.3 has at least */
    if (view->engine)
        view->engine->gl.GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &most);
    size_t samplers = sampler_count(view, cast);
    if (samplers > (size_t)most && cast->plan.method == PLR_METHOD_MIDPOINT && cast->plan.leaps) {
        drop_leaps(view, cast, samplers - (size_t)most);
        samplers = sampler_count(view, cast);
    }
    while (samplers > (size_t)most && cast->count > 1) {
        size_t kept = cast->count * (size_t)most / samplers;
        kept = kept < 1 ? 1 : kept < cast->count ? kept : cast->count - 1;
        plr_cast *rest = add_cast(view);
        memcpy(rest->members, cast->members + kept, (cast->count - kept) * sizeof *rest->members);
        rest->count = cast->count - kept;
        rest->plan = cast->plan;
        cast->count = kept;
        plr_diags_add(diags, PLR_CODE_LAYERED,
                      plr_node_place(view->volumes.volumes[rest->members[0]].node),
                      "%zu volumes have more textures than fit into one program: from here on they "
                      "are layers, not mixed with those before",
                      kept + rest->count);
        plr_cast_build_recipe(view, cast, true, NULL);
        samplers = sampler_count(view, cast);
    }
}

void plr_volume_pass_prepare(plr_view *view, plr_diags *diags) {
    plr_volume_pass *pass = &view->volumes;
    if (!pass->count)
        return;
    pass->casts = PLR_NEW_ARRAY(&view->arena, pass->count + 1, plr_cast);
    plr_cast *together = add_cast(view);
    for (size_t i = 0; i < pass->count; i++)
        together->members[together->count++] = i;
    plr_volume_order(view, together->members, together->count);
    plr_cast_build_recipe(view, together, true, NULL);
    ray_use use = find_ray_use(view, together);
    if (pass->count > 1)
        split_layers(view, use.layers, diags);
    for (size_t i = 0; i < pass->cast_count; i++) {
        plr_cast *cast = &pass->casts[i];
        cast->everywhere = use.accumulates;
        plr_cast_plan(view, cast, !use.accumulates);
        plr_cast_build_recipe(view, cast, !use.accumulates, NULL);
        split_by_textures(view, cast, diags);
        plr_cast_build_recipe(view, cast, !use.accumulates, diags);
        cast->pass.built =
            plr_compose_program(&view->composer, &cast->pass.recipe, "volume", &cast->pass.program);
        plr_cast_derive(view, cast);
        plr_cast_explain(view, cast, !use.accumulates);
        plr_pilot_prepare(view, cast);
    }
    plr_atlas_make(&view->textures, &view->arena, &pass->functions,
                   view->desc.dialect == PLR_DIALECT_2005);
}
