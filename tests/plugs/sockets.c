/* Plugs, the functions called there, and the order of calls. */
#include "helper.h"

#define BASE                                                                                       \
    "uniform vec4 color;\nout vec4 result;\nvoid main()\n{\n  vec4 c = color;\n"                   \
    "  /* PLUG: change (c) */\n  result = c;\n}\n"

static void test_call(void) {
    begin();
    base(BASE);
    effect("void PLUG_change(inout vec4 x) { x *= 0.5; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "void plr0_change(inout vec4 x);\n");
    CHECK_HAS(r->fragment, "\n  plr0_change(c);\n  result = c;\n");
    CHECK_LACKS(r->fragment, "PLUG");
    CHECK_ORDER(r->fragment, "void plr0_change(inout vec4 x);", "void main()");
    CHECK_SILENT();
    CHECK(plr_program_is_active(r->program, 0));
}

static void test_spacing(void) {
    static const char *const comments[] = {
        "/*PLUG:change(c)*/",
        "/* PLUG: change(c) */",
        "/*  PLUG :  change  ( c )  */",
        "/*\tPLUG:\tchange\t(c)\t*/",
        "/*\n PLUG:\n change\n (c)\n*/",
        "/* PLUG: change (c)*/",
    };
    for (size_t i = 0; i < sizeof comments / sizeof comments[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, "out vec4 c;\nvoid main() { c = vec4(1.0); %s }\n",
                 comments[i]);
        begin();
        base(text);
        effect("void PLUG_change(inout vec4 x) { x *= 0.5; }");
        const linked *r = link_valid();
        CHECK_INT(plr_program_plug_count(r->program), 1);
        CHECK_HAS(r->fragment, "plr0_change(");
        CHECK_SILENT();
    }
}

static void test_function_forms(void) {
    static const char *const forms[] = {
        "void PLUG_change (inout vec4 x) { x *= 0.5; }",
        "void PLUG_change\n(inout vec4 x)\n{ x *= 0.5; }",
        "const float a = 1.0;void PLUG_change(inout vec4 x) { x *= a; }",
        "void\nPLUG_change(inout vec4 x) { x *= 0.5; }",
        "void PLUG_ch\\\nange(inout vec4 x) { x *= 0.5; }",
        "void PLUG_change(inout vec4 \\\n x) { x *= \\\r\n 0.5; }",
        "\xEF\xBB\xBFvoid PLUG_change(inout vec4 x)\r\n{\r\n  x *= 0.5;\r\n}",
        ("void /* PLUG_other(a) */ PLUG_change(/* b */ inout vec4 x) // PLUG_third(c)\n{ x *= 0.5; "
         "}"),
    };
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
        begin();
        base(BASE);
        effect(forms[i]);
        const linked *r = link_valid();
        CHECK_HAS(r->fragment, "  plr0_change(c);\n");
        CHECK_LACKS(r->fragment, "\r");
        CHECK_SILENT();
    }
}

/* (a) of the living implementation's faults: a name that begins another one. */
static void test_prefix_names(void) {
    static const char *const orders[] = {
        "void PLUG_a(inout vec4 x) { x.r = 0.0; }\nvoid PLUG_a_b(inout vec4 x) { x.g = 0.0; }\n",
        "void PLUG_a_b(inout vec4 x) { x.g = 0.0; }\nvoid PLUG_a(inout vec4 x) { x.r = 0.0; }\n",
    };
    for (int i = 0; i < 2; i++) {
        begin();
        base("out vec4 c;\nvoid main() {\n  c = vec4(1.0);\n  /* PLUG: a (c) */\n"
             "  c.b = 0.5;\n  /* PLUG: a_b (c) */\n}\n");
        effect(orders[i]);
        const linked *r = link_valid();
        CHECK_HAS(r->fragment, "  plr0_a(c);\n  c.b = 0.5;\n  plr0_a_b(c);\n");
        CHECK_SILENT();
    }
}

/* (b): names in comments and in inactive text are no functions and no plugs. */
static void test_comments(void) {
    begin();
    base("out vec4 c;\nvoid main() {\n  c = vec4(1.0);\n  // /* PLUG: line (c) */\n"
         "  /* see /* PLUG: inner (c) */\n#if 0\n  /* PLUG: off (c) */\n#endif\n"
         "  /* PLUG: change (c) */\n}\n");
    effect("/* see PLUG_fog_apply (a) */\n// void PLUG_line(inout vec4 x) { }\n"
           "#if 0\nvoid PLUG_off(inout vec4 x) { }\n#endif\n"
           "void XPLUG_change(inout vec4 x) { }\n"
           "void PLUG_change(inout vec4 x);\n"
           "void PLUG_change(inout vec4 x) { x *= 0.5; }\n");
    const linked *r = link_valid();
    CHECK_INT(plr_program_plug_count(r->program), 1);
    CHECK_INT(occurrences(r->fragment, "plr0_change"), 3);
    CHECK_SILENT();
}

/* (c) and several argument lists: each function is called with the first list of its length. */
static void test_lists(void) {
    begin();
    base("uniform sampler2D tex;\nin vec4 coord;\nout vec4 result;\nvoid main() {\n"
         "  vec4 c = texture(tex, coord.xy);\n"
         "  /* PLUG: texture_color (c, tex, coord) (c, coord) */\n"
         "  vec4 d = vec4(1.0, 0.0, 1.0, 1.0);\n  /* PLUG: texture_color (d, coord) */\n"
         "  result = c + d;\n}\n");
    effect("void PLUG_texture_color(inout vec4 c, const in sampler2D t, const in vec4 uv) "
           "{ c = texture2D(t, uv.yx); }\n");
    effect("void PLUG_texture_color(inout vec4 c, const in vec4 uv) { c *= uv; }\n");
    const linked *r = link_valid();
    CHECK_INT(occurrences(r->fragment, "  plr0_texture_color(c, tex, coord);\n"), 1);
    CHECK_INT(occurrences(r->fragment, "  plr1_texture_color("), 2);
    CHECK_HAS(r->fragment, "  plr1_texture_color(d, coord);\n");
    CHECK_SILENT();
}

static void test_depth_of_commas(void) {
    begin();
    base("out vec4 c;\nvoid main() {\n  float a[2];\n  a[0] = a[1] = 1.0;\n  c = vec4(1.0);\n"
         "  /* PLUG: change (c, vec2(1.0, max(2.0, 3.0)), a[min(0, 1)]) */\n"
         "  /* PLUG: none () */\n}\n");
    effect("void PLUG_change(inout vec4 c, vec2 v, float f) { c.xy += v * f; }\n"
           "float flag;\nvoid PLUG_none(void) { flag = 1.0; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "  plr0_change(c, vec2(1.0, max(2.0, 3.0)), a[min(0, 1)]);\n");
    CHECK_HAS(r->fragment, "  plr0_none();\n");
    CHECK_SILENT();
}

/* A plug defined by an effect is open to later ones: a chain of four. */
static void test_chain(void) {
    begin();
    base(BASE);
    effect("void PLUG_change(inout vec4 x) { x.r *= 0.5; /* PLUG: second (x) */ }\n");
    effect("void PLUG_second(inout vec4 x) { x.g *= 0.5; /* PLUG: third (x) */ }\n");
    effect("void PLUG_third(inout vec4 x) { x.b *= 0.5; /* PLUG: fourth (x) */ }\n");
    effect("void PLUG_fourth(inout vec4 x) { x.a *= 0.5; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "x.r *= 0.5;\n");
    CHECK_ORDER(r->fragment, "x.r *= 0.5;", "plr1_second(x);");
    CHECK_ORDER(r->fragment, "x.g *= 0.5;", "plr2_third(x);");
    CHECK_ORDER(r->fragment, "x.b *= 0.5;", "plr3_fourth(x);");
    CHECK_SILENT();
}

static void test_later_units_only(void) {
    begin();
    base(BASE);
    effect("void PLUG_change(inout vec4 x) { x.r *= 0.5; /* PLUG: own (x) */ }\n");
    unit("void PLUG_own(inout vec4 x) { x.g *= 0.5; }\n");
    const linked *r = link_valid();
    CHECK_ORDER(r->fragment, "x.r *= 0.5;", "plr0_own(x);");
    CHECK_SILENT();
    begin();
    base(BASE);
    effect("void PLUG_early(inout vec4 x) { x.g *= 0.5; }\n");
    effect("void PLUG_change(inout vec4 x) { x.r *= 0.5; /* PLUG: early (x) */ }\n");
    link_valid();
    CHECK_SAID("a.frag:1:6: warning", "unknown-plug");
    CHECK_SAID("b.frag:1:46: note", "unknown-plug");
}

/* (d) 10: two functions of one name, in one unit and in two. */
static void test_many_functions(void) {
    begin();
    base(BASE);
    effect("void PLUG_change(inout vec4 x) { x.r *= 0.5; }\n"
           "void PLUG_change(inout vec4 x) { x.g *= 0.5; }\n"
           "float change_2() { return 1.0; }\nfloat use() { return change_2(); }\n");
    unit("void PLUG_change(inout vec4 x) { x.b *= use(); }\n");
    same_effect_again();
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "  plr0_change(c);\n  plr0_change_3(c);\n  plr0_change_4(c);\n"
                           "  plr1_change(c);\n  plr1_change_3(c);\n  plr1_change_4(c);\n");
    CHECK_SILENT();
}

static void test_places(void) {
    begin();
    base("out vec4 result;\nvec4 shade(vec4 c) {\n  /* PLUG: change (c) */\n  return c;\n}\n"
         "void main() {\n  vec4 c = vec4(1.0);\n"
         "  for (int i = 0; i < 3; i++) {\n    /* PLUG: change (c) */\n  }\n"
         "  /* PLUG: change (c) */ /* PLUG: change (c) */\n"
         "  for (int i = 0; i < 3; i++) /* PLUG: change (c) */;\n"
         "  if (c.r > 0.5) /* PLUG: change (c) */ c.g = 0.0;\n"
         "  else /* PLUG: change (c) */ { c.b = 0.0; }\n"
         "  result = shade(c);\n}\n");
    effect("void PLUG_change(inout vec4 x) { x.r *= 0.5; }\n");
    effect("void PLUG_change(inout vec4 x) { x.g *= 0.5; }\n");
    const linked *r = link_valid();
    CHECK_INT(plr_program_plug_count(r->program), 7);
    CHECK_INT(occurrences(r->fragment, "plr1_change(c);"), 7);
    CHECK_HAS(r->fragment, "{ plr0_change(c);\n  plr1_change(c); }\n");
    CHECK_HAS(r->fragment, "c.g = 0.0; }");
    CHECK_SILENT();
}

/* Numbered names do not meet those of other plugs. */
static void test_numbered_names(void) {
    begin();
    base("out vec4 c;\nvoid main() { c = vec4(1.0); /* PLUG: a (c) */ /* PLUG: a_2 (c) */ }\n");
    effect("void PLUG_a(inout vec4 x) { x.r = 0.0; }\nvoid PLUG_a(inout vec4 x) { x.g = 0.0; }\n"
           "void PLUG_a_2(inout vec4 x) { x.b = 0.0; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "plr0_a(c);\nplr0_a_3(c);\nplr0_a_2(c);");
}

static void test_macro_body(void) {
    begin();
    base(BASE);
    effect("#define ARGS inout vec4 x\n#define BODY { x.r = 0.5; }\nvoid PLUG_change(ARGS) BODY\n"
           "void PLUG_change(inout vec4 x) { x.g = 0.5; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "  plr0_change(c);\n  plr0_change_2(c);\n");
}

/* A plug in the middle of a statement is called at its end. */
static void test_inside_statement(void) {
    begin();
    base("out vec4 c;\nvoid main() {\n  c = vec4(1.0) /* PLUG: change (c) */;\n"
         "  c = c + vec4(length(c)) /* PLUG: change (c) */ * 2.0; c.a = 1.0;\n}\n");
    effect("void PLUG_change(inout vec4 x) { x.r *= 0.5; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "  c = vec4(1.0) ;\n  plr0_change(c);\n  c = c + vec4(length(c))");
    CHECK_ORDER(r->fragment, "* 2.0;\n  plr0_change(c);\n", "c.a = 1.0;");
}

static void test_direct_call(void) {
    begin();
    base(BASE);
    effect("void PLUG_change(inout vec4 x) { x.r *= 0.5; }\n"
           "void PLUG_change(inout vec4 x) { x.g *= 0.5; }\n"
           "void helper(inout vec4 x) { if (x.a > 0.5) PLUG_change(x); PLUG_one(x); }\n"
           "void PLUG_one(inout vec4 x) { x.b *= 0.5; }\n"
           "void PLUG_change(inout vec4 x, float f) { helper(x); }\n");
    link_all();
    begin();
    base("out vec4 c;\nvoid main() { c = vec4(1.0);\n  /* PLUG: change (c) (c, 2.0) */\n"
         "  /* PLUG: one (c) */\n}\n");
    effect("void PLUG_one(inout vec4 x) { x.b *= 0.5; }\n"
           "void PLUG_change(inout vec4 x) { x.r *= 0.5; }\n"
           "void PLUG_change(inout vec4 x) { x.g *= 0.5; }\n"
           "void helper(inout vec4 x) { if (x.a > 0.5) PLUG_change(x); PLUG_one(x); }\n"
           "void PLUG_change(inout vec4 x, float f) { helper(x); }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "if (x.a > 0.5) { plr0_change(x); plr0_change_2(x); } plr0_one(x);");
    CHECK_SILENT();
}

/* ---- Order and scopes --------------------------------------------------------------------------
 */

static void test_builtin_first(void) {
    begin();
    base(BASE);
    effect("void PLUG_change(inout vec4 x) { x.r *= 0.5; }\n");
    effect("void PLUG_change(inout vec4 x) { x.g *= 0.5; }\n")->builtin = true;
    effect("void PLUG_change(inout vec4 x) { x.b *= 0.5; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "  plr1_change(c);\n  plr0_change(c);\n  plr2_change(c);\n");
}

static void light(void) {
    plr_effect *e = effect("void PLUG_add_light(inout vec4 c)\n{\n  float scale = 1.0;\n"
                           "  /* PLUG: light_scale (scale) */\n  c.rgb += scale;\n}\n");
    e->builtin = true;
    e->name = "DirectionalLight";
}

#define LIT                                                                                        \
    "out vec4 c;\nvoid main() {\n  c = vec4(0.0);\n  /* PLUG: add_light (c) */\n"                  \
    "  /* PLUG: fragment_modify (c) */\n}\n"
#define SCALE "void PLUG_light_scale(inout float s) { s *= 0.5; }\n"

static void test_instances(void) {
    begin();
    base(LIT);
    light();
    light();
    effect(SCALE)->attached = 1;
    effect(SCALE)->attached = 2;
    effect(SCALE);
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "  float scale = 1.0;\n  plr2_light_scale(scale);\n"
                           "  plr4_light_scale(scale);\n");
    CHECK_HAS(r->fragment, "  float scale = 1.0;\n  plr3_light_scale(scale);\n"
                           "  plr4_light_scale(scale);\n");
    CHECK_SILENT();
}

/* Where the instance has no plug of the name, those of everything before are used. */
static void test_instance_reaches_shape(void) {
    begin();
    base(LIT);
    light();
    effect(SCALE "void PLUG_fragment_modify(inout vec4 c) { c.a = 1.0; }\n")->attached = 1;
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "  plr1_fragment_modify(c);\n");
    CHECK_HAS(r->fragment, "  plr1_light_scale(scale);\n");
    CHECK_SILENT();
}

static void test_instance_plug_of_attached(void) {
    begin();
    base(LIT);
    for (size_t i = 0; i < 2; i++) {
        light();
        effect("void PLUG_light_scale(inout float s) { /* PLUG: mine (s) */ s *= 0.5; }\n")
            ->attached = 3 * i + 1;
        effect("void PLUG_mine(inout float s) { s += 0.25; }\n")->attached = 3 * i + 1;
    }
    const linked *r = link_valid();
    CHECK_INT(occurrences(r->fragment, "plr2_mine(s);"), 1);
    CHECK_INT(occurrences(r->fragment, "plr5_mine(s);"), 1);
    CHECK_SILENT();
}

#define NEST                                                                                       \
    "void PLUG_light_scale(inout float s) { float t = s;\n/* PLUG: light_scale (t) */ s = t; }\n"

/* An effect at the end of a chain is reached from its beginning. */
static void test_deep_instances(void) {
    begin();
    base(LIT);
    light();
    effect("void PLUG_light_scale(inout float s) { /* PLUG: mine (s) */ s *= 0.5; }\n")->attached =
        1;
    effect("void PLUG_mine(inout float s) { /* PLUG: inner (s) */ s += 0.5; }\n")->attached = 2;
    effect("void PLUG_inner(inout float s) { s += 0.25; }\n")->attached = 1;
    light();
    effect("void PLUG_inner(inout float s) { s += 0.25; }\n")->attached = 5;
    const linked *r = link_valid();
    CHECK_INT(occurrences(r->fragment, "plr3_inner(s);"), 1);
    CHECK_INT(occurrences(r->fragment, "plr5_inner(s);"), 1); /* no such plug there: any */
}

/* What stands inside an effect with plugs of its own is called there alone, and nothing else is. */
static void test_private_plugs(void) {
    begin();
    base(LIT);
    light();
    plr_effect *around = effect(NEST);
    around->attached = 1;
    around->private_plugs = true;
    plr_effect *inside = effect(SCALE);
    inside->attached = 2;
    inside->only_attached = true;
    effect(SCALE)->attached = 1; /* beside: not called inside */
    effect(SCALE);               /* of the whole: neither */
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "float t = s;\nplr2_light_scale(t);\ns = t;");
    CHECK_INT(occurrences(r->fragment, "plr3_light_scale(scale);"), 1);
    CHECK_INT(occurrences(r->fragment, "plr3_light_scale(t);"), 0);
    CHECK_INT(occurrences(r->fragment, "plr4_light_scale(t);"), 0);
}

/* ---- Placement ---------------------------------------------------------------------------------
 */

static plr_effect *placed(plr_placement placement, const char *target) {
    plr_effect *e = effect("void PLUG_change(inout vec4 x) { x.r *= 0.5; }\n");
    e->placement = placement;
    e->target = target;
    return e;
}

static void styles(void) {
    static const char *const names[] = {"Tone", "Edge", "Tone"};
    begin();
    base(BASE);
    for (int i = 0; i < 3; i++) {
        plr_effect *e = effect("void PLUG_change(inout vec4 x) { x.g *= 0.5; }\n");
        e->builtin = true;
        e->name = names[i];
    }
}

static void check_calls(const char *expected) {
    const linked *r = link_valid();
    char calls[64] = "";
    for (size_t i = 0; i < plr_program_plug(r->program, 0)->call_count; i++) {
        char one[8];
        snprintf(one, sizeof one, "%d", (int)plr_program_plug_call(r->program, 0, i, NULL));
        strcat(calls, one);
    }
    CHECK_STR(calls, expected);
    char text[64] = "";
    for (const char *at = r->fragment; (at = strstr(at, "_change(c);")) != NULL; at++)
        strncat(text, at - 1, 1);
    CHECK_STR(text, expected);
}

static void test_placement(void) {
    static const struct {
        plr_placement placement;
        const char *target, *calls;
    } rows[] = {
        {PLR_ADD_AFTER, NULL, "0123"},      {PLR_ADD_BEFORE, NULL, "3012"},
        {PLR_ADD_BEFORE, "", "3012"},       {PLR_REPLACE, "", "3"},
        {PLR_ADD_BEFORE, "Tone", "3012"},   {PLR_ADD_AFTER, "Tone", "0123"},
        {PLR_ADD_BEFORE, "Edge", "0312"},   {PLR_ADD_AFTER, "Edge", "0132"},
        {PLR_REPLACE, "Edge", "032"},       {PLR_REPLACE, "Tone", "31"},
        {PLR_REMOVE, "Tone", "13"},         {PLR_ADD_BEFORE, "Nothing", "3012"},
        {PLR_ADD_AFTER, "Nothing", "0123"}, {PLR_REPLACE, "Nothing", "0123"},
        {PLR_REMOVE, "Nothing", "0123"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        styles();
        placed(rows[i].placement, rows[i].target);
        check_calls(rows[i].calls);
    }
}

static void test_several_placed(void) {
    styles();
    placed(PLR_ADD_BEFORE, "Edge");
    placed(PLR_ADD_BEFORE, "Edge");
    placed(PLR_ADD_AFTER, "Edge");
    placed(PLR_ADD_AFTER, "Edge");
    placed(PLR_ADD_BEFORE, "");
    placed(PLR_ADD_AFTER, "");
    check_calls("703415628");
    styles();
    placed(PLR_REPLACE, "");
    placed(PLR_REPLACE, "");
    placed(PLR_ADD_AFTER, "");
    check_calls("345");
}

static void test_only_if_active(void) {
    styles();
    placed(PLR_ADD_BEFORE, "Fog")->only_if_active = true;
    placed(PLR_ADD_BEFORE, "Edge")->only_if_active = true;
    check_calls("0412");
    CHECK(!plr_program_is_active(link_result()->program, 3));
    CHECK_LACKS(link_result()->fragment, "plr3_");
    CHECK_SILENT();
}

static void test_bad_remove(void) {
    styles();
    plr_effect *e = placed(PLR_REMOVE, "");
    e->place = (plr_place){"scene.x3dv", 7, 3};
    check_calls("012");
    CHECK_SAID("scene.x3dv:7:3: error", "bad-target");
    CHECK(plr_program_is_faulty(link_result()->program, 3));
}

static void test_local_target(void) {
    begin();
    base(LIT);
    light();
    light();
    plr_effect *e = effect("void PLUG_add_light(inout vec4 c) { c.r = 1.0; }\n");
    e->attached = 2;
    e->placement = PLR_REPLACE;
    e->target = "DirectionalLight";
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "  plr0_add_light(c);\n  plr2_add_light(c);\n");
    CHECK_LACKS(r->fragment, "plr1_");
}

/* A gate stands before all else in the plug functions, and nowhere else. */
static void test_gate(void) {
    begin();
    base(BASE);
    plr_effect *gated = effect("uniform bool gate = true;\nuniform float k;\n"
                               "float half_of(float x) { return 0.5 * x; }\n"
                               "void PLUG_change(inout vec4 x) {\n    x *= half_of(k);\n}\n"
                               "void PLUG_lost(inout vec4 x) { x *= k; }\n");
    gated->gate = "gate";
    effect("uniform bool gate;\nvoid PLUG_change(inout vec4 x) { x.r = gate ? 0.0 : 1.0; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "uniform bool plr0_gate = true;\n");
    CHECK_HAS(r->fragment,
              "void plr0_change(inout vec4 x) {\n    if (!plr0_gate)\n        return;\n"
              "    x *= plr0_half_of(plr0_k);\n}");
    CHECK_HAS(r->fragment, "void plr1_change(inout vec4 x) { x.r");
    CHECK_INT(occurrences(r->fragment, "return;"), 1);
    CHECK_ORDER(r->fragment, "uniform bool plr0_gate", "if (!plr0_gate)");
}

/* A gate that no unit of the stage declares is none. */
static void test_no_gate(void) {
    begin();
    base(BASE);
    effect("void PLUG_change(inout vec4 x) { x *= 0.5; }\n")->gate = "gate";
    const linked *r = link_valid();
    CHECK_LACKS(r->fragment, "return");
}

int main(void) {
    test_call();
    test_spacing();
    test_function_forms();
    test_prefix_names();
    test_comments();
    test_lists();
    test_depth_of_commas();
    test_chain();
    test_later_units_only();
    test_many_functions();
    test_places();
    test_numbered_names();
    test_macro_body();
    test_inside_statement();
    test_direct_call();
    test_builtin_first();
    test_instances();
    test_instance_reaches_shape();
    test_instance_plug_of_attached();
    test_deep_instances();
    test_private_plugs();
    test_placement();
    test_several_placed();
    test_only_if_active();
    test_bad_remove();
    test_local_target();
    test_gate();
    test_no_gate();
    return finish();
}
