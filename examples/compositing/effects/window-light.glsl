/* A picture in front of the lamp: only what passes the glass lights the scene. The light's own data
 * (where it is, where it points, how wide it is) is read by name. */

uniform sampler2D window;

void PLUG_light_color(inout vec3 color, const in vec4 vertex_eye, const in vec3 light_dir) {
    vec3 axis = light_direction_eye;
    vec3 side = normalize(cross(axis, mat3(plugray_ViewMatrix) * vec3(0.0, 1.0, 0.0))), up = cross(side, axis);
    float reach = tan(cutOffAngle) * dot(-light_dir, axis);
    vec2 place = vec2(dot(-light_dir, side), dot(-light_dir, up)) / reach;
    color *= texture2D(window, 0.5 + 0.5 * place).rgb;
}
