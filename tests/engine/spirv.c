/* What is read from SPIR-V, and that nothing is read beyond it. */
#include "engine/spirv.h"

#include "tests/tap.h"

/* An instruction: its length and opcode, its operands. */
#define WORDS(...) (sizeof((uint32_t[]){0, __VA_ARGS__}) / sizeof(uint32_t))
#define OP(code, ...) (uint32_t)(WORDS(__VA_ARGS__) << 16 | (code)), __VA_ARGS__
#define BARE(code) (1u << 16 | (code))

/* Of an id 2 "ab\0": a load into 3, a fetch from 3 into 4, in line 9. */
static const uint32_t good[] = {
    0x07230203,
    0x10000,
    0,
    5,
    0,                        /* magic, version, generator, bound, schema */
    OP(5, 2, 'a' | 'b' << 8), /* OpName */
    OP(54, 0, 1, 0, 0),       /* OpFunction */
    OP(248, 1),               /* OpLabel */
    OP(8, 1, 9, 1),           /* OpLine */
    OP(61, 0, 3, 2),          /* OpLoad */
    OP(87, 0, 4, 3, 0),       /* OpImageSampleImplicitLod */
    BARE(317),                /* OpNoLine */
    OP(95, 0, 4, 4, 0),       /* OpImageFetch from nothing known */
    BARE(253),                /* OpReturn */
    BARE(56),                 /* OpFunctionEnd */
};
enum {
    SIZE = sizeof good / sizeof *good
};

static void test_good(void) {
    uint32_t instructions, fetches;
    size_t count;
    plr_spirv_count(good, SIZE, &instructions, &fetches);
    CHECK_INT(instructions, 4);
    CHECK_INT(fetches, 2);
    plr_spirv_fetch *list = plr_spirv_fetches(good, SIZE, &count);
    CHECK_INT(count, 2);
    CHECK(list && list[0].line == 9);
    CHECK_STR(list ? list[0].name : NULL, "ab");
    CHECK(list && list[1].line == 0 && !list[1].name);
    free(list);
}

/* Words cut off anywhere, and each word in turn as something else. */
static void test_broken(void) {
    static const uint32_t other[] = {
        0, 0xffffffff, 0x7fffffff, 2u << 16 | 5, 2u << 16 | 61, 3u << 16 | 87};
    size_t count, most = 0;
    for (size_t size = 0; size <= SIZE; size++) {
        uint32_t *exact = malloc(size * sizeof *exact + 1);
        memcpy(exact, good, size * sizeof *exact);
        free(plr_spirv_fetches(exact, size, &count));
        most = count > most ? count : most;
        for (size_t i = 0; i < size; i++)
            for (size_t k = 0; k < sizeof other / sizeof *other; k++) {
                exact[i] = other[k];
                free(plr_spirv_fetches(exact, size, &count));
                most = count > most ? count : most;
                exact[i] = good[i];
            }
        free(exact);
    }
    CHECK(most >= 2 && most < SIZE);
}

int main(void) {
    test_good();
    test_broken();
    return tap_done();
}
