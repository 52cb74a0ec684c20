/* One volume: where the ray runs in it, its samples, its styles. Effects on the volume speak here. */

uniform mat4 eyeToLocal; /* eye space -> own coordinates, the box centred at the origin */
uniform vec3 dimensions;
uniform float sampleDistance;   /* own coordinates */
uniform float referenceLength;  /* an opacity means "after this length", own coordinates */
uniform sampler3D voxels;
uniform int volumeIndex;

/* Along the ray, t = 0 at the eye: where it is in the box of texture coordinates [0,1], how fast it
 * moves there, and how fast in own coordinates. */
vec3 ray_origin;
vec3 ray_direction;
float ray_speed;
float enter;
float leave;

void PLUG_volume_begin(const in vec3 origin_eye, const in vec3 direction_eye, const in float start,
                       const in float limit) {
    vec3 direction = mat3(eyeToLocal) * direction_eye;
    ray_speed = length(direction);
    ray_origin = (eyeToLocal * vec4(origin_eye, 1.0)).xyz / dimensions + 0.5;
    ray_direction = direction / dimensions;
    /* a component of 0 stays on its side of both faces: 1e-30 reaches neither in any picture */
    vec3 d = mix(ray_direction, vec3(1.0e-30), equal(ray_direction, vec3(0.0)));
    vec3 to_low = -ray_origin / d, to_high = (1.0 - ray_origin) / d;
    vec3 near = min(to_low, to_high), far = max(to_low, to_high);
    enter = max(max(near.x, near.y), max(near.z, start));
    leave = min(min(far.x, far.y), min(far.z, limit));
#if PLUG_USED(volume_ray)
    float t_enter = enter, t_exit = leave;
    /* PLUG: volume_ray (t_enter, t_exit, origin_eye, direction_eye) */
    enter = max(enter, t_enter);
    leave = min(leave, t_exit);
#endif
#if VOLUME_COUNT > 1
    if (!(enter < leave))
        enter = leave = 0.0;
#endif
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
        step_length = min(step_length, sampleDistance / ray_speed);
        t_next = min(t_next, leave);
    } else if (t < enter) {
        t_next = min(t_next, enter);
    }
#else
    t = enter;
    t_next = leave;
    step_length = sampleDistance / ray_speed;
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
    vec3 x = vec3(voxel.x, 0.0, 0.0), y = vec3(0.0, voxel.y, 0.0), z = vec3(0.0, 0.0, voxel.z);
    vec3 difference = vec3(scalar_at(p + x) - scalar_at(p - x), scalar_at(p + y) - scalar_at(p - y),
                           scalar_at(p + z) - scalar_at(p - z));
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
    vec3 position = ray_origin + t * ray_direction;
    s.value = texture(voxels, position);
#if READS(position)
    s.position = position;
#endif
#if READS(position_eye)
    s.position_eye = origin_eye + t * direction_eye;
#endif
#if READS(step_length)
    s.step_length = span * ray_speed;
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
    volume_mix_add(mixed, color, span * ray_speed / referenceLength);
}
#else
void PLUG_volume_step(out vec4 color, out VolumeSample s, const in float t, const in float span,
                      const in vec3 origin_eye, const in vec3 direction_eye) {
    classify_and_shade(color, s, t, span, origin_eye, direction_eye);
    /* opacity of this step: 1 - (1 - alpha)^(length / reference); opaque stays opaque */
    if (color.a < 1.0)
        color.a = opacity_of_depth(-log(1.0 - color.a) * span * ray_speed / referenceLength);
}
#endif
