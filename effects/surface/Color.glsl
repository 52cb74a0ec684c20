/* Colours at the vertices. ISO/IEC 19775-1 V4 11.4.2 and 17.2.2: they stand for the material's
 * diffuse, base or emissive colour; those of ColorRGBA for its transparency too. The extension
 * mode "MODULATE" multiplies instead. */

in vec4 vertex_color;

void PLUG_surface_color(inout vec4 fragment_color) {
#if COLORS_MODULATE
    fragment_color *= vertex_color;
#elif WITH_ALPHA
    fragment_color = vertex_color;
#else
    fragment_color.rgb = vertex_color.rgb;
#endif
}
