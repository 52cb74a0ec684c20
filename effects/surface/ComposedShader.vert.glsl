/* Makes texture coordinates where a complete shader knows the vertex in eye space. */

void PLUG_vertex_eye_space(const in vec4 vertex_eye, const in vec3 normal_eye) {
    /* PLUG: vertex_attributes () */
    /* PLUG: vertex_place (vertex_eye) */
}
