/* A scale bar. Its length is exact in parallel projection; in perspective it is that at the centre of the volume.
 * Beside text.glsl, in an Effect on the volume; its fields are the uniforms below. */

uniform float unitLength = 0.001; /* how long the unit is, in the volume's own coordinates: a millimetre in metres */
uniform int unit[6] = int[6](109, 109, 0, 0, 0, 0); /* its name: "mm" */
uniform float barLength = 0.0;    /* in that unit; 0: the longest of 1, 2, 5, 10, ... that fits */
uniform float most = 0.3;         /* of the picture's width */
uniform vec2 place = vec2(0.05);  /* of the bar's left end, in parts of the picture from its lower left corner */
uniform vec4 color = vec4(1.0);
uniform vec4 backdrop = vec4(0.0, 0.0, 0.0, 0.5);

/* How many pixels a unit takes, across the picture, where the centre of the volume is. */
float pixels_of_unit() {
    mat4 p = castle_ProjectionMatrix;
    vec3 center = castle_ModelViewMatrix[3].xyz;
    float w = p[2][3] * center.z + p[3][3];
    /* what is as long as this in own coordinates lies along the picture's rows */
    float own = length(mat3(plugray_InverseModelViewMatrix) * vec3(1.0, 0.0, 0.0));
    return w > 0.0 ? unitLength / own * p[0][0] / w * 0.5 * viewport.z : 0.0;
}

void PLUG_volume_ray_end(inout vec4 accumulated, inout float depth) {
    float pixels = pixels_of_unit();
    if (pixels <= 0.0)
        return;
    float units = barLength > 0.0 ? barLength : text_round(most * viewport.z / pixels);
    float dot_size = text_dot();
    vec2 corner = floor(place * viewport.zw);
    vec2 at = text_pixel() - corner;
    float width = units * pixels;
    float thick = 2.0 * dot_size;
    int decimals = text_decimals(text_round(units));
    int number = text_length(units, decimals);
    int letters = text_count(unit);
    float line = float(number + 1 + letters) * TEXT_WIDTH - 1.0;
    float margin = 3.0 * dot_size;
    float height = thick + (TEXT_HEIGHT + 2.0) * dot_size;

    /* the label stands in the middle of the bar; where it is longer it begins with it */
    float label = max(floor(0.5 * (width - line * dot_size)), 0.0);
    float right = max(width, line * dot_size);
    if (any(lessThan(at, vec2(-margin))) || at.x > right + margin || at.y > height + margin)
        return;
    text_over(accumulated, backdrop);
    if (at.y >= 0.0 && at.y < thick && at.x >= 0.0 && at.x < width)
        text_over(accumulated, color);
    vec2 dots = (at - vec2(label, thick + 2.0 * dot_size)) / dot_size;
    int index = text_index(dots);
    int code = index < number ? text_number(index, units, decimals) : 0;
    if (index > number && index <= number + letters)
        code = unit[index - number - 1];
    text_over(accumulated, vec4(color.rgb, color.a * text_glyph(code, dots)));
}
