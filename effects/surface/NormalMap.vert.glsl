/* See NormalMap.glsl. Tangents are given only where an effect asks for them. */

#if PLUG_USED(tangent_object_space)
out vec4 tangent_eye;
#endif

void PLUG_vertex_eye_space_extended(const in vec4 vertex_eye, const in vec3 normal_eye,
                                    const in vec3 normal_object) {
#if PLUG_USED(tangent_object_space)
    vec4 tangent_object = castle_Tangent;
#endif
    /* PLUG: tangent_object_space (tangent_object) */
#if PLUG_USED(tangent_object_space)
    tangent_eye = vec4(mat3(castle_ModelViewMatrix) * tangent_object.xyz, tangent_object.w);
#endif
}
