/* Patterns along lines: ISO/IEC 19775-1 V4 12.4.4 names them; their lengths are in pixels of a line of
 * nominal width, and grow with it. */

uniform int linetype = 1;
uniform float linewidthScaleFactor = 0.0;

in float line_distance;

/* Whether the pattern, 16 long, is drawn there. */
bool is_drawn(float place) {
    float at = mod(place, 16.0);
    if (linetype == 3) /* dotted */
        return mod(place, 4.0) < 2.0;
    if (linetype == 4) /* dash, dot */
        return at < 8.0 || (at >= 11.0 && at < 13.0);
    if (linetype == 5) /* dash, dot, dot */
        return at < 7.0 || (at >= 9.0 && at < 11.0) || (at >= 13.0 && at < 15.0);
    return at < 10.0; /* dashed */
}

void PLUG_fragment_end(const in vec4 fragment_color) {
    /* how far along the line it is from one pixel to the next */
    float pixel = length(vec2(dFdx(line_distance), dFdy(line_distance)));
    float place = line_distance / max(pixel * max(linewidthScaleFactor, 1.0), 1e-30);
    if (!is_drawn(place))
        discard;
}
