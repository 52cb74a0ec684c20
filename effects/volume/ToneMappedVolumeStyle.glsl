/* Warm towards the light, cool away from it (Gooch et al. 1998). ISO/IEC 19775-1 V4 41.4.12:
 *
 *     cc = (1 + Li.n) / 2,  Cg = sum over the lights of cc warmColor + (1 - cc) coolColor,  Og = Ov
 *
 * The sum is not clamped before the end; the alphas of the colours do not enter. The lights' own effects
 * say from where they shine (material_reflection below); their colours and distances are not in the
 * formula. Without light, or a light with a direction, or a normal, nothing changes. */

#if PLUG_USED(add_light)
uniform vec4 coolColor = vec4(0.0, 0.0, 1.0, 0.0);
uniform vec4 warmColor = vec4(1.0, 1.0, 0.0, 0.0);

/* What the lights read of it means nothing here; hides the library's own. */
struct MaterialInfo {
    vec3 ambient;
    vec3 diffuse;
};

vec4 tones; /* their sum, and how many lights */

vec3 material_reflection(MaterialInfo material, vec4 vertex_eye, vec3 normal_eye, vec3 light_dir) {
    float warmth = 0.5 + 0.5 * dot(light_dir, normal_eye);
    tones += vec4(mix(coolColor.rgb, warmColor.rgb, warmth), 1.0);
    return vec3(0.0);
}
#endif

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
#if PLUG_USED(add_light)
    vec3 normal = style_normal(s);
    if (normal == vec3(0.0))
        return;
    tones = vec4(0.0);
    vec4 lit = vec4(0.0);
    MaterialInfo material = MaterialInfo(vec3(0.0), vec3(0.0));
    /* PLUG: add_light (lit, vec4(s.position_eye, 1.0), normal, material) */
    if (tones.a > 0.0)
        color.rgb = tones.rgb;
#endif
}
