/* How one texture of a MultiTexture is mixed: ISO/IEC 19775-1 V4 18.4.3, tables 18.3 (mode), 18.4 (source)
 * and 18.5 (function). The first argument is the texture, the second is what the source says. Where the
 * standard leaves open: REPLACE takes the texture; ADDSIGNED takes 0.5 from the sum; COMPLEMENT leaves
 * alpha; the modes that add a colour multiply alpha; results below 0 are 0, alpha above 1 is 1.
 * CHANNELS_RGB, CHANNELS_ALPHA: these alone ("MODULATE / REPLACE" is two instances); LAST: the function is
 * due. */

#ifdef SOURCE_SPECULAR
uniform vec3 specularColor = vec3(0.0);
#endif

void PLUG_texture_mix(inout vec4 result, const in vec4 arg1, const in vec4 previous, const in vec4 primary,
                      const in vec4 factor) {
#ifdef SOURCE_DIFFUSE
    vec4 arg2 = primary;
#elif defined(SOURCE_SPECULAR)
    vec4 arg2 = vec4(specularColor, primary.a);
#elif defined(SOURCE_FACTOR)
    vec4 arg2 = factor;
#else
    vec4 arg2 = previous;
#endif

#if defined(MODE_REPLACE) || defined(MODE_SELECTARG1)
    vec4 mixed = arg1;
#elif defined(MODE_SELECTARG2)
    vec4 mixed = arg2;
#elif defined(MODE_MODULATE2X)
    vec4 mixed = 2.0 * arg1 * arg2;
#elif defined(MODE_MODULATE4X)
    vec4 mixed = 4.0 * arg1 * arg2;
#elif defined(MODE_ADD)
    vec4 mixed = arg1 + arg2;
#elif defined(MODE_ADDSIGNED)
    vec4 mixed = max(arg1 + arg2 - 0.5, 0.0);
#elif defined(MODE_ADDSIGNED2X)
    vec4 mixed = max(2.0 * (arg1 + arg2 - 0.5), 0.0);
#elif defined(MODE_SUBTRACT)
    vec4 mixed = max(arg1 - arg2, 0.0);
#elif defined(MODE_ADDSMOOTH)
    vec4 mixed = arg1 + (1.0 - arg1) * arg2;
#elif defined(MODE_BLENDDIFFUSEALPHA)
    vec4 mixed = mix(arg2, arg1, primary.a);
#elif defined(MODE_BLENDTEXTUREALPHA)
    vec4 mixed = mix(arg2, arg1, arg1.a);
#elif defined(MODE_BLENDFACTORALPHA)
    vec4 mixed = mix(arg2, arg1, factor.a);
#elif defined(MODE_BLENDCURRENTALPHA)
    vec4 mixed = mix(arg2, arg1, previous.a);
#elif defined(MODE_MODULATEALPHA_ADDCOLOR)
    vec4 mixed = vec4(arg1.rgb + arg1.a * arg2.rgb, arg1.a * arg2.a);
#elif defined(MODE_MODULATEINVALPHA_ADDCOLOR)
    vec4 mixed = vec4((1.0 - arg1.a) * arg2.rgb + arg1.rgb, arg1.a * arg2.a);
#elif defined(MODE_MODULATEINVCOLOR_ADDALPHA)
    vec4 mixed = vec4((1.0 - arg1.rgb) * arg2.rgb + arg1.a, arg1.a * arg2.a);
#elif defined(MODE_DOTPRODUCT3)
    vec4 mixed = vec4(max(4.0 * dot(arg1.rgb - 0.5, arg2.rgb - 0.5), 0.0));
#else
    vec4 mixed = arg1 * arg2;
#endif
#if defined(MODE_MODULATE2X) || defined(MODE_MODULATE4X) || defined(MODE_ADD) ||                         \
    defined(MODE_ADDSIGNED) || defined(MODE_ADDSIGNED2X) || defined(MODE_DOTPRODUCT3)
    mixed.a = min(mixed.a, 1.0);
#endif

#ifdef CHANNELS_RGB
    result.rgb = mixed.rgb;
#elif defined(CHANNELS_ALPHA)
    result.a = mixed.a;
#else
    result = mixed;
#endif
#if LAST && defined(FUNCTION_COMPLEMENT)
    result.rgb = 1.0 - result.rgb;
#elif LAST && defined(FUNCTION_ALPHAREPLICATE)
    result.rgb = vec3(result.a);
#endif
}
