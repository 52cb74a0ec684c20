/* Segment numbers as whole numbers: from volumes, and as textures that shaders read exactly. */
#include "volume_test.h"

#include "engine/texture.h"
#include "engine/volume_blocks.h"
#include "engine/volume_label_cells.h"
#include "triangle.h"

static plr_volume make_volume(plr_voxel_type type, uint32_t count, uint32_t components,
                              const void *voxels) {
    plr_volume v = {.size = {count, 1, 1}, .components = components, .type = type, .slope = 1};
    size_t bytes = count * components * plr_voxel_size(type);
    v.voxels = malloc(bytes);
    memcpy(v.voxels, voxels, bytes);
    return v;
}

static const plr_place place = {"scene.x3d", 4, 5};

/* ---- From volumes ---- */

static void check_labels(plr_volume v, uint32_t component, plr_sample_type type,
                         const uint32_t *expected, const char *name) {
    plr_image image;
    plr_diags *diags = plr_diags_create(NULL);
    bool fine = plr_volume_to_labels(&v, component, place, &image, diags) && image.type == type &&
                image.components == 1 && image.width == v.size[0] && image.height == 1 &&
                image.depth == 1 && plr_diags_count(diags) == 0;
    for (uint32_t i = 0; fine && i < v.size[0]; i++)
        fine = plr_image_sample(&image, i, 0, 0, 0) == expected[i];
    TAP_RESULT(fine, "%s", name);
    plr_image_free(&image);
    plr_diags_destroy(&diags);
    plr_volume_free(&v);
}

static void test_types(void) {
    check_labels(make_volume(PLR_VOXEL_U8, 3, 1, "\0\7\xff"), 0, PLR_UINT8,
                 (const uint32_t[]){0, 7, 255}, "bytes");
    check_labels(make_volume(PLR_VOXEL_S16, 3, 1, (const int16_t[]){0, 12, 255}), 0, PLR_UINT8,
                 (const uint32_t[]){0, 12, 255}, "16 bits that fit 8");
    check_labels(make_volume(PLR_VOXEL_U16, 3, 1, (const uint16_t[]){256, 257, 65535}), 0,
                 PLR_UINT16, (const uint32_t[]){256, 257, 65535}, "16 bits");
    check_labels(make_volume(PLR_VOXEL_S32, 2, 1, (const int32_t[]){65536, INT32_MAX}), 0,
                 PLR_UINT32, (const uint32_t[]){65536, INT32_MAX}, "signed 32 bits");
    check_labels(make_volume(PLR_VOXEL_U64, 2, 1, (const uint64_t[]){1, UINT32_MAX}), 0, PLR_UINT32,
                 (const uint32_t[]){1, UINT32_MAX}, "64 bits, all that 32 can hold");
    check_labels(make_volume(PLR_VOXEL_F32, 2, 1, (const float[]){3, 2035}), 0, PLR_UINT16,
                 (const uint32_t[]){3, 2035}, "whole floats");
    check_labels(make_volume(PLR_VOXEL_U8, 2, 2, "\1\2\3\4"), 1, PLR_UINT8,
                 (const uint32_t[]){2, 4}, "the second component");
    plr_volume scaled = make_volume(PLR_VOXEL_U8, 2, 1, "\1\2");
    scaled.slope = 0.5;
    scaled.intercept = -3;
    check_labels(scaled, 0, PLR_UINT8, (const uint32_t[]){1, 2}, "stored values, never rescaled");
    plr_volume one = make_volume(PLR_VOXEL_U8, 1, 1, "\1");
    plr_image image;
    CHECK(!plr_volume_to_labels(&one, 1, place, &image, NULL) && !image.samples);
    CHECK(!plr_volume_to_labels(NULL, 0, place, &image, NULL) && !image.samples);
    plr_volume_free(&one);
}

static void check_odd(plr_volume v, const uint32_t *expected, const char *message) {
    plr_image image;
    plr_diags *diags = plr_diags_create(NULL);
    CHECK(plr_volume_to_labels(&v, 0, place, &image, diags));
    bool same = true;
    for (uint32_t i = 0; i < v.size[0]; i++)
        same = same && plr_image_sample(&image, i, 0, 0, 0) == expected[i];
    CHECK(same && plr_diags_count(diags) == 1);
    CHECK_STR(diag_text(diags, 0), message);
    plr_image_free(&image);
    plr_diags_destroy(&diags);
    plr_volume_free(&v);
}

static void test_odd_numbers(void) {
    check_odd(make_volume(PLR_VOXEL_S16, 3, 1, (const int16_t[]){-1, 5, -300}),
              (const uint32_t[]){0, 5, 0},
              "scene.x3d:4:5 warning 2 segment numbers are below 0 or beyond 32 bits; 0 is taken "
              "for them");
    check_odd(make_volume(PLR_VOXEL_F32, 3, 1, (const float[]){2.5f, 1.25f, 4}),
              (const uint32_t[]){3, 1, 4},
              "scene.x3d:4:5 warning 2 segment numbers are not whole; they are rounded");
    check_odd(make_volume(PLR_VOXEL_F64, 4, 1, (const double[]){NAN, INFINITY, 4294967296., 9}),
              (const uint32_t[]){0, 0, 0, 9},
              "scene.x3d:4:5 warning 3 segment numbers are below 0 or beyond 32 bits; 0 is taken "
              "for them");
}

/* ---- As textures ---- */

/* Whether the shader finds `expected` at the upper column's centre of a texture of two labels. */
static const char labels_fragment[] =
    "#version 330 core\n"
    "uniform usampler3D labels;\n"
    "uniform vec4 color;\n"
    "out vec4 result;\n"
    "void main() {\n"
    "    uint low = uint(color.x) + uint(color.y) * 65536u;\n"
    "    bool near = texture(labels, vec3(0.74, 0.5, 0.5)).r == low &&\n"
    "                texelFetch(labels, ivec3(1, 0, 0), 0).r == low &&\n"
    "                texture(labels, vec3(0.49, 0.5, 0.5)).r == 1u;\n"
    "    result = near ? color : vec4(-1.0);\n"
    "}\n";

static GLuint labels_program(const plr_gl *gl) {
    GLuint program = gl->CreateProgram();
    GLuint vertex = triangle_compile(gl, GL_VERTEX_SHADER, triangle_vertex);
    GLuint fragment = triangle_compile(gl, GL_FRAGMENT_SHADER, labels_fragment);
    gl->AttachShader(program, vertex);
    gl->AttachShader(program, fragment);
    gl->LinkProgram(program);
    gl->DeleteShader(vertex);
    gl->DeleteShader(fragment);
    return program;
}

static void check_upload(const plr_gl *gl, uint32_t label, plr_texture_use use) {
    jmp_buf out_of_memory;
    plr_arena arena;
    plr_arena_init(&arena, NULL, &out_of_memory);
    plr_textures textures = {.arena = &arena, .gl = gl};
    plr_volume v = make_volume(PLR_VOXEL_U32, 2, 1, (const uint32_t[]){1, label});
    plr_image image;
    float pixels[TRIANGLE_SIZE * TRIANGLE_SIZE * 4] = {0};
    const float color[4] = {(float)(label & 65535), (float)(label >> 16), 0, 1};
    plr_framebuffer framebuffer;
    bool fine = plr_volume_to_labels(&v, 0, place, &image, NULL) &&
                plr_framebuffer_create(&framebuffer, gl, TRIANGLE_SIZE, TRIANGLE_SIZE, NULL);
    plr_texture *texture = plr_textures_make(&textures, &image, PLR_TEXTURE_3D_LABELS, true);
    fine = plr_textures_upload(&textures) && plr_texture_dimensions(texture) == 3 && fine;
    GLuint program = labels_program(gl);
    plr_texture_bind(&textures, texture, 0, use);
    plr_framebuffer_bind(&framebuffer);
    triangle_draw(gl, program, color);
    fine = plr_framebuffer_read(&framebuffer, pixels) && triangle_is(pixels, color) && fine;
    TAP_RESULT(fine && gl->GetError() == GL_NO_ERROR, "the label %u is read exactly", label);
    gl->DeleteProgram(program);
    plr_framebuffer_destroy(&framebuffer);
    plr_textures_finish(&textures);
    plr_arena_finish(&arena);
    plr_volume_free(&v);
}

static void test_uploads(void) {
    plr_gl gl;
    plr_context *context = plr_context_create(PLR_BACKEND_AUTO, NULL);
    if (!context || plr_gl_load(&gl, plr_context_get_proc_address, context)) {
        TAP_SKIP("labels as textures", "no GL here");
    } else {
        check_upload(&gl, 200, PLR_USE_CLAMPED);
        check_upload(&gl, 65535, PLR_USE_VOLUME);
        check_upload(&gl, 16777217, PLR_USE_CLAMPED);
        check_upload(&gl, 4294967295u, PLR_USE_SURFACE);
    }
    plr_context_destroy(&context);
}

/* ---- Cells and blocks ---- */

static uint32_t label_at(const plr_image *image, int x, int y, int z) {
    const int size[3] = {(int)image->width, (int)image->height, (int)image->depth};
    int at[3] = {x, y, z};
    for (int i = 0; i < 3; i++)
        at[i] = at[i] < 0 ? 0 : at[i] < size[i] ? at[i] : size[i] - 1;
    return (uint32_t)plr_image_sample(image, (uint32_t)at[0], (uint32_t)at[1], (uint32_t)at[2], 0);
}

/* What cell i has in common, where cells lie behind voxels. */
static uint32_t common_label(const plr_image *image, const int cell[3]) {
    uint32_t first = label_at(image, cell[0], cell[1], cell[2]);
    bool same = first < PLR_LABELS_DIFFER;
    for (int i = 1; i < 8; i++)
        same = same && label_at(image, cell[0] + (i & 1), cell[1] + (i >> 1 & 1),
                                cell[2] + (i >> 2)) == first;
    return same ? first : PLR_LABELS_DIFFER;
}

/* Which labels a block of 4 x 4 x 4 cells reaches; cell c lies between voxels c - 1 and c. */
static uint64_t block_labels(const plr_image *image, const int block[3]) {
    uint64_t found = 0;
    for (int z = 4 * block[2] - 1; z <= 4 * block[2] + 3; z++)
        for (int y = 4 * block[1] - 1; y <= 4 * block[1] + 3; y++)
            for (int x = 4 * block[0] - 1; x <= 4 * block[0] + 3; x++) {
                uint32_t label = label_at(image, x, y, z);
                found |= UINT64_C(1) << (label < 63 ? label : 63);
            }
    return found;
}

static void check_cells(plr_arena *arena, const plr_image *labels, const char *name) {
    plr_image cells = plr_label_cells(arena, labels);
    const uint8_t *at = cells.samples;
    size_t wrong = 0;
    for (int z = 0; z < (int)cells.depth; z++)
        for (int y = 0; y < (int)cells.height; y++)
            for (int x = 0; x < (int)cells.width; x++)
                wrong += *at++ != common_label(labels, (int[]){x, y, z});
    CHECK_INT(cells.width, labels->width > 1 ? labels->width - 1 : 1);
    TAP_RESULT(wrong == 0, "%s: labels that cells have in common", name);
    plr_image_free(&cells);
    plr_blocks blocks = {
        .cells = 4,
        .size = {(labels->width + 4) / 4, (labels->height + 4) / 4, (labels->depth + 4) / 4}};
    plr_blocks_add_labels(arena, &blocks, labels);
    size_t i = wrong = 0;
    uint64_t all = 0;
    for (uint32_t z = 0; z < blocks.size[2]; z++)
        for (uint32_t y = 0; y < blocks.size[1]; y++)
            for (uint32_t x = 0; x < blocks.size[0]; x++, i++) {
                wrong += blocks.labels[i] != block_labels(labels, (int[]){(int)x, (int)y, (int)z});
                all |= blocks.labels[i];
            }
    TAP_RESULT(wrong == 0 && blocks.all_labels == all, "%s: labels of blocks", name);
}

static void test_cells(void) {
    static const struct {
        const char *name;
        plr_sample_type type;
        uint32_t size[3], labels;
    } cases[] = {{"few", PLR_UINT8, {9, 6, 7}, 2},     {"one voxel", PLR_UINT8, {1, 1, 1}, 3},
                 {"a row", PLR_UINT8, {1, 13, 1}, 2},  {"up to 255", PLR_UINT8, {6, 5, 4}, 256},
                 {"many", PLR_UINT16, {5, 8, 3}, 300}, {"one, large", PLR_UINT32, {4, 4, 4}, 1}};
    jmp_buf out_of_memory;
    plr_arena arena;
    plr_arena_init(&arena, NULL, &out_of_memory);
    if (setjmp(out_of_memory))
        return;
    uint32_t seed = 7;
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        plr_image image = {.width = cases[c].size[0],
                           .height = cases[c].size[1],
                           .depth = cases[c].size[2],
                           .components = 1,
                           .type = cases[c].type};
        size_t count = (size_t)image.width * image.height * image.depth;
        image.samples = calloc(count, 4);
        for (size_t i = 0; image.samples && i < count; i++) {
            seed = seed * 1664525 + 1013904223;
            /* regions of three and two, so that cells have something in common */
            uint32_t label =
                (seed >> 16) % 4 ? (uint32_t)(i / 3 % 2) : (seed >> 20) % cases[c].labels;
            if (image.type == PLR_UINT8)
                ((uint8_t *)image.samples)[i] = (uint8_t)label;
            else if (image.type == PLR_UINT16)
                ((uint16_t *)image.samples)[i] = (uint16_t)label;
            else
                ((uint32_t *)image.samples)[i] = 100000;
        }
        check_cells(&arena, &image, cases[c].name);
        plr_image_free(&image);
    }
    plr_arena_finish(&arena);
}

int main(void) {
    test_cells();
    test_types();
    test_odd_numbers();
    test_uploads();
    return tap_done();
}
