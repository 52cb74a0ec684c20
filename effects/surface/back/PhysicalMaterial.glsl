/* The material of back sides, Appearance.backMaterial: ISO/IEC 19775-1 V4 12.4.2. */

uniform vec3 baseColor = vec3(1.0);
uniform vec3 emissiveColor = vec3(0.0);
uniform float transparency = 0.0;
uniform float metallic = 1.0;
uniform float roughness = 1.0;

void PLUG_material_back_color(inout vec3 color, inout float clear) {
    if (gl_FrontFacing)
        return;
    color = baseColor;
    clear = transparency;
}

void PLUG_material_back_shine(inout vec2 metal_rough) {
    if (!gl_FrontFacing)
        metal_rough = vec2(metallic, roughness);
}

void PLUG_material_back_emissive(inout vec3 emissive) {
    if (!gl_FrontFacing)
        emissive = emissiveColor;
}
