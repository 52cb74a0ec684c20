/* The shadow that falls on a surface in a light that has a map of depths: L. Williams, Casting Curved
 * Shadows on Curved Surfaces, SIGGRAPH 1978. Filtered as W. Reeves, D. Salesin and R. Cook say
 * (Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987): 3 x 3 comparisons, each of them
 * interpolated. Attached to the light, whose contribution it scales: by 1 - shadowIntensity in full
 * shadow (ISO/IEC 19775-1 V4 17.3.1). What is beside the map is lit. SURFACE is 0 in volumes, where
 * there are no triangles. */

uniform sampler2DShadow shadowMap;
uniform mat4 eyeToShadow = mat4(1.0);   /* to 0..1 in the map, by w */
uniform vec3 shadowAxis = vec3(0.0);    /* across the map, in eye space */
uniform float shadowTexel = 0.0;        /* a texel's side in eye space, divided by w */
uniform float shadowOffset = 1.0;       /* 0 where the depths of the map are already set back */
uniform float shadowDepthBias = 0.0;
uniform float shadowIntensity = 1.0;

void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir,
                      const in vec4 vertex_eye) {
#if SURFACE
    vec3 normal = shadow_plane(vertex_eye, light_dir);
#else
    vec3 normal = normal_eye;
#endif
    vec4 place = eyeToShadow * vertex_eye;
    if (!(place.w > 0.0))
        return;
    vec3 shift = shadow_shift(normal, shadowAxis, light_dir);
    place += eyeToShadow * vec4(shift * (shadowOffset * shadowTexel * place.w), 0.0);
    vec3 at = place.xyz / place.w;
    /* beyond the farthest caster the map's far plane still shadows */
    at.z = clamp(at.z - shadowDepthBias, 0.0, 1.0);
    if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThan(at.xy, vec2(1.0))))
        return;
    vec2 texel = 1.0 / vec2(textureSize(shadowMap, 0));
    float lit = 0.0;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++)
            lit += textureLod(shadowMap, vec3(at.xy + vec2(float(x), float(y)) * texel, at.z), 0.0);
    scale *= 1.0 - shadowIntensity * (1.0 - lit / 9.0);
}
