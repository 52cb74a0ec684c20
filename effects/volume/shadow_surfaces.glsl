/* The optical depth of surfaces of equal value: each crossing lets through 1 - alpha. A unit of
 * ShadowRay.glsl's effect, beside levels.glsl.
 *
 * The value at both ends of a step tells which surfaces lie between; where each is crossed is then
 * found. What is near the place itself counts as empty: from cell to cell a trilinear surface has steps that its
 * normals do not have, and these would lie in their own shadow. */

const float OWN_VOXELS = 1.5;

float value_at(const in float t) {
    VolumeSample s;
    sample_at(s, t, 0.0);
    return voxel_scalar(s.value);
}

/* Where the value is `level`, between two places on its two sides: false position. The opacity there may
 * depend on the value; where exactly it is matters little. */
float find_crossing(const in float level, float a, float value_a, float b, float value_b) {
    float t = a;
    for (int i = 0; i < 4; i++) {
        t = mix(a, b, clamp((level - value_a) / (value_b - value_a), 0.0, 1.0));
        float value = value_at(t);
        if (value == level)
            break;
        if ((value < level) == (value_a < level)) {
            a = t;
            value_a = value;
        } else {
            b = t;
            value_b = value;
        }
    }
    return t;
}

/* The depth of one crossing. */
float crossing_depth(const in float t, const in int surface) {
    vec3 position = ray_origin + t * ray_direction;
    if (!is_steep(position))
        return 0.0;
    VolumeSample s;
    sample_at(s, t, 0.0);
    surface_sample(s, position, surface);
    float alpha = sample_opacity(s);
    return alpha < 1.0 ? -log(1.0 - alpha) : OPAQUE_DEPTH;
}

void add_depth(inout float depth, const in float enter, const in float leave) {
    float start = enter <= 0.0 ? min(OWN_VOXELS * voxel_way(), leave) : enter;
    float step_length = shadow_step(leave - start);
    int count = step_count(leave - start, step_length);
    float t = start, value = value_at(start);
    int below = count_below(value);
    for (int i = 0; i < count && depth <= DARK_DEPTH; i++) {
        float t_next = i == count - 1 ? leave : start + float(i + 1) * step_length;
        float value_next = value_at(t_next);
        int below_next = count_below(value_next);
        while (below != below_next && depth <= DARK_DEPTH) {
            bool up = below < below_next;
            int surface = up ? below : below - 1;
            below += up ? 1 : -1;
            float crossing = find_crossing(surfaces[surface].x, t, value, t_next, value_next);
            depth += crossing_depth(crossing, surface);
        }
        t = t_next;
        value = value_next;
        below = below_next;
    }
}
