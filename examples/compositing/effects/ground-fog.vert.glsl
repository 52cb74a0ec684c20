varying vec4 place_eye;

void PLUG_vertex_eye_space(const in vec4 vertex_eye, const in vec3 normal_eye) {
    place_eye = vertex_eye;
}
