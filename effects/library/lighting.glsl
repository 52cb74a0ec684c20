/* What the lights share. */

/* The direction at length 1; what has no direction stays zero. */
vec3 unit_or_zero(vec3 direction) {
    return direction * inversesqrt(dot(direction, direction) + 1e-37);
}

/* The colour without its alpha. By its components: compilers then see that what one effect puts together the
 * next takes apart, which they do not see through a swizzle. */
vec3 rgb_of(vec4 color) {
    return vec3(color.r, color.g, color.b);
}

/* From a point in eye space, which is not the eye's own, to the viewer, length 1; in parallel projection the
 * same for all. */
vec3 direction_to_viewer(vec4 vertex_eye) {
    float parallel = castle_ProjectionMatrix[3][3]; /* 1, or 0 in perspective */
    return normalize(vec3(0.0, 0.0, parallel) - (1.0 - parallel) * vertex_eye.xyz);
}

/* ISO/IEC 19775-1 V4 17.2.2: diffuse_i + specular_i without I_i. `light_dir` is the unit vector to
 * the light, L; H lies between L and the direction to the viewer. A zero normal reflects nothing. */
vec3 phong_reflection(MaterialInfo material, vec4 vertex_eye, vec3 normal_eye, vec3 light_dir) {
    vec3 reflected = material.diffuse * max(dot(normal_eye, light_dir), 0.0);
    vec3 between = light_dir + direction_to_viewer(vertex_eye);
    float n_dot_h = dot(normal_eye, between) * inversesqrt(dot(between, between) + 1e-37);
    /* pow is not defined where both are 0; a sum costs less than a max, which must mind NaN */
    float shine = pow(max(n_dot_h, 0.0), material.shininess + 1e-30);
    return reflected + shine * material.specular;
}

/* What a light calls: how the material meets it. A material's effect that knows better has a function of
 * this name, and a MaterialInfo, of its own. */
vec3 material_reflection(MaterialInfo material, vec4 vertex_eye, vec3 normal_eye, vec3 light_dir) {
    return phong_reflection(material, vertex_eye, normal_eye, light_dir);
}

/* 17.2.2: 1 / max(c1 + c2 d + c3 d^2, 1), and nothing beyond the radius; the distance d is in the
 * light's own lengths, as its radius and attenuation are. */
float light_attenuation(float d, vec3 attenuation, float radius) {
    float weakening = max(attenuation.x + (attenuation.y + attenuation.z * d) * d, 1.0);
    return d > radius ? 0.0 : 1.0 / weakening;
}
