/* The texture moves over the surface. */
uniform vec2 offset = vec2(0.25, 0.0);

void PLUG_texture_coord_shift(inout vec2 tex_coord) {
    tex_coord += offset;
}
