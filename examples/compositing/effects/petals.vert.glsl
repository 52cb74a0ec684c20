varying vec3 petals;

void PLUG_vertex_object_space(const in vec4 vertex_object, inout vec3 normal_object) {
    vec2 root = plugray_ModelMatrix[3].xz;
    float hue = fract(sin(dot(root, vec2(12.9898, 78.233))) * 43758.5453);
    petals = hue < 0.45 ? vec3(0.92, 0.12, 0.10) : hue < 0.7 ? vec3(0.98, 0.80, 0.15) : hue < 0.85 ? vec3(0.55, 0.25, 0.85) : vec3(1.0);
}
