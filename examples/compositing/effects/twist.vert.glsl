/* The object turns more the higher it is; its normals turn with it. */
uniform float angle = 1.0;

void PLUG_vertex_object_space_change(inout vec4 vertex_object, inout vec3 normal_object) {
    float a = angle * vertex_object.y, c = cos(a), s = sin(a);
    mat3 turn = mat3(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c);
    vertex_object.xyz = turn * vertex_object.xyz;
    normal_object = turn * normal_object;
}
