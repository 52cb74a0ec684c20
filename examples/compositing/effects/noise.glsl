/* Smooth noise of a lattice, in two and three dimensions: gradient noise with the quintic of Perlin,
 * "Improving Noise", 2002. Helpers for the units that stand beside this one. */

vec3 lattice_gradient(vec3 corner) {
    vec3 p = fract(corner * vec3(0.1031, 0.1030, 0.0973));
    p += dot(p, p.yxz + 33.33);
    return 2.0 * fract((p.xxy + p.yxx) * p.zyx) - 1.0;
}

float smooth_noise(vec3 place) {
    vec3 cell = floor(place), f = place - cell;
    vec3 w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    float corner[8];
    for (int i = 0; i < 8; i++) {
        vec3 offset = vec3(float(i & 1), float(i >> 1 & 1), float(i >> 2));
        corner[i] = dot(lattice_gradient(cell + offset), f - offset);
    }
    vec4 x = mix(vec4(corner[0], corner[2], corner[4], corner[6]),
                 vec4(corner[1], corner[3], corner[5], corner[7]), w.x);
    vec2 y = mix(x.xz, x.yw, w.y);
    return mix(y.x, y.y, w.z);
}

/* Noise of several octaves, about -1 to 1. */
float turbulence(vec3 place) {
    float sum = 0.0, part = 1.0;
    for (int octave = 0; octave < 4; octave++) {
        sum += part * smooth_noise(place);
        place *= 2.03;
        part *= 0.5;
    }
    return sum;
}
