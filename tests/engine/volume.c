/* Volumes as texture samples, gradients, and the real files of the shared data folder. */
#include "volume_test.h"

#include <time.h>

/* A volume of w x h x d zeros. */
static plr_volume make_volume(plr_voxel_type type, uint32_t w, uint32_t h, uint32_t d) {
    plr_volume v = {.size = {w, h, d}, .components = 1, .type = type, .slope = 1};
    v.voxels = calloc((size_t)w * h * d, plr_voxel_size(type));
    return v;
}

static const double as_said[2] = {0, 0};

/* ---- samples ---- */

static void test_bytes(void) {
    plr_volume v = make_volume(PLR_VOXEL_U8, 256, 1, 1);
    plr_image image;
    for (int i = 0; i < 256; i++)
        ((uint8_t *)v.voxels)[i] = (uint8_t)i;
    plr_volume_set_range(&v, NAN, NAN);
    CHECK(plr_volume_to_image(&v, as_said, &image));
    CHECK(image.type == PLR_UNORM16 && image.width == 256 && image.depth == 1);
    bool exact = true;
    for (uint32_t i = 0; i < 256; i++)
        exact = exact && ((uint16_t *)image.samples)[i] == i * 257 &&
                plr_image_sample(&image, i, 0, 0, 0) == i / 255.0;
    CHECK(exact);
    plr_image_free(&image);
    /* another range: floats */
    CHECK(plr_volume_to_image(&v, (const double[2]){100, 200}, &image));
    CHECK(image.type == PLR_FLOAT32);
    CHECK(plr_image_sample(&image, 100, 0, 0, 0) == 0 &&
          plr_image_sample(&image, 200, 0, 0, 0) == 1 &&
          plr_image_sample(&image, 150, 0, 0, 0) == 0.5);
    CHECK(plr_image_sample(&image, 0, 0, 0, 0) == 0 && plr_image_sample(&image, 255, 0, 0, 0) == 1);
    plr_image_free(&image);
    plr_volume_free(&v);
    CHECK(!plr_volume_to_image(NULL, as_said, &image) && !image.samples);
    CHECK(!plr_volume_to_image(&v, as_said, &image));
}

/* All 65536 values keep their difference: 1/65535 within half of that. */
static void test_words(void) {
    plr_volume v = make_volume(PLR_VOXEL_U16, 256, 256, 1);
    plr_image image;
    for (int i = 0; i < 65536; i++)
        ((uint16_t *)v.voxels)[i] = (uint16_t)i;
    plr_volume_set_range(&v, NAN, NAN);
    CHECK(plr_volume_to_image(&v, as_said, &image));
    double worst = 0;
    for (uint32_t i = 0; i < 65536; i++)
        worst = fmax(worst, fabs(plr_image_sample(&image, i % 256, i / 256, 0, 0) - i / 65535.0));
    CHECK_NEAR(worst, 0, 6e-8);
    CHECK(plr_image_sample(&image, 255, 255, 0, 0) == 1);
    plr_image_free(&image);
    plr_volume_free(&v);
}

static void test_physical_range(void) {
    plr_volume v = make_volume(PLR_VOXEL_S16, 3, 1, 1);
    plr_image image;
    memcpy(v.voxels, (const int16_t[]){0, 500, 1000}, 6);
    v.slope = -2;
    v.intercept = 100;
    plr_volume_set_range(&v, NAN, NAN);
    CHECK(v.minimum == -1900 && v.maximum == 100);
    CHECK(plr_volume_to_image(&v, as_said, &image));
    CHECK(plr_image_sample(&image, 0, 0, 0, 0) == 1 &&
          plr_image_sample(&image, 1, 0, 0, 0) == 0.5 && plr_image_sample(&image, 2, 0, 0, 0) == 0);
    plr_image_free(&image);
    CHECK(plr_volume_to_image(&v, (const double[2]){-900, 1100}, &image));
    CHECK_NEAR(plr_image_sample(&image, 0, 0, 0, 0), 0.5, 1e-7);
    CHECK(plr_image_sample(&image, 2, 0, 0, 0) == 0);
    plr_image_free(&image);
    plr_volume_free(&v);
}

static void test_not_finite(void) {
    plr_volume v = make_volume(PLR_VOXEL_F32, 5, 1, 1);
    plr_image image;
    const float values[] = {NAN, INFINITY, -INFINITY, 2, 6};
    memcpy(v.voxels, values, sizeof values);
    plr_volume_set_range(&v, NAN, NAN);
    CHECK(v.minimum == 2 && v.maximum == 6);
    CHECK(plr_volume_to_image(&v, as_said, &image));
    const float *samples = image.samples;
    CHECK(samples[0] == 0 && samples[1] == 0 && samples[2] == 0 && samples[3] == 0 &&
          samples[4] == 1);
    plr_image_free(&image);
    memcpy((float *)v.voxels + 3, values, 2 * sizeof(float));
    plr_volume_set_range(&v, NAN, NAN);
    CHECK(v.minimum == 0 && v.maximum == 0);
    plr_volume_free(&v);
    /* the same number everywhere: nothing stands out */
    v = make_volume(PLR_VOXEL_F64, 2, 1, 1);
    ((double *)v.voxels)[0] = ((double *)v.voxels)[1] = 7;
    plr_volume_set_range(&v, NAN, NAN);
    CHECK(plr_volume_to_image(&v, as_said, &image));
    CHECK(plr_image_sample(&image, 0, 0, 0, 0) == 0);
    plr_image_free(&image);
    plr_volume_free(&v);
}

/* ---- gradients ---- */

static plr_image make_image(uint32_t w, uint32_t h, uint32_t d, uint32_t components) {
    plr_image image = {.width = w, .height = h, .depth = d, .components = components};
    image.type = PLR_FLOAT32;
    image.samples = calloc((size_t)w * h * d * components, sizeof(float));
    return image;
}

/* A ramp along one axis: the gradient is its slope in the volume's own coordinates. */
static void test_ramp(int axis) {
    plr_image image = make_image(20, 30, 40, 1);
    const uint32_t size[3] = {20, 30, 40};
    const double dimensions[3] = {2, 0.5, 8};
    float *at = image.samples;
    for (uint32_t z = 0; z < 40; z++)
        for (uint32_t y = 0; y < 30; y++)
            for (uint32_t x = 0; x < 20; x++) {
                const uint32_t place[3] = {x, y, z};
                *at++ = ((float)place[axis] + 0.5f) / (float)size[axis];
            }
    CHECK_NEAR(plr_image_gradient_percentile(&image, dimensions), 1 / dimensions[axis], 1e-5);
    plr_image_free(&image);
}

/* v = x^2 along 1000 voxels: central differences give 2 x exactly, clamped ones at the borders
 * about half of that. So the 990th of the 1000 magnitudes in order is that of voxel 988, where x is
 * 0.9885. */
static void test_quadratic(void) {
    plr_image image = make_image(1000, 2, 3, 1);
    const double dimensions[3] = {1, 1, 1};
    for (uint32_t i = 0; i < 6000; i++) {
        double x = (i % 1000 + 0.5) / 1000;
        ((float *)image.samples)[i] = (float)(x * x);
    }
    CHECK_NEAR(plr_image_gradient_percentile(&image, dimensions), 2 * 0.9885, 1e-4);
    plr_image_free(&image);
}

/* One bright voxel of 100 x 1 x 1: two magnitudes above zero, whatever the rest. */
static void test_zeros_do_not_count(void) {
    plr_image image = make_image(100, 1, 1, 1);
    const double dimensions[3] = {100, 1, 1};
    CHECK(plr_image_gradient_percentile(&image, dimensions) == 1);
    ((float *)image.samples)[50] = 0.25f;
    CHECK_NEAR(plr_image_gradient_percentile(&image, dimensions), 0.125, 1e-9);
    plr_image_free(&image);
}

/* Colours: the mean of red, green and blue; luminance with alpha: the luminance. */
static void test_components(void) {
    static const struct {
        uint32_t components;
        float first[4], second[4];
        double expected;
    } rows[] = {
        {2, {0, 1}, {0.5f, 0}, 0.25},
        {3, {0, 0, 0}, {0.3f, 0.6f, 0}, 0.15},
        {4, {0, 0, 0, 0}, {0.3f, 0.6f, 0, 1}, 0.15},
    };
    for (size_t i = 0; i < 3; i++) {
        plr_image image = make_image(2, 1, 1, rows[i].components);
        float *samples = image.samples;
        memcpy(samples, rows[i].first, rows[i].components * sizeof *samples);
        memcpy(samples + rows[i].components, rows[i].second, rows[i].components * sizeof *samples);
        CHECK_NEAR(plr_image_gradient_percentile(&image, (const double[3]){2, 1, 1}),
                   rows[i].expected, 1e-7);
        plr_image_free(&image);
    }
}

static void test_integer_samples(void) {
    uint16_t words[] = {0, 65535};
    uint8_t bytes[] = {0, 255};
    plr_image deep = {.width = 2, .height = 1, .depth = 1, .components = 1}, flat = deep;
    deep.type = PLR_UNORM16;
    deep.samples = words;
    flat.type = PLR_UNORM8;
    flat.samples = bytes;
    const double dimensions[3] = {2, 1, 1};
    CHECK_NEAR(plr_image_gradient_percentile(&deep, dimensions), 0.5, 1e-6);
    CHECK_NEAR(plr_image_gradient_percentile(&flat, dimensions), 0.5, 1e-6);
}

/* ---- speed ---- */

static double seconds(void) {
    return (double)clock() / CLOCKS_PER_SEC; /* of this program: other load does not count */
}

/* Generous: an optimised build takes a tenth of this; a call for each voxel would not pass. */
static void test_speed(void) {
    plr_volume v = make_volume(PLR_VOXEL_S16, 256, 256, 256);
    plr_image image;
    for (size_t i = 0; i < 256 * 256 * 256; i++)
        ((int16_t *)v.voxels)[i] = (int16_t)(i * 40503u >> 8);
    double start = seconds();
    plr_volume_set_range(&v, NAN, NAN);
    CHECK(plr_volume_to_image(&v, as_said, &image));
    double converted = seconds();
    plr_image_gradient_percentile(&image, (const double[3]){1, 1, 1});
    double end = seconds();
    printf("# 16.8 million voxels: samples %.0f ms, gradients %.0f ms\n", 1e3 * (converted - start),
           1e3 * (end - converted));
    CHECK(converted - start < 3 && end - converted < 12);
    plr_image_free(&image);
    plr_volume_free(&v);
}

/* ---- real files ---- */

/* Sums and ranges found with another reader (Python's zlib and array modules). */
static const struct {
    const char *name;
    uint32_t size[3];
    double minimum, maximum, sum, metres;
} real_files[] = {
    {"confocal-cells-cytoplasm-75x75x75", {75, 75, 75}, 0, 65535, 3860494792, 0},
    {"confocal-cells-labels-75x75x75", {75, 75, 75}, 0, 255, 435123, 0},
    {"confocal-cells-nuclei-75x75x75", {75, 75, 75}, 0, 65535, 942462219, 0},
    {"confocal-ovule-128x128x32", {128, 128, 32}, 0, 255, 62957120, 1e-6},
    {"confocal-ovule-labels-128x128x32", {128, 128, 32}, 0, 255, 15002322, 1e-6},
    {"cryoem-betagal-100x100x100",
     {100, 100, 100},
     -0.05296945199370384,
     0.19695799052715302,
     -67.82992400585911,
     1e-10},
    {"cryoem-betagal-localres-100x100x100",
     {100, 100, 100},
     7.239999771118164,
     13.960000038146973,
     8863673.205364227,
     1e-10},
    {"ct-head-64x64x93", {64, 64, 93}, 0, 3926, 193392317, 1e-3},
    {"ct-tooth-103x94x161", {103, 94, 161}, 0, 1300, 821287590, 0},
    {"lightsheet-nuclei-94x86x124", {94, 86, 124}, 222, 2781, 420787391, 0},
    {"mr-head-160x232x160", {160, 232, 160}, 0, 255, 330743732, 1e-3},
    {"mr-head-labels-160x232x160", {160, 232, 160}, 0, 255, 4111567, 1e-3},
    {"mr-stroke-flair-124x160x140", {124, 160, 140}, 0, 255, 115231646, 1e-3},
    {"mr-stroke-t1-124x160x140", {124, 160, 140}, 0, 255, 123430146, 1e-3},
    {"mr-stroke-t2-124x160x140", {124, 160, 140}, 0, 255, 80212795, 1e-3},
    {"orbital-benzene-55x55x40",
     {55, 55, 40},
     -0.212459996342659,
     0.21253499388694763,
     0.0026922139714251818,
     1e-10},
};

static char *read_file(const char *path, size_t *length) {
    FILE *f = fopen(path, "rb");
    char *data = NULL;
    *length = 0;
    if (f && fseek(f, 0, SEEK_END) == 0) {
        long size = ftell(f);
        rewind(f);
        data = size > 0 ? malloc((size_t)size) : NULL;
        *length = data ? fread(data, 1, (size_t)size, f) : 0;
    }
    if (f)
        fclose(f);
    return data;
}

static bool matches(const plr_volume *v, size_t row) {
    double sum = 0;
    for (uint32_t z = 0; z < v->size[2]; z++)
        for (uint32_t y = 0; y < v->size[1]; y++)
            for (uint32_t x = 0; x < v->size[0]; x++)
                sum += plr_volume_value(v, x, y, z, 0);
    return memcmp(v->size, real_files[row].size, sizeof v->size) == 0 && v->components == 1 &&
           v->minimum == real_files[row].minimum && v->maximum == real_files[row].maximum &&
           fabs(sum - real_files[row].sum) <= 1e-9 * fabs(real_files[row].sum) + 1e-9 &&
           fabs(v->metres - real_files[row].metres) <= 1e-6 * real_files[row].metres;
}

static void test_real_files(const char *shared) {
    for (size_t i = 0; i < sizeof real_files / sizeof *real_files; i++) {
        char path[1024];
        size_t length;
        plr_volume v = {0};
        snprintf(path, sizeof path, "%s/%s.nrrd", shared, real_files[i].name);
        char *data = read_file(path, &length);
        if (!data) {
            TAP_SKIP(real_files[i].name, "the shared data folder is not here");
            continue;
        }
        plr_diags *diags = plr_diags_create(NULL);
        plr_volume_source source = {.data = data, .length = length, .name = path, .diags = diags};
        bool ok = plr_volume_parse(&source, &v) && matches(&v, i) && plr_diags_count(diags) == 0;
        TAP_RESULT(ok, "%s", real_files[i].name);
        if (!ok)
            printf("# %s; %.17g..%.17g\n", diag_text(diags, 0), v.minimum, v.maximum);
        plr_volume_free(&v);
        plr_diags_destroy(&diags);
        free(data);
    }
}

/* usage: volume [FOLDER OF THE SHARED DATA] */
int main(int argc, char **argv) {
    const char *shared = getenv("PLUGRAY_SHARED_DATA");
    test_bytes();
    test_words();
    test_physical_range();
    test_not_finite();
    for (int axis = 0; axis < 3; axis++)
        test_ramp(axis);
    test_quadratic();
    test_zeros_do_not_count();
    test_components();
    test_integer_samples();
    test_speed();
    test_real_files(shared ? shared : argc > 1 ? argv[1] : "../shared/data");
    return tap_done();
}
