/* The calls of a program in their order. */
#include "helper.h"

/* "stage plug effect@line" for each call, indented by depth. */
static void check_chain(const char *expected) {
    const linked *r = link_valid();
    plr_call_info calls[64];
    char text[4096] = "";
    size_t count = plr_program_calls(r->program, calls, 64);
    CHECK_INT(plr_program_calls(r->program, NULL, 0), (long)count);
    for (size_t i = 0; i < count && i < 64; i++) {
        const plr_plug_info *plug = plr_program_plug(r->program, calls[i].plug);
        size_t length = strlen(text);
        snprintf(text + length, sizeof text - length, "%*s%c %s %d@%u\n", (int)calls[i].depth, "",
                 plr_stage_text(plug->stage)[0], plug->name, (int)calls[i].effect,
                 (unsigned)calls[i].function.line);
    }
    CHECK_STR(text, expected);
}

#define BASE                                                                                       \
    "out vec4 c;\nvec4 lit(vec4 x) {\n  /* PLUG: light (x) */\n  return x;\n}\n"                   \
    "void unused() {\n  /* PLUG: never (c) */\n}\n#define LATER later()\n"                         \
    "void later() {\n  /* PLUG: late (c) */\n}\nvoid main() {\n  c = vec4(1.0);\n"                 \
    "  /* PLUG: first (c) */\n  c = lit(c) + lit(c);\n  /* PLUG: second (c) */\n  LATER;\n}\n"

static void test_order(void) {
    begin();
    base(BASE);
    base_vertex(
        "in vec4 p;\nvoid main() {\n  gl_Position = p;\n  /* PLUG: move (gl_Position) */\n}\n");
    effect("void PLUG_second(inout vec4 x) { x.r = 0.0; }\n"
           "void PLUG_first(inout vec4 x) { x.g = 0.0; }\n");
    vertex_unit("\n\nvoid PLUG_move(inout vec4 p) { p.x = 0.0; }\n");
    effect("void PLUG_light(inout vec4 x) {\n  /* PLUG: inner (x) */\n  x.b = 0.0;\n}\n"
           "void PLUG_never(inout vec4 x) { }\n")
        ->builtin = true;
    effect("void PLUG_inner(inout vec4 x) { x.a = 0.0; }\n"
           "void PLUG_inner(inout vec4 x) { x.a = 1.0; }\n"
           "void PLUG_late(inout vec4 x) { PLUG_other(x); }\nvoid PLUG_other(inout vec4 x) {\n"
           "  /* PLUG: own (x) */\n}\n");
    unit("void PLUG_own(inout vec4 x) { x.rgb *= 0.5; }\n");
    check_chain("v move 0@3\nf first 0@2\nf light 1@1\n f inner 2@1\n f inner 2@2\nf second 0@1\n"
                "f late 2@3\n f own 2@1\n");
}

/* Placement counts, and what is removed is not called. */
static void test_placement(void) {
    begin();
    base("out vec4 c;\nvoid main() {\n  c = vec4(1.0);\n  /* PLUG: first (c) */\n}\n");
    plr_effect *e = effect("void PLUG_first(inout vec4 x) { x.r = 0.0; }\n");
    e->builtin = true;
    e->name = "One";
    e = effect("void PLUG_first(inout vec4 x) { x.g = 0.0; }\n");
    e->builtin = true;
    e->name = "Two";
    e = effect("void PLUG_first(inout vec4 x) { x.b = 0.0; }\n");
    e->placement = PLR_ADD_BEFORE;
    e->target = "Two";
    e = effect(NULL);
    e->placement = PLR_REMOVE;
    e->target = "One";
    check_chain("f first 2@1\nf first 1@1\n");
}

/* The text of many functions that call each other is followed once. */
static void test_large(void) {
    static char text[200000];
    size_t length = 0;
    for (int i = 0; i < 2000; i++)
        length +=
            (size_t)snprintf(text + length, sizeof text - length,
                             "float f%d(float x) { return f%d(x) + f%d(x); }\n", i, i + 1, i + 1);
    snprintf(
        text + length, sizeof text - length,
        "float f2000(float x) { return x; }\nvoid PLUG_first(inout vec4 x) { x.r = f0(x.r); }\n");
    begin();
    base("out vec4 c;\nvoid main() {\n  c = vec4(1.0);\n  /* PLUG: first (c) */\n}\n");
    effect(text);
    const linked *r = link_all();
    CHECK_INT(plr_program_calls(r->program, NULL, 0), 1);
}

int main(void) {
    test_order();
    test_placement();
    test_large();
    return finish();
}
