/* Faults: each is said at its place, leaves out its effect, and nothing else. */
#include "helper.h"

#define BASE                                                                                       \
    "out vec4 c;\nvoid main()\n{\n  c = vec4(1.0);\n  /* PLUG: change (c) */\n"                    \
    "  /* PLUG: two (c, 1.0) (c, 1.0, 2.0) */\n}\n"
#define GOOD "void PLUG_change(inout vec4 x) { x *= 0.5; }\n"

/* An effect between two good ones is faulty, and said to be so. */
static void check_fault(const char *text, const char *place, const char *code) {
    begin();
    base(BASE);
    effect(GOOD);
    effect(text);
    effect(GOOD);
    const linked *r = link_valid();
    CHECK_SAID(place, code);
    CHECK(plr_program_is_faulty(r->program, 1));
    CHECK(!plr_program_is_faulty(r->program, 0) && !plr_program_is_faulty(r->program, 2));
    CHECK_HAS(r->fragment, "  plr0_change(c);\n  plr2_change(c);\n");
    CHECK_LACKS(r->fragment, "plr1");
}

static void test_errors(void) {
    static const char *const rows[][3] = {
        {"\nfloat PLUG_change(inout vec4 x) { return 1.0; }\n", "b.frag:2:7: error",
         "plug-not-void"},
        {" PLUG_change(inout vec4 x) { x.r = 1.0; }\n", "b.frag:1:2: error", "plug-not-void"},
        {"PLUG_change(inout vec4 x) { return 1.0; }\nvec4 PLUG_change(vec4 x) { return x; }\n",
         "b.frag:2:6: error", "plug-not-void"},
        {"  void PLUG_change(inout vec4 x, float y) { }\n", "b.frag:1:8: error", "plug-arity"},
        {"void PLUG_two(inout vec4 x) { }\n", "b.frag:1:6: error", "plug-arity"},
        {"void PLUG_change(inout vec4 x)\n{\n  if (x.r > 0.0) {\n}\n", "b.frag:1:6: error",
         "unterminated"},
        {GOOD "float helper()\n{\n", "b.frag:2:7: error", "unterminated"},
        {GOOD "/* never closed\n", "b.frag:2:1: error", "unterminated"},
        {GOOD "float f(\n", "b.frag:2:7: error", "unterminated"},
        {GOOD "#if 1\n#ifdef A\n#endif\n", "b.frag:2:1: error", "preprocessor"},
        {GOOD " #endif\n", "b.frag:2:2: error", "preprocessor"},
        {GOOD "#if 1\n#else\n#elif 1\n#endif\n", "b.frag:4:1: error", "preprocessor"},
        {GOOD "float plr3_noise() { return 1.0; }\n", "b.frag:2:7: error", "reserved-name"},
        {"void PLUG_change(inout vec4 x) { float plr0u_a; }\n", "b.frag:1:40: error",
         "reserved-name"},
        {GOOD "float gl_Mine() { return 1.0; }\n", "b.frag:2:7: error", "reserved-name"},
        {GOOD "uniform float gl_Own;\n", "b.frag:2:15: error", "reserved-name"},
        {GOOD "#define gl_Macro 1\n", "b.frag:2:9: error", "reserved-name"},
        {GOOD "float plugray_own() { return 1.0; }\n", "b.frag:2:7: error", "reserved-name"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        check_fault(rows[i][0], rows[i][1], rows[i][2]);
}

static void test_arity_message(void) {
    begin();
    base(BASE);
    effect("void PLUG_two(inout vec4 x) { }\n");
    link_valid();
    CHECK(said_text("has 1 parameter, but the plug passes 2 or 3"));
    CHECK_SAID("base.frag:6:3: note", "plug-arity");
}

/* Only where no place fits is the number an error. */
static void test_arity_somewhere(void) {
    begin();
    base("out vec4 c;\nvoid main() {\n  c = vec4(1.0);\n  /* PLUG: change (c) */\n"
         "  /* PLUG: change (c, 1.0) */\n}\n");
    effect("void PLUG_change(inout vec4 x, float y) { x *= y; }\n");
    const linked *r = link_valid();
    CHECK_INT(occurrences(r->fragment, "plr0_change(c"), 1);
    CHECK_SILENT();
}

static void test_warnings(void) {
    begin();
    base(BASE);
    base_vertex(
        "void main() { vec4 v = vec4(1.0); /* PLUG: vertex_eye (v) */ gl_Position = v; }\n");
    static const plr_known_plug known[] = {{"light_scale", PLR_FRAGMENT},
                                           {"vertex_object", PLR_VERTEX}};
    description()->known_plugs = known;
    description()->known_plug_count = 2;
    effect("void PLUG_chnage(inout vec4 x) { }\nvoid PLUG_light_scal(inout float x) { }\n"
           "void PLUG_light_scale(inout float x) { }\nvoid PLUG_vertex_eye(vec4 x) { }\n"
           "void PLUG_vertex_object(vec4 x) { }\nvoid PLUG_nowhere_near() { }\n" GOOD);
    const linked *r = link_valid();
    CHECK_SAID("a.frag:1:6: warning", "unknown-plug");
    CHECK(said_text("did you mean \"change\""));
    CHECK_SAID("a.frag:2:6: warning", "unknown-plug");
    CHECK(said_text("did you mean \"light_scale\""));
    CHECK_SAID("a.frag:4:6: warning", "wrong-stage");
    CHECK(said_text("exists in the vertex stage"));
    CHECK_SAID("a.frag:5:6: warning", "wrong-stage");
    CHECK_SAID("a.frag:6:6: warning", "unknown-plug");
    CHECK_INT(plr_diags_count(r->diags), 5);
    CHECK(!plr_program_is_faulty(r->program, 0));
    CHECK_HAS(r->fragment, "plr0_change(c);");
}

static void test_comment_warnings(void) {
    begin();
    base(BASE);
    effect("#define MACRO /* PLUG: in_macro (c) */ 1.0\n/* PLUG: outside (c) */\n"
           "void PLUG_change(inout vec4 x) {\n  /* PLUG: this is prose */\n  /* PLUG: open (x */\n"
           "  x *= max(1.0, /* PLUG: inside (x) */ 2.0);\n  /* PLUG */ /* PLUGGED: a (b) */\n"
           "  /* PLUG-PROMISE: colour-only */\n}\n");
    const linked *r = link_valid();
    CHECK_SAID("a.frag:1:15: warning", "plug-in-macro");
    CHECK_SAID("a.frag:2:1: warning", "plug-syntax");
    CHECK_SAID("a.frag:4:3: warning", "plug-syntax");
    CHECK_SAID("a.frag:5:3: warning", "plug-syntax");
    CHECK_SAID("a.frag:6:17: warning", "plug-syntax");
    CHECK_INT(plr_diags_count(r->diags), 5);
    CHECK_LACKS(r->fragment, "PLUG");
}

static void test_lacks(void) {
    begin();
    base(BASE);
    effect("float PLUG_change(inout vec4 x) { /* PLUG: inner (x) */ return 1.0; }\n")->name = "Sea";
    effect("void PLUG_inner(inout vec4 x) { x *= 0.5; }\n" GOOD)->name = "Wave";
    const linked *r = link_valid();
    CHECK_SAID("b.frag:1:6: note", "lacks");
    CHECK(said_text("effect \"Wave\" lacks the plug \"inner\", that effect \"Sea\" would have"));
    CHECK_INT(plr_diags_count_of(r->diags, PLR_ERROR), 1);
    CHECK_HAS(r->fragment, "plr1_change(c);");
}

static void test_base_fault(void) {
    static const char *const rows[] = {"void main() {\n", "void main() { }\n/* open", "#if 1\n"};
    for (size_t i = 0; i < 3; i++) {
        begin();
        base(rows[i]);
        effect(GOOD);
        const linked *r = link_all();
        CHECK(!r->program);
        CHECK_INT(plr_diags_count_of(r->diags, PLR_ERROR), 1);
    }
}

static void test_disabled(void) {
    begin();
    base(BASE);
    effect("float PLUG_change(inout vec4 x) { return 1.0; }\n")->disabled = true;
    effect(GOOD);
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "plr1_change(c);");
    CHECK_SILENT();
}

static void test_attached_forward(void) {
    begin();
    base(BASE);
    effect(GOOD)->attached = 2;
    effect(GOOD);
    const linked *r = link_valid();
    CHECK(plr_program_is_faulty(r->program, 0));
    CHECK_INT(plr_diags_count_of(r->diags, PLR_ERROR), 1);
}

static void test_attached_deep(void) {
    begin();
    base(BASE);
    for (size_t i = 0; i < PLR_MOST_ATTACHED + 2; i++)
        effect(GOOD)->attached = i;
    const linked *r = link_valid();
    CHECK(!plr_program_is_faulty(r->program, PLR_MOST_ATTACHED));
    CHECK(plr_program_is_faulty(r->program, PLR_MOST_ATTACHED + 1));
    CHECK_INT(plr_diags_count_of(r->diags, PLR_ERROR), 1);
}

/* A fault in one stage leaves out the effect in all. */
static void test_all_stages(void) {
    begin();
    base(BASE);
    base_vertex("void main() { vec4 v = vec4(1.0); /* PLUG: place (v) */ gl_Position = v; }\n");
    effect(GOOD);
    vertex_unit("int PLUG_place(inout vec4 v) { return 1; }\n");
    const linked *r = link_valid();
    CHECK_SAID("a.vert:1:5: error", "plug-not-void");
    CHECK_LACKS(r->fragment, "plr0");
}

/* Text that is not recognised is kept, in its place. */
static void test_kept_text(void) {
    begin();
    base(BASE);
    effect("precision highp float;\nDECLARE(a) what is this 12 + ;\nOTHER(b)\n" GOOD);
    const linked *r = link_all();
    CHECK_HAS(r->fragment, "precision highp float;");
    CHECK_HAS(r->fragment, "what is this 12 + ;");
    CHECK_HAS(r->fragment, "OTHER(b)");
    CHECK_HAS(r->fragment, "plr0_change(c);");
    CHECK(!plr_program_is_faulty(r->program, 0));
}

/* A byte-order mark takes no column; only the text's own first line has one. */
static void test_byte_order_mark(void) {
    begin();
    base("out vec4 c;\nvoid main() {\n  c = vec4(1.0);\n  /* PLUG: change (c) */\n}\n");
    effect("\xEF\xBB\xBFint PLUG_change(inout vec4 x) { return 1; }\n");
    effect("\xEF\xBB\xBF\nint PLUG_change(inout vec4 x) { return 1; }\n");
    link_valid();
    CHECK_SAID("a.frag:1:5: error", "plug-not-void");
    CHECK_SAID("b.frag:2:5: error", "plug-not-void");
}

int main(void) {
    test_errors();
    test_arity_message();
    test_arity_somewhere();
    test_warnings();
    test_comment_warnings();
    test_lacks();
    test_base_fault();
    test_disabled();
    test_attached_forward();
    test_attached_deep();
    test_all_stages();
    test_kept_text();
    test_byte_order_mark();
    return finish();
}
