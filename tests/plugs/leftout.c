/* What is left out, and what is said of it: targets, what faulty effects would have given. */
#include "helper.h"

#define BASE                                                                                       \
    "out vec4 result;\nvoid main()\n{\n  vec4 c = vec4(1.0);\n  /* PLUG: change (c) */\n"          \
    "  /* PLUG: finish (c) */\n  result = c;\n}\n"
#define CHANGE "void PLUG_change(inout vec4 x) { x.r *= 0.5; }\n"

static const char *const known[] = {"Fog", "LocalFog", "Material"};

static void builtin(const char *name, const char *text) {
    plr_effect *e = effect(text);
    e->builtin = true;
    e->name = name;
}

static plr_effect *placed(plr_placement placement, const char *target, bool only_if_active) {
    plr_effect *e = effect(CHANGE);
    e->placement = placement;
    e->target = target;
    e->only_if_active = only_if_active;
    e->place = (plr_place){"scene", 3, 5};
    description()->known_targets = known;
    description()->known_target_count = sizeof known / sizeof known[0];
    return e;
}

/* An effect of that name is there, but called or not. */
static void test_only_if_active(void) {
    static const struct {
        const char *target_text;
        bool called;
    } rows[] = {
        {"void PLUG_change(inout vec4 x) { x.g = 0.0; }\n", true},
        {"void PLUG_light(inout vec4 x) { x.g = 0.0; }\n", false},
        {"float helper() { return 1.0; }\n", false},
        {"void PLUG_finish(inout vec4 x) { x.g = 0.0; }\n", true},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        for (int later = 0; later < 2; later++) {
            begin();
            base(BASE);
            if (!later)
                builtin("Fog", rows[i].target_text);
            placed(PLR_ADD_BEFORE, "Fog", true);
            if (later)
                builtin("Fog", rows[i].target_text);
            const linked *r = link_valid();
            CHECK_INT(occurrences(r->fragment, later ? "plr0_change(c)" : "plr1_change(c)"),
                      rows[i].called);
            CHECK_INT(said_text("did you mean"), 0);
        }
}

/* The plug of an effect that is not called calls nothing. */
static void test_called_by_nobody(void) {
    for (int lit = 0; lit < 2; lit++) {
        begin();
        base(BASE);
        builtin("Lit", lit ? "void PLUG_change(inout vec4 x) { /* PLUG: add_light (x) */ }\n"
                           : "void PLUG_other(inout vec4 x) { /* PLUG: add_light (x) */ }\n");
        builtin("Lamp", "void PLUG_add_light(inout vec4 x) { x.b = 0.0; }\n");
        placed(PLR_ADD_AFTER, "Lamp", true);
        const linked *r = link_valid();
        CHECK_INT(occurrences(r->fragment, "plr2_change(c)"), lit);
    }
}

/* An effect that takes away its own target finds it active, and does not come and go. */
static void test_removing_oneself(void) {
    begin();
    base(BASE);
    builtin("Fog", "void PLUG_change(inout vec4 x) { x.g = 0.0; }\n");
    placed(PLR_REPLACE, "Fog", true);
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "  plr1_change(c);");
    CHECK_LACKS(r->fragment, "plr0_change(c);");
}

/* What was asked for by an effect that is left out is asked no more. */
static void test_questions_of_left_out(void) {
    begin();
    base("out vec4 result;\nvoid main() {\n  vec4 c = vec4(1.0);\n#if PLUG_USED(extra)\n"
         "  c.a = 0.25;\n#endif\n  /* PLUG: extra (c) */\n  result = c;\n}\n");
    plr_effect *e = placed(PLR_ADD_AFTER, "Fog", true);
    (void)e;
    unit("void PLUG_extra(inout vec4 x) { x.r = 0.0; }\n");
    builtin("Fog", "void PLUG_nowhere(inout vec4 x) { x.g = 0.0; }\n");
    const linked *r = link_valid();
    CHECK_LACKS(r->fragment, "0.25");
}

static void test_unknown_target(void) {
    begin();
    base(BASE);
    builtin("Material", CHANGE);
    placed(PLR_ADD_AFTER, "Matreial", false);
    placed(PLR_ADD_AFTER, "Zebra", true);
    placed(PLR_ADD_AFTER, "LocalFog", false);
    link_valid();
    CHECK_SAID("scene:3:5: warning", "unknown-target");
    CHECK(said_text("there is no effect \"Matreial\"; did you mean \"Material\""));
    CHECK(said_text("there is no effect \"Zebra\""));
    CHECK_INT(plr_diags_count(link_result()->diags), 2);
}

/* Who builds on a faulty effect lacks its plugs, and its names: a note, and no second error. */
static void test_lacking_names(void) {
    static const char *const faulty[] = {
        "float helper(float a) { return a; }\nint PLUG_change(inout vec4 x) {\n"
        "  /* PLUG: mine (x) */\n  return 1; }\n",
        "#define helper(a) (a)\nvoid PLUG_change(inout vec4 x) {\n  /* PLUG: mine (x) */\n",
        "#if 1\nfloat helper(float a) { return a; }\n#endif\n"
        "int PLUG_change(inout vec4 x) {\n  /* PLUG: mine (x) */\n  return 1; }\n",
    };
    for (size_t i = 0; i < sizeof faulty / sizeof faulty[0]; i++) {
        begin();
        base(BASE);
        effect(faulty[i]);
        effect("void PLUG_mine(inout vec4 x) { x.r = 0.0; }\n"
               "void PLUG_change(inout vec4 x) { x.g = helper(x.r); }\n")
            ->name = "Second";
        effect("void PLUG_finish(inout vec4 x) { x.b = 0.0; }\n");
        const linked *r = link_valid();
        CHECK_SAID("b.frag:2:40: note", "lacks");
        CHECK(said_text("lacks \"helper\", that effect 1 would have offered"));
        CHECK(plr_program_is_faulty(r->program, 1));
        CHECK_LACKS(r->fragment, "plr1_");
        CHECK_HAS(r->fragment, "plr2_finish(c);");
    }
    /* one that needs nothing but the plug is drawn without it */
    begin();
    base(BASE);
    effect(faulty[0]);
    effect("void PLUG_mine(inout vec4 x) { x.r = 0.0; }\n" CHANGE);
    const linked *r = link_valid();
    CHECK(!plr_program_is_faulty(r->program, 1));
    CHECK_HAS(r->fragment, "plr1_change(c);");
    CHECK_SAID("b.frag:1:6: note", "lacks");
}

/* A chain of effects, each building on the one before. */
static void test_lacking_chain(void) {
    begin();
    base(BASE);
    effect("int PLUG_change(inout vec4 x) { /* PLUG: p0 (x) */ return 1; }\nfloat h0() { return "
           "1.0; }\n");
    for (int i = 1; i < 40; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "void PLUG_p%d(inout vec4 x) { /* PLUG: p%d (x) */ }\n"
                 "float h%d() { return h%d(); }\nvoid PLUG_finish(inout vec4 x) { x.r = h%d(); }\n",
                 i - 1, i, i, i - 1, i);
        effect(text);
    }
    const linked *r = link_valid();
    CHECK_LACKS(r->fragment, "plr");
    for (size_t i = 0; i < 40; i++)
        CHECK(plr_program_is_faulty(r->program, i));
}

int main(void) {
    test_only_if_active();
    test_called_by_nobody();
    test_removing_oneself();
    test_questions_of_left_out();
    test_unknown_target();
    test_lacking_names();
    test_lacking_chain();
    return finish();
}
