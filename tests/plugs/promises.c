/* What authors promise of their plug functions: which comments count, and what they say. */
#include "helper.h"

#define BASE                                                                                       \
    "uniform vec4 color;\nout vec4 result;\nvoid main()\n{\n  vec4 c = color;\n"                   \
    "  /* PLUG: change (c) */\n  result = c;\n}\n"
#define CHANGE "void PLUG_change(inout vec4 x) { x.r *= 0.5; }\n"

/* Links one effect of one unit: what it promises. */
static plr_promises promises_of(const char *text) {
    begin();
    base(BASE);
    effect(text);
    return plr_program_promises(link_valid()->program, 0);
}

static bool are(plr_promises p, bool colour_only, bool keeps_transparent, double lipschitz) {
    return p.colour_only == colour_only && p.keeps_transparent == keeps_transparent &&
           fabs(p.lipschitz - lipschitz) <= 1e-12 * lipschitz;
}

#define CHECK_PROMISES(text, colour_only, keeps_transparent, lipschitz)                            \
    CHECK(are(promises_of(text), colour_only, keeps_transparent, lipschitz))

static void test_words(void) {
    static const struct {
        const char *comment;
        bool colour_only, keeps_transparent;
        double lipschitz;
    } rows[] = {
        {"", false, false, 0},
        {"/* PLUG-PROMISE: colour-only */", true, true, 0},
        {"/* PLUG-PROMISE: color-only */", true, true, 0},
        {"/* PLUG-PROMISE: keeps-transparent */", false, true, 0},
        {"/* PLUG-PROMISE: lipschitz 12.5 */", false, false, 12.5},
        {"/* PLUG-PROMISE: colour-only keeps-transparent lipschitz 12.5 */", true, true, 12.5},
        {"/*PLUG-PROMISE:lipschitz 3*/", false, false, 3},
        {"/*\tPLUG-PROMISE :\r\n lipschitz\n .5\n*/", false, false, 0.5},
        {"/* PLUG-PROMISE: lipschitz 1.5e-2 */", false, false, 0.015},
        {"/* PLUG-PROMISE: lipschitz 2E+3 */", false, false, 2000},
        {"/* PLUG-PROMISE: lips\\\nchitz 1\\\n2 */", false, false, 12},
        {"/* PLUG-PROMISE: colour-only colour-only color-only */", true, true, 0},
        {"/* PLUG-PROMISE: lipschitz 2 lipschitz 5 lipschitz 3 */", false, false, 5},
        {"/* PLUG-PROMISE: colour-only */ /* PLUG-PROMISE: lipschitz 2 */", true, true, 2},
        {"/* see PLUG-PROMISE: colour-only */", false, false, 0},
        {"/* PLUG-DECLARATIONS */ /* PLUG-PROMISE: colour-only */", true, true, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, "%s\n%s", rows[i].comment, CHANGE);
        plr_promises p = promises_of(text);
        CHECK(are(p, rows[i].colour_only, rows[i].keeps_transparent, rows[i].lipschitz));
        CHECK_SILENT();
        CHECK_LACKS(link_result()->fragment, "PROMISE");
    }
}

/* It may stand anywhere: it is no token that could tear others apart. */
static void test_places(void) {
    CHECK_PROMISES(CHANGE "/* PLUG-PROMISE: colour-only */", true, true, 0);
    CHECK_PROMISES("void PLUG_change(inout vec4 /* PLUG-PROMISE: colour-only */ x) { x *= 0.5; }",
                   true, true, 0);
    CHECK_PROMISES("void PLUG_change(inout vec4 x) { x *= 0.5; /* PLUG-PROMISE: lipschitz 1 */ }",
                   false, false, 1);
    CHECK_SILENT();
}

static void test_conditionals(void) {
    CHECK_PROMISES("#if 0\n/* PLUG-PROMISE: colour-only */\n#endif\n" CHANGE, false, false, 0);
    CHECK_SILENT();
    CHECK_PROMISES("#if 1\n/* PLUG-PROMISE: colour-only */\n#endif\n" CHANGE, true, true, 0);
    CHECK_SILENT();
    CHECK_PROMISES("#if 0\n#else\n/* PLUG-PROMISE: colour-only */\n#endif\n" CHANGE, true, true, 0);
    CHECK_PROMISES("#if 1\n#else\n/* PLUG-PROMISE: colour-only */\n#endif\n" CHANGE, false, false,
                   0);
    CHECK_PROMISES("#if 0\n#if 1\n/* PLUG-PROMISE: colour-only */\n#endif\n"
                   "/* PLUG-PROMISE: colour-only */\n#elif 1\n/* PLUG-PROMISE: lipschitz 3 */\n"
                   "#else\n/* PLUG-PROMISE: lipschitz 4 */\n#endif\n" CHANGE,
                   false, false, 3);
    CHECK_PROMISES("#if 0\n#endif\n/* PLUG-PROMISE: lipschitz 1 */\n#if 0\n#endif\n" CHANGE, false,
                   false, 1);
    CHECK_PROMISES("#define SOFT 1\n#if SOFT\n/* PLUG-PROMISE: lipschitz 7 */\n#endif\n" CHANGE,
                   false, false, 7);
    CHECK_SILENT();
    /* faults of words in inactive text are none */
    CHECK_PROMISES("#if 0\n/* PLUG-PROMISE: nonsense */\n#endif\n" CHANGE, false, false, 0);
    CHECK_SILENT();
    /* of what cannot be evaluated all branches are kept, and none of them is sure */
    begin();
    base(BASE);
    effect("#if UNKNOWN(1)\n/* PLUG-PROMISE: colour-only */\n#endif\n" CHANGE);
    CHECK(are(plr_program_promises(link_all()->program, 0), false, false, 0));
    CHECK_SAID("a.frag:2:1: warning", "promise");
}

static void test_faults(void) {
    static const struct {
        const char *comment, *place, *text;
        plr_promises left;
    } rows[] = {
        {"/* PLUG-PROMISE: color-onyl */",
         "a.frag:1:18: warning",
         "did you mean \"color-only\"",
         {0}},
        {"/* PLUG-PROMISE:\n  keep-transparent lipschitz 2 */",
         "a.frag:2:3: warning",
         "did you mean \"keeps-transparent\"",
         {false, false, 2}},
        {"/* PLUG-PROMISE: nothing colour-only */",
         "a.frag:1:18: warning",
         "\"nothing\"",
         {true, true, 0}},
        {"/* PLUG-PROMISE: Colour-only */", "a.frag:1:18: warning", "did you mean", {0}},
        {"/* PLUG-PROMISE: lipschitz */", "a.frag:1:18: warning", "needs a finite number", {0}},
        {"/* PLUG-PROMISE: lipschitz colour-only */",
         "a.frag:1:18: warning",
         "needs a finite number",
         {true, true, 0}},
        {"/* PLUG-PROMISE: lipschitz 0 */", "a.frag:1:28: warning", "needs a finite number", {0}},
        {"/* PLUG-PROMISE: lipschitz -1 colour-only */",
         "a.frag:1:28: warning",
         "needs a finite number",
         {true, true, 0}},
        {"/* PLUG-PROMISE: lipschitz 1e999 */",
         "a.frag:1:28: warning",
         "needs a finite number",
         {0}},
        {"/* PLUG-PROMISE: lipschitz 1e */", "a.frag:1:28: warning", "needs a finite number", {0}},
        {"/* PLUG-PROMISE: lipschitz 2x */", "a.frag:1:28: warning", "needs a finite number", {0}},
        {"/* PLUG-PROMISE: lipschitz 1.2.3 */",
         "a.frag:1:28: warning",
         "needs a finite number",
         {0}},
        {"/* PLUG-PROMISE: lipschitz . */", "a.frag:1:28: warning", "needs a finite number", {0}},
        {"/* PLUG-PROMISE: lipschitz nan */", "a.frag:1:18: warning", "needs a finite number", {0}},
        {"/* PLUG-PROMISE: */", "a.frag:1:18: warning", "promises nothing", {0}},
        {"/* PLUG-PROMISE colour-only */", "a.frag:1:1: warning", "behind a colon", {0}},
        {"/* PLUG-PROMISES: colour-only */", "a.frag:1:1: warning", "behind a colon", {0}},
        {"  // PLUG-PROMISE: colour-only", "a.frag:1:3: warning", "of the other kind", {0}},
        {"#define X 1 /* PLUG-PROMISE: colour-only */",
         "a.frag:1:13: warning",
         "preprocessor line",
         {0}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, "%s\n%s", rows[i].comment, CHANGE);
        plr_promises p = promises_of(text);
        CHECK(are(p, rows[i].left.colour_only, rows[i].left.keeps_transparent,
                  rows[i].left.lipschitz));
        CHECK_SAID(rows[i].place, "promise");
        CHECK(said_text(rows[i].text));
        CHECK(plr_program_is_active(link_result()->program, 0)); /* warnings leave nothing out */
    }
    /* a word that is too long for anything */
    char text[4096] = "/* PLUG-PROMISE: lipschitz 1";
    memset(text + strlen(text), '0', 3000);
    strcat(text, " */\n" CHANGE);
    CHECK_PROMISES(text, false, false, 0);
    CHECK_SAID("a.frag:1:28: warning", "promise");
}

/* All units of an effect that have plug functions must promise; helpers need not. */
static void test_units(void) {
    begin();
    base(BASE);
    effect("/* PLUG-PROMISE: colour-only lipschitz 2 */\n" CHANGE);
    unit("/* PLUG-PROMISE: keeps-transparent lipschitz 5 */\n" CHANGE);
    unit("float helper() { return 1.0; }\n");
    effect("/* PLUG-PROMISE: colour-only lipschitz 2 */\n" CHANGE);
    unit(CHANGE);
    effect("/* PLUG-PROMISE: lipschitz 9 */\n" CHANGE);
    const linked *r = link_valid();
    CHECK(are(plr_program_promises(r->program, 0), false, true, 5));
    CHECK(are(plr_program_promises(r->program, 1), false, false, 0));
    CHECK(are(plr_program_promises(r->program, 2), false, false, 9));
    CHECK(are(plr_program_promises(r->program, 3), false, false, 0)); /* there is none */
    CHECK_SILENT();
}

static void test_wrong_units(void) {
    begin();
    base("/* PLUG-PROMISE: colour-only */\n" BASE);
    base_vertex("/* PLUG: place (gl_Position) */\nvoid main() {\n  gl_Position = vec4(1.0);\n"
                "  /* PLUG: place (gl_Position) */\n}\n");
    effect(CHANGE);
    unit("/* PLUG-PROMISE: colour-only */\nfloat helper() { return 1.0; }\n");
    vertex_unit(
        "\n  /* PLUG-PROMISE: colour-only */\nvoid PLUG_place(inout vec4 p) { p.x = 0.0; }\n");
    const linked *r = link_valid();
    CHECK(are(plr_program_promises(r->program, 0), false, false, 0));
    CHECK_SAID("base.frag:1:1: warning", "promise");
    CHECK(said_text("a base shader promises nothing"));
    CHECK(said_text("has no plug function"));
    CHECK(said_text("those of fragment units"));
}

/* An effect that is left out promises nothing. */
static void test_left_out(void) {
    begin();
    base(BASE);
    effect("/* PLUG-PROMISE: colour-only */\nint PLUG_change(inout vec4 x) { return 1; }\n");
    effect("/* PLUG-PROMISE: colour-only */\n" CHANGE)->disabled = true;
    const linked *r = link_all();
    CHECK(are(plr_program_promises(r->program, 0), false, false, 0));
    CHECK(are(plr_program_promises(r->program, 1), false, false, 0));
}

static void test_place(void) {
    begin();
    base(BASE);
    effect("/* PLUG-PROMISE: lipschitz 1 */\n  /* PLUG-PROMISE: keeps-transparent lipschitz 2 */\n"
           " /* PLUG-PROMISE: colour-only */\n" CHANGE);
    effect(CHANGE);
    const linked *r = link_valid();
    static const uint32_t lines[] = {
        [PLR_COLOUR_ONLY] = 3, [PLR_KEEPS_TRANSPARENT] = 2, [PLR_LIPSCHITZ] = 2};
    for (int kind = 0; kind < PLR_PROMISE_KINDS; kind++) {
        plr_place place = {0};
        CHECK(plr_program_promise_place(r->program, 0, 0, (plr_promise_kind)kind, &place));
        CHECK_INT(place.line, lines[kind]);
        CHECK_INT(place.column, kind == PLR_COLOUR_ONLY ? 2 : 3);
        CHECK(!plr_program_promise_place(r->program, 0, 1, (plr_promise_kind)kind, &place));
        CHECK(!plr_program_promise_place(r->program, 0, 2, (plr_promise_kind)kind, &place));
        CHECK(!plr_program_promise_place(r->program, 1, 0, (plr_promise_kind)kind, &place));
    }
}

int main(void) {
    test_words();
    test_places();
    test_conditionals();
    test_faults();
    test_units();
    test_wrong_units();
    test_left_out();
    test_place();
    return finish();
}
