/* A volume with a table (table.glsl), cut at the faces of voxel cells. In a cell the trilinear value is a
 * cubic along the ray: four samples have it exactly. It is cut further until its parts are straight enough.
 * A unit of Volume.glsl's effect.
 *
 * Along a part the straight line stands for the value that has the same mean. Along a line colour and opacity are
 * linear from one node of the transfer function to the next, so that the integrals of extinction, -ln(1 - opacity),
 * and of colour times extinction have closed forms; those of gentle functions are lines there themselves. Where extinction is linear in the value nothing is lost. Else it errs by half the change of its slope times the integral of the
 * distance from the line, 0.257 l b / 8 for a parabola that bends by b over the part: 0.016 l b times the change
 * of slope. Colours are weighted by opacity within a part: what hides what is lost there, at most
 * opacity * change of colour * depth / 2. (Novins, Arvo 1992 have such bounds for other rules.)
 */

uniform vec2 seenValues;  /* outside of this open interval values are clear */
uniform sampler2D sums;   /* integrals of colour * extinction and of extinction up to each node of values; the
                             function there; opaque values below and above the span behind; what the
                             first lost by rounding */
uniform sampler2D ranges; /* between two values: change of slope, extinction, change of colour */


const float RANGES = 64.0; /* the same in C: PLR_TABLE_RANGES */
const float VALUE_UNIT = 1.0 / 8388608.0; /* values are not followed finer */

vec3 next_face;  /* along each axis, in cells */
float cubic[4];  /* the value over the piece of the ray in the cell, from 0 to 1 */
float last_value;
/* At the end of the part of a piece before. */
float part_value;
bool is_clear; /* nothing can be seen in the piece, which may then span many cells */
#if HAS_WALL
vec4 walls;    /* what is not between the first two is opaque; towards them opacity rises to 1 from the others on */
float wall_at; /* where the piece meets an opaque value; beyond 1: nowhere */
#endif

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

/* A node of the transfer function: colour and opacity, and with it what comes before. Beyond the outermost
 * nodes the function goes on as it is between the last two, so that means of lines are kept. */
struct Place {
    int node;
    float beyond; /* in nodes */
};

Place place_of(const in float value) {
    int last = textureSize(sums, 0).x - 1;
    float place = value * float(last);
    int node = clamp(int(floor(place)), 0, last - 1);
    return Place(node, place - float(node));
}

vec4 function_in(const in int node, const in float beyond) {
    return mix(texelFetch(sums, ivec2(node, 1), 0), texelFetch(sums, ivec2(node + 1, 1), 0), beyond);
}

#if GENTLE
/* The mean over a part of what is between two nodes, where it is a line. */
vec4 mean_within(const in int node, const in float from, const in float to) {
    return function_in(node, 0.5 * (from + to));
}
#else
/* The mean of colour * extinction and of extinction over a part of what is between two nodes. Clearness,
 * 1 - opacity, runs from m (1 - r) to m (1 + r); for r near 0 the closed forms are cancelled, their series serve. */
vec4 mean_within(const in int node, const in float from, const in float to) {
    vec4 first = texelFetch(sums, ivec2(node, 1), 0), last = texelFetch(sums, ivec2(node + 1, 1), 0);
    vec4 a = mix(first, last, from), b = mix(first, last, to);
    vec2 ends = max(1.0 - vec2(first.a, last.a), 0.0);
    float least = 0.5 * min(ends.x, ends.y);
    float p = max(mix(1.0 - first.a, 1.0 - last.a, from), least);
    float q = max(mix(1.0 - first.a, 1.0 - last.a, to), least);
    const float TINY = 1.0e-30;
    float r = (q - p) / max(p + q, TINY), r2 = r * r;
    float alpha = 0.5 * (a.a + b.a);
    float middle = abs(alpha) < 0.03125 ? alpha * (1.0 + alpha * (0.5 + alpha * (1.0 / 3.0 + alpha * 0.25)))
                                        : -log(max(0.5 * (p + q), TINY));
    float mean = middle + r2 * (1.0 / 6.0 + r2 * (1.0 / 20.0 + r2 * (1.0 / 42.0 + r2 / 72.0)));
    float tilt = r * (1.0 / 3.0 + r2 * (1.0 / 15.0 + r2 * (1.0 / 35.0 + r2 / 63.0)));
    if (abs(r) > 0.3) {
        float lp = log(max(p, TINY)), lq = log(max(q, TINY)), t = 0.5 * (lq - lp);
        mean = 1.0 - 0.5 * (lp + lq) - t / r;
        tilt = 0.5 * (t * (1.0 - 1.0 / r2) + 1.0 / r);
    }
    return vec4(0.5 * (a.rgb + b.rgb) * mean - 0.5 * (b.rgb - a.rgb) * tilt, mean);
}
#endif

/* What lies, in the mean, between two values. */
vec4 exact_mean(const in float from, const in float to) {
    Place low = place_of(min(from, to)), high = place_of(max(from, to));
    bool in_one = low.node == high.node;
    vec4 mean = mean_within(low.node, low.beyond, in_one ? high.beyond : 1.0);
    if (!in_one) {
        int behind = low.node + 1;
        vec4 between = (texelFetch(sums, ivec2(high.node, 0), 0) - texelFetch(sums, ivec2(behind, 0), 0)) +
                       (texelFetch(sums, ivec2(high.node, 3), 0) - texelFetch(sums, ivec2(behind, 3), 0));
        float rest = 1.0 - low.beyond;
        mean = mean * rest + mean_within(high.node, 0.0, high.beyond) * high.beyond +
               between * float(textureSize(sums, 0).x - 1);
        mean /= float(high.node - behind) + rest + high.beyond;
    }
    return max(mean, 0.0);
}

#if HAS_WALL
float value_in(const in float u) {
    return ((cubic[3] * u + cubic[2]) * u + cubic[1]) * u + cubic[0];
}

bool is_opaque(const in float value) {
    return value <= walls.x || value >= walls.y;
}

/* Where the cubic first takes an opaque value: it is cut where it turns, and in the first part that ends
 * in one is the place, by Newton's method, halving where that leads astray. */
float find_wall() {
    if (is_opaque(cubic[0]))
        return 0.0;
    float a = 3.0 * cubic[3], b = cubic[2], c = cubic[1];
    float root = sqrt(max(b * b - a * c, 0.0)), q = -(b + (b < 0.0 ? -root : root));
    float one = a == 0.0 ? 2.0 : q / a, other = q == 0.0 ? 2.0 : c / q;
    vec2 turns = vec2(min(one, other), max(one, other));
    turns = mix(turns, vec2(1.0), lessThanEqual(turns, vec2(0.0)));
    turns = min(vec2(min(turns.x, turns.y), max(turns.x, turns.y)), 1.0);
    bool first = is_opaque(value_in(turns.x)), second = is_opaque(value_in(turns.y));
    if (!first && !second && !is_opaque(value_in(1.0)))
        return 2.0;
    float low = first ? 0.0 : second ? turns.x : turns.y;
    float high = first ? turns.x : second ? turns.y : 1.0;
    float at = value_in(high) <= walls.x ? walls.x : walls.y;
    bool rises = at == walls.y;
    float u = 0.5 * (low + high);
    for (int i = 0; i < 20; i++) {
        float value = value_in(u), slope = (3.0 * cubic[3] * u + 2.0 * cubic[2]) * u + cubic[1];
        bool beyond = rises ? value >= at : value <= at;
        high = beyond ? u : high;
        low = beyond ? low : u;
        float next = u - (value - at) / (slope == 0.0 ? 1.0e-30 : slope);
        u = next > low && next < high ? next : 0.5 * (low + high);
    }
    return u;
}
#endif

/* The value over the piece, and what its integral errs by if it is not cut: x; y: its
 * optical depth at most; z: change of colour. At most how many parts make sense; where the first volume is opaque. */
void PLUG_volume_cell_fit(const in float t, const in float end, inout vec3 need, inout float most,
                          inout float opaque_at) {
    float span = end - t;
    float v0 = last_value, v3 = value_at(end);
    find_faces(end);
    last_value = v3;
#if HAS_WALL
    wall_at = 2.0;
#endif
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
    /* of differences: what is even stays so */
    float d1 = v1 - v0, d2 = v2 - v1, d3 = v3 - v2;
    cubic[0] = v0;
    cubic[1] = 0.5 * (11.0 * d1 - 7.0 * d2 + 2.0 * d3);
    cubic[2] = 4.5 * (3.0 * d2 - 2.0 * d1 - d3);
    cubic[3] = 4.5 * (d1 - 2.0 * d2 + d3);
    if (!is_inside(t))
        return;
    /* Bernstein's coefficients enclose the cubic */
    float b1 = v0 + cubic[1] / 3.0, b2 = v0 + (2.0 * cubic[1] + cubic[2]) / 3.0;
    float low = min(min(v0, v3), min(b1, b2)), high = max(max(v0, v3), max(b1, b2));
    float bend = max(abs(2.0 * cubic[2]), abs(2.0 * cubic[2] + 6.0 * cubic[3]));
    float depth = span * depth_ratio;
    float slopes = 0.0;
#if HAS_WALL
    walls = texelFetch(sums, ivec2(place_of(v0).node, 2), 0);
    float apart = min(low - walls.x, walls.y - high);
    if (apart <= 0.0) {
        wall_at = find_wall();
        opaque_at = min(opaque_at, wall_at);
        float u = min(wall_at, 1.0);
        apart = abs((3.0 * cubic[3] * u + 2.0 * cubic[2]) * u + cubic[1]);
    }
    /* Towards an opaque value extinction is the logarithm of the distance to it, and its slope one over that.
     * Rays that come to it nearly at a tangent are as those beside them. */
    slopes = min(1.0 / max(apart, 1.0e-9), 64.0 / max(bend, 1.0e-9));
    low = max(low, walls.x);
    high = min(high, walls.y);
    slopes = low < walls.z || high > walls.w ? slopes : 0.0;
#endif
    vec4 range = texelFetch(ranges, ivec2(clamp(vec2(low, high), 0.0, 1.0 - 0.5 / RANGES) * RANGES), 0);
#if MIXES
    /* colours of volumes in one place are as unlike as can be */
    if (need.y > 0.0 && range.y > 0.0)
        need.z = 1.0;
#endif
    need.xy += vec2(depth * (range.x + slopes) * bend * 0.016, depth * range.y);
    need.z = max(need.z, range.z);
    most = max(most, ceil(sqrt(bend / (8.0 * VALUE_UNIT))));
}

/* What lies along a part of the piece, which ends at u. */
void PLUG_volume_cell_part(inout VolumeMix mixed, const in float t, const in float u,
                           const in float part, const in float span) {
    float from = part_value;
    float to = ((cubic[3] * u + cubic[2]) * u + cubic[1]) * u + cubic[0];
    part_value = to;
    if (!is_inside(t) || is_clear)
        return;
    float shift = (2.0 * cubic[2] + 6.0 * cubic[3] * (u - 0.5 * part)) * part * part / 12.0;
#if HAS_WALL
    /* the line keeps on its side of what is opaque */
    shift = clamp(shift, max(from, to) - walls.y, min(from, to) - walls.x);
#endif
    mixed.sum += exact_mean(from - shift, to - shift) * (span * depth_ratio);
}

#if HAS_WALL
/* The piece ends here, in opaque values of one volume or several. */
void PLUG_volume_cell_wall(inout vec4 wall, const in float t, const in float u) {
    if (!is_inside(t) || is_clear || wall_at > u)
        return;
    Place place = place_of(clamp(value_in(u), 0.0, 1.0));
    wall += vec4(function_in(place.node, place.beyond).rgb, 1.0);
}
#endif
