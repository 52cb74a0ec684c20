/* One of the six pictures around the viewer. ISO/IEC 19775-1 V4 24.2.1: they stand on the faces of a cube
 * at infinite distance, upright for a viewer who turns from the front (-Z) to the left (-X), the back
 * (+Z) and the right (+X); the top and the bottom join the front. What a picture does not cover shows
 * sky and ground. FACE: 0 front, 1 back, 2 left, 3 right, 4 top, 5 bottom. HAS_IMAGE is 0 for a
 * ShaderTexture, which is what its effects make of it. */

#if HAS_IMAGE
uniform sampler2D self;
#endif
uniform mat4 nodeToEye = mat4(1.0);

#if FACE == 0
const mat3 face_axes = mat3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0); /* right, up, ahead */
#elif FACE == 1
const mat3 face_axes = mat3(-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
#elif FACE == 2
const mat3 face_axes = mat3(0.0, 0.0, -1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0);
#elif FACE == 3
const mat3 face_axes = mat3(0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0);
#elif FACE == 4
const mat3 face_axes = mat3(1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0);
#else
const mat3 face_axes = mat3(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, -1.0, 0.0);
#endif

void PLUG_background_color(inout vec4 color, const in vec3 direction_eye) {
    vec3 on_face = background_direction(nodeToEye, direction_eye) * face_axes;
    vec2 coord = on_face.xy / on_face.z * 0.5 + 0.5;
#if HAS_IMAGE
    /* beside the face they are not defined */
    vec2 along_x = dFdx(coord), along_y = dFdy(coord);
#endif
    if (!(on_face.z > 0.0 && max(abs(on_face.x), abs(on_face.y)) <= on_face.z))
        return;
#if HAS_IMAGE
    /* up to the middle of the texels at the edge: the opposite edge must not shine through */
    vec2 margin = 0.5 / vec2(textureSize(self, 0));
    vec4 texture_color =
        textureGrad(self, clamp(coord, margin, 1.0 - margin), along_x, along_y);
#else
    vec4 texture_color = vec4(1.0, 0.0, 1.0, 1.0);
#endif
    vec4 tex_coord = vec4(coord, 0.0, 1.0);
#if HAS_IMAGE
    /* PLUG: texture_color (texture_color, self, tex_coord) (texture_color, tex_coord) */
#else
    /* PLUG: texture_color (texture_color, tex_coord) */
#endif
    float alpha = texture_color.a + color.a * (1.0 - texture_color.a);
    vec3 mixed = texture_color.rgb * texture_color.a + color.rgb * (color.a * (1.0 - texture_color.a));
    color = vec4(alpha > 0.0 ? mixed / alpha : vec3(0.0), alpha);
}
