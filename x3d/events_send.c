/* Events on their way: values, ROUTEs, and the fields that they leave behind. */
#include "x3d/events.h"

#include <string.h>

/* ---- Values ---- */

static size_t element_size(plr_type type) {
    static const size_t sizes[] = {sizeof(bool),   sizeof(int32_t),    sizeof(float),
                                   sizeof(double), sizeof(plr_string), sizeof(plr_node *)};
    return sizes[plr_type_kind(type)] * (size_t)plr_type_components(type);
}

static void keep(plr_arena *arena, x3d_event_value *value, const void *from, size_t count,
                 size_t size) {
    if (value->room < count * size) {
        size_t room = 2 * value->room > count * size ? 2 * value->room : count * size;
        value->memory = plr_arena_alloc(arena, room);
        value->room = room;
    }
    if (count && value->memory != from)
        memmove(value->memory, from, count * size);
    value->count = count;
}

static void set_value(x3d_events *ev, x3d_event_field *field, const void *from, size_t count) {
    plr_field *target = &field->owner->node->fields[field->index];
    if (!field->changed)
        field->original = *target;
    field->changed = true;
    if (!field->listed) {
        field->listed = true;
        field->next_listed = ev->listed;
        ev->listed = field;
    }
    keep(&ev->scene->arena, &field->current, from, count, element_size(target->type));
    target->value.any = field->current.memory;
    target->count = count;
    target->given = true;
}

void *x3d_events_scratch(x3d_events *ev, size_t size) {
    if (ev->scratch_room < size) {
        ev->scratch = plr_arena_alloc(&ev->scene->arena, 2 * size);
        ev->scratch_room = 2 * size;
    }
    return ev->scratch;
}

/* ---- Sending ---- */

static void enqueue(x3d_events *ev, x3d_event_field *field, bool received) {
    *PLR_PUSH(&ev->scene->arena, &ev->queue) = (struct x3d_event_item){field, received};
}

static size_t find_field(const plr_node *node, const char *name) {
    for (size_t i = 0; i < node->field_count; i++)
        if (strcmp(node->fields[i].name, name) == 0)
            return i;
    return SIZE_MAX;
}

void x3d_send(x3d_events *ev, x3d_event_node *node, const char *name, const void *values,
              size_t count) {
    size_t index = find_field(node->node, name);
    if (index == SIZE_MAX)
        return;
    x3d_event_field *field = x3d_event_field_at(ev, node, index);
    set_value(ev, field, values, count);
    enqueue(ev, field, false);
}

void x3d_send_bool(x3d_events *ev, x3d_event_node *node, const char *field, bool value) {
    x3d_send(ev, node, field, &value, 1);
}

void x3d_send_time(x3d_events *ev, x3d_event_node *node, const char *field, double value) {
    x3d_send(ev, node, field, &value, 1);
}

/* Nodes do not travel: a scene that hangs its parts into each other while it is drawn would have to
 * be read anew. */
static void deliver(x3d_events *ev, const x3d_event_route *route) {
    const plr_field *value = &route->from->owner->node->fields[route->from->index];
    x3d_event_node *to = route->to->owner;
    const x3d_behaviour *behaviour = to->behaviour;
    if (plr_type_kind(value->type) == PLR_NODE)
        return;
    if (behaviour && behaviour->accepts &&
        !behaviour->accepts(to, &to->node->fields[route->to->index], value))
        return;
    set_value(ev, route->to, value->value.any, value->count);
    enqueue(ev, route->to, true);
}

void x3d_cascade(x3d_events *ev) {
    for (size_t i = 0; i < ev->queue.count; i++) {
        struct x3d_event_item item = ev->queue.items[i];
        x3d_event_node *owner = item.field->owner;
        if (item.received && owner->behaviour && owner->behaviour->receive)
            owner->behaviour->receive(ev, owner, &owner->node->fields[item.field->index]);
        for (size_t r = 0; r < item.field->route_count; r++) {
            x3d_event_route *route = &ev->routes.items[item.field->first_route + r];
            if (route->stamp == ev->stamp)
                continue;
            route->stamp = ev->stamp;
            ev->work++;
            deliver(ev, route);
        }
    }
    ev->queue.count = 0;
}

/* ---- Before and after ---- */

void x3d_events_reset(x3d_events *ev) {
    ev->queue.count = 0;
    for (x3d_event_field *field = ev->listed; field; field = field->next_listed) {
        if (field->changed)
            field->owner->node->fields[field->index] = field->original;
        field->changed = false;
    }
    for (size_t i = 0; i < ev->nodes.count; i++)
        memset(&ev->nodes.items[i]->state, 0, sizeof ev->nodes.items[i]->state);
    memset(ev->tops, 0, sizeof ev->tops);
}

static bool same(const plr_field *field, const void *memory, size_t count) {
    return field->count == count &&
           (!count || field->value.any == memory ||
            memcmp(field->value.any, memory, count * element_size(field->type)) == 0);
}

void x3d_events_compare(x3d_events *ev) {
    for (x3d_event_field *field = ev->listed; field; field = field->next_listed) {
        plr_node *node = field->owner->node;
        const plr_field *now = &node->fields[field->index];
        const plr_field *given = field->changed ? &field->original : now;
        bool unchanged = field->has_shown ? same(now, field->shown.memory, field->shown.count)
                                          : same(now, given->value.any, given->count);
        if (unchanged)
            continue;
        keep(&ev->scene->arena, &field->shown, now->value.any, now->count, element_size(now->type));
        field->has_shown = true;
        node->revision++;
        field->changed_at = ++ev->scene->revision;
    }
}
