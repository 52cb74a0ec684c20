/* Samples at which promises of authors' effects are tried: those of the volume, at places by chance, and
 * such as any volume might have; colours likewise. Its voxels are in a second unit, grid.glsl. */

uniform float sampleDistance; /* own coordinates */
#if defined(BRICKED) && BRICKED
uniform vec3 brickLow; /* what is at hand of the voxels */
uniform vec3 brickHigh;
#endif

/* What is asked of a trial, the same in engine/trust.c; an odd number asks it of its second sample, which
 * differs from the first in colour and value alone. */
const int TRIAL_COLOR = 0;
const int TRIAL_VALUE = 1;
const int TRIAL_PLACE = 2;
const int TRIAL_CLASSIFIED = 3;
const int TRIAL_SHADED = 4;

#if voxels_COMPONENTS == 1
const int VALUE_COMPONENTS = 1;
#elif voxels_COMPONENTS == 2
const int VALUE_COMPONENTS = 2;
#elif voxels_COMPONENTS == 3
const int VALUE_COMPONENTS = 3;
#else
const int VALUE_COMPONENTS = 4;
#endif

uint trial_number;
uint trial_draws;

/* The next number from 0 to 1, both included; always the same ones for a trial. */
float drawn() {
    uvec3 hash = hashed(uvec3(trial_number, trial_draws, 0u));
    trial_draws++;
    return float(hash.x >> 8u) / 16777215.0;
}

/* An end or what lies between: promises tend to break at ends. */
float drawn_with_ends() {
    float kind = drawn(), between = drawn();
    return kind < 0.125 ? 0.0 : kind < 0.25 ? 1.0 : between;
}

vec4 drawn_color() {
    vec4 color;
    for (int i = 0; i < 4; i++)
        color[i] = drawn_with_ends();
    return color;
}

/* The components that the volume has: the rest stay as they are. */
void draw_value(inout vec4 value) {
    for (int i = 0; i < VALUE_COMPONENTS; i++)
        value[i] = drawn_with_ends();
}

/* Uniform on the sphere: Marsaglia 1972, by height and longitude. */
vec3 drawn_direction() {
    float z = 2.0 * drawn() - 1.0, angle = 6.28318531 * drawn();
    return vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(angle), sin(angle)), z);
}

/* A place of the volume: all that is known of it, then half of that as it might be elsewhere. */
void draw_sample(out VolumeSample s) {
    vec3 position = vec3(drawn(), drawn(), drawn());
#if defined(BRICKED) && BRICKED
    position = mix(brickLow, brickHigh, position);
#endif
    vec4 place = castle_ModelViewMatrix * vec4((position - 0.5) * dimensions, 1.0);
    volume_sample_at(s, position, place.xyz, sampleDistance);
    if (drawn() < 0.5)
        draw_value(s.value);
    bool invented = drawn() < 0.5;
#if READS(normal_eye)
    vec3 normal = drawn() < 0.25 ? vec3(0.0) : drawn_direction();
    if (invented)
        s.normal_eye = normal;
#endif
#if READS(gradient)
    /* central differences: at most from 0 to 1 over two voxels along each axis */
    float steepness = drawn_with_ends() * length(0.5 * voxel_count() / dimensions);
    if (invented)
        s.gradient = steepness;
#endif
}

/* Another colour and value, far away or in any decade from 1e-4 to 1 nearby: in all components, or in one. */
void draw_second(inout vec4 color, inout VolumeSample s) {
    float far = drawn(), reach = exp2(-13.0 * drawn()), one = drawn();
    int only = int(drawn() * float(4 + VALUE_COMPONENTS));
    vec4 other_color = drawn_color(), other_value = s.value;
    draw_value(other_value);
    for (int i = 0; i < 4 + VALUE_COMPONENTS; i++) {
        float way = reach * (2.0 * drawn() - 1.0);
        if (one < 0.5)
            way = i == only ? reach * sign(way) : 0.0;
        if (i < 4)
            other_color[i] = far < 0.25 ? other_color[i] : clamp(color[i] + way, 0.0, 1.0);
        else
            other_value[i - 4] = far < 0.25 ? other_value[i - 4] : clamp(s.value[i - 4] + way, 0.0, 1.0);
    }
    color = other_color;
    s.value = other_value;
}

void PLUG_volume_trial(inout vec4 result, const in uint number, const in int quantity) {
    trial_number = number;
    trial_draws = 0u;
    vec4 color = drawn_color();
    VolumeSample s;
    draw_sample(s);
    vec3 position = s.position;
    int asked = quantity >> 1;
    if ((quantity & 1) != 0)
        draw_second(color, s);
    result = asked == TRIAL_VALUE ? s.value : asked == TRIAL_PLACE ? vec4(position, 0.0) : color;
    if (asked == TRIAL_CLASSIFIED) {
        /* PLUG: volume_classify (color, s) */
        result = color;
    } else if (asked == TRIAL_SHADED) {
        /* PLUG: volume_shade (color, s) */
        result = color;
    }
}
