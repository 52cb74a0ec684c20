/* A small cube in a corner of the picture that turns with the volume; its faces carry the letters of the body's sides.
 * Beside text.glsl, in an Effect on the volume; its fields are the uniforms below. */

uniform vec3 right = vec3(1.0, 0.0, 0.0); /* as in orientation-letters.glsl */
uniform vec3 anterior = vec3(0.0, 1.0, 0.0);
uniform vec3 superior = vec3(0.0, 0.0, 1.0);
uniform vec2 place = vec2(0.9, 0.14); /* of its middle, in parts of the picture from its lower left corner */
uniform float size = 0.07;            /* of half a side, in parts of the picture's height */
uniform vec4 color = vec4(1.0, 0.9, 0.4, 1.0);

/* The cube's own axes in eye space: those of the body, of length 1. */
mat3 cube_axes() {
    mat3 to_eye = mat3(castle_ModelViewMatrix);
    return mat3(normalize(to_eye * right), normalize(to_eye * anterior), normalize(to_eye * superior));
}

int cube_letter(const in int axis, const in bool is_positive) {
    ivec3 letters = is_positive ? ivec3(82, 65, 83) : ivec3(76, 80, 73); /* R A S, L P I */
    return letters[axis];
}

/* The directions in which letters are written on a face, across and up: upright where the body stands or lies on its back. */
void cube_writing(const in int axis, const in float side, out vec3 across, out vec3 up) {
    up = axis == 2 ? vec3(0.0, side, 0.0) : vec3(0.0, 0.0, 1.0);
    vec3 outward = vec3(0.0);
    outward[axis] = side;
    across = cross(up, outward);
}

void PLUG_volume_ray_end(inout vec4 accumulated, inout float depth) {
    float reach = size * viewport.w;
    vec2 at = (text_pixel() - floor(place * viewport.zw)) / reach;
    if (dot(at, at) > 3.0)
        return;
    mat3 axes = cube_axes();
    /* a parallel ray in the cube's own coordinates, whether or not left and right are exchanged */
    mat3 to_body = inverse(axes);
    vec3 origin = to_body * vec3(at, 2.0);
    vec3 direction = to_body * vec3(0.0, 0.0, -1.0);
    float enter = 0.0, leave = NOWHERE;
    cross_box(vec3(-1.0), vec3(1.0), origin, direction, enter, leave);
    if (enter >= leave)
        return;
    vec3 hit = origin + enter * direction;
    vec3 far_out = abs(hit);
    int axis = far_out.x >= far_out.y && far_out.x >= far_out.z ? 0 : far_out.y >= far_out.z ? 1 : 2;
    float side = sign(hit[axis]);
    vec3 across, up;
    cube_writing(axis, side, across, up);
    /* seen in a mirror, letters are still to be read */
    if (determinant(axes) < 0.0)
        across = -across;
    vec2 on_face = vec2(dot(hit, across), dot(hit, up));

    vec3 normal = axes[axis] * side;
    float light = 0.25 + 0.35 * abs(normal.z);
    text_over(accumulated, vec4(vec3(light), 1.0));
    vec2 dots = on_face * 6.0 + vec2(2.5, 3.5);
    bool is_rim = max(abs(on_face.x), abs(on_face.y)) > 0.92;
    float ink = is_rim ? 0.4 : text_glyph(cube_letter(axis, side > 0.0), dots);
    text_over(accumulated, vec4(color.rgb, color.a * ink));
}
