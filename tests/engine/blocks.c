/* Leaps through blocks: in each octant of directions as far as all is clear, and no farther; and
 * what they gain. */
#include "tests/tap.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "engine/volume_blocks.h"
#include "engine/volume_leaps.h"

enum {
    MOST = 4096
};

typedef struct blocks {
    plr_blocks shape;
    bool full[MOST];
    uint32_t leaps[MOST];
} blocks;

static size_t index_of(const blocks *b, const int at[3]) {
    return (size_t)at[0] +
           b->shape.size[0] * ((size_t)at[1] + (size_t)b->shape.size[1] * (size_t)at[2]);
}

static bool is_full(const blocks *b, const int at[3]) {
    for (int axis = 0; axis < 3; axis++)
        if (at[axis] < 0 || at[axis] >= (int)b->shape.size[axis])
            return false;
    return b->full[index_of(b, at)];
}

/* Whether all is clear in the cube of so many blocks a side whose corner is `at`. */
static bool is_clear(const blocks *b, const int at[3], int octant, int side) {
    int limits[3];
    for (int axis = 0; axis < 3; axis++) /* beyond there is nothing */
        limits[axis] = side < (int)b->shape.size[axis] ? side : (int)b->shape.size[axis];
    for (int z = 0; z < limits[2]; z++)
        for (int y = 0; y < limits[1]; y++)
            for (int x = 0; x < limits[0]; x++) {
                const int place[3] = {at[0] + (octant & 1 ? -x : x), at[1] + (octant & 2 ? -y : y),
                                      at[2] + (octant & 4 ? -z : z)};
                if (is_full(b, place))
                    return false;
            }
    return true;
}

/* What codes stand for; the one behind the last leads on for ever. */
static const int sides[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 18, 26, 34, 42, 50};

/* How many codes of all blocks and octants lead into what is full, or less far than they could. */
static size_t count_wrong(const blocks *b) {
    size_t wrong = 0;
    for (int z = 0; z < (int)b->shape.size[2]; z++)
        for (int y = 0; y < (int)b->shape.size[1]; y++)
            for (int x = 0; x < (int)b->shape.size[0]; x++)
                for (int octant = 0; octant < 8; octant++) {
                    const int at[3] = {x, y, z};
                    uint32_t code = b->leaps[index_of(b, at)] >> 4 * octant & 15;
                    wrong += plr_blocks_side(b->leaps[index_of(b, at)], (uint32_t)octant) !=
                             (uint32_t)sides[code];
                    wrong += !is_clear(b, at, octant, sides[code]) ||
                             (code < 15 && is_clear(b, at, octant, sides[code + 1]));
                }
    return wrong;
}

static void check(const char *name, uint32_t x, uint32_t y, uint32_t z, unsigned one_of) {
    static blocks b;
    b.shape = (plr_blocks){.size = {x, y, z}};
    uint64_t state = x + 64 * y + 4096 * z + one_of;
    for (size_t i = 0; i < plr_blocks_count(&b.shape); i++) {
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        b.full[i] = one_of && (state >> 33) % one_of == 0;
    }
    bool made = plr_blocks_leaps(&b.shape, b.full, b.leaps);
    size_t wrong = made ? count_wrong(&b) : 1;
    TAP_RESULT(made && wrong == 0, "%s", name);
    if (wrong)
        printf("#   %zu wrong\n", wrong);
}

/* What is gained where the first part of the layers along x is clear. */
static double find_gain(unsigned clear, plr_method method, double step) {
    enum {
        SIDE = 16
    };
    static blocks b;
    b.shape = (plr_blocks){.cells = 2, .size = {SIDE, SIDE, SIDE}};
    for (size_t i = 0; i < plr_blocks_count(&b.shape); i++)
        b.full[i] = i % SIDE >= clear;
    return plr_blocks_leaps(&b.shape, b.full, b.leaps)
               ? plr_leaps_gain(&b.shape, b.leaps, method, step)
               : -1;
}

/* A look costs 2 steps, of which 8 are taken together. */
static void check_gains(plr_method method) {
    CHECK_NEAR(find_gain(0, method, 0.5), 0.8, 1e-9);
    CHECK(find_gain(16, method, 0.25) > 8);
    double some = find_gain(4, method, 0.25), half = find_gain(8, method, 0.25);
    CHECK(some > 0.8 && some < 1.2);
    CHECK(half > 1.1 * some && half < 2);
    CHECK(plr_leaps_least_gain(method) >= 1 && plr_leaps_least_gain(method) < 1.5);
}

int main(void) {
    check("one block, clear", 1, 1, 1, 0);
    check("one block, full", 1, 1, 1, 1);
    check("a line along x", 60, 1, 1, 23);
    check("a line along y", 1, 60, 1, 23);
    check("a line along z", 1, 1, 60, 23);
    check("a line without anything", 1, 300, 1, 0);
    check("many full", 9, 7, 8, 5);
    check("few full", 15, 13, 14, 300);
    check("flat", 20, 1, 19, 60);
    check_gains(PLR_METHOD_MIDPOINT);
    check_gains(PLR_METHOD_PREINTEGRATED);
    check_gains(PLR_METHOD_CELLS);
    return tap_done();
}
