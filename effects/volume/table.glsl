/* A volume of one component that one transfer function makes visible: where the value
 * runs evenly along the ray, a table has what lies between any two values (engine/volume_table.c). Styles
 * that only change what can be seen look at one place of each part. A unit of Volume.glsl's effect; segments.glsl or
 * cells.glsl, another, cuts the ray.
 *
 * Pre-integration: Max, Hanrahan, Crawfis 1990; Engel, Kraus, Ertl 2001. The table has means, not
 * products with a length, so that segments may be of any length. */

#if PLUG_USED(volume_classify) || PLUG_USED(volume_shade) || PLUG_USED(volume_fog)
#define STYLED 1
#else
#define STYLED 0
#endif

#if !CELLS
uniform sampler2D integrals; /* mean of colour * extinction, and of extinction, per reference length */
#endif
#if !CELLS
vec2 table_place; /* from values to texture coordinates of the table: scale and shift */
#endif
float depth_ratio; /* from lengths of the ray to reference lengths */

#if HAS_QUADS
uniform sampler3D voxelQuads; /* a texel has the values at (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1) of its layer */

vec3 texel_size;

#if !CELLS
/* As a linear filter would, but from two looks, and with weights of as many bits as floats have. */
float value_at(const in float t) {
    vec3 last = vec3(textureSize(voxelQuads, 0)) - 1.0;
    vec3 place = clamp(cell_origin - 1.0 + t * cell_direction, vec3(0.0), last);
    vec3 first = floor(place);
    vec3 way = place - first;
    vec3 texel = (first + 0.5) * texel_size;
    vec4 quad = mix(texture(voxelQuads, texel), texture(voxelQuads, vec3(texel.xy, texel.z + texel_size.z)), way.z);
    vec2 pair = mix(quad.xz, quad.yw, way.x);
    return mix(pair.x, pair.y, way.y);
}
#endif
#else
float value_at(const in float t) {
    return voxel_scalar(voxel_at(ray_origin + t * ray_direction));
}
#endif

void ray_begins(const in vec3 origin_eye, const in vec3 direction_eye) {
#if HAS_QUADS
    vec3 count = vec3(textureSize(voxelQuads, 0));
    texel_size = 1.0 / count;
#else
    vec3 count = voxel_count();
#endif
    cells_begin(count);
#if !CELLS
    float nodes = float(textureSize(integrals, 0).x);
    table_place = vec2((nodes - 1.0) / nodes, 0.5 / nodes);
#endif
    depth_ratio = ray_speed / referenceLength;
}

bool is_inside(const in float t) {
#if MIXES
    return enter <= t && t < leave;
#else
    return true;
#endif
}

#if STYLED
/* What styles make of a colour at a place of the ray. */
void style_at(inout vec4 color, const in float t, const in float span, const in vec3 origin_eye,
              const in vec3 direction_eye) {
    VolumeSample s;
    sample_at(s, t, span, origin_eye, direction_eye);
    style_sample(color, s);
}

/* What they make of a mean of colour * extinction, and of extinction. */
void style_found(inout vec4 mean, const in VolumeSample s) {
    vec4 color = vec4(mean.rgb / max(mean.a, 1.0e-30), opacity_of_depth(mean.a));
    float before = color.a;
    style_sample(color, s);
    float extinction = color.a == before ? mean.a : -log(max(1.0 - color.a, 1.0e-30));
    mean = extinction * vec4(color.rgb, 1.0);
}

#if TURNS && READS(normal_eye)
vec3 seen_gradient = vec3(0.0); /* what styles saw last, and where */
float seen_t = -3.0e38;

void style_turned(inout vec4 mean, const in VolumeSample found, const in vec3 gradient) {
    VolumeSample s = found;
    set_gradient(s, gradient);
    /* PLUG: volume_sample (s) */
    style_found(mean, s);
}

/* Along a segment nothing changes as much as the gradient, and highlights are no lines: styles see the place with the
 * gradients on both sides of it, one standard deviation away (the mean of a function of them is right to second order
 * then; it would be 0.289 of the segment if all of it could be seen alike, and is less as not all can). How the gradient
 * changes is told by the segment before, if it could be seen. */
void style_mean(inout vec4 mean, const in float t, const in float span, const in vec3 origin_eye,
                const in vec3 direction_eye) {
    const float DEVIATION = 0.24;
    VolumeSample s;
    volume_sample_at(s, ray_origin + t * ray_direction, origin_eye + t * direction_eye, span * ray_speed);
    vec3 gradient = sampled_gradient;
    float apart = t - seen_t;
    vec3 turn = (gradient - seen_gradient) * (DEVIATION * span / max(apart, span));
    turn = apart < 2.0 * span ? turn : vec3(0.0);
    vec4 before = mean;
    style_turned(before, s, gradient - turn);
    style_turned(mean, s, gradient + turn);
    mean = 0.5 * (before + mean);
    seen_gradient = gradient;
    seen_t = t;
}
#else
void style_mean(inout vec4 mean, const in float t, const in float span, const in vec3 origin_eye,
                const in vec3 direction_eye) {
    VolumeSample s;
    sample_at(s, t, span, origin_eye, direction_eye);
    style_found(mean, s);
}
#endif
#endif

#if HAS_WALL && !CELLS
uniform vec2 wallValues; /* values between these, they included, are opaque */
uniform vec4 wallColors[2]; /* at these */

/* Which part of the way between two values leads to the first opaque one: 2 if there is none. */
float way_to_wall(const in float from, const in float to) {
    if (from >= wallValues.x && from <= wallValues.y)
        return 0.0;
    if (from < wallValues.x ? to < wallValues.x : to > wallValues.y)
        return 2.0;
    return ((from < wallValues.x ? wallValues.x : wallValues.y) - from) / (to - from);
}

vec4 wall_color(const in float from) {
    return from < 0.5 * (wallValues.x + wallValues.y) ? wallColors[0] : wallColors[1];
}

/* Whether a value is opaque, and not just because it is the first one that is. */
bool is_within_wall(const in float value) {
    const float ROUNDED = 2.0e-5;
    return value >= wallValues.x + ROUNDED && value <= wallValues.y - ROUNDED;
}
#endif

#if !CELLS
/* What lies, in the mean, between two values: colour times extinction, extinction. */
vec4 mean_between(const in float from, const in float to) {
    return texture(integrals, vec2(from, to) * table_place.x + table_place.y);
}
#endif
