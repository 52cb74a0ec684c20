uniform float amount = 0.2;

void PLUG_picture_color(inout vec4 color, const in vec2 place) {
    color.r += amount;
}
