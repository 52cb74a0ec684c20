#include "engine/targets.h"

#include <string.h>

#include "engine/targets_draw.h"

/* So many at most, whatever a scene asks for. */
enum {
    MOST_TARGETS = 256
};

/* ---- Making targets ---- */

static plr_target *push_target(plr_view *view, plr_texture *texture) {
    plr_target *target = PLR_NEW(&view->arena, plr_target);
    target->texture = texture;
    target->node = (plr_node *)texture->node;
    target->clear = true;
    *PLR_PUSH(&view->arena, &view->targets) = target;
    return target;
}

/* What `scene` holds, or all of the scene once more in another fog: fog is part of programs. */
static plr_world *new_world(plr_view *view, const plr_node *texture, plr_diags *diags) {
    plr_node *scene = plr_node_child(texture, "scene"), *fog = plr_node_child(texture, "fog");
    const plr_flat *flat = &view->flat;
    if (!scene && !fog)
        return NULL;
    plr_world *world = PLR_NEW(&view->arena, plr_world);
    if (scene)
        plr_flatten_node(&view->arena, view->scene, scene, flat, &world->flat, diags);
    else
        plr_flatten(&view->arena, view->scene, flat->has_eye ? &flat->eye_to_world : NULL,
                    &world->flat, NULL);
    if (fog)
        world->flat.fog = (plr_placed){.node = fog, .to_world = plr_matrix_identity()};
    world->viewpoint = view->viewpoint;
    return world;
}

/* A viewpoint that stands in the scene, or nowhere but in the texture. */
static const plr_viewpoint *find_viewpoint(plr_view *view, const plr_world *world, plr_node *node,
                                           plr_diags *diags) {
    const plr_flat *flats[] = {&view->flat, world ? &world->flat : &view->flat};
    for (int f = 0; f < 2; f++)
        for (size_t i = 0; i < flats[f]->viewpoints.count; i++)
            if (flats[f]->viewpoints.items[i].node == node)
                return &flats[f]->viewpoints.items[i];
    plr_flat *alone = PLR_NEW(&view->arena, plr_flat);
    plr_flatten_node(&view->arena, view->scene, node, &(plr_flat){0}, alone, diags);
    if (alone->viewpoints.count)
        return &alone->viewpoints.items[0];
    plr_diags_add(diags, PLR_CODE_NOT_DRAWN, plr_node_place(node),
                  "%s is no viewpoint to draw from; that of the picture is taken",
                  plr_node_type(node));
    return NULL;
}

static void prepare_rendered(plr_view *view, plr_target *target, plr_diags *diags) {
    plr_node *viewpoint = plr_node_child(target->node, "viewpoint");
    plr_node *background = plr_node_child(target->node, "background");
    target->own = new_world(view, target->node, diags);
    if (target->own) {
        plr_view_enter(view, target->own);
        plr_world_prepare(view, diags);
        plr_view_enter(view, target->own);
    }
    if (viewpoint)
        target->viewpoint = find_viewpoint(view, target->own, viewpoint, diags);
    if (!background)
        return;
    target->background = PLR_NEW(&view->arena, plr_background);
    plr_flat placed;
    plr_flatten_node(&view->arena, view->scene, background, &(plr_flat){0}, &placed, diags);
    *target->background = (plr_background){.node = background, .to_world = plr_matrix_identity()};
    if (background == view->flat.background)
        target->background->to_world = view->flat.background_to_world;
    plr_background_prepare(view, target->background);
}

static bool has_room(const plr_view *view, const plr_node *node, plr_diags *diags) {
    if (view->targets.count < MOST_TARGETS)
        return true;
    if (node)
        plr_diags_add(diags, PLR_CODE_LIMIT, plr_node_place(node),
                      "more than %d textures are to be drawn by the engine; this one stays black",
                      MOST_TARGETS);
    return false;
}

static bool is_known(const plr_view *view, const plr_texture *texture) {
    for (size_t i = 0; i < view->targets.count; i++)
        if (view->targets.items[i]->texture == texture)
            return true;
    return false;
}

/* "NONE" leaves a texture as it is, that is black. */
static void read_update(plr_target *target, const plr_node *node) {
    const char *update = plr_node_string(node, "update");
    target->once = strcmp(update, "NEXT_FRAME_ONLY") == 0;
    target->never = !target->once && strcmp(update, "ALWAYS") != 0;
}

void plr_targets_prepare(plr_view *view, plr_diags *diags) {
    /* what a target shows may read further textures: the list grows while it is walked */
    for (size_t i = 0; i < view->textures.list.count; i++) {
        plr_texture *texture = view->textures.list.items[i];
        if (!texture->generated || !texture->node || is_known(view, texture) ||
            !has_room(view, texture->node, diags))
            continue;
        if (plr_node_is(texture->node, "GeneratedShadowMap") &&
            plr_shadow_of_map(view, texture->node, texture))
            continue;
        plr_target *target = push_target(view, texture);
        read_update(target, texture->node);
        if (plr_node_is(target->node, "RenderedTexture"))
            prepare_rendered(view, target, diags);
        target->never = target->never || plr_node_is(target->node, "GeneratedShadowMap");
    }
    plr_casters_prepare(view); /* for maps that only authors read */
    plr_targets_find_signals(view);
    view->targets.order = PLR_NEW_ARRAY(&view->arena, view->targets.count + 1, size_t);
}

/* A map that stands for a light's default is drawn, unless its author says how it is to be updated.
 */
bool plr_targets_add_shadow(plr_view *view, plr_shadow *shadow) {
    if (is_known(view, shadow->values.texture) || !has_room(view, shadow->light, NULL))
        return is_known(view, shadow->values.texture);
    plr_target *target = push_target(view, shadow->values.texture);
    target->shadow = shadow;
    bool is_default = shadow->map == plr_node_child(shadow->light, "defaultShadowMap");
    if (shadow->map && (!is_default || plr_node_field(shadow->map, "update")->given))
        read_update(target, shadow->map);
    return true;
}

void plr_targets_find(plr_view *view) {
    for (size_t i = 0; i < view->targets.count; i++) {
        plr_target *target = view->targets.items[i];
        if (target->background)
            plr_pass_find(view, &target->background->pass);
        if (!target->own)
            continue;
        plr_view_enter(view, target->own);
        plr_world_find(view);
        plr_view_enter(view, target->own);
    }
}

void plr_targets_finish(plr_view *view) {
    if (view->entered) /* something went wrong in there */
        plr_view_enter(view, view->entered);
    for (size_t i = 0; i < view->targets.count; i++) {
        plr_target *target = view->targets.items[i];
        plr_canvas_destroy(&target->canvas);
        if (!target->own)
            continue;
        plr_view_enter(view, target->own);
        plr_world_finish(view);
        plr_view_enter(view, target->own);
    }
    view->targets.count = 0;
}

/* ---- Drawing ---- */

static void draw(plr_view *view, plr_target *target, const plr_frame *here) {
    plr_target_send_rendering(view, target, true);
    plr_target_draw(view, target, here);
    plr_target_send_rendering(view, target, false);
    target->drawn = true;
    target->revision = plr_scene_revision(view->scene);
}

/* What is drawn once is drawn again when the scene has changed: what it shows must not depend on
 * the times that were asked for before. */
bool plr_target_is_due(const plr_view *view, const plr_target *target) {
    bool as_drawn = target->drawn && target->revision == plr_scene_revision(view->scene);
    return !target->never && !(target->once && as_drawn);
}

void plr_targets_draw(plr_view *view, const plr_frame *here) {
    if (!view->targets.count)
        return;
    plr_targets_order(view, here);
    plr_targets_send_cameras(view);
    for (size_t i = 0; i < view->targets.order_count; i++)
        plr_target_clear(view, view->targets.items[view->targets.order[i]]);
    for (size_t i = 0; i < view->targets.order_count; i++) {
        plr_target *target = view->targets.items[view->targets.order[i]];
        if (plr_target_is_due(view, target))
            draw(view, target, here);
    }
}

bool plr_targets_camera(plr_view *view, const plr_node *texture, plr_matrix *projection,
                        plr_matrix *viewing) {
    for (size_t i = 0; i < view->targets.count; i++) {
        plr_target *target = view->targets.items[i];
        if (target->node != texture || target->shadow || target->texture->kind != PLR_TEXTURE_2D)
            continue;
        const double depths[2] = {0.1,
                                  1000}; /* whatever a depth buffer needs is nobody's business */
        const plr_viewpoint *viewpoint = target->viewpoint ? target->viewpoint : view->viewpoint;
        plr_viewpoint_matrices(viewpoint, target->texture->width, target->texture->height, depths,
                               projection, viewing);
        return true;
    }
    return false;
}
