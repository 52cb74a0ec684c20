/* Voxels on a grid that fills the box of a volume: value, gradient, colour. A unit of every effect
 * that has voxels. */

uniform mat4 eyeToLocal; /* eye space -> the volume's own coordinates, the box centred at the origin */
uniform vec3 dimensions;
uniform int volumeIndex;
uniform sampler3D voxels;
#if defined(BRICKED) && BRICKED
uniform vec3 voxelCount; /* of the whole, of which the texture is a brick */
uniform vec3 brickScale;
uniform vec3 brickShift;

vec4 voxel_at(const in vec3 position) {
    return texture(voxels, position * brickScale + brickShift);
}

vec3 voxel_count() {
    return voxelCount;
}
#else
vec4 voxel_at(const in vec3 position) {
    return texture(voxels, position);
}

vec3 voxel_count() {
    return vec3(textureSize(voxels, 0));
}
#endif

#if defined(HAS_LABELS) && HAS_LABELS
uniform usampler3D labels;

/* The number of the segment: that of the nearest voxel. */
int segment_at(const in vec3 position) {
    ivec3 size = textureSize(labels, 0);
    return int(texelFetch(labels, clamp(ivec3(position * vec3(size)), ivec3(0), size - 1), 0).r);
}
#else
int segment_at(const in vec3 position) {
    return 0;
}
#endif

/* The scalar of a voxel, for gradients and surfaces: L, or the mean of RGB. */
float voxel_scalar(const in vec4 value) {
#if voxels_COMPONENTS >= 3
    return (value.r + value.g + value.b) / 3.0;
#else
    return value.r;
#endif
}

float scalar_at(const in vec3 position) {
    return voxel_scalar(voxel_at(position));
}

/* The trilinear interpolation of central differences at voxel centres, value per unit length in own
 * coordinates. */
#if defined(HAS_GRADIENTS) && HAS_GRADIENTS
uniform sampler3D voxelGradients; /* at the centres, as differences from voxel to voxel */

vec3 gradient_at(const in vec3 position) {
    return texture(voxelGradients, position).xyz * (voxel_count() / dimensions);
}
#else
/* Differences over exactly two voxels, clamped to the outermost centres, commute with the interpolation. */
vec3 gradient_at(const in vec3 position) {
    vec3 size = voxel_count();
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

#if READS(normal_eye) || READS(gradient)
#if defined(TURNS) && TURNS
vec3 sampled_gradient; /* that of the last sample */
#endif

void set_gradient(inout VolumeSample s, const in vec3 gradient) {
#if READS(gradient)
    s.gradient = length(gradient);
#endif
#if READS(normal_eye)
    s.normal_eye = normal_of_gradient(gradient, mat3(eyeToLocal));
#endif
}
#endif

/* What the grid has at a place of the box, in texture coordinates. */
void grid_sample(inout VolumeSample s, const in vec3 position) {
    s.value = voxel_at(position);
#if READS(normal_eye) || READS(gradient)
    vec3 gradient = gradient_at(position);
    set_gradient(s, gradient);
#if defined(TURNS) && TURNS
    sampled_gradient = gradient;
#endif
#endif
}

/* All that is known of a sample, before authors change it: `place` is where it is in eye space, `span` the length
 * of its step in own coordinates. */
void volume_sample_at(out VolumeSample s, const in vec3 position, const in vec3 place, const in float span) {
    grid_sample(s, position);
#if READS(position)
    s.position = position;
#endif
#if READS(position_eye)
    s.position_eye = place;
#endif
#if READS(step_length)
    s.step_length = span;
#endif
#if READS(segment)
    s.segment = segment_at(position);
#endif
#if READS(surface)
    s.surface = -1;
#endif
#if READS(volume)
    s.volume = volumeIndex;
#endif
}
