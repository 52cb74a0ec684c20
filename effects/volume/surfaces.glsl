/* A volume of which surfaces of equal value are drawn: each crossing is an event along the ray, whose
 * alpha is the opacity of one crossing. ISO/IEC 19775-1 V4 41.4.3, IsoSurfaceVolumeData. A unit of
 * Volume.glsl's effect, beside levels.glsl and crossings.glsl. */

const float UNKNOWN = -NOWHERE;
float event_t = NOWHERE; /* the next, UNKNOWN before it is looked for */
#if PLUG_USED(volume_sample)
vec3 way_origin_eye;
vec3 way_direction_eye;
#endif

float value_at(const in float t) {
#if PLUG_USED(volume_sample)
    VolumeSample s;
    sample_at(s, t, 0.0, way_origin_eye, way_direction_eye);
    return voxel_scalar(s.value);
#else
    return scalar_at(ray_origin + t * ray_direction);
#endif
}

void ray_begins(const in vec3 origin_eye, const in vec3 direction_eye) {
#if PLUG_USED(volume_sample)
    way_origin_eye = origin_eye;
    way_direction_eye = direction_eye;
#endif
}

void PLUG_volume_look(const in float from, const in float to, const in vec3 origin_eye,
                      const in vec3 direction_eye) {
    if (!(from == enter && enter < leave))
        return;
    begin_way(enter, leave);
    event_t = UNKNOWN;
}

void PLUG_volume_event(inout float t) {
    if (event_t == UNKNOWN)
        event_t = next_crossing(sampleDistance / ray_speed);
    t = min(t, event_t);
}

/* One volume meets the ray at a time, though others may have an event at the same place. */
void PLUG_volume_meet(inout bool met, inout vec4 color, inout VolumeSample s, const in float t,
                      const in vec3 origin_eye, const in vec3 direction_eye) {
    if (met || event_t != t)
        return;
    met = true;
#if PICKS
    met_volume = volumeIndex;
    met_surface = int(surfaces[event_surface].y);
#endif
    sample_at(s, t, 0.0, origin_eye, direction_eye);
    surface_sample(s, ray_origin + t * ray_direction, event_surface);
    color = voxel_color(s.value);
    style_sample(color, s);
    event_t = UNKNOWN;
}
