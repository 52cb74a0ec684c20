/* Texture coordinates from places and normals at the vertices. ISO/IEC 19775-1 V4 18.4.8, table 18.6; the
 * modes of world space are an extension. Modes that reflect are made again for each fragment
 * (TextureCoordinateGenerator.glsl); what is not known is COORD. Object space is that of the geometry's
 * own coordinates: a texture sticks to vertices that an effect moves. */

#ifdef VERTICES
#if defined(mode_SPHERE) || defined(mode_CAMERASPACENORMAL) || defined(mode_WORLDSPACENORMAL)
void PLUG_texture_coord_generate(inout vec4 tex_coord, const in vec4 vertex_eye, const in vec3 normal_eye) {
#ifdef mode_SPHERE
    tex_coord = vec4(0.5 * normal_eye.xy + 0.5, 0.0, 1.0);
#elif defined(mode_WORLDSPACENORMAL)
    tex_coord = vec4(direction_eye_to_world_space(normal_eye), 1.0);
#else
    tex_coord = vec4(normal_eye, 1.0);
#endif
}
#elif defined(mode_CAMERASPACEREFLECTIONVECTOR) || defined(mode_WORLDSPACEREFLECTIONVECTOR) ||           \
    defined(mode_SPHERE_REFLECT)
uniform float parameter[1] = float[1](0.0);

void PLUG_texture_coord_generate(inout vec4 tex_coord, const in vec4 vertex_eye, const in vec3 normal_eye) {
    vec3 seen = -direction_to_viewer(vertex_eye);
#ifdef mode_SPHERE_REFLECT
    tex_coord = vec4(bent_direction(seen, normal_eye, parameter[0]), 1.0);
#elif defined(mode_WORLDSPACEREFLECTIONVECTOR)
    tex_coord = vec4(direction_eye_to_world_space(reflect(seen, normal_eye)), 1.0);
#else
    tex_coord = vec4(reflect(seen, normal_eye), 1.0);
#endif
}
#elif defined(mode_CAMERASPACEPOSITION) || defined(mode_COORD_EYE) || defined(mode_NOISE_EYE)
uniform float parameter[6] = float[6](1.0, 1.0, 1.0, 0.0, 0.0, 0.0);

void PLUG_texture_coord_generate(inout vec4 tex_coord, const in vec4 vertex_eye) {
    tex_coord = vec4(vertex_eye.xyz / vertex_eye.w, 1.0);
#ifdef mode_NOISE_EYE
    tex_coord.stp = solid_noise_vector(scaled_and_moved(tex_coord.stp, parameter));
#endif
}
#else
#ifdef mode_SPHERE_REFLECT_LOCAL
uniform float parameter[4] = float[4](0.0, 0.0, 0.0, 0.0);
#else
uniform float parameter[6] = float[6](1.0, 1.0, 1.0, 0.0, 0.0, 0.0);
#endif

void PLUG_texture_coord_generate(inout vec4 tex_coord) {
#ifdef mode_SPHERE_LOCAL
    tex_coord = vec4(0.5 * castle_Normal.xy + 0.5, 0.0, 1.0);
#elif defined(mode_SPHERE_REFLECT_LOCAL)
    vec3 eye = vec3(parameter[1], parameter[2], parameter[3]);
    vec3 seen = unit_or_zero(castle_Vertex.xyz - eye);
    tex_coord = vec4(bent_direction(seen, castle_Normal, parameter[0]), 1.0);
#elif defined(mode_NOISE)
    tex_coord = vec4(solid_noise_vector(scaled_and_moved(castle_Vertex.xyz, parameter)), 1.0);
#elif !defined(mode_BOUNDS) && !defined(mode_BOUNDS2D) && !defined(mode_BOUNDS3D)
    tex_coord = vec4(castle_Vertex.xyz, 1.0);
#endif
}
#endif
#endif
