#version 330 core
/* The base raycaster. It sets up the ray, finds how far it may go, walks it in steps and hands each
 * step to the volumes (Volume.glsl) and to the compositing effect (Composite.glsl). All distances
 * along a ray are in eye space: 0 at the eye, or at the eye's plane where the projection is parallel.
 * From an eye that is far away compared with the volumes, floats could not tell their places: there
 * rays begin at a plane before the volumes. Effects of authors see distances from the eye. */

uniform vec4 viewport; /* x, y, width, height in pixels */
uniform float rayPlane; /* how far before the eye rays begin */
#if HAS_OPAQUE
uniform sampler2D opaqueDepth;
uniform vec2 depthToClip;  /* scale and shift from the depth buffer to clip space */
uniform float emptyDepth;  /* of pixels where nothing opaque is */
#endif
#if HAS_PARTS
/* Translucent surfaces divide the ray: this is the part behind one of them and before the next. */
uniform sampler2D partStart;
uniform sampler2D partEnd;
uniform int hasPartStart;
#endif
#if HAS_CUT
uniform vec2 viewpointCut; /* near and far distance that the viewpoint asks for, as planes */
#endif
#if EARLY_END || WRITES_DEPTH
uniform float transparencyLeft; /* rays end where less than this shines through */
#endif

out vec4 plugray_FragColor;

/* PLUG-DECLARATIONS */

#if HAS_EVENTS
const int MOST_EVENTS = 4096; /* in one step */
#endif

#if SEGMENTS
const int CHUNK = 8; /* segments or cells that are looked at together; the same in segments.glsl and cells.glsl */
#if PLUG_USED(volume_join)
const int JOINED = 4; /* so many are taken together where that is as good; they begin at multiples of it */
const int BEHIND = JOINED;
#else
const int BEHIND = 3; /* where values from before are not known, segments of a chunk that do without them come last */
#endif
#endif
#if CELLS
uniform float errorAllowed; /* of the integral along a ray */
const float MOST_PARTS = 256.0; /* of a piece in one cell */

/* What a piece of the ray in one cell needs. */
struct CellNeed {
    float error;  /* of its integrals, if it is not cut */
    float depth;  /* optical depth, at most */
    float change; /* of colour: the greatest, */
    float turns;  /* and all that there are, forth and back, added up */
    float most;   /* how many parts make sense */
    vec2 part;    /* of the piece, where something can be seen */
    float opaque_at; /* where in it the first volume is opaque; beyond 1: nowhere */
};

float piece_t[CHUNK + 1];
vec4 piece_needs[CHUNK]; /* see needs_of */
vec2 piece_part[CHUNK];
#if HAS_WALL
float piece_opaque[CHUNK];
#endif

/* Errors of the integral; of colours, by all their changes, and by the greatest; how many parts make sense. */
vec4 needs_of(const in CellNeed need) {
    float hides = 0.125 * need.depth;
    return vec4(need.error, hides * need.depth * need.turns, hides * min(need.depth, 1.0) * need.change, need.most);
}

/* Into how many parts a piece is cut that may err by `share`, where so much shines through. What it needs beyond
 * comes from the purse; what it does not need goes there.
 *
 * Colours in a part of depth d, that differ by c, have the right mean over depth; where among them what hides and what
 * is hidden lie is lost: at most c (1 - exp(-d/2))^2 / 2, below c d^2 / 8, and below c A d / 8 for its opacity A. Of n
 * parts the first are at most d^2 / (8 n^2) times the changes of all, the others d / (8 n) times the greatest. */
float part_count(const in vec4 needs, const in float share, const in float through, inout float purse) {
    float error = through * needs.x, square = through * needs.y, plain = through * needs.z;
    float allowed = share + 0.125 * max(purse, 0.0), inverse = 1.0 / allowed;
    float by_turns = sqrt((error + square) * inverse);
    float by_change = 0.5 * inverse * (plain + sqrt(plain * plain + 4.0 * allowed * error));
    float most = max(needs.w, ceil(min(sqrt(square * inverse), plain * inverse)));
    float parts = clamp(min(ceil(min(by_turns, by_change)), most), 1.0, MOST_PARTS);
    float part = 1.0 / parts;
    purse += share - (error * part + min(square * part, plain)) * part;
    return parts;
}
#endif

#if SKIPS
#if LEAPS && !MIXES
const int LOOK_AHEAD = 8; /* steps; then it may be time to leap again */
#else
const int LOOK_AHEAD = 32; /* steps, one a bit */
#endif
#if MIXES
vec4 ahead_sums[LOOK_AHEAD]; /* of those that something was found in, see VolumeMix */
uint ahead_mixed;
uint ahead_opaque;
#endif

#if MIXES
/* The steps ahead lie in a few pieces of parts of the ray, see step_way. */
#if MANY_VOLUMES
const int PIECES = 8;
#else
const int PIECES = 4;
#endif
float piece_t[PIECES];
float piece_next[PIECES];
float piece_length[PIECES];
int piece_steps[PIECES];
int piece_first[PIECES]; /* of the steps ahead */
int piece_shift[PIECES]; /* from the number of a step ahead to that in its part */
#endif

#endif
#if SKIPS || SEGMENTS
int lowest_bit(uint bits) {
    return (floatBitsToInt(float(bits & (0u - bits))) >> 23) - 127;
}
#endif

#if HAS_PARTS
float part_start = -NOWHERE;
float part_end = NOWHERE; /* where it is not the end of the ray */
#endif
float eye_distance = 0.0; /* of where the ray begins */
#if PLUG_USED(volume_ray)
vec3 eye_origin = vec3(0.0); /* where it would begin at the eye */
#endif
#if EARLY_END || WRITES_DEPTH
/* Whether nothing behind can be seen any more; of a ray that picks, whether something is seen. */
bool is_ended(float alpha) {
#if PICKS
    return alpha >= 1.0 / 255.0;
#else
    return 1.0 - alpha < transparencyLeft;
#endif
}
#endif

#if WRITES_DEPTH
float written_end = -NOWHERE; /* where the ray leaves the volumes that write depth */
#endif
#if PICKS
int met_volume = -1; /* what the ray has met last */
int met_surface = -1;
float met_depth;
vec2 picked;
#endif
#if WRITES_DEPTH || PICKS
float ended_at = NOWHERE;

/* Notes where the ray ends. */
void note_end(float alpha, float t) {
    if (ended_at < NOWHERE || !is_ended(alpha))
        return;
    ended_at = t;
#if PICKS
    picked = vec2(met_volume, met_surface);
#endif
}
#endif

#if HAS_OPAQUE
ivec2 depth_texel() {
#if PICKS
    return ivec2(gl_FragCoord.xy); /* of a picture there is this pixel alone */
#else
    return ivec2(gl_FragCoord.xy - viewport.xy);
#endif
}

/* Distance along the ray of what a depth buffer holds. */
float depth_distance(float depth, vec3 direction_eye) {
    if (depth == emptyDepth)
        return NOWHERE;
    float ndc = depth * depthToClip.x + depthToClip.y;
    mat4 p = castle_ProjectionMatrix;
    float z = p[2][3] != 0.0 ? -p[3][2] / (ndc + p[2][2]) : (ndc - p[3][2]) / p[2][2];
    return (z + rayPlane) / direction_eye.z;
}
#endif

#if WRITES_DEPTH
/* What a depth buffer holds of a place of the ray, before what stands there already. */
float distance_depth(float t, vec3 direction_eye, float before) {
    mat4 p = castle_ProjectionMatrix;
    float z = t * direction_eye.z - rayPlane;
    float ndc = (p[2][2] * z + p[3][2]) / (p[2][3] * z + p[3][3]);
    float depth = clamp((ndc - depthToClip.y) / depthToClip.x, 0.0, 1.0);
    return emptyDepth == 0.0 ? max(depth, before) : min(depth, before);
}
#endif

#if !HAS_EVENTS
/* Where a step of a part of the ray begins, and how long it is. */
vec2 step_way(int i, int steps, float t, float t_next, float step_length) {
    float from = t + float(i) * step_length;
#if HAS_PARTS
    /* steps stay where they are along the whole ray; those at its ends are shortened */
    from = max(from, part_start);
    return vec2(from, max((i == steps - 1 ? t_next : t + float(i + 1) * step_length) - from, 0.0));
#else
    /* the last step is shortened: lengths add up to the part */
    return vec2(from, i == steps - 1 ? t_next - from : step_length);
#endif
}
#endif

#if MIXES && SKIPS
/* The same of step k of those ahead. */
vec2 ahead_way(int k) {
    float t = piece_t[0], t_next = piece_next[0], step_length = piece_length[0];
    int steps = piece_steps[0], shift = piece_shift[0];
    for (int piece = 1; piece < PIECES; piece++)
        if (k >= piece_first[piece]) {
            t = piece_t[piece];
            t_next = piece_next[piece];
            step_length = piece_length[piece];
            steps = piece_steps[piece];
            shift = piece_shift[piece];
        }
    return step_way(k + shift, steps, t, t_next, step_length);
}
#endif

void main() {
    /* the ray through the pixel's centre, from the eye or, in parallel projection, from its plane */
    vec2 ndc = (gl_FragCoord.xy - viewport.xy) / viewport.zw * 2.0 - 1.0;
    mat4 p = castle_ProjectionMatrix;
    vec2 scale = vec2(p[0][0], p[1][1]);
    vec3 origin_eye = vec3(0.0), direction_eye = vec3(0.0, 0.0, -1.0);
    if (p[2][3] != 0.0)
        direction_eye = normalize(vec3((ndc + p[2].xy) / scale, -1.0));
    else
        origin_eye.xy = (ndc - p[3].xy) / scale;
#if PLUG_USED(volume_ray)
    eye_origin = origin_eye;
#endif
    eye_distance = rayPlane / -direction_eye.z;
    origin_eye += eye_distance * direction_eye;

    float start = -eye_distance;
    float limit = NOWHERE;
#if HAS_CUT
    start = (viewpointCut.x - rayPlane) / -direction_eye.z;
    limit = (viewpointCut.y - rayPlane) / -direction_eye.z;
#endif
#if HAS_OPAQUE
    float opaque = texelFetch(opaqueDepth, depth_texel(), 0).r;
    limit = min(limit, depth_distance(opaque, direction_eye));
#endif
#if HAS_PARTS
    float part_depth = texelFetch(partEnd, depth_texel(), 0).r;
    if (part_depth != opaque)
        part_end = depth_distance(part_depth, direction_eye);
    if (hasPartStart != 0) {
        float start_depth = texelFetch(partStart, depth_texel(), 0).r;
        if (start_depth == part_depth)
            discard; /* no surface here */
        part_start = depth_distance(start_depth, direction_eye);
    }
#endif
    /* PLUG: volume_begin (origin_eye, direction_eye, start, limit) */

    vec4 accumulated = vec4(0.0);
#if PLUG_USED(volume_ray_end)
    float depth = NOWHERE;
#endif
    float t = NOWHERE;
#if SEGMENTS
    /* From one entry or exit to the next the ray is cut into segments; between their ends volumes know
     * what lies there. */
    bool ended = false;
#if CELLS
    float purse = 0.5 * errorAllowed;
#endif
#if MIXES
    /* PLUG: volume_first (t) */
    while (t < NOWHERE && !ended) {
#endif
        float t_next = NOWHERE;
        float step_length = NOWHERE;
        /* PLUG: volume_part (t, t_next, step_length) */
#if MIXES
        if (t_next >= NOWHERE)
            break;
#endif
#if CELLS
        /* Of the error that the ray may have, a part is for each length alike; the rest is a purse for
         * places that need more. */
        float rate = 0.5 * errorAllowed / max(t_next - t, 1.0e-30);
        float from = t, spent_until = t;
        while (from < t_next && !ended) {
#if LEAPS
            bool leapt = true;
            while (leapt && from < t_next) {
                float leap = t_next;
                /* PLUG: volume_cells_leap (from, leap) */
                leapt = leap > from;
                from = max(from, leap);
            }
#endif
            /* Most cells cannot be seen. That is found out first for some, at the least cost; then what those
             * need that can; then the parts of all are worked through in one loop: neighbouring rays wait for
             * each other once, not cell by cell. */
            uint visible = 0u;
            /* PLUG: volume_cells_begin (from) */
            for (int k = 0; k < CHUNK; k++) {
                float to = t_next;
                /* PLUG: volume_cell (from, to) */
                /* PLUG: volume_cell_look (visible, k, from, to) */
                piece_t[k] = from;
                from = to;
            }
            piece_t[CHUNK] = from;
            uint seen = 0u;
            while (visible != 0u) {
                int k = lowest_bit(visible);
                visible &= visible - 1u;
                CellNeed need = CellNeed(0.0, 0.0, 0.0, 0.0, 1.0, vec2(0.0, 1.0), 2.0);
                float t_cell = piece_t[k], t_end = piece_t[k + 1];
                /* PLUG: volume_cell_fit (k, t_cell, t_end, need) */
#if HAS_WALL
                need.part.y = max(min(need.part.y, need.opaque_at), need.part.x);
                piece_opaque[k] = need.opaque_at;
#endif
                piece_needs[k] = needs_of(need);
                piece_part[k] = need.part;
                if (need.depth > 0.0 || need.opaque_at <= 1.0)
                    seen |= 1u << uint(k);
            }
            int k = 0;
            float part = 0.0, parts = 0.0, t_piece = from, piece_length = 0.0;
            vec3 way; /* where parts begin: the first, from one to the next; where the last ends */
            while (true) {
                if (part >= parts) {
                    if (seen == 0u)
                        break;
                    k = lowest_bit(seen);
                    seen &= seen - 1u;
                    part = 0.0;
                    t_piece = piece_t[k];
                    float t_end = piece_t[k + 1];
                    piece_length = t_end - t_piece;
                    /* what is clear has had its share, too */
                    parts = part_count(piece_needs[k], rate * (t_end - spent_until), 1.0 - accumulated.a, purse);
                    spent_until = t_end;
                    vec2 range = piece_part[k];
                    way = vec3(range.x, (range.y - range.x) / parts, range.y);
                }
                float u = way.x + part * way.y, u_end = min(way.x + (part + 1.0) * way.y, way.z);
                part += 1.0;
                float span = piece_length * way.y;
                float begin = t_piece + u * piece_length;
                VolumeMix mixed = VolumeMix(vec4(0.0), false);
                /* PLUG: volume_cell_part (mixed, k, t_piece, u, u_end, span) */
                VolumeSample s;
                vec4 color = volume_mix_color(mixed);
#if READS(position_eye)
                s.position_eye = origin_eye + (begin + 0.5 * span) * direction_eye;
#endif
#if READS(step_length)
                s.step_length = span;
#endif
#if READS(volume)
                s.volume = -1;
#endif
                /* PLUG: volume_composite (accumulated, color, s) */
#if PLUG_USED(volume_ray_end)
                if (depth >= NOWHERE && accumulated.a > 0.0)
                    depth = begin + 0.5 * span;
#endif
#if WRITES_DEPTH
                note_end(accumulated.a, begin + span);
#endif
#if HAS_WALL
                float opaque_at = piece_opaque[k];
                if (part >= parts && opaque_at <= 1.0) {
                    float met = t_piece + opaque_at * piece_length;
                    vec4 wall = vec4(0.0);
                    /* PLUG: volume_cell_wall (wall, k, t_piece, opaque_at) */
                    color = vec4(wall.rgb / max(wall.a, 1.0), min(wall.a, 1.0));
#if READS(position_eye)
                    s.position_eye = origin_eye + met * direction_eye;
#endif
#if READS(step_length)
                    s.step_length = 0.0;
#endif
#if READS(volume)
                    s.volume = -1;
#endif
                    /* PLUG: volume_composite (accumulated, color, s) */
#if PLUG_USED(volume_ray_end)
                    if (depth >= NOWHERE)
                        depth = met;
#endif
#if WRITES_DEPTH
                    note_end(accumulated.a, met);
#endif
                }
#endif
#if EARLY_END
                if (is_ended(accumulated.a)) {
                    ended = true;
                    break;
                }
#endif
            }
        }
#else
#if MIXES
        int steps = step_length < NOWHERE ? max(step_count(t_next - t, step_length), 1) : 1;
#else
        int steps = step_count(t_next - t, step_length);
#endif
        int i = 0, behind = BEHIND;
        while (i < steps && !ended) {
#if LEAPS
            while (i < steps) {
                float at = t + float(i) * step_length;
                int leap = steps - i;
                /* PLUG: volume_leap (at, step_length, leap) */
#if PLUG_USED(volume_join)
                leap = i + leap < steps ? leap & -JOINED : leap;
#endif
                if (leap == 0)
                    break;
                behind = BEHIND;
                i += leap;
            }
            if (i >= steps)
                break;
#endif
            /* most segments cannot be seen: that is found out first for some, at the least cost */
            int first = i - behind;
            uint visible = 0u;
            /* PLUG: volume_chunk_begin (visible) */
            /* in two halves: a longer loop would not be unrolled, and places in arrays not be known */
            for (int k = 0; k < CHUNK / 2; k++) {
                float at = first + k + 2 < steps ? t + float(first + k + 2) * step_length : t_next;
                /* PLUG: volume_chunk (visible, k, at) */
            }
            for (int k = CHUNK / 2; k < CHUNK; k++) {
                float at = first + k + 2 < steps ? t + float(first + k + 2) * step_length : t_next;
                /* PLUG: volume_chunk (visible, k, at) */
            }
            visible &= (1u << uint(min(steps - first, CHUNK))) - (1u << uint(behind));
            i = first + CHUNK;
            behind = 0;
#if PLUG_USED(volume_join)
            uint joined = 0u; /* begin here, and are as good as one */
            for (int k = 0; k < CHUNK; k += JOINED)
                if (first + k > 0 && first + k + JOINED + 1 < steps) { /* they and their neighbours are as long */
                    /* PLUG: volume_join (visible, joined, k) */
                }
#endif
            while (visible != 0u) {
                int k = lowest_bit(visible);
                visible &= visible - 1u;
                int n = first + k;
#if PLUG_USED(volume_join)
                int count = (joined >> uint(k) & 1u) != 0u ? JOINED : 1;
#else
                const int count = 1;
#endif
                float begin = t + float(n) * step_length;
                float end = n + count < steps ? t + float(n + count) * step_length : t_next;
                VolumeMix mixed = VolumeMix(vec4(0.0), false);
                float span = end - begin;
                bool even = n > 0 && n + 2 < steps; /* its neighbours are as long */
                /* PLUG: volume_segment (mixed, k, count, begin, span, even, origin_eye, direction_eye) */
                VolumeSample s;
                vec4 color = volume_mix_color(mixed);
#if READS(position_eye)
                s.position_eye = origin_eye + (begin + 0.5 * span) * direction_eye;
#endif
#if READS(step_length)
                s.step_length = span;
#endif
#if READS(volume)
                s.volume = -1;
#endif
                /* PLUG: volume_composite (accumulated, color, s) */
#if PLUG_USED(volume_ray_end)
                if (depth >= NOWHERE && accumulated.a > 0.0)
                    depth = begin + 0.5 * span;
#endif
#if WRITES_DEPTH
                note_end(accumulated.a, end);
#endif
#if EARLY_END
                if (is_ended(accumulated.a)) {
                    ended = true;
                    break;
                }
#endif
            }
        }
#endif
#if MIXES
        t = t_next;
    }
#endif
#elif MIXES && SKIPS
    /* Most samples of most volumes cannot be seen. The way is planned for some steps ahead; each volume
     * finds out at the least cost where it can be seen, and mixes itself into those steps alone. */
    bool ended = false;
    int i = 0, steps = 0;
    /* PLUG: volume_first (t) */
    float t_next = t;
    float step_length = NOWHERE;
    while (t < NOWHERE && !ended) {
        int count = 0;
        for (int piece = 0; piece < PIECES; piece++) {
            if (i == steps && t < NOWHERE) { /* from one entry or exit to the next: steps never straddle one */
                t = t_next;
                t_next = NOWHERE;
                step_length = NOWHERE;
                /* PLUG: volume_part (t, t_next, step_length) */
                steps = step_length < NOWHERE ? max(step_count(t_next - t, step_length), 1) : 1;
                i = 0;
                if (t_next >= NOWHERE)
                    t = NOWHERE;
            }
            piece_t[piece] = t;
            piece_next[piece] = t_next;
            piece_length[piece] = step_length;
            piece_steps[piece] = steps;
            piece_first[piece] = count;
            piece_shift[piece] = i - count;
            int taken = t < NOWHERE ? min(steps - i, LOOK_AHEAD - count) : 0;
            /* PLUG: volume_plan (count, taken, t) */
            count += taken;
            i += taken;
        }
        ahead_mixed = 0u;
        ahead_opaque = 0u;
        /* PLUG: volume_mix_ahead (origin_eye, direction_eye) */
        while (ahead_mixed != 0u) {
            int k = lowest_bit(ahead_mixed);
            ahead_mixed &= ahead_mixed - 1u;
            vec2 way = ahead_way(k);
            float t_middle = way.x + 0.5 * way.y;
            VolumeSample s;
            vec4 color = volume_mix_color(VolumeMix(ahead_sums[k], (ahead_opaque >> uint(k) & 1u) != 0u));
#if READS(position_eye)
            s.position_eye = origin_eye + t_middle * direction_eye;
#endif
#if READS(step_length)
            s.step_length = way.y;
#endif
#if READS(volume)
            s.volume = -1;
#endif
            /* PLUG: volume_composite (accumulated, color, s) */
#if PLUG_USED(volume_ray_end)
            if (depth >= NOWHERE && accumulated.a > 0.0)
                depth = t_middle;
#endif
#if WRITES_DEPTH
            note_end(accumulated.a, t_middle);
#endif
            if (is_ended(accumulated.a)) {
                ended = true;
                break;
            }
        }
    }
#else
#if MIXES
    bool ended = false;
    /* PLUG: volume_first (t) */
    /* Between two neighbouring entries and exits the set of volumes does not change: steps never
     * straddle one, and what does not overlap along this ray is met in order along this ray. */
    while (t < NOWHERE && !ended) { /* t grows from one entry or exit to the next */
#endif
        float t_next = NOWHERE;
        float step_length = NOWHERE;
        /* PLUG: volume_part (t, t_next, step_length) */
#if MIXES
        if (t_next >= NOWHERE)
            break;
        int steps = step_length < NOWHERE ? step_count(t_next - t, step_length) : 0;
#if HAS_EVENTS
        steps = max(steps, 1);
#endif
#else
        int steps = step_count(t_next - t, step_length);
#endif
#if SKIPS
        /* Most samples of most volumes cannot be seen. That is found out first for some steps ahead, at
         * the least cost; then what can be seen is drawn, in the same places. */
        int ahead = 0;
        while (ahead < steps) {
#if LEAPS
            while (ahead < steps) {
                float at = t + (float(ahead) + 0.5) * step_length;
                int leap = steps - ahead;
                /* PLUG: volume_leap (at, step_length, leap) */
                if (leap == 0)
                    break;
                ahead += leap;
            }
#endif
            int first = ahead;
            uint visible = 0u;
            for (; ahead < steps && ahead < first + LOOK_AHEAD; ahead++) {
                vec2 way = step_way(ahead, steps, t, t_next, step_length);
                int bit = ahead - first;
                float t_middle = way.x + 0.5 * way.y;
                /* PLUG: volume_look_ahead (visible, bit, t_middle) */
            }
            while (visible != 0u) {
                int i = first + lowest_bit(visible);
                visible &= visible - 1u;
#else
        for (int i = 0; i < steps; i++) {
#endif
#if HAS_EVENTS
            float from = t + float(i) * step_length;
            float to = i == steps - 1 ? t_next : t + float(i + 1) * step_length;
            /* PLUG: volume_look (from, to, origin_eye, direction_eye) */
            /* a surface splits the step: what is before it, the surface itself, what is behind */
            for (int part = 0; part < MOST_EVENTS; part++) {
                float event = NOWHERE;
                /* PLUG: volume_event (event) */
                float span = min(event, to) - from;
#else
            vec2 way = step_way(i, steps, t, t_next, step_length);
            float from = way.x;
            float span = way.y;
#endif
            float t_middle = from + 0.5 * span;
            VolumeSample s;
            vec4 color;
#if HAS_STEPS
#if MIXES
#if HAS_EVENTS
            if (span > 0.0) {
#endif
            VolumeMix mixed = VolumeMix(vec4(0.0), false);
#if PICKS
            met_depth = -1.0;
#endif
            /* PLUG: volume_mix (mixed, t_middle, span, origin_eye, direction_eye) */
            color = volume_mix_color(mixed);
#if READS(position_eye)
            s.position_eye = origin_eye + t_middle * direction_eye;
#endif
#if READS(step_length)
            s.step_length = span;
#endif
#if READS(volume)
            s.volume = -1;
#endif
#else
            /* PLUG: volume_step (color, s, t_middle, span, origin_eye, direction_eye) */
#endif
            /* PLUG: volume_composite (accumulated, color, s) */
#if PLUG_USED(volume_ray_end)
            if (depth >= NOWHERE && accumulated.a > 0.0)
                depth = t_middle;
#endif
#if WRITES_DEPTH || PICKS
            note_end(accumulated.a, t_middle);
#endif
#if MIXES && HAS_EVENTS
            }
#endif
#endif
#if HAS_EVENTS
                if (event > to)
                    break;
                bool met = false;
                /* PLUG: volume_meet (met, color, s, event, origin_eye, direction_eye) */
                if (!met)
                    break;
                /* PLUG: volume_composite (accumulated, color, s) */
#if PLUG_USED(volume_ray_end)
                if (depth >= NOWHERE && accumulated.a > 0.0)
                    depth = event;
#endif
#if WRITES_DEPTH || PICKS
                note_end(accumulated.a, event);
#endif
                from = max(from, event);
#if EARLY_END
                if (is_ended(accumulated.a))
                    break;
#endif
            }
#endif
#if EARLY_END
            if (is_ended(accumulated.a)) {
#if SKIPS
                ahead = steps;
#endif
                break;
            }
#endif
        }
#if SKIPS
        }
#endif
#if MIXES
#if EARLY_END
        ended = is_ended(accumulated.a);
#endif
        t = t_next;
    }
#endif
#endif
#if PLUG_USED(volume_ray_end)
    if (depth < NOWHERE)
        depth += eye_distance;
#endif
    /* PLUG: volume_ray_end (accumulated, depth) */
#if PICKS
    plugray_FragColor = ended_at < NOWHERE ? vec4(ended_at + eye_distance, picked, 1.0) : vec4(0.0);
#else
    plugray_FragColor = accumulated;
#endif
#if WRITES_DEPTH
    if (accumulated == vec4(0.0))
        discard; /* no trace: what other bricks have written stays */
    gl_FragDepth = opaque;
    if (accumulated.a > 0.0 && written_end >= 0.0)
        gl_FragDepth = distance_depth(min(ended_at, written_end), direction_eye, opaque);
#endif
}
