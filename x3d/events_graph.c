/* Which nodes take part in events, the ROUTEs between them, and where sensors are. */
#include "x3d/events.h"

#include <string.h>

#include "x3d/transforms.h"

/* ---- Nodes and fields ---- */

static const x3d_behaviour *find_behaviour(const plr_node_info *info) {
    static const x3d_behaviour *const tables[] = {
        x3d_clock_behaviours,  x3d_logic_behaviours,  x3d_interpolator_behaviours,
        x3d_spline_behaviours, x3d_sensor_behaviours, x3d_bindable_behaviours,
        x3d_dialect_behaviours};
    for (size_t t = 0; t < sizeof tables / sizeof *tables; t++)
        for (const x3d_behaviour *row = tables[t]; row->type; row++)
            if (plr_node_info_is(info, row->type))
                return row;
    return NULL;
}

static const x3d_type *known_type(const plr_node *node) {
    x3d_type *type = node->type;
    if (!type->behaviour_known) {
        type->behaviour = find_behaviour(type->info);
        type->transforms = x3d_transforms(node);
    }
    type->behaviour_known = true;
    return type;
}

static const x3d_behaviour *behaviour_of(const plr_node *node) {
    return known_type(node)->behaviour;
}

x3d_event_node *x3d_event_node_of(x3d_events *ev, plr_node *node) {
    if (node->events)
        return node->events;
    plr_arena *arena = &ev->scene->arena;
    x3d_event_node *made = PLR_NEW(arena, x3d_event_node);
    made->node = node;
    made->behaviour = behaviour_of(node);
    made->fields = PLR_NEW_ARRAY(arena, node->field_count + 1, x3d_event_field *);
    node->events = made;
    *PLR_PUSH(arena, &ev->nodes) = made;
    const x3d_behaviour *behaviour = made->behaviour;
    if (behaviour && behaviour->step)
        *PLR_PUSH(arena, behaviour->is_clock ? &ev->clocks : &ev->steppers) = made;
    if (behaviour && behaviour->start)
        *PLR_PUSH(arena, &ev->starters) = made;
    return made;
}

x3d_event_field *x3d_event_field_at(x3d_events *ev, x3d_event_node *node, size_t index) {
    if (!node->fields[index]) {
        node->fields[index] = PLR_NEW(&ev->scene->arena, x3d_event_field);
        node->fields[index]->owner = node;
        node->fields[index]->index = (uint32_t)index;
    }
    return node->fields[index];
}

/* ---- The walk over all nodes ---- */

typedef struct walk_step {
    plr_node *node;
    uint32_t place;
} walk_step;

typedef struct walk {
    x3d_events *events;
    struct {
        walk_step *items;
        size_t count, capacity;
    } stack;
    bool *seen;       /* by number */
    uint32_t *places; /* by number: of the space inside the node; for TransformSensor */
} walk;

static void push_children(walk *w, const plr_node *node, uint32_t place) {
    size_t bottom = w->stack.count;
    for (size_t f = 0; f < node->field_count; f++) {
        const plr_field *field = &node->fields[f];
        if (plr_type_kind(field->type) != PLR_NODE || strcmp(field->name, "metadata") == 0)
            continue;
        for (size_t i = 0; i < field->count; i++)
            if (field->value.nodes[i] && !w->seen[field->value.nodes[i]->id])
                *PLR_PUSH(&w->events->scene->arena, &w->stack) =
                    (walk_step){field->value.nodes[i], place};
    }
    for (size_t i = bottom, k = w->stack.count; i + 1 < k; i++) { /* the first comes off first */
        walk_step swap = w->stack.items[i];
        w->stack.items[i] = w->stack.items[--k];
        w->stack.items[k] = swap;
    }
}

static void visit(walk *w, walk_step at) {
    x3d_events *ev = w->events;
    plr_node *node = at.node;
    if (w->seen[node->id])
        return;
    w->seen[node->id] = true;
    uint32_t inside = at.place;
    if (known_type(node)->transforms) {
        inside = (uint32_t)ev->places.count;
        *PLR_PUSH(&ev->scene->arena, &ev->places) =
            (x3d_event_place){.node = node, .outer = at.place};
    }
    w->places[node->id] = inside;
    if (behaviour_of(node))
        x3d_event_node_of(ev, node)->place = at.place;
    push_children(w, node, inside);
}

static void walk_from(walk *w, plr_node *node) {
    *PLR_PUSH(&w->events->scene->arena, &w->stack) = (walk_step){node, 0};
    while (w->stack.count)
        visit(w, w->stack.items[--w->stack.count]);
}

/* Nodes of a prototype's body besides the first are in no other node, but ROUTEs reach them. */
static void walk_all(x3d_events *ev, walk *w) {
    plr_scene *scene = ev->scene;
    w->seen = PLR_NEW_ARRAY(&scene->arena, scene->node_count + 1, bool);
    w->places = PLR_NEW_ARRAY(&scene->arena, scene->node_count + 1, uint32_t);
    *PLR_PUSH(&scene->arena, &ev->places) = (x3d_event_place){.to_world = plr_matrix_identity()};
    for (size_t i = 0; i < scene->nodes.count; i++)
        walk_from(w, scene->nodes.items[i]);
    for (size_t i = 0; i < scene->routes.count; i++) {
        walk_from(w, scene->routes.items[i].from);
        walk_from(w, scene->routes.items[i].to);
    }
}

/* ---- ROUTEs ---- */

/* Two passes: how many leave each field, then each at its place. */
static void build_routes(x3d_events *ev) {
    const x3d_route_list *list = &ev->scene->routes;
    ev->routes.items = PLR_NEW_ARRAY(&ev->scene->arena, list->count + 1, x3d_event_route);
    ev->routes.count = list->count;
    for (size_t i = 0; i < list->count; i++) {
        const plr_route *route = &list->items[i];
        x3d_event_node *from = x3d_event_node_of(ev, route->from);
        x3d_event_field_at(ev, from, route->from_index)->route_count++;
        x3d_event_field_at(ev, x3d_event_node_of(ev, route->to), route->to_index);
    }
    size_t next = 0;
    for (size_t i = 0; i < list->count; i++) {
        const plr_route *route = &list->items[i];
        x3d_event_field *from = route->from->events->fields[route->from_index];
        if (!from->listed) {
            from->first_route = next;
            from->listed = true; /* for the time of building: its place is known */
            next += from->route_count;
            from->route_count = 0;
        }
        ev->routes.items[from->first_route + from->route_count++] =
            (x3d_event_route){from, route->to->events->fields[route->to_index], 0};
    }
    for (size_t i = 0; i < ev->routes.count; i++)
        ev->routes.items[i].from->listed = false;
}

/* Outputs that tell of a change: to know them one has to have been there. */
static bool tells_of_change(const char *field) {
    static const char *const names[] = {"isActive", "isPaused", "cycleTime", "enterTime",
                                        "exitTime", "bindTime", "isBound",   "lowResActive"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(field, names[i]) == 0)
            return true;
    return false;
}

static bool has_history(const x3d_events *ev) {
    for (size_t i = 0; i < ev->scene->routes.count; i++) {
        const plr_route *route = &ev->scene->routes.items[i];
        const x3d_behaviour *to = route->to->events->behaviour;
        if ((to && to->remembers && to->remembers(route->to_field)) ||
            (route->from->events->behaviour && tells_of_change(route->from_field)))
            return true;
    }
    for (size_t i = 0; i < ev->clocks.count; i++) /* a pause is remembered */
        if (plr_node_number(ev->clocks.items[i]->node, "pauseTime") != 0)
            return true;
    return false;
}

/* ---- Places ---- */

static void find_targets(x3d_events *ev, const walk *w) {
    for (size_t i = 0; i < ev->steppers.count; i++) {
        x3d_event_node *node = ev->steppers.items[i];
        const plr_node *target = plr_node_child(node->node, "targetObject");
        if (target)
            node->target_place = w->places[target->id];
        ev->places.items[node->place].needed = true;
        ev->places.items[node->target_place].needed = true;
    }
    for (size_t i = ev->places.count; i-- > 1;)
        if (ev->places.items[i].needed)
            ev->places.items[ev->places.items[i].outer].needed = true;
}

void x3d_event_places_update(x3d_events *ev) {
    for (size_t i = 1; i < ev->places.count; i++) {
        x3d_event_place *place = &ev->places.items[i];
        if (!place->needed)
            continue;
        plr_matrix own;
        plr_node_transform(place->node, own.m);
        place->to_world = plr_matrix_multiply(&ev->places.items[place->outer].to_world, &own);
    }
}

/* ---- All together ---- */

/* How many steps one call may take. */
static double most_steps(const x3d_events *ev) {
    enum {
        MOST_STEPS = 65536,
        LEAST_STEPS = 64
    };
    double work = 1 + (double)ev->routes.count + (double)ev->clocks.count +
                  (double)ev->steppers.count + (double)ev->places.count;
    for (size_t i = 0; i < ev->nodes.count; i++) {
        const plr_field *values = plr_node_field(ev->nodes.items[i]->node, "keyValue");
        const plr_field *keys = plr_node_field(ev->nodes.items[i]->node, "key");
        if (values && keys && keys->count)
            work += (double)values->count / (double)keys->count;
    }
    double steps = X3D_MOST_WORK / work;
    return steps > MOST_STEPS ? MOST_STEPS : steps < LEAST_STEPS ? LEAST_STEPS : steps;
}

static void find_origin(x3d_events *ev) {
    for (size_t i = 0; i < ev->nodes.count; i++)
        if (plr_node_bool(ev->nodes.items[i]->node, "timeOriginAtLoad"))
            ev->origin_at_load = true;
}

x3d_events *x3d_events_build(plr_scene *scene) {
    x3d_events *ev = PLR_NEW(&scene->arena, x3d_events);
    ev->scene = scene;
    walk w = {.events = ev};
    walk_all(ev, &w);
    build_routes(ev);
    find_targets(ev, &w);
    find_origin(ev);
    ev->has_history = has_history(ev);
    ev->most_steps = most_steps(ev);
    return ev;
}
