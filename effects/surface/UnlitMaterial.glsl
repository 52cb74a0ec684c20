/* A material that no light changes. ISO/IEC 19775-1 V4 17.2.2: the fragment is emissive
 * colour, or the colour at the vertices. Also for shapes without any material (emissive white), and
 * for lines and points without normals, where a Material counts by its emissive colour. */

#if !HAS_COLORS || COLORS_MODULATE
uniform vec3 emissiveColor = vec3(1.0);
#endif
uniform float transparency = 0.0;

void PLUG_surface_color(inout vec4 fragment_color) {
#if !HAS_COLORS || COLORS_MODULATE
    vec3 color = emissiveColor;
#else
    vec3 color = vec3(1.0);
#endif
    float clear = transparency;
    /* PLUG: material_back_color (color, clear) */
    fragment_color = vec4(color, 1.0 - clear);
}
