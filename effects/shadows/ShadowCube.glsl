/* As ShadowMap.glsl, of a light that shines in all directions: the map is a cube around it, with the
 * axes of the world. The taps lie in the plane across the axis of the face on which the point falls. */

uniform samplerCubeShadow shadowMap;
uniform mat4 eyeToShadow = mat4(1.0);   /* to the light's place, axes of the world */
uniform float shadowTexel = 0.0;        /* a texel's side at distance 1 from the light */
uniform vec2 shadowDepths = vec2(0.0);  /* depth in the map: x + y / distance along the face's axis */
uniform float shadowOffset = 1.0;       /* 0 where the depths of the map are already set back */
uniform float shadowDepthBias = 0.0;
uniform float shadowIntensity = 1.0;

/* The axis of the face on which a direction falls. */
vec3 face_axis(vec3 from_light) {
    vec3 d = abs(from_light);
    if (d.x >= d.y && d.x >= d.z)
        return vec3(1.0, 0.0, 0.0);
    return d.y >= d.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
}

float lit_at(vec3 from_light) {
    vec3 d = abs(from_light);
    float depth = shadowDepths.x + shadowDepths.y / max(max(d.x, d.y), d.z) - shadowDepthBias;
    return texture(shadowMap, vec4(from_light, clamp(depth, 0.0, 1.0)));
}

void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir,
                      const in vec4 vertex_eye) {
#if SURFACE
    vec3 normal = shadow_plane(vertex_eye, light_dir);
#else
    vec3 normal = normal_eye;
#endif
    mat3 turn = mat3(eyeToShadow);
    vec3 place = (eyeToShadow * vertex_eye).xyz / vertex_eye.w;
    vec3 axis = face_axis(place);
    float texel = shadowTexel * abs(dot(place, axis));
    if (!(texel > 0.0))
        return;
    place += shadow_shift(turn * normal, axis, turn * light_dir) * (shadowOffset * texel);
    vec3 right = axis.zxy * texel, above = axis.yzx * texel;
    float lit = 0.0;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++)
            lit += lit_at(place + float(x) * right + float(y) * above);
    scale *= 1.0 - shadowIntensity * (1.0 - lit / 9.0);
}
