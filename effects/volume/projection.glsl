/* A volume of which the ray takes one intensity: the greatest, the least or the mean. ISO/IEC 19775-1 V4
 * 41.4.9, ProjectionVolumeStyle. One layer (I, I, I, alpha), met where the intensity was found, or at
 * the entry for the mean. A unit of Volume.glsl's effect.
 *
 * The intensity is the mean of the voxel's colour components; alpha is the voxel's own, 1 if it has none.
 * Both ends of the ray are sampled; the mean is the integral over its length (trapezoids). */

#if !defined(renderStyle_type_AVERAGE) && !defined(renderStyle_type_MIN)
uniform float renderStyle_intensityThreshold = 0.0;
#endif

float event_t = NOWHERE;
float intensity;
float intensity_alpha;

float own_alpha(const in vec4 value) {
#if voxels_COMPONENTS == 2
    return value.g;
#elif voxels_COMPONENTS == 4
    return value.a;
#else
    return 1.0;
#endif
}

vec4 value_on_ray(const in float t, const in float span, const in vec3 origin_eye,
                  const in vec3 direction_eye) {
#if PLUG_USED(volume_sample)
    VolumeSample s;
    sample_at(s, t, span, origin_eye, direction_eye);
    return s.value;
#else
    return voxel_at(ray_origin + t * ray_direction);
#endif
}

#if !defined(renderStyle_type_AVERAGE)
/* A peak lies between samples as a rule: golden section search between the neighbours of the best one
 * (Kiefer, Proc. AMS 4, 1953). */
void refine(const in float span, const in vec3 origin_eye, const in vec3 direction_eye) {
    const float GOLDEN = 0.61803399;
    float a = max(event_t - span, enter), b = min(event_t + span, leave);
    for (int i = 0; i < 10; i++) {
        float c = b - GOLDEN * (b - a), d = a + GOLDEN * (b - a);
        vec4 at_c = value_on_ray(c, span, origin_eye, direction_eye);
        vec4 at_d = value_on_ray(d, span, origin_eye, direction_eye);
        float here = voxel_scalar(at_c), there = voxel_scalar(at_d);
#if defined(renderStyle_type_MIN)
        bool first = here < there;
        bool better = min(here, there) < intensity;
#else
        bool first = here > there;
        bool better = max(here, there) > intensity;
#endif
        if (better) {
            intensity = first ? here : there;
            intensity_alpha = own_alpha(first ? at_c : at_d);
            event_t = first ? c : d;
        }
        if (first)
            b = d;
        else
            a = c;
    }
}
#endif

void ray_begins(const in vec3 origin_eye, const in vec3 direction_eye) {
    event_t = NOWHERE;
    if (!(enter <= leave))
        return;
    if (leave == 0.0) { /* the eye is on the box and looks away from it */
        leave = -1.0;
        return;
    }
    int count = max(step_count(leave - enter, sampleDistance / ray_speed), 1);
    float span = (leave - enter) / float(count);
#if defined(renderStyle_type_AVERAGE)
    intensity = 0.0;
    intensity_alpha = 0.0;
    event_t = enter;
#else
    intensity = NOWHERE;
    float before = -NOWHERE, before_alpha = 0.0, before_t = enter;
#endif
    for (int i = 0; i <= count; i++) {
        float t = i == count ? leave : enter + float(i) * span;
        vec4 value = value_on_ray(t, span, origin_eye, direction_eye);
        float here = voxel_scalar(value), alpha = own_alpha(value);
#if defined(renderStyle_type_AVERAGE)
        float weight = (i == 0 || i == count ? 0.5 : 1.0) / float(count);
        intensity += weight * here;
        intensity_alpha += weight * alpha;
#else
#if !defined(renderStyle_type_MIN)
        /* the first local maximum above the threshold (LMIP; Sato et al., TVCG 4(2), 1998) */
        if (renderStyle_intensityThreshold > 0.0 && before > renderStyle_intensityThreshold &&
            here < before) {
            intensity = before;
            intensity_alpha = before_alpha;
            event_t = before_t;
            break;
        }
#endif
#if defined(renderStyle_type_MIN)
        bool better = here < intensity;
#else
        bool better = intensity == NOWHERE || here > intensity;
#endif
        if (better) {
            intensity = here;
            intensity_alpha = alpha;
            event_t = t;
        }
        before = here;
        before_alpha = alpha;
        before_t = t;
#endif
    }
#if defined(renderStyle_type_AVERAGE)
    /* weights in floats may add up to more than 1 */
    intensity = min(intensity, 1.0);
    intensity_alpha = min(intensity_alpha, 1.0);
#else
    refine(span, origin_eye, direction_eye);
#endif
#if HAS_PARTS
    if (event_t < part_start || event_t >= part_end) {
        event_t = NOWHERE;
        enter = leave = 0.0;
        return;
    }
#endif
    /* the ray meets the layer where it was found and nothing of the volume elsewhere */
    enter = event_t;
    leave = enter + max(1.0e-6 * abs(enter), 1.0e-3 * sampleDistance / ray_speed);
}

void PLUG_volume_look(const in float from, const in float to, const in vec3 origin_eye,
                      const in vec3 direction_eye) {
}

void PLUG_volume_event(inout float t) {
    t = min(t, event_t);
}

void PLUG_volume_meet(inout bool met, inout vec4 color, inout VolumeSample s, const in float t,
                      const in vec3 origin_eye, const in vec3 direction_eye) {
    if (met || event_t != t)
        return;
    met = true;
#if PICKS
    met_volume = volumeIndex;
#endif
    event_t = NOWHERE;
    sample_at(s, t, 0.0, origin_eye, direction_eye);
    color = vec4(vec3(intensity), intensity_alpha);
    style_sample(color, s);
}
