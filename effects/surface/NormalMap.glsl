/* Normals from a texture: normalTexture of materials (ISO/IEC 19775-1 V4 12.4.5), and the older extension
 * normalMap of Appearance. RGB holds a vector along the directions in which the texture coordinates
 * grow and along the normal, each from -1 to 1; normalScale stretches it along the surface. */

#if CHANNEL == 0
#define TEX_COORD castle_TexCoord0
#elif CHANNEL == 1
#define TEX_COORD castle_TexCoord1
#elif CHANNEL == 2
#define TEX_COORD castle_TexCoord2
#elif CHANNEL == 3
#define TEX_COORD castle_TexCoord3
#elif CHANNEL == 4
#define TEX_COORD castle_TexCoord4
#elif CHANNEL == 5
#define TEX_COORD castle_TexCoord5
#elif CHANNEL == 6
#define TEX_COORD castle_TexCoord6
#elif CHANNEL == 7
#define TEX_COORD castle_TexCoord7
#endif

uniform float normalScale = 1.0;

#if PLUG_USED(tangent_object_space)
in vec4 tangent_eye;
#endif

void PLUG_fragment_eye_space(const in vec4 vertex_eye, inout vec3 normal_eye) {
    vec4 value = vec4(0.5, 0.5, 1.0, 1.0);
#if PLUG_USED(tangent_object_space)
    mat3 frame = given_tangent_frame(tangent_eye, normal_eye);
#else
    mat3 frame = tangent_frame(vertex_eye.xyz, TEX_COORD.st / TEX_COORD.q, normal_eye);
#endif
    /* PLUG: texture_value (value) */
    vec3 bump = (2.0 * value.rgb - 1.0) * vec3(normalScale, normalScale, 1.0);
    bump = unit_or_zero(frame * bump);
    if (bump != vec3(0.0) && frame[0] != vec3(0.0))
        normal_eye = bump;
}
