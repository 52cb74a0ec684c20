/* ISO/IEC 19775-1 V4 17.4, DirectionalLight, and 17.2.2. A zero normal gets ambient light only. What meets the light, and how, is the
 * material's: material_reflection. */

uniform vec3 direction = vec3(0.0, 0.0, -1.0);
uniform vec3 color = vec3(1.0);
uniform float intensity = 1.0;
uniform float ambientIntensity = 0.0;

/* Also for effects on this light: where it shines, length 1. */
uniform vec3 light_direction_eye = vec3(0.0, 0.0, -1.0);

#if defined(IN_SHADOW)
uniform float shadowIntensity = 1.0;
#endif

void PLUG_add_light(inout vec4 lit, const in vec4 vertex_eye, const in vec3 normal_eye,
                    const in MaterialInfo material) {
    vec3 light_dir = -light_direction_eye;
#if PLUG_USED(light_scale) || defined(IN_SHADOW)
    float scale = 1.0;
#endif
    /* PLUG: light_scale (scale, normal_eye, light_dir) (scale, normal_eye, light_dir, vertex_eye) */
    vec3 light_color = color;
    /* PLUG: light_color (light_color, vertex_eye, light_dir) */
#if PLUG_USED(light_scale)
    light_color *= scale;
#endif
    vec3 reflected = intensity * material_reflection(material, vertex_eye, normal_eye, light_dir);
#if defined(IN_SHADOW)
    float shadow = 0.0;
    vec4 brought = vec4(scale * reflected, lit.a);
    /* PLUG: light_shadow (shadow, brought, vertex_eye, light_dir, NOWHERE) */
    reflected *= 1.0 - shadowIntensity * shadow;
#endif
#if !defined(NO_AMBIENT)
    reflected += ambientIntensity * material.ambient;
#endif
    lit = vec4(rgb_of(lit) + light_color * reflected, lit.a);
}
