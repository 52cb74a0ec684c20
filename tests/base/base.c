#include "tests/tap.h"

#include <plugray/base.h>
#include "base/arena.h"

static void test_origin(void) {
    plr_origin plain = {"a.glsl", 0, 0, NULL, 0};
    plr_place place = plr_origin_place(&plain, "ab\ncd", 4);
    CHECK_INT(place.line, 2);
    CHECK_INT(place.column, 2);
    plr_break breaks[] = {{2, 7, 30}};
    plr_origin broken = {"a.x3d", 7, 20, breaks, 1};
    CHECK_INT(plr_origin_place(&broken, "a<b\nc", 1).column, 21);
    CHECK_INT(plr_origin_place(&broken, "a<b\nc", 2).column, 30);
    CHECK_INT(plr_origin_place(&broken, "a<b\nc", 4).line, 8);
    CHECK_INT(plr_origin_place(&broken, "a<b\nc", 4).column, 1);
}

static void test_diags(void) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_place place = {"f", 1, 2};
    plr_diags_add(diags, PLR_CODE_UNKNOWN_PLUG, place, "no plug '%s'", "x");
    plr_diags_note(diags, place, "nearest is '%s'", "y");
    plr_diags_add(diags, PLR_CODE_UNKNOWN_PLUG, place, "no plug '%s'", "x");
    plr_diags_note(diags, place, "nearest is '%s'", "y");
    CHECK_INT(plr_diags_count(diags), 2);
    CHECK_INT(plr_diags_count_of(diags, PLR_WARNING), 1);
    CHECK_STR(plr_diags_get(diags, 0)->message, "no plug 'x'");
    CHECK_INT(plr_diags_get(diags, 1)->severity, PLR_NOTE);
    CHECK_STR(plr_code_text(plr_diags_get(diags, 0)->code), "unknown-plug");
    plr_diags_destroy(&diags);
    CHECK(diags == NULL);
}

static void test_arena(void) {
    plr_arena arena;
    jmp_buf out_of_memory;
    plr_arena_init(&arena, NULL, &out_of_memory);
    volatile int jumped = 0;
    if (setjmp(out_of_memory) == 0)
        plr_arena_array(&arena, SIZE_MAX / 2, 4);
    else
        jumped = 1;
    CHECK(jumped);
    struct {
        int *items;
        size_t count, capacity;
    } list = {0};
    for (int i = 0; i < 1000; i++)
        *PLR_PUSH(&arena, &list) = i;
    CHECK_INT(list.items[999], 999);
    CHECK_STR(plr_arena_format(&arena, "%d-%s", 5, "x"), "5-x");
    plr_arena_finish(&arena);
}

int main(void) {
    test_origin();
    test_diags();
    test_arena();
    return tap_done();
}
