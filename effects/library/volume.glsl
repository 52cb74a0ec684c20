/* What the effects of volumes share. */

/* What is known of one sample. Members that nothing reads are not in the program. */
struct VolumeSample {
    vec4 value;         /* voxel in [0,1]; missing components 0, the fourth 1 */
#if READS(position)
    vec3 position;      /* texture coordinates of the volume, [0,1] */
#endif
#if READS(position_eye)
    vec3 position_eye;
#endif
#if READS(normal_eye)
    vec3 normal_eye;    /* unit, against the gradient; zero where that vanishes */
#endif
#if READS(gradient)
    float gradient;     /* magnitude, value per unit length in the volume's own coordinates */
#endif
#if READS(step_length)
    float step_length;  /* own coordinates of the volume; eye space in a mix */
#endif
#if READS(segment)
    int segment;
#endif
#if READS(surface)
    int surface;        /* of equal value, by its number; -1 where there is none */
#endif
#if READS(volume)
    int volume;         /* -1 in a mix of several */
#endif
};

const float NOWHERE = 3.0e38; /* along a ray */

/* To [0,1]; what is no number becomes 0. */
vec4 clamped(const in vec4 color) {
    return mix(vec4(0.0), min(color, vec4(1.0)), greaterThan(color, vec4(0.0)));
}

/* Unit and in eye space, against the gradient; zero where that vanishes. A gradient is a covector: it
 * goes to eye space by the transpose of eye -> own coordinates. */
vec3 normal_of_gradient(const in vec3 gradient, const in mat3 eye_to_local) {
    vec3 normal = -(gradient * eye_to_local);
    float squared = dot(normal, normal);
    return squared > 0.0 ? normal * inversesqrt(squared) : vec3(0.0);
}

/* The functions of all volumes of the program, each with a margin around it. */
uniform sampler2D plugray_TransferFunctions;

/* Looks a function up: `place` has the centre of its first texel, and how far it is to the last one. */
vec4 transfer_in(const in vec4 place, const in vec2 at) {
    vec2 texel = place.xy + clamp(at, 0.0, 1.0) * place.zw;
    return texture(plugray_TransferFunctions, texel / vec2(textureSize(plugray_TransferFunctions, 0)));
}

/* Texture coordinates of a transfer function: 0 and 1 are the centres of the outer texels. */
vec2 function_coordinate(const in vec2 at, const in ivec2 size) {
    return (clamp(at, 0.0, 1.0) * (vec2(size) - 1.0) + 0.5) / vec2(size);
}

/* How many steps a part of the ray takes; a remainder that is only rounding is no step. */
int step_count(float whole, float step_length) {
    return int(ceil(min(whole / step_length - 1.0e-4, 1.0e6)));
}

/* Cuts the part of a ray that is within a box, in lengths of the ray's direction; where it misses the box
 * it leaves before it enters. */
void cross_box(const in vec3 low, const in vec3 high, const in vec3 origin, const in vec3 direction,
               inout float enter, inout float leave) {
    /* a component of 0 stays on its side of both faces: 1e-30 reaches neither in any picture */
    vec3 d = mix(direction, vec3(1.0e-30), equal(direction, vec3(0.0)));
    vec3 to_low = (low - origin) / d, to_high = (high - origin) / d;
    vec3 near = min(to_low, to_high), far = max(to_low, to_high);
    enter = max(max(near.x, near.y), max(near.z, enter));
    leave = min(min(far.x, far.y), min(far.z, leave));
}

/* The same with a box that a scene gives: it may have no inside. */
void cross_cropped_box(const in vec3 low, const in vec3 high, const in vec3 origin, const in vec3 direction,
                       inout float enter, inout float leave) {
    cross_box(low, high, origin, direction, enter, leave);
    if (any(greaterThan(low, high)))
        leave = -NOWHERE;
}
