#version 330 core
/* The surface base, vertex stage: object space, eye space, clip space. What the fragment stage does
 * not ask for is neither read nor handed on. */

/* PLUG-DECLARATIONS */

out vec4 castle_vertex_eye;
out vec3 castle_normal_eye;

void main() {
    vec4 vertex_object = castle_Vertex;
#if PLUG_USED(vertex_object_space_change) || PLUG_USED(vertex_object_space) ||                      \
    PLUG_USED(vertex_eye_space) || PLUG_USED(vertex_eye_space_extended) || READS(castle_normal_eye)
    vec3 normal_object = castle_Normal;
#endif
    /* PLUG: vertex_object_space_change (vertex_object, normal_object) */
    /* PLUG: vertex_object_space (vertex_object, normal_object) */

    vec4 vertex_eye = castle_ModelViewMatrix * vertex_object;
#if PLUG_USED(vertex_eye_space) || PLUG_USED(vertex_eye_space_extended) || READS(castle_normal_eye)
    vec3 normal_eye = unit_or_zero(castle_NormalMatrix * normal_object);
#endif
    /* PLUG: vertex_attributes () */
    /* PLUG: vertex_place (vertex_eye) */
    /* PLUG: vertex_eye_space (vertex_eye, normal_eye) */
    /* PLUG: vertex_eye_space_extended (vertex_eye, normal_eye, normal_object) */

#if READS(castle_vertex_eye)
#if PROJECTIVE || PLUG_USED(vertex_object_space_change) || PLUG_USED(vertex_object_space) ||        \
    PLUG_USED(vertex_eye_space) || PLUG_USED(vertex_eye_space_extended)
    castle_vertex_eye = vertex_eye / vertex_eye.w;
#else
    castle_vertex_eye = vertex_eye; /* its last component is 1 */
#endif
#endif
#if READS(castle_normal_eye)
    castle_normal_eye = normal_eye;
#endif
    gl_Position = castle_ProjectionMatrix * vertex_eye;
}
