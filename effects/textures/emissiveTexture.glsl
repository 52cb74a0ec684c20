/* ISO/IEC 19775-1 V4 12.4.5, emissiveTexture: RGB multiplies emissiveColor. */

void PLUG_material_emissive(inout vec3 emissive) {
    vec4 value = vec4(1.0);
    /* PLUG: texture_value (value) */
    emissive *= value.rgb;
}
