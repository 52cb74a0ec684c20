/* Lighting of samples. ISO/IEC 19775-1 V4 41.4.10: Cg = CE + sum over the lights (Blinn-Phong, see the
 * lights' own effects), Og = Ov (1 - transparency). Without a Material the incoming colour is the
 * diffuse colour. Where the gradient is zero only ambient and emissive remain. */

#if lighting
#if HAS_material
uniform vec3 material_diffuseColor = vec3(0.8);
uniform vec3 material_specularColor = vec3(0.0);
uniform vec3 material_emissiveColor = vec3(0.0);
uniform float material_ambientIntensity = 0.2;
uniform float material_shininess = 0.2;
#endif
#elif HAS_material
uniform vec3 material_diffuseColor = vec3(0.8);
#endif
#if HAS_material
uniform float material_transparency = 0.0;
#endif

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
#if lighting
    MaterialInfo material;
#if HAS_material
    material.diffuse = material_diffuseColor;
    material.ambient = material_ambientIntensity * material.diffuse;
    material.specular = material_specularColor;
    material.shininess = 128.0 * material_shininess;
    vec4 lit = vec4(material_emissiveColor, color.a);
#else
    material.diffuse = color.rgb;
    material.ambient = 0.2 * material.diffuse;
    material.specular = vec3(0.0);
    material.shininess = 0.2 * 128.0;
    vec4 lit = vec4(0.0, 0.0, 0.0, color.a);
#endif
    /* PLUG: add_light (lit, vec4(s.position_eye, 1.0), s.normal_eye, material) */
    color = lit;
#elif HAS_material
    color.rgb = material_diffuseColor;
#endif
#if HAS_material
    color.a *= 1.0 - material_transparency;
#endif
}
