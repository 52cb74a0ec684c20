/* The optical depth of surfaces of equal value: each crossing lets through 1 - alpha. A unit of
 * ShadowRay.glsl's effect, beside levels.glsl.
 *
 * The value at both ends of a step tells which surfaces lie between; where they are crossed is found on
 * the straight line between the ends. The first half voxel counts as empty, so that a surface does not
 * shadow itself where it lies. */

const float OWN_VOXELS = 0.5;

float value_at(const in float t) {
    VolumeSample s;
    sample_at(s, t, 0.0);
    return voxel_scalar(s.value);
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
            float part = clamp((surfaces[surface].x - value) / (value_next - value), 0.0, 1.0);
            depth += crossing_depth(mix(t, t_next, part), surface);
        }
        t = t_next;
        value = value_next;
        below = below_next;
    }
}
