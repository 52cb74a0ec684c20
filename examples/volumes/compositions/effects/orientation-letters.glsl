/* Letters at the edges of the picture that tell which side of the body lies there: R and L, A and P, S and I (right, left;
 * anterior, posterior; superior, inferior). In an oblique view the nearest side stands first, the next one behind it.
 * Beside text.glsl, in an Effect on the volume; its fields are the uniforms below. */

/* Where the patient's right, front and head lie, in the volume's own coordinates: those of NIfTI (RAS). Of DICOM (LPS) right
 * and anterior are -1 0 0 and 0 -1 0. */
uniform vec3 right = vec3(1.0, 0.0, 0.0);
uniform vec3 anterior = vec3(0.0, 1.0, 0.0);
uniform vec3 superior = vec3(0.0, 0.0, 1.0);
uniform vec4 color = vec4(1.0, 0.9, 0.4, 1.0);
uniform vec4 backdrop = vec4(0.0, 0.0, 0.0, 0.5);

const float LEAST = 0.3; /* of a side that is named: some 17 degrees out of the picture's direction */

/* The parts of a direction in the picture, from -1 to 1, along the patient's axes. */
vec3 body_parts(const in vec2 towards) {
    mat3 to_eye = mat3(castle_ModelViewMatrix);
    vec3 v = vec3(towards, 0.0);
    return vec3(dot(v, normalize(to_eye * right)), dot(v, normalize(to_eye * anterior)),
                dot(v, normalize(to_eye * superior)));
}

/* The letter of the greatest part, which is taken away; 0 where none is great enough. */
int body_letter(inout vec3 parts) {
    vec3 size = abs(parts);
    float greatest = max(size.x, max(size.y, size.z));
    if (greatest < LEAST)
        return 0;
    int axis = size.x == greatest ? 0 : size.y == greatest ? 1 : 2;
    bool is_positive = parts[axis] > 0.0;
    parts[axis] = 0.0;
    if (axis == 0)
        return is_positive ? 82 : 76; /* R, L */
    if (axis == 1)
        return is_positive ? 65 : 80; /* A, P */
    return is_positive ? 83 : 73;     /* S, I */
}

/* The letters of a direction, the greatest part first; unused ones are 0. */
ivec3 body_letters(const in vec2 towards) {
    vec3 parts = body_parts(towards);
    int first = body_letter(parts);
    int second = body_letter(parts);
    return ivec3(first, second, body_letter(parts));
}

void PLUG_volume_ray_end(inout vec4 accumulated, inout float depth) {
    float dot_size = text_dot();
    vec2 from_middle = text_pixel() - floor(0.5 * viewport.zw);
    vec2 part = from_middle / viewport.zw;
    /* the edge that this pixel belongs to */
    vec2 towards = abs(part.x) > abs(part.y) ? vec2(sign(part.x), 0.0) : vec2(0.0, sign(part.y));
    ivec3 letters = body_letters(towards);
    float count = float(letters.y == 0 ? 1 : letters.z == 0 ? 2 : 3);
    vec2 size = vec2(count * TEXT_WIDTH - 1.0, TEXT_HEIGHT) * dot_size;
    float margin = 4.0 * dot_size;
    vec2 start = floor(towards * (0.5 * viewport.zw - margin) - 0.5 * size * (1.0 + towards));
    vec2 at = from_middle - start;
    float border = 2.0 * dot_size;
    if (letters.x == 0 || any(lessThan(at, vec2(-border))) || any(greaterThan(at, size + border)))
        return;
    text_over(accumulated, backdrop);
    vec2 dots = at / dot_size;
    int index = text_index(dots);
    int code = index >= 0 && index < 3 ? letters[index] : 0;
    text_over(accumulated, vec4(color.rgb, color.a * text_glyph(code, dots)));
}
