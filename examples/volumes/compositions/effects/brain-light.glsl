/* A lamp at the viewer's head for a volume whose segments are not lit, and a box cut out of it. */

uniform vec3 corner = vec3(0.5, 0.52, 0.5); /* of the box, which reaches to 0 1 1; texture coordinates */

float outside_box(const in vec3 position) {
    vec3 inside = vec3(corner.x - position.x, position.yz - corner.yz);
    return -min(inside.x, min(inside.y, inside.z));
}

void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {
    if (outside_box(s.position) < 0.0)
        color.a = 0.0;
}

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    if (outside_box(s.position) < 0.01) {
        color.rgb *= 0.35 + 1.3 * s.value.r; /* on the cut: the scan itself */
    } else if (s.normal_eye != vec3(0.0)) {
        vec3 light = normalize(vec3(-0.3, 0.5, 1.0));
        color.rgb *= 0.3 + 0.8 * max(dot(s.normal_eye, light), 0.0);
    }
}
