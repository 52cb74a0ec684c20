/* Every point moves out along its normal. */
uniform float distance = 0.12;

void PLUG_vertex_object_space_change(inout vec4 vertex_object, inout vec3 normal_object) {
    vertex_object.xyz += distance * normal_object;
}
