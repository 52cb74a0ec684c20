/* Images: files of every format that is read, pixel fields, two-dimensional NRRD. */
#include "volume_test.h"

static const plr_place place = {"scene.x3d", 9, 12};

static bool decode(const file *f, plr_image *image, plr_diags *diags) {
    char *exact = malloc(f->length ? f->length : 1);
    memcpy(exact, f->data, f->length);
    bool ok = plr_image_decode(exact, f->length, place, image, diags);
    free(exact);
    return ok;
}

static bool is_image(const plr_image *image, uint32_t width, uint32_t height, uint32_t components,
                     plr_sample_type type) {
    return image->width == width && image->height == height && image->depth == 1 &&
           image->components == components && image->type == type;
}

/* ---- PNG ---- */

static void add_chunk(file *f, const char *type, const void *data, size_t length) {
    static unsigned char joined[4096];
    memcpy(joined, type, 4);
    if (length)
        memcpy(joined + 4, data, length);
    add_bits(f, length, 4, true);
    add_bytes(f, joined, 4 + length);
    add_bits(f, crc32(0, joined, (uInt)(4 + length)), 4, true);
}

/* `rows` as PNG has them: each with its filter byte, top row first, big endian. */
static void make_png(file *f, uint32_t width, uint32_t height, int bits, int colour,
                     const void *rows, size_t length) {
    static file head;
    unsigned char packed[1024];
    uLongf packed_length = sizeof packed;
    memset(f, 0, sizeof *f);
    memset(&head, 0, sizeof head);
    add_bits(&head, width, 4, true);
    add_bits(&head, height, 4, true);
    add_bits(&head, (uint64_t)bits, 1, true);
    add_bits(&head, (uint64_t)colour, 1, true);
    add_bits(&head, 0, 3, true);
    compress(packed, &packed_length, rows, length);
    add_bytes(f, "\x89PNG\r\n\032\n", 8);
    add_chunk(f, "IHDR", head.data, head.length);
    add_chunk(f, "IDAT", packed, packed_length);
    add_chunk(f, "IEND", NULL, 0);
}

static void test_png(void) {
    static const struct {
        int colour;
        uint32_t components;
    } kinds[] = {{0, 1}, {4, 2}, {2, 3}, {6, 4}};
    static file f;
    for (size_t i = 0; i < 4; i++)
        for (uint32_t bytes = 1; bytes <= 2; bytes++) {
            uint32_t n = kinds[i].components, row = 1 + 2 * n * bytes;
            unsigned char rows[64] = {0};
            for (uint32_t k = 0; k < 2 * row; k++)
                rows[k] = k % row ? (unsigned char)(k * 37 + 11) : 0;
            make_png(&f, 2, 2, (int)bytes * 8, kinds[i].colour, rows, 2 * row);
            plr_image image;
            bool ok = decode(&f, &image, NULL) &&
                      is_image(&image, 2, 2, n, bytes == 2 ? PLR_UNORM16 : PLR_UNORM8);
            for (uint32_t k = 0; ok && k < 4 * n; k++) {
                /* bottom row first */
                const unsigned char *from = rows + (1 - k / n / 2) * row + 1 + k % (2 * n) * bytes;
                double expected =
                    bytes == 2 ? (from[0] * 256 + from[1]) / 65535.0 : from[0] / 255.0;
                ok = plr_image_sample(&image, k / n % 2, k / n / 2, 0, k % n) == expected;
            }
            TAP_RESULT(ok, "PNG of %u components of %u bits", n, bytes * 8);
            plr_image_free(&image);
        }
}

/* ---- other formats ---- */

static void test_hdr(void) {
    static file f;
    plr_image image;
    memset(&f, 0, sizeof f);
    add_text(&f, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n");
    /* mantissa / 256 * 2^(exponent - 128) */
    add_bytes(&f, "\x80\x40\x20\x83\x80\x00\x01\x80", 8);
    CHECK(decode(&f, &image, NULL));
    CHECK(is_image(&image, 1, 2, 3, PLR_FLOAT32));
    const float *samples = image.samples;
    CHECK(samples && samples[0] == 0.5f && samples[1] == 0 && samples[2] == 1 / 256.f);
    CHECK(samples && samples[3] == 4 && samples[4] == 2 && samples[5] == 1);
    plr_image_free(&image);
}

static bool decode_hdr(const char *sizes, const char *pixels, size_t length, plr_image *image,
                       plr_diags *diags) {
    static file f;
    memset(&f, 0, sizeof f);
    add_text(&f, "#?RGBE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n");
    add_text(&f, sizes);
    add_bytes(&f, pixels, length);
    return decode(&f, image, diags);
}

static void test_hdr_runs(void) {
    plr_image image;
    plr_diags *diags = plr_diags_create(NULL);
    /* component by component: a run of 8; 7 literal bytes and one; a run of 8; a run of 8 */
    CHECK(decode_hdr("-Y 1 +X 8\n", "\2\2\0\10\210\100\7\1\2\3\4\5\6\7\1\10\210\3\210\210", 20,
                     &image, NULL));
    for (uint32_t x = 0; x < 8; x++) {
        const float *pixel = (const float *)image.samples + 3 * x;
        CHECK(pixel[0] == 64 && pixel[1] == (float)(x + 1) && pixel[2] == 3);
    }
    plr_image_free(&image);
    /* whole pixels: one, three more like it; the lower row comes first */
    CHECK(decode_hdr("+Y 2 +X 4\n", "\1\2\3\210\1\1\1\3\4\5\6\210\1\1\1\3", 16, &image, NULL));
    CHECK(is_image(&image, 4, 2, 3, PLR_FLOAT32));
    CHECK(plr_image_sample(&image, 3, 0, 0, 1) == 2 && plr_image_sample(&image, 3, 1, 0, 1) == 5);
    plr_image_free(&image);
    CHECK(!decode_hdr("-Y 1 +X 8\n", "\2\2\0\10\0\0\0\0\0\0", 10, &image, diags));
    CHECK(!decode_hdr("-Y 1 +X 8\n", "\2\2\0\10\211\1\210\1\210\1\210\1", 12, &image, NULL));
    CHECK(!decode_hdr("-Y 1 +X 2\n", "\1\1\1\2\1\1\1\2", 8, &image, NULL));
    CHECK(!decode_hdr("-Y 1 +X 2\n", "\2\2\2\2\1\1\1\2", 8, &image, NULL));
    CHECK_STR(diag_text(diags, 0),
              "scene.x3d:9:12 error this image cannot be read: it is damaged or cut off");
    CHECK(!decode_hdr("-Y 40000 +X 2\n", "", 0, &image, diags));
    CHECK_STR(diag_text(diags, 1),
              "scene.x3d:9:12 error this image cannot be read: it is too large");
    CHECK(!decode_hdr("-Y 10 +X 20000\n", "\1\2\3\210", 4, &image, diags));
    CHECK_STR(diag_text(diags, 2), "scene.x3d:9:12 error this image cannot be read: it is cut off");
    CHECK(!decode_hdr("+X 2 -Y 1\n", "\1\2\3\210\1\2\3\210", 8, &image, diags));
    CHECK_STR(diag_text(diags, 3),
              "scene.x3d:9:12 error this image cannot be read: its sizes cannot be read");
    plr_diags_destroy(&diags);
}

static void test_bmp(void) {
    static file f;
    plr_image image;
    memset(&f, 0, sizeof f);
    add_text(&f, "BM");
    add_bits(&f, 54 + 8, 4, false);
    add_bits(&f, 0, 4, false);
    add_bits(&f, 54, 4, false);
    add_bits(&f, 40, 4, false);
    add_bits(&f, 1, 4, false);
    add_bits(&f, 2, 4, false);
    add_bits(&f, 1, 2, false);
    add_bits(&f, 24, 2, false);
    for (int i = 0; i < 6; i++)
        add_bits(&f, 0, 4, false);
    add_bytes(&f, "\1\2\3\0\4\5\6\0", 8); /* blue first, bottom row first */
    CHECK(decode(&f, &image, NULL));
    CHECK(is_image(&image, 1, 2, 3, PLR_UNORM8));
    CHECK(image.samples && memcmp(image.samples, "\3\2\1\6\5\4", 6) == 0);
    plr_image_free(&image);
}

static void test_tga(void) {
    static file f;
    plr_image image;
    memset(&f, 0, sizeof f);
    add_bytes(&f, "\0\0\3\0\0\0\0\0\0\0\0\0", 12); /* grey, not packed */
    add_bits(&f, 2, 2, false);
    add_bits(&f, 2, 2, false);
    add_bytes(&f, "\10\0abcd", 6); /* bottom row first */
    CHECK(decode(&f, &image, NULL));
    CHECK(is_image(&image, 2, 2, 1, PLR_UNORM8));
    CHECK(image.samples && memcmp(image.samples, "abcd", 4) == 0);
    plr_image_free(&image);
}

static void test_gif(void) {
    static const unsigned char gif[] = {
        'G', 'I', 'F',  '8',  '9', 'a', 2, 0, 1, 0, 0x80, 0, 0, /* 2 x 1, two colours */
        10,  20,  30,   40,   50,  60,                          /* the colours */
        ',', 0,   0,    0,    0,   2,   0, 1, 0, 0,             /* the picture */
        2,   2,   0x0c, 0x05, 0,                                /* clear, 1, 0, end */
        ';'};
    static file f;
    plr_image image;
    memset(&f, 0, sizeof f);
    add_bytes(&f, gif, sizeof gif);
    /* codes of 3 bits from the lowest: 4 1 0 5 */
    f.data[sizeof gif - 4] = 4 | 1 << 3 | (0 << 6 & 0xff);
    f.data[sizeof gif - 3] = 0 | 5 << 1;
    CHECK(decode(&f, &image, NULL));
    CHECK(is_image(&image, 2, 1, 4, PLR_UNORM8));
    CHECK(image.samples && memcmp(image.samples, "\50\62\74\377\12\24\36\377", 8) == 0);
    plr_image_free(&image);
}

static void add_segment(file *f, int marker, const void *data, size_t length) {
    add_bits(f, 0xff00 | (uint64_t)marker, 2, true);
    add_bits(f, length + 2, 2, true);
    add_bytes(f, data, length);
}

/* Two grey blocks, one above the other, that have but a constant term: 8 (200 - 128) = 576, and the
 * difference of 8 (50 - 128) from it, -1200. Codes: 0 is 10 bits, 10 is 11 bits; 0 ends a block. */
static void test_jpeg(void) {
    static const char bits[] = "0"
                               "1001000000"
                               "0"
                               "10"
                               "01101001111"
                               "0"
                               "111111";
    unsigned char tables[65], data[4] = {0};
    static file f;
    plr_image image;
    memset(&f, 0, sizeof f);
    memset(tables, 1, sizeof tables);
    tables[0] = 0;
    for (size_t i = 0; i < 32; i++)
        data[i / 8] = (unsigned char)(data[i / 8] << 1 | (bits[i] == '1'));
    add_bits(&f, 0xffd8, 2, true);
    add_segment(&f, 0xdb, tables, 65);
    add_segment(&f, 0xc0, "\10\0\20\0\10\1\1\21\0", 9);
    add_segment(&f, 0xc4, "\0\1\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\12\13", 19);
    add_segment(&f, 0xc4, "\20\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 18);
    add_segment(&f, 0xda, "\1\1\0\0\77\0", 6);
    add_bytes(&f, data, 4);
    add_bits(&f, 0xffd9, 2, true);
    CHECK(decode(&f, &image, NULL));
    CHECK(is_image(&image, 8, 16, 1, PLR_UNORM8));
    CHECK(plr_image_sample(&image, 3, 0, 0, 0) == 50 / 255.0);
    CHECK(plr_image_sample(&image, 3, 15, 0, 0) == 200 / 255.0);
    plr_image_free(&image);
    /* a table of more codes than there are, then no table at all */
    f.data[101] = 255;
    f.data[102] = 255;
    CHECK(!decode(&f, &image, NULL) && !image.samples);
    f.length = 90;
    CHECK(!decode(&f, &image, NULL));
}

/* ---- NRRD
 * ------------------------------------------------------------------------------------------------
 */

/* Values stay what they are: a transfer function's numbers are not stretched to 0..1. */
static void test_nrrd(void) {
    static file f;
    plr_image image;
    plr_diags *diags = plr_diags_create(NULL);
    memset(&f, 0, sizeof f);
    add_text(&f, "NRRD0004\ntype: float\ndimension: 2\nsizes: 4 2\nkinds: RGBA-color domain\n"
                 "encoding: ascii\n\n0.25 0.5 2 1  -1 0 0 0.125\n");
    CHECK(decode(&f, &image, NULL));
    CHECK(is_image(&image, 2, 1, 4, PLR_FLOAT32));
    const float expected[] = {0.25f, 0.5f, 2, 1, -1, 0, 0, 0.125f};
    CHECK(image.samples && memcmp(image.samples, expected, sizeof expected) == 0);
    plr_image_free(&image);
    f.length = 0;
    add_text(&f, "NRRD0004\ntype: ushort\ndimension: 2\nsizes: 2 2\nencoding: ascii\n\n"
                 "0 1 2 65535\n");
    CHECK(decode(&f, &image, NULL));
    CHECK_NEAR(plr_image_sample(&image, 0, 1, 0, 0), 2 / 65535.0, 1e-11);
    CHECK(plr_image_sample(&image, 1, 1, 0, 0) == 1);
    plr_image_free(&image);
    f.length = 0;
    add_text(&f, "NRRD0004\ntype: short\ndimension: 2\nsizes: 2 1\nencoding: ascii\nmin: -100\n"
                 "max: 100\n\n-50 100\n");
    CHECK(decode(&f, &image, NULL));
    CHECK(plr_image_sample(&image, 0, 0, 0, 0) == 0.25 &&
          plr_image_sample(&image, 1, 0, 0, 0) == 1);
    plr_image_free(&image);
    f.length = 0;
    add_text(&f, "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1 2\nencoding: raw\n\nab");
    CHECK(!decode(&f, &image, diags));
    CHECK_STR(diag_text(diags, 0),
              "scene.x3d:9:12 error data of 1 x 1 x 2 voxels are not an image");
    plr_diags_destroy(&diags);
}

/* ---- fields
 * ------------------------------------------------------------------------------------------------
 */

static plr_field make_field(plr_type type, const int32_t *ints, size_t count) {
    plr_field field = {.name = "image", .type = type, .place = place, .count = count};
    field.value.ints = ints;
    return field;
}

static void test_sfimage(void) {
    static const int32_t rgba[] = {1, 2, 4, 0x11223344, (int32_t)0xff8040c0u};
    static const int32_t grey[] = {3, 1, 1, 0, 0x7f, 0x1ff};
    static const int32_t pair[] = {1, 1, 2, 0xabcd};
    plr_image image;
    plr_field field = make_field(PLR_SFIMAGE, rgba, 5);
    CHECK(plr_image_from_sfimage(&field, &image, NULL));
    CHECK(is_image(&image, 1, 2, 4, PLR_UNORM8));
    CHECK(memcmp(image.samples, "\x11\x22\x33\x44\xff\x80\x40\xc0", 8) == 0);
    plr_image_free(&image);
    field = make_field(PLR_SFIMAGE, grey, 6);
    CHECK(plr_image_from_sfimage(&field, &image, NULL));
    CHECK(is_image(&image, 3, 1, 1, PLR_UNORM8) && memcmp(image.samples, "\0\x7f\xff", 3) == 0);
    plr_image_free(&image);
    field = make_field(PLR_SFIMAGE, pair, 4);
    CHECK(plr_image_from_sfimage(&field, &image, NULL));
    CHECK(is_image(&image, 1, 1, 2, PLR_UNORM8) && memcmp(image.samples, "\xab\xcd", 2) == 0);
    plr_image_free(&image);
}

static void test_image3d(void) {
    static const int32_t ints[] = {3, 2, 1, 2, 0x010203, 0x040506, 0x070809, 0x0a0b0c};
    plr_image image;
    plr_field field = make_field(PLR_MFINT32, ints, 8);
    CHECK(plr_image_from_image3d(&field, &image, NULL));
    CHECK(image.width == 2 && image.height == 1 && image.depth == 2 && image.components == 3);
    CHECK(memcmp(image.samples, "\1\2\3\4\5\6\7\10\11\12\13\14", 12) == 0);
    CHECK(plr_image_sample(&image, 1, 0, 1, 2) == 12 / 255.0);
    plr_image_free(&image);
}

static void test_field_fault(bool three, const int32_t *ints, size_t count, const char *message) {
    plr_image image;
    plr_diags *diags = plr_diags_create(NULL);
    plr_field field = make_field(three ? PLR_MFINT32 : PLR_SFIMAGE, ints, count);
    bool ok = (three ? plr_image_from_image3d : plr_image_from_sfimage)(&field, &image, diags);
    CHECK(!ok && !image.samples);
    CHECK_STR(diag_text(diags, 0), message);
    CHECK(plr_diags_get(diags, 0)->code == (three ? PLR_CODE_BAD_VOLUME : PLR_CODE_BAD_IMAGE));
    plr_diags_destroy(&diags);
}

static void test_field_faults(void) {
    test_field_fault(true, (const int32_t[]){1, 2, 2, 2, 1, 2, 3, 4, 5, 6, 7}, 11,
                     "scene.x3d:9:12 error 2 x 2 x 2 are 8 pixels, but the field has 7");
    test_field_fault(false, (const int32_t[]){2, 1, 1, 1, 2, 3}, 6,
                     "scene.x3d:9:12 error 2 x 1 x 1 are 2 pixels, but the field has 3");
    test_field_fault(true, (const int32_t[]){5, 1, 1, 1, 1}, 5,
                     "scene.x3d:9:12 error 5 components are outside 1..4");
    test_field_fault(true, (const int32_t[]){1, -1, 1, 1, 1}, 5,
                     "scene.x3d:9:12 error a side of -1 pixels is outside 1..32768");
    test_field_fault(true, (const int32_t[]){1, 2147483647, 2147483647, 2147483647, 1}, 5,
                     "scene.x3d:9:12 error a side of 2147483647 pixels is outside 1..32768");
    test_field_fault(false, (const int32_t[]){1, 1}, 2,
                     "scene.x3d:9:12 error an image needs at least 3 numbers: its sizes and "
                     "components");
}

/* ---- faults
 * --------------------------------------------------------------------------------------------------
 */

static void test_faults(void) {
    static file f;
    plr_image image;
    plr_diags *diags = plr_diags_create(NULL);
    unsigned char rows[64] = {0};
    memset(&f, 0, sizeof f);
    CHECK(!decode(&f, &image, diags));
    add_text(&f, "hello");
    CHECK(!decode(&f, &image, diags) && !image.samples);
    CHECK_STR(diag_text(diags, 0),
              "scene.x3d:9:12 error this image cannot be read: it is of no format "
              "that is read, or damaged");
    make_png(&f, 20000, 20000, 16, 4, rows, sizeof rows);
    CHECK(!decode(&f, &image, diags));
    CHECK_STR(diag_text(diags, 1),
              "scene.x3d:9:12 error this image cannot be read: it is too large");
    make_png(&f, 16000, 16000, 8, 0, rows, sizeof rows);
    CHECK(!decode(&f, &image, diags));
    CHECK_STR(diag_text(diags, 2), "scene.x3d:9:12 error this image cannot be read: it is cut off");
    make_png(&f, 4, 4, 8, 0, rows, 20);
    f.length -= 30;
    CHECK(!decode(&f, &image, diags));
    CHECK_INT(plr_diags_count(diags), 4);
    plr_diags_destroy(&diags);
}

/* The library gives no reason for this fault, if none came before: it must be a fault all the same.
 */
static void test_long_chunk(void) {
    static file f;
    static const char chunk[] = "\xff\0\0\0\x0bIDATx";
    plr_image image;
    plr_diags *diags = plr_diags_create(NULL);
    unsigned char rows[8] = {0};
    make_png(&f, 1, 1, 8, 0, rows, 2);
    memcpy(f.data + 33, chunk, sizeof chunk - 1);
    CHECK(!decode(&f, &image, diags) && !image.samples);
    CHECK_STR(diag_text(diags, 0), "scene.x3d:9:12 error this image cannot be read: it is damaged");
    plr_diags_destroy(&diags);
}

int main(void) {
    test_long_chunk(); /* before all others */
    test_png();
    test_hdr();
    test_hdr_runs();
    test_bmp();
    test_tga();
    test_gif();
    test_jpeg();
    test_nrrd();
    test_sfimage();
    test_image3d();
    test_field_faults();
    test_faults();
    return tap_done();
}
