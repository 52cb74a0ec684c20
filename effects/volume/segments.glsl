/* A volume of one component that a transfer function alone makes visible: the ray is cut into segments,
 * along which the value runs evenly from one end to the other; a table has what lies between any two
 * values (engine/volume_table.c). A unit of Volume.glsl's effect.
 *
 * Pre-integration: Max, Hanrahan, Crawfis 1990; Engel, Kraus, Ertl 2001. The table has means, not
 * products with a length, so that segments may be of any length. */

uniform sampler2D integrals; /* mean of colour * extinction, and of extinction, per reference length */
uniform vec2 seenValues;     /* outside of this open interval values are clear */
uniform usampler3D leaps;    /* blocks from here to the next in which anything can be seen */

const float BLOCK_CELLS = 4.0; /* the same in C: PLR_BLOCK_CELLS */

/* Along the ray in cells: cell c lies between the centres of voxels c - 1 and c. */
vec3 cell_origin;
vec3 cell_direction;
vec3 cell_inverse;
vec3 table_place; /* from values to texture coordinates of the table: scale, shift, and nothing */
float depth_ratio; /* from lengths of the ray to reference lengths */
float values[9];   /* at the ends of the segments that are looked at together: CHUNK and one more */

float value_at(const in float t) {
    return voxel_scalar(voxel_at(ray_origin + t * ray_direction));
}

void ray_begins(const in vec3 origin_eye, const in vec3 direction_eye) {
    vec3 count = voxel_count();
    cell_origin = ray_origin * count + 0.5;
    cell_direction = ray_direction * count;
    float nodes = float(textureSize(integrals, 0).x);
    table_place = vec3((nodes - 1.0) / nodes, 0.5 / nodes, 0.0);
    depth_ratio = ray_speed / referenceLength;
    cell_inverse = 1.0 / mix(cell_direction, vec3(1.0e-30), equal(cell_direction, vec3(0.0)));
}

bool is_inside(const in float t) {
#if MIXES
    return enter <= t && t < leave;
#else
    return true;
#endif
}

/* Segments that are looked at together begin here. */
void PLUG_volume_chunk_begin(const in float t) {
    values[0] = value_at(t);
}

/* Whether anything can be seen of segment k of those, which ends here: not if the transfer function is
 * clear at all values between its ends. */
void PLUG_volume_chunk(inout uint visible, const in int k, const in float t) {
    float value = value_at(t);
    values[k + 1] = value;
    if (max(value, values[k]) > seenValues.x && min(value, values[k]) < seenValues.y)
        visible |= 1u << uint(k);
}

#if LEAPS
/* How many steps of some length lead on through blocks where nothing can be seen; 0: the next may
 * show something. */
void PLUG_volume_leap(const in float t, const in float step_length, inout int steps) {
    if (!is_inside(t))
        return;
    vec3 block = floor((cell_origin + t * cell_direction) / BLOCK_CELLS);
    ivec3 texel = clamp(ivec3(block), ivec3(0), textureSize(leaps, 0) - 1);
    float blocks = float(texelFetch(leaps, texel, 0).r);
    /* the farthest corner of the cube of blocks where there is nothing */
    vec3 corner = block + mix(vec3(1.0 - blocks), vec3(blocks), greaterThanEqual(cell_direction, vec3(0.0)));
    vec3 ends = (corner * BLOCK_CELLS - cell_origin) * cell_inverse;
    float end = min(min(ends.x, ends.y), ends.z);
    int whole = int(min((end - t) / step_length - 1.0e-3, 1.0e6));
    steps = min(steps, blocks > 0.0 ? max(whole, 0) : 0);
}
#endif

/* What lies along segment k of those that are looked at together. */
void PLUG_volume_segment(inout VolumeMix mixed, const in int k, const in float t, const in float span) {
    vec4 mean = texture(integrals, vec2(values[k], values[k + 1]) * table_place.x + table_place.y);
    mixed.sum += is_inside(t) ? mean * (span * depth_ratio) : vec4(0.0);
}
