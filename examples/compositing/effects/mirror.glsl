/* What a cube map shows in the direction of the reflected and of the refracted ray; how much of each, by
 * Schlick's approximation (1994). */

uniform samplerCube surroundings;
uniform vec3 depth_color = vec3(0.02, 0.12, 0.14);

void PLUG_lighting_apply(inout vec4 color, const in vec4 vertex_eye, const in vec3 normal_eye) {
    vec3 from_eye = normalize(vertex_eye.xyz);
    vec3 up = dot(from_eye, normal_eye) < 0.0 ? normal_eye : reflect(normal_eye, from_eye);
    float reflected = 0.02 + 0.98 * pow(1.0 - max(dot(-from_eye, up), 0.0), 5.0);
    mat3 to_world = mat3(plugray_InverseViewMatrix);
    vec3 sky = textureCube(surroundings, to_world * reflect(from_eye, up)).rgb;
    vec3 ground = textureCube(surroundings, to_world * refract(from_eye, up, 1.0 / 1.33)).rgb;
    color.rgb = color.rgb * 0.35 + mix(mix(depth_color, ground, 0.35), sky, reflected);
}
