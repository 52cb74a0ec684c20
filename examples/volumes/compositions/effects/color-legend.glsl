/* A legend: the colours of a transfer function with values beside them. Beside text.glsl, in an Effect on the volume;
 * its fields are the uniforms below. */

uniform sampler2D transferFunction;
uniform vec2 range = vec2(0.0, 1.0); /* the values at the ends of the function */
uniform vec2 shown = vec2(0.0);      /* the values at the ends of the legend; 0 0: those of the function */
uniform int unit[6] = int[6](0, 0, 0, 0, 0, 0);
uniform float interval = 0.0;        /* between the values told; 0: some five of them */
uniform vec4 place = vec4(0.05, 0.25, 0.03, 0.5); /* left, bottom, width, height in parts of the picture */
uniform vec4 color = vec4(1.0);
uniform vec4 backdrop = vec4(0.0, 0.0, 0.0, 0.5);

/* The function's colour, opaque: an opacity of a voxel is none of a picture. */
vec3 legend_color(const in float value) {
    float at = (value - range.x) / (range.y - range.x);
    return texture(transferFunction, function_coordinate(vec2(at, 0.0), textureSize(transferFunction, 0))).rgb;
}

/* The value beside which a label stands that covers this value, where a letter covers `reach` to both sides: the ends, and
 * between them the multiples of the interval that keep their distance. */
float legend_label(const in float value, const in vec2 ends, const in float gap, const in float reach) {
    vec2 low_high = vec2(min(ends.x, ends.y), max(ends.x, ends.y));
    if (abs(value - ends.x) <= reach)
        return ends.x;
    if (abs(value - ends.y) <= reach)
        return ends.y;
    float nearest = floor(value / gap + 0.5) * gap;
    return nearest > low_high.x + 2.5 * reach && nearest < low_high.y - 2.5 * reach ? nearest : ends.x;
}

void PLUG_volume_ray_end(inout vec4 accumulated, inout float depth) {
    vec2 ends = shown.x == shown.y ? range : shown;
    float dot_size = text_dot();
    vec2 corner = floor(place.xy * viewport.zw);
    vec2 size = floor(place.zw * viewport.zw + 0.5);
    vec2 at = text_pixel() - corner;
    float gap = interval > 0.0 ? interval : text_round(0.3 * abs(ends.y - ends.x));
    int decimals = text_decimals(text_round(gap));
    int longest = max(text_length(ends.x, decimals), text_length(ends.y, decimals));
    int letters = text_count(unit);
    float row = (TEXT_HEIGHT + 4.0) * dot_size; /* of the unit, above the bar */
    float right = size.x + 3.0 * dot_size + float(longest) * TEXT_WIDTH * dot_size;
    right = max(right, float(letters) * TEXT_WIDTH * dot_size);
    float margin = 4.0 * dot_size;
    if (any(lessThan(at, vec2(-margin))) || at.x > right + margin ||
        at.y > size.y + margin + (letters > 0 ? row : 0.0))
        return;
    text_over(accumulated, backdrop);

    /* the bar, a frame of a pixel around it */
    if (at.x > -1.0 && at.x < size.x + 1.0 && at.y > -1.0 && at.y < size.y + 1.0) {
        vec2 inside = at / size;
        bool is_frame = any(lessThan(inside, vec2(0.0))) || any(greaterThan(inside, vec2(1.0)));
        vec3 bar = is_frame ? color.rgb : legend_color(mix(ends.x, ends.y, inside.y));
        text_over(accumulated, vec4(bar, is_frame ? color.a : 1.0));
    }

    int code = 0;
    vec2 dots;
    if (at.y > size.y + 4.0 * dot_size) {
        dots = (at - vec2(0.0, size.y + margin)) / dot_size;
        int index = text_index(dots);
        code = index >= 0 && index < letters ? unit[index] : 0;
    } else {
        float scale = (ends.y - ends.x) / size.y; /* of values to pixels */
        float reach = (0.5 * TEXT_HEIGHT * dot_size + 0.6) * abs(scale); /* rounded rows too */
        float label = legend_label(ends.x + at.y * scale, ends, gap, reach);
        float middle = (label - ends.x) / scale;
        vec2 start = vec2(size.x + 3.0 * dot_size, floor(middle - 0.5 * TEXT_HEIGHT * dot_size));
        dots = (at - start) / dot_size;
        code = text_number(text_index(dots), label, decimals);
    }
    text_over(accumulated, vec4(color.rgb, color.a * text_glyph(code, dots)));
}
