/* Volumes brought down, levels that scenes give, and the window of volume nodes. */
#include "volume_test.h"

static plr_image make_image(uint32_t w, uint32_t h, uint32_t d, uint32_t components,
                            plr_sample_type type, const void *samples) {
    plr_image image = {.width = w, .height = h, .depth = d, .components = components, .type = type};
    size_t bytes = plr_image_level_samples(&image, 0) * plr_image_sample_size(type);
    image.samples = malloc(bytes);
    memcpy(image.samples, samples, bytes);
    return image;
}

static bool has(const plr_image *image, uint32_t w, uint32_t h, uint32_t d, const double *values) {
    bool same = image->width == w && image->height == h && image->depth == d;
    for (uint32_t z = 0; same && z < d; z++)
        for (uint32_t y = 0; y < h; y++)
            for (uint32_t x = 0; x < w; x++)
                for (uint32_t c = 0; c < image->components; c++)
                    same = same && fabs(plr_image_sample(image, x, y, z, c) - *values++) < 1e-6;
    return same;
}

/* ---- How small ---- */

static void check_factors(uint32_t w, uint32_t h, uint32_t d, uint32_t side, size_t bytes,
                          uint32_t x, uint32_t y, uint32_t z) {
    plr_image image = {.width = w, .height = h, .depth = d, .components = 1, .type = PLR_FLOAT32};
    uint32_t f[3];
    plr_image_reduction(&image, side, bytes, f);
    TAP_RESULT(f[0] == x && f[1] == y && f[2] == z, "%u x %u x %u by %u x %u x %u", w, h, d, f[0],
               f[1], f[2]);
}

static void test_factors(void) {
    check_factors(256, 256, 256, 0, 0, 1, 1, 1);
    check_factors(2048, 256, 2049, 2048, 0, 1, 1, 2);
    check_factors(4097, 1, 1, 2048, 0, 4, 1, 1);
    check_factors(256, 256, 256, 2048, 256 * 256 * 256 * 4, 1, 1, 1);
    check_factors(256, 256, 256, 2048, 256 * 256 * 256 * 4 - 1, 2, 2, 2);
    check_factors(256, 256, 1, 0, 65536, 2, 2, 1);
    check_factors(3, 1, 1, 0, 1, 4, 1, 1);
    check_factors(1, 1, 1, 0, 1, 1, 1, 1);
}

/* ---- Values ---- */

static void test_values(void) {
    const uint32_t twice[3] = {2, 2, 2}, across[3] = {2, 1, 1}, none[3] = {1, 1, 1};
    plr_image cube = make_image(2, 2, 2, 1, PLR_FLOAT32, (const float[]){0, 1, 2, 3, 4, 5, 6, 7});
    CHECK(plr_image_reduce(&cube, none) && cube.width == 2);
    CHECK(plr_image_reduce(&cube, twice) && has(&cube, 1, 1, 1, (const double[]){3.5}));
    plr_image_free(&cube);
    plr_image words = make_image(4, 1, 1, 1, PLR_UNORM16, (const uint16_t[]){0, 2, 65535, 65534});
    CHECK(plr_image_reduce(&words, across));
    CHECK(has(&words, 2, 1, 1, (const double[]){1 / 65535., 1}) && words.type == PLR_UNORM16);
    plr_image_free(&words);
    plr_image bytes = make_image(2, 1, 1, 2, PLR_UNORM8, (const uint8_t[]){0, 100, 2, 200});
    CHECK(plr_image_reduce(&bytes, across));
    CHECK(has(&bytes, 1, 1, 1, (const double[]){1 / 255., 150 / 255.}));
    plr_image_free(&bytes);
    /* five voxels in three cells of 1 2/3: parts of voxels count in part, the box stays */
    plr_image five = make_image(5, 1, 1, 1, PLR_FLOAT32, (const float[]){1, 2, 3, 4, 5});
    CHECK(plr_image_reduce(&five, across));
    CHECK(has(&five, 3, 1, 1, (const double[]){(1 + 2 * 2 / 3.) * 0.6, 3, (5 + 4 * 2 / 3.) * 0.6}));
    plr_image_free(&five);
    plr_image tall = make_image(1, 2, 3, 1, PLR_FLOAT32, (const float[]){1, 2, 3, 4, 5, 6});
    const uint32_t deep[3] = {1, 1, 4};
    CHECK(plr_image_reduce(&tall, deep) && has(&tall, 1, 2, 1, (const double[]){3, 4}));
    plr_image_free(&tall);
}

/* The mean of all stays, whatever the sizes. */
static void test_mean(void) {
    enum {
        SIDE = 13
    };
    float samples[SIDE * SIDE * SIDE];
    double sum = 0, after = 0;
    for (int i = 0; i < SIDE * SIDE * SIDE; i++)
        sum += (double)(samples[i] = (float)(i * 7919 % 1000) / 1000);
    plr_image image = make_image(SIDE, SIDE, SIDE, 1, PLR_FLOAT32, samples);
    CHECK(plr_image_reduce(&image, (const uint32_t[]){2, 4, 8}));
    CHECK(image.width == 7 && image.height == 4 && image.depth == 2);
    for (size_t i = 0; i < 7 * 4 * 2; i++)
        after += (double)((const float *)image.samples)[i];
    CHECK_NEAR(after / (7 * 4 * 2), sum / (SIDE * SIDE * SIDE), 1e-6);
    plr_image_free(&image);
}

/* ---- Labels ---- */

static void test_labels(void) {
    const uint32_t twice[3] = {2, 2, 2}, across[3] = {2, 1, 1};
    plr_image cube =
        make_image(2, 2, 2, 1, PLR_UINT16, (const uint16_t[]){1, 300, 300, 2, 2, 300, 1, 7});
    CHECK(plr_image_reduce(&cube, twice) && has(&cube, 1, 1, 1, (const double[]){300}));
    plr_image_free(&cube);
    /* never a number between; of as many, the first */
    plr_image row = make_image(5, 1, 1, 1, PLR_UINT8, (const uint8_t[]){9, 9, 0, 4, 4});
    CHECK(plr_image_reduce(&row, across) && has(&row, 3, 1, 1, (const double[]){9, 0, 4}));
    plr_image_free(&row);
    plr_image wide =
        make_image(4, 2, 1, 1, PLR_UINT32, (const uint32_t[]){70000, 1, 5, 5, 70000, 1, 6, 6});
    CHECK(plr_image_reduce(&wide, (const uint32_t[]){2, 2, 1}));
    CHECK(has(&wide, 2, 1, 1, (const double[]){70000, 5}));
    plr_image_free(&wide);
    plr_image many =
        make_image(9, 1, 1, 1, PLR_UINT8, (const uint8_t[]){1, 1, 1, 2, 3, 3, 3, 3, 3});
    CHECK(plr_image_reduce(&many, (const uint32_t[]){16, 1, 1}));
    CHECK(many.width == 1 && many.samples != NULL);
    plr_image_free(&many);
}

/* ---- Scenes ---- */

static plr_scene *read_scene(const char *text, plr_diags *diags) {
    char all[2048];
    snprintf(all, sizeof all, "#X3D V4.0 utf8\nPROFILE Full\nDEF V %s\n", text);
    return plr_scene_parse(all, strlen(all), "scene.x3dv", NULL, diags);
}

static void check_range(const char *node, double low, double high) {
    plr_scene *scene = read_scene(node, NULL);
    double range[2] = {-1, -1};
    plr_volume_node_range(plr_scene_find(scene, "V"), range);
    TAP_RESULT(range[0] == low && range[1] == high, "%s", node);
    plr_scene_destroy(&scene);
}

static void test_range(void) {
    check_range("VolumeData { }", 0, 0);
    check_range("VolumeData { windowCenter 40 }", 0, 0);
    check_range("VolumeData { windowCenter 40 windowWidth 400 }", -160, 240);
    check_range("IsoSurfaceVolumeData { windowWidth 1 }", -0.5, 0.5);
    check_range("SegmentedVolumeData { windowCenter 40 windowWidth 400 valueRange 5 9 }", 5, 9);
    check_range("SegmentedVolumeData { windowCenter 40 windowWidth 400 valueRange 5 5 }", -160,
                240);
    check_range("Group { }", 0, 0);
}

static void check_levels(const char *levels, const char *message) {
    char text[1024];
    plr_diags *diags = plr_diags_create(NULL);
    snprintf(text, sizeof text, "VolumeData {\nvoxelLevels [ %s ] }", levels);
    plr_scene *scene = read_scene(text, diags);
    const plr_volume finest = {.size = {5, 2, 1}, .components = 1};
    plr_volume_check_levels(scene, plr_scene_find(scene, "V"), &finest, diags);
    CHECK_STR(diag_text(diags, 0), message);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_levels(void) {
    check_levels("", "(none)");
    check_levels("PixelTexture3D { image [ 1 2 1 1 0 0 ] }\n"
                 "PixelTexture3D { image [ 1 1 1 1 0 ] }",
                 "(none)");
    check_levels("PixelTexture3D { image [ 1 3 1 1 0 0 0 ] }\n"
                 "PixelTexture3D { image [ 1 2 1 1 0 0 ] }",
                 "(none)");
    check_levels("PixelTexture3D { image [ 1 3 1 1 0 0 0 ] }\n"
                 "PixelTexture3D { image [ 1 3 1 1 0 0 0 ] }",
                 "scene.x3dv:5:1 warning level 2 of the voxels is 3 x 1 x 1 with 1 components, not "
                 "half of 3 x 1 x 1 with 1");
    check_levels(
        "PixelTexture3D { image [ 2 3 1 1 0 0 0 ] }",
        "scene.x3dv:4:15 warning level 1 of the voxels is 3 x 1 x 1 with 2 components, not "
        "half of 5 x 2 x 1 with 1");
    CHECK_INT(plr_volume_fitting_level(1, 100), 0);
    CHECK_INT(plr_volume_fitting_level(4, 0.5), 0);
    CHECK_INT(plr_volume_fitting_level(4, 1.99), 0);
    CHECK_INT(plr_volume_fitting_level(4, 2), 1);
    CHECK_INT(plr_volume_fitting_level(4, 7), 2);
    CHECK_INT(plr_volume_fitting_level(4, 1e9), 3);
    CHECK_INT(plr_volume_fitting_level(0, 8), 0);
}

/* The limit of bytes is the host's. */
static void check_limit(size_t bytes, const char *message) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = read_scene(
        "VolumeData { voxels PixelTexture3D { image [ 1 2 2 2 1 2 3 4 5 6 7 8 ] } }", diags);
    const plr_view_desc desc = {.max_voxel_bytes = bytes};
    plr_view *view = plr_view_create(NULL, scene, &desc, diags);
    CHECK_STR(diag_text(diags, 0), message);
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_limit(void) {
    check_limit(0, "(none)");
    check_limit(16, "(none)");
    check_limit(15, "scene.x3dv:3:7 warning 2 x 2 x 2 voxels are more than can be held here; they "
                    "are brought down by 2 x 2 x 2");
}

int main(void) {
    test_limit();
    test_factors();
    test_values();
    test_mean();
    test_labels();
    test_range();
    test_levels();
    return tap_done();
}
