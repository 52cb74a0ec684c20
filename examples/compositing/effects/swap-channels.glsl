/* On every texture of the shape: red and blue change places. */
void PLUG_texture_color(inout vec4 texture_color, const in vec4 tex_coord) {
    texture_color.rgb = texture_color.bgr;
}
