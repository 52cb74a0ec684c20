/* Conditionals, versions, extensions. */
#include "helper.h"

#define BASE "out vec4 c;\nvoid main()\n{\n  c = vec4(1.0);\n  /* PLUG: change (c) */\n}\n"
#define CHANGE "void PLUG_change(inout vec4 x) { x *= 0.5; }\n"

/* The branch of an effect that a condition takes: the text has "yes" or "no", or both. */
static void check_condition(int row, const char *condition, bool yes, bool no) {
    char text[512];
    snprintf(text, sizeof text,
             "%s\nvoid PLUG_change(inout vec4 x) { x.r = 1.25; }\n#else\n"
             "void PLUG_change(inout vec4 x) { x.g = 2.25; }\n#endif\n",
             condition);
    begin();
    static const plr_define defines[] = {{"ONE", NULL}, {"TWO", "2"}, {"SUM", "ONE + TWO"}};
    description()->defines = defines;
    description()->define_count = 3;
    base(BASE);
    effect(text);
    const linked *r = link_all();
    TAP_RESULT((strstr(r->fragment, "1.25") != NULL) == yes, "row %d: first branch", row);
    TAP_RESULT((strstr(r->fragment, "2.25") != NULL) == no, "row %d: second branch", row);
    if (!yes || !no)
        CHECK_LACKS(r->fragment + 10, "#");
}

static void test_expressions(void) {
    static const struct {
        const char *condition;
        bool yes, no;
    } rows[] = {
        {"#if 0", false, true},
        {"#if 1", true, false},
        {"#ifdef ONE", true, false},
        {"#ifdef THREE", false, true},
        {"#ifndef THREE", true, false},
        {"#if defined(ONE) && !defined THREE", true, false},
        {"#if TWO * 3 == 6 && (TWO - 1) <= 1", true, false},
        {"#if SUM * 2 == 5", true, false}, /* text, not value: ONE + TWO * 2 */
        {"#if (7 % 4) + (1 << 3) - (~0) == 12", true, false},
        {"#if __VERSION__ >= 330", true, false},
        {"#ifdef GL_ES", false, true},
        {"#ifdef GL_core_profile", true, false},
        {"#if 0x10 == 16 && 010 == 8", true, false},
        {"#if UNKNOWN", true, true},
        {"#if UNKNOWN && 0", false, true},
        {"#if UNKNOWN || ONE", true, false},
        {"#ifdef GL_ARB_texture_gather", true, true},
        {"#if defined(GL_ARB_texture_gather)", true, true},
        {"#define LOCAL 3\n#if LOCAL == 3", true, false},
        {"#define LOCAL 3\n#undef LOCAL\n#ifdef LOCAL", false, true},
        {"#define F(x) x\n#if F(1)", true, true},
        {"#if 1 / 0", true, true},
        {"#if (", true, true},
        {"#  if /* c */ 1 // d", true, false},
        {"#if 0\n#elif TWO == 2", true, false},
        {"#if \\\n 1", true, false},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        check_condition((int)i, rows[i].condition, rows[i].yes, rows[i].no);
}

static void test_effect_defines(void) {
    static const plr_define defines[] = {{"MODE", "2"}};
    static const char text[] = "#if MODE == 2\nvoid PLUG_change(inout vec4 x) { x.r = MODE_; }\n"
                               "#else\nvoid PLUG_change(inout vec4 x) { x.g = 0.5; }\n#endif\n"
                               "#define MODE_ 1.0\n";
    begin();
    base(BASE);
    plr_effect *first = effect(text);
    first->defines = defines;
    first->define_count = 1;
    effect("#ifdef MODE\nbad\n#endif\n" CHANGE);
    const linked *r = link_all();
    CHECK_HAS(r->fragment, "x.r = ");
    CHECK_LACKS(r->fragment, "bad");
}

static void test_kept(void) {
    begin();
    base(BASE);
    static const plr_define define = {"HOST", "1"};
    description()->defines = &define;
    description()->define_count = 1;
    effect("#ifdef GL_OES_standard_derivatives\nfloat fine(float x) { return dFdx(x); }\n"
           "#elif HOST == 0\nbroken\n#else\nfloat fine(float x) { return x; }\n#endif\n"
           "void PLUG_change(inout vec4 x)\n{\n  x.r = fine(x.r);\n"
           "#if defined(GL_EXT_x) && HOST\n  if (x.r > 1.0) {\n#else\n  if (x.r > 2.0) {\n#endif\n"
           "    x.r = 0.0;\n  }\n}\n");
    const linked *r = link_valid();
    CHECK_INT(occurrences(r->fragment, "float plr0_fine(float x)"), 2);
    CHECK_HAS(r->fragment, "#ifdef GL_OES_standard_derivatives\n");
    CHECK_HAS(r->fragment, "#else\n");
    CHECK_LACKS(r->fragment, "broken");
    CHECK_HAS(r->fragment, "#if defined(GL_EXT_x) && (1)\n");
    CHECK_SILENT();
}

/* A function in each branch of a conditional that is kept is one function. */
static void test_twins(void) {
    begin();
    base(BASE);
    effect("#ifdef GL_ARB_never\nvoid PLUG_change(inout vec4 x) { x.r = 0.25; }\n#else\n"
           "void PLUG_change(inout vec4 x) { x.g = 0.25; }\n#endif\n");
    effect("void PLUG_change(inout vec4 x\n#ifdef NEVER\n, float y\n#endif\n) { x.b = 0.25; }\n");
    const linked *r = link_valid();
    CHECK_INT(occurrences(r->fragment, "  plr0_change(c);"), 1);
    CHECK_LACKS(r->fragment, "change_2");
    CHECK_HAS(r->fragment, "  plr1_change(c);");
    CHECK_SILENT();
}

/* Twins stand in different branches; in one branch they are two. */
static void test_two_in_a_branch(void) {
    begin();
    base(BASE);
    effect("#ifdef GL_ARB_never\nvoid PLUG_change(inout vec4 x) { x.r = 0.25; }\n"
           "void PLUG_change(inout vec4 x) { x.g = 0.25; }\n#elif defined(GL_ARB_other)\n"
           "void PLUG_change(inout vec4 x) { x.b = 0.25; }\n#else\n"
           "#ifdef GL_ARB_third\n#endif\nvoid PLUG_change(inout vec4 x) { x.r = 0.5; }\n"
           "#ifdef GL_ARB_third\nvoid PLUG_change(inout vec4 x) { x.g = 0.5; }\n#else\n"
           "void PLUG_change(inout vec4 x) { x.b = 0.5; }\n#endif\n#endif\n");
    const linked *r = link_valid();
    CHECK_INT(occurrences(r->fragment, "  plr0_change(c);"), 1);
    CHECK_INT(occurrences(r->fragment, "  plr0_change_2(c);"), 1);
    CHECK_LACKS(r->fragment, "change_3");
    CHECK_INT(occurrences(r->fragment, "void plr0_change(inout vec4 x) {"), 3);
    CHECK_INT(occurrences(r->fragment, "void plr0_change_2(inout vec4 x) {"), 3);
    CHECK_SILENT();
}

static void test_macros_across_units(void) {
    begin();
    base(BASE);
    effect("#define HAVE_IT\n" CHANGE);
    unit("#ifdef HAVE_IT\nvoid PLUG_change(inout vec4 x) { x.b = 0.75; }\n#endif\n");
    effect("#ifdef HAVE_IT\nbad\n#endif\n" CHANGE);
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "x.b = 0.75;");
}

/* ---- PLUG_USED and READS -----------------------------------------------------------------------
 */

#define DYNAMIC                                                                                    \
    "struct Sample {\n  vec4 value;\n#if READS(normal)\n  vec3 normal;\n#endif\n"                  \
    "#if READS(gradient) || READS(normal)\n  float gradient;\n#endif\n};\n"                        \
    "uniform sampler3D volume;\nin vec3 at;\nout vec4 c;\n"                                        \
    "#if READS(normal)\nvec3 find_normal(vec3 p) { return texture(volume, p).xyz; }\n#endif\n"     \
    "void main()\n{\n  Sample s;\n  s.value = texture(volume, at);\n"                              \
    "#if READS(normal)\n  s.normal = find_normal(at);\n  s.gradient = length(s.normal);\n#endif\n" \
    "  c = s.value;\n"                                                                             \
    "#if PLUG_USED(shade)\n  float light = 1.0;\n  /* PLUG: shade (c, s) */\n  c *= "              \
    "light;\n#endif\n"                                                                             \
    "#if !PLUG_USED(shade) && defined(GL_core_profile)\n  c.a = 1.0;\n#endif\n}\n"

static void test_used(void) {
    begin();
    base(DYNAMIC);
    const linked *r = link_valid();
    CHECK_LACKS(r->fragment, "normal");
    CHECK_LACKS(r->fragment, "gradient");
    CHECK_LACKS(r->fragment, "light");
    CHECK_HAS(r->fragment, "c.a = 1.0;");
    CHECK_LACKS(r->fragment, "#if");
    begin();
    base(DYNAMIC);
    effect("float unused(Sample s) { return s.gradient; }\n"
           "void PLUG_shade(inout vec4 c, const in Sample s) { c *= s.value; }\n");
    r = link_valid();
    CHECK_LACKS(r->fragment, "normal");
    CHECK_LACKS(r->fragment, "gradient");
    CHECK_HAS(r->fragment, "light = 1.0;");
    CHECK_LACKS(r->fragment, "c.a = 1.0;");
    begin();
    base(DYNAMIC);
    effect("void PLUG_shade(inout vec4 c, const in Sample s) { c *= s.normal.x; }\n");
    r = link_valid();
    CHECK_HAS(r->fragment, "vec3 normal;");
    CHECK_HAS(r->fragment, "float gradient;");
    CHECK_HAS(r->fragment, "vec3 find_normal(vec3 p) { return");
    CHECK_SILENT();
}

#define CARRYING "#if READS(carried)\nvoid PLUG_attributes() { carried = place; }\n#endif\n"

static void describe_carried(const char *reader) {
    begin();
    base(BASE);
    base_vertex("in vec4 place;\nvoid main() {\n  /* PLUG: attributes () */\n"
                "  gl_Position = vec4(0.0);\n}\n");
    library("varying vec4 carried;\n");
    library_vertex("varying vec4 carried;\nin vec4 place;\n");
    effect(CHANGE)->builtin = true;
    vertex_unit(CARRYING);
    effect(reader);
}

/* A vertex stage hands on what a later stage reads. */
static void test_reads_of_stages(void) {
    describe_carried(CHANGE);
    const linked *r = link_valid();
    CHECK_LACKS(r->vertex, "carried");
    describe_carried("void PLUG_change(inout vec4 x) { x += carried; }\n");
    r = link_valid();
    CHECK_HAS(r->vertex, "carried = place;");
    describe_carried("varying vec4 carried;\nvoid PLUG_change(inout vec4 x) { x += carried; }\n");
    r = link_valid();
    CHECK_HAS(r->vertex, "carried = place;");
    describe_carried("varying vec4 carried;\nfloat f() { return carried.x; }\n" CHANGE);
    r = link_valid();
    CHECK_LACKS(r->vertex, "carried");
    CHECK_SILENT();
}

/* ---- Versions and extensions -------------------------------------------------------------------
 */

static void check_version(const char *first, const char *second, plr_target_glsl glsl,
                          const char *expected) {
    char a[256], b[256];
    snprintf(a, sizeof a, "%s%s", first, BASE);
    snprintf(b, sizeof b, "%s%s", second, CHANGE);
    begin();
    base(a);
    effect(b);
    description()->glsl = glsl;
    const linked *r = link_all();
    char line[64] = "";
    strncat(line, r->fragment, strcspn(r->fragment, "\n"));
    CHECK_STR(line, expected);
    CHECK_INT(occurrences(r->fragment, "#version"), 1);
}

static void test_versions(void) {
    check_version("", "", PLR_GLSL_330, "#version 330 core");
    check_version("#version 120\n", "", PLR_GLSL_330, "#version 330 core");
    check_version("#version 400 compatibility\n", "#version 130\n", PLR_GLSL_330,
                  "#version 400 core");
    check_version("", "// c\n#version 430 core\n", PLR_GLSL_330, "#version 430 core");
    check_version("", "#version 100\n", PLR_GLSL_330, "#version 330 core");
    check_version("", "#version 310 es\n", PLR_GLSL_330, "#version 430 core");
    check_version("#version 330\n", "", PLR_GLSL_410, "#version 410 core");
    check_version("#version 460\n", "", PLR_GLSL_450, "#version 460 core");
    check_version("#version 330\n", "", PLR_GLSL_300ES, "#version 300 es");
    CHECK_HAS(link_result()->fragment, "precision highp float;");
    check_version("", "#if 0\n#version 450\n#endif\n", PLR_GLSL_330, "#version 330 core");
    check_version("", "#version 999\n", PLR_GLSL_330, "#version 330 core");
    CHECK_SAID("a.frag:1:1: warning", "bad-version");
}

static void test_extensions(void) {
    begin();
    base("#version 330\n#extension GL_ARB_gpu_shader5 : enable\n" BASE);
    effect("#extension GL_ARB_gpu_shader5 : require\n#extension GL_ARB_texture_gather : "
           "enable\n" CHANGE);
    effect("float x;\n#ifdef GL_ARB_shader_bit_encoding\n"
           "#extension GL_ARB_shader_bit_encoding : enable\nfloat y;\n#endif\n" CHANGE);
    effect("#extension GL_EXT_never : require\nvoid PLUG_nothing() { }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "#version 330 core\n#extension GL_ARB_gpu_shader5 : require\n"
                           "#extension GL_ARB_texture_gather : enable\n");
    CHECK_INT(occurrences(r->fragment, "#extension"), 3);
    CHECK_ORDER(r->fragment, "#extension GL_ARB_shader_bit_encoding", "out vec4 c;");
    CHECK_LACKS(r->fragment, "never");
}

static void test_other_lines(void) {
    begin();
    base("#line 5\n#pragma optimize(on)\n#\n" BASE);
    effect("#line 7 8\n" CHANGE);
    const linked *r = link_valid();
    CHECK_LACKS(r->fragment, "#line");
    CHECK_HAS(r->fragment, "#pragma optimize(on)");
}

int main(void) {
    test_expressions();
    test_effect_defines();
    test_kept();
    test_twins();
    test_two_in_a_branch();
    test_macros_across_units();
    test_used();
    test_reads_of_stages();
    test_versions();
    test_extensions();
    test_other_lines();
    return finish();
}
