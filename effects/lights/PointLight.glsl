/* ISO/IEC 19775-1 V4 17.4, PointLight, and 17.2.2. Radius and attenuation are in the light's
 * own lengths. A zero normal gets ambient light only. What meets the light, and how, is the
 * material's: material_reflection. */

uniform float lengthToNode = 1.0;
uniform vec3 location = vec3(0.0);
uniform vec3 color = vec3(1.0);
uniform float intensity = 1.0;
uniform float ambientIntensity = 0.0;
uniform vec3 attenuation = vec3(1.0, 0.0, 0.0);
uniform float radius = 100.0;

/* Also for effects on this light: where it stands. */
uniform vec3 light_location_eye = vec3(0.0);

#if defined(IN_SHADOW)
uniform float shadowIntensity = 1.0;
#endif

void PLUG_add_light(inout vec4 lit, const in vec4 vertex_eye, const in vec3 normal_eye,
                    const in MaterialInfo material) {
    vec3 to_light = light_location_eye - vertex_eye.xyz;
    float far = length(to_light);
    vec3 light_dir = to_light / (far + 1e-18);
    float scale = 1.0;
    /* PLUG: light_scale (scale, normal_eye, light_dir) (scale, normal_eye, light_dir, vertex_eye) */
    scale *= light_attenuation(lengthToNode * far, attenuation, radius);
    vec3 light_color = color;
    /* PLUG: light_color (light_color, vertex_eye, light_dir) */
    vec3 reflected = intensity * material_reflection(material, vertex_eye, normal_eye, light_dir);
#if defined(IN_SHADOW)
    float shadow = 0.0;
    vec4 brought = vec4(scale * reflected, lit.a);
    /* PLUG: light_shadow (shadow, brought, vertex_eye, light_dir, far) */
    reflected *= 1.0 - shadowIntensity * shadow;
#endif
#if !defined(NO_AMBIENT)
    reflected += ambientIntensity * material.ambient;
#endif
    lit = vec4(rgb_of(lit) + scale * light_color * reflected, lit.a);
}
