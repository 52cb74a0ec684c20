/* glTF 2.0 B.3, what ISO/IEC 19775-1 V4 17.2.2.7 refers to: the reflected part of the light from `light_dir`,
 * times the cosine. `diffuse` is c_diff, `specular` f0, `alpha` the square of the roughness. */
vec3 physical_reflection(vec3 diffuse, vec3 specular, float alpha, vec4 vertex_eye, vec3 normal_eye,
                         vec3 light_dir) {
    float n_dot_l = dot(normal_eye, light_dir);
    if (n_dot_l <= 0.0)
        return vec3(0.0);
    vec3 view = direction_to_viewer(vertex_eye);
    vec3 between = unit_or_zero(light_dir + view);
    float n_dot_v = abs(dot(normal_eye, view)), n_dot_h = max(dot(normal_eye, between), 0.0);
    float v_dot_h = dot(view, between); /* their angle is at most a right one */
    float a2 = alpha * alpha;

    /* B.3.2: D, Trowbridge-Reitz/GGX, and V = G / (4 |N.L| |N.V|), Smith */
    float spread = n_dot_h * n_dot_h * (a2 - 1.0) + 1.0;
    float d = a2 / (3.14159265358979 * spread * spread);
    float v = 1.0 / ((n_dot_l + sqrt(a2 + (1.0 - a2) * n_dot_l * n_dot_l)) *
                     (n_dot_v + sqrt(a2 + (1.0 - a2) * n_dot_v * n_dot_v)));
    /* B.3.4, F: Schlick's approximation */
    float x = 1.0 - v_dot_h, x2 = x * x;
    vec3 f = specular + (1.0 - specular) * (x2 * x2 * x);
    /* B.3.5 */
    return n_dot_l * ((1.0 - f) * diffuse / 3.14159265358979 + f * (v * d));
}

/* From linear light to the numbers of a display, which answers to them by their power of 2.2. */
vec3 linear_to_display(vec3 color) {
    return pow(max(color, 0.0), vec3(1.0 / 2.2));
}
