/* Colour and opacity from a transfer function. ISO/IEC 19775-1 V4 41.4.8; never lit.
 * L goes to S; LA to S, T; RGB to S, T, R; what the function has no dimension for is ignored. 0 and 1
 * are the centres of the outer texels. */

#if transferFunction_DIMENSIONS == 3
uniform sampler3D transferFunction;
#else
uniform sampler2D transferFunction;
#endif

vec4 transfer(const in vec4 value) {
#if transferFunction_DIMENSIONS == 3
    vec3 size = vec3(textureSize(transferFunction, 0));
    vec3 at = clamp(value.rgb, 0.0, 1.0);
#else
    vec2 size = vec2(textureSize(transferFunction, 0));
#if voxels_COMPONENTS >= 2
    vec2 at = clamp(value.rg, 0.0, 1.0);
#else
    vec2 at = vec2(clamp(value.r, 0.0, 1.0), 0.0);
#endif
#endif
    return texture(transferFunction, (at * (size - 1.0) + 0.5) / size);
}

#if LEADING
void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {
    color = transfer(s.value);
}
#else
void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    color = transfer(s.value);
}
#endif
