/* Flowers in the wind: what stands higher bends further, and the gust that bends a flower depends on where it
 * stands in the world. Nothing but this function moves: thousands of flowers cost no work outside the GPU. */

uniform float time = 0.0;
uniform float strength = 0.35;

void PLUG_vertex_object_space_change(inout vec4 vertex_object, inout vec3 normal_object) {
    vec3 root = plugray_ModelMatrix[3].xyz;
    float gust = sin(1.7 * time + 0.9 * root.x + 0.6 * root.z) + 0.5 * sin(4.3 * time + 5.0 * root.z + 3.0 * root.x);
    float angle = strength * (0.7 + 0.6 * gust) * vertex_object.y;
    float c = cos(angle), s = sin(angle);
    vertex_object.xy = vec2(c * vertex_object.x + s * vertex_object.y, c * vertex_object.y - s * vertex_object.x);
    normal_object.xy = vec2(c * normal_object.x + s * normal_object.y, c * normal_object.y - s * normal_object.x);
}
