/* What a RenderedTexture tells by its ROUTEs: the matrices of its camera, and when it is drawn.
 * They are followed to the next node alone, which is as far as uniforms of effects go. */
#include "engine/targets_draw.h"

#include <string.h>

void plr_targets_find_signals(plr_view *view) {
    for (size_t r = 0; r < plr_scene_route_count(view->scene); r++) {
        const plr_route *route = plr_scene_route(view->scene, r);
        if (!plr_node_is(route->from, "RenderedTexture"))
            continue;
        for (size_t i = 0; i < view->targets.count; i++)
            if (view->targets.items[i]->node == route->from)
                *PLR_PUSH(&view->arena, &view->targets.signals) = (plr_signal){i, r};
    }
}

/* A new value of an effect's own field is a new uniform, for which nothing has to be made anew. */
static void send(plr_view *view, const plr_route *route, const void *value) {
    const plr_field *field = plr_node_field(route->to, route->to_field);
    bool as_before = view->revision == plr_scene_revision(view->scene);
    if (!field)
        return;
    plr_node_set(view->scene, route->to, route->to_field, value, 1);
    if (as_before && field->declared)
        view->revision = plr_scene_revision(view->scene);
}

/* Fields hold rows, as those of a Viewpoint's camera matrices do. */
static void send_matrix(plr_view *view, const plr_route *route, const plr_matrix *matrix) {
    float rows[16];
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++)
            rows[4 * row + column] = (float)matrix->m[4 * column + row];
    send(view, route, rows);
}

void plr_targets_send_cameras(plr_view *view) {
    for (size_t i = 0; i < view->targets.signals.count; i++) {
        const plr_signal *signal = &view->targets.signals.items[i];
        const plr_route *route = plr_scene_route(view->scene, signal->route);
        const plr_target *target = view->targets.items[signal->target];
        plr_matrix projection, viewing;
        if (!plr_targets_camera(view, target->node, &projection, &viewing))
            continue;
        if (strcmp(route->from_field, "viewing") == 0)
            send_matrix(view, route, &viewing);
        else if (strcmp(route->from_field, "projection") == 0)
            send_matrix(view, route, &projection);
    }
}

void plr_target_send_rendering(plr_view *view, const plr_target *target, bool rendering) {
    for (size_t i = 0; i < view->targets.signals.count; i++) {
        const plr_signal *signal = &view->targets.signals.items[i];
        const plr_route *route = plr_scene_route(view->scene, signal->route);
        if (view->targets.items[signal->target] == target &&
            strcmp(route->from_field, "rendering") == 0)
            send(view, route, &rendering);
    }
}
