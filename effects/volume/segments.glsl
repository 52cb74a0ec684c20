/* A volume with a table (table.glsl), cut into segments of equal length, of which four may be joined. A unit of
 * Volume.glsl's effect. */

uniform vec2 seenValues; /* outside of this open interval values are clear */

float values[11]; /* at the ends of the segments that are looked at together, CHUNK, and one step around */

bool is_between_seen(const in float from, const in float to) {
    return max(from, to) > seenValues.x && min(from, to) < seenValues.y;
}

/* Where segments are looked at together behind others some values are known. */
void PLUG_volume_chunk_begin(inout uint visible) {
    for (int k = 0; k < 3; k++)
        values[k] = values[k + 8];
    visible |= uint(is_between_seen(values[1], values[2]));
}

#if STYLED
uniform sampler2D places; /* between two values: at which part of the way lies the mean of what can be seen */
#endif

/* The end of the segment behind segment k, and whether anything can be seen of it: not if the transfer function is
 * clear at all values between its ends. */
void PLUG_volume_chunk(inout uint visible, const in int k, const in float t) {
    values[k + 3] = value_at(t);
    visible |= uint(is_between_seen(values[k + 2], values[k + 3])) << uint(k + 1);
}

#if LEAPS
/* How many steps of some length lead on through blocks where nothing can be seen; 0: the next may
 * show something. */
void PLUG_volume_leap(const in float t, const in float step_length, inout int steps) {
    if (!is_inside(t))
        return;
    vec3 corner;
    float blocks = leap_at(cell_origin + t * cell_direction, corner);
    vec3 ends = (corner - cell_origin) * cell_inverse;
    float end = min(min(ends.x, ends.y), ends.z);
    float whole = (end - t) * (1.0 / step_length) - 1.0e-3;
    steps = blocks > 0.0 ? int(clamp(whole, 0.0, float(steps))) : 0;
}
#endif

#if JOINS && !STYLED
/* Four segments are as good as one where the function is nearly linear in all their values: between the least
 * and this, by bins of the least. See plr_table_reach. */
uniform float joinReach[64];

float shifts[2]; /* of the lines of those that are joined, k / 4 */

void PLUG_volume_join(inout uint visible, inout uint joined, const in int k) {
    float from = values[k + 1], to = values[k + 5];
    vec3 inner = vec3(values[k + 2], values[k + 3], values[k + 4]);
    /* the line has the mean of all, to fourth order (Euler, Maclaurin) */
    float mean = 0.125 * (from + to) + 0.25 * (inner.x + inner.y + inner.z) -
                 (values[k] - inner.x - inner.z + values[k + 6]) / 96.0;
    float shift = 0.5 * (from + to) - mean;
    shifts[k >> 2] = shift;
    /* it may reach farther than the values do, but not beyond 0 and 1, where the function bends */
    vec2 ends = vec2(min(from, to), max(from, to));
    float low = min(min(ends.x, ends.x - shift), min(min(inner.x, inner.y), inner.z));
    float high = max(max(ends.y, ends.y - shift), max(max(inner.x, inner.y), inner.z));
    uint all = 15u << uint(k), one = 1u << uint(k);
    if ((visible & all) != 0u && low >= 0.0 && high <= joinReach[int(clamp(64.0 * low, 0.0, 63.0))]) {
        visible = (visible & ~all) | one;
        joined |= one;
    }
}
#endif

/* The values at the ends of segment k, and one step around. By halves: where a place in an array is not known, pixels
 * read and write it one by one. */
vec4 values_around(const in int k) {
    float a[7], b[5];
    vec4 c;
    bool far = (k & 4) != 0, two = (k & 2) != 0, one = (k & 1) != 0;
    for (int n = 0; n < 7; n++)
        a[n] = far ? values[n + 4] : values[n];
    for (int n = 0; n < 5; n++)
        b[n] = two ? a[n + 2] : a[n];
    for (int n = 0; n < 4; n++)
        c[n] = one ? b[n + 1] : b[n];
    return c;
}

/* What lies along segment k of those that are looked at together, and `count` - 1 more; `even`: its neighbours are
 * as long. */
void PLUG_volume_segment(inout VolumeMix mixed, const in int k, const in int count, const in float t, const in float span,
                         const in bool even, const in vec3 origin_eye, const in vec3 direction_eye) {
    vec4 around = values_around(k);
    float from = around.y, to = around.z;
#if STYLED
    float seen = t + span * texture(places, vec2(from, to) * table_place.x + table_place.y).r;
#endif
    /* the mean over the segment differs from that of its ends by a twelfth of the second difference, of which this
     * is the mean of both ends' */
    float shift = even ? (around.x - from - to + around.w) / 24.0 : 0.0;
#if HAS_WALL
    /* the line keeps on its side of what is opaque */
    float low = min(from, to), high = max(from, to);
    shift = high < wallValues.x ? max(shift, high - wallValues.x) : shift;
    shift = low > wallValues.y ? min(shift, low - wallValues.y) : shift;
#endif
    from -= shift;
    to -= shift;
#if JOINS && !STYLED
    if (count > 1) {
        float joined_shift = k < 4 ? shifts[0] : shifts[1];
        from = around.y - joined_shift;
        to = (k < 4 ? values[5] : values[9]) - joined_shift;
    }
#endif
    vec4 mean = mean_between(from, to);
#if HAS_WALL
    float way = way_to_wall(around.y, around.z);
    if (is_inside(t) && way <= 1.0) {
        vec4 color = vec4(wall_color(around.y).rgb, 1.0);
        if (is_within_wall(around.y)) {
            vec4 there = mean_between(around.y, around.y);
            color.rgb = there.rgb / there.a;
        }
#if STYLED
        style_at(color, t + way * span, span, origin_eye, direction_eye);
#endif
        volume_mix_add(mixed, color, span * depth_ratio);
        return;
    }
#endif
    if (is_inside(t) && !mixed.opaque) {
#if STYLED
        style_mean(mean, seen, span, origin_eye, direction_eye);
#endif
        mixed.sum += mean * (span * depth_ratio);
    }
}
