/* The Phong material. ISO/IEC 19775-1 V4 17.2.2: the fragment is emissive colour plus what each light
 * adds; ambient, diffuse and specular colour meet the light in the lights' own effects. Colours at
 * the vertices stand for diffuse colour. */

#if !HAS_COLORS
uniform vec3 diffuseColor = vec3(0.8);
#endif
uniform vec3 emissiveColor = vec3(0.0);
uniform float transparency = 0.0;

#if PLUG_USED(add_light)
uniform float ambientIntensity = 0.2;
uniform vec3 specularColor = vec3(0.0);
uniform float shininess = 0.2;
#endif

MaterialInfo material;

void PLUG_surface_color(inout vec4 fragment_color) {
#if !HAS_COLORS
    fragment_color.rgb = diffuseColor;
#endif
    fragment_color.a *= 1.0 - transparency;

#if PLUG_USED(add_light)
    material.specular = specularColor;
    material.shininess = 128.0 * shininess;
    /* PLUG: material_specular (material.specular) */
    /* PLUG: material_shininess (material.shininess) */
#endif
}

void PLUG_surface_light(inout vec4 fragment_color) {
    vec4 lit = vec4(0.0, 0.0, 0.0, fragment_color.a);
#if PLUG_USED(add_light)
    material.diffuse = fragment_color.rgb;
    material.ambient = ambientIntensity * fragment_color.rgb;
    /* PLUG: material_ambient (material.ambient) */
#endif

#if PLUG_USED(material_light_ambient)
    /* light from no light in particular: none, unless an effect brings some */
    vec3 light_ambient = vec3(0.0);
#endif
    /* PLUG: material_light_ambient (light_ambient) */
#if PLUG_USED(material_light_ambient)
    lit.rgb += light_ambient;
#endif

    /* PLUG: add_light (lit, surface_vertex_eye, surface_normal_eye, material) */
    /* PLUG: material_occlusion (lit) */

    vec3 emissive = emissiveColor;
    /* PLUG: material_emissive (emissive) */
    lit.rgb += emissive;
    fragment_color = lit;
}
