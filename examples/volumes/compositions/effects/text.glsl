/* Text in pictures: a small font, and numbers in it. The other unit of effects that draw labels. Places are in dots:
 * a glyph is five wide and seven high, the next one begins six dots further on; y goes up. Letters are numbers of
 * Unicode, as MFInt32 fields have them: "mm" is 109 109; 176 is a degree, 181 micro, 197 angstrom. */

uniform float textSize = 0.0; /* of a dot, in pixels; 0: by the size of the picture */

const int TEXT_MOST = 6; /* letters of the name of a unit */
const float TEXT_WIDTH = 6.0;
const float TEXT_HEIGHT = 7.0;

/* From the percent sign to z, then the three that ASCII lacks: four rows from the top, then three, of five bits, the highest on
 * the left. */
const uvec2 TEXT_GLYPHS[89] = uvec2[89](
    uvec2(0xC6444u, 0x2263u), uvec2(0x00000u, 0x0000u), uvec2(0x00000u, 0x0000u), uvec2(0x11108u, 0x2082u), uvec2(0x41042u, 0x0888u),
    uvec2(0x055DFu, 0x3AA0u), uvec2(0x0109Fu, 0x1080u), uvec2(0x00000u, 0x3088u), uvec2(0x0001Fu, 0x0000u), uvec2(0x00000u, 0x018Cu),
    uvec2(0x00444u, 0x2200u), uvec2(0x74675u, 0x662Eu), uvec2(0x23084u, 0x108Eu), uvec2(0x74422u, 0x111Fu), uvec2(0xF8882u, 0x062Eu),
    uvec2(0x11952u, 0x7C42u), uvec2(0xFC3C1u, 0x062Eu), uvec2(0x3221Eu, 0x462Eu), uvec2(0xF8444u, 0x2108u), uvec2(0x7462Eu, 0x462Eu),
    uvec2(0x7462Fu, 0x044Cu), uvec2(0x03180u, 0x3180u), uvec2(0x00000u, 0x0000u), uvec2(0x11110u, 0x2082u), uvec2(0x003E0u, 0x7C00u),
    uvec2(0x41041u, 0x0888u), uvec2(0x74422u, 0x1004u), uvec2(0x00000u, 0x0000u), uvec2(0x7463Fu, 0x4631u), uvec2(0xF463Eu, 0x463Eu),
    uvec2(0x74610u, 0x422Eu), uvec2(0xF4631u, 0x463Eu), uvec2(0xFC21Eu, 0x421Fu), uvec2(0xFC21Eu, 0x4210u), uvec2(0x74617u, 0x462Fu),
    uvec2(0x8C63Fu, 0x4631u), uvec2(0x71084u, 0x108Eu), uvec2(0x38842u, 0x0A4Cu), uvec2(0x8CA98u, 0x5251u), uvec2(0x84210u, 0x421Fu),
    uvec2(0x8EEB5u, 0x4631u), uvec2(0x8C735u, 0x4E31u), uvec2(0x74631u, 0x462Eu), uvec2(0xF463Eu, 0x4210u), uvec2(0x74631u, 0x564Du),
    uvec2(0xF463Eu, 0x5251u), uvec2(0x7C20Eu, 0x043Eu), uvec2(0xF9084u, 0x1084u), uvec2(0x8C631u, 0x462Eu), uvec2(0x8C631u, 0x4544u),
    uvec2(0x8C635u, 0x56AAu), uvec2(0x8C544u, 0x2A31u), uvec2(0x8C62Au, 0x1084u), uvec2(0xF8444u, 0x221Fu), uvec2(0x00000u, 0x0000u),
    uvec2(0x00000u, 0x0000u), uvec2(0x00000u, 0x0000u), uvec2(0x22A20u, 0x0000u), uvec2(0x00000u, 0x001Fu), uvec2(0x00000u, 0x0000u),
    uvec2(0x001C1u, 0x3E2Fu), uvec2(0x842D9u, 0x463Eu), uvec2(0x001D0u, 0x422Eu), uvec2(0x085B3u, 0x462Fu), uvec2(0x001D1u, 0x7E0Eu),
    uvec2(0x3251Cu, 0x2108u), uvec2(0x03E31u, 0x3C2Eu), uvec2(0x842D9u, 0x4631u), uvec2(0x20184u, 0x108Eu), uvec2(0x100C2u, 0x0A4Cu),
    uvec2(0x84254u, 0x6292u), uvec2(0x61084u, 0x108Eu), uvec2(0x00355u, 0x5631u), uvec2(0x002D9u, 0x4631u), uvec2(0x001D1u, 0x462Eu),
    uvec2(0x003D1u, 0x7A10u), uvec2(0x001B3u, 0x3C21u), uvec2(0x002D9u, 0x4210u), uvec2(0x001D0u, 0x383Eu), uvec2(0x42388u, 0x2126u),
    uvec2(0x00231u, 0x466Du), uvec2(0x00231u, 0x4544u), uvec2(0x00231u, 0x56AAu), uvec2(0x0022Au, 0x1151u), uvec2(0x00231u, 0x3C2Eu),
    uvec2(0x003E2u, 0x111Fu), uvec2(0x64A4Cu, 0x0000u), uvec2(0x00231u, 0x4FB0u), uvec2(0x2008Au, 0x47F1u));

float text_dot() {
    if (textSize > 0.0)
        return max(floor(textSize + 0.5), 1.0);
    return max(floor(min(viewport.z, viewport.w) / 200.0 + 0.5), 1.0);
}

/* The pixel, counted from the lower left corner of the picture; its centre. */
vec2 text_pixel() {
    return gl_FragCoord.xy - viewport.xy;
}

/* 1 on the glyph, else 0. */
float text_glyph(const in int code, const in vec2 at) {
    int glyph = code >= 37 && code <= 122 ? code - 37 : code == 176 ? 86 : code == 181 ? 87 : code == 197 ? 88 : -1;
    ivec2 dot = ivec2(floor(at));
    if (glyph < 0 || any(lessThan(dot, ivec2(0))) || dot.x > 4 || dot.y > 6)
        return 0.0;
    uvec2 rows = TEXT_GLYPHS[glyph];
    uint row = dot.y >= 3 ? rows.x >> (5 * (dot.y - 3)) : rows.y >> (5 * dot.y);
    return float((row >> (4 - dot.x)) & 1u);
}

/* Which letter of a line stands here, and where in its cell. */
int text_index(inout vec2 at) {
    float index = floor(at.x / TEXT_WIDTH);
    at.x -= index * TEXT_WIDTH;
    return int(index);
}

const int TEXT_POWERS[10] = int[10](1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000, 1000000000);

int text_power(const in int exponent) {
    return TEXT_POWERS[clamp(exponent, 0, 9)];
}

/* A number in units of its last decimal. */
int text_whole(const in float value, const in int decimals) {
    return int(min(abs(value) * float(text_power(decimals)) + 0.5, 999999999.0));
}

/* How many letters a number has. Loops here are spelled out: some compilers need minutes for one after another. */
int text_length(const in float value, const in int decimals) {
    int whole = text_whole(value, decimals);
    int rest = whole / text_power(decimals);
    int digits = 1 + int(rest >= 10) + int(rest >= 100) + int(rest >= 1000) + int(rest >= 10000) + int(rest >= 100000) +
                 int(rest >= 1000000) + int(rest >= 10000000) + int(rest >= 100000000);
    return digits + (decimals > 0 ? decimals + 1 : 0) + int(value < 0.0 && whole > 0);
}

/* A letter of a number; 0 beyond its ends. */
int text_number(const in int index, const in float value, const in int decimals) {
    int whole = text_whole(value, decimals);
    int from_end = text_length(value, decimals) - 1 - index;
    if (from_end < 0 || index < 0)
        return 0;
    if (index == 0 && value < 0.0 && whole > 0)
        return 45;
    if (decimals > 0 && from_end == decimals)
        return 46;
    int place = decimals > 0 && from_end > decimals ? from_end - 1 : from_end;
    return 48 + whole / text_power(place) % 10;
}

/* How many decimals tell multiples of a step apart. */
int text_decimals(const in float step_size) {
    return int(clamp(-floor(log(step_size) / log(10.0) + 1.0e-3), 0.0, 6.0));
}

/* The largest of 1, 2, 5, 10, 20 ... that is at most this, a power of ten below 1 as well. */
float text_round(const in float most) {
    float power = pow(10.0, floor(log(most) / log(10.0) + 1.0e-5));
    float times = most / power * 1.00001;
    return (times >= 5.0 ? 5.0 : times >= 2.0 ? 2.0 : 1.0) * power;
}

/* How many letters the name of a unit has: those before the first 0. */
int text_count(const in int name[TEXT_MOST]) {
    return name[0] == 0 ? 0 : name[1] == 0 ? 1 : name[2] == 0 ? 2 : name[3] == 0 ? 3 : name[4] == 0 ? 4 : name[5] == 0 ? 5 : 6;
}

/* Lays a straight colour over a premultiplied one. */
void text_over(inout vec4 below, const in vec4 color) {
    below = vec4(color.rgb * color.a, color.a) + (1.0 - color.a) * below;
}
