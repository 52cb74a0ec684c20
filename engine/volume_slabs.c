/* Renderers end loops that take too many turns, in silence. Where rays through volumes could, they
 * are cast in slabs along the view, the farthest first. */
#include "engine/volume_pass.h"

#include <math.h>
#include <string.h>

enum {
    /* Of all loops of a pixel together: llvmpipe stops them after 65535 turns (Mesa,
     * lp_bld_limits.h: LP_MAX_TGSI_LOOP_ITERATIONS). */
    TURNS_OF_LLVMPIPE = 60000,
    TURNS = 1000000, /* of others: step_count in library/volume.glsl takes no more steps */
    MOST_SLABS = 1024,
    STEP_TURNS = 3,   /* a look ahead, the sample, and those that are there for many steps */
    SHADOW_TURNS = 8, /* of a ray to a light, beyond one for each two steps */
    CROSSINGS = 16,   /* of a ray with surfaces, as many as are expected */
};

static double most_turns(const plr_view *view) {
    const char *renderer = (const char *)view->engine->gl.GetString(GL_RENDERER);
    return renderer && strstr(renderer, "llvmpipe") ? TURNS_OF_LLVMPIPE : TURNS;
}

/* Of the longest ray in the box. */
static double steps_in(const plr_volume_state *state, double length) {
    double squared = 0;
    for (int axis = 0; axis < 3; axis++)
        squared += state->dimensions[axis] * state->dimensions[axis];
    return sqrt(squared) / (state->step * length);
}

/* Of the longest ray from surface to surface: from cell to cell, or, where an effect changes
 * values, in steps. */
static double cells_in(const plr_volume_state *state) {
    double cells = CROSSINGS;
    for (int axis = 0; axis < 3; axis++)
        cells += state->grid->size[axis];
    return cells;
}

static double turns_to_light(const plr_volume_state *state, double length) {
    double turns = steps_in(state, length) / 2 + SHADOW_TURNS;
    return state->kind == PLR_VOLUME_SURFACES ? fmax(turns, cells_in(state)) : turns;
}

/* Each step asks all volumes of the cast that are there, those of volumes in one place together:
 * the larger of what comes out if all are in one place and if none are. Of a surface only crossings
 * are lit. `length`: steps become so many times as long. */
static double turns(const plr_view *view, const plr_cast *cast, double length) {
    const plr_recipe *recipe = &cast->pass.recipe;
    double whole = 0, longest = 0, lit = 0, light = 0;
    for (size_t i = 0; i < cast->count; i++) {
        const plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        double steps = steps_in(state, length);
        if (state->kind == PLR_VOLUME_SURFACES)
            steps = fmax(steps, cells_in(state));
        whole += steps;
        longest = fmax(longest, steps);
        lit += state->kind == PLR_VOLUME_SURFACES ? CROSSINGS : steps;
    }
    for (size_t i = 0; i < recipe->effects.count; i++) {
        const char *name = recipe->effects.items[i].name;
        size_t volume = recipe->bindings.items[i].volume;
        if (name && strcmp(name, "ShadowRay") == 0 && volume < view->volumes.count)
            light += turns_to_light(&view->volumes.volumes[volume], length);
    }
    double together = longest * ((double)cast->count * (STEP_TURNS - 1) + 1);
    return fmax(whole * STEP_TURNS, together) + lit * light;
}

static bool can_divide(const plr_view *view, const plr_cast *cast) {
    bool fine = cast->early_end && !cast->writes_depth;
    for (size_t i = 0; i < cast->count; i++)
        fine = fine && view->volumes.volumes[cast->members[i]].kind != PLR_VOLUME_PROJECTED;
    return fine;
}

static bool is_whole(const plr_view *view, const plr_cast *cast) {
    return !view->engine || cast->picks ||
           view->volumes.volumes[cast->members[0]].grid->brick_sides[0];
}

/* Should steps become so many times as long. */
static double slabs_wanted(const plr_view *view, const plr_cast *cast, double length) {
    return is_whole(view, cast) ? 1 : turns(view, cast, length) / most_turns(view);
}

static double most_slabs(const plr_view *view, const plr_cast *cast) {
    return can_divide(view, cast) ? MOST_SLABS : 1;
}

bool plr_cast_fit_slabs(const plr_view *view, plr_cast *cast) {
    double wanted = slabs_wanted(view, cast, 1);
    if (wanted > most_slabs(view, cast))
        return false;
    cast->slabs = (unsigned)fmax(ceil(wanted), 1);
    return true;
}

bool plr_cast_has_slabs(const plr_view *view, const plr_cast *cast, double length) {
    return slabs_wanted(view, cast, length) > 1 && most_slabs(view, cast) > 1;
}

void plr_cast_find_slabs(plr_view *view, plr_cast *cast, bool early_end, plr_diags *diags) {
    cast->slabs = 1;
    plr_volume_state *first = &view->volumes.volumes[cast->members[0]];
    cast->early_end = early_end;
    if (plr_cast_fit_slabs(view, cast))
        return;
    double wanted = slabs_wanted(view, cast, 1), most = most_slabs(view, cast);
    cast->slabs = (unsigned)most;
    if (!diags)
        return;
    /* with rays to lights the turns grow with the square of the steps */
    double factor = wanted / most;
    for (size_t i = 0; i < cast->count; i++)
        view->volumes.volumes[cast->members[i]].step *= factor;
    cast->plan.step *= factor;
    plr_diags_add_as(diags, PLR_WARNING, PLR_CODE_LIMIT, plr_node_place(first->node),
                     "rays take more steps than the renderer can: steps are %.3g times as long",
                     factor);
}

void plr_cast_slab(const plr_cast *cast, unsigned slab, double cut[2]) {
    double thick = (cast->farthest - cast->nearest) / cast->slabs;
    if (slab > 0)
        cut[0] = fmax(cut[0], cast->nearest + slab * thick);
    if (slab + 1 < cast->slabs)
        cut[1] = fmin(cut[1], cast->nearest + (slab + 1) * thick);
}
