/* A volume that fills its box: samples in steps along the ray. A unit of Volume.glsl's effect. */

void ray_begins(const in vec3 origin_eye, const in vec3 direction_eye) {
#if HAS_LEAPS
    cells_begin(voxel_count());
#endif
}

/* Colour and opacity per reference length in the middle of a step. */
void step_color(out vec4 color, out VolumeSample s, const in float t, const in float span,
                const in vec3 origin_eye, const in vec3 direction_eye) {
    sample_at(s, t, span, origin_eye, direction_eye);
    color = voxel_color(s.value);
    style_sample(color, s);
}

#if SKIPS
/* Whether the sample at t can add anything: what is clear before the styles stays so, if KEEPS_CLEAR. */
bool is_visible(const in float t) {
#if KEEPS_CLEAR
    vec4 value = voxel_at(ray_origin + t * ray_direction);
    bool visible = voxel_color(value).a > 0.0;
    /* PLUG: volume_visible (visible, value) */
    return visible;
#else
    return true;
#endif
}

#if HAS_LEAPS
/* How many samples from that at t on lie in blocks where nothing can be seen, if steps are at most so long. */
void pass_clear(const in float t, const in float step_length, inout int steps) {
    vec3 corner;
    float blocks = leap_at(cell_origin + t * cell_direction, corner);
    vec3 ends = (corner - cell_origin) * cell_inverse;
    float end = min(min(ends.x, ends.y), ends.z);
    float behind = (end - t) * (1.0 / step_length) - 1.0e-3;
    steps = blocks > 0.0 ? min(1 + int(clamp(behind, 0.0, float(steps))), steps) : 0;
}

#if !MIXES
void PLUG_volume_leap(const in float t, const in float step_length, inout int steps) {
    pass_clear(t, step_length, steps);
}
#endif
#endif

#if MIXES
int ahead_start; /* which of the steps ahead are in the volume */
int ahead_end;

/* The next steps ahead, `count` of them behind `first`, lie in a part of the ray that begins at t. */
void PLUG_volume_plan(const in int first, const in int count, const in float t) {
    if (first == 0)
        ahead_start = ahead_end = 0;
    if (enter <= t && t < leave) {
        if (ahead_end == 0)
            ahead_start = first;
        ahead_end = first + count;
    }
}

/* Notes in which of these it may be seen. */
void look_at(inout uint visible, const in int k) {
    vec2 way = ahead_way(k);
    if (is_visible(way.x + 0.5 * way.y))
        visible |= 1u << uint(k);
}

/* Mixes what can be seen of this volume into the steps ahead. */
void PLUG_volume_mix_ahead(const in vec3 origin_eye, const in vec3 direction_eye) {
    uint visible = 0u;
#if HAS_LEAPS
    const int LOOKS = 8; /* then it may be time to leap again */
    float longest = sampleDistance / ray_speed;
    for (int k = ahead_start; k < ahead_end;) {
        while (k < ahead_end) {
            vec2 way = ahead_way(k);
            int leap = ahead_end - k;
            pass_clear(way.x + 0.5 * way.y, longest, leap);
            if (leap == 0)
                break;
            k += leap;
        }
        for (int end = min(k + LOOKS, ahead_end); k < end; k++)
            look_at(visible, k);
    }
#else
    for (int k = ahead_start; k < ahead_end; k++)
        look_at(visible, k);
#endif
    while (visible != 0u) {
        int k = lowest_bit(visible);
        uint bit = 1u << uint(k);
        visible ^= bit;
        vec2 way = ahead_way(k);
        vec4 color;
        VolumeSample s;
        step_color(color, s, way.x + 0.5 * way.y, way.y, origin_eye, direction_eye);
        VolumeMix mixed = VolumeMix(vec4(0.0), false);
        if ((ahead_mixed & bit) != 0u)
            mixed = VolumeMix(ahead_sums[k], (ahead_opaque & bit) != 0u);
        volume_mix_add(mixed, color, way.y * ray_speed / referenceLength);
        ahead_sums[k] = mixed.sum;
        ahead_mixed |= bit;
        if (mixed.opaque)
            ahead_opaque |= bit;
    }
}
#else
void PLUG_volume_look_ahead(inout uint visible, const in int bit, const in float t) {
    if (is_visible(t))
        visible |= 1u << uint(bit);
}
#endif
#endif

#if MIXES
#if !SKIPS
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
#endif
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
