varying float height;
varying float steepness;

void PLUG_vertex_object_space(const in vec4 vertex_object, inout vec3 normal_object) {
    height = vertex_object.y;
    steepness = 1.0 - normalize(normal_object).y;
}
