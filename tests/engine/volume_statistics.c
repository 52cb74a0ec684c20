/* Percentiles, histograms, counts, against what sorting gives. */
#include "engine/volume_statistics.h"

#include <float.h>

#include "tests/tap.h"

static plr_volume make(plr_voxel_type type, void *voxels, uint32_t x, uint32_t y, uint32_t z,
                       uint32_t components) {
    return (plr_volume){
        .size = {x, y, z}, .components = components, .type = type, .voxels = voxels, .slope = 1};
}

static int compare(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

static uint32_t state = 1;

static uint32_t noise(void) {
    return state = state * 1664525u + 1013904223u;
}

/* Against a sorted copy, for numbers of every sign and size. */
static void check_percentiles(const char *name, const plr_volume *v, uint32_t component) {
    static const double percents[] = {0, 0.1, 1, 12.5, 50, 50.001, 75, 99.9, 100};
    enum {
        COUNT = sizeof percents / sizeof *percents
    };
    double found[COUNT];
    size_t count = (size_t)v->size[0] * v->size[1] * v->size[2];
    double *sorted = malloc(count * sizeof *sorted);
    size_t finite = 0;
    for (uint32_t i = 0; i < count; i++) {
        double value = plr_volume_value(v, i % v->size[0], i / v->size[0] % v->size[1],
                                        i / v->size[0] / v->size[1], component);
        if (isfinite(value))
            sorted[finite++] = value;
    }
    qsort(sorted, finite, sizeof *sorted, compare);
    bool fine = plr_volume_get_percentiles(v, component, percents, COUNT, found);
    for (size_t i = 0; i < COUNT && fine; i++) {
        size_t rank = (size_t)ceil(percents[i] / 100 * (double)finite);
        fine = found[i] == sorted[rank ? rank - 1 : 0];
    }
    TAP_RESULT(fine, "percentiles of %s", name);
    free(sorted);
}

static void test_percentiles(void) {
    static double doubles[4913];
    static float floats[4913];
    static int16_t shorts[4913 * 3];
    static uint8_t bytes[4913];
    for (size_t i = 0; i < 4913; i++) {
        doubles[i] = ldexp((double)noise() - 2147483648.0, (int)(noise() % 1600) - 800);
        floats[i] = (float)noise() / 4e9f - 0.5f;
        bytes[i] = (uint8_t)(noise() >> 28);
    }
    for (size_t i = 0; i < 4913 * 3; i++)
        shorts[i] = (int16_t)(noise() >> 16);
    plr_volume v = make(PLR_VOXEL_F64, doubles, 17, 17, 17, 1);
    check_percentiles("doubles of all sizes", &v, 0);
    v = make(PLR_VOXEL_F32, floats, 17, 17, 17, 1);
    check_percentiles("floats", &v, 0);
    floats[7] = (float)NAN;
    floats[70] = (float)INFINITY;
    floats[700] = -(float)INFINITY;
    check_percentiles("floats, some not finite", &v, 0);
    v = make(PLR_VOXEL_U8, bytes, 17, 17, 17, 1);
    check_percentiles("bytes", &v, 0);
    v = make(PLR_VOXEL_S16, shorts, 17, 17, 17, 3);
    check_percentiles("the third of three components", &v, 2);
    v.slope = -0.37;
    v.intercept = 11;
    check_percentiles("values with a falling slope", &v, 1);
}

static uint64_t total(const plr_volume_statistics *s) {
    uint64_t sum = 0;
    for (uint32_t i = 0; i < s->bins; i++)
        sum += s->counts[i];
    return sum;
}

static void test_statistics(void) {
    float values[] = {-1, 0, 0.5f, 3, (float)NAN, (float)INFINITY, -(float)INFINITY, (float)NAN};
    plr_volume v = make(PLR_VOXEL_F32, values, 2, 2, 2, 1);
    plr_volume_statistics s;
    CHECK(plr_volume_get_statistics(&v, 0, &s));
    CHECK(s.finite == 4 && s.nan == 2 && s.infinite == 2);
    CHECK(s.minimum == -1 && s.maximum == 3);
    CHECK(s.bins == 32 && s.first == -1 && s.width == 0.125);
    CHECK(s.counts[0] == 1 && s.counts[8] == 1 && s.counts[12] == 1 && s.counts[31] == 1);
    CHECK(total(&s) == 4);
    CHECK(s.percentiles[0] == -1 && s.percentiles[4] == 0 && s.percentiles[8] == 3);
    CHECK(!plr_volume_get_statistics(&v, 1, &s));
}

/* 100 levels on 32 bins: four levels each, none more than its share. */
static void test_integer_bins(void) {
    uint16_t values[100];
    for (uint16_t i = 0; i < 100; i++)
        values[i] = (uint16_t)(1000 + i);
    plr_volume v = make(PLR_VOXEL_U16, values, 10, 10, 1, 1);
    plr_volume_statistics s;
    const double slopes[] = {1, 0.1, -0.1};
    for (int k = 0; k < 3; k++) {
        v.slope = slopes[k];
        CHECK(plr_volume_get_statistics(&v, 0, &s));
        CHECK(s.bins == 25);
        CHECK_NEAR(s.width, 4 * fabs(slopes[k]), 1e-12);
        bool even = true;
        for (uint32_t i = 0; i < s.bins; i++)
            even = even && s.counts[i] == 4;
        TAP_RESULT(even, "each bin has four");
    }
}

static void test_extremes(void) {
    float none[] = {(float)NAN, (float)NAN};
    plr_volume v = make(PLR_VOXEL_F32, none, 2, 1, 1, 1);
    plr_volume_statistics s;
    CHECK(plr_volume_get_statistics(&v, 0, &s));
    CHECK(s.finite == 0 && s.nan == 2 && s.bins == 1 && total(&s) == 0);
    CHECK(s.minimum == 0 && s.maximum == 0 && s.percentiles[8] == 0);
    uint8_t one[] = {7, 7, 7, 7};
    v = make(PLR_VOXEL_U8, one, 1, 1, 1, 4);
    CHECK(plr_volume_get_statistics(&v, 3, &s));
    CHECK(s.finite == 1 && s.bins == 1 && s.counts[0] == 1 && s.percentiles[0] == 7);
    double huge[] = {-DBL_MAX, DBL_MAX, 0, DBL_MIN};
    v = make(PLR_VOXEL_F64, huge, 4, 1, 1, 1);
    CHECK(plr_volume_get_statistics(&v, 0, &s));
    CHECK(isfinite(s.width) && s.counts[0] == 1 && s.counts[31] == 1 && s.counts[16] == 2);
    double tiny[] = {0, 5e-324};
    v = make(PLR_VOXEL_F64, tiny, 2, 1, 1, 1);
    CHECK(plr_volume_get_statistics(&v, 0, &s));
    CHECK(total(&s) == 2);
    uint64_t wide[] = {0, UINT64_MAX};
    v = make(PLR_VOXEL_U64, wide, 2, 1, 1, 1);
    CHECK(plr_volume_get_statistics(&v, 0, &s));
    CHECK(s.bins == 32 && s.counts[0] == 1 && s.counts[31] == 1);
}

/* Two heaps of values: the threshold lies in the empty stretch between them. */
static void test_threshold(void) {
    float values[90];
    for (int i = 0; i < 90; i++)
        values[i] = (float)(i < 60 ? i % 10 : 80 + i % 20);
    plr_volume v = make(PLR_VOXEL_F32, values, 90, 1, 1, 1);
    double t = plr_volume_threshold(&v, 0, 0, 100);
    CHECK(t > 40 && t < 50);
    CHECK(plr_volume_threshold(&v, 0, 5, 5) == 5);
}

static void test_labels(void) {
    uint32_t values[] = {70000, 0, 0, 3, 70000, 0xffffffff, 3, 3};
    plr_image image = {.width = 2, .height = 2, .depth = 2, .components = 1, .type = PLR_UINT32};
    image.samples = values;
    size_t count;
    bool more;
    plr_label_count *counts = plr_image_count_labels(&image, &count, &more);
    CHECK(counts && count == 4 && !more);
    CHECK(counts[0].value == 0 && counts[0].voxels == 2);
    CHECK(counts[1].value == 3 && counts[1].voxels == 3);
    CHECK(counts[2].value == 70000 && counts[2].voxels == 2);
    CHECK(counts[3].value == 0xffffffff && counts[3].voxels == 1);
    free(counts);
    enum {
        MANY = PLR_MAX_LABEL_COUNTS + 100
    };
    uint32_t *many = malloc(MANY * sizeof *many);
    for (uint32_t i = 0; i < MANY; i++)
        many[i] = i * 3;
    image = (plr_image){.width = MANY, .height = 1, .depth = 1, .components = 1};
    image.type = PLR_UINT32;
    image.samples = many;
    counts = plr_image_count_labels(&image, &count, &more);
    CHECK(counts && count == PLR_MAX_LABEL_COUNTS && more);
    free(counts);
    free(many);
}

/* Of a node of a scene, as a host asks. */
static void test_node(void) {
    static const char text[] =
        "#X3D V3.3 utf8\n"
        "VolumeData { voxels DEF A PixelTexture3D { image 2 2 1 2 0x0107 0x0207 0x0307 0x0907 } }\n"
        "VolumeData { voxels DEF B ImageTexture3D { url \"nowhere.nrrd\" } }\n";
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = plr_scene_parse(text, sizeof text - 1, "scene.x3dv", NULL, diags);
    plr_volume_statistics s;
    CHECK(plr_volume_read_statistics(scene, plr_scene_find(scene, "A"), 0, &s, diags));
    CHECK(s.minimum == 1 && s.maximum == 9 && s.percentiles[4] == 2 && s.finite == 4);
    CHECK(plr_volume_read_statistics(scene, plr_scene_find(scene, "A"), 1, &s, diags));
    CHECK(s.minimum == 7 && s.maximum == 7);
    CHECK_INT(plr_diags_count(diags), 0);
    CHECK(!plr_volume_read_statistics(scene, plr_scene_find(scene, "A"), 2, &s, diags));
    CHECK(!plr_volume_read_statistics(scene, plr_scene_find(scene, "B"), 0, &s, diags));
    CHECK_INT(plr_diags_count(diags), 1);
    CHECK(s.finite == 0 && s.bins == 0);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

int main(void) {
    test_percentiles();
    test_statistics();
    test_integer_bins();
    test_extremes();
    test_threshold();
    test_labels();
    test_node();
    return tap_done();
}
