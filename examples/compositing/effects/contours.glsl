/* Lines of equal height, as on a map, one pixel wide at any distance. */
uniform float lines = 6.0; /* in a unit of height */

varying vec3 place_object;

void PLUG_fragment_modify(inout vec4 fragment_color) {
    float level = lines * place_object.y;
    float line = abs(fract(level - 0.5) - 0.5) / fwidth(level);
    fragment_color.rgb *= 0.25 + 0.75 * clamp(line - 0.25, 0.0, 1.0);
}
