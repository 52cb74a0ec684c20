/* Textures from nodes, as far as no GL is needed: kinds, alpha, limits, images in other forms. */
#include "volume_test.h"

#include "engine/image_internal.h"
#include "engine/texture_internal.h"

typedef struct fixture {
    plr_arena arena;
    jmp_buf out_of_memory;
    plr_scene *scene;
    plr_diags *diags;
    plr_textures textures;
} fixture;

/* A scene whose first node is a Shape with the texture T. */
static void set_up(fixture *f, const char *texture) {
    char text[4096];
    snprintf(
        text, sizeof text,
        "#X3D V4.0 utf8\nPROFILE Full\nShape { appearance Appearance {\ntexture DEF T %s } }\n",
        texture);
    memset(f, 0, sizeof *f);
    f->diags = plr_diags_create(NULL);
    f->scene = plr_scene_parse(text, strlen(text), "scene.x3dv", NULL, f->diags);
    plr_arena_init(&f->arena, NULL, &f->out_of_memory);
    f->textures = (plr_textures){.arena = &f->arena, .scene = f->scene, .diags = f->diags};
}

static plr_texture *texture_of(fixture *f) {
    return plr_textures_get(&f->textures, plr_scene_find(f->scene, "T"));
}

static void tear_down(fixture *f) {
    plr_textures_finish(&f->textures);
    plr_arena_finish(&f->arena);
    plr_scene_destroy(&f->scene);
    plr_diags_destroy(&f->diags);
}

/* ---- kinds ---- */

static void test_kinds(void) {
    static const struct {
        const char *node;
        plr_texture_kind kind;
        int dimensions;
        bool generated, depth;
        uint32_t width, height;
    } cases[] = {
        {"PixelTexture { image 2 1 1 0 0 }", PLR_TEXTURE_2D, 2, false, false, 2, 1},
        {"PixelTexture3D { image [1 2 3 1 0 0 0 0 0 0] }", PLR_TEXTURE_3D, 3, false, false, 2, 3},
        {"ComposedCubeMapTexture { }", PLR_TEXTURE_CUBE, 6, false, false, 1, 1},
        {"ImageCubeMapTexture { load FALSE url \"a\" }", PLR_TEXTURE_CUBE, 6, false, false, 1, 1},
        {"RenderedTexture { dimensions [ 40 30 4 ] }", PLR_TEXTURE_2D, 2, true, false, 40, 30},
        {"RenderedTexture { dimensions [ 0 999999 ] }", PLR_TEXTURE_2D, 2, true, false, 1, 16384},
        {"RenderedTexture { dimensions [ ] }", PLR_TEXTURE_2D, 2, true, false, 128, 128},
        {"GeneratedCubeMapTexture { size 64 }", PLR_TEXTURE_CUBE, 6, true, false, 64, 64},
        {"GeneratedShadowMap { size 64 }", PLR_TEXTURE_2D_SHADOW, 2, true, true, 64, 64},
        {"GeneratedShadowMap { light PointLight { } }", PLR_TEXTURE_CUBE_SHADOW, 6, true, true, 128,
         128},
        {"GeneratedShadowMap { compareMode \"NONE\" }", PLR_TEXTURE_2D, 2, true, true, 128, 128},
        {"GeneratedShadowMap { light PointLight { } compareMode \"NONE\" }", PLR_TEXTURE_CUBE, 6,
         true, true, 128, 128},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fixture f;
        set_up(&f, cases[i].node);
        const plr_texture *t = texture_of(&f);
        TAP_RESULT(t && t->kind == cases[i].kind && t->generated == cases[i].generated &&
                       plr_texture_dimensions(t) == cases[i].dimensions &&
                       t->depth == cases[i].depth && t->width == cases[i].width &&
                       t->height == cases[i].height && t == texture_of(&f),
                   "%s", cases[i].node);
        tear_down(&f);
    }
    fixture f;
    set_up(&f, "ShaderTexture { }");
    CHECK(!texture_of(&f));
    tear_down(&f);
    set_up(&f, "MultiTexture { }");
    CHECK(!texture_of(&f));
    tear_down(&f);
}

/* ---- alpha ---- */

static void test_alpha(void) {
    static const struct {
        const char *fields;
        plr_texture_alpha alpha;
    } cases[] = {
        {"image 2 1 3 1 2", PLR_ALPHA_OPAQUE},
        {"image 2 1 4 0xff 0x1ff", PLR_ALPHA_OPAQUE},
        {"image 2 1 4 0xff 0x100", PLR_ALPHA_TEST},
        {"image 2 1 2 0xff 0x100", PLR_ALPHA_TEST},
        {"image 2 1 4 0xff 0x180", PLR_ALPHA_BLENDING},
        {"image 3 1 4 0xff 0x1fe 0x100", PLR_ALPHA_BLENDING},
        {"image 2 1 4 0xff 0x180 alphaChannel \"TEST\"", PLR_ALPHA_TEST},
        {"image 2 1 4 0xff 0x180 alphaChannel \"NONE\"", PLR_ALPHA_OPAQUE},
        {"image 2 1 4 0xff 0x100 alphaChannel \"BLENDING\"", PLR_ALPHA_BLENDING},
        {"image 2 1 4 0xff 0x100 alphaChannel \"AUTO\"", PLR_ALPHA_TEST},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fixture f;
        char node[256];
        snprintf(node, sizeof node, "PixelTexture { %s }", cases[i].fields);
        set_up(&f, node);
        const plr_texture *t = texture_of(&f);
        TAP_RESULT(t && t->alpha == cases[i].alpha, "%s", node);
        tear_down(&f);
    }
}

/* ---- limits ---- */

static void test_memory(void) {
    fixture f;
    set_up(&f, "PixelTexture { image 4 4 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 }");
    f.textures.max_bytes = 32;
    CHECK(!texture_of(&f)->failed && f.textures.bytes == 32);
    plr_textures_reload(&f.textures, texture_of(&f));
    CHECK(!texture_of(&f)->failed && f.textures.bytes == 32);
    tear_down(&f);
    set_up(&f, "PixelTexture { image 4 4 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 }");
    f.textures.max_bytes = 31;
    plr_texture *t = texture_of(&f);
    CHECK(t->failed && t->width == 1 && t->components == 4 && f.textures.bytes == 0);
    CHECK_STR(diag_text(f.diags, 0),
              "scene.x3dv:4:15 error the textures of the scene need more than "
              "0 MiB; this one is left out");
    tear_down(&f);
    set_up(&f, "GeneratedCubeMapTexture { size 16384 }");
    t = texture_of(&f);
    CHECK(t->failed && t->width == 1 && t->height == 1);
    CHECK_INT(plr_diags_count(f.diags), 1);
    tear_down(&f);
}

static void test_shrink(void) {
    static const uint8_t texels[] = {10, 20, 30, 40, 50, 110, 120, 130, 140, 150};
    plr_image image = {.width = 5, .height = 2, .depth = 1, .components = 1};
    image.samples = malloc(sizeof texels);
    memcpy(image.samples, texels, sizeof texels);
    /* two texels of 5 each: the first two columns, the last three; both rows */
    CHECK(plr_image_shrink(&image, (const uint32_t[]){2, 1, 1}));
    CHECK(image.width == 2 && image.height == 1);
    CHECK(((const uint8_t *)image.samples)[0] == 65 && ((const uint8_t *)image.samples)[1] == 90);
    plr_image_free(&image);
}

static void test_convert(void) {
    const uint8_t texels[] = {51, 102};
    uint16_t wide[4];
    float rgba[4];
    uint8_t l;
    plr_image la = {.width = 1, .height = 1, .depth = 1, .components = 2};
    la.samples = (void *)texels;
    plr_image_convert(&la, 4, PLR_UNORM16, wide);
    CHECK(wide[0] == 51 * 257 && wide[1] == wide[0] && wide[2] == wide[0] && wide[3] == 102 * 257);
    la.components = 1;
    plr_image_convert(&la, 4, PLR_FLOAT32, rgba);
    CHECK(rgba[0] == 0.2f && rgba[2] == 0.2f && rgba[3] == 1);
    plr_image_convert(&la, 1, PLR_UNORM8, &l);
    CHECK(l == 51);
}

/* ---- DDS ---- */

static void put(unsigned char *bytes, size_t at, uint32_t value) {
    for (size_t i = 0; i < 4; i++)
        bytes[at + i] = (unsigned char)(value >> (8 * i));
}

/* Grey of 8 bits, by default two by two. */
static void make_dds(unsigned char *bytes) {
    memset(bytes, 0, 256);
    memcpy(bytes, "DDS ", 4);
    put(bytes, 4, 124);
    put(bytes, 12, 2);
    put(bytes, 16, 2);
    put(bytes, 76, 32);
    put(bytes, 80, 0x20000);
    put(bytes, 88, 8);
    put(bytes, 92, 0xff);
}

static void test_dds_faults(void) {
    static const struct {
        const char *what;
        size_t at[4];
        uint32_t values[4];
        size_t length;
        const char *fault;
    } cases[] = {
        {"as it should be", {0}, {0}, 132, NULL},
        {"cut off in the header", {0}, {0}, 127, "it is cut off"},
        {"cut off in the texels", {0}, {0}, 131, "it is cut off"},
        {"no width", {16}, {0}, 132, "its sizes cannot be right"},
        {"too wide", {16}, {0xffffffff}, 132, "it is too large"},
        {"more than there is", {12, 16}, {32768, 32768}, 132, "it is cut off"},
        {"a volume of no depth", {112, 24}, {0x200000, 0}, 132, "its sizes cannot be right"},
        {"a deep volume", {112, 24, 16, 12}, {0x200000, 32768, 32768, 32768}, 132, "it is cut off"},
        {"a cube that is none", {112, 16}, {0xfe00, 1}, 132, "its sizes cannot be right"},
        {"12 bits", {88}, {12}, 132, "its texels have neither 8, 16, 24 nor 32 bits"},
        {"no colours", {80}, {8}, 132, "its texels are neither colours nor grey"},
        {"BC7",
         {80, 84, 128},
         {4, 0x30315844, 98},
         160,
         "its format of texels is not read (BC6H, BC7, signed, ...)"},
        {"unknown letters",
         {80, 84},
         {4, 0x20202020},
         132,
         "its format of texels is not read (BC6H, BC7, signed, ...)"},
        {"a long header that is cut off", {80, 84}, {4, 0x30315844}, 140, "it is cut off"},
        {"a mask of holes", {92}, {0xa5}, 132, NULL},
        {"no mask", {92}, {0}, 132, NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        unsigned char bytes[256];
        make_dds(bytes);
        for (size_t k = 0; k < 4 && cases[i].at[k]; k++)
            put(bytes, cases[i].at[k], cases[i].values[k]);
        char *exact = malloc(cases[i].length); /* so that no byte is read beyond */
        memcpy(exact, bytes, cases[i].length);
        plr_image image = {0};
        const char *fault = plr_image_decode_dds(exact, cases[i].length, &image);
        bool as_said = cases[i].fault ? fault && strcmp(fault, cases[i].fault) == 0 : !fault;
        TAP_RESULT(as_said && (!fault == !!image.samples), "DDS: %s", cases[i].what);
        plr_image_free(&image);
        free(exact);
    }
}

int main(void) {
    test_kinds();
    test_alpha();
    test_memory();
    test_shrink();
    test_convert();
    test_dds_faults();
    return tap_done();
}
