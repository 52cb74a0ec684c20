/* What is far turns blue, as in the air of a landscape. */
uniform vec3 air = vec3(0.35, 0.5, 0.8);
uniform float start = 3.0;
varying float distance_eye;

void PLUG_fog_apply(inout vec4 fragment_color, const vec3 normal_eye) {
    fragment_color.rgb = mix(fragment_color.rgb, air, clamp((distance_eye - start) / 6.0, 0.0, 0.5));
}
