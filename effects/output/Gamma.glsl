/* The way from linear light to the picture, for materials whose colours are linear: textures hold
 * colours of displays, which answer to a number by its power of 2.2, the gamma of ITU-R BT.709's
 * and IEC 61966-2-1's curves; light is added in linear colours, and the result goes back. */

const float display_gamma = 2.2;

void PLUG_texture_decode(inout vec4 texture_color) {
    texture_color = vec4(pow(max(rgb_of(texture_color), 0.0), vec3(display_gamma)), texture_color.a);
}

void PLUG_surface_output(inout vec4 fragment_color) {
    fragment_color = vec4(linear_to_display(rgb_of(fragment_color)), fragment_color.a);
}
