/* Another volume in the same box, blended with this one sample by sample. ISO/IEC 19775-1 V4 41.4.1:
 * Cg = clamp(Cv w1 + Cb w2), Og = clamp(Ov w1 + Ob w2), where b is the other volume in its own style. With
 * DRAFT_NAMES the weights are called as in the draft of the component: ALPHA1 is Ov, ALPHA2 is Ob. */

uniform float weightConstant1 = 0.5;
uniform float weightConstant2 = 0.5;
#if HAS_weightTransferFunction1
uniform sampler2D weightTransferFunction1;
#endif
#if HAS_weightTransferFunction2
uniform sampler2D weightTransferFunction2;
#endif

float first_weight(const in float own, const in float other) {
#if defined(weightFunction1_TABLE)
#if HAS_weightTransferFunction1
    return texture(weightTransferFunction1,
                   function_coordinate(vec2(own, other), textureSize(weightTransferFunction1, 0))).r;
#else
    return own;
#endif
#elif DRAFT_NAMES && defined(weightFunction1_ALPHA1) || defined(weightFunction1_ALPHA0)
    return own;
#elif DRAFT_NAMES && defined(weightFunction1_ONE_MINUS_ALPHA1) || defined(weightFunction1_ONE_MINUS_ALPHA0)
    return 1.0 - own;
#elif defined(weightFunction1_ALPHA1) || defined(weightFunction1_ALPHA2)
    return other;
#elif defined(weightFunction1_ONE_MINUS_ALPHA1) || defined(weightFunction1_ONE_MINUS_ALPHA2)
    return 1.0 - other;
#else
    return weightConstant1;
#endif
}

float second_weight(const in float own, const in float other) {
#if defined(weightFunction2_TABLE)
#if HAS_weightTransferFunction2
    return texture(weightTransferFunction2,
                   function_coordinate(vec2(other, own), textureSize(weightTransferFunction2, 0))).r;
#else
    return other;
#endif
#elif DRAFT_NAMES && defined(weightFunction2_ALPHA1) || defined(weightFunction2_ALPHA0)
    return own;
#elif DRAFT_NAMES && defined(weightFunction2_ONE_MINUS_ALPHA1) || defined(weightFunction2_ONE_MINUS_ALPHA0)
    return 1.0 - own;
#elif defined(weightFunction2_ALPHA1) || defined(weightFunction2_ALPHA2)
    return other;
#elif defined(weightFunction2_ONE_MINUS_ALPHA1) || defined(weightFunction2_ONE_MINUS_ALPHA2)
    return 1.0 - other;
#else
    return weightConstant2;
#endif
}

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    vec4 blend = vec4(0.0);
#if HAS_OTHER
    VolumeSample other = s;
    grid_sample(other, s.position);
    blend = voxel_color(other.value);
    /* PLUG: volume_classify (blend, other) */
    blend = clamped(blend);
    /* PLUG: volume_shade (blend, other) */
    blend = clamped(blend);
#endif
    color = clamped(color * first_weight(color.a, blend.a) + blend * second_weight(color.a, blend.a));
}
