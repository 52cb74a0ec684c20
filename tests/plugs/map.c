/* The map: program positions to the author's, compilers' words to the author's. */
#include "helper.h"

static const char base_text[] = "#version 330 core\n"
                                "uniform vec4 color; out vec4 result;\n"
                                "/* PLUG-DECLARATIONS */\n"
                                "void main()\n"
                                "{\n"
                                "  vec4 c = color; /* a comment */ c.r = 1.0;\n"
                                "  /* PLUG: change (c) */\n"
                                "  result = c;\n"
                                "}\n";
static const char effect_text[] = "uniform float amount; // how much\n"
                                  "float noise(vec3 p)\n"
                                  "{\n"
                                  "  return p.x * \\\n"
                                  "    amount;\n"
                                  "}\n"
                                  "void PLUG_change(inout vec4 x)\n"
                                  "{\n"
                                  "  x.rgb = noise(x.rgb) * noise(x.bgr) * vec3(1.0);\n"
                                  "}\n";

static uint32_t line_of(const char *text, const char *part, uint32_t *column) {
    const char *at = strstr(text, part), *start = at;
    uint32_t line = 1;
    if (!at)
        return 0;
    for (const char *c = text; c < at; c++)
        line += *c == '\n';
    while (start > text && start[-1] != '\n')
        start--;
    *column = (uint32_t)(at - start) + 1;
    return line;
}

static void check_place(const char *part, uint32_t skip, const char *expected) {
    const linked *r = link_result();
    uint32_t column = 0, line = line_of(r->fragment, part, &column);
    plr_mapped mapped;
    bool found = plr_program_map(r->program, PLR_FRAGMENT, line, column + skip, &mapped);
    char place[64];
    snprintf(place, sizeof place, "%s:%u:%u", mapped.place.file ? mapped.place.file : "-",
             (unsigned)mapped.place.line, (unsigned)mapped.place.column);
    CHECK(found);
    CHECK_STR(place, expected);
}

static void test_columns(void) {
    begin();
    base(base_text);
    effect(effect_text);
    link_valid();
    check_place("uniform vec4 color", 0, "base.frag:2:1");
    check_place("out vec4 result", 4, "base.frag:2:25");
    check_place("c.r = 1.0", 0, "base.frag:6:35");
    check_place("c.r = 1.0", 6, "base.frag:6:41");
    check_place("uniform float plr0_amount", 16, "a.frag:1:15");
    check_place("return p.x", 7, "a.frag:4:10");
    check_place("    plr0_amount;", 4, "a.frag:5:5");
    check_place("= plr0_noise(x.rgb)", 2, "a.frag:9:11");
    check_place("= plr0_noise(x.rgb)", 13, "a.frag:9:17");
    check_place("* plr0_noise(x.bgr)", 13, "a.frag:9:32");
    check_place("vec3(1.0)", 5, "a.frag:9:46");
    check_place("#version", 0, "-:0:0");
    check_place("void plr0_change(inout vec4 x);", 5, "a.frag:7:6");
    check_place("void plr0_change(inout vec4 x);", 17, "a.frag:7:18");
}

static void test_socket_call(void) {
    const linked *r = link_result();
    uint32_t column, line = line_of(r->fragment, "plr0_change(c);", &column);
    for (uint32_t at = 0; at < 12; at++) {
        plr_mapped mapped;
        CHECK(plr_program_map(r->program, PLR_FRAGMENT, line, at, &mapped));
        CHECK(mapped.socket_call && mapped.effect == 0);
        CHECK_INT(mapped.place.line * 100 + mapped.place.column, 717);
        CHECK_STR(mapped.place.file, "a.frag");
        CHECK_STR(mapped.plug_place.file, "base.frag");
        CHECK_INT(mapped.plug_place.line * 100 + mapped.plug_place.column, 703);
    }
}

/* Every line that is not the linker's own leads to a source, and no position is refused. */
static void test_complete(void) {
    const linked *r = link_result();
    uint32_t lines = plr_program_lines(r->program, PLR_FRAGMENT), own = 0, written = 0;
    for (const char *at = r->fragment; *at; at++)
        written += *at == '\n';
    CHECK_INT(lines, written);
    for (uint32_t line = 1; line <= lines; line++) {
        plr_mapped mapped;
        if (!plr_program_map(r->program, PLR_FRAGMENT, line, 0, &mapped))
            TAP_RESULT(0, "line %u of the program is mapped", (unsigned)line);
        own += mapped.source == NULL;
    }
    CHECK_INT(own, 4); /* #version and the empty lines before three functions */
    plr_mapped mapped;
    CHECK(!plr_program_map(r->program, PLR_FRAGMENT, 0, 1, &mapped));
    CHECK(!plr_program_map(r->program, PLR_FRAGMENT, lines + 1, 1, &mapped));
    CHECK(!plr_program_map(r->program, PLR_VERTEX, 1, 1, &mapped));
    CHECK(plr_program_map(r->program, PLR_FRAGMENT, 2, 9999, &mapped));
}

static void check_demangled(const char *message, const char *expected) {
    char text[256];
    size_t length = plr_program_demangle(link_result()->program, message, text, sizeof text);
    CHECK_STR(text, expected);
    CHECK_INT(length, strlen(expected));
}

static void test_demangle(void) {
    check_demangled("'plr0_noise' : no matching overloaded function found",
                    "'noise' : no matching overloaded function found");
    check_demangled("plr0_change(vf4;", "PLUG_change(vf4;");
    check_demangled("plr0_amount plr1_amount plr0_none xplr0_noise",
                    "amount plr1_amount plr0_none xplr0_noise");
    char small[4];
    CHECK_INT(plr_program_demangle(link_result()->program, "plr0_noise", small, sizeof small), 5);
    CHECK_STR(small, "noi");
    CHECK_INT(plr_program_demangle(link_result()->program, "plr0_noise", NULL, 0), 5);
}

static void test_find_word(void) {
    const linked *r = link_result();
    uint32_t column = 0, line = line_of(r->fragment, "  x.rgb = plr0_noise", &column);
    CHECK_INT(plr_program_find_word(r->program, PLR_FRAGMENT, line, "noise", 5), 11);
    CHECK_INT(plr_program_find_word(r->program, PLR_FRAGMENT, line, "plr0_noise", 10), 11);
    CHECK_INT(plr_program_find_word(r->program, PLR_FRAGMENT, line, "x", 1), 3);
    CHECK_INT(plr_program_find_word(r->program, PLR_FRAGMENT, line, "rg", 2), 0);
    CHECK_INT(plr_program_find_word(r->program, PLR_FRAGMENT, line, "=", 1), 9);
    CHECK_INT(plr_program_find_word(r->program, PLR_FRAGMENT, 999, "x", 1), 0);
}

/* A text inside a scene file, with an escape in the middle. */
static void test_breaks(void) {
    static const char text[] = "void PLUG_change(inout vec4 x)\n{ x.r = 0.5 < x.g ? 1.0 : 0.0; }\n"
                               "float PLUG_change(float y) { return y; }\n";
    const size_t escape = (size_t)(strchr(text, '<') - text);
    plr_break breaks[] = {{escape + 1, 41, 17 + 12 + 4}};
    plr_origin origin = {"scene.x3d", 40, 17, breaks, 1};
    plr_source *source = plr_source_read(PLR_FRAGMENT, text, sizeof text - 1, &origin, NULL, NULL);
    const plr_source *units[] = {source};
    begin();
    base(base_text);
    plr_effect *e = effect(NULL);
    e->sources = units;
    e->source_count = 1;
    link_all();
    CHECK_SAID("scene.x3d:42:7: error", "plug-not-void");
    for (size_t i = 0; i < sizeof text - 1; i++) {
        /* plr_origin_place walks the text; the source must agree with it */
        plr_place place = plr_origin_place(&origin, text, i);
        if (i == escape + 1)
            CHECK_INT(place.column, 33);
    }
    begin();
    plr_source_destroy(&source);
}

int main(void) {
    test_columns();
    test_socket_call();
    test_complete();
    test_demangle();
    test_find_word();
    test_breaks();
    return finish();
}
