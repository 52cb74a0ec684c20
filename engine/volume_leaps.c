#include "engine/volume_leaps.h"

#include <math.h>

enum {
    RAYS = 128
};

/* Below, leaps cost ever less in steps. */
#define LEAST_STEP 0.125

/* How the shader walks (effects/volume/raycaster.frag.glsl): steps are looked at together, of which
 * some behind a leap serve those that follow alone; leaps go over so many times some steps; a look
 * into the table costs as much as so many steps; cells are of one length in the mean. From what
 * gain on leaps pay was measured, of single voxels at random and of spheres. */
typedef struct gait {
    int together, behind, multiple;
    double look, length, least_gain;
} gait;

static const gait gaits[] = {[PLR_METHOD_MIDPOINT] = {8, 0, 1, 2, 0, 1.1},
                             [PLR_METHOD_PREINTEGRATED] = {8, 4, 4, 2, 0, 1.25},
                             [PLR_METHOD_CELLS] = {8, 0, 1, 2, 2.0 / 3, 1.05}};

/* In cells, as plr_blocks has them; `end`: how long it is. */
typedef struct ray {
    double origin[3], direction[3], end;
} ray;

static double next(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Through any place in any direction. */
static ray make_ray(const plr_blocks *blocks, uint64_t *state) {
    ray r;
    double z = 2 * next(state) - 1, turn = 6.283185307179586 * next(state);
    const double direction[3] = {sqrt(1 - z * z) * cos(turn), sqrt(1 - z * z) * sin(turn), z};
    double before = -INFINITY, after = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double side = (double)blocks->size[axis] * blocks->cells, way = direction[axis];
        way = fabs(way) > 1e-9 ? way : 1e-9;
        r.direction[axis] = way;
        r.origin[axis] = side * next(state);
        double to_low = -r.origin[axis] / way, to_high = (side - r.origin[axis]) / way;
        before = fmax(before, fmin(to_low, to_high));
        after = fmin(after, fmax(to_low, to_high));
    }
    for (int axis = 0; axis < 3; axis++)
        r.origin[axis] += before * r.direction[axis];
    r.end = after - before;
    return r;
}

/* How many cells it is from a place of a ray to the end of the clear cube ahead; 0: there is none.
 */
static double leap_from(const plr_blocks *blocks, const uint32_t *leaps, const ray *r, double t) {
    size_t index = 0, stride = 1;
    uint32_t octant = 0;
    double block[3], end = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double place = (r->origin[axis] + t * r->direction[axis]) / blocks->cells;
        block[axis] = fmin(fmax(floor(place), 0), blocks->size[axis] - 1.0);
        index += stride * (size_t)block[axis];
        stride *= blocks->size[axis];
        octant |= r->direction[axis] < 0 ? 1u << axis : 0;
    }
    double side = plr_blocks_side(leaps[index], octant);
    for (int axis = 0; axis < 3; axis++) {
        double corner = block[axis] + (r->direction[axis] < 0 ? 1 - side : side);
        end = fmin(end, (corner * blocks->cells - r->origin[axis]) / r->direction[axis]);
    }
    return side > 0 ? fmax(end - t, 0) : 0;
}

static double walk(const plr_blocks *blocks, const uint32_t *leaps, const ray *r, const gait *g,
                   double step) {
    double steps = ceil(r->end / step), cost = 0;
    int behind = g->behind;
    for (double i = 0; i < steps; i += g->together - behind, behind = 0) {
        double leap = 1;
        while (i < steps && leap > 0) {
            leap = floor(leap_from(blocks, leaps, r, i * step) / (step * g->multiple));
            leap *= g->multiple;
            behind = leap > 0 ? g->behind : behind;
            cost += g->look;
            i += leap;
        }
        cost += i < steps ? g->together : 0;
    }
    return cost;
}

double plr_leaps_gain(const plr_blocks *blocks, const uint32_t *leaps, plr_method method,
                      double step) {
    const gait *g = &gaits[method];
    double with = 0, without = 0;
    uint64_t state = 1;
    step = g->length > 0 ? g->length : fmax(step, LEAST_STEP);
    for (int i = 0; i < RAYS; i++) {
        ray r = make_ray(blocks, &state);
        with += walk(blocks, leaps, &r, g, step);
        without += g->together * ceil((r.end / step + g->behind) / g->together);
    }
    return without / with;
}

double plr_leaps_least_gain(plr_method method) {
    return gaits[method].least_gain;
}
