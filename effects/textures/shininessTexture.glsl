/* ISO/IEC 19775-1 V4 12.4.5, Material.shininessTexture: A multiplies shininess. */

void PLUG_material_shininess(inout float shininess) {
    vec4 value = vec4(1.0);
    /* PLUG: texture_value (value) */
    shininess *= value.a;
}
