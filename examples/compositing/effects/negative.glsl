/* What is bright gets dark. */
void PLUG_fragment_modify(inout vec4 fragment_color) {
    fragment_color.rgb = 1.0 - clamp(fragment_color.rgb, 0.0, 1.0);
}
