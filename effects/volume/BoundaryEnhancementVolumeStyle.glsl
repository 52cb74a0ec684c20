/* More opaque where the value changes fast. ISO/IEC 19775-1 V4 41.4.2:
 *
 *     Og = Ov (kgc + kgs |grad f|^kge), Cg = Cv
 *
 * with retainedOpacity, boundaryOpacity and opacityFactor. The proposal of 2005 (4.1) has more. Its
 * transferFunction is evaluated first. Its text leaves the colour alone where it gives the formula, and
 * darkens it where it describes gradientColor ("the maximum colour at the point of maximum gradient
 * change; where there is little or none, interpolated to transparent"): so colours change where the
 * scene gives gradientColor or contribution. The colour's share grows with |grad f| from nothing to its
 * alpha, `contribution` weighs it. surfaceNormals say nothing to this style, which asks for magnitudes. */

uniform float retainedOpacity = 0.2;
uniform float boundaryOpacity = 0.9;
uniform float opacityFactor = 2.0;
#if defined(GIVEN_gradientColor) || defined(GIVEN_contribution)
uniform vec4 gradientColor = vec4(0.0, 0.0, 0.0, 1.0);
uniform float contribution = 0.2;
#endif

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
#if HAS_transferFunction
    color = style_transfer(s.value);
#endif
    float change = style_gradient(s);
#if defined(GIVEN_gradientColor) || defined(GIVEN_contribution)
    float share = contribution * gradientColor.a * min(change, 1.0);
    color.rgb = mix(color.rgb, gradientColor.rgb, share);
#endif
    float factor = retainedOpacity + boundaryOpacity * style_power(change, opacityFactor);
    color.a = min(color.a * factor, 1.0);
}
