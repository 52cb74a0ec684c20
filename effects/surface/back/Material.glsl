/* The material of back sides, Appearance.backMaterial: ISO/IEC 19775-1 V4 12.4.2. */

uniform vec3 diffuseColor = vec3(0.8);
uniform vec3 emissiveColor = vec3(0.0);
uniform float transparency = 0.0;
uniform float ambientIntensity = 0.2;
uniform vec3 specularColor = vec3(0.0);
uniform float shininess = 0.2;

void PLUG_material_back_color(inout vec3 color, inout float clear) {
    if (gl_FrontFacing)
        return;
    color = diffuseColor;
    clear = transparency;
}

void PLUG_material_back_shine(inout float ambient, inout vec3 specular, inout float exponent) {
    if (gl_FrontFacing)
        return;
    ambient = ambientIntensity;
    specular = specularColor;
    exponent = shininess;
}

void PLUG_material_back_emissive(inout vec3 emissive) {
    if (!gl_FrontFacing)
        emissive = emissiveColor;
}
