/* Every light that falls on the surface: more at grazing angles, so that the terminator glows. */
uniform float wrap = 0.5;

void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir) {
    float facing = max(dot(normal_eye, light_dir), 0.0);
    scale *= 1.0 + wrap * (1.0 - facing);
}
