/* ISO/IEC 19775-1 V4 11.4.1, ClipPlane: what lies at (x, y, z) of the plane's own coordinates is kept where
 * a x + b y + c z + d is not negative. */

uniform mat4 eyeToNode = mat4(1.0);
uniform vec4 plane = vec4(0.0, 1.0, 0.0, 0.0);

#if !VOLUME
void PLUG_surface_clip(const in vec4 vertex_eye) {
    if (dot(plane, eyeToNode * vertex_eye) < 0.0)
        discard;
}
#else
/* Of a ray through a volume: what lies on the side that is kept. */
void PLUG_volume_ray(inout float t_enter, inout float t_exit, const in vec3 origin_eye,
                     const in vec3 direction_eye) {
    float at_eye = dot(plane, eyeToNode * vec4(origin_eye, 1.0));
    float growth = dot(plane, eyeToNode * vec4(direction_eye, 0.0));
    if (growth > 0.0)
        t_enter = max(t_enter, -at_eye / growth);
    else if (growth < 0.0)
        t_exit = min(t_exit, -at_eye / growth);
    else if (at_eye < 0.0)
        t_exit = -NOWHERE;
}
#endif
