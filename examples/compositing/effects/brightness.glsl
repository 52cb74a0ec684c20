/* The first effect that one writes: two times brighter. */
void PLUG_main_texture_apply(inout vec4 fragment_color, const in vec3 normal_eye) {
    fragment_color.rgb *= 2.0;
}
