/* Brings light of any brightness to what a picture can hold, [0, 1]: one curve, by `mode`. */

uniform float exposure = 1.0;

#if defined(mode_UNCHARTED)
/* J. Hable, "Uncharted 2: HDR Lighting", GDC 2010: a filmic curve of shoulder, linear part, toe. */
vec3 filmic(vec3 x) {
    const float shoulder = 0.15, linear = 0.50, angle = 0.10;
    const float toe = 0.20, numerator = 0.02, denominator = 0.30;
    return (x * (shoulder * x + angle * linear) + toe * numerator) /
               (x * (shoulder * x + linear) + toe * denominator) -
           numerator / denominator;
}
#endif

void PLUG_surface_output(inout vec4 fragment_color) {
    vec3 c = max(rgb_of(fragment_color) * exposure, 0.0);
#if defined(mode_UNCHARTED)
    /* the talk's own exposure of 2, and white at 11.2 */
    c = filmic(2.0 * c) / filmic(vec3(11.2));
#elif defined(mode_HEJL_RICHARD)
    /* J. Hejl and R. Burgess-Dawson, in the same talk: the display's curve is in it */
    vec3 x = max(c - 0.004, 0.0);
    c = x * (6.2 * x + 0.5) / (x * (6.2 * x + 1.7) + 0.06);
#if LINEAR
    c = pow(c, vec3(2.2)); /* it comes again */
#endif
#elif defined(mode_REINHARD)
    /* E. Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002, equation 3 */
    c = c / (1.0 + c);
#elif defined(mode_ACES)
    /* K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2015: a fit */
    c = clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
#endif
    fragment_color = vec4(c, fragment_color.a);
}
