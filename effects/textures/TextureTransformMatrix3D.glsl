/* ISO/IEC 19775-1 V4 33.4.6, TextureTransformMatrix3D, for coordinates that are made for each
 * fragment. */

#ifdef FRAGMENTS
uniform mat4 matrix = mat4(1.0);

void PLUG_texture_coord_transform(inout vec4 tex_coord) {
    tex_coord = matrix * tex_coord;
}
#endif
