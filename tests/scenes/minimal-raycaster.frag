#version 330 core
// A raycaster written by hand for one bare volume: what the composed program is measured against.
// It does the same work: perspective and parallel rays, the box, midpoint samples with a shortened last
// step, a look ahead for samples that are not clear, a transfer function, opacity corrected for the step, front to back, an early end.

uniform mat4 castle_ProjectionMatrix;
uniform vec4 viewport;
uniform mat4 eyeToLocal;
uniform vec3 dimensions;
uniform float sampleDistance;
uniform float referenceLength;
uniform float transparencyLeft;
uniform sampler3D voxels;
uniform sampler2D transferFunction;
uniform vec2 visibleValues; // outside of these the function is clear

out vec4 result;

void main() {
    vec2 ndc = (gl_FragCoord.xy - viewport.xy) / viewport.zw * 2.0 - 1.0;
    mat4 p = castle_ProjectionMatrix;
    vec2 scale = vec2(p[0][0], p[1][1]);
    vec3 origin = vec3(0.0), direction = vec3(0.0, 0.0, -1.0);
    if (p[2][3] != 0.0)
        direction = normalize(vec3((ndc + p[2].xy) / scale, -1.0));
    else
        origin.xy = (ndc - p[3].xy) / scale;

    // in texture coordinates, the box is from 0 to 1
    vec3 d = mat3(eyeToLocal) * direction;
    float speed = length(d);
    vec3 o = (eyeToLocal * vec4(origin, 1.0)).xyz / dimensions + 0.5;
    d /= dimensions;
    vec3 along = mix(d, vec3(1.0e-30), equal(d, vec3(0.0)));
    vec3 a = -o / along, b = (1.0 - o) / along, near = min(a, b), far = max(a, b);
    float enter = max(max(near.x, near.y), max(near.z, 0.0));
    float leave = min(far.x, min(far.y, far.z));

    vec4 sum = vec4(0.0);
    float pace = sampleDistance / speed;
    int steps = int(clamp(ceil((leave - enter) / pace - 1.0e-3), 0.0, 1.0e6));
    vec2 size = vec2(textureSize(transferFunction, 0));
    int next = 0;
    while (next < steps) {
    int first = next;
    uint bits = 0u;
    for (; next < steps && next < first + 32; next++) {
        float from = enter + float(next) * pace;
        float span = next == steps - 1 ? leave - from : pace;
        float value = texture(voxels, o + (from + 0.5 * span) * d).r;
        if (value > visibleValues.x && value < visibleValues.y)
            bits |= 1u << uint(next - first);
    }
    while (bits != 0u) {
        int i = first + (floatBitsToInt(float(bits & (0u - bits))) >> 23) - 127;
        bits &= bits - 1u;
        float from = enter + float(i) * pace;
        float span = i == steps - 1 ? leave - from : pace;
        vec2 at = vec2(clamp(texture(voxels, o + (from + 0.5 * span) * d).r, 0.0, 1.0), 0.0);
        vec4 color = clamp(texture(transferFunction, (at * (size - 1.0) + 0.5) / size), 0.0, 1.0);
        if (color.a < 1.0) {
            // 1 - exp(-x), with all its digits for small x
            float x = -log(1.0 - color.a) * span * speed / referenceLength;
            color.a = x < 0.02 ? x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x / 24.0))) : 1.0 - exp(-x);
        }
        sum += (1.0 - sum.a) * vec4(color.rgb * color.a, color.a);
        if (1.0 - sum.a < transparencyLeft) {
            next = steps;
            break;
        }
    }
    }
    result = sum;
}
