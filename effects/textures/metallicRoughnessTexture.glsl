/* ISO/IEC 19775-1 V4 12.4.6, PhysicalMaterial.metallicRoughnessTexture: B multiplies metallic, G roughness. */

void PLUG_material_metallic_roughness(inout float metallic, inout float roughness) {
    vec4 value = vec4(1.0);
    /* PLUG: texture_value (value) */
    metallic *= value.b;
    roughness *= value.g;
}
