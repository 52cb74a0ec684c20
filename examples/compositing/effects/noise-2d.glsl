/* Noise on the surface's own two coordinates. */

uniform float scale = 8.0;
uniform vec3 dark = vec3(0.12, 0.25, 0.45);
uniform vec3 bright = vec3(0.95, 0.97, 1.0);

float turbulence(vec3 place);

void PLUG_texture_color(inout vec4 texture_color, const in vec4 tex_coord) {
    float cloud = 0.5 + 0.9 * turbulence(vec3(scale * tex_coord.st, 0.5));
    texture_color = vec4(mix(dark, bright, clamp(cloud, 0.0, 1.0)), 1.0);
}
