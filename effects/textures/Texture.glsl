/* One texture of a surface, whatever its node type; every place where a texture is used is one instance.
 * The host says by macros where its coordinates come from and what becomes of its colour:
 *   CHANNEL      the texture coordinates, castle_TexCoord<CHANNEL>
 *   DIMENSIONS   of `self`: 2, 3, 6 (a cube); 0: ShaderTexture, whose effects alone make its colour
 *   PROJECTIVE   the coordinates have a fourth component other than 1
 *   REFLECTED    they are made here, for each fragment, by what is attached
 *   SHIFTED      texture_coord_shift may move them; texture_color gets them moved
 *   DATA         no colour: neither gamma nor tone belongs to it
 *   STAGE        one of the textures of a MultiTexture
 *   VALUE        what this is attached to knows what to do with it
 * Else it multiplies the colour before light, alpha too: the rule of ISO/IEC 19775-1 V4 17.2.2 for every
 * number of components, and of the living implementations for version 3, too (whose text let RGB replace
 * the colour). The host lets L read as (l, l, l, 1), LA as (l, l, l, a), RGB as (r, g, b, 1). */

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

#if DIMENSIONS == 2
uniform sampler2D self;
#elif DIMENSIONS == 3
uniform sampler3D self;
#elif DIMENSIONS == 6
uniform samplerCube self;
#endif

vec4 find_texture_color() {
#if DIMENSIONS != 0 || PLUG_USED(texture_color)
    vec4 tex_coord = TEX_COORD;
#endif
#if REFLECTED
    /* PLUG: texture_coord_reflect (tex_coord, surface_vertex_eye, surface_normal_eye) */
    /* PLUG: texture_coord_transform (tex_coord) */
#endif

#if DIMENSIONS == 0
    vec4 texture_color = vec4(1.0, 0.0, 1.0, 1.0);
    /* PLUG: texture_color (texture_color, tex_coord) */
#else
#if DIMENSIONS == 2
#if SHIFTED
#if PROJECTIVE && PLUG_USED(texture_coord_shift)
    tex_coord /= tex_coord.q;
#endif
    /* PLUG: texture_coord_shift (tex_coord.st) */
#endif
#if PROJECTIVE
    vec4 texture_color = textureProj(self, tex_coord);
#else
    vec4 texture_color = texture(self, tex_coord.st);
#endif
#elif DIMENSIONS == 3
#if PROJECTIVE
    vec4 texture_color = textureProj(self, tex_coord);
#else
    vec4 texture_color = texture(self, tex_coord.stp);
#endif
#else
    vec4 texture_color = texture(self, tex_coord.stp);
#endif
#if !DATA
    /* PLUG: texture_decode (texture_color) */
#endif
    /* PLUG: texture_color (texture_color, self, tex_coord) (texture_color, tex_coord) */
#endif
    return texture_color;
}

#ifdef VALUE
void PLUG_texture_value(inout vec4 value) {
    value = find_texture_color();
}
#elif defined(STAGE)
void PLUG_texture_stage(inout vec4 fragment_color, const in vec4 primary) {
    vec4 previous = fragment_color, texture_color = find_texture_color();
    /* PLUG: texture_mix (fragment_color, texture_color, previous, primary, vec4(color, alpha)) */
}
#else
void PLUG_surface_texture(inout vec4 fragment_color) {
    vec4 texture_color = find_texture_color();
    fragment_color = vec4(rgb_of(fragment_color) * texture_color.rgb, fragment_color.a * texture_color.a);
}
#endif
