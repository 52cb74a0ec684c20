/* A grating before a lamp: its light falls in stripes. On a SpotLight, whose place and direction it reads. */

uniform float stripes = 40.0; /* to a radian */

void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir) {
    vec3 across = normalize(cross(light_direction_eye, vec3(0.0, 1.0, 0.0)));
    float angle = asin(clamp(dot(-light_dir, across), -1.0, 1.0));
    scale *= smoothstep(-0.25, 0.25, sin(stripes * angle));
}
