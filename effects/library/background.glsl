/* A direction of eye space in the coordinates of a background. ISO/IEC 19775-1 V4 24.2.1: of the groups
 * around it the background takes the turns, not the scales. */
vec3 background_direction(const in mat4 node_to_eye, const in vec3 direction_eye) {
    return direction_eye * mat3(unit_or_zero(node_to_eye[0].xyz), unit_or_zero(node_to_eye[1].xyz),
                                unit_or_zero(node_to_eye[2].xyz));
}
