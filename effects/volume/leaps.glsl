/* Cells of voxels along the ray, and leaps through blocks of them. A unit of Volume.glsl's effect. */

/* Along the ray in cells: cell c lies between the centres of voxels c - 1 and c. */
vec3 cell_origin;
vec3 cell_direction;
vec3 cell_inverse;

#if LEAPS
uniform float blockCells; /* a side of a block */
uniform usampler3D leaps; /* sides of clear cubes of blocks, 4 bits for each octant of directions: plr_blocks_leaps */

float leap_blocks; /* of a cell */
vec3 leap_texel;
vec3 leap_near; /* the side of a block that rays come in by is that of block 0 or 1 */
vec3 leap_way;
uint leap_octant; /* where its bits begin */
#endif

void cells_begin(const in vec3 count) {
    cell_origin = ray_origin * count + 0.5;
    cell_direction = ray_direction * count;
    cell_inverse = 1.0 / mix(cell_direction, vec3(1.0e-30), equal(cell_direction, vec3(0.0)));
#if LEAPS
    bvec3 upwards = greaterThanEqual(cell_direction, vec3(0.0));
    leap_blocks = 1.0 / blockCells;
    leap_texel = 1.0 / vec3(textureSize(leaps, 0));
    leap_near = blockCells * mix(vec3(1.0), vec3(0.0), upwards);
    leap_way = blockCells * mix(vec3(-1.0), vec3(1.0), upwards);
    leap_octant = uint(dot(mix(vec3(4.0, 8.0, 16.0), vec3(0.0), upwards), vec3(1.0)));
#endif
}

#if LEAPS
/* How many blocks a side has the cube of blocks from that around a place on, in the direction of the ray, in which nothing
 * can be seen, and its corner, in cells, that the ray leaves it by. */
float leap_at(const in vec3 place, out vec3 corner) {
    vec3 block = floor(place * leap_blocks);
    float code = float(int(texture(leaps, (block + 0.5) * leap_texel).r >> leap_octant & 15u));
    float blocks = max(code, 8.0 * code - 70.0);
    corner = blockCells * block + (leap_near + blocks * leap_way);
    return blocks;
}
#endif
