/* One volume: where the ray runs in it, its samples, its styles. Effects on the volume speak here. */

uniform mat4 eyeToLocal; /* eye space -> own coordinates, the box centred at the origin */
uniform vec3 dimensions;
uniform float sampleDistance;   /* own coordinates */
uniform float referenceLength;  /* an opacity means "after this length", own coordinates */
uniform sampler3D voxels;
uniform int volumeIndex;

vec3 local_origin;
vec3 local_direction; /* own coordinates per unit of eye space */
float enter = 0.0;
float leave = 0.0;

/* The part of the ray inside the box; a component of 0 is inside or outside for all of it. */
void box_interval(out float t_enter, out float t_exit) {
    t_enter = 0.0;
    t_exit = 3.0e38;
    for (int axis = 0; axis < 3; axis++) {
        float o = local_origin[axis], d = local_direction[axis], half_size = 0.5 * dimensions[axis];
        if (d == 0.0) {
            if (!(abs(o) <= half_size))
                t_exit = -1.0;
            continue;
        }
        float a = (-half_size - o) / d, b = (half_size - o) / d;
        t_enter = max(t_enter, min(a, b));
        t_exit = min(t_exit, max(a, b));
    }
}

void PLUG_volume_begin(const in vec3 origin_eye, const in vec3 direction_eye, const in float start,
                       const in float limit) {
    local_origin = (eyeToLocal * vec4(origin_eye, 1.0)).xyz;
    local_direction = mat3(eyeToLocal) * direction_eye;
    float t_enter, t_exit;
    box_interval(t_enter, t_exit);
    enter = max(t_enter, start);
    leave = min(t_exit, limit);
#if PLUG_USED(volume_ray)
    /* PLUG: volume_ray (t_enter, t_exit, origin_eye, direction_eye) */
    enter = max(enter, t_enter);
    leave = min(leave, t_exit);
#endif
    if (!(enter < leave))
        enter = leave = 0.0;
}

#if VOLUME_COUNT > 1
void PLUG_volume_first(inout float t) {
    if (enter < leave)
        t = min(t, enter);
}
#endif

void PLUG_volume_part(inout float t, inout float t_next, inout float step_length) {
#if VOLUME_COUNT > 1
    if (enter <= t && t < leave) {
        step_length = min(step_length, sampleDistance / length(local_direction));
        t_next = min(t_next, leave);
    } else if (t < enter) {
        t_next = min(t_next, enter);
    }
#else
    t = enter;
    t_next = leave;
    step_length = sampleDistance / length(local_direction);
#endif
}

#if READS(normal_eye) || READS(gradient)
/* The scalar of a voxel, for gradients: L, or the mean of RGB. */
float scalar_at(const in vec3 position) {
#if voxels_COMPONENTS >= 3
    vec3 rgb = texture(voxels, position).rgb;
    return (rgb.r + rgb.g + rgb.b) / 3.0;
#else
    return texture(voxels, position).r;
#endif
}

/* The trilinear interpolation of central differences at voxel centres: differences over exactly two
 * voxels, clamped to the outermost centres, commute with the interpolation. Value per unit length in
 * own coordinates. */
vec3 gradient_at(const in vec3 position) {
    vec3 size = vec3(textureSize(voxels, 0));
    vec3 voxel = 1.0 / size;
    vec3 p = clamp(position, 0.5 * voxel, 1.0 - 0.5 * voxel);
    vec3 difference;
    for (int axis = 0; axis < 3; axis++) {
        vec3 shift = vec3(0.0);
        shift[axis] = voxel[axis];
        difference[axis] = scalar_at(p + shift) - scalar_at(p - shift);
    }
    return difference * size / (2.0 * dimensions);
}
#endif

/* The voxel itself as a colour, before any style. */
vec4 voxel_color(const in vec4 value) {
#if voxels_COMPONENTS == 1
    return value.rrrr;
#elif voxels_COMPONENTS == 2
    return value.rrrg;
#elif voxels_COMPONENTS == 3
    return vec4(value.rgb, (value.r + value.g + value.b) / 3.0);
#else
    return value;
#endif
}

/* To [0,1]; what is no number becomes 0. */
vec4 clamped(const in vec4 color) {
    return mix(vec4(0.0), min(color, vec4(1.0)), greaterThan(color, vec4(0.0)));
}

/* Colour and opacity per reference length at t. */
void classify_and_shade(out vec4 color, out VolumeSample s, const in float t, const in float span,
                        const in vec3 origin_eye, const in vec3 direction_eye) {
    vec3 position = (local_origin + t * local_direction) / dimensions + 0.5;
    s.value = texture(voxels, position);
#if READS(position)
    s.position = position;
#endif
#if READS(position_eye)
    s.position_eye = origin_eye + t * direction_eye;
#endif
#if READS(step_length)
    s.step_length = span * length(local_direction);
#endif
#if READS(segment)
    s.segment = 0;
#endif
#if READS(volume)
    s.volume = volumeIndex;
#endif
#if READS(normal_eye) || READS(gradient)
    vec3 gradient = gradient_at(position);
#endif
#if READS(gradient)
    s.gradient = length(gradient);
#endif
#if READS(normal_eye)
    /* a gradient is a covector: it goes to eye space by the transpose of eye -> own */
    vec3 normal = -(gradient * mat3(eyeToLocal));
    float squared = dot(normal, normal);
    s.normal_eye = squared > 0.0 ? normal * inversesqrt(squared) : vec3(0.0);
#endif
    /* PLUG: volume_sample (s) */
    color = voxel_color(s.value);
#if PLUG_USED(volume_classify)
    /* PLUG: volume_classify (color, s) */
    color = clamped(color);
#endif
#if PLUG_USED(volume_shade)
    /* PLUG: volume_shade (color, s) */
    color = clamped(color);
#endif
}

#if VOLUME_COUNT > 1
void PLUG_volume_mix(inout VolumeMix mixed, const in float t, const in float span,
                     const in vec3 origin_eye, const in vec3 direction_eye) {
    if (!(enter <= t && t < leave))
        return;
    vec4 color;
    VolumeSample s;
    classify_and_shade(color, s, t, span, origin_eye, direction_eye);
    volume_mix_add(mixed, color, span * length(local_direction) / referenceLength);
}
#else
void PLUG_volume_step(out vec4 color, out VolumeSample s, const in float t, const in float span,
                      const in vec3 origin_eye, const in vec3 direction_eye) {
    classify_and_shade(color, s, t, span, origin_eye, direction_eye);
    /* opacity of this step: 1 - (1 - alpha)^(length / reference); opaque stays opaque */
    color.a = color.a >= 1.0 ? 1.0
                             : 1.0 - pow(1.0 - color.a, span * length(local_direction) / referenceLength);
}
#endif
