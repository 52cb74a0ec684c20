/* The colour of edges. ISO/IEC 19775-1 V4 41.4.5: Og = Ov, and
 *
 *     Cg = Cv                                  where |n.V| >= cos(gradientThreshold)
 *     Cg = Cv |n.V| + edgeColor (1 - |n.V|)    elsewhere
 *
 * (the alpha of edgeColor does not enter). The proposal of 2005 (4.4) has this in prose, and a field
 * `contribution` that its text does not mention: where the scene gives it, it is the weight of Cg
 * against Cv. Where there is no normal nothing changes. */

uniform vec4 edgeColor = vec4(0.0, 0.0, 0.0, 1.0);
uniform float gradientThreshold = 0.4;
#if defined(GIVEN_contribution)
uniform float contribution = 0.2;
#endif

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    vec3 normal = style_normal(s);
    float facing = abs(style_facing(s, normal));
    if (normal == vec3(0.0) || facing >= cos(gradientThreshold))
        return;
    float share = 1.0 - facing;
#if defined(GIVEN_contribution)
    share *= contribution;
#endif
    color.rgb = mix(color.rgb, edgeColor.rgb, share);
}
