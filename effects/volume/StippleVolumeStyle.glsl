/* Points in place of a continuum. The proposal of 2005 for the component, 4.10, after Lu et al. 2002,
 * "Non-photorealistic volume rendering using stippling techniques": a voxel has N points,
 *
 *     N = Nmax Tb Ts Td Tl Tr Ti
 *     Tb = Cv (kgc + kgs |grad f|^kge)        gradientRetainedOpacity, ..BoundaryOpacity, ..OpacityFactor
 *     Ts = Cv (ksc + kss (1 - |n.V|)^kse)     silhouetteRetainedOpacity, ..BoundaryOpacity, ..OpacityFactor
 *     Td = 1 + (z/a)^kde                      distanceFactor
 *     Tl = 1 - sum over the lights of (Li.n)^kle    lightingFactor
 *     Tr = ((Dnear + di) / (Dnear + d0))^kre  resolutionFactor
 *     Ti = |grad f|^kie                       interiorFactor
 *
 * What the text leaves open: Cv is the opacity, the one number that a sample has. kgs counts only where the
 * normal is at least gradientThreshold away from the view. z runs from -a at the far end of the volume to
 * a at the near end, and a power keeps its sign. What looks away from a light has none of it. di and d0
 * are the distances from the viewer to the volume's middle, now and where he stood first.
 *
 * Nmax is 8: a cube of a voxel's volume is cut into 8 cells, and a cell is a point - opaque, of the colour
 * that comes in - where a number that belongs to it is less than N / Nmax. */

uniform float distanceFactor = 1.0;
uniform float interiorFactor = 1.0;
uniform float lightingFactor = 1.0;
uniform float resolutionFactor = 1.0;
uniform float gradientThreshold = 0.4;
uniform float gradientRetainedOpacity = 1.0;
uniform float gradientBoundaryOpacity = 0.0;
uniform float gradientOpacityFactor = 1.0;
uniform float silhouetteRetainedOpacity = 1.0;
uniform float silhouetteBoundaryOpacity = 0.0;
uniform float silhouetteOpacityFactor = 1.0;

uniform mat4 eyeToLocal;
uniform vec3 dimensions;
uniform float voxelLength;    /* of a cube of the same volume as a voxel, own coordinates */
uniform float approach = 1.0; /* how far the viewer is, to how far he was at first */

#if PLUG_USED(add_light)
/* What the lights read of it means nothing here; hides the library's own. */
struct MaterialInfo {
    vec3 ambient;
    vec3 diffuse;
};

float brightness;

vec3 material_reflection(MaterialInfo material, vec4 vertex_eye, vec3 normal_eye, vec3 light_dir) {
    brightness += style_power(max(dot(light_dir, normal_eye), 0.0), lightingFactor);
    return vec3(0.0);
}
#endif

/* T_l. */
float darkness(const in VolumeSample s, const in vec3 normal) {
#if PLUG_USED(add_light)
    brightness = 0.0;
    vec4 lit = vec4(0.0);
    MaterialInfo material = MaterialInfo(vec3(0.0), vec3(0.0));
    /* PLUG: add_light (lit, vec4(s.position_eye, 1.0), normal, material) */
    return max(1.0 - brightness, 0.0);
#else
    return 1.0;
#endif
}

/* T_d. The way to the viewer's plane, in own coordinates: what is at right angles to its two axes. */
float nearness(const in VolumeSample s) {
    vec3 axis = cross(eyeToLocal[0].xyz, eyeToLocal[1].xyz);
    axis = dot(axis, eyeToLocal[2].xyz) < 0.0 ? -axis : axis;
    float share = 2.0 * dot(axis, (s.position - 0.5) * dimensions) / dot(abs(axis), dimensions);
    return 1.0 + sign(share) * style_power(abs(share), distanceFactor);
}

/* N / Nmax. */
float density(const in VolumeSample s, const in float opacity) {
    vec3 normal = style_normal(s);
    float change = style_gradient(s);
    float facing = abs(style_facing(s, normal));
    float boundary = gradientRetainedOpacity;
    if (facing <= cos(gradientThreshold))
        boundary += gradientBoundaryOpacity * style_power(change, gradientOpacityFactor);
    float silhouette = silhouetteRetainedOpacity +
                       silhouetteBoundaryOpacity * style_power(1.0 - facing, silhouetteOpacityFactor);
    return opacity * boundary * opacity * silhouette * nearness(s) * darkness(s, normal) *
           style_power(approach, resolutionFactor) * style_power(change, interiorFactor);
}

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    vec3 cell = floor(2.0 * s.position * dimensions / voxelLength);
    uint number = hashed(uvec3(ivec3(cell))).x >> 8u;
    color.a = float(number) < density(s, color.a) * 16777216.0 ? 1.0 : 0.0;
}
