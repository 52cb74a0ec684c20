/* A material that no light changes. ISO/IEC 19775-1 V4 17.2.2: the fragment is emissive
 * colour, or the colour at the vertices. Also for shapes without any material (emissive white), and
 * for lines and points without normals, where a Material counts by its emissive colour. */

#if !HAS_COLORS
uniform vec3 emissiveColor = vec3(1.0);
#endif
uniform float transparency = 0.0;

void PLUG_surface_color(inout vec4 fragment_color) {
#if !HAS_COLORS
    fragment_color.rgb = emissiveColor;
#endif
    fragment_color.a *= 1.0 - transparency;
}
