/* Cells of voxels along the ray, and leaps through blocks of them. A unit of Volume.glsl's effect. */

/* Along the ray in cells: cell c lies between the centres of voxels c - 1 and c. */
vec3 cell_origin;
vec3 cell_direction;
vec3 cell_inverse;

void cells_begin(const in vec3 count) {
    cell_origin = ray_origin * count + 0.5;
    cell_direction = ray_direction * count;
    cell_inverse = 1.0 / mix(cell_direction, vec3(1.0e-30), equal(cell_direction, vec3(0.0)));
}

#if LEAPS
uniform float blockCells; /* a side of a block */
uniform usampler3D leaps; /* blocks from here to the next in which anything can be seen */

/* How many blocks it is to the next in which anything can be seen, and the corner, in cells, of the cube of
 * blocks around a place where nothing can, that a ray leaves by. */
float leap_at(const in vec3 place, out vec3 corner) {
    vec3 block = floor(place / blockCells);
    ivec3 texel = clamp(ivec3(block), ivec3(0), textureSize(leaps, 0) - 1);
    float blocks = float(texture(leaps, (vec3(texel) + 0.5) / vec3(textureSize(leaps, 0))).r);
    corner = blockCells *
             (block + mix(vec3(1.0 - blocks), vec3(blocks), greaterThanEqual(cell_direction, vec3(0.0))));
    return blocks;
}
#endif
