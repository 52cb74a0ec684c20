/* Dots of a printed page: their size is the brightness. */
uniform float cell = 5.0; /* pixels */

void PLUG_fragment_modify(inout vec4 fragment_color) {
    vec2 place = fract(mat2(0.8, 0.6, -0.6, 0.8) * gl_FragCoord.xy / cell) - 0.5;
    float brightness = clamp(dot(fragment_color.rgb, vec3(0.2126, 0.7152, 0.0722)), 0.0, 1.0);
    fragment_color.rgb *= length(place) < 0.71 * sqrt(brightness) ? 1.25 : 0.35;
}
