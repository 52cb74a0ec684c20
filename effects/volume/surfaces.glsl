/* A volume of which surfaces of equal value are drawn: each crossing is an event along the ray, whose
 * alpha is the opacity of one crossing. ISO/IEC 19775-1 V4 41.4.3, IsoSurfaceVolumeData. A unit of
 * Volume.glsl's effect, beside levels.glsl.
 *
 * In a step the value at both ends tells how many surfaces lie between; each is then found where the
 * field itself crosses it, in the order in which the ray meets them. */

float look_end = -NOWHERE; /* where the last step ended, and the value there */
float look_value;
float bracket_start; /* what is left of the step ends at look_end; the value at its start */
float bracket_value;
int surfaces_below;  /* at the start of the bracket, and at its end */
int surfaces_to;
int event_surface;
float event_t;

void ray_begins(const in vec3 origin_eye, const in vec3 direction_eye) {
}

float value_at(const in float t, const in vec3 origin_eye, const in vec3 direction_eye) {
#if PLUG_USED(volume_sample)
    VolumeSample s;
    sample_at(s, t, 0.0, origin_eye, direction_eye);
    return voxel_scalar(s.value);
#else
    return scalar_at(ray_origin + t * ray_direction);
#endif
}

/* Where the field has this value, between two places on its two sides: the Illinois method (Dowell and
 * Jarratt, BIT 11, 1971), which never leaves the bracket. */
float find_crossing(const in float value, const in vec3 origin_eye, const in vec3 direction_eye) {
    float a = bracket_start, b = look_end;
    float fa = bracket_value - value, fb = look_value - value;
    for (int i = 0; i < 12 && fa != fb && abs(b - a) > 1.0e-6 * abs(b); i++) {
        float c = b - fb * (b - a) / (fb - fa);
        float fc = value_at(c, origin_eye, direction_eye) - value;
        if ((fc < 0.0) != (fb < 0.0)) {
            a = b;
            fa = fb;
        } else {
            fa *= 0.5;
        }
        b = c;
        fb = fc;
    }
    return b;
}

/* The next surface between bracket_start and look_end. */
void find_event(const in vec3 origin_eye, const in vec3 direction_eye) {
    event_t = NOWHERE;
    while (surfaces_below != surfaces_to && event_t == NOWHERE) {
        bool up = surfaces_below < surfaces_to;
        event_surface = up ? surfaces_below : surfaces_below - 1;
        surfaces_below += up ? 1 : -1;
        float value = surfaces[event_surface].x;
        float t = find_crossing(value, origin_eye, direction_eye);
        if (is_steep(ray_origin + t * ray_direction))
            event_t = t;
        bracket_start = t; /* what follows lies behind */
        bracket_value = value;
    }
}

void PLUG_volume_look(const in float from, const in float to, const in vec3 origin_eye,
                      const in vec3 direction_eye) {
    event_t = NOWHERE;
    if (!(enter <= from && from < leave))
        return;
    bracket_start = from;
    bracket_value = look_end == from ? look_value : value_at(from, origin_eye, direction_eye);
    look_end = to;
    look_value = value_at(to, origin_eye, direction_eye);
    surfaces_below = count_below(bracket_value);
    surfaces_to = count_below(look_value);
    find_event(origin_eye, direction_eye);
}

void PLUG_volume_event(inout float t) {
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
    find_event(origin_eye, direction_eye);
}
