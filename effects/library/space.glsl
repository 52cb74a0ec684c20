/* Between world and eye space. Positions are homogeneous; directions keep their length. */

vec4 position_world_to_eye_space(vec4 position) {
    return plugray_ViewMatrix * position;
}

vec4 position_eye_to_world_space(vec4 position) {
    return plugray_InverseViewMatrix * position;
}

vec3 direction_world_to_eye_space(vec3 direction) {
    return mat3(plugray_ViewMatrix) * direction;
}

vec3 direction_eye_to_world_space(vec3 direction) {
    return mat3(plugray_InverseViewMatrix) * direction;
}
