/* ISO/IEC 19775-1 V4 11.4.1, ClipPlane: what lies at (x, y, z) of the plane's own coordinates is kept where
 * a x + b y + c z + d is not negative. */

uniform mat4 eyeToNode = mat4(1.0);
uniform vec4 plane = vec4(0.0, 1.0, 0.0, 0.0);

void PLUG_surface_clip(const in vec4 vertex_eye) {
    if (dot(plane, eyeToNode * vertex_eye) < 0.0)
        discard;
}
