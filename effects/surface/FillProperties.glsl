/* Hatching: ISO/IEC 19775-1 V4 12.4.3. Lines of one pixel, eight apart, on the screen; hatchStyle 1 to 6 of the
 * registry of ISO/IEC 9973: horizontal, vertical, rising, falling, crossed, crossed diagonally. They have
 * hatchColor, unlit. Without `filled` nothing is seen between them. */

uniform vec3 hatchColor = vec3(1.0);
uniform int hatchStyle = 1;

bool is_line(float place) {
    return mod(floor(place), 8.0) == 0.0;
}

bool is_hatched() {
#if hatched
    vec2 p = gl_FragCoord.xy - 0.5;
    bool level = is_line(p.y), upright = is_line(p.x);
    bool rising = is_line(p.y - p.x), falling = is_line(p.y + p.x);
    return hatchStyle == 2   ? upright
           : hatchStyle == 3 ? rising
           : hatchStyle == 4 ? falling
           : hatchStyle == 5 ? level || upright
           : hatchStyle == 6 ? rising || falling
                             : level;
#else
    return false;
#endif
}

#if hatched
void PLUG_fragment_modify(inout vec4 fragment_color) {
    if (is_hatched())
        fragment_color.rgb = hatchColor;
}
#endif

#if !filled
void PLUG_fragment_end(const in vec4 fragment_color) {
    if (!is_hatched())
        discard;
}
#endif
