/* Sensors of the environment (ISO/IEC 19775-1 V4, clause 22), and LoadSensor (9.4.3). A node that
 * is USEd in several places senses in the first of them. */
#include "x3d/events.h"

#include <math.h>
#include <string.h>

#include "x3d/quaternion.h"

/* The box of a sensor as its corner of least and of greatest coordinates; false: it is empty. */
static bool box_of(const plr_node *node, double box[2][3]) {
    float center[3] = {0}, size[3] = {0};
    plr_node_numbers(node, "center", center, 3);
    plr_node_numbers(node, "size", size, 3);
    for (int i = 0; i < 3; i++) {
        box[0][i] = (double)center[i] - (double)size[i] / 2;
        box[1][i] = (double)center[i] + (double)size[i] / 2;
    }
    return size[0] > 0 && size[1] > 0 && size[2] > 0;
}

static bool is_inside(double box[2][3], const double point[3]) {
    for (int i = 0; i < 3; i++)
        if (!(point[i] >= box[0][i] && point[i] <= box[1][i]))
            return false;
    return true;
}

/* Takes the lengths out of a matrix, so that its columns are a rotation. */
static void only_turn(plr_matrix *m) {
    for (int column = 0; column < 3; column++) {
        double *v = &m->m[4 * column];
        double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        for (int i = 0; i < 3 && length > 0; i++)
            v[i] /= length;
    }
}

static void send_if_new(x3d_events *ev, x3d_event_node *node, const char *name, const float *values,
                        size_t components, bool entered) {
    const plr_field *field = plr_node_field(node->node, name);
    if (field && (entered || memcmp(field->value.floats, values, components * sizeof *values) != 0))
        x3d_send(ev, node, name, values, 1);
}

static void send_vector(x3d_events *ev, x3d_event_node *node, const char *name, const double *v,
                        bool entered) {
    const float values[3] = {(float)v[0], (float)v[1], (float)v[2]};
    send_if_new(ev, node, name, values, 3, entered);
}

static void send_turn(x3d_events *ev, x3d_event_node *node, plr_matrix turned, bool entered) {
    double q[4];
    float rotation[4];
    only_turn(&turned);
    x3d_quaternion_from_matrix(turned.m, q);
    x3d_quaternion_to(q, rotation);
    send_if_new(ev, node, "orientation_changed", rotation, 4, entered);
}

/* Says that something came in or went out; true if it is inside and has just come. */
static bool enter_or_leave(x3d_events *ev, x3d_event_node *node, bool inside) {
    if (inside == node->state.sensor.inside)
        return false;
    node->state.sensor.inside = inside;
    x3d_send_bool(ev, node, "isActive", inside);
    x3d_send_time(ev, node, inside ? "enterTime" : "exitTime", ev->now);
    return inside;
}

/* Where something is as the sensor sees it; false where the sensor's space has no extent. */
static bool seen_from(const x3d_events *ev, const x3d_event_node *node, const plr_matrix *thing,
                      plr_matrix *seen) {
    plr_matrix to_local;
    if (!plr_matrix_invert(&ev->places.items[node->place].to_world, &to_local))
        return false;
    *seen = plr_matrix_multiply(&to_local, thing);
    return true;
}

static const x3d_event_node *bound_viewpoint(const x3d_events *ev) {
    return ev->tops[0];
}

static void send_center(x3d_events *ev, x3d_event_node *node, bool entered) {
    const x3d_event_node *viewpoint = bound_viewpoint(ev);
    float center[3] = {0};
    plr_matrix seen;
    if (!viewpoint || !seen_from(ev, node, &ev->places.items[viewpoint->place].to_world, &seen))
        return;
    plr_node_numbers(viewpoint->node, "centerOfRotation", center, 3);
    double point[3] = {center[0], center[1], center[2]};
    plr_matrix_point(&seen, point, point);
    send_vector(ev, node, "centerOfRotation_changed", point, entered);
}

static void sense_viewer(x3d_events *ev, x3d_event_node *node) {
    double box[2][3];
    plr_matrix eye, seen;
    bool inside = ev->viewer && plr_node_bool(node->node, "enabled") && box_of(node->node, box);
    if (inside) {
        memcpy(eye.m, ev->viewer->eye_to_world, sizeof eye.m);
        inside = seen_from(ev, node, &eye, &seen) && is_inside(box, &seen.m[12]);
    }
    bool entered = enter_or_leave(ev, node, inside);
    if (!inside)
        return;
    send_vector(ev, node, "position_changed", &seen.m[12], entered);
    send_turn(ev, node, seen, entered);
    send_center(ev, node, entered);
}

static void sense_target(x3d_events *ev, x3d_event_node *node) {
    double box[2][3];
    plr_matrix seen;
    const plr_matrix *target = &ev->places.items[node->target_place].to_world;
    bool inside = plr_node_child(node->node, "targetObject") &&
                  plr_node_bool(node->node, "enabled") && box_of(node->node, box) &&
                  seen_from(ev, node, target, &seen) && is_inside(box, &seen.m[12]);
    bool entered = enter_or_leave(ev, node, inside);
    if (!inside)
        return;
    send_vector(ev, node, "position_changed", &seen.m[12], entered);
    send_turn(ev, node, seen, entered);
}

/* A box is out of sight where all its corners are beyond the same side of the view. */
static bool is_in_sight(const plr_matrix *to_clip, double box[2][3]) {
    int beyond[5] = {0};
    for (int corner = 0; corner < 8; corner++) {
        double clip[4];
        for (int row = 0; row < 4; row++) {
            clip[row] = to_clip->m[12 + row];
            for (int axis = 0; axis < 3; axis++)
                clip[row] += to_clip->m[4 * axis + row] * box[corner >> axis & 1][axis];
        }
        beyond[0] += clip[0] < -clip[3];
        beyond[1] += clip[0] > clip[3];
        beyond[2] += clip[1] < -clip[3];
        beyond[3] += clip[1] > clip[3];
        beyond[4] += clip[3] <= 0;
    }
    for (int side = 0; side < 5; side++)
        if (beyond[side] == 8)
            return false;
    return true;
}

static void sense_sight(x3d_events *ev, x3d_event_node *node) {
    double box[2][3];
    bool inside = ev->viewer && plr_node_bool(node->node, "enabled") && box_of(node->node, box);
    if (inside) {
        plr_matrix projection, to_eye, to_clip;
        memcpy(projection.m, ev->viewer->projection, sizeof projection.m);
        memcpy(to_eye.m, ev->viewer->world_to_eye, sizeof to_eye.m);
        to_clip = plr_matrix_multiply(&projection, &to_eye);
        to_clip = plr_matrix_multiply(&to_clip, &ev->places.items[node->place].to_world);
        inside = is_in_sight(&to_clip, box);
    }
    enter_or_leave(ev, node, inside);
}

/* An OctTree of the proposal of 2005 for volumes says which of its halves is seen: at first, and
 * whenever that changes. Without a viewer it is the near one. */
static void sense_range(x3d_events *ev, x3d_event_node *node) {
    float c[3] = {0};
    plr_matrix eye, seen;
    bool far = false;
    if (ev->viewer) {
        memcpy(eye.m, ev->viewer->eye_to_world, sizeof eye.m);
        plr_node_numbers(node->node, "center", c, 3);
        double distance = 0;
        if (seen_from(ev, node, &eye, &seen))
            for (int i = 0; i < 3; i++)
                distance = hypot(distance, seen.m[12 + i] - (double)c[i]);
        far = distance >= plr_node_number(node->node, "range");
    }
    if (node->state.octants.told && far == node->state.octants.far)
        return;
    node->state.octants.told = true;
    node->state.octants.far = far;
    x3d_send_bool(ev, node, "lowResActive", far);
}

/* Everything is there from the start. */
static void load(x3d_events *ev, x3d_event_node *node) {
    const plr_field *watched = plr_node_field(node->node, "children");
    const float all = 1;
    if (!plr_node_bool(node->node, "enabled") || !watched || !watched->count)
        return;
    x3d_send_bool(ev, node, "isLoaded", true);
    x3d_send_time(ev, node, "loadTime", 0);
    x3d_send(ev, node, "progress", &all, 1);
}

const x3d_behaviour x3d_sensor_behaviours[] = {{.type = "ProximitySensor", .step = sense_viewer},
                                               {.type = "TransformSensor", .step = sense_target},
                                               {.type = "VisibilitySensor", .step = sense_sight},
                                               {.type = "OctTree", .step = sense_range},
                                               {.type = "LoadSensor", .start = load},
                                               {.type = NULL}};
