/* Three textures by height and steepness: grass in the valleys, rock on what is steep, snow on the tops. */

uniform sampler2D grass, rock, snow;
uniform float tree_line = 0.45;
uniform float snow_line = 0.8;
uniform float repeats = 12.0;

varying float height;
varying float steepness;

void PLUG_texture_color(inout vec4 texture_color, const in vec4 tex_coord) {
    vec2 place = tex_coord.st * repeats;
    float bare = max(smoothstep(tree_line - 0.2, tree_line + 0.2, height), smoothstep(0.35, 0.7, steepness));
    float white = smoothstep(snow_line - 0.12, snow_line + 0.12, height) * (1.0 - smoothstep(0.6, 0.9, steepness));
    texture_color = mix(texture2D(grass, place), texture2D(rock, place), bare);
    texture_color = mix(texture_color, texture2D(snow, place), white);
}
