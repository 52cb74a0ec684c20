#version 330 core
in vec4 castle_vertex_eye;
in vec3 castle_normal_eye;
uniform mat4 castle_ProjectionMatrix;
uniform vec3 plr0_diffuseColor;
uniform vec3 plr0_emissiveColor;
uniform float plr0_ambientIntensity;
uniform vec3 plr0_specularColor;
uniform float plr0_shininess;
uniform vec3 plr2_color;
uniform float plr2_intensity;
uniform float plr2_ambientIntensity;
uniform vec3 plr2_light_direction_eye;
uniform mat4 plr3_eyeToNode;
uniform vec3 plr3_color;
uniform float plr3_visibilityRange;
out vec4 plugray_FragColor;

void main() {
    vec3 normal = castle_normal_eye * inversesqrt(dot(castle_normal_eye, castle_normal_eye) + 1e-37);
    float parallel = castle_ProjectionMatrix[3][3];
    vec3 view = normalize(vec3(0.0, 0.0, parallel) - (1.0 - parallel) * castle_vertex_eye.xyz);
    vec3 light = -plr2_light_direction_eye;
    vec3 between = light + view;
    float shine = pow(max(dot(normal, between) * inversesqrt(dot(between, between)), 0.0), plr0_shininess * 128.0);
    vec3 reflected = plr0_diffuseColor * max(dot(normal, light), 0.0) + shine * plr0_specularColor;
    reflected = plr2_intensity * reflected + plr2_ambientIntensity * (plr0_ambientIntensity * plr0_diffuseColor);
    float far = length((plr3_eyeToNode * vec4(castle_vertex_eye.xyz, 0.0)).xyz);
    vec3 color = mix(plr3_color, plr2_color * reflected + plr0_emissiveColor,
                     max(1.0 - far / plr3_visibilityRange, 0.0));
    plugray_FragColor = vec4(color, 1.0);
}
