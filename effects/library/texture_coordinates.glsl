/* What texture coordinates are made with and changed by. */

/* ISO/IEC 19775-1 V4 18.4.12: Tc' = -C S R C T Tc, the rightmost first. Homogeneous coordinates stay so. */
vec2 transformed_tex_coord(vec4 tex_coord, vec2 translation, vec2 center, float rotation, vec2 scale) {
    vec2 moved = tex_coord.st + (translation + center) * tex_coord.q;
    float c = cos(rotation), s = sin(rotation);
    vec2 turned = vec2(c * moved.s - s * moved.t, s * moved.s + c * moved.t);
    return scale * turned - center * tex_coord.q;
}

/* 33.4.5, in space; the rotation is an axis and an angle (Rodrigues' formula). */
vec3 transformed_tex_coord(vec4 tex_coord, vec3 translation, vec3 center, vec4 rotation, vec3 scale) {
    vec3 moved = tex_coord.stp + (translation + center) * tex_coord.q;
    vec3 axis = unit_or_zero(rotation.xyz);
    float c = cos(rotation.w), s = sin(rotation.w);
    if (axis != vec3(0.0))
        moved = c * moved + s * cross(axis, moved) + (1.0 - c) * dot(axis, moved) * axis;
    return scale * moved - center * tex_coord.q;
}

/* Where the view goes from a surface: reflected, or with an index of refraction above 0 into it. */
vec3 bent_direction(vec3 seen, vec3 normal, float refraction) {
    return refraction > 0.0 ? refract(seen, normal, 1.0 / refraction) : reflect(seen, normal);
}

/* 18.4.8, NOISE: the parameters are three scales and a translation. */
vec3 scaled_and_moved(vec3 place, float parameter[6]) {
    return place * vec3(parameter[0], parameter[1], parameter[2]) +
           vec3(parameter[3], parameter[4], parameter[5]);
}
