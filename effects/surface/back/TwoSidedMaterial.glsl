/* The material of back sides, of TwoSidedMaterial with separateBackColor: ISO/IEC 19775-1 V4 12.4.8. */

uniform vec3 backDiffuseColor = vec3(0.8);
uniform vec3 backEmissiveColor = vec3(0.0);
uniform float backTransparency = 0.0;
uniform float backAmbientIntensity = 0.2;
uniform vec3 backSpecularColor = vec3(0.0);
uniform float backShininess = 0.2;

void PLUG_material_back_color(inout vec3 color, inout float clear) {
    if (gl_FrontFacing)
        return;
    color = backDiffuseColor;
    clear = backTransparency;
}

void PLUG_material_back_shine(inout float ambient, inout vec3 specular, inout float exponent) {
    if (gl_FrontFacing)
        return;
    ambient = backAmbientIntensity;
    specular = backSpecularColor;
    exponent = backShininess;
}

void PLUG_material_back_emissive(inout vec3 emissive) {
    if (!gl_FrontFacing)
        emissive = backEmissiveColor;
}
