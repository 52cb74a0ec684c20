/* Pictures to files, read again by other readers than those that wrote them. */
#include <errno.h>
#include <sys/stat.h>
#include <unistd.h>
#include <openexr.h>
#include <png.h>
#include <plugray/engine.h>

#include "engine/file.h"
#include "tests/tap.h"

static char folder[] = "/tmp/plugray-picture-XXXXXX";

static const char *in_folder(const char *name) {
    static char path[4][256];
    static int next;
    char *p = path[next++ & 3];
    snprintf(p, sizeof path[0], "%s/%s", folder, name);
    return p;
}

/* Premultiplied RGBA, and the bytes that a PNG has for it: over black, and straight. */
static const struct {
    float pixel[4];
    unsigned char opaque[3], straight[4];
} cases[] = {
    {{0, 0, 0, 0}, {0, 0, 0}, {0, 0, 0, 0}},
    {{1, 1, 1, 1}, {255, 255, 255}, {255, 255, 255, 255}},
    {{0.25f, 0.5f, 0, 0.5f}, {64, 128, 0}, {128, 255, 0, 128}},
    {{2, -1, 0.5f, 1}, {255, 0, 128}, {255, 0, 128, 255}},
    {{NAN, 1, INFINITY, NAN}, {0, 255, 255}, {0, 0, 0, 0}},
    {{0.3f, -INFINITY, 0.2f, 1.5f}, {77, 0, 51}, {77, 0, 51, 255}},
    {{0.5f, 0.25f, 0.125f, -1}, {128, 64, 32}, {0, 0, 0, 0}},
    {{0.5f / 255, 0.49f / 255, 254.5f / 255, 1}, {1, 0, 255}, {1, 0, 255, 255}},
};
enum {
    CASES = sizeof cases / sizeof cases[0]
};

static plr_picture case_picture(void) {
    plr_picture picture = {CASES, 1, malloc(sizeof(float) * 4 * CASES)};
    for (int i = 0; i < CASES; i++)
        memcpy(picture.pixels + i * 4, cases[i].pixel, sizeof cases[i].pixel);
    return picture;
}

/* Every sample differs; rows go beyond one chunk of an EXR (16 rows). */
static plr_picture ramp_picture(int width, int height) {
    plr_picture picture = {width, height, malloc(sizeof(float) * 4 * (size_t)(width * height))};
    for (int i = 0; i < width * height * 4; i++)
        picture.pixels[i] = (float)i * 0.37f - 5.0f;
    return picture;
}

static void test_png_alpha(void) {
    plr_picture picture = case_picture();
    for (int transparent = 0; transparent < 2; transparent++) {
        png_image image = {.version = PNG_IMAGE_VERSION};
        unsigned char bytes[CASES * 4];
        const char *path = in_folder("alpha.png");
        CHECK(plr_picture_write(&picture, path, transparent, NULL));
        CHECK(png_image_begin_read_from_file(&image, path));
        CHECK_INT(image.format, transparent ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB);
        CHECK_INT(image.width, CASES);
        CHECK_INT(image.height, 1);
        CHECK(png_image_finish_read(&image, NULL, bytes, 0, NULL));
        size_t size = transparent ? 4 : 3;
        for (int i = 0; i < CASES; i++) {
            const unsigned char *expected = transparent ? cases[i].straight : cases[i].opaque;
            printf("# case %d\n", i);
            CHECK(memcmp(bytes + (size_t)i * size, expected, size) == 0);
        }
    }
    plr_picture_free(&picture);
    CHECK(picture.pixels == NULL);
}

static void test_png_rows(void) {
    plr_picture picture = {2, 3, calloc(24, sizeof(float))};
    png_image image = {.version = PNG_IMAGE_VERSION};
    unsigned char bytes[18];
    for (int i = 0; i < 6; i++)
        picture.pixels[i * 4] = (float)(i * 10) / 255.0f;
    CHECK(plr_picture_write(&picture, in_folder("ROWS.PNG"), false, NULL));
    CHECK(png_image_begin_read_from_file(&image, in_folder("ROWS.PNG")));
    CHECK(png_image_finish_read(&image, NULL, bytes, 0, NULL));
    for (int i = 0; i < 6; i++)
        CHECK_INT(bytes[i * 3], i * 10);
    plr_picture_free(&picture);
}

/* Reads a whole file; NULL if there is none. */
static unsigned char *read_all(const char *path, size_t *length) {
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    unsigned char *data = malloc(1 << 20);
    *length = fread(data, 1, 1 << 20, file);
    fclose(file);
    return data;
}

static void test_npy(void) {
    plr_picture picture = ramp_picture(5, 3);
    size_t length = 0;
    picture.pixels[7] = -INFINITY;
    CHECK(plr_picture_write(&picture, in_folder("a.npy"), true, NULL));
    unsigned char *data = read_all(in_folder("a.npy"), &length);
    CHECK(data && memcmp(data, "\x93NUMPY\1\0", 8) == 0);
    size_t header = data[8] + (size_t)256 * data[9];
    CHECK_INT((10 + header) % 64, 0);
    CHECK_INT(data[10 + header - 1], '\n');
    CHECK_INT(length, 10 + header + 5 * 3 * 4 * sizeof(float));
    data[10 + header - 1] = 0;
    CHECK(strstr((char *)data + 10, "'shape': (3, 5, 4)") != NULL);
    CHECK(strstr((char *)data + 10, "'fortran_order': False") != NULL);
    CHECK(strstr((char *)data + 10, "'descr': '<f4'") != NULL);
    CHECK(memcmp(data + 10 + header, picture.pixels, 5 * 3 * 4 * sizeof(float)) == 0);
    free(data);
    plr_picture_free(&picture);
}

/* Reads a float EXR to RGBA by OpenEXRCore's decoder. */
static bool read_exr(const char *path, int width, int height, float *pixels) {
    exr_context_t exr = NULL;
    exr_attr_box2i_t window;
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    int rows = 0;
    bool fine = exr_start_read(&exr, path, NULL) == EXR_ERR_SUCCESS;
    fine = fine && exr_get_data_window(exr, 0, &window) == EXR_ERR_SUCCESS &&
           window.max.x - window.min.x + 1 == width && window.max.y - window.min.y + 1 == height &&
           exr_get_scanlines_per_chunk(exr, 0, &rows) == EXR_ERR_SUCCESS;
    for (int y = 0; fine && y < height; y += rows) {
        exr_chunk_info_t chunk;
        fine = exr_read_scanline_chunk_info(exr, 0, y, &chunk) == EXR_ERR_SUCCESS &&
               (y ? exr_decoding_update(exr, 0, &chunk, &pipeline)
                  : exr_decoding_initialize(exr, 0, &chunk, &pipeline)) == EXR_ERR_SUCCESS &&
               pipeline.channel_count == 4;
        for (int i = 0; fine && i < 4; i++) {
            exr_coding_channel_info_t *c = &pipeline.channels[i];
            const char *at = strchr("RGBA", c->channel_name[0]);
            fine = at && c->data_type == EXR_PIXEL_FLOAT;
            c->decode_to_ptr = (uint8_t *)(pixels + y * width * 4 + (at ? at - "RGBA" : 0));
            c->user_pixel_stride = 16;
            c->user_line_stride = 16 * width;
            c->user_bytes_per_element = 4;
            c->user_data_type = EXR_PIXEL_FLOAT;
        }
        fine = fine &&
               (y || exr_decoding_choose_default_routines(exr, 0, &pipeline) == EXR_ERR_SUCCESS) &&
               exr_decoding_run(exr, 0, &pipeline) == EXR_ERR_SUCCESS;
    }
    exr_decoding_destroy(exr, &pipeline);
    exr_finish(&exr);
    return fine;
}

static void test_exr(void) {
    static const int sizes[][2] = {{1, 1}, {7, 16}, {33, 50}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        int width = sizes[i][0], height = sizes[i][1];
        size_t bytes = sizeof(float) * 4 * (size_t)(width * height);
        plr_picture picture = ramp_picture(width, height);
        float *again = calloc(1, bytes);
        picture.pixels[1] = INFINITY;
        CHECK(plr_picture_write(&picture, in_folder("a.exr"), false, NULL));
        CHECK(read_exr(in_folder("a.exr"), width, height, again));
        CHECK(memcmp(again, picture.pixels, bytes) == 0);
        free(again);
        plr_picture_free(&picture);
    }
}

static void test_refused(void) {
    static const struct {
        const char *name, *part;
    } refused[] = {{"a.jpg", ".png, .exr or .npy"},
                   {"png", "must end"},
                   {"no/such/folder/a.png", "No such file"},
                   {"folder.png", "directory"}};
    plr_picture picture = case_picture();
    mkdir(in_folder("folder.png"), 0777);
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        plr_diags *diags = plr_diags_create(NULL);
        const char *path = in_folder(refused[i].name);
        CHECK(!plr_picture_write(&picture, path, false, diags));
        CHECK_INT(plr_diags_count_of(diags, PLR_ERROR), 1);
        CHECK_STR(plr_code_text(plr_diags_get(diags, 0)->code), "output");
        CHECK(strstr(plr_diags_get(diags, 0)->message, refused[i].part) != NULL);
        CHECK_STR(plr_diags_get(diags, 0)->place.file, path);
        plr_diags_destroy(&diags);
    }
    plr_picture_free(&picture);
}

/* A file is replaced, keeps its permissions, and links stay links. */
static void test_replace(void) {
    struct stat status;
    size_t length = 0;
    const char *path = in_folder("target"), *link = in_folder("link");
    CHECK_INT(plr_file_write(path, "first version", 13), 0);
    chmod(path, 0640);
    CHECK_INT(symlink(path, link), 0);
    CHECK_INT(plr_file_write(link, "second", 6), 0);
    unsigned char *data = read_all(path, &length);
    CHECK(data && length == 6 && memcmp(data, "second", 6) == 0);
    free(data);
    CHECK(lstat(link, &status) == 0 && S_ISLNK(status.st_mode));
    CHECK(stat(path, &status) == 0 && (status.st_mode & 0777) == 0640);
    CHECK_INT(plr_file_write("/dev/null", "x", 1), 0);
    CHECK(stat("/dev/null", &status) == 0 && S_ISCHR(status.st_mode));
    CHECK_INT(plr_file_write(in_folder("none/x"), "x", 1), ENOENT);
}

static void test_buffer(void) {
    plr_buffer buffer = {0};
    CHECK(plr_buffer_append(&buffer, "ab", 2));
    CHECK(plr_buffer_write_at(&buffer, 6000, "c", 1));
    CHECK(plr_buffer_write_at(&buffer, 1, "d", 1));
    CHECK_INT(buffer.length, 6001);
    CHECK(memcmp(buffer.data, "ad\0", 3) == 0 && buffer.data[5999] == 0 &&
          buffer.data[6000] == 'c');
    CHECK(!plr_buffer_write_at(&buffer, (size_t)-2, "x", 1));
    plr_buffer_free(&buffer);
    CHECK(buffer.data == NULL);
}

static void clean_up(void) {
    static const char *const names[] = {"alpha.png", "ROWS.PNG", "a.npy",
                                        "a.exr",     "link",     "target"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        unlink(in_folder(names[i]));
    rmdir(in_folder("folder.png"));
    /* Fails if a temporary file was left behind. */
    CHECK_INT(rmdir(folder), 0);
}

int main(void) {
    if (!mkdtemp(folder))
        return 1;
    test_png_alpha();
    test_png_rows();
    test_npy();
    test_exr();
    test_refused();
    test_replace();
    test_buffer();
    clean_up();
    return tap_done();
}
