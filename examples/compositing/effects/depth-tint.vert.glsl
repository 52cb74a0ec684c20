varying float distance_eye;

void PLUG_vertex_eye_space(const in vec4 vertex_eye, const in vec3 normal_eye) {
    distance_eye = length(vertex_eye.xyz);
}
