/* ISO/IEC 19775-1 V4 12.4.5, Material.ambientTexture: RGB multiplies the ambient parameter. */

void PLUG_material_ambient(inout vec3 ambient) {
    vec4 value = vec4(1.0);
    /* PLUG: texture_value (value) */
    ambient *= value.rgb;
}
