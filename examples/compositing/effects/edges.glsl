/* Edges of a picture: Sobel's operator on its luminance (Sobel and Feldman, 1968). */

uniform sampler2D picture;
uniform float strength = 1.0;

float luminance(vec2 place) {
    return dot(texture2D(picture, place).rgb, vec3(0.2126, 0.7152, 0.0722));
}

void PLUG_texture_color(inout vec4 texture_color, const in vec4 tex_coord) {
    vec2 d = 1.0 / vec2(textureSize(picture, 0));
    vec2 st = tex_coord.st;
    float l[9];
    for (int i = 0; i < 9; i++)
        l[i] = luminance(st + d * vec2(float(i % 3) - 1.0, float(i / 3) - 1.0));
    vec2 gradient = vec2(l[2] + 2.0 * l[5] + l[8] - l[0] - 2.0 * l[3] - l[6],
                         l[6] + 2.0 * l[7] + l[8] - l[0] - 2.0 * l[1] - l[2]);
    texture_color = vec4(vec3(1.0 - clamp(strength * length(gradient), 0.0, 1.0)), 1.0);
}
