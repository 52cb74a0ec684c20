/* The optical depth of a volume that fills its box: the middle of each step stands for it. Steps begin
 * short, since the matter around the place itself changes from sample to sample of the viewer's ray,
 * and grow with the way behind them. A unit of ShadowRay.glsl's effect.
 *
 * What is opaque is met by the viewer's ray up to a step behind its surface. That it is dark there would
 * be no shadow but a fault: opaque matter around the place itself counts only from two voxels on. */

const float OWN_VOXELS = 2.0;
const float FIRST_PART = 0.25; /* of the longest step */

void add_depth(inout float depth, const in float enter, const in float leave) {
    float longest = shadow_step(leave - enter), own_end = OWN_VOXELS * voxel_way();
    float shortest = FIRST_PART * longest;
    float t = enter;
    VolumeSample s;
    bool own = false;
    if (enter <= 0.0) {
        sample_at(s, 0.0, 0.0);
        own = sample_opacity(s) >= 1.0;
    }
    /* the last step is shortened: lengths add up to the way; a remainder that is rounding is none */
    for (int i = 0; i < 2 * MOST_STEPS && leave - t > 1.0e-4 * shortest && depth <= DARK_DEPTH; i++) {
        float span = min(clamp(t, shortest, longest), leave - t);
        float middle = t + 0.5 * span;
        sample_at(s, middle, span);
        float alpha = sample_opacity(s);
        own = own && alpha >= 1.0 && middle < own_end;
        if (alpha < 1.0)
            depth -= log(1.0 - alpha) * span * ray_speed / referenceLength;
        else if (!own)
            depth = OPAQUE_DEPTH;
        t += span;
    }
}
