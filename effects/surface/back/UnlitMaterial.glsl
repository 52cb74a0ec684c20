/* The material of back sides, Appearance.backMaterial: ISO/IEC 19775-1 V4 12.4.2. */

uniform vec3 emissiveColor = vec3(1.0);
uniform float transparency = 0.0;

void PLUG_material_back_color(inout vec3 color, inout float clear) {
    if (gl_FrontFacing)
        return;
    color = emissiveColor;
    clear = transparency;
}
