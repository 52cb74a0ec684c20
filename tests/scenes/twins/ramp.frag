#version 330 core
uniform vec4 viewport;
uniform float rayPlane;
uniform float transparencyLeft;
uniform mat4 castle_ProjectionMatrix;
uniform vec3 plr0_localStart;
uniform float plr0_sampleDistance;
uniform float plr0_referenceLength;
uniform mat4 plr0_eyeToLocal;
uniform vec3 plr0_dimensions;
uniform sampler3D plr0_voxels;
uniform vec2 plr1_visibleValues;
uniform vec4 plr1_transferPlace;
uniform sampler2D plugray_TransferFunctions;
out vec4 plugray_FragColor;

void main() {
    // the ray, from the plane before the volume
    vec2 ndc = (gl_FragCoord.xy - viewport.xy) / viewport.zw * 2.0 - 1.0;
    mat4 p = castle_ProjectionMatrix;
    vec2 scale = vec2(p[0][0], p[1][1]);
    vec3 origin = vec3(0.0), direction = vec3(0.0, 0.0, -1.0);
    if (p[2][3] != 0.0)
        direction = normalize(vec3((ndc + p[2].xy) / scale, -1.0));
    else
        origin.xy = (ndc - p[3].xy) / scale;
    float eye = rayPlane / -direction.z;
    origin += eye * direction;

    // in texture coordinates, where the box is from 0 to 1
    vec3 local = mat3(plr0_eyeToLocal) * direction;
    float speed = length(local);
    vec3 start = (mat3(plr0_eyeToLocal) * vec3(origin.xy, 0.0) + plr0_localStart) / plr0_dimensions + 0.5;
    vec3 way = local / plr0_dimensions;
    vec3 d = mix(way, vec3(1.0e-30), equal(way, vec3(0.0)));
    vec3 a = -start / d, b = (1.0 - start) / d, near = min(a, b), far = max(a, b);
    float enter = max(max(near.x, near.y), max(near.z, -eye));
    float leave = min(min(far.x, far.y), far.z);

    vec4 sum = vec4(0.0);
    float pace = plr0_sampleDistance / speed;
    int steps = int(ceil((leave - enter) / pace - 1.0e-4));
    int next = 0;
    while (next < steps) {
        int first = next;
        uint bits = 0u;
        for (; next < steps && next < first + 32; next++) {
            float from = enter + float(next) * pace;
            float t = from + 0.5 * (next == steps - 1 ? leave - from : pace);
            float value = texture(plr0_voxels, start + t * way).r;
            if (value > plr1_visibleValues.x && value < plr1_visibleValues.y)
                bits |= 1u << uint(next - first);
        }
        while (bits != 0u) {
            int i = first + ((floatBitsToInt(float(bits & (0u - bits))) >> 23) - 127);
            bits &= bits - 1u;
            float from = enter + float(i) * pace;
            float span = i == steps - 1 ? leave - from : pace;
            float t = from + 0.5 * span;
            vec2 texel = plr1_transferPlace.xy + vec2(texture(plr0_voxels, start + t * way).r, 0.0) * plr1_transferPlace.zw;
            vec4 color = texture(plugray_TransferFunctions, texel / vec2(textureSize(plugray_TransferFunctions, 0)));
            if (color.a < 1.0) {
                float x = -log(1.0 - color.a) * span * speed / plr0_referenceLength;
                float few = x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x / 24.0)));
                color.a = x < 0.02 ? few : 1.0 - exp(-x);
            }
            sum += (1.0 - sum.a) * vec4(color.rgb * color.a, color.a);
            if (1.0 - sum.a < transparencyLeft) {
                next = steps;
                break;
            }
        }
    }
    plugray_FragColor = sum;
}
