/* The Phong material of CommonSurfaceShader, an extension (Schwenk, Jung, Behr and Fellner 2010, "A modern
 * declarative surface shader for X3D"; here its Phong part): as Material, but the ambient colour does not depend
 * on the diffuse one. */

uniform vec3 diffuseFactor = vec3(0.8);
uniform vec3 emissiveFactor = vec3(0.0);
uniform float alphaFactor = 1.0;

#if PLUG_USED(add_light)
uniform vec3 ambientFactor = vec3(0.2);
uniform vec3 specularFactor = vec3(0.0);
uniform float shininessFactor = 0.2;

MaterialInfo material;
#endif

void PLUG_surface_color(inout vec4 fragment_color) {
    fragment_color = vec4(diffuseFactor, alphaFactor);
#if PLUG_USED(add_light)
    material.specular = specularFactor;
    material.shininess = 128.0 * shininessFactor;
    /* PLUG: material_specular (material.specular) */
    /* PLUG: material_shininess (material.shininess) */
#endif
}

void PLUG_surface_light(inout vec4 fragment_color) {
    vec4 lit = vec4(0.0, 0.0, 0.0, fragment_color.a);
#if PLUG_USED(add_light)
    material.diffuse = fragment_color.rgb;
    material.ambient = ambientFactor;
    /* PLUG: material_ambient (material.ambient) */
#endif

#if PLUG_USED(material_light_ambient)
    vec3 light_ambient = vec3(0.0); /* unless an effect brings some */
#endif
    /* PLUG: material_light_ambient (light_ambient) */
#if PLUG_USED(material_light_ambient)
    lit.rgb += light_ambient;
#endif

    /* PLUG: add_light (lit, surface_vertex_eye, surface_normal_eye, material) (lit, surface_vertex_eye, surface_normal_eye, material, direction_to_viewer(surface_vertex_eye)) */
    /* PLUG: material_occlusion (lit) */

    vec3 emissive = emissiveFactor;
    /* PLUG: material_emissive (emissive) */
    lit.rgb += emissive;
    fragment_color = lit;
}
