/* Fog and LocalFog. ISO/IEC 19775-1 V4 24.2: C = I_F C_F + (1 - I_F) C; the interpolant falls
 * from 1 at the viewer to 0 at visibilityRange, which is a length in the fog's own coordinates, as
 * is the distance from the viewer. FogCoordinate gives that distance at the vertices. With the
 * extension `volumetric` it is the depth below a plane instead, wherever the viewer is: measured
 * along volumetricDirection, from volumetricVisibilityStart on. The extension visibilityStart keeps
 * fog away from what is nearer. */

uniform mat4 eyeToNode = mat4(1.0);
uniform vec3 color = vec3(1.0);
uniform float visibilityRange = 0.0;
uniform float visibilityStart = 0.0;
#if volumetric
uniform vec3 volumetricDirection = vec3(0.0, -1.0, 0.0);
uniform float volumetricVisibilityStart = 0.0;
#endif

#if HAS_FOG_COORD && !volumetric
in float fog_coordinate;
#elif COMPLETE
in vec4 fog_place;
#define FOG_PLACE fog_place
#elif VOLUME
#define FOG_PLACE sample_place
#else
#define FOG_PLACE surface_vertex_eye
#endif

/* How much of the surface is seen through so much fog. The range is not 0: there is no such fog. */
float fog_interpolant(float depth) {
#if defined(GIVEN_visibilityStart) || defined(fogType_EXPONENTIAL)
    if (depth >= visibilityRange)
        return 0.0;
    float range = visibilityRange;
#if defined(GIVEN_visibilityStart)
    depth = max(depth - visibilityStart, 0.0);
    range -= visibilityStart;
#endif
#if defined(fogType_EXPONENTIAL)
    return exp(-depth / (range - depth));
#else
    return 1.0 - depth / range;
#endif
#else
    return max(1.0 - depth / visibilityRange, 0.0);
#endif
}

float fog_depth() {
#if volumetric
    vec3 place = (eyeToNode * FOG_PLACE).xyz;
    return max(dot(place, unit_or_zero(volumetricDirection)) - volumetricVisibilityStart, 0.0);
#elif HAS_FOG_COORD
    return max(fog_coordinate, 0.0);
#else
    return length((eyeToNode * vec4(FOG_PLACE.xyz, 0.0)).xyz);
#endif
}

#if VOLUME
void PLUG_volume_fog(inout vec4 sample_color) {
    sample_color = vec4(mix(color, rgb_of(sample_color), fog_interpolant(fog_depth())), sample_color.a);
}
#else
void PLUG_fog_apply(inout vec4 fragment_color, const in vec3 normal_eye) {
    fragment_color = vec4(mix(color, rgb_of(fragment_color), fog_interpolant(fog_depth())), fragment_color.a);
}
#endif
