uniform float amount = 40.0; /* not the amount of warm.frag: each effect has names of its own */

void PLUG_picture_color(inout vec4 color, const in vec2 place) {
    color.rgb *= 0.5 + 0.5 * step(0.0, sin(place.x * amount));
}
