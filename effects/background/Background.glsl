/* Sky and ground. ISO/IEC 19775-1 V4 24.3.1 and 24.4.1: the first sky colour stands at the zenith, the
 * first ground colour at the nadir, the others at the angles that are given, linear between; the last
 * sky colour goes on to the nadir, the ground ends at its last angle. */

const int COLORS = 32; /* as many as this at most */
uniform mat4 nodeToEye = mat4(1.0);
uniform vec3 skyColor[COLORS];
uniform float skyAngle[COLORS];
uniform int skyColor_count;
uniform int skyAngle_count;
#if HAS_GROUND
uniform vec3 groundColor[COLORS];
uniform float groundAngle[COLORS];
uniform int groundColor_count;
uniform int groundAngle_count;
#endif
uniform float transparency = 0.0;

vec3 sky_at(float angle) {
    vec3 color = skyColor[0];
    float from = 0.0;
    for (int i = 1; i < min(skyColor_count, COLORS) && i <= skyAngle_count; i++) {
        float to = skyAngle[i - 1];
        color = mix(color, skyColor[i], clamp((angle - from) / max(to - from, 1.0e-6), 0.0, 1.0));
        from = to;
    }
    return color;
}

#if HAS_GROUND
/* True where the direction is down in the ground's part; then `color` is set. */
bool ground_at(float angle, inout vec3 color) {
    if (groundAngle_count < 1 || angle > groundAngle[min(groundAngle_count, COLORS) - 1])
        return false;
    color = groundColor[0];
    float from = 0.0;
    for (int i = 1; i < min(groundColor_count, COLORS) && i <= groundAngle_count; i++) {
        float to = groundAngle[i - 1];
        color = mix(color, groundColor[i], clamp((angle - from) / max(to - from, 1.0e-6), 0.0, 1.0));
        from = to;
    }
    return true;
}
#endif

void PLUG_background_color(inout vec4 color, const in vec3 direction_eye) {
    vec3 direction = background_direction(nodeToEye, direction_eye);
    /* not acos: it loses digits at small angles, and Mesa's is coarse everywhere */
    float from_zenith = atan(length(direction.xz), direction.y);
    color.rgb = sky_at(from_zenith);
#if HAS_GROUND
    ground_at(3.14159265358979 - from_zenith, color.rgb);
#endif
    color.a = 1.0 - transparency;
}
