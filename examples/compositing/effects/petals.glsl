/* White becomes the petals' colour, another one in every place; what is not white stays. */

varying vec3 petals;

void PLUG_main_texture_apply(inout vec4 fragment_color, const in vec3 normal_eye) {
    float white = smoothstep(0.2, 0.5, fragment_color.b);
    fragment_color.rgb = mix(fragment_color.rgb, fragment_color.rgb * petals, white);
}
