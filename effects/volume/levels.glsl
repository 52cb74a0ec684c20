/* The surfaces of equal value of a volume: how many a value is above of, where they are steep enough to
 * be there, and a sample of one. ISO/IEC 19775-1 V4 41.4.3, IsoSurfaceVolumeData. A unit of the effects
 * that meet them along a ray. */

const int MOST_SURFACES = 256;
uniform vec2 surfaces[MOST_SURFACES]; /* value, ascending, and number, by which styles are chosen */
uniform int surfaceCount = 0;
uniform float surfaceTolerance = 0.0;
uniform float gradientUnit;
#if HAS_gradients
uniform sampler3D gradients;
#endif

/* How many surfaces have a value of at most this: by bisection. */
int count_below(const in float value) {
    int from = 0, to = surfaceCount;
    while (from < to) {
        int middle = (from + to) / 2;
        if (surfaces[middle].x <= value)
            from = middle + 1;
        else
            to = middle;
    }
    return from;
}

/* The gradient in own coordinates: from its own texture, n = 2 t - 1, or of the voxels. */
vec3 surface_gradient(const in vec3 position) {
#if HAS_gradients
    return (2.0 * texture(gradients, position).rgb - 1.0) / gradientUnit;
#else
    return gradient_at(position);
#endif
}

/* A surface is there only where the normalised gradient is above the tolerance. */
bool is_steep(const in vec3 position) {
    if (surfaceTolerance <= 0.0)
        return true;
    return length(surface_gradient(position)) * gradientUnit > surfaceTolerance;
}

/* Makes a sample one of the surface that it lies on. */
void surface_sample(inout VolumeSample s, const in vec3 position, const in int surface) {
#if HAS_gradients && (READS(normal_eye) || READS(gradient))
    vec3 gradient = surface_gradient(position);
#if READS(gradient)
    s.gradient = length(gradient);
#endif
#if READS(normal_eye)
    s.normal_eye = normal_of_gradient(gradient, mat3(eyeToLocal));
#endif
#endif
#if READS(surface)
    s.surface = int(surfaces[surface].y);
#endif
}
