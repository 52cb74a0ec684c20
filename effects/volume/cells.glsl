/* A volume with a table (table.glsl), cut at the faces of voxel cells. In a cell the trilinear value is a
 * cubic along the ray, from its corners, or from four samples, exactly. It is cut further until its parts are straight enough.
 * A unit of Volume.glsl's effect.
 *
 * Along a part the straight line stands for the value that has the same mean. Along a line colour and opacity are
 * linear from one node of the transfer function to the next, so that the integrals of extinction, -ln(1 - opacity),
 * and of colour times extinction have closed forms; those of gentle functions are lines there themselves. Where extinction is linear in the value nothing is lost. Else it errs by half the change of its slope times the integral of the
 * distance from the line, 0.257 l b / 8 for a parabola that bends by b over the part: 0.016 l b times the change
 * of slope. Colours are weighted by extinction within a part: what hides what is lost there (part_count in
 * raycaster.frag.glsl). (Novins, Arvo 1992 have such bounds for other rules.)
 */

uniform vec2 seenValues;  /* outside of this open interval values are clear */
uniform sampler2D sums;   /* integrals of colour * extinction and of extinction up to each node of values; the
                             function there; opaque values below and above the span behind; what the
                             first lost by rounding */
uniform sampler2D ranges; /* between two values: change of slope; extinction; change of colour, in PLR_TABLE_COLORS,
                             and behind the point its part of all changes; from where to where something can be seen */
#if HAS_LABELS
/* Of both there is one for each function of the segments, sums one above the other, ranges in rows of RANGES_ACROSS.
 * The row above all sums has, for each segment number: the first row of its function, its last node, and outside of which
 * open interval values are clear. The last texel is that of all numbers above. */
#endif


const float SEEN_STEPS = 4096.0; /* of two numbers in one: PLR_TABLE_SEEN */
const float COLORS = 1000.0; /* the same in C: PLR_TABLE_COLORS */
const float RANGES = 64.0; /* the same in C: PLR_TABLE_RANGES */
const float RANGES_ACROSS = 8.0; /* the same in C: PLR_RANGES_ACROSS */
const float VALUE_UNIT = 1.0 / 8388608.0; /* values are not followed finer */

vec3 next_face;  /* along each axis, in cells */
vec3 face_step;  /* to the one behind it */
vec4 cubics[8];  /* the values over the cells that are looked at together, CHUNK: coefficients, each from 0 to 1 */
vec4 cubic;      /* over one of them */
#if !HAS_LABELS
float node_size; /* of `sums`, as texture coordinates have it */
#endif
#if !HAS_QUADS
float value_before; /* where the cell before ends */
#endif
#if HAS_LABELS
vec4 cell_functions[8]; /* in each of them, as they stand in `sums`; or NOT_SEEN */
vec4 function_here;
const vec4 NOT_SEEN = vec4(0.0, 1.0, 1.0e30, -1.0e30);
uniform usampler3D cellLabels; /* of the cells between voxels: the label that these have in common */
const float LABELS_DIFFER = 255.0; /* there, where they have none; the same in C: PLR_LABELS_DIFFER */
float piece_label;
#endif

#if HAS_WALL
vec2 cell_walls[8];   /* what is not between these is opaque */
float wall_at[8];     /* where in a cell that is met; beyond 1: nowhere */
#endif

/* Whether cell k, which begins at t, may add anything. */
bool is_looked_at(const in int k, const in float t) {
#if HAS_LABELS
    return is_inside(t) && cell_functions[k].z < cell_functions[k].w;
#else
    return is_inside(t);
#endif
}

/* Along each axis the first face that lies behind t. */
void find_faces(const in float t) {
    face_step = mix(vec3(-1.0), vec3(1.0), greaterThanEqual(cell_direction, vec3(0.0)));
    next_face = floor(cell_origin + t * cell_direction) - face_step;
    for (int i = 0; i < 3; i++)
        next_face += face_step * vec3(lessThanEqual((next_face - cell_origin) * cell_inverse, vec3(t)));
}

#if LEAPS
/* How far nothing can be seen; no further than t if something may be. */
void PLUG_volume_cells_leap(const in float t, inout float end) {
    if (!is_inside(t))
        return;
    find_faces(t);
    vec3 corner;
    /* the cell by its faces: rounding takes none for its neighbour, however short the ray is in it */
    float blocks = leap_at(next_face - 0.5 * face_step, corner);
    vec3 ends = (corner - cell_origin) * cell_inverse;
    end = min(end, blocks > 0.0 ? min(min(ends.x, ends.y), ends.z) : t);
}
#endif

#if HAS_LABELS
float at_voxel(const in usampler3D numbers, const in vec3 voxel) {
    vec3 size = vec3(textureSize(numbers, 0));
    return float(texture(numbers, (clamp(voxel, vec3(0.0), size - 1.0) + 0.5) / size).r);
}

/* The label of the piece that begins at t and ends at the next face, and where it ends, if before. The label is that of
 * the nearest voxel: where those around the cell differ it is cut in the middle, too. Faces and middles tell the
 * voxel: rounding takes none for its neighbour, nor does it leave slivers where the volume is cut just there. */
void find_label(const in float t, inout float end) {
    vec3 middle = next_face - 0.5 * face_step, cell = floor(middle);
    piece_label = at_voxel(cellLabels, cell - 1.0);
    if (piece_label != LABELS_DIFFER)
        return;
    vec3 ahead = (middle - cell_origin - t * cell_direction) * face_step;
    vec3 beyond = (cell_origin + end * cell_direction - middle) * face_step;
    vec3 rounded = 5.0e-7 * (abs(cell_origin) + abs(t * cell_direction));
    vec3 ends = mix(vec3(NOWHERE), (middle - cell_origin) * cell_inverse, greaterThan(min(ahead, beyond), rounded));
    bvec3 before = greaterThan(ahead, rounded);
    end = min(end, min(min(ends.x, ends.y), ends.z));
    vec3 upper = abs(vec3(greaterThan(face_step, vec3(0.0))) - vec3(before));
    piece_label = at_voxel(labels, cell - 1.0 + upper);
}

/* The function of a label. */
vec4 function_of(const in float label) {
    vec2 texels = vec2(textureSize(sums, 0));
    float number = min(label, texels.x - 1.0);
    return texture(sums, (vec2(number, texels.y - 1.0) + 0.5) / texels);
}

/* What holds between two values in the function at hand. */
vec4 range_of(const in float low, const in float high) {
    float number = 0.25 * function_here.x, row = floor(number / RANGES_ACROSS);
    vec2 first = RANGES * vec2(number - RANGES_ACROSS * row, row);
    vec2 bin = min(floor(clamp(vec2(low, high), 0.0, 1.0) * RANGES), RANGES - 1.0);
    return texture(ranges, (first + bin + 0.5) / vec2(textureSize(ranges, 0)));
}
#endif

/* Cells that are looked at together begin. */
void PLUG_volume_cells_begin(const in float t) {
#if !HAS_LABELS
    node_size = 1.0 / float(textureSize(sums, 0).x);
#endif
    find_faces(t);
#if !HAS_QUADS
    value_before = value_at(t);
#endif
}

/* How far the ray stays in the cell that it is in. */
void PLUG_volume_cell(const in float t, inout float end) {
    vec3 to_faces = (next_face - cell_origin) * cell_inverse;
    float to_face = min(min(to_faces.x, to_faces.y), to_faces.z);
#if HAS_LABELS
    to_face = min(to_face, end);
    find_label(t, to_face);
#endif
    end = is_inside(t) ? max(min(end, to_face), t) : end;
}

#if HAS_QUADS
/* The value along the piece of a cell from t to `end`, from 0 to 1: trilinear between the cell's corners. */
vec4 cubic_between(const in float t, const in float end, out bool zero) {
    vec3 last = vec3(textureSize(voxelQuads, 0)) - 1.0;
    vec3 first = clamp(floor(next_face - 0.5 * face_step) - 1.0, vec3(0.0), last);
    vec3 texel = (first + 0.5) * texel_size;
    vec4 front = texture(voxelQuads, texel), back = texture(voxelQuads, vec3(texel.xy, texel.z + texel_size.z));
    vec3 from = clamp(cell_origin + t * cell_direction - 1.0 - first, 0.0, 1.0);
    vec3 way = clamp(cell_origin + end * cell_direction - 1.0 - first, 0.0, 1.0) - from;
    /* of differences: what is even stays so */
    vec4 along_z = back - front, low = front + along_z * from.z;
    along_z *= way.z;
    vec2 along_x = low.yw - low.xz, twist = along_z.yw - along_z.xz;
    vec2 p = low.xz + along_x * from.x, q = along_z.xz + twist * from.x + along_x * way.x, r = twist * way.x;
    vec3 along_y = vec3(p.y - p.x, q.y - q.x, r.y - r.x);
    vec4 found = vec4(vec3(p.x, q.x, r.x) + along_y * from.y, 0.0) + vec4(0.0, along_y * way.y);
    zero = all(equal(found, vec4(0.0)));
    return found;
}
#else
/* The same from four samples. */
vec4 cubic_between(const in float t, const in float end, out bool zero) {
    float span = end - t, v0 = value_before;
    float v1 = value_at(t + span / 3.0), v2 = value_at(t + span * (2.0 / 3.0)), v3 = value_at(end);
    value_before = v3;
    /* a cubic that is nowhere below 0, and 0 at two places within, is 0: its ends, in faces of cells, may be
     * rounded to those behind */
    zero = v1 == 0.0 && v2 == 0.0;
    float d1 = v1 - v0, d2 = v2 - v1, d3 = v3 - v2;
    return vec4(v0, 0.5 * (11.0 * d1 - 7.0 * d2 + 2.0 * d3), 4.5 * (3.0 * d2 - 2.0 * d1 - d3),
                4.5 * (d1 - 2.0 * d2 + d3));
}
#endif

/* Looks at cell k: whether anything can be seen there. */
void PLUG_volume_cell_look(inout uint visible, const in int k, const in float t, const in float end) {
    bool zero;
    vec4 c = cubic_between(t, end, zero);
    next_face += face_step * vec3(lessThanEqual((next_face - cell_origin) * cell_inverse, vec3(end)));
    cubics[k] = c;
    /* Bernstein's coefficients enclose the cubic */
    float b1 = c.x + c.y * (1.0 / 3.0), b2 = b1 + (c.y + c.z) * (1.0 / 3.0), v3 = c.x + (c.y + (c.z + c.w));
    float low = min(min(c.x, v3), min(b1, b2)), high = max(max(c.x, v3), max(b1, b2));
    bool seen = high > seenValues.x && low < seenValues.y;
    /* so that cells are clear here where a leap would pass over them */
#if HAS_LABELS
    vec4 function = NOT_SEEN;
    if (seen)
        function = function_of(piece_label);
    seen = high > function.z && low < function.w;
    cell_functions[k] = seen ? function : NOT_SEEN;
    bool clear = zero && function.z >= 0.0;
#else
    bool clear = zero && seenValues.x >= 0.0;
#endif
    if (seen && !clear && end > t && is_inside(t))
        visible |= 1u << uint(k);
}

/* The value over cell k. */
void take_cubic(const in int k) {
    cubic = cubics[k];
#if HAS_LABELS
    function_here = cell_functions[k];
#endif
}

float value_in(const in float u) {
    return ((cubic[3] * u + cubic[2]) * u + cubic[1]) * u + cubic[0];
}

#if CLIPS
/* Narrows a part of a piece, from x to y, to where its value may be within some: there the line between its ends is, but
 * for three quarters of what Bernstein's coefficients are off that line (clipping by a fat line: Sederberg,
 * Nishita 1990). */
void clip_piece(const in vec2 values, inout vec2 part) {
    float size = part.y - part.x, first = value_in(part.x), last = value_in(part.y);
    vec2 slopes = (3.0 * cubic[3] * part + 2.0 * cubic[2]) * part + cubic[1];
    float rise = last - first;
    vec2 off = vec2(size * slopes.x - rise, rise - size * slopes.y) / 3.0;
    float above = 0.75 * max(max(off.x, off.y), 0.0), below = 0.75 * min(min(off.x, off.y), 0.0);
    if (abs(rise) < 1.0e-6)
        return;
    vec2 ends = (values + vec2(-above, -below) - first) / rise;
    ends = rise < 0.0 ? ends.yx : ends;
    ends = clamp(ends + vec2(-1.0e-5, 1.0e-5), 0.0, 1.0);
    part = ends.x < ends.y ? part.x + ends * size : part.xx;
}
#endif

/* A node of the transfer function: colour and opacity, and with it what comes before. Beyond the outermost
 * nodes the function goes on as it is between the last two, so that means of lines are kept. */
struct Place {
    int node;
    float beyond; /* in nodes */
};

/* Row by row what belongs to a node: by texture(), which costs less than texelFetch() where there are no
 * levels to choose from. */
vec4 sums_at(const in int node, const in float row) {
#if HAS_LABELS
    return texture(sums, (vec2(float(node), function_here.x + row) + 0.5) / vec2(textureSize(sums, 0)));
#else
    return texture(sums, vec2((float(node) + 0.5) * node_size, (row + 0.5) * 0.25));
#endif
}

Place place_of(const in float value) {
#if HAS_LABELS
    int last = int(function_here.y);
#else
    int last = textureSize(sums, 0).x - 1;
#endif
    float place = value * float(last);
    int node = clamp(int(floor(place)), 0, last - 1);
    return Place(node, place - float(node));
}

vec4 function_in(const in int node, const in float beyond) {
    return mix(sums_at(node, 1.0), sums_at(node + 1, 1.0), beyond);
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
    vec4 first = sums_at(node, 1.0), last = sums_at(node + 1, 1.0);
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
    float mean = middle + r2 * (1.0 / 6.0 + r2 * (1.0 / 20.0 + r2 * (1.0 / 42.0 + r2 * (1.0 / 72.0))));
    float tilt = r * (1.0 / 3.0 + r2 * (1.0 / 15.0 + r2 * (1.0 / 35.0 + r2 * (1.0 / 63.0))));
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
        vec4 between = (sums_at(high.node, 0.0) - sums_at(behind, 0.0)) +
                       (sums_at(high.node, 3.0) - sums_at(behind, 3.0));
        float rest = 1.0 - low.beyond;
#if HAS_LABELS
        float spans = function_here.y;
#else
        float spans = float(textureSize(sums, 0).x - 1);
#endif
        mean = mean * rest + mean_within(high.node, 0.0, high.beyond) * high.beyond + between * spans;
        mean *= 1.0 / (float(high.node - behind) + rest + high.beyond);
    }
    return max(mean, 0.0);
}

#if HAS_WALL
bool is_opaque(const in float value, const in vec2 walls) {
    return value <= walls.x || value >= walls.y;
}

/* Where the cubic first takes an opaque value: it is cut where it turns, and in the first part that ends
 * in one is the place, by Newton's method, halving where that leads astray. */
float find_wall(const in vec2 walls) {
    if (is_opaque(cubic[0], walls))
        return 0.0;
    float a = 3.0 * cubic[3], b = cubic[2], c = cubic[1];
    float root = sqrt(max(b * b - a * c, 0.0)), q = -(b + (b < 0.0 ? -root : root));
    float one = a == 0.0 ? 2.0 : q / a, other = q == 0.0 ? 2.0 : c / q;
    vec2 turns = vec2(min(one, other), max(one, other));
    turns = mix(turns, vec2(1.0), lessThanEqual(turns, vec2(0.0)));
    turns = min(vec2(min(turns.x, turns.y), max(turns.x, turns.y)), 1.0);
    bool first = is_opaque(value_in(turns.x), walls), second = is_opaque(value_in(turns.y), walls);
    if (!first && !second && !is_opaque(value_in(1.0), walls))
        return 2.0;
    float low = first ? 0.0 : second ? turns.x : turns.y;
    float high = first ? turns.x : second ? turns.y : 1.0;
    float at = value_in(high) <= walls.x ? walls.x : walls.y;
    bool rises = at == walls.y;
    float u = 0.5 * (low + high), way = high - low;
    /* each way is at most half of the one before, or of what is between low and high: it ends. Neighbouring rays wait
     * for the last of them: no count of rounds, which a compiler would unroll. */
    do {
        float value = value_in(u), slope = (3.0 * cubic[3] * u + 2.0 * cubic[2]) * u + cubic[1];
        bool beyond = rises ? value >= at : value <= at;
        high = beyond ? u : high;
        low = beyond ? low : u;
        float newton = (value - at) / (slope == 0.0 ? 1.0e-30 : slope), next = u - newton;
        bool better = next > low && next < high && abs(newton) <= 0.5 * abs(way);
        next = better ? next : 0.5 * (low + high);
        way = next - u;
        u = next;
    } while (abs(way) > 1.0e-7);
    return u;
}
#endif

/* What cell k needs. */
void PLUG_volume_cell_fit(const in int k, const in float t, const in float end, inout CellNeed need) {
#if HAS_WALL
    wall_at[k] = 2.0;
#endif
    if (!is_looked_at(k, t))
        return;
    take_cubic(k);
    float v0 = cubic[0], v3 = value_in(1.0);
    float b1 = v0 + cubic[1] * (1.0 / 3.0), b2 = b1 + (cubic[1] + cubic[2]) * (1.0 / 3.0);
    float low = min(min(v0, v3), min(b1, b2)), high = max(max(v0, v3), max(b1, b2));
    float slopes = 0.0;
#if HAS_WALL
    vec4 walls = sums_at(place_of(v0).node, 2.0);
    cell_walls[k] = walls.xy;
    float apart = min(low - walls.x, walls.y - high);
    if (apart <= 0.0) {
        float u = find_wall(walls.xy);
        wall_at[k] = u;
        need.opaque_at = min(need.opaque_at, u);
        u = min(u, 1.0);
        apart = abs((3.0 * cubic[3] * u + 2.0 * cubic[2]) * u + cubic[1]);
    }
    low = max(low, walls.x);
    high = min(high, walls.y);
    /* Towards an opaque value extinction is the logarithm of the distance to it, and its slope one over that. */
    slopes = low < walls.z || high > walls.w ? 1.0 / max(apart, 1.0e-9) : 0.0;
#endif
    /* a part's line reaches farther than its values do: there the function counts, too */
    vec2 reach = vec2(low, high) + vec2(-1.0, 1.0) / 12.0 * max(abs(2.0 * cubic[2]), abs(2.0 * cubic[2] + 6.0 * cubic[3]));
#if HAS_WALL
    reach = vec2(max(reach.x, walls.x), min(reach.y, walls.y));
#endif
#if HAS_LABELS
    vec4 range = range_of(reach.x, reach.y);
#else
    vec4 range = texture(ranges, clamp(reach, 0.0, 1.0));
#endif
    vec2 part = vec2(0.0, 1.0);
#if CLIPS && !MIXES
    float first_seen = floor(range.w / SEEN_STEPS);
    vec2 seen = vec2(first_seen, range.w - first_seen * SEEN_STEPS) / (SEEN_STEPS - 1.0);
    /* values beyond 0 and 1 are those; and cubics round */
    seen += mix(vec2(-1.0e-5, 1.0e-5), vec2(-1.0, 1.0), vec2(lessThanEqual(vec2(seen.x, 1.0 - seen.y), vec2(0.0))));
    clip_piece(seen, part);
    clip_piece(seen, part);
    need.part = part;
#endif
    float size = part.y - part.x, depth = size * (end - t) * depth_ratio;
    vec2 bends = abs(2.0 * cubic[2] + 6.0 * cubic[3] * part);
    float bend = size * size * max(bends.x, bends.y);
    /* rays that come to what is opaque nearly at a tangent are as those beside them */
    slopes = min(slopes, 64.0 / max(bend, 1.0e-9));
    /* forth and back: no cubic turns more often than the coefficients that enclose it */
    float passes = 1.0 + float((b1 - v0) * (b2 - b1) < 0.0) + float((b2 - b1) * (v3 - b2) < 0.0);
    float change = floor(range.z) / COLORS, turns = passes * change / max(fract(range.z), 1.0e-6);
#if MIXES
    /* colours of volumes in one place are as unlike as can be */
    if (need.depth > 0.0 && range.y > 0.0) {
        change = 1.0;
        turns = max(turns, 4.0);
    }
    need.change = max(need.change, change);
    need.turns = max(need.turns, turns);
#else
    need.change = change;
    need.turns = turns;
#endif
    need.error += depth * (range.x + slopes) * bend * 0.016;
    need.depth += depth * range.y;
    need.most = max(need.most, ceil(sqrt(bend / (8.0 * VALUE_UNIT))));
}

/* What lies along a part of cell k, which begins at t, from u to u_end of it. */
void PLUG_volume_cell_part(inout VolumeMix mixed, const in int k, const in float t, const in float u,
                           const in float u_end, const in float span) {
    if (!is_looked_at(k, t))
        return;
    take_cubic(k);
    float from = value_in(u), to = value_in(u_end), part = u_end - u;
    float shift = (2.0 * cubic[2] + 3.0 * cubic[3] * (u + u_end)) * part * part * (1.0 / 12.0);
#if HAS_WALL
    /* the line keeps on its side of what is opaque */
    shift = clamp(shift, max(from, to) - cell_walls[k].y, min(from, to) - cell_walls[k].x);
#endif
    mixed.sum += exact_mean(from - shift, to - shift) * (span * depth_ratio);
}

#if HAS_WALL
/* Cell k ends at u, in opaque values of one volume or several. */
void PLUG_volume_cell_wall(inout vec4 wall, const in int k, const in float t, const in float u) {
    if (!is_looked_at(k, t) || wall_at[k] > u)
        return;
    take_cubic(k);
    Place place = place_of(clamp(value_in(u), 0.0, 1.0));
    wall += vec4(function_in(place.node, place.beyond).rgb, 1.0);
}
#endif
