/* What styles have in common. It is the second unit of every style, so that each has a normal texture
 * and a transfer function of its own. */

uniform mat4 eyeToLocal;          /* eye space -> own coordinates of the volume */
uniform float gradientUnit = 1.0; /* one over the gradient that counts as 1 */
uniform float gradientMost = 1.0; /* 1, or no limit where the scene gives that unit */

#if defined(surfaceNormals_DIMENSIONS) && surfaceNormals_DIMENSIONS == 3 && surfaceNormals_COMPONENTS >= 3
uniform sampler3D surfaceNormals;

/* ISO/IEC 19775-1 V4 41.2: a texel t is the normal 2 t - 1 in own coordinates, seen through the trilinear filter. Eight bits
 * have no 0: what is within one step of it, as 127 and 128 are, is no normal. */
vec3 style_normal(const in VolumeSample s) {
    vec3 normal = 2.0 * texture(surfaceNormals, s.position).rgb - 1.0;
    if (all(lessThan(abs(normal), vec3(1.5 / 255.0))))
        return vec3(0.0);
    return unit_or_zero(normal * mat3(eyeToLocal)); /* as a covector, which normals are */
}
#else
vec3 style_normal(const in VolumeSample s) {
    return s.normal_eye;
}
#endif

/* The cosine of the angle between a normal and the direction to the viewer, n.V. */
float style_facing(const in VolumeSample s, const in vec3 normal) {
    return clamp(dot(normal, direction_to_viewer(vec4(s.position_eye, 1.0))), -1.0, 1.0);
}

/* "The normalised gradient" of 41.2: its magnitude over what counts as 1. */
float style_gradient(const in VolumeSample s) {
    return min(s.gradient * gradientUnit, gradientMost);
}

/* x^y of what is not negative: 0^0 is 1, as x^0 is everywhere, and nothing is infinite. */
float style_power(const in float x, const in float y) {
    if (y == 0.0)
        return 1.0;
    return x > 0.0 ? min(pow(x, y), 1.0e30) : 0.0;
}

#if defined(IN_ATLAS)
uniform vec4 transferPlace;

/* 41.4.7: L goes to S; LA to S, T; what the function has no dimension for is ignored. */
vec4 style_transfer(const in vec4 value) {
#if voxels_COMPONENTS >= 2
    return transfer_in(transferPlace, value.rg);
#else
    return transfer_in(transferPlace, vec2(value.r, 0.0));
#endif
}
#elif defined(transferFunction_DIMENSIONS) && transferFunction_DIMENSIONS >= 2
#if transferFunction_DIMENSIONS == 3
uniform sampler3D transferFunction;
#else
uniform sampler2D transferFunction;
#endif

/* 41.4.7: L goes to S; LA to S, T; RGB to S, T, R; what the function has no dimension for is ignored.
 * 0 and 1 are the centres of the outer texels. */
vec4 style_transfer(const in vec4 value) {
#if transferFunction_DIMENSIONS == 3
    vec3 size = vec3(textureSize(transferFunction, 0));
    return texture(transferFunction, (clamp(value.rgb, 0.0, 1.0) * (size - 1.0) + 0.5) / size);
#elif voxels_COMPONENTS >= 2
    return texture(transferFunction, function_coordinate(value.rg, textureSize(transferFunction, 0)));
#else
    vec2 at = vec2(value.r, 0.0);
    return texture(transferFunction, function_coordinate(at, textureSize(transferFunction, 0)));
#endif
}
#endif
