/* Bindable nodes (ISO/IEC 19775-1 V4, 7.2.2): a stack for each class, whose top is what is used;
 * and what the viewpoint in use tells. */
#include "x3d/events.h"

#include <string.h>

static const char *const classes[X3D_STACKS] = {"X3DViewpointNode", "X3DBackgroundNode",
                                                "NavigationInfo", "X3DFogObject"};

static size_t class_of(const x3d_event_node *node) {
    for (size_t i = 0; i < X3D_STACKS; i++)
        if (plr_node_is(node->node, classes[i]))
            return i;
    return X3D_STACKS;
}

static void tell(x3d_events *ev, x3d_event_node *node, bool bound) {
    x3d_send_bool(ev, node, "isBound", bound);
    x3d_send_time(ev, node, "bindTime", ev->now);
}

static void take_out(x3d_events *ev, size_t stack, x3d_event_node *node) {
    x3d_event_node *below = node->state.bindable.below, *above = node->state.bindable.above;
    if (below)
        below->state.bindable.above = above;
    if (above)
        above->state.bindable.below = below;
    else
        ev->tops[stack] = below;
    memset(&node->state.bindable, 0, sizeof node->state.bindable);
}

static void put_on_top(x3d_events *ev, size_t stack, x3d_event_node *node) {
    x3d_event_node *top = ev->tops[stack];
    if (top)
        top->state.bindable.above = node;
    node->state.bindable.below = top;
    node->state.bindable.bound = true;
    ev->tops[stack] = node;
}

static void receive(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    size_t stack = class_of(node);
    if (strcmp(field->name, "set_bind") != 0 || stack == X3D_STACKS)
        return;
    x3d_event_node *top = ev->tops[stack];
    bool bind = field->value.bools[0];
    if (bind == (top == node) || (!bind && !node->state.bindable.bound))
        return;
    if (node->state.bindable.bound)
        take_out(ev, stack, node);
    if (bind) {
        put_on_top(ev, stack, node);
        if (top)
            tell(ev, top, false);
        tell(ev, node, true);
    } else if (top == node) {
        tell(ev, node, false);
        if (ev->tops[stack])
            tell(ev, ev->tops[stack], true);
    }
}

void x3d_bindables_start(x3d_events *ev) {
    const plr_node *asked = ev->viewer ? ev->viewer->viewpoint : NULL;
    x3d_event_node *first[X3D_STACKS] = {NULL};
    for (size_t i = 0; i < ev->nodes.count; i++) {
        x3d_event_node *node = ev->nodes.items[i];
        if (!node->behaviour || node->behaviour->receive != receive)
            continue;
        size_t stack = class_of(node);
        if (stack < X3D_STACKS && (!first[stack] || node->node == asked))
            first[stack] = node;
    }
    for (size_t i = 0; i < X3D_STACKS; i++)
        if (first[i]) {
            put_on_top(ev, i, first[i]);
            tell(ev, first[i], true);
        }
}

/* ---- Matrices of the camera ---- */

/* Fields hold rows, so that `cameraMatrix * v` in GLSL takes v from world to eye. */
static void send_matrix(x3d_events *ev, x3d_event_node *node, const char *name, const double *m,
                        int size) {
    float rows[16];
    for (int row = 0; row < size; row++)
        for (int column = 0; column < size; column++)
            rows[size * row + column] = (float)m[4 * column + row];
    x3d_send(ev, node, name, rows, 1);
}

static void look(x3d_events *ev, x3d_event_node *node) {
    if (!ev->viewer || ev->tops[0] != node)
        return;
    send_matrix(ev, node, "cameraMatrix", ev->viewer->world_to_eye, 4);
    send_matrix(ev, node, "cameraInverseMatrix", ev->viewer->eye_to_world, 4);
    send_matrix(ev, node, "cameraRotationMatrix", ev->viewer->world_to_eye, 3);
    send_matrix(ev, node, "cameraRotationInverseMatrix", ev->viewer->eye_to_world, 3);
}

static bool remembers(const char *field) {
    return strcmp(field, "set_bind") == 0;
}

const x3d_behaviour x3d_bindable_behaviours[] = {
    {.type = "X3DViewpointNode", .receive = receive, .step = look, .remembers = remembers},
    {.type = "X3DBindableNode", .receive = receive, .remembers = remembers},
    {.type = NULL}};
