/* The Phong material. ISO/IEC 19775-1 V4 17.2.2: the fragment is emissive colour plus what each light
 * adds; ambient, diffuse and specular colour meet the light in the lights' own effects, through
 * material_reflection of the library. */

#if !HAS_COLORS || COLORS_MODULATE
uniform vec3 diffuseColor = vec3(0.8);
#endif
uniform vec3 emissiveColor = vec3(0.0);
uniform float transparency = 0.0;

#if PLUG_USED(add_light)
uniform float ambientIntensity = 0.2;
uniform vec3 specularColor = vec3(0.0);
uniform float shininess = 0.2;

MaterialInfo material;
float ambient_part; /* of the diffuse colour */
#endif

void PLUG_surface_color(inout vec4 fragment_color) {
#if !HAS_COLORS || COLORS_MODULATE
    vec3 color = diffuseColor;
#else
    vec3 color = vec3(1.0);
#endif
    float clear = transparency;
    /* PLUG: material_back_color (color, clear) */
    fragment_color = vec4(color, 1.0 - clear);

#if PLUG_USED(add_light)
    ambient_part = ambientIntensity;
    material.specular = specularColor;
    material.shininess = shininess;
    /* PLUG: material_back_shine (ambient_part, material.specular, material.shininess) */
    material.shininess *= 128.0;
    /* PLUG: material_specular (material.specular) */
    /* PLUG: material_shininess (material.shininess) */
#endif
}

void PLUG_surface_light(inout vec4 fragment_color) {
    vec4 lit = vec4(0.0, 0.0, 0.0, fragment_color.a);
#if PLUG_USED(add_light)
    material.diffuse = rgb_of(fragment_color);
    material.ambient = ambient_part * material.diffuse;
    /* PLUG: material_ambient (material.ambient) */
#endif

#if PLUG_USED(material_light_ambient)
    /* light from no light in particular: none, unless an effect brings some */
    vec3 light_ambient = vec3(0.0);
#endif
    /* PLUG: material_light_ambient (light_ambient) */
#if PLUG_USED(material_light_ambient)
    lit = vec4(rgb_of(lit) + light_ambient, lit.a);
#endif

    /* PLUG: add_light (lit, surface_vertex_eye, surface_normal_eye, material) (lit, surface_vertex_eye, surface_normal_eye, material, direction_to_viewer(surface_vertex_eye)) */
    /* PLUG: material_occlusion (lit) */

    vec3 emissive = emissiveColor;
    /* PLUG: material_back_emissive (emissive) */
    /* PLUG: material_emissive (emissive) */
    fragment_color = vec4(rgb_of(lit) + emissive, lit.a);
}
