/* The modes that reflect, for each fragment: directions between vertices are exact, and normals may have
 * been changed by effects. ISO/IEC 19775-1 V4 18.4.8: R = 2 (E.N) N - E with E to the viewer, which is
 * reflect(-E, N). */

#ifdef FRAGMENTS
#ifdef mode_SPHERE_REFLECT
uniform float parameter[1] = float[1](0.0);
#endif

void PLUG_texture_coord_reflect(inout vec4 tex_coord, const in vec4 vertex_eye, const in vec3 normal_eye) {
    vec3 seen = -direction_to_viewer(vertex_eye);
#ifdef mode_SPHERE_REFLECT
    tex_coord = vec4(bent_direction(seen, normal_eye, parameter[0]), 1.0);
#elif defined(mode_WORLDSPACEREFLECTIONVECTOR)
    tex_coord = vec4(direction_eye_to_world_space(reflect(seen, normal_eye)), 1.0);
#else
    tex_coord = vec4(reflect(seen, normal_eye), 1.0);
#endif
}
#endif
