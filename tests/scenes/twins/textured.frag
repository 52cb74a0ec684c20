#version 330 core
in vec4 castle_vertex_eye;
in vec3 castle_normal_eye;
in vec4 castle_TexCoord0;
uniform mat4 castle_ProjectionMatrix;
uniform vec3 plr0_diffuseColor;
uniform vec3 plr0_emissiveColor;
uniform float plr0_ambientIntensity;
uniform vec3 plr0_specularColor;
uniform float plr0_shininess;
uniform sampler2D plr2_self;
uniform vec3 plr3_color;
uniform float plr3_intensity;
uniform float plr3_ambientIntensity;
uniform vec3 plr3_light_direction_eye;
uniform float plr4_lengthToNode;
uniform vec3 plr4_color;
uniform float plr4_intensity;
uniform float plr4_ambientIntensity;
uniform vec3 plr4_attenuation;
uniform float plr4_radius;
uniform vec3 plr4_light_location_eye;
out vec4 plugray_FragColor;

void main() {
    vec3 normal = castle_normal_eye * inversesqrt(dot(castle_normal_eye, castle_normal_eye) + 1e-37);
    float parallel = castle_ProjectionMatrix[3][3];
    vec3 view = normalize(vec3(0.0, 0.0, parallel) - (1.0 - parallel) * castle_vertex_eye.xyz);
    vec3 diffuse = plr0_diffuseColor * texture(plr2_self, castle_TexCoord0.st).rgb;
    vec3 ambient = plr0_ambientIntensity * diffuse;
    float shininess = plr0_shininess * 128.0;

    // the sun
    vec3 light = -plr3_light_direction_eye;
    vec3 between = light + view;
    float shine = pow(max(dot(normal, between) * inversesqrt(dot(between, between)), 0.0), shininess);
    vec3 reflected = diffuse * max(dot(normal, light), 0.0) + shine * plr0_specularColor;
    vec3 sum = plr3_color * (plr3_intensity * reflected + plr3_ambientIntensity * ambient);

    // the lamp
    vec3 way = plr4_light_location_eye - castle_vertex_eye.xyz;
    float far = length(way);
    light = way / far;
    between = light + view;
    shine = pow(max(dot(normal, between) * inversesqrt(dot(between, between)), 0.0), shininess);
    reflected = diffuse * max(dot(normal, light), 0.0) + shine * plr0_specularColor;
    float d = plr4_lengthToNode * far;
    float weakening = max(plr4_attenuation.x + (plr4_attenuation.y + plr4_attenuation.z * d) * d, 1.0);
    float scale = d > plr4_radius ? 0.0 : 1.0 / weakening;
    sum += scale * plr4_color * (plr4_intensity * reflected + plr4_ambientIntensity * ambient);

    plugray_FragColor = vec4(sum + plr0_emissiveColor, 1.0);
}
