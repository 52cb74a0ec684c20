/* Who reads and writes members. */
#include "helper.h"

/* "effect@line:column r|w" for each use in the fragment stage. */
static void check_uses(const char *name, const char *expected) {
    const linked *r = link_valid();
    plr_member_use uses[32];
    char text[2048] = "";
    size_t count = plr_program_member_uses(r->program, PLR_FRAGMENT, name, uses, 32);
    CHECK_INT(plr_program_member_uses(r->program, PLR_FRAGMENT, name, NULL, 0), (long)count);
    for (size_t i = 0; i < count && i < 32; i++) {
        size_t length = strlen(text);
        snprintf(text + length, sizeof text - length, "%d@%u:%u %c\n", (int)uses[i].at.effect,
                 (unsigned)uses[i].at.place.line, (unsigned)uses[i].at.place.column,
                 uses[i].written ? 'w' : 'r');
    }
    CHECK_STR(text, expected);
}

#define BASE                                                                                       \
    "#version 330 core\n"                                                                          \
    "struct Sample { vec4 value; vec3 normal; };\n"                                                \
    "out vec4 o;\n"                                                                                \
    "void main() {\n"                                                                              \
    "    Sample s;\n"                                                                              \
    "    s.value = vec4(1.5, 2., .5e1, 1.e0);\n"                                                   \
    "    s.normal = vec3(0.0);\n"                                                                  \
    "    vec4 c = s.value;\n"                                                                      \
    "    /* PLUG: shade (c, s) */\n"                                                               \
    "    o = c;\n"                                                                                 \
    "}\n"

static void test_uses(void) {
    begin();
    base(BASE);
    effect("void PLUG_shade(inout vec4 c, const in Sample s) {\n"
           "    c.rgb *= s.normal; // s.normal\n"
           "}\n");
    effect("void PLUG_shade(inout vec4 c, Sample s) {\n"
           "    s . /* here */ normal = vec3(1.0); s.normal.x = 2.0;\n"
           "    if (s.normal == vec3(0.0)) c = vec4(0.0);\n"
           "    s.normal += 1.0; float normal = s.value.x; c.x = normal;\n"
           "}\n");
    check_uses("normal", "-1@7:7 w\n0@2:16 r\n1@2:20 w\n1@2:42 w\n1@3:11 r\n1@4:7 r\n");
    check_uses("value", "-1@6:7 w\n-1@8:16 r\n1@4:39 r\n");
    check_uses("e0", "");
    check_uses("5e1", "");
    check_uses("x", "1@2:49 w\n1@4:45 r\n1@4:50 w\n");
    check_uses("nothing", "");
    check_uses("", "");
    plr_member_use use;
    CHECK_INT(plr_program_member_uses(link_result()->program, PLR_VERTEX, "value", &use, 1), 0);
    CHECK_INT(plr_program_member_uses(link_result()->program, PLR_STAGE_COUNT, "value", &use, 1),
              0);
}

/* Arguments at a plug are read by who offers it. */
static void test_arguments(void) {
    begin();
    base(BASE);
    effect("void PLUG_shade(inout vec4 c, const in Sample s) {\n"
           "    /* PLUG: light (c, s.normal) */\n"
           "}\n");
    effect("void PLUG_light(inout vec4 c, vec3 normal) { c.rgb *= normal; }\n");
    effect("void PLUG_light(inout vec4 c, vec3 normal) { c.rgb += normal; }\n");
    check_uses("normal", "-1@7:7 w\n0@2:5 r\n0@2:5 r\n");
}

/* What is left out reads nothing. */
static void test_unreached(void) {
    begin();
    base(BASE);
    effect("float unused(Sample s) { return s.normal.x; }\n"
           "void PLUG_shade(inout vec4 c, const in Sample s) { c.a = 1.0; }\n");
    check_uses("normal", "-1@7:7 w\n");
}

int main(void) {
    test_uses();
    test_arguments();
    test_unreached();
    return finish();
}
