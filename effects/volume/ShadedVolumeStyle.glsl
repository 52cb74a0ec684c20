/* Lighting of samples. ISO/IEC 19775-1 V4 41.4.10:
 *
 *     Cg = CE + sum over the lights of on att spot IL (ambient + diffuse + specular), Og = Ov (1 - transparency)
 *
 * Blinn-Phong through the lights' own effects; CE once, however many lights there are. Without a material
 * the incoming colour is the diffuse one. A PhysicalMaterial reflects as it does on surfaces, in
 * linear light; an UnlitMaterial has its emissiveColor alone. Without lighting the colour is flat: diffuseColor (baseColor,
 * emissiveColor of an unlit one), or what it was.
 *
 * Where there is no normal, lights bring only their ambient part. With shadows and the phase function of
 * Henyey and Greenstein they also scatter there: the diffuse colour times that function, which is 1 in all
 * directions where phaseAnisotropy is 0, so that the light of a cloud does not depend on where its
 * gradient vanishes. */

#if defined(HAS_material) && HAS_material
#define MATERIAL 1
#else
#define MATERIAL 0
#endif
#if lighting && !defined(material_UnlitMaterial)
#define LIT 1
#else
#define LIT 0
#endif
#if LIT && shadows && defined(phaseFunction_Henyey_Greenstein)
#define SCATTERS 1
#else
#define SCATTERS 0
#endif

#if MATERIAL
uniform float material_transparency = 0.0;
#if defined(material_UnlitMaterial)
uniform vec3 material_emissiveColor = vec3(1.0);
#elif defined(material_PhysicalMaterial)
uniform vec3 material_baseColor = vec3(1.0);
uniform float material_metallic = 1.0;
uniform float material_roughness = 1.0;
uniform vec3 material_emissiveColor = vec3(0.0);
#else
uniform vec3 material_diffuseColor = vec3(0.8);
uniform vec3 material_specularColor = vec3(0.0);
uniform vec3 material_emissiveColor = vec3(0.0);
uniform float material_ambientIntensity = 0.2;
uniform float material_shininess = 0.2;
#endif
#endif

#if LIT && PLUG_USED(add_light)
#if SCATTERS
uniform float phaseAnisotropy = 0.0;

/* Henyey and Greenstein 1941, times 4 pi; the cosine is that between the ways of the light before and
 * after. */
float phase_function(const in float cosine) {
    float g = clamp(phaseAnisotropy, -0.999, 0.999);
    float spread = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g * g) / (spread * sqrt(spread));
}
#endif

#if defined(material_PhysicalMaterial)
/* As that of surface/PhysicalMaterial; hides the library's own. */
struct MaterialInfo {
    vec3 ambient;  /* 0 */
    vec3 diffuse;  /* c_diff */
    vec3 specular; /* f0 */
    float alpha;   /* the square of the roughness */
};
#endif

#if SCATTERS || defined(material_PhysicalMaterial)
vec3 material_reflection(MaterialInfo material, vec4 vertex_eye, vec3 normal_eye, vec3 light_dir) {
#if SCATTERS
    if (normal_eye == vec3(0.0))
        return phase_function(-dot(light_dir, direction_to_viewer(vertex_eye))) * material.diffuse;
#endif
#if defined(material_PhysicalMaterial)
    return physical_reflection(material.diffuse, material.specular, material.alpha, vertex_eye, normal_eye,
                               light_dir);
#else
    return phong_reflection(material, vertex_eye, normal_eye, light_dir);
#endif
}
#endif

/* What the lights shall know of a sample of this colour. */
MaterialInfo material_of(const in vec3 color) {
    MaterialInfo material;
#if defined(material_PhysicalMaterial)
    float metal = clamp(material_metallic, 0.0, 1.0), rough = clamp(material_roughness, 0.0, 1.0);
    material.ambient = vec3(0.0);
    material.diffuse = material_baseColor * (1.0 - metal);
    material.specular = mix(vec3(0.04), material_baseColor, metal);
    material.alpha = max(rough * rough, 0.001);
#elif MATERIAL
    material.diffuse = material_diffuseColor;
    material.ambient = material_ambientIntensity * material.diffuse;
    material.specular = material_specularColor;
    material.shininess = 128.0 * material_shininess;
#else
    material.diffuse = color;
    material.ambient = 0.2 * material.diffuse;
    material.specular = vec3(0.0);
    material.shininess = 0.2 * 128.0;
#endif
    return material;
}
#endif

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
#if LIT
    vec4 lit = vec4(0.0, 0.0, 0.0, color.a);
#if PLUG_USED(add_light)
    MaterialInfo material = material_of(color.rgb);
    /* PLUG: add_light (lit, vec4(s.position_eye, 1.0), style_normal(s), material) */
#endif
#if MATERIAL
    color = vec4(rgb_of(lit) + material_emissiveColor, color.a);
#else
    color = vec4(rgb_of(lit), color.a);
#endif
#elif MATERIAL && defined(material_UnlitMaterial)
    color.rgb = material_emissiveColor;
#elif MATERIAL && defined(material_PhysicalMaterial)
    color.rgb = material_baseColor;
#elif MATERIAL
    color.rgb = material_diffuseColor;
#endif
#if MATERIAL && defined(material_PhysicalMaterial)
    color.rgb = linear_to_display(color.rgb);
#endif
#if MATERIAL
    color.a *= 1.0 - material_transparency;
#endif
}
