/* ISO/IEC 19775-1 V4 12.4.5, Material.specularTexture: RGB multiplies specularColor. */

void PLUG_material_specular(inout vec3 specular) {
    vec4 value = vec4(1.0);
    /* PLUG: texture_value (value) */
    specular *= value.rgb;
}
