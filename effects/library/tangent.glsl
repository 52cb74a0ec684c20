/* What bumps share. */

#ifdef PLUGRAY_FRAGMENT
/* The directions in which texture coordinates grow on the surface, and its normal: columns of length 1,
 * orthogonal. From the derivatives of place and coordinates across the screen, so that no
 * tangents need be given, and vertices may be moved as effects like. With the derivatives along x and y
 * p' = T s' + B t' is solved for T and B, as in C. Schueler, "Normal Mapping without Precomputed
 * Tangents", ShaderX5, 2006; B is made from N and T as glTF 2.0 3.7.2.1 says. Zero where the
 * coordinates do not run across the surface. */
mat3 tangent_frame(vec3 place_eye, vec2 tex_coord, vec3 normal_eye) {
    vec3 p1 = dFdx(place_eye), p2 = dFdy(place_eye);
    vec2 c1 = dFdx(tex_coord), c2 = dFdy(tex_coord);
    float side = sign(c1.s * c2.t - c2.s * c1.t);
    vec3 t = side * (p1 * c2.t - p2 * c1.t), b = side * (p2 * c1.s - p1 * c2.s);
    t = unit_or_zero(t - normal_eye * dot(normal_eye, t));
    vec3 across = cross(normal_eye, t);
    return mat3(t, dot(across, b) < 0.0 ? -across : across, normal_eye);
}

/* The same from a tangent at the vertices: xyz, and in w the side of the other one (glTF 2.0 3.7.2.1). */
mat3 given_tangent_frame(vec4 tangent_eye, vec3 normal_eye) {
    vec3 t = unit_or_zero(tangent_eye.xyz - normal_eye * dot(normal_eye, tangent_eye.xyz));
    return mat3(t, tangent_eye.w * cross(normal_eye, t), normal_eye);
}
#endif
