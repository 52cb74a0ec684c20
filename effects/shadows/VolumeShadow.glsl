/* The shadow that volumes cast: of light that goes straight to a place exp(-depth) arrives there, where
 * depth is the optical depth of all volumes on its way. (Beer and Lambert; N. Max, Optical Models for
 * Direct Volume Rendering, TVCG 1(2), 1995: single scattering.) ISO/IEC 19775-1 V4 41.4.10, `shadows`.
 * Lights ask for it before they add ambient light, which comes from everywhere.
 *
 * `light` is what the light would bring, and the opacity of what it falls on: nothing is asked where it
 * brings nothing, nor, with SKIPS_CLEAR, where that cannot be seen. */

void PLUG_light_shadow(inout float shadow, const in vec4 light, const in vec4 vertex_eye,
                       const in vec3 light_dir, const in float reach) {
    if (light.rgb == vec3(0.0))
        return;
#if SKIPS_CLEAR
    if (light.a <= 0.0)
        return;
#endif
    float depth = 0.0;
    vec3 from_eye = vertex_eye.xyz / vertex_eye.w;
    /* PLUG: volume_shadow (depth, from_eye, light_dir, reach) */
    shadow = 1.0 - (1.0 - shadow) * exp(-depth);
}
