/* The metallic-roughness material. ISO/IEC 19775-1 V4 17.2.2.7 takes it from glTF 2.0, whose appendix B
 * has the formulas (library/physical.glsl): a diffuse base under a rough dielectric interface, mixed with a rough metal. All
 * light is direct: a light brings no ambient part (17.2.2.7 has none). */

#if !HAS_COLORS || COLORS_MODULATE
uniform vec3 baseColor = vec3(1.0);
#endif
uniform vec3 emissiveColor = vec3(0.0);
uniform float transparency = 0.0;

#if PLUG_USED(add_light)
uniform float metallic = 1.0;
uniform float roughness = 1.0;

/* What a light needs to know of this material; hides the library's own. */
struct MaterialInfo {
    vec3 ambient;  /* 0 */
    vec3 diffuse;  /* c_diff */
    vec3 specular; /* f0 */
    float alpha;   /* the square of the roughness */
};

MaterialInfo material;
vec2 metal_rough;

vec3 material_reflection(MaterialInfo material, vec4 vertex_eye, vec3 normal_eye, vec3 light_dir) {
    return physical_reflection(material.diffuse, material.specular, material.alpha, vertex_eye, normal_eye,
                               light_dir);
}
#endif

void PLUG_surface_color(inout vec4 fragment_color) {
#if !HAS_COLORS || COLORS_MODULATE
    vec3 color = baseColor;
#else
    vec3 color = vec3(1.0);
#endif
    float clear = transparency;
    /* PLUG: material_back_color (color, clear) */
    fragment_color = vec4(color, 1.0 - clear);
#if PLUG_USED(add_light)
    metal_rough = vec2(metallic, roughness);
    /* PLUG: material_back_shine (metal_rough) */
    /* PLUG: material_metallic_roughness (metal_rough.x, metal_rough.y) */
#endif
}

void PLUG_surface_light(inout vec4 fragment_color) {
    vec4 lit = vec4(0.0, 0.0, 0.0, fragment_color.a);
#if PLUG_USED(add_light)
    float metal = clamp(metal_rough.x, 0.0, 1.0);
    float rough = clamp(metal_rough.y, 0.0, 1.0);
    material.ambient = vec3(0.0);
    vec3 base = rgb_of(fragment_color);
    material.diffuse = base * (1.0 - metal);
    material.specular = mix(vec3(0.04), base, metal);
    material.alpha = max(rough * rough, 0.001); /* a perfect mirror shows no point of light */
#endif

    /* PLUG: add_light (lit, surface_vertex_eye, surface_normal_eye, material) (lit, surface_vertex_eye, surface_normal_eye, material, direction_to_viewer(surface_vertex_eye)) */
    /* PLUG: material_occlusion (lit) */

    vec3 emissive = emissiveColor;
    /* PLUG: material_back_emissive (emissive) */
    /* PLUG: material_emissive (emissive) */
    fragment_color = vec4(rgb_of(lit) + emissive, lit.a);
}
