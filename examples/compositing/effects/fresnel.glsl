/* What is seen at a grazing angle reflects more: Schlick's approximation ("An Inexpensive BRDF Model for
 * Physically-based Rendering", 1994). */

uniform vec3 rim_color = vec3(0.75, 0.9, 1.0);
uniform float at_normal = 0.04;

void PLUG_lighting_apply(inout vec4 color, const in vec4 vertex_eye, const in vec3 normal_eye) {
    float facing = clamp(dot(normalize(-vertex_eye.xyz), normal_eye), 0.0, 1.0);
    float reflected = at_normal + (1.0 - at_normal) * pow(1.0 - facing, 5.0);
    color.rgb = mix(color.rgb, rim_color, reflected);
}
