/* Interpolators (ISO/IEC 19775-1 V4, clause 19) that go from key to key. */
#include "x3d/events.h"

#include <math.h>
#include <string.h>

#include "x3d/quaternion.h"

/* ---- Keys ---- */

/* 19.2.2: the first value up to the first key, the last one from the last key on. The last of equal
 * keys counts, so that two equal keys make a jump. */
bool x3d_key_span_find(const plr_field *key, size_t count, double fraction, x3d_key_span *span) {
    const float *keys = key->value.floats;
    if (count > key->count)
        count = key->count;
    if (!count || !isfinite(fraction))
        return false;
    *span = (x3d_key_span){0, 0, 0};
    if (fraction <= (double)keys[0])
        return true;
    size_t low = 0, high = count; /* keys[low] <= fraction, and keys[high] is above it */
    if (fraction >= (double)keys[count - 1])
        low = count - 1;
    while (low + 1 < high) {
        size_t middle = low + (high - low) / 2;
        if ((double)keys[middle] <= fraction)
            low = middle;
        else
            high = middle;
    }
    span->index = span->next = low;
    if (low + 1 >= count)
        return true;
    span->next = low + 1;
    double length = (double)keys[low + 1] - (double)keys[low];
    double weight = (fraction - (double)keys[low]) / length;
    if (weight > 0)
        span->weight = weight < 1 ? weight : 1;
    return true;
}

/* ---- Ways to go from one value to the next ---- */

typedef void mix(const float *a, const float *b, double weight, float *out);

static void mix_numbers(const float *a, const float *b, double weight, float *out, int count) {
    for (int i = 0; i < count; i++)
        out[i] = (float)((double)a[i] + weight * ((double)b[i] - (double)a[i]));
}

static void mix_1(const float *a, const float *b, double weight, float *out) {
    mix_numbers(a, b, weight, out, 1);
}
static void mix_2(const float *a, const float *b, double weight, float *out) {
    mix_numbers(a, b, weight, out, 2);
}
static void mix_3(const float *a, const float *b, double weight, float *out) {
    mix_numbers(a, b, weight, out, 3);
}

/* 19.4.1: in HSV. The hue goes the shorter way round; a grey has that of the other colour. */
static void to_hsv(const float *rgb, double hsv[3]) {
    double r = rgb[0], g = rgb[1], b = rgb[2];
    double most = fmax(r, fmax(g, b)), range = most - fmin(r, fmin(g, b));
    hsv[2] = most;
    hsv[1] = most > 0 ? range / most : 0;
    hsv[0] = 0;
    if (!(range > 0))
        return;
    if (r >= g && r >= b)
        hsv[0] = (g - b) / range;
    else if (g >= b)
        hsv[0] = 2 + (b - r) / range;
    else
        hsv[0] = 4 + (r - g) / range;
}

static void from_hsv(const double hsv[3], float *rgb) {
    for (int i = 0; i < 3; i++) {
        /* how far the hue is from that of the component: 0 to 3 */
        double far = fabs(fmod(fmod(hsv[0] - 2 * i, 6) + 9, 6) - 3);
        double tint = fmin(fmax(2 - far, 0), 1);
        rgb[i] = (float)(hsv[2] * (1 - hsv[1] * (1 - tint)));
    }
}

static void mix_color(const float *a, const float *b, double weight, float *out) {
    double x[3], y[3], hsv[3];
    to_hsv(a, x);
    to_hsv(b, y);
    if (!(x[1] > 0))
        x[0] = y[0];
    if (!(y[1] > 0))
        y[0] = x[0];
    double turn = y[0] - x[0];
    turn -= turn > 3 ? 6 : turn < -3 ? -6 : 0;
    hsv[0] = x[0] + weight * turn;
    for (int i = 1; i < 3; i++)
        hsv[i] = x[i] + weight * (y[i] - x[i]);
    from_hsv(hsv, out);
}

/* 19.4.5: normals go along the shortest arc. */
static void mix_normal(const float *a, const float *b, double weight, float *out) {
    double dot = 0, x = 0, y = 0;
    for (int i = 0; i < 3; i++) {
        dot += (double)a[i] * (double)b[i];
        x += (double)a[i] * (double)a[i];
        y += (double)b[i] * (double)b[i];
    }
    double cosine = fmin(fmax(dot / sqrt(x * y), -1), 1), angle = acos(cosine), sine = sin(angle);
    if (!(sine > 1e-6)) {
        mix_3(a, b, weight, out);
        return;
    }
    double from = sin((1 - weight) * angle) / sine, to = sin(weight * angle) / sine;
    for (int i = 0; i < 3; i++)
        out[i] = (float)(from * (double)a[i] / sqrt(x) + to * (double)b[i] / sqrt(y));
}

static void mix_rotation(const float *a, const float *b, double weight, float *out) {
    double x[4], y[4], q[4];
    x3d_quaternion_from(a, x);
    x3d_quaternion_from(b, y);
    x3d_quaternion_slerp(x, y, weight, q);
    x3d_quaternion_to(q, out);
}

/* ---- The nodes ---- */

typedef struct way {
    mix *mix;
    int components;
    bool many; /* a list of values for each key */
} way;

static void interpolate(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    const way *w = node->behaviour->data;
    const plr_field *key = plr_node_field(node->node, "key");
    const plr_field *values = plr_node_field(node->node, "keyValue");
    if (strcmp(field->name, "set_fraction") != 0 || !key->count)
        return;
    size_t each = w->many ? values->count / key->count : 1;
    size_t count = w->many || key->count < values->count ? key->count : values->count;
    x3d_key_span span;
    if (!each || !x3d_key_span_find(key, count, (double)field->value.floats[0], &span))
        return;
    size_t size = (size_t)w->components;
    float *out = x3d_events_scratch(ev, each * size * sizeof *out);
    const float *a = values->value.floats + span.index * each * size;
    const float *b = values->value.floats + span.next * each * size;
    for (size_t i = 0; i < each * size; i += size)
        if (span.weight > 0)
            w->mix(a + i, b + i, span.weight, out + i);
        else
            memcpy(out + i, a + i, size * sizeof *out);
    x3d_send(ev, node, "value_changed", out, each);
}

/* 19.4.4: each key eases in before and out behind. */
static void ease(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    const plr_field *key = plr_node_field(node->node, "key");
    const plr_field *eases = plr_node_field(node->node, "easeInEaseOut");
    x3d_key_span span;
    size_t count = key->count < eases->count ? key->count : eases->count;
    if (strcmp(field->name, "set_fraction") != 0 ||
        !x3d_key_span_find(key, count, (double)field->value.floats[0], &span))
        return;
    if (span.index == span.next && span.index > 0) /* the end of the last span */
        span = (x3d_key_span){span.index - 1, span.index, 1};
    double u = span.weight, out = eases->value.floats[2 * span.index + 1];
    double in = eases->value.floats[2 * span.next], sum = in + out;
    if (sum > 1) {
        in /= sum;
        out /= sum;
    }
    if (sum > 0) {
        double top = 1 / (2 - out - in);
        if (u < out)
            u = top / out * u * u;
        else if (u <= 1 - in)
            u = top * (2 * u - out);
        else
            u = 1 - top * (1 - u) * (1 - u) / in;
    }
    float modified = (float)u;
    x3d_send(ev, node, "modifiedFraction_changed", &modified, 1);
}

static const way color = {mix_color, 3, false}, colors = {mix_color, 3, true};
static const way vectors2 = {mix_2, 2, true}, vectors3 = {mix_3, 3, true};
static const way vector2 = {mix_2, 2, false}, vector3 = {mix_3, 3, false};
static const way number = {mix_1, 1, false}, numbers = {mix_1, 1, true};
static const way normals = {mix_normal, 3, true}, rotation = {mix_rotation, 4, false};

const x3d_behaviour x3d_interpolator_behaviours[] = {
    {.type = "ColorInterpolator", .receive = interpolate, .data = &color},
    {.type = "ColorSetInterpolator", .receive = interpolate, .data = &colors},
    {.type = "CoordinateInterpolator", .receive = interpolate, .data = &vectors3},
    {.type = "CoordinateInterpolator2D", .receive = interpolate, .data = &vectors2},
    {.type = "EaseInEaseOut", .receive = ease},
    {.type = "NormalInterpolator", .receive = interpolate, .data = &normals},
    {.type = "OrientationInterpolator", .receive = interpolate, .data = &rotation},
    {.type = "PositionInterpolator", .receive = interpolate, .data = &vector3},
    {.type = "PositionInterpolator2D", .receive = interpolate, .data = &vector2},
    {.type = "ScalarInterpolator", .receive = interpolate, .data = &number},
    {.type = "VectorInterpolator", .receive = interpolate, .data = &numbers},
    {.type = NULL}};
