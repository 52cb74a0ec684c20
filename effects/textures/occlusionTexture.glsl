/* ISO/IEC 19775-1 V4 12.4.5, occlusionTexture: R is how much light arrives, 0 none; occlusionStrength is how
 * much that counts. */

uniform float occlusionStrength = 1.0;

void PLUG_material_occlusion(inout vec4 lit) {
    vec4 value = vec4(1.0);
    /* PLUG: texture_value (value) */
    lit.rgb *= mix(1.0, value.r, occlusionStrength);
}
