/* Hostile and large input, no memory, the same result each time. */
#include "helper.h"

#include <time.h>

#define BASE                                                                                       \
    "struct S { vec4 a;\n#if READS(b)\n float b;\n#endif\n};\nout vec4 c;\nvoid main()\n{\n"       \
    "  S s;\n  s.a = c = vec4(1.0);\n  /* PLUG: change (c, s) (c) */\n"                            \
    "#if PLUG_USED(change)\n  c += s.a;\n#endif\n}\n"
#define EFFECT                                                                                     \
    "#define M(x) (x)\nuniform float amount, b[2];\nstruct T { float a; };\nfloat noise(vec3 "     \
    "p);\n"                                                                                        \
    "float noise(vec3 p) { return M(p.x) * amount; }\n#ifdef GL_X\nfloat y;\n#endif\n"             \
    "void PLUG_change(inout vec4 x, const in S s) { /* PLUG: own (x) */ x *= s.b * noise(x.rgb); " \
    "}\n"
#define LIBRARY "float helper(float x) { return x; }\nuniform mat4 castle_ModelViewMatrix;\n"

static const char *const broken[] = {
    "e\n#define*",
    "void f()\n#define 3 4\n{ }",
    "",
    "\xEF\xBB\xBF",
    "\\",
    "\\\n",
    "#",
    "#define",
    "#define X(",
    "#if",
    "#ifdef\n#endif",
    "#undef\n#version\n#extension\n#extension a\n#extension a : b c\n#version 1 2 3",
    "/*",
    "/*/",
    "/* PLUG:",
    "/* PLUG: a (",
    "/* PLUG: a (b */",
    "/* PLUG: a (b) (c */ void f() { /* PLUG: a ((((b)) */ }",
    "//",
    "// \\",
    "struct",
    "struct {",
    "struct S",
    "struct S { float",
    "struct S { float a[ } b;",
    "uniform",
    "uniform float",
    "uniform float a,",
    "uniform float a, ;",
    "uniform float a, b c, d",
    "uniform float a[",
    "uniform B {",
    "uniform B { float a; } b",
    "layout",
    "layout(",
    "layout(a = b) in;",
    "void f",
    "void f(",
    "void f()",
    "void f() {",
    "void f() }",
    "void f() ) { }",
    "float a = { b, { c } , ",
    "PLUG_x",
    "PLUG_x(",
    "void PLUG_",
    "void PLUG_() { }",
    "void PLUG_x(,,) { PLUG_x(; PLUG_x(); }",
    "void PLUG_PLUG_x() { PLUG_PLUG_x(); }",
    "x.",
    "1e+",
    "0x",
    "\"a\" 'b' $ @ ` \x80\xff",
    "a b c d e f g ( h",
    "precision",
    ";;;;",
    "}}}}",
    "((((",
    "void f() { /* PLUG: a (b) */ ( /* PLUG: a (b) */ { /* PLUG: a (b) */",
    "#if UNKNOWN\nvoid f() {\n#else\nvoid f() { {\n#endif\n}\n",
    "#if UNKNOWN\nvoid f() {\n#else\n}\n#endif\n} uniform float a;\n#if UNKNOWN\n}\n#endif",
    "void f()\n#if UNKNOWN\n{ }\n#else\n;\n#endif\nvoid g() { }",
    "#if (((((((1)))))))\n#elif ((((\n#endif",
    "#define A B\n#define B A\n#if A\n#endif\n#if defined(\n#endif\n#if defined A B\n#endif",
    "#if PLUG_USED\n#endif\n#if READS(\n#endif\n#if READS(x) READS(y)\n#endif",
    "if (x) /* PLUG: a (b) */ else",
    "void f() { if /* PLUG: change (x) */",
    "void f() { shadow2D(shadow2D(a, shadow2D( ; texture2D texture2D( gl_FragData[ }",
    "#define F(a,a,b c d) a b c\n#define G( a\n",
    "varying",
    "attribute;",
    "in inout in inout const inout a(",
    "float texture; float texture() { texture; texture(texture); }",
};

static void test_broken(void) {
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++)
        for (int as = 0; as < 3; as++) {
            char joined[1024];
            begin();
            snprintf(joined, sizeof joined, "%s\n%s", as == 0 ? broken[i] : BASE,
                     as == 0 ? BASE : "");
            base(joined);
            if (as == 1)
                library(broken[i]);
            effect("void PLUG_change(inout vec4 x) { x *= 0.5; }\n");
            if (as == 2) {
                effect(broken[i]);
                snprintf(joined, sizeof joined, "%s void PLUG_change(inout vec4 x) { }", broken[i]);
                effect(joined);
                snprintf(joined, sizeof joined, "void PLUG_change(inout vec4 x) { %s", broken[i]);
                effect(joined);
            }
            const linked *r = link_all();
            bool sound = as == 0 || (r->program && strstr(r->fragment, "plr0_change(c);"));
            TAP_RESULT(sound, "broken text %d, used as %d", (int)i, as);
            for (uint32_t line = 1;
                 r->program && line <= plr_program_lines(r->program, PLR_FRAGMENT); line++)
                for (uint32_t column = 0; column < 40; column++) {
                    plr_mapped mapped;
                    plr_program_map(r->program, PLR_FRAGMENT, line, column, &mapped);
                }
        }
}

/* Every beginning of a text, as a file that breaks off. */
static void test_truncated(void) {
    static const char text[] = BASE LIBRARY EFFECT;
    char part[sizeof text];
    for (size_t length = 0; length < sizeof text; length++) {
        memcpy(part, text, length);
        part[length] = '\0';
        begin();
        base(BASE);
        effect(part);
        if (!link_all()->program)
            TAP_RESULT(0, "the base stands beside a text of %zu bytes", length);
    }
    CHECK(true);
}

static void describe(void) {
    begin();
    base(BASE);
    library(LIBRARY);
    for (int i = 0; i < 4; i++)
        effect(EFFECT);
    effect("float PLUG_change(inout vec4 x) { return 1.0; }");
    effect("void PLUG_own(inout vec4 x) { x *= helper(1.0) * castle_ModelViewMatrix[0][0]; }");
}

static void test_determinism(void) {
    describe();
    const linked *r = link_valid();
    char *first = malloc(strlen(r->fragment) + 1);
    strcpy(first, r->fragment);
    describe();
    r = link_all();
    CHECK_STR(r->fragment, first);
    free(first);
}

/* ---- No memory ---------------------------------------------------------------------------------
 */

typedef struct counter {
    long left, live;
} counter;

static void *count_reallocate(void *user, void *pointer, size_t size) {
    counter *c = user;
    if (c->left-- <= 0)
        return NULL;
    c->live += pointer == NULL;
    return realloc(pointer, size);
}

static void count_release(void *user, void *pointer) {
    ((counter *)user)->live -= pointer != NULL;
    free(pointer);
}

/* Reads and links with room for that many allocations; true if they were enough. */
static bool link_with(long allocations, long *leaked) {
    counter c = {allocations, 0};
    plr_allocator allocator = {count_reallocate, count_release, &c};
    enum {
        COUNT = 7
    };
    static const struct {
        plr_stage stage;
        const char *text;
    } texts[COUNT] = {
        {PLR_FRAGMENT, BASE},
        {PLR_VERTEX, "in vec4 p;\nout vec3 n;\nvoid main() { n = p.xyz; gl_Position = p; }\n"},
        {PLR_GEOMETRY, "void plugray_varyings_set(const int index);\n"
                       "void geometryVertexSet(const int index) {\n  plugray_varyings_set(index);\n"
                       "  /* PLUG: geometry_vertex_set (index) */\n}\n"},
        {PLR_FRAGMENT, LIBRARY},
        {PLR_FRAGMENT, EFFECT},
        {PLR_GEOMETRY, "layout(triangles) in;\nlayout(points, max_vertices = 1) out;\n"
                       "void main() { geometryVertexSet(0); EmitVertex(); }\n"},
        {PLR_FRAGMENT, "in vec3 n;\nvoid PLUG_change(inout vec4 x) { x.rgb *= n; }\n"},
    };
    plr_break breaks[] = {{2, 3, 4}};
    plr_origin origin = {"file", 1, 1, breaks, 1};
    plr_source *sources[COUNT];
    bool good = true;
    plr_diags *diags = plr_diags_create(&allocator);
    for (int i = 0; i < COUNT; i++) {
        sources[i] = plr_source_read(texts[i].stage, texts[i].text, strlen(texts[i].text), &origin,
                                     &allocator, diags);
        good &= sources[i] != NULL;
    }
    if (good) {
        const plr_source *const *all = (const plr_source *const *)sources;
        plr_effect effects[3] = {{.sources = &all[4], .source_count = 1},
                                 {.sources = &all[4], .source_count = 2},
                                 {.sources = &all[6], .source_count = 1}};
        plr_link_desc desc = {.base = all,
                              .base_count = 3,
                              .library = &all[3],
                              .library_count = 1,
                              .effects = effects,
                              .effect_count = 3,
                              .allocator = &allocator};
        plr_program *program = plr_link(&desc, diags);
        good = program && plr_program_calls(program, NULL, 0) > 0;
        plr_program_destroy(&program);
    }
    for (int i = 0; i < COUNT; i++)
        plr_source_destroy(&sources[i]);
    plr_diags_destroy(&diags);
    *leaked += c.live;
    return good && c.left >= 0;
}

static void test_no_memory(void) {
    long leaked = 0, allocations = 0;
    while (!link_with(allocations, &leaked) && allocations < 10000)
        allocations++;
    CHECK(allocations > 10 && allocations < 10000);
    CHECK_INT(leaked, 0);
}

/* ---- Size --------------------------------------------------------------------------------------
 */

static double seconds(void) {
    return (double)clock() / CLOCKS_PER_SEC;
}

static void test_many_effects(void) {
    enum {
        COUNT = 10000
    };
    static plr_effect effects[COUNT];
    plr_source *source = plr_source_read(PLR_FRAGMENT, EFFECT, sizeof EFFECT - 1, NULL, NULL, NULL);
    for (size_t i = 0; i < COUNT; i++)
        effects[i] = (plr_effect){.sources = (const plr_source *const *)&source, .source_count = 1};
    begin();
    base(BASE);
    description()->effects = effects;
    description()->effect_count = COUNT;
    const linked *r = link_all();
    CHECK_HAS(r->fragment, "plr9999_change(c, s);");
    description()->max_effects = COUNT - 1;
    CHECK(!link_all()->program);
    CHECK_INT(plr_diags_count_of(r->diags, PLR_ERROR), 1);
    description()->max_effects = 0;
    description()->max_text = 100000;
    CHECK(!link_all()->program);
    begin();
    plr_source_destroy(&source);
}

static char *repeated(const char *head, const char *part, size_t count, const char *tail) {
    size_t length = strlen(part);
    char *text = malloc(strlen(head) + length * count + strlen(tail) + 1);
    char *at = stpcpy(text, head);
    for (size_t i = 0; i < count; i++, at += length)
        memcpy(at, part, length);
    strcpy(at, tail);
    return text;
}

/* Texts that are deep or long in one way: the time grows with the text and no more. */
static void test_deep(void) {
    static const char *const rows[][3] = {
        {"void PLUG_change(inout vec4 x) { ", "{ ", ""},
        {"void PLUG_change(inout vec4 x) { x.r = ", "(", ""},
        {"void PLUG_change(inout vec4 x) { x.r = ", "min(", ""},
        {"float min(float a) { return a; }\nvoid PLUG_change(inout vec4 x) { x.r = ", "min(", ""},
        {"void PLUG_change(inout vec4 x) { x = ", "shadow2D(", ""},
        {"", "#if X\n", ""},
        {"#if ", "(", "\n#endif\nvoid PLUG_change(inout vec4 x) { }"},
        {"#if ", "!", "1\n#endif\nvoid PLUG_change(inout vec4 x) { }"},
        {"#if 1", " + 1", "\n#endif\nvoid PLUG_change(inout vec4 x) { }"},
        {"", "#ifdef GL_X\n#endif\n", "void PLUG_change(inout vec4 x) { }"},
        {"void PLUG_change(inout vec4 x) { ", "if (a) ", ";}"},
        {"void PLUG_change(inout vec4 x) { ", "/* PLUG: a (x) */ ", "}"},
        {"void PLUG_change(inout vec4 x) { ", "if (x.r > 0.) /* PLUG: a (x) */ ", ";}\n"},
        {"", "void PLUG_change(inout vec4 x) { }\n", ""},
        {"", "float f(float x) { return f(x); }\n", "void PLUG_change(inout vec4 x) { f(1.); }"},
        {"", "#define M M2\n#undef M\n", "void PLUG_change(inout vec4 x) { x = M; }"},
        {"uniform float a", ", b", ";\nvoid PLUG_change(inout vec4 x) { x *= a; }"},
        {"/* PLUG: a ", "(b, c) ", "*/ void PLUG_change(inout vec4 x) { }"},
        {"void PLUG_change(inout vec4 x) { /* PLUG: a ", "(b, c) ", "*/ }"},
        {"", "/* PLUG: a (b", ""},
        {"", "struct { ", ""},
        {"#define F(", "a,", "b) a\nvoid PLUG_change(inout vec4 x) { }"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char *text = repeated(rows[i][0], rows[i][1], 20000, rows[i][2]);
        begin();
        base("out vec4 c;\nvoid main() { c = vec4(1.0); /* PLUG: change (c) */ }\n");
        effect(text);
        double start = seconds();
        const linked *r = link_all();
        double spent = seconds() - start;
        TAP_RESULT(r->program && spent < 5, "deep text %d is linked in little time", (int)i);
        if (spent > 1)
            printf("# %d: %.2f s\n", (int)i, spent);
        free(text);
    }
}

static void test_struct_chain(void) {
    enum {
        COUNT = 20000
    };
    char *text = malloc((size_t)COUNT * 64), *at = text;
    at += sprintf(at, "struct S0 { float a; };\n");
    for (int i = 1; i < COUNT; i++)
        at += sprintf(at, "struct S%d { S%d a; };\n", i, i - 1);
    sprintf(at, "void PLUG_change(inout vec4 x) { S%d s; }\n", COUNT - 1);
    begin();
    base("out vec4 c;\nvoid main() { c = vec4(1.0); /* PLUG: change (c) */ }\n");
    effect(text);
    const linked *r = link_all();
    CHECK_ORDER(r->fragment, "struct plr0_S19998 ", "struct plr0_S19999 ");
    free(text);
}

static void test_large_source(void) {
    size_t size = ((size_t)64 << 20) + 1;
    char *text = malloc(size);
    memset(text, ' ', size);
    begin();
    plr_source *source =
        plr_source_read(PLR_FRAGMENT, text, size, NULL, NULL, link_result()->diags);
    CHECK(!source);
    CHECK_INT(plr_diags_count_of(link_result()->diags, PLR_ERROR), 1);
    source = plr_source_read(PLR_FRAGMENT, text, size - 1, NULL, NULL, NULL);
    CHECK(source != NULL);
    plr_source_destroy(&source);
    free(text);
}

static void test_twice_the_work(void) {
    double times[2];
    for (int i = 0; i < 2; i++) {
        char *text = repeated("", "float f(float a) { float b = a * 2.0; return b + 1.0; }\n",
                              i ? 40000 : 4000, "");
        double start = seconds();
        plr_source *source = plr_source_read(PLR_FRAGMENT, text, strlen(text), NULL, NULL, NULL);
        times[i] = seconds() - start;
        plr_source_destroy(&source);
        free(text);
    }
    TAP_RESULT(times[1] < 40 * times[0] + 0.1, "reading takes time in proportion");
}

int main(void) {
    test_broken();
    test_truncated();
    test_determinism();
    test_no_memory();
    test_many_effects();
    test_deep();
    test_struct_chain();
    test_large_source();
    test_twice_the_work();
    return finish();
}
