/* A volume with a table (table.glsl), cut at the faces of voxel cells. In a cell the trilinear value is a
 * cubic along the ray: four samples have it exactly. It is cut further until its parts are straight enough.
 * A unit of Volume.glsl's effect.
 *
 * Along a part the straight line stands for the value that has the same mean: where extinction is linear in
 * the value, its integral is exact. Else it errs by half the change of its slope times the integral of the
 * distance from the line, 0.257 l b / 8 for a parabola that bends by b over the part: 0.016 l b times the change
 * of slope. Colours are weighted by opacity within a part: what hides what is lost there, at most
 * opacity * change of colour * depth / 2. (Novins, Arvo 1992 have such bounds for other rules.)
 */

uniform vec2 seenValues;  /* outside of this open interval values are clear */
uniform sampler2D sums;   /* integrals of colour * extinction and of extinction up to each node of values; what is
                             there; what is added to that up to the next node */
uniform sampler2D ranges; /* between two values: change of slope, extinction, change of colour */


const float RANGES = 64.0; /* the same in C: PLR_TABLE_RANGES */
const float VALUE_UNIT = 1.0 / 524288.0; /* values are not followed finer */

vec3 next_face;  /* along each axis, in cells */
float cubic[4];  /* the value over the piece of the ray in the cell, from 0 to 1 */
float last_value;
/* At the end of the part of a piece before. */
float part_value;
bool is_clear; /* nothing can be seen in the piece, which may then span many cells */

/* Along each axis the first face that lies behind t. */
void find_faces(const in float t) {
    vec3 forward = mix(vec3(-1.0), vec3(1.0), greaterThanEqual(cell_direction, vec3(0.0)));
    next_face = floor(cell_origin + t * cell_direction) - forward;
    for (int i = 0; i < 3; i++)
        next_face += forward * vec3(lessThanEqual((next_face - cell_origin) * cell_inverse, vec3(t)));
}

void PLUG_volume_cells_begin(const in float t) {
    find_faces(t);
    last_value = value_at(t);
}

/* How far the ray stays in the cell that it is in, or where nothing can be seen. */
void PLUG_volume_cell(const in float t, inout float end) {
    if (!is_inside(t))
        return;
    vec3 to_faces = (next_face - cell_origin) * cell_inverse;
    float to_face = min(min(to_faces.x, to_faces.y), to_faces.z);
#if LEAPS
    vec3 corner;
    /* the cell by its faces: rounding takes none for its neighbour, however short the ray is in it */
    vec3 cell = next_face - mix(vec3(-0.5), vec3(0.5), greaterThanEqual(cell_direction, vec3(0.0)));
    is_clear = leap_at(cell, corner) > 0.0;
    if (is_clear) {
        to_faces = (corner - cell_origin) * cell_inverse;
        to_face = max(to_face, min(min(to_faces.x, to_faces.y), to_faces.z));
    }
#endif
    end = max(min(end, to_face), t);
}

/* The value over the piece, and what its integral errs by if it is not cut: x; y: its
 * optical depth at most; z: change of colour. At least and at most how many parts make sense. */
void PLUG_volume_cell_fit(const in float t, const in float end, inout vec3 need, inout float least,
                          inout float most) {
    float span = end - t;
    float v0 = last_value, v3 = value_at(end);
    find_faces(end);
    last_value = v3;
#if LEAPS
    if (is_clear)
        return;
#endif
    float v1 = value_at(t + span / 3.0), v2 = value_at(t + span * (2.0 / 3.0));
    /* a cubic that is nowhere below 0, and 0 at two places within, is 0: its ends, in faces of cells, may be
     * rounded to those behind. So that cells are clear here where a leap would pass over them. */
    is_clear = v1 == 0.0 && v2 == 0.0 && seenValues.x >= 0.0;
    if (is_clear)
        return;
    part_value = v0;
    cubic[0] = v0;
    cubic[1] = 0.5 * (18.0 * v1 - 11.0 * v0 - 9.0 * v2 + 2.0 * v3);
    cubic[2] = 4.5 * (2.0 * v0 - 5.0 * v1 + 4.0 * v2 - v3);
    cubic[3] = 4.5 * (3.0 * v1 - v0 - 3.0 * v2 + v3);
    if (!is_inside(t))
        return;
    /* Bernstein's coefficients enclose the cubic */
    float b1 = v0 + cubic[1] / 3.0, b2 = v0 + (2.0 * cubic[1] + cubic[2]) / 3.0;
    float low = min(min(v0, v3), min(b1, b2)), high = max(max(v0, v3), max(b1, b2));
    vec4 range = texelFetch(ranges, ivec2(clamp(vec2(low, high), 0.0, 1.0 - 0.5 / RANGES) * RANGES), 0);
    float bend = max(abs(2.0 * cubic[2]), abs(2.0 * cubic[2] + 6.0 * cubic[3]));
    float depth = span * depth_ratio;
#if MIXES
    /* colours of volumes in one place are as unlike as can be */
    if (need.y > 0.0 && range.y > 0.0)
        need.z = 1.0;
#endif
    need.xy += vec2(depth * range.x * bend * 0.016, depth * range.y);
    need.z = max(need.z, range.z);
    float finest = ceil(sqrt(bend / (8.0 * VALUE_UNIT)));
    most = max(most, finest);
#if HAS_WALL
    if (high >= wallValues.x && low <= wallValues.y)
        least = max(least, finest);
#endif
}

/* The integral from 0 to a value, in two parts of unlike size, and what is there. */
void sum_at(const in float value, out vec4 sum, out vec4 small, out vec4 density) {
    int nodes = textureSize(sums, 0).x;
    float place = clamp(value, 0.0, 1.0) * float(nodes - 1);
    int node = min(int(place), nodes - 2);
    float beyond = place - float(node);
    vec4 first = texelFetch(sums, ivec2(node, 1), 0), rise = texelFetch(sums, ivec2(node, 2), 0);
    density = first + beyond * rise;
    sum = texelFetch(sums, ivec2(node, 0), 0);
    small = texelFetch(sums, ivec2(node, 3), 0) + beyond / float(nodes - 1) * (first + 0.5 * beyond * rise);
}

/* What lies, in the mean, between two values. Between two nodes extinction is a line, which has its mean in
 * the middle; beyond, integrals differ by more than rounding. */
vec4 exact_mean(const in float from, const in float to) {
    vec4 first, last, first_small, last_small, first_density, last_density;
    sum_at(from, first, first_small, first_density);
    sum_at(to, last, last_small, last_density);
    float apart = clamp(to, 0.0, 1.0) - clamp(from, 0.0, 1.0);
    float last_node = float(textureSize(sums, 0).x - 1);
    bool in_one = floor(clamp(from, 0.0, 1.0) * last_node) == floor(clamp(to, 0.0, 1.0) * last_node);
    vec4 mean = ((last - first) + (last_small - first_small)) / (apart == 0.0 ? 1.0 : apart);
    return max(in_one || abs(apart) < 2.0e-6 ? 0.5 * (first_density + last_density) : mean, 0.0);
}

#if HAS_WALL
/* Of the first opaque value from `from` on: amid opaque ones its own, else that of the nearer end. */
vec3 opaque_color(const in float from) {
    if (!is_within_wall(from))
        return wall_color(from).rgb;
    vec4 sum, small, density;
    sum_at(from, sum, small, density);
    return density.rgb / density.a;
}
#endif

/* What lies along a part of the piece, which ends at u; `parts` of them are the whole. */
void PLUG_volume_cell_part(inout VolumeMix mixed, inout vec4 wall, const in float t, const in float u,
                           const in float parts, const in float span) {
    float from = part_value, part = 1.0 / parts;
    float to = ((cubic[3] * u + cubic[2]) * u + cubic[1]) * u + cubic[0];
    part_value = to;
    if (!is_inside(t) || is_clear)
        return;
    float shift = (2.0 * cubic[2] + 6.0 * cubic[3] * (u - 0.5 * part)) * part * part / 12.0;
    float length_ratio = span * depth_ratio;
#if HAS_WALL
    float way = way_to_wall(from, to);
    if (way <= 1.0) {
        length_ratio *= way;
        wall += vec4(opaque_color(from), 1.0);
        to = mix(from, to, way);
        shift = 0.0;
    }
#endif
    mixed.sum += exact_mean(from - shift, to - shift) * length_ratio;
}
