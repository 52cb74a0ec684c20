/* Marble: noise that fills space, so that no seam shows wherever the surface cuts it. */

uniform float scale = 3.0;
uniform vec3 vein = vec3(0.16, 0.13, 0.12);
uniform vec3 stone = vec3(0.93, 0.90, 0.85);

float turbulence(vec3 place);

void PLUG_texture_color(inout vec4 texture_color, const in vec4 tex_coord) {
    vec3 place = scale * tex_coord.stp;
    float layers = sin(2.5 * (place.x + place.y) + 5.0 * turbulence(place));
    texture_color = vec4(mix(vein, stone, pow(0.5 + 0.5 * layers, 0.4)), 1.0);
}
