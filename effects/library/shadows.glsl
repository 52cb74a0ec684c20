/* What shadow maps share. */

/* Texels that the filter reaches from its centre, at most: one tap, the bilinear square around it,
 * along the diagonal. */
const float shadow_reach = 2.8284271;

/* In texels, how far from the point itself the map is asked, so that a surface does not shadow itself.
 * All taps lie in the plane of equal depths in the map, across `axis`. Within their reach r a surface
 * that is tilted by the angle a against that plane comes up by r sin a, measured along its normal:
 * shifted by that, all of the taps are before it, at every angle, and the shift is never longer than r
 * (D. Holbert, Saying Goodbye to Shadow Acne, GDC 2011). Half a texel towards the light pays for
 * rounding where the tilt is zero. */
vec3 shadow_shift(const in vec3 normal, const in vec3 axis, const in vec3 light_dir) {
    float cosine = dot(normal, axis);
    return shadow_reach * sqrt(max(1.0 - cosine * cosine, 0.0)) * normal + 0.5 * light_dir;
}

/* The plane of the triangle at this fragment, turned to the light: what a surface must not shadow
 * itself with is its shape, not the normals that light it. */
vec3 shadow_plane(const in vec4 vertex_eye, const in vec3 light_dir) {
    vec3 place = vertex_eye.xyz / vertex_eye.w;
    vec3 normal = unit_or_zero(cross(dFdx(place), dFdy(place)));
    return dot(normal, light_dir) < 0.0 ? -normal : normal;
}
