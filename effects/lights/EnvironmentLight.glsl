/* ISO/IEC 19775-1 V4 17.4, EnvironmentLight: light from all around. What arrives at a surface is read from
 * diffuseTexture by its normal, in the light's own coordinates turned by `rotation`; without that texture
 * there is the ambient part alone. What specularTexture would mirror is not drawn. */

uniform mat4 eyeToNode = mat4(1.0);
uniform vec3 color = vec3(1.0);
uniform float ambientIntensity = 0.0;

#if HAS_diffuseTexture && diffuseTexture_DIMENSIONS == 6
uniform float intensity = 1.0;
uniform vec4 rotation = vec4(0.0, 0.0, 1.0, 0.0);
uniform samplerCube diffuseTexture;

/* Rodrigues' formula, backwards. */
vec3 unrotate(vec3 v, vec4 rotation) {
    vec3 axis = unit_or_zero(rotation.xyz);
    float c = cos(rotation.w), s = -sin(rotation.w);
    return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1.0 - c));
}
#endif

void PLUG_add_light(inout vec4 lit, const in vec4 vertex_eye, const in vec3 normal_eye,
                    const in MaterialInfo material) {
    vec3 light_dir = normal_eye;
#if PLUG_USED(light_scale)
    float scale = 1.0;
#endif
    /* PLUG: light_scale (scale, normal_eye, light_dir) (scale, normal_eye, light_dir, vertex_eye) */
    vec3 light_color = color;
    /* PLUG: light_color (light_color, vertex_eye, light_dir) */
#if PLUG_USED(light_scale)
    light_color *= scale;
#endif
    vec3 reflected = ambientIntensity * material.ambient;
#if HAS_diffuseTexture && diffuseTexture_DIMENSIONS == 6
    vec3 from = unrotate(mat3(eyeToNode) * normal_eye, rotation);
    reflected += intensity * material.diffuse * texture(diffuseTexture, from).rgb;
#endif
    lit = vec4(rgb_of(lit) + light_color * reflected, lit.a);
}
