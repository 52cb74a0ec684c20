/* A volume that fills its box: samples in steps along the ray. A unit of Volume.glsl's effect. */

void ray_begins(const in vec3 origin_eye, const in vec3 direction_eye) {
}

/* Colour and opacity per reference length in the middle of a step. */
void step_color(out vec4 color, out VolumeSample s, const in float t, const in float span,
                const in vec3 origin_eye, const in vec3 direction_eye) {
    sample_at(s, t, span, origin_eye, direction_eye);
    color = voxel_color(s.value);
    style_sample(color, s);
}

#if MIXES
void PLUG_volume_mix(inout VolumeMix mixed, const in float t, const in float span,
                     const in vec3 origin_eye, const in vec3 direction_eye) {
    if (!(enter <= t && t < leave))
        return;
    vec4 color;
    VolumeSample s;
    step_color(color, s, t, span, origin_eye, direction_eye);
    volume_mix_add(mixed, color, span * ray_speed / referenceLength);
#if PICKS
    float depth = color.a < 1.0 ? -log(1.0 - color.a) * span * ray_speed / referenceLength : NOWHERE;
    if (depth > met_depth) {
        met_depth = depth;
        met_volume = volumeIndex;
        met_surface = -1;
    }
#endif
}
#else
void PLUG_volume_step(out vec4 color, out VolumeSample s, const in float t, const in float span,
                      const in vec3 origin_eye, const in vec3 direction_eye) {
    step_color(color, s, t, span, origin_eye, direction_eye);
#if PICKS
    met_volume = volumeIndex;
#endif
    /* opacity of this step: 1 - (1 - alpha)^(length / reference); opaque stays opaque */
    if (color.a < 1.0)
        color.a = opacity_of_depth(-log(1.0 - color.a) * span * ray_speed / referenceLength);
}
#endif
