/* Darker towards the border of the picture: the viewport's size is at hand. */
void PLUG_fog_apply(inout vec4 fragment_color, const vec3 normal_eye) {
    vec2 place = gl_FragCoord.xy / plugray_ViewportSize - 0.5;
    fragment_color.rgb *= 1.0 - 1.2 * dot(place, place);
}
