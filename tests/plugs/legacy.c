/* Old GLSL in a program of the core profile. */
#include "helper.h"

#define BASE                                                                                       \
    "uniform sampler2D tex;\nvarying vec4 coord;\nvoid main()\n{\n  vec4 c = texture2D(tex, "      \
    "coord.xy);\n"                                                                                 \
    "  /* PLUG: change (c, tex) (c) */\n  gl_FragColor = c;\n}\n"

static char host_text[65536], legacy_text[65536];

static void read_file(const char *name, char *text, size_t size) {
    char path[1024];
    snprintf(path, sizeof path, "%s/effects/library/%s", SOURCE_ROOT, name);
    FILE *file = fopen(path, "rb");
    size_t length = file ? fread(text, 1, size - 1, file) : 0;
    text[length] = '\0';
    CHECK(length > 0);
    if (file)
        fclose(file);
}

static void test_storage(void) {
    begin();
    base("varying vec3 v;\n" BASE);
    base_vertex("attribute vec4 place;\nvarying vec3 v;\nvarying vec4 coord;\n"
                "void main() { v = place.xyz; coord = place; gl_Position = place; }\n");
    effect("varying vec3 v;\nvoid PLUG_change(inout vec4 c) { c.rgb *= v; }\n");
    const linked *r = link_all();
    CHECK_HAS(r->vertex, "in vec4 place;");
    CHECK_HAS(r->vertex, "out vec4 coord;");
    CHECK_HAS(r->fragment, "in vec4 coord;");
    CHECK_HAS(r->fragment, "in vec3 plr0_v;");
    CHECK_HAS(r->fragment, "out vec4 plr_FragColor;\n");
    CHECK_HAS(r->fragment, "  plr_FragColor = c;\n");
    CHECK_SILENT();
}

static void test_textures(void) {
    static const char *const calls[] = {
        "texture2D(tex, x.xy)",
        "texture2D(tex, x.xy, 0.5)",
        "texture2DProj(tex, x.xyz)",
        "texture2DProj(tex, x)",
        "texture2DLod(tex, x.xy, 0.0)",
        "texture2DProjLod(tex, x, 0.0)",
        "texture2DGradARB(tex, x.xy, x.xy, x.zw)",
        "texture3D(volume, x.xyz)",
        "textureCube(cube, x.xyz)",
        "textureCubeLod(cube, x.xyz, 0.0)",
        "texture1D(line, x.x)",
        "texture2DRect(rect, x.xy)",
        "shadow2D(shadow, x.xyz)",
        "shadow2D(shadow, x.xyz).rrrr",
        "vec4(shadow2DProj(shadow, x).r)",
        "shadow2D(shadow, shadow2D(shadow, x.xyz).xyz)",
        "TEX(x.xy)",
        "vec4(PROJ(x))",
    };
    for (size_t i = 0; i < sizeof calls / sizeof calls[0]; i++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "#define TEX(c) texture2D(tex, c)\n#define PROJ(c) shadow2DProj(shadow, c).r\n"
                 "uniform sampler2D tex;\nuniform sampler3D volume;\nuniform samplerCube cube;\n"
                 "uniform sampler1D line;\nuniform sampler2DRect rect;\n"
                 "uniform sampler2DShadow shadow;\nvoid PLUG_change(inout vec4 x) { x += %s; }\n",
                 calls[i]);
        begin();
        base(BASE);
        effect(text);
        link_valid();
        CHECK_SILENT();
    }
}

/* A parameter or variable whose name became a built-in function or a reserved word. */
static void test_new_words(void) {
    begin();
    base(BASE);
    effect("uniform sampler2D sample;\nuniform float filter;\nstruct S { float common; };\n"
           "vec4 look(sampler2D texture, vec2 uv) { return texture2D(texture, uv); }\n"
           "float smooth(float active) { return active * active; }\n"
           "void PLUG_change(inout vec4 x, const in sampler2D texture) {\n"
           "  float input = filter, output, partition[2];\n  output = smooth(input);\n"
           "  partition[0] = output;\n  S s = S(1.0);\n  s.common = partition[0];\n"
           "  x = look(texture, x.xy) * texture2D(sample, x.xy) * s.common;\n}\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "uniform sampler2D plr0_sample;");
    CHECK_HAS(r->fragment, "return texture(plr_texture, uv);");
    CHECK_SILENT();
    bool found = false;
    for (size_t i = 0; i < plr_program_symbol_count(r->program); i++) {
        const plr_symbol *symbol = plr_program_symbol(r->program, i);
        found |= strcmp(symbol->name, "sample") == 0 && strcmp(symbol->program, "plr0_sample") == 0;
    }
    CHECK(found);
    begin();
    base("uniform sampler2D texture;\nuniform float filter;\nvarying vec2 uv;\n"
         "void main() { gl_FragColor = texture2D(texture, uv) * filter; }\n");
    r = link_valid();
    CHECK_HAS(r->fragment, "plr_FragColor = texture(plr_texture, uv) * plr_filter;");
    CHECK_STR(plr_program_symbol(r->program, 0)->name, "texture");
    CHECK_STR(plr_program_symbol(r->program, 0)->program, "plr_texture");
}

static void test_qualifiers(void) {
    begin();
    base(BASE);
    effect(
        "float f(in inout float a, inout in float b, const in float c) { a = b + c; return a; }\n"
        "void PLUG_change(const inout vec4 x) { float a = 1.0; x *= f(a, a, 1.0); }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "float plr0_f( inout float a, inout float b, const in float c)");
    CHECK_SILENT();
}

static void test_dialects(void) {
    begin();
    base(BASE);
    effect(
        "#version 130\nfloat table[3] = float[3](1.0, 2.0, 3.0);\nuniform highp mat3 m;\n"
        "void PLUG_change(inout vec4 x) {\n  float other[2] = float[](1.0, 2.0);\n"
        "  x.r = table[1] + other[0] + m[0][0] + texture2D(t, x.xy).r;\n}\nuniform sampler2D t;\n");
    const linked *r = link_all();
    CHECK_HAS(r->fragment, "float plr0_table[3] = float[3](1.0, 2.0, 3.0);");
    begin();
    base(BASE);
    effect("vec4 texture2D(float a) { return vec4(a); }\n"
           "void PLUG_change(inout vec4 x) { x = texture2D(1.0); }\n");
    r = link_valid();
    CHECK_HAS(r->fragment, "x = plr0_texture2D(1.0);");
}

static void test_data(void) {
    begin();
    base("void main() { gl_FragData[0] = vec4(1.0); gl_FragData[2] = vec4(0.5); }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->fragment, "out vec4 plr_FragData[3];");
    CHECK_INT(plr_program_symbol_count(r->program), 1);
    CHECK_INT(plr_program_symbol(r->program, 0)->array, 3);
}

static void test_fixed_function(void) {
    begin();
    library(host_text);
    library(legacy_text);
    library_vertex(host_text);
    library_vertex(legacy_text);
    base_vertex("varying vec3 n;\nvoid main()\n{\n  gl_TexCoord[0] = gl_TextureMatrix[0] * "
                "gl_MultiTexCoord0;\n  n = gl_NormalMatrix * gl_Normal;\n"
                "  gl_FrontColor = gl_Color;\n  gl_Position = ftransform() + "
                "gl_ModelViewProjectionMatrix * gl_Vertex + gl_ModelViewMatrix * gl_Vertex;\n}\n");
    base("varying vec3 n;\nvoid main() { gl_FragColor = gl_Color * n.z + gl_TexCoord[0]; }\n");
    const linked *r = link_valid();
    CHECK_HAS(r->vertex, "plugray_ftransform() +");
    CHECK_HAS(r->vertex, "in vec4 castle_Vertex;");
    CHECK_HAS(r->vertex, "out vec4 plugray_TexCoord[8];");
    CHECK_HAS(r->fragment, "in vec4 plugray_TexCoord[8];");
    CHECK_LACKS(r->vertex, "gl_Vertex");
    CHECK_LACKS(r->vertex, "castle_MultiTexCoord1");
    CHECK_SILENT();
    char text[256];
    plr_program_demangle(r->program, "'plugray_ftransform' and plr_FragColor", text, sizeof text);
    CHECK_STR(text, "'ftransform' and gl_FragColor");
}

int main(void) {
    read_file("host.glsl", host_text, sizeof host_text);
    read_file("legacy.glsl", legacy_text, sizeof legacy_text);
    test_storage();
    test_textures();
    test_new_words();
    test_qualifiers();
    test_dialects();
    test_data();
    test_fixed_function();
    return finish();
}
