/* Hue, saturation and value, each from 0 to 1. Smith 1978, "Color gamut transform pairs", hexcone. */

/* The hue of a grey is 0. */
vec3 rgb_to_hsv(vec3 c) {
    float value = max(c.r, max(c.g, c.b));
    float chroma = value - min(c.r, min(c.g, c.b));
    if (!(chroma > 0.0))
        return vec3(0.0, 0.0, value);
    float hue = value == c.r   ? (c.g - c.b) / chroma
                : value == c.g ? (c.b - c.r) / chroma + 2.0
                               : (c.r - c.g) / chroma + 4.0;
    return vec3(fract(hue / 6.0), chroma / value, value);
}

vec3 hsv_to_rgb(vec3 hsv) {
    vec3 ramp = abs(fract(hsv.x + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0;
    return hsv.z * mix(vec3(1.0), clamp(ramp, 0.0, 1.0), hsv.y);
}

/* From a to b. The hue goes the shorter way round, upwards where both ways are equally long; a grey has
 * none and takes the other's. */
vec3 mix_in_hsv(vec3 a, vec3 b, float share) {
    vec3 from = rgb_to_hsv(a), to = rgb_to_hsv(b);
    if (from.y == 0.0)
        from.x = to.x;
    if (to.y == 0.0)
        to.x = from.x;
    float way = to.x - from.x;
    way -= way > 0.5 ? 1.0 : way <= -0.5 ? -1.0 : 0.0;
    return hsv_to_rgb(vec3(from.x + share * way, mix(from.yz, to.yz, share)));
}
