#version 330 core
in vec4 castle_vertex_eye;
in vec3 castle_normal_eye;
uniform mat4 castle_ProjectionMatrix;
uniform vec3 plr0_baseColor;
uniform vec3 plr0_emissiveColor;
uniform float plr0_metallic;
uniform float plr0_roughness;
uniform float plr2_lengthToNode;
uniform vec3 plr2_color;
uniform float plr2_intensity;
uniform vec3 plr2_attenuation;
uniform float plr2_radius;
uniform vec3 plr2_light_location_eye;
out vec4 plugray_FragColor;

void main() {
    vec3 normal = castle_normal_eye * inversesqrt(dot(castle_normal_eye, castle_normal_eye) + 1e-37);
    float metal = clamp(plr0_metallic, 0.0, 1.0);
    float rough = clamp(plr0_roughness, 0.0, 1.0);
    float alpha = max(rough * rough, 0.001);
    vec3 way = plr2_light_location_eye - castle_vertex_eye.xyz;
    float far = length(way);
    vec3 light = way / far;
    float d = plr2_lengthToNode * far;
    float weakening = max(plr2_attenuation.x + (plr2_attenuation.y + plr2_attenuation.z * d) * d, 1.0);
    float scale = d > plr2_radius ? 0.0 : 1.0 / weakening;
    float n_dot_l = dot(normal, light);
    vec3 reflected = vec3(0.0);
    if (n_dot_l > 0.0) {
        float parallel = castle_ProjectionMatrix[3][3];
        vec3 view = normalize(vec3(0.0, 0.0, parallel) - (1.0 - parallel) * castle_vertex_eye.xyz);
        vec3 between = normalize(light + view);
        float n_dot_v = abs(dot(normal, view)), n_dot_h = max(dot(normal, between), 0.0);
        float v_dot_h = dot(view, between);
        float a2 = alpha * alpha;
        float spread = n_dot_h * n_dot_h * (a2 - 1.0) + 1.0;
        float many = a2 / (3.14159265358979 * spread * spread);
        float seen = 1.0 / ((n_dot_l + sqrt(a2 + (1.0 - a2) * n_dot_l * n_dot_l)) *
                            (n_dot_v + sqrt(a2 + (1.0 - a2) * n_dot_v * n_dot_v)));
        float x = 1.0 - v_dot_h, x2 = x * x;
        vec3 specular = mix(vec3(0.04), plr0_baseColor, metal);
        vec3 f = specular + (1.0 - specular) * (x2 * x2 * x);
        reflected = n_dot_l * ((1.0 - f) * (plr0_baseColor * (1.0 - metal)) / 3.14159265358979 + f * (seen * many));
    }
    vec3 color = scale * plr2_color * (plr2_intensity * reflected) + plr0_emissiveColor;
    plugray_FragColor = vec4(pow(color, vec3(1.0 / 2.2)), 1.0);
}
