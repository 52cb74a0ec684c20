/* Event utilities (ISO/IEC 19775-1 V4, clause 30) and the Toggler of other browsers. */
#include "x3d/events.h"

#include <string.h>

static bool is_named(const plr_field *field, const char *name) {
    return strcmp(field->name, name) == 0;
}

/* "enabled" is an extension of some of these nodes. */
static bool is_enabled(const plr_node *node) {
    return !plr_node_field(node, "enabled") || plr_node_bool(node, "enabled");
}

static void filter(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    if (!is_named(field, "set_boolean") || !is_enabled(node->node))
        return;
    bool value = field->value.bools[0];
    x3d_send_bool(ev, node, value ? "inputTrue" : "inputFalse", value);
    x3d_send_bool(ev, node, "inputNegate", !value);
}

static void toggle(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    if (is_named(field, "set_boolean") && is_enabled(node->node) && field->value.bools[0])
        x3d_send_bool(ev, node, "toggle", !plr_node_bool(node->node, "toggle"));
}

static void trigger_boolean(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    if (is_named(field, "set_triggerTime") && is_enabled(node->node))
        x3d_send_bool(ev, node, "triggerTrue", true);
}

static void trigger_integer(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    int32_t key = plr_node_int(node->node, "integerKey");
    if (is_named(field, "set_boolean") && is_enabled(node->node))
        x3d_send(ev, node, "triggerValue", &key, 1);
}

static void trigger_time(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    if (is_named(field, "set_boolean") && is_enabled(node->node))
        x3d_send_time(ev, node, "triggerTime", ev->now);
}

/* The outputs of a Toggler that go with a status. */
static void tell_status(x3d_events *ev, x3d_event_node *node, bool status) {
    x3d_send_bool(ev, node, "changed", true);
    x3d_send_bool(ev, node, status ? "on" : "off", true);
}

static void toggler(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    bool value = field->value.bools && field->count ? field->value.bools[0] : false;
    if (is_named(field, "status") || is_named(field, "notStatus")) {
        bool direct = is_named(field, "status");
        x3d_send_bool(ev, node, direct ? "notStatus" : "status", !value);
        tell_status(ev, node, direct ? value : !value);
        return;
    }
    bool now = plr_node_bool(node->node, "status"), next = now;
    if (is_named(field, "toggle"))
        next = !now;
    else if (is_named(field, "set"))
        next = true;
    else if (is_named(field, "reset"))
        next = false;
    if (!value || next == now || !is_enabled(node->node))
        return;
    x3d_send_bool(ev, node, "status", next);
    x3d_send_bool(ev, node, "notStatus", !next);
    tell_status(ev, node, next);
}

/* ---- Sequencers: value_changed is sent when another value's turn comes ---- */

static void send_value(x3d_events *ev, x3d_event_node *node, size_t index) {
    const plr_field *values = plr_node_field(node->node, "keyValue");
    if (node->state.sequencer.current == index + 1)
        return;
    node->state.sequencer.current = index + 1;
    if (index >= values->count)
        return;
    if (plr_type_kind(values->type) == PLR_BOOL)
        x3d_send(ev, node, "value_changed", &values->value.bools[index], 1);
    else
        x3d_send(ev, node, "value_changed", &values->value.ints[index], 1);
}

static void sequence(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    const plr_field *key = plr_node_field(node->node, "key");
    size_t count = key->count, current = node->state.sequencer.current;
    x3d_key_span span;
    if (!count)
        return;
    if (is_named(field, "set_fraction") &&
        x3d_key_span_find(key, count, (double)field->value.floats[0], &span))
        send_value(ev, node, span.index);
    else if (is_named(field, "next") && field->value.bools[0])
        send_value(ev, node, current % count);
    else if (is_named(field, "previous") && field->value.bools[0])
        send_value(ev, node, current < 2 ? count - 1 : current - 2);
}

static bool always(const char *field) {
    return *field != 0;
}

static bool steps(const char *field) {
    return strcmp(field, "next") == 0 || strcmp(field, "previous") == 0;
}

const x3d_behaviour x3d_logic_behaviours[] = {
    {.type = "BooleanFilter", .receive = filter, .remembers = always},
    {.type = "BooleanToggle", .receive = toggle, .remembers = always},
    {.type = "BooleanTrigger", .receive = trigger_boolean, .remembers = always},
    {.type = "IntegerTrigger", .receive = trigger_integer, .remembers = always},
    {.type = "TimeTrigger", .receive = trigger_time, .remembers = always},
    {.type = "Toggler", .receive = toggler, .remembers = always},
    {.type = "X3DSequencerNode", .receive = sequence, .remembers = steps},
    {.type = NULL}};
