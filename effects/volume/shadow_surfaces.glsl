/* The optical depth of surfaces of equal value: each crossing lets through 1 - alpha. A unit of
 * ShadowRay.glsl's effect, beside levels.glsl and crossings.glsl.
 *
 * What is near the place itself counts as empty: from cell to cell a trilinear surface has steps that its
 * normals do not have, and these would lie in their own shadow. */

const float OWN_VOXELS = 1.5;

float value_at(const in float t) {
#if PLUG_USED(volume_sample)
    VolumeSample s;
    sample_at(s, t, 0.0);
    return voxel_scalar(s.value);
#else
    return scalar_at(ray_origin + t * ray_direction);
#endif
}

/* The depth of one crossing. */
float crossing_depth(const in float t, const in int surface) {
    VolumeSample s;
    sample_at(s, t, 0.0);
    surface_sample(s, ray_origin + t * ray_direction, surface);
    float alpha = sample_opacity(s);
    return alpha < 1.0 ? -log(1.0 - alpha) : OPAQUE_DEPTH;
}

void add_depth(inout float depth, const in float enter, const in float leave) {
    float start = enter <= 0.0 ? min(OWN_VOXELS * voxel_way(), leave) : enter;
    float step_length = shadow_step(leave - start);
    begin_way(start, leave);
    float t = start;
    while (t < NOWHERE && depth <= DARK_DEPTH) {
        t = next_crossing(step_length);
        if (t < NOWHERE)
            depth += crossing_depth(t, event_surface);
    }
}
