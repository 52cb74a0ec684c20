/* Names: isolation of effects, what is shared by rule, reachability, declarations. */
#include "helper.h"

#define BASE                                                                                       \
    "uniform vec4 color;\nout vec4 result;\nvoid main()\n{\n  vec4 c = color;\n"                   \
    "  /* PLUG: change (c) */\n  result = c;\n}\n"
#define USE(expression) "void PLUG_change(inout vec4 x) { x *= float(" expression "); }\n"

/* (d) 10: helpers, uniforms, constants, structs, macros, globals, varyings of one name. */
static void test_isolation(void) {
    static const char text[] =
        "uniform float amount;\nconst int N = %d;\nstruct Thing { float a; };\n"
        "#define TWICE(x) ((x) * %d.0)\nfloat counter = %d.0;\nvarying float height;\n"
        "float noise(vec3 p) { return p.x * %d.0; }\n"
        "void PLUG_change(inout vec4 x) {\n  Thing t = Thing(noise(x.xyz));\n"
        "  x *= TWICE(t.a) * amount * float(N) * counter * height;\n}\n";
    char first[512], second[512];
    snprintf(first, sizeof first, text, 1, 1, 1, 1);
    snprintf(second, sizeof second, text, 2, 2, 2, 2);
    begin();
    base(BASE);
    base_vertex("in vec4 v;\nvoid main() { gl_Position = v; /* PLUG: place (v) */ }\n");
    effect(first);
    vertex_unit("varying float height;\nvoid PLUG_place(vec4 p) { height = p.y; }\n");
    effect(second);
    vertex_unit("varying float height;\nvoid PLUG_place(vec4 p) { height = p.x; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "const int plr0_N = 1;");
    CHECK_HAS(r->fragment, "const int plr1_N = 2;");
    CHECK_HAS(r->fragment, "#define plr1_TWICE(x) ((x) * 2.0)");
    CHECK_HAS(r->fragment, "struct plr1_Thing { float a; };");
    CHECK_HAS(r->fragment, "float plr1_counter = 2.0;");
    CHECK_HAS(r->fragment, "in float plr0_height;");
    CHECK_HAS(r->vertex, "out float plr0_height;");
    CHECK_HAS(r->vertex, "out float plr1_height;");
    CHECK_HAS(r->fragment, "plr1_Thing t = plr1_Thing(plr1_noise(x.xyz));");
    CHECK_SILENT();
    size_t uniforms = 0;
    for (size_t i = 0; i < plr_program_symbol_count(r->program); i++) {
        const plr_symbol *symbol = plr_program_symbol(r->program, i);
        if (strcmp(symbol->name, "amount") == 0 && symbol->kind == PLR_UNIFORM) {
            CHECK_INT(symbol->effect, uniforms);
            CHECK_STR(symbol->program, uniforms ? "plr1_amount" : "plr0_amount");
            CHECK_STR(symbol->type, "float");
            uniforms++;
        }
    }
    CHECK_INT(uniforms, 2);
}

static void test_same_effect_twice(void) {
    begin();
    base(BASE);
    effect("uniform float amount;\nfloat helper() { return amount; }\n" USE("helper()"));
    same_effect_again();
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "return plr0_amount;");
    CHECK_HAS(r->fragment, "return plr1_amount;");
    CHECK_SILENT();
}

static void test_members_and_keys(void) {
    begin();
    base(BASE);
    effect("struct S { float noise; vec2 amount[2], b; };\nfloat noise() { return 1.0; }\n"
           "uniform float amount;\nconst int location = 3;\nlayout(location = 5) out vec4 extra;\n"
           "void PLUG_change(inout vec4 x) {\n  S s; s.noise = noise(); s.amount[0].x = amount;\n"
           "  x.r = s.noise + float(location);\n  extra = x;\n}\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "{ float noise; vec2 amount[2], b; };");
    CHECK_HAS(r->fragment, "s.noise = plr0_noise(); s.amount[0].x = plr0_amount;");
    CHECK_HAS(r->fragment, "layout(location = 5) out vec4 plr0_extra;");
}

/* A macro replaces members too, so they follow its name; its parameters stay. */
static void test_macros(void) {
    begin();
    base(BASE);
    effect("#define first r\n#define SCALE(x, factor) ((x) * factor * amount)\n"
           "uniform float amount, x, factor;\n"
           "void PLUG_change(inout vec4 c) { c.first = SCALE(c.first, 2.0) + x + factor; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "c.plr0_first = plr0_SCALE(c.plr0_first, 2.0) + plr0_x + plr0_factor;");
    CHECK_HAS(r->fragment, "#define plr0_SCALE(x, factor) ((x) * factor * plr0_amount)");
    CHECK_SILENT();
}

static void test_underscore(void) {
    begin();
    base(BASE);
    effect("float _h() { return 1.0; }\n" USE("_h()"));
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "float plr0u_h() { return 1.0; }");
    CHECK_LACKS(r->fragment, "__");
}

static void test_locals(void) {
    begin();
    base(BASE);
    library("float helper() { return 1.0; }\nfloat other() { return 2.0; }\n");
    effect("uniform float amount;\n"
           "float f(float amount) { return amount; }\n"
           "void PLUG_change(inout vec4 x) {\n  float helper = amount;\n  float other = other();\n"
           "  x.r = helper + f(other);\n  { float amount = 1.0; x.g = amount; }\n}\n");
    const linked *r = link_valid();
    CHECK_LACKS(r->fragment, "float helper()");
    CHECK_HAS(r->fragment, "float other() { return 2.0; }");
    CHECK_HAS(r->fragment, "float plr0_f(float amount) { return amount; }");
}

/* ---- Units of one effect -----------------------------------------------------------------------
 */

static void test_units_share(void) {
    begin();
    base(BASE);
    effect(
        "#define SCALE 2.0\nuniform float amount;\nfloat helper(float x);\n" USE("helper(SCALE)"));
    unit("uniform float amount;\nfloat helper(float x) { return x * amount * SCALE; }\n");
    const linked *r = link_valid();
    CHECK_INT(occurrences(r->fragment, "uniform float plr0_amount;"), 1);
    CHECK_ORDER(r->fragment, "float plr0_helper(float x);", "float plr0_helper(float x) {");
    CHECK_SILENT();
}

static void test_own_unit_first(void) {
    begin();
    base(BASE);
    effect("float h(float x) { return x; }\n" USE("h(1.0)"));
    unit("float h(float y) { return y * 2.0; }\n" USE("h(2.0)"));
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "float(plr0_h(1.0))");
    CHECK_HAS(r->fragment, "float(plr0_h_2(2.0))");
    CHECK_HAS(r->fragment, "float plr0_h_2(float y) { return y * 2.0; }");
    CHECK_SILENT();
}

/* A helper that several effects use belongs to each of them. */
static void test_shared_helper(void) {
    static const char helper[] =
        "#define K 3.0\nfloat state;\nfloat help() { return K + state; }\n";
    begin();
    base(BASE);
    effect(helper);
    unit("float help();\n" USE("help()"));
    effect(helper);
    unit("float help();\n" USE("help()"));
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "float plr0_help() { return plr0_K + plr0_state; }");
    CHECK_HAS(r->fragment, "float plr1_help() { return plr1_K + plr1_state; }");
}

/* A macro of the base or the library leaves members of effects alone. */
static void test_macro_like_member(void) {
    begin();
    library("#define glow (0.25)\n");
    base("#define heat (c.r + 1.0)\nstruct Own { float heat; };\nout vec4 c;\n"
         "void main() {\n  c = vec4(1.0);\n  c.g = heat + glow;\n  /* PLUG: change (c) */\n}\n");
    effect("struct Mine { float heat, glow; };\n"
           "void PLUG_change(inout vec4 x) { Mine m = Mine(0.25, 0.5); m.heat = m.glow; x.r = "
           "m.heat; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "#define plr_base_heat (c.r + 1.0)");
    CHECK_HAS(r->fragment, "c.g = plr_base_heat + plr_lib_glow;");
    CHECK_HAS(r->fragment, "m.heat = m.glow;");
    char text[64];
    plr_program_demangle(r->program, "plr_base_heat and plr_lib_glow", text, sizeof text);
    CHECK_STR(text, "heat and glow");
    begin();
    base("#define heat 0.5\nout vec4 c;\nvoid main() { c = vec4(heat);\n  /* PLUG: change (c) "
         "*/\n}\n");
    effect("void PLUG_change(inout vec4 x) { float heat = 0.25; x.r = heat; }\n");
    r = link_valid();
    CHECK_HAS(r->fragment, "#define heat 0.5");
}

static void test_macro_in_order(void) {
    begin();
    base(BASE);
    effect("#define V 1.0\n" USE("V"));
    unit("#define V 2.0\n" USE("V"));
    const linked *r = link_valid();
    CHECK_ORDER(r->fragment, "#define plr0_V 1.0", "#undef plr0_V\n#define plr0_V 2.0");
}

/* ---- Other effects, base and library -----------------------------------------------------------
 */

static void test_provider(void) {
    begin();
    base(BASE);
    effect("struct Wave { float height; };\nfloat sea_level() { return 0.5; }\n"
           "void PLUG_change(inout vec4 x) {\n  Wave w = Wave(1.0);\n  /* PLUG: wave (w) */\n"
           "  x.r = w.height;\n}\n");
    effect("struct Wave { float height; };\n"
           "void PLUG_wave(inout Wave w) { w.height += sea_level(); }\n");
    effect("struct Wave { float tall; };\n"
           "void PLUG_change(inout vec4 x) { Wave w = Wave(x.r); x.g = w.tall; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "void plr1_wave(inout plr0_Wave w) { w.height += plr0_sea_level(); }");
    CHECK_LACKS(r->fragment, "plr1_Wave");
    CHECK_HAS(r->fragment, "struct plr2_Wave { float tall; };");
    CHECK_ORDER(r->fragment, "struct plr0_Wave", "void plr1_wave(inout plr0_Wave w);");
    CHECK_SILENT();
}

/* The struct goes on through effects that offer it again. */
static void test_struct_through_chain(void) {
    begin();
    base(BASE);
    effect("struct W { float h; };\nvoid PLUG_change(inout vec4 x) { W w = W(1.0); "
           "/* PLUG: one (w) */ x.r = w.h; }\n");
    effect(
        "struct W { float h; };\nvoid PLUG_one(inout W w) { /* PLUG: two (w) */ w.h *= 2.0; }\n");
    effect(
        "struct W { float h; };\nvoid PLUG_two(inout W w) { /* PLUG: three (w) */ w.h *= 2.0; }\n");
    effect("void PLUG_three(inout W w) { w.h *= 2.0; }\n");
    const linked *r = link_valid();
    CHECK_INT(occurrences(r->fragment, "struct "), 1);
    CHECK_HAS(r->fragment, "void plr3_three(inout plr0_W w)");
    CHECK_SILENT();
}

static void test_base_struct(void) {
    begin();
    base("out vec4 result;\n/* PLUG-DECLARATIONS */\nconst int N = 2;\n#define SIZE N\n"
         "struct Part { float a[SIZE]; };\nstruct Info { Part part; float b; };\nvoid main() {\n"
         "  Info info;\n  info.b = 1.0;\n  /* PLUG: fill (info) */\n  result = vec4(info.b);\n}\n");
    effect("void PLUG_fill(inout Info i) { i.part.a[0] = 1.0; }\n");
    effect("struct Info { Part part; float b; };\nvoid PLUG_fill(inout Info i) { i.b = 2.0; }\n");
    const linked *r = link_valid();
    CHECK_INT(occurrences(r->fragment, "struct Info"), 1);
    CHECK_ORDER(r->fragment, "struct Info", "void plr0_fill(inout Info i);");
    CHECK_HAS(r->fragment, "void plr1_fill(inout Info i)");
    CHECK_SILENT();
}

static void test_library(void) {
    begin();
    base(BASE);
    library("const float HALF = 0.5;\nuniform mat4 plugray_view;\n"
            "float inner(float x) { return x * HALF; }\n"
            "float outer(float x) { return inner(x) + plugray_view[0][0]; }\n"
            "float unused(float x) { return x; }\nuniform float unused_uniform;\n");
    effect("float outer(float x);\nuniform mat4 plugray_view;\n" USE("outer(1.0)"));
    effect(USE("outer(2.0) + plugray_view[1][1]"));
    const linked *r = link_valid();
    CHECK_INT(occurrences(r->fragment, "float outer(float x) {"), 1);
    CHECK_INT(occurrences(r->fragment, "uniform mat4 plugray_view;"), 1);
    CHECK_INT(occurrences(r->fragment, "const float HALF"), 1);
    CHECK_LACKS(r->fragment, "unused");
    CHECK_SILENT();
}

static void test_dead_code(void) {
    static const char dead[] =
        "uniform float gone;\nconst int lost = 1;\nstruct Away { float a; };\n#define NONE lost\n"
        "float never(float x) { return x * gone; }\nfloat twice(float x) { return x * 2.0; }\n"
        "float twice(vec2 x) { return x.x; }\nuniform float a, kept, b;\n" USE("twice(kept)");
    begin();
    base(BASE);
    effect(dead);
    const linked *r = link_valid();
    CHECK_LACKS(r->fragment, "gone");
    CHECK_LACKS(r->fragment, "lost");
    CHECK_LACKS(r->fragment, "Away");
    CHECK_LACKS(r->fragment, "never");
    CHECK_HAS(r->fragment, "uniform float plr0_kept;");
    CHECK_LACKS(r->fragment, "plr0_a");
    CHECK_INT(occurrences(r->fragment, "float plr0_twice("), 2);
    begin();
    base(BASE);
    effect(dead);
    description()->keep_all = true;
    r = link_valid();
    CHECK_HAS(r->fragment, "uniform float plr0_gone;");
    CHECK_HAS(r->fragment, "const int plr0_lost = 1;");
    CHECK_HAS(r->fragment, "#define plr0_NONE plr0_lost");
}

static void test_nobody_calls(void) {
    begin();
    base(BASE);
    description()->known_plugs = &(plr_known_plug){"light_scale", PLR_FRAGMENT};
    description()->known_plug_count = 1;
    effect("uniform float amount;\nvoid PLUG_light_scale(inout float s) { s *= amount; }\n");
    const linked *r = link_valid();
    CHECK_LACKS(r->fragment, "amount");
    CHECK(!plr_program_is_active(r->program, 0));
    CHECK_SILENT();
}

/* ---- Host names --------------------------------------------------------------------------------
 */

static void test_host_names(void) {
    begin();
    base(BASE);
    base_vertex("in vec4 castle_Vertex;\nvoid main() { gl_Position = castle_Vertex; "
                "/* PLUG: place (castle_Vertex) */ }\n");
    library("uniform mat3 castle_NormalMatrix;\nuniform float plugray_time;\n");
    library_vertex("uniform mat3 castle_NormalMatrix;\n");
    for (int i = 0; i < 2; i++) {
        effect(
            "uniform highp mat3 castle_NormalMatrix;\nuniform float plugray_time, mine;\n"
            "uniform vec4 castle_Other;\n" USE("castle_NormalMatrix[0][0] * plugray_time * mine * "
                                               "castle_Other.x"));
        vertex_unit("attribute vec4 castle_Vertex;\nattribute vec3 own;\nvarying float v;\n"
                    "void PLUG_place(vec4 p) { v = castle_Vertex.x + own.x; }\n");
    }
    const linked *r = link_valid();
    CHECK_INT(occurrences(r->fragment, "castle_NormalMatrix;"), 1);
    CHECK_INT(occurrences(r->fragment, "uniform float plugray_time;"), 1);
    CHECK_INT(occurrences(r->fragment, "uniform vec4 castle_Other;"), 1);
    CHECK_HAS(r->fragment, "uniform float plr1_mine;");
    CHECK_INT(occurrences(r->vertex, "in vec4 castle_Vertex;"), 1);
    CHECK_INT(occurrences(r->vertex, "in vec3 own;"), 1);
    CHECK_SILENT();
    bool attribute = false;
    for (size_t i = 0; i < plr_program_symbol_count(r->program); i++) {
        const plr_symbol *symbol = plr_program_symbol(r->program, i);
        attribute |= symbol->kind == PLR_ATTRIBUTE && strcmp(symbol->program, "own") == 0;
    }
    CHECK(attribute);
}

static void test_host_type(void) {
    begin();
    base(BASE);
    library("uniform mat3 castle_NormalMatrix;\n");
    effect("uniform mat4 castle_NormalMatrix;\n" USE("castle_NormalMatrix[0][0]"));
    effect(USE("1.0"));
    const linked *r = link_valid();
    CHECK_SAID("a.frag:1:14: error", "host-type");
    CHECK(plr_program_is_faulty(r->program, 0));
    CHECK_HAS(r->fragment, "plr1_change(c);");
    CHECK_LACKS(r->fragment, "plr0_");
}

/* ---- Built-in functions ------------------------------------------------------------------------
 */

static void test_builtin_overload(void) {
    begin();
    base(BASE);
    effect("float mix(float a) { return a; }\nfloat clamp(float a, float b) { return min(a, b); }\n"
           "void PLUG_change(inout vec4 x) {\n  x.r = mix(x.r) + mix(x.r, x.g, 0.5);\n"
           "  x.g = clamp(x.g, 1.0) + clamp(x.g, 0.0, 1.0);\n}\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "x.r = plr0_mix(x.r) + mix(x.r, x.g, 0.5);");
    CHECK_HAS(r->fragment, "x.g = plr0_clamp(x.g, 1.0) + clamp(x.g, 0.0, 1.0);");
    CHECK_SILENT();
}

/* ---- Declarations ------------------------------------------------------------------------------
 */

static void test_declarations(void) {
    begin();
    base("#version 330 core\n// a comment\nuniform vec4 before;\n/* PLUG-DECLARATIONS */\n"
         "out vec4 c;\nvoid main() { c = before; /* PLUG: change (c) */ }\n");
    effect(USE("1.0"));
    const linked *r = link_valid();
    CHECK_ORDER(r->fragment, "uniform vec4 before;", "void plr0_change(inout vec4 x);");
    CHECK_ORDER(r->fragment, "void plr0_change(inout vec4 x);", "out vec4 c;");
    begin();
    base("#version 330 core\nout vec4 c;\nvoid f(inout vec4 c) { /* PLUG: change (c) */ }\n"
         "/* PLUG-DECLARATIONS */\nvoid main() { c = vec4(1.0); f(c); }\n");
    effect(USE("1.0"));
    link_valid();
    CHECK_SILENT();
}

static void test_array_symbols(void) {
    begin();
    base(BASE);
    effect("const int N = 4;\n#define M 3\nuniform float a[N], b[M], c[2], d;\nuniform vec2[5] e;\n"
           "uniform float f[N + 1];\nuniform float g = 2.0;\n" USE(
               "a[0] + b[0] + c[0] + d + e[0].x + f[0] + g"));
    const linked *r = link_valid();
    static const uint32_t sizes[] = {4, 3, 2, 0, 5, UINT32_MAX, 0};
    size_t at = 0;
    for (size_t i = 0; i < plr_program_symbol_count(r->program); i++) {
        const plr_symbol *symbol = plr_program_symbol(r->program, i);
        if (symbol->effect != 0)
            continue;
        CHECK_INT(symbol->array, sizes[at]);
        CHECK_INT(symbol->initialized, at == 6);
        at++;
    }
    CHECK_INT(at, 7);
}

static void test_blocks(void) {
    begin();
    base(BASE);
    effect("uniform Named { float a; } inst;\nuniform Plain { float b; vec2 c[2]; };\n" USE(
        "inst.a + b + c[0].x"));
    effect("uniform Named { float a; } inst;\n" USE("inst.a"));
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "uniform plr0_Named { float a; } plr0_inst;");
    CHECK_HAS(r->fragment, "uniform plr0_Plain { float plr0_b; vec2 plr0_c[2]; };");
    CHECK_HAS(r->fragment, "float(plr0_inst.a + plr0_b + plr0_c[0].x)");
    CHECK_SILENT();
}

/* A base that has a library's name for itself. */
static void test_base_hides_library(void) {
    begin();
    base("float inner(float x) { return x * 3.0; }\nuniform float plugray_Time;\n"
         "#define weight 4.0\n" BASE);
    library("float inner(float x) { return x * 2.0; }\nuniform float plugray_Time;\n"
            "float outer(float x) { return inner(x) * plugray_Time; }\n");
    effect("void PLUG_change(inout vec4 x) { float weight = 0.5; x *= outer(1.0) + inner(2.0) * "
           "weight; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "{ return plr_lib_inner(x) * plugray_Time; }");
    CHECK_HAS(r->fragment, "float plr0_weight = 0.5; x *= outer(1.0) + inner(2.0) * plr0_weight;");
    CHECK_INT(occurrences(r->fragment, "uniform float plugray_Time;"), 1);
    CHECK_SILENT();
}

/* A complete shader of several units, each of which declares what it uses. */
static void test_base_units(void) {
    begin();
    base("uniform highp mat3 castle_NormalMatrix;\nfloat half_of(float x) { return x * 0.5; }\n");
    base("uniform mat3 castle_NormalMatrix;\nfloat half_of(float x);\nout vec4 c;\n"
         "void main() { c = vec4(half_of(castle_NormalMatrix[0][0])); }\n");
    link_valid();
    CHECK_SILENT();
}

static void test_library_struct(void) {
    begin();
    base(BASE);
    library("struct MaterialInfo { vec3 a; };\nfloat shine(MaterialInfo m) { return m.a.x; }\n");
    effect("struct MaterialInfo { vec3 a; };\nfloat shine(const in MaterialInfo m);\n" USE(
        "shine(MaterialInfo(x.rgb))"));
    const linked *r = link_valid();
    CHECK_INT(occurrences(r->fragment, "struct "), 1);
    CHECK_SILENT();
}

int main(void) {
    test_base_hides_library();
    test_base_units();
    test_library_struct();
    test_isolation();
    test_same_effect_twice();
    test_members_and_keys();
    test_macros();
    test_underscore();
    test_locals();
    test_units_share();
    test_own_unit_first();
    test_shared_helper();
    test_macro_like_member();
    test_macro_in_order();
    test_provider();
    test_struct_through_chain();
    test_base_struct();
    test_library();
    test_dead_code();
    test_nobody_calls();
    test_host_names();
    test_host_type();
    test_builtin_overload();
    test_declarations();
    test_array_symbols();
    test_blocks();
    return finish();
}
