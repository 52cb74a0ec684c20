/* What the effects of volumes share. */

/* To [0,1]; what is no number becomes 0. */
vec4 clamped(const in vec4 color) {
    return mix(vec4(0.0), min(color, vec4(1.0)), greaterThan(color, vec4(0.0)));
}

/* Unit and in eye space, against the gradient; zero where that vanishes. A gradient is a covector: it
 * goes to eye space by the transpose of eye -> own coordinates. */
vec3 normal_of_gradient(const in vec3 gradient, const in mat3 eye_to_local) {
    vec3 normal = -(gradient * eye_to_local);
    float squared = dot(normal, normal);
    return squared > 0.0 ? normal * inversesqrt(squared) : vec3(0.0);
}

/* Texture coordinates of a transfer function: 0 and 1 are the centres of the outer texels. */
vec2 function_coordinate(const in vec2 at, const in ivec2 size) {
    return (clamp(at, 0.0, 1.0) * (vec2(size) - 1.0) + 0.5) / vec2(size);
}
