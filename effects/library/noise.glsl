/* Solid noise. */

/* Jarzynski and Olano 2020, "Hash functions for GPU rendering": pcg3d. */
uvec3 hashed(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v += v.yzx * v.zxy;
    v ^= v >> 16u;
    v += v.yzx * v.zxy;
    return v;
}

/* One of the twelve directions to the edges of a cube, times the way from the corner. */
float noise_gradient(uint hash, vec3 way) {
    uint h = hash >> 28u;
    float u = h < 8u ? way.x : way.y;
    float v = h < 4u ? way.y : h == 12u || h == 14u ? way.x : way.z;
    return ((h & 1u) == 0u ? u : -u) + ((h & 2u) == 0u ? v : -v);
}

/* Perlin 2002, "Improving noise", on three lattices at once: 0 at every corner, within -1 and 1. */
vec3 solid_noise_vector(vec3 place) {
    vec3 cell = floor(place), way = place - cell;
    vec3 blend = way * way * way * (way * (way * 6.0 - 15.0) + 10.0);
    vec3 result = vec3(0.0);
    for (int corner = 0; corner < 8; corner++) {
        vec3 at = vec3(float(corner & 1), float(corner >> 1 & 1), float(corner >> 2));
        uvec3 hash = hashed(uvec3(ivec3(cell + at)));
        vec3 weight = mix(1.0 - blend, blend, at);
        result += weight.x * weight.y * weight.z *
                  vec3(noise_gradient(hash.x, way - at), noise_gradient(hash.y, way - at),
                       noise_gradient(hash.z, way - at));
    }
    return result;
}

float solid_noise(vec3 place) {
    return solid_noise_vector(place).x;
}
