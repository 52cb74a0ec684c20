/* Things that moved, and nothing else: the scene is flattened again, and where the same comes out,
 * it goes on with new places. */
#include "engine/changes.h"

#include "engine/targets.h"
#include "engine/update.h"
#include "engine/volume_geometry.h"

/* ---- Is it the same? ---- */

static bool same_lights(const plr_lights *a, const plr_lights *b) {
    if (a->count != b->count)
        return false;
    for (size_t i = 0; i < a->count; i++)
        if (a->items[i].node != b->items[i].node)
            return false;
    return true;
}

static bool same_scopes(const plr_scope *a, const plr_scope *b) {
    for (; a && b; a = a->outer, b = b->outer) {
        if (!same_lights(&a->lights, &b->lights) || a->fog.node != b->fog.node ||
            a->effects.count != b->effects.count || a->clip_planes.count != b->clip_planes.count)
            return false;
        for (size_t i = 0; i < a->effects.count; i++)
            if (a->effects.items[i] != b->effects.items[i])
                return false;
        for (size_t i = 0; i < a->clip_planes.count; i++)
            if (a->clip_planes.items[i].node != b->clip_planes.items[i].node)
                return false;
    }
    return a == b; /* both at their end */
}

static bool same_leaves(const plr_leaves *a, const plr_leaves *b) {
    if (a->count != b->count)
        return false;
    for (size_t i = 0; i < a->count; i++)
        if (a->items[i].node != b->items[i].node ||
            !same_scopes(a->items[i].scope, b->items[i].scope))
            return false;
    return true;
}

static bool same_flats(const plr_flat *a, const plr_flat *b) {
    if (a->viewpoints.count != b->viewpoints.count)
        return false;
    for (size_t i = 0; i < a->viewpoints.count; i++)
        if (a->viewpoints.items[i].node != b->viewpoints.items[i].node)
            return false;
    return same_leaves(&a->volumes, &b->volumes) && same_leaves(&a->shapes, &b->shapes) &&
           same_lights(&a->global_lights, &b->global_lights) &&
           same_lights(&a->all_lights, &b->all_lights) && a->background == b->background &&
           a->navigation == b->navigation && a->fog.node == b->fog.node &&
           a->tone_mapping == b->tone_mapping && a->projective == b->projective;
}

/* A volume is left out while its space has no extent. */
static bool has_extent(const plr_leaves *volumes) {
    static const double any_size[3] = {1, 1, 1};
    for (size_t i = 0; i < volumes->count; i++)
        if (!plr_volume_has_extent(&volumes->items[i].to_world, any_size))
            return false;
    return true;
}

/* ---- New places ---- */

static void move_lights(plr_lights *lights, const plr_lights *to) {
    for (size_t i = 0; i < lights->count; i++)
        lights->items[i].to_world = to->items[i].to_world;
}

static void move_leaves(plr_leaves *leaves, const plr_leaves *to) {
    for (size_t i = 0; i < leaves->count; i++) {
        leaves->items[i].to_world = to->items[i].to_world;
        /* scopes are the flat's own: what is made of them may not change them, it may */
        plr_scope *scope = (plr_scope *)leaves->items[i].scope;
        const plr_scope *now = to->items[i].scope;
        for (; scope; scope = (plr_scope *)scope->outer, now = now->outer) {
            move_lights(&scope->lights, &now->lights);
            scope->fog.to_world = now->fog.to_world;
            for (size_t k = 0; k < scope->clip_planes.count; k++)
                scope->clip_planes.items[k].to_world = now->clip_planes.items[k].to_world;
        }
    }
}

static void move_flat(plr_flat *flat, const plr_flat *to) {
    move_leaves(&flat->volumes, &to->volumes);
    move_leaves(&flat->shapes, &to->shapes);
    move_lights(&flat->global_lights, &to->global_lights);
    move_lights(&flat->all_lights, &to->all_lights);
    for (size_t i = 0; i < flat->viewpoints.count; i++)
        flat->viewpoints.items[i].to_world = to->viewpoints.items[i].to_world;
    flat->background_to_world = to->background_to_world;
    flat->fog.to_world = to->fog.to_world;
    flat->eye_to_world = to->eye_to_world;
}

static void move_pass(plr_pass *pass) {
    for (size_t i = 0; i < pass->recipe.bindings.count; i++) {
        plr_binding *binding = &pass->recipe.bindings.items[i];
        if (binding->place)
            binding->to_world = *binding->place;
    }
}

static void move_cast(plr_cast *cast) {
    move_pass(&cast->pass);
    if (cast->picking)
        move_pass(&cast->picking->pass);
}

static void move_parts(plr_view *view) {
    view->background.to_world = view->flat.background_to_world;
    move_pass(&view->background.pass);
    for (size_t i = 0; i < view->surface_count; i++)
        view->surfaces[i].to_world = view->flat.shapes.items[i].to_world;
    for (size_t i = 0; i < view->model_count; i++) {
        move_pass(&view->models[i]->pass);
        if (view->models[i]->caster)
            move_pass(&view->models[i]->caster->pass);
    }
    for (size_t i = 0; i < view->volumes.count; i++)
        plr_volume_move(&view->volumes.volumes[i], view->volumes.leaves[i]);
    for (size_t i = 0; i < view->volumes.cast_count; i++)
        move_cast(&view->volumes.casts[i]);
}

static bool flatten_and_move(plr_view *view, plr_arena *arena, const plr_matrix *eye_to_world) {
    plr_flat flat;
    plr_flatten(arena, view->scene, eye_to_world, &flat, NULL);
    if (!same_flats(&view->flat, &flat) || !has_extent(&view->flat.volumes) ||
        !has_extent(&flat.volumes) || view->surface_count != view->flat.shapes.count)
        return false;
    move_flat(&view->flat, &flat);
    move_parts(view);
    if (!plr_lights_stay(view))
        return false; /* some light has come near, or gone */
    for (size_t i = 0; i < view->volumes.cast_count; i++)
        if (!view->volumes.casts[i].divided && plr_cast_is_divided(view, &view->volumes.casts[i]))
            return false; /* another program */
    view->viewpoint = plr_flat_bound(&view->flat, plr_view_chosen(view, &view->flat));
    return true;
}

/* Textures that show worlds of their own, or the scene from elsewhere, hold places, too. */
static bool targets_stay(const plr_view *view) {
    for (size_t i = 0; i < view->targets.count; i++) {
        const plr_target *target = view->targets.items[i];
        if (target->own || target->background || target->viewpoint)
            return false;
    }
    return true;
}

bool plr_view_move(plr_view *view, const plr_matrix *eye_to_world) {
    jmp_buf out_of_memory;
    plr_arena arena;
    volatile bool moved = false;
    if (!targets_stay(view))
        return false;
    plr_arena_init(&arena, NULL, &out_of_memory);
    if (setjmp(out_of_memory) == 0)
        moved = flatten_and_move(view, &arena, eye_to_world);
    plr_arena_finish(&arena);
    return moved;
}
