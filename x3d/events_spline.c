/* Interpolators that go through their keys on curves: ISO/IEC 19775-1 V4, 19.2.4 and 19.4.10 to
 * 19.4.13, and those of other browsers with control points. */
#include "x3d/events.h"

#include <math.h>
#include <string.h>

#include "x3d/quaternion.h"

/* ---- Hermite splines ---- */

typedef struct spline {
    const float *keys, *values, *velocities; /* velocities NULL: none given */
    size_t count, velocity_count;
    int components;
    bool closed;
    double scale; /* of each velocity to the length of the path; 0: as they are */
} spline;

static double length(const double *v, int components) {
    double sum = 0;
    for (int c = 0; c < components; c++)
        sum += v[c] * v[c];
    return sqrt(sum);
}

static double path_length(const spline *s) {
    double sum = 0;
    for (size_t i = 0; i + 1 < s->count; i++) {
        double step[3];
        for (int c = 0; c < s->components; c++) {
            size_t at = i * (size_t)s->components + (size_t)c;
            step[c] = (double)s->values[at + (size_t)s->components] - (double)s->values[at];
        }
        sum += length(step, s->components);
    }
    return sum;
}

/* The neighbours of a key; a closed path goes on from its last point, which is its first. */
static bool neighbours(const spline *s, size_t i, size_t *before, size_t *behind) {
    bool end = i == 0 || i + 1 == s->count;
    if (end && (!s->closed || s->count < 3))
        return false;
    *before = i == 0 ? s->count - 2 : i - 1;
    *behind = i + 1 == s->count ? 1 : i + 1;
    return true;
}

/* 19.2.4: half the way between the neighbours, or the velocity that is given: for each key, or, two
 * of them, for the first and the last. */
static void tangent(const spline *s, size_t i, double *t) {
    size_t n = (size_t)s->components, before = 0, behind = 0;
    memset(t, 0, n * sizeof *t);
    const float *given = NULL;
    if (s->velocity_count == s->count)
        given = s->velocities + i * n;
    else if (s->velocity_count == 2 && (i == 0 || i + 1 == s->count))
        given = s->velocities + (i == 0 ? 0 : n);
    bool between = neighbours(s, i, &before, &behind);
    for (size_t c = 0; c < n; c++)
        if (given)
            t[c] = given[c];
        else if (between)
            t[c] = ((double)s->values[behind * n + c] - (double)s->values[before * n + c]) / 2;
    double size = length(t, s->components);
    for (size_t c = 0; c < n && given && s->scale > 0 && size > 0; c++)
        t[c] *= s->scale / size;
}

/* Uneven keys: the speed in time before a key and behind it is the same where each side takes its
 * part of both intervals. */
static double side_factor(const spline *s, size_t i, bool behind) {
    size_t left = 0, right = 0;
    if (!neighbours(s, i, &left, &right))
        return 1;
    double k = s->keys[i], before = k - (double)s->keys[left], after = (double)s->keys[right] - k;
    if (i == 0)
        before = (double)s->keys[s->count - 1] - (double)s->keys[left];
    if (i + 1 == s->count)
        after = (double)s->keys[right] - (double)s->keys[0];
    double sum = before + after;
    return sum > 0 ? 2 * (behind ? after : before) / sum : 1;
}

static void evaluate(const spline *s, const x3d_key_span *span, float *out) {
    size_t n = (size_t)s->components;
    const float *a = s->values + span->index * n, *b = s->values + span->next * n;
    if (!(span->weight > 0)) {
        memcpy(out, a, n * sizeof *out);
        return;
    }
    double t0[3], t1[3], u = span->weight, u2 = u * u, u3 = u2 * u;
    tangent(s, span->index, t0);
    tangent(s, span->next, t1);
    double f0 = side_factor(s, span->index, true), f1 = side_factor(s, span->next, false);
    for (size_t c = 0; c < n; c++)
        out[c] = (float)((2 * u3 - 3 * u2 + 1) * (double)a[c] + (3 * u2 - 2 * u3) * (double)b[c] +
                         (u3 - 2 * u2 + u) * f0 * t0[c] + (u3 - u2) * f1 * t1[c]);
}

/* A path is closed where its author says so and its ends meet. */
static bool is_closed(const spline *s, const plr_node *node) {
    size_t n = (size_t)s->components;
    return plr_node_bool(node, "closed") && s->count > 1 &&
           memcmp(s->values, s->values + (s->count - 1) * n, n * sizeof(float)) == 0;
}

static void follow_spline(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    const plr_node *own = node->node;
    const plr_field *key = plr_node_field(own, "key"), *values = plr_node_field(own, "keyValue");
    const plr_field *velocities = plr_node_field(own, "keyVelocity");
    spline s = {.keys = key->value.floats,
                .values = values->value.floats,
                .velocities = velocities->value.floats,
                .count = key->count < values->count ? key->count : values->count,
                .velocity_count = velocities->count,
                .components = plr_type_components(values->type)};
    x3d_key_span span;
    if (strcmp(field->name, "set_fraction") != 0 ||
        !x3d_key_span_find(key, s.count, (double)field->value.floats[0], &span))
        return;
    s.closed = is_closed(&s, own);
    if (plr_node_bool(own, "normalizeVelocity"))
        s.scale = path_length(&s);
    float out[3];
    evaluate(&s, &span, out);
    x3d_send(ev, node, "value_changed", out, 1);
}

/* ---- Rotations ---- */

static void rotation_at(const plr_field *values, size_t index, const double *near, double q[4]) {
    x3d_quaternion_from(values->value.floats + 4 * index, q);
    double cosine = 0;
    for (int i = 0; near && i < 4; i++)
        cosine += q[i] * near[i];
    for (int i = 0; cosine < 0 && i < 4; i++)
        q[i] = -q[i];
}

/* 19.4.13: the point of the inner curve that belongs to a key: q exp(-(log(q^-1 q_behind) +
 * log(q^-1 q_before)) / 4). At the ends of an open path it is the key itself. */
static void inner_point(const plr_field *values, size_t count, bool closed, size_t i,
                        const double q[4], double s[4]) {
    memcpy(s, q, 4 * sizeof *s);
    if ((i == 0 || i + 1 == count) && (!closed || count < 3))
        return;
    size_t sides[2] = {i == 0 ? count - 2 : i - 1, i + 1 == count ? 1 : i + 1};
    double back[4] = {-q[0], -q[1], -q[2], q[3]}, sum[3] = {0}, turn[4];
    for (int k = 0; k < 2; k++) {
        double other[4], v[3];
        rotation_at(values, sides[k], q, other);
        x3d_quaternion_multiply(back, other, turn);
        x3d_quaternion_log(turn, v);
        for (int c = 0; c < 3; c++)
            sum[c] -= v[c] / 4;
    }
    x3d_quaternion_exp(sum, turn);
    x3d_quaternion_multiply(q, turn, s);
}

static void follow_squad(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    const plr_field *key = plr_node_field(node->node, "key");
    const plr_field *values = plr_node_field(node->node, "keyValue");
    size_t count = key->count < values->count ? key->count : values->count;
    x3d_key_span span;
    if (strcmp(field->name, "set_fraction") != 0 ||
        !x3d_key_span_find(key, count, (double)field->value.floats[0], &span))
        return;
    bool closed = plr_node_bool(node->node, "closed") && count > 1 &&
                  memcmp(values->value.floats, values->value.floats + 4 * (count - 1),
                         4 * sizeof(float)) == 0;
    double a[4], b[4], inner_a[4], inner_b[4], outer[4], inner[4], q[4], u = span.weight;
    rotation_at(values, span.index, NULL, a);
    rotation_at(values, span.next, a, b);
    inner_point(values, count, closed, span.index, a, inner_a);
    inner_point(values, count, closed, span.next, b, inner_b);
    x3d_quaternion_slerp_as_is(a, b, u, outer);
    x3d_quaternion_slerp_as_is(inner_a, inner_b, u, inner);
    x3d_quaternion_slerp_as_is(outer, inner, 2 * u * (1 - u), q);
    float out[4];
    x3d_quaternion_to(q, out);
    if (!(u > 0))
        memcpy(out, values->value.floats + 4 * span.index, sizeof out);
    x3d_send(ev, node, "value_changed", out, 1);
}

/* ---- Control points: each span's time goes along a curve from (0,0) to (1,1) ---- */

static double bezier(double a, double b, double t) {
    return 3 * (1 - t) * (1 - t) * t * a + 3 * (1 - t) * t * t * b + t * t * t;
}

/* The y at which the curve has this x; x grows with t where the points are between 0 and 1. */
static double curve_at(const float points[4], double x) {
    double low = 0, high = 1;
    for (int i = 0; i < 50; i++) {
        double middle = (low + high) / 2;
        if (bezier(points[0], points[2], middle) < x)
            low = middle;
        else
            high = middle;
    }
    return bezier(points[1], points[3], low);
}

static bool find_curved(const x3d_event_node *node, const plr_field *field, x3d_key_span *span) {
    const plr_field *key = plr_node_field(node->node, "key");
    const plr_field *values = plr_node_field(node->node, "keyValue");
    const plr_field *points = plr_node_field(node->node, "controlPoints");
    size_t count = key->count < values->count ? key->count : values->count;
    if (strcmp(field->name, "set_fraction") != 0 ||
        !x3d_key_span_find(key, count, (double)field->value.floats[0], span))
        return false;
    if (points && span->index < points->count && span->weight > 0)
        span->weight = curve_at(points->value.floats + 4 * span->index, span->weight);
    return true;
}

static float curved(const x3d_event_node *node, const x3d_key_span *span, size_t component,
                    size_t components) {
    const float *values = plr_node_field(node->node, "keyValue")->value.floats;
    double a = values[span->index * components + component];
    double b = values[span->next * components + component];
    return (float)(a + span->weight * (b - a));
}

static void follow_angle(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    x3d_key_span span;
    if (!find_curved(node, field, &span))
        return;
    float out[4] = {0, 0, 1, 0};
    plr_node_numbers(node->node, "axis", out, 3);
    out[3] = curved(node, &span, 0, 1);
    x3d_send(ev, node, "value_changed", out, 1);
}

static void follow_curve(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    x3d_key_span span;
    if (!find_curved(node, field, &span))
        return;
    float out[3];
    for (size_t c = 0; c < 3; c++)
        out[c] = curved(node, &span, c, 3);
    x3d_send(ev, node, "value_changed", out, 1);
}

const x3d_behaviour x3d_spline_behaviours[] = {
    {.type = "SplinePositionInterpolator", .receive = follow_spline},
    {.type = "SplinePositionInterpolator2D", .receive = follow_spline},
    {.type = "SplineScalarInterpolator", .receive = follow_spline},
    {.type = "SquadOrientationInterpolator", .receive = follow_squad},
    {.type = "OrientationInterpolator2D", .receive = follow_angle},
    {.type = "CubicBezier2DOrientationInterpolator", .receive = follow_angle},
    {.type = "CubicBezierPositionInterpolator", .receive = follow_curve},
    {.type = NULL}};
