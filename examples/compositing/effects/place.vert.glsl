/* For fragment parts that ask where in the object they are. */
varying vec3 place_object;

void PLUG_vertex_object_space(const in vec4 vertex_object, inout vec3 normal_object) {
    place_object = vertex_object.xyz;
}
