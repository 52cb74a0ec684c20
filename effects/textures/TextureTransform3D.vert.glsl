/* ISO/IEC 19775-1 V4 33.4.5, TextureTransform3D. */

#ifdef VERTICES
uniform vec3 translation = vec3(0.0);
uniform vec3 center = vec3(0.0);
uniform vec4 rotation = vec4(0.0, 0.0, 1.0, 0.0);
uniform vec3 scale = vec3(1.0);

void PLUG_texture_coord_transform(inout vec4 tex_coord) {
    tex_coord.stp = transformed_tex_coord(tex_coord, translation, center, rotation, scale);
}
#endif
