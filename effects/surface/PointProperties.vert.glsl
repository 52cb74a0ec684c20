/* Sizes of points: ISO/IEC 19775-1 V4 12.4.6. A point of nominal size covers a pixel; the factor multiplies that. With
 * attenuation it shrinks with the distance from the viewer, within the two bounds, which concern nothing
 * else: by default they would forbid any other size than the nominal one. */

uniform vec3 attenuation = vec3(1.0, 0.0, 0.0);
uniform float pointSizeScaleFactor = 1.0;
uniform float pointSizeMinValue = 1.0;
uniform float pointSizeMaxValue = 1.0;

void PLUG_vertex_place(const in vec4 vertex_eye) {
    float size = pointSizeScaleFactor;
    if (attenuation != vec3(1.0, 0.0, 0.0)) {
        float d = length(vertex_eye.xyz);
        size /= attenuation.x + (attenuation.y + attenuation.z * d) * d;
        size = clamp(size, pointSizeMinValue, pointSizeMaxValue);
    }
    gl_PointSize = size;
}
