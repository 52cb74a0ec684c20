/* The optical depth of a volume that fills its box: the middle of each step stands for it. A unit of
 * ShadowRay.glsl's effect.
 *
 * What is opaque is met by the viewer's ray up to a step behind its surface. That it is dark there would
 * be no shadow but a fault: opaque matter around the place itself counts only from two voxels on. */

const float OWN_VOXELS = 2.0;

void add_depth(inout float depth, const in float enter, const in float leave) {
    float step_length = shadow_step(leave - enter);
    int count = step_count(leave - enter, step_length);
    VolumeSample s;
    bool own = false;
    float own_end = OWN_VOXELS * voxel_way();
    if (enter <= 0.0) {
        sample_at(s, 0.0, 0.0);
        own = sample_opacity(s) >= 1.0;
    }
    for (int i = 0; i < count && depth <= DARK_DEPTH; i++) {
        float t = enter + float(i) * step_length;
        float span = i == count - 1 ? leave - t : step_length;
        float middle = t + 0.5 * span;
        sample_at(s, middle, span);
        float alpha = sample_opacity(s);
        own = own && alpha >= 1.0 && middle < own_end;
        if (alpha < 1.0)
            depth -= log(1.0 - alpha) * span * ray_speed / referenceLength;
        else if (!own)
            depth = OPAQUE_DEPTH;
    }
}
