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
uniform float plr3_bands;
uniform vec3 plr4_tint;
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
    vec4 color = vec4(plr2_color * (plr3_bands * abs(normal.x)) * reflected + plr0_emissiveColor, 1.0);
    color.rgb = mix(color.rgb, plr4_tint, color.g); // as the author has it
    plugray_FragColor = color;
}
