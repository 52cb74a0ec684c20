/* The geometry stage: when it is there, what goes through it. */
#include "helper.h"

static char geometry_base[16384];

static void read_base(void) {
    FILE *file = fopen(SOURCE_ROOT "/effects/surface/surface.geom.glsl", "rb");
    size_t length = file ? fread(geometry_base, 1, sizeof geometry_base - 1, file) : 0;
    geometry_base[length] = '\0';
    CHECK(length > 0);
    if (file)
        fclose(file);
}

#define LAYOUT                                                                                     \
    "#version 150\nlayout(triangles) in;\nlayout(triangle_strip, max_vertices = 3) out;\n"
#define MAIN                                                                                       \
    "void main() {\n  for (int i = 0; i < gl_in.length(); i++) {\n    geometryVertexSet(i);\n"     \
    "    EmitVertex();\n  }\n  EndPrimitive();\n}\n"

/* A base with one varying, and the engine's own geometry unit. */
static void start(void) {
    begin();
    base_vertex("in vec4 place;\nout vec3 normal;\nvoid main() {\n  gl_Position = place;\n"
                "  normal = place.xyz;\n  /* PLUG: move (gl_Position) */\n}\n");
    base_geometry(geometry_base);
    base("in vec3 normal;\nout vec4 result;\nvoid main() {\n  result = vec4(normal, 1.0);\n"
         "  /* PLUG: change (result) */\n}\n");
}

static void test_passing(void) {
    start();
    effect("varying vec2 mine;\nflat in int kind;\nin mat3 turn;\nin vec4 list[2];\n"
           "void PLUG_change(inout vec4 c) { c.rg = mine + float(kind) + turn[0].xy + list[1].xy; "
           "}\n");
    vertex_unit("varying vec2 mine;\nflat out int kind;\nout mat3 turn;\nout vec4 list[2];\n"
                "void PLUG_move(inout vec4 p) { mine = p.xy; kind = 3; turn = mat3(1.0);\n"
                "  list[0] = list[1] = p; }\n");
    effect("varying vec2 mine;\nvoid PLUG_change(inout vec4 c) { c.b = mine.x; }\n");
    vertex_unit("varying vec2 mine;\nvoid PLUG_move(inout vec4 p) { mine = p.yx; }\n");
    geometry_unit(LAYOUT "void geometryVertexSet(const int index);\n" MAIN);
    const linked *r = link_valid();
    CHECK_SILENT();
    CHECK_HAS(r->geometry, "in vec3 normal[];\nout vec3 plr_geo_normal;\n");
    CHECK_HAS(r->geometry, "out vec2 plr_geo_plr0_mine;");
    CHECK_HAS(r->geometry, "out vec2 plr_geo_plr1_mine;");
    CHECK_HAS(r->geometry, "flat in int plr0_kind[];\nflat out int plr_geo_plr0_kind;");
    CHECK_HAS(r->geometry, "in vec4 plr0_list[][2];");
    CHECK_HAS(r->geometry, "plr_geo_normal = normal[index];");
    CHECK_HAS(r->geometry, "void main() {");
    CHECK_LACKS(r->geometry, "geometryVertexAdd");
    CHECK_LACKS(r->geometry, "plugray_varyings_add");
    CHECK_ORDER(r->geometry, "layout(triangles) in;", "plr0_mine[]");
    CHECK_HAS(r->fragment, "in vec3 plr_geo_normal;");
    CHECK_HAS(r->fragment, "vec4(plr_geo_normal, 1.0)");
    CHECK_HAS(r->fragment, "in vec2 plr_geo_plr1_mine;");
    CHECK_HAS(r->vertex, "out vec2 plr1_mine;");
    char text[256];
    plr_program_demangle(r->program, "'plr_geo_plr1_mine' and plr_geo_normal", text, sizeof text);
    CHECK_STR(text, "'mine' and normal");
}

/* What cannot be handed on makes its effect faulty, and nothing else. */
static void test_obstacles(void) {
    static const struct {
        const char *head, *declaration, *set, *get;
        unsigned line, column;
    } rows[] = {
        {"struct S { float a; };\n", " S s;\n", "s.a = 1.0;", "s.a", 2, 6},
        {"", " B { float a; } b;\n", "b.a = 1.0;", "b.a", 1, 4},
        {"const int n = 2;\n", " float s[n + 1];\n", "s[0] = 1.0;", "s[0]", 2, 10},
        {"#ifdef GL_ARB_gpu_shader5\n", " float s;\n#else\n", "s = 1.0;", "s", 2, 10},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char fragment[512], vertex[512], place[64];
        const char *tail = *rows[i].head == '#' ? "float unused;\n#endif\n" : "";
        snprintf(fragment, sizeof fragment,
                 "%sin%s%svoid PLUG_change(inout vec4 c) { c.r = %s; }\n", rows[i].head,
                 rows[i].declaration, tail, rows[i].get);
        snprintf(vertex, sizeof vertex, "%sout%s%svoid PLUG_move(inout vec4 p) { %s }\n",
                 rows[i].head, rows[i].declaration, tail, rows[i].set);
        start();
        effect(fragment);
        vertex_unit(vertex);
        effect("void PLUG_change(inout vec4 c) { c.g = 0.0; }\n");
        geometry_unit(LAYOUT MAIN);
        const linked *r = link_valid();
        snprintf(place, sizeof place, "a.frag:%u:%u: error", rows[i].line, rows[i].column);
        CHECK_SAID(place, "glsl-link");
        CHECK(plr_program_is_faulty(r->program, 0));
        CHECK_HAS(r->fragment, "plr1_change(result);");
        CHECK_HAS(r->geometry, "plr_geo_normal = normal[index];");
    }
}

static void test_primitives(void) {
    static const struct {
        const char *given, *layout;
        bool fits;
    } rows[] = {{NULL, "lines", true},
                {"lines", "lines", true},
                {"lines", "triangles", false},
                {"points", "lines", false},
                {"triangles", "invocations = 1, triangles", true},
                {"triangles", "triangles_adjacency", false}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        for (int complete = 0; complete < 2; complete++) {
            char text[512];
            snprintf(text, sizeof text,
                     "#version 400\nlayout(%s) in;\nlayout(points, max_vertices = 1) out;\n"
                     "void main() { gl_Position = vec4(0.0); EmitVertex(); }\n",
                     rows[i].layout);
            begin();
            base_vertex("void main() { gl_Position = vec4(0.0); }\n");
            base_geometry(complete ? text : geometry_base);
            base("out vec4 c;\nvoid main() { c = vec4(1.0); }\n");
            effect(NULL);
            if (!complete)
                geometry_unit(text);
            description()->primitive = rows[i].given;
            const linked *r = link_all();
            CHECK(!*r->geometry == !rows[i].fits);
            CHECK_INT(
                said(complete ? "base.geom:2:8: error" : "a.geom:2:8: error", "wrong-primitive"),
                !rows[i].fits);
            CHECK(complete || plr_program_is_faulty(r->program, 0) == !rows[i].fits);
        }
}

/* A fault of the effect that brings the stage is told, though there is no stage then. */
static void test_faulty_main(void) {
    start();
    effect(NULL);
    geometry_unit(LAYOUT MAIN "int PLUG_geometry_vertex_set(const int index) { return 1; }\n");
    effect("void PLUG_change(inout vec4 c) { c.r = 0.0; }\n");
    geometry_unit("void PLUG_geometry_vertex_set(const int index) { }\n");
    const linked *r = link_valid();
    CHECK_SAID("a.geom:11:5: error", "plug-not-void");
    CHECK_SAID("b.geom:1:1: warning", "no-main");
    CHECK_INT(plr_diags_count(r->diags), 2);
    CHECK(plr_program_is_faulty(r->program, 0));
    CHECK_STR(r->geometry, "");
}

static void test_size_of_points(void) {
    for (int sized = 0; sized < 2; sized++) {
        start();
        effect(NULL);
        vertex_unit(sized ? "void PLUG_move(inout vec4 p) { gl_PointSize = 4.0; }\n"
                          : "void unused() { gl_PointSize = 4.0; }\n");
        geometry_unit("layout(points) in; layout(points, max_vertices = 1) out;\n"
                      "void main() { geometryVertexSet(0); EmitVertex(); }\n");
        const linked *r = link_valid();
        CHECK_INT(occurrences(r->geometry, "gl_PointSize = gl_in[index].gl_PointSize;"), sized);
        CHECK_SILENT();
    }
}

static void test_blending(void) {
    start();
    effect(NULL);
    geometry_unit(LAYOUT "void geometryVertexZero();\n"
                         "void geometryVertexAdd(const int index, const float scale);\n"
                         "void main() { geometryVertexZero(); geometryVertexAdd(0, 0.5);\n"
                         "  geometryVertexAdd(1, 0.5); EmitVertex(); EndPrimitive(); }\n");
    const linked *r = link_valid();
    CHECK_SILENT();
    CHECK_HAS(r->geometry, "plr_geo_normal = vec3 (0);");
    CHECK_HAS(r->geometry, "plr_geo_normal += normal[index] * scale;");
    CHECK_LACKS(r->geometry, "plugray_varyings_set");
}

/* By hand, in both manners; with a main() of their own, of another effect, and without any. */
static void manner_one(bool own_main) {
    effect("#ifdef HAS_GEOMETRY_SHADER\n#define v v_geoshader\n#endif\nvarying vec4 v;\n"
           "void PLUG_change(inout vec4 c) { c = v; }\n");
    vertex_unit("varying vec4 v;\nvoid PLUG_move(inout vec4 p) { v = p; }\n");
    geometry_unit("in vec4 v[CASTLE_GEOMETRY_INPUT_SIZE];\nout vec4 v_geoshader;\n"
                  "void PLUG_geometry_vertex_set(const int index) { v_geoshader = v[index]; }\n"
                  "void PLUG_geometry_vertex_zero() { v_geoshader = vec4(0.0); }\n"
                  "void PLUG_geometry_vertex_add(const int index, const float scale) {\n"
                  "  v_geoshader += v[index] * scale; }\n");
    if (own_main)
        geometry_unit(LAYOUT "void geometryVertexSet(const int index);\n" MAIN);
}

static void test_by_hand(void) {
    for (int own = 0; own < 2; own++) {
        start();
        manner_one(own);
        if (!own) {
            effect(NULL);
            geometry_unit(LAYOUT MAIN);
        }
        const linked *r = link_valid();
        CHECK_SILENT();
        CHECK_HAS(r->geometry, "out vec4 plr0_v_geoshader;");
        CHECK_HAS(r->geometry, "in vec4 plr0_v[];");
        CHECK_HAS(r->geometry, "    plr0_geometry_vertex_set(index);");
        CHECK_HAS(r->fragment, "#define plr0_v plr0_v_geoshader");
        CHECK_LACKS(r->geometry, "plr_geo_plr0_v");
    }
    start();
    manner_one(false);
    const linked *r = link_valid();
    CHECK_STR(r->geometry, "");
    CHECK_LACKS(r->fragment, "#define");
    CHECK_SAID("a.geom:1:1: warning", "no-main");
    CHECK_INT(plr_diags_count(r->diags), 1);
    start();
    effect("varying vec4 v;\nvoid PLUG_change(inout vec4 c) { c = v; }\n");
    vertex_unit("/* VARYING-PASSTHROUGH-GEOMETRY-SHADERS */\nvarying vec4 v;\n"
                "void PLUG_move(inout vec4 p) { v = p; }\n");
    geometry_unit(LAYOUT MAIN);
    r = link_valid();
    CHECK_SILENT();
    CHECK_HAS(r->geometry, "plr_geo_plr0_v = plr0_v[index];");
}

/* What the author's stage declares itself is used, and its own outputs reach the fragment stage. */
static void test_own_varyings(void) {
    start();
    effect("in float height;\nin vec4 v;\nvoid PLUG_change(inout vec4 c) { c = v * height; }\n");
    vertex_unit("out vec4 v;\nvoid PLUG_move(inout vec4 p) { v = p; }\n");
    geometry_unit(LAYOUT "in vec4 v[];\nout float height;\nin vec3 normal[];\n"
                         "void main() {\n  for (int i = 0; i < 3; i++) {\n    height = v[i].y;\n"
                         "    geometryVertexSet(i);\n    EmitVertex();\n  }\n}\n");
    const linked *r = link_valid();
    CHECK_SILENT();
    CHECK_INT(occurrences(r->geometry, "in vec4 plr0_v[];"), 1);
    CHECK_HAS(r->geometry, "out float plr0_height;");
    CHECK_HAS(r->fragment, "in float plr0_height;");
    CHECK_HAS(r->geometry, "plr_geo_plr0_v = plr0_v[index];");
    CHECK_INT(occurrences(r->geometry, "in vec3 normal[];"), 1);
}

static void test_old_words(void) {
    start();
    effect(NULL);
    geometry_unit(
        "#version 120\n#extension GL_EXT_geometry_shader4 : enable\n"
        "layout(triangles) in; layout(points, max_vertices = 3) out;\n"
        "void main() { for (int i = 0; i < gl_VerticesIn; i++) {\n"
        "  geometryVertexSet(i); gl_Position = gl_PositionIn[i + 0]; EmitVertex(); } }\n");
    const linked *r = link_valid();
    CHECK_SILENT();
    CHECK_HAS(r->geometry, "gl_Position = gl_in[i + 0].gl_Position;");
    CHECK_HAS(r->geometry, "i < gl_in.length()");
    CHECK_LACKS(r->geometry, "#extension");
}

static void test_two_mains(void) {
    start();
    effect(NULL);
    geometry_unit(LAYOUT MAIN);
    effect("void PLUG_change(inout vec4 c) { c.r = 0.0; }\n");
    geometry_unit(LAYOUT MAIN);
    const linked *r = link_valid();
    CHECK_SAID("b.geom:4:6: error", "reserved-name");
    CHECK_SAID("a.geom:4:6: note", "reserved-name");
    CHECK(plr_program_is_faulty(r->program, 1));
    CHECK_INT(occurrences(r->geometry, "void main"), 1);
}

/* main() in text that is not there, or in a comment, is none. */
static void test_no_main(void) {
    static const char *const texts[] = {
        LAYOUT "/* main() */\nvoid PLUG_geometry_vertex_set(const int i) { }\n",
        LAYOUT "#ifdef NOTHING\n" MAIN "#endif\n",
        LAYOUT "void main();\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        start();
        effect("#ifdef HAS_GEOMETRY_SHADER\n#error\n#endif\n"
               "void PLUG_change(inout vec4 c) { c.r = 0.0; }\n");
        geometry_unit(texts[i]);
        effect(NULL);
        geometry_unit(texts[i]);
        const linked *r = link_valid();
        CHECK_STR(r->geometry, "");
        CHECK_SAID("a.geom:1:1: warning", "no-main");
        CHECK_INT(plr_diags_count(r->diags), 1);
        CHECK_LACKS(r->fragment, "#error");
    }
}

static void test_base_without(void) {
    begin();
    base("out vec4 c;\nvoid main() {\n  c = vec4(1.0);\n  /* PLUG: change (c) */\n}\n");
    effect("void PLUG_change(inout vec4 c) { c.r = 0.0; }\n");
    geometry_unit("\n  " LAYOUT MAIN);
    vertex_unit("void PLUG_move(inout vec4 p) { }\n");
    const linked *r = link_valid();
    CHECK_SAID("a.geom:2:3: warning", "wrong-stage");
    CHECK_SAID("a.vert:1:1: warning", "wrong-stage");
    CHECK_INT(plr_diags_count(r->diags), 2);
}

/* A complete shader brings its own stage: nothing of the engine's is needed. */
static void test_complete_shader(void) {
    begin();
    base_vertex("in vec4 place;\nout vec4 v;\nvoid main() { gl_Position = v = place; }\n");
    base_geometry(LAYOUT "in vec4 v[];\nout vec4 w;\nvoid main() {\n"
                         "  for (int i = 0; i < 3; i++) {\n    w = v[i];\n"
                         "    gl_Position = gl_in[i].gl_Position;\n    /* PLUG: emit (i) */\n"
                         "    EmitVertex();\n  }\n}\n");
    base("in vec4 w;\nout vec4 c;\nvoid main() {\n  c = w;\n  /* PLUG: change (c) */\n}\n");
    effect("in float f;\nvoid PLUG_change(inout vec4 c) { c.r = f; }\n");
    geometry_unit("out float f;\nvoid PLUG_emit(const in int index) { f = float(index); }\n");
    const linked *r = link_valid();
    CHECK_SILENT();
    CHECK_HAS(r->geometry, "    plr0_emit(i);\n");
    CHECK_HAS(r->fragment, "in float plr0_f;");
}

int main(void) {
    read_base();
    test_passing();
    test_obstacles();
    test_primitives();
    test_faulty_main();
    test_size_of_points();
    test_blending();
    test_by_hand();
    test_own_varyings();
    test_old_words();
    test_two_mains();
    test_no_main();
    test_base_without();
    test_complete_shader();
    return finish();
}
