/* NIfTI files: both versions, byte orders, types, scaling, geometry, pairs, errors. */
#include "volume_test.h"

/* A header to be filled in: offsets from the comments of nifti1.h and nifti2.h. */
typedef struct header {
    unsigned char bytes[544];
    size_t size;
    bool big_endian;
} header;

static void put_bits(header *h, size_t offset, uint64_t bits, size_t size) {
    for (size_t i = 0; i < size; i++)
        h->bytes[offset + i] = (unsigned char)(bits >> (8 * (h->big_endian ? size - 1 - i : i)));
}

static void put_float(header *h, size_t offset, double number) {
    float narrow = (float)number;
    uint32_t bits;
    memcpy(&bits, &narrow, 4);
    put_bits(h, offset, bits, 4);
}

static void put_double(header *h, size_t offset, double number) {
    uint64_t bits;
    memcpy(&bits, &number, 8);
    put_bits(h, offset, bits, 8);
}

static header make_header(int datatype, int width, int height, int depth, bool big_endian) {
    header h = {.size = 352, .big_endian = big_endian};
    const int dim[8] = {3, width, height, depth, 1, 1, 1, 1};
    put_bits(&h, 0, 348, 4);
    for (size_t i = 0; i < 8; i++)
        put_bits(&h, 40 + 2 * i, (uint64_t)dim[i], 2);
    put_bits(&h, 70, (uint64_t)datatype, 2);
    for (size_t i = 1; i < 4; i++)
        put_float(&h, 76 + 4 * i, 1);
    put_float(&h, 108, 352);
    memcpy(h.bytes + 344, "n+1", 4);
    return h;
}

static header make_header2(int datatype, int width, int height, int depth, bool big_endian) {
    header h = {.size = 544, .big_endian = big_endian};
    const int dim[8] = {3, width, height, depth, 1, 1, 1, 1};
    put_bits(&h, 0, 540, 4);
    memcpy(h.bytes + 4, "n+2\0\r\n\032\n", 8);
    put_bits(&h, 12, (uint64_t)datatype, 2);
    for (size_t i = 0; i < 8; i++)
        put_bits(&h, 16 + 8 * i, (uint64_t)dim[i], 8);
    for (size_t i = 1; i < 4; i++)
        put_double(&h, 104 + 8 * i, 2);
    put_bits(&h, 168, 544, 8);
    put_double(&h, 176, 0.5);
    put_double(&h, 184, -1);
    put_bits(&h, 500, 2, 4);
    return h;
}

static bool read_header(const header *h, const void *data, size_t length, plr_volume *volume,
                        plr_diags *diags) {
    static folder in;
    in.count = 0;
    file *f = add_file(&in, "a.nii");
    add_bytes(f, h->bytes, h->size);
    add_bytes(f, data, length);
    return read_volume(&in, volume, diags);
}

static const struct {
    int code;
    plr_voxel_type type;
    unsigned components;
    double least, greatest;
} types[] = {
    {2, PLR_VOXEL_U8, 1, 0, 255},
    {4, PLR_VOXEL_S16, 1, -32768, 32767},
    {8, PLR_VOXEL_S32, 1, -2147483648., 2147483647.},
    {16, PLR_VOXEL_F32, 1, -0.5, 1e30f},
    {64, PLR_VOXEL_F64, 1, -1e-200, 1e200},
    {256, PLR_VOXEL_S8, 1, -128, 127},
    {512, PLR_VOXEL_U16, 1, 0, 65535},
    {768, PLR_VOXEL_U32, 1, 0, 4294967295.},
    {1024, PLR_VOXEL_S64, 1, -0x1p60, 0x1p60},
    {1280, PLR_VOXEL_U64, 1, 0, 0x1p60},
    {128, PLR_VOXEL_U8, 3, 0, 255},
    {2304, PLR_VOXEL_U8, 4, 0, 255},
    {32, PLR_VOXEL_F32, 2, -3, 4},
};

/* 1 x 2 x 2 voxels of each type, in both byte orders and versions. */
static void test_type(size_t row, bool big_endian, bool second) {
    header h = (second ? make_header2 : make_header)(types[row].code, 1, 2, 2, big_endian);
    static file data;
    memset(&data, 0, sizeof data);
    unsigned n = types[row].components;
    for (unsigned i = 0; i < 4 * n; i++)
        add_number(&data, types[row].type,
                   i == 0           ? types[row].least
                   : i == 4 * n - 1 ? types[row].greatest
                                    : i,
                   big_endian);
    plr_volume v;
    bool ok = read_header(&h, data.data, data.length, &v, NULL) && v.type == types[row].type &&
              v.components == n && v.size[0] == 1 && v.size[1] == 2 && v.size[2] == 2;
    bool scaled = second && n < 3;
    for (unsigned i = 0; ok && i < 4 * n; i++) {
        double stored = i == 0 ? types[row].least : i == 4 * n - 1 ? types[row].greatest : i;
        ok = plr_volume_value(&v, 0, i / n % 2, i / n / 2, i % n) ==
             (scaled ? stored * 0.5 - 1 : stored);
    }
    TAP_RESULT(ok, "type %d %s NIfTI-%d", types[row].code, big_endian ? "big" : "little",
               second ? 2 : 1);
    plr_volume_free(&v);
}

static void test_types(void) {
    for (size_t row = 0; row < sizeof types / sizeof *types; row++)
        for (int i = 0; i < 4; i++)
            test_type(row, i & 1, i & 2);
}

static void test_values(void) {
    plr_volume v;
    header h = make_header(4, 2, 1, 1, false);
    put_float(&h, 112, 2);     /* scl_slope */
    put_float(&h, 116, -1024); /* scl_inter */
    CHECK(read_header(&h, "\0\0\0\4", 4, &v, NULL));
    CHECK(v.slope == 2 && v.intercept == -1024 && !v.range_declared);
    CHECK(v.minimum == -1024 && v.maximum == 1024);
    plr_volume_free(&v);
    put_float(&h, 112, -2);
    CHECK(read_header(&h, "\0\0\0\4", 4, &v, NULL));
    CHECK(v.minimum == -3072 && v.maximum == -1024);
    plr_volume_free(&v);
    put_float(&h, 112, 0); /* no scaling at all */
    put_float(&h, 124, 500);
    put_float(&h, 128, -100);
    CHECK(read_header(&h, "\0\0\0\4", 4, &v, NULL));
    CHECK(v.slope == 1 && v.intercept == 0 && v.range_declared);
    CHECK(v.minimum == -100 && v.maximum == 500);
    plr_volume_free(&v);
    h = make_header(2, 2, 1, 1, false);
    CHECK(read_header(&h, "\3\7", 2, &v, NULL));
    CHECK(v.minimum == 0 && v.maximum == 255);
    plr_volume_free(&v);
    put_float(&h, 112, 10);
    CHECK(read_header(&h, "\3\7", 2, &v, NULL));
    CHECK(v.minimum == 30 && v.maximum == 70);
    plr_volume_free(&v);
}

/* ---- geometry ---- */

static bool has_direction(const plr_volume *v, int axis, double x, double y, double z) {
    return fabs(v->directions[axis][0] - x) < 1e-6 && fabs(v->directions[axis][1] - y) < 1e-6 &&
           fabs(v->directions[axis][2] - z) < 1e-6;
}

static void test_geometry(void) {
    plr_volume v;
    header h = make_header(2, 1, 1, 1, true);
    put_float(&h, 76, -1);
    put_float(&h, 80, 2);
    put_float(&h, 84, 3);
    put_float(&h, 88, 4);
    h.bytes[123] = 3 | 8; /* micrometres, seconds */
    CHECK(read_header(&h, "a", 1, &v, NULL));
    CHECK(v.has_geometry && has_direction(&v, 0, 2, 0, 0) && has_direction(&v, 1, 0, 3, 0) &&
          has_direction(&v, 2, 0, 0, 4));
    CHECK(v.metres == 1e-6 && v.unplaced && v.space == PLR_SPACE_UNKNOWN);
    plr_volume_free(&v);
    /* a quarter turn around z: x to y, y to -x; qfac -1 turns the third axis round */
    put_bits(&h, 252, 1, 2);
    put_float(&h, 264, sqrt(0.5));
    put_float(&h, 268, 10);
    put_float(&h, 276, -30);
    CHECK(read_header(&h, "a", 1, &v, NULL));
    CHECK(v.space == PLR_SPACE_RAS && !v.unplaced);
    CHECK(has_direction(&v, 0, 0, 2, 0) && has_direction(&v, 1, -3, 0, 0) &&
          has_direction(&v, 2, 0, 0, -4));
    CHECK(v.origin[0] == 10 && v.origin[1] == 0 && v.origin[2] == -30);
    plr_volume_free(&v);
    /* a half turn around x, where a is 0 */
    put_float(&h, 256, 1);
    put_float(&h, 264, 0);
    put_float(&h, 76, 1);
    CHECK(read_header(&h, "a", 1, &v, NULL));
    CHECK(has_direction(&v, 0, 2, 0, 0) && has_direction(&v, 1, 0, -3, 0) &&
          has_direction(&v, 2, 0, 0, -4));
    plr_volume_free(&v);
    /* a third of a turn around (1,1,1): x to y to z to x */
    put_float(&h, 256, 0.5);
    put_float(&h, 260, 0.5);
    put_float(&h, 264, 0.5);
    CHECK(read_header(&h, "a", 1, &v, NULL));
    CHECK(has_direction(&v, 0, 0, 2, 0) && has_direction(&v, 1, 0, 0, 3) &&
          has_direction(&v, 2, 4, 0, 0));
    plr_volume_free(&v);
    /* the affine matrix goes before the quaternion */
    put_bits(&h, 254, 2, 2);
    for (size_t i = 0; i < 12; i++)
        put_float(&h, 280 + 4 * i, (double)i);
    CHECK(read_header(&h, "a", 1, &v, NULL));
    CHECK(has_direction(&v, 0, 0, 4, 8) && has_direction(&v, 1, 1, 5, 9) &&
          has_direction(&v, 2, 2, 6, 10));
    CHECK(v.origin[0] == 3 && v.origin[1] == 7 && v.origin[2] == 11);
    plr_volume_free(&v);
    header second = make_header2(2, 1, 1, 1, true);
    CHECK(read_header(&second, "a", 1, &v, NULL));
    CHECK(has_direction(&v, 1, 0, 2, 0) && v.metres == 1e-3);
    plr_volume_free(&v);
}

/* ---- files ---- */

static void test_extensions_and_gzip(void) {
    static folder in;
    static file plain;
    plr_volume v;
    header h = make_header(2, 3, 1, 1, false);
    put_float(&h, 108, 352 + 16);
    in.count = 0;
    memset(&plain, 0, sizeof plain);
    add_bytes(&plain, h.bytes, h.size);
    add_text(&plain, "an extension....abc");
    add_gzip(add_file(&in, "a.nii.gz"), plain.data, plain.length);
    CHECK(read_volume(&in, &v, NULL));
    CHECK(v.voxels && memcmp(v.voxels, "abc", 3) == 0);
    plr_volume_free(&v);
}

static void test_pair(const char *header_name, const char *image_name, bool pack) {
    static folder in;
    plr_volume v;
    header h = make_header(512, 2, 1, 1, false);
    memcpy(h.bytes + 344, "ni1", 4);
    put_float(&h, 108, 2);
    in.count = 0;
    add_bytes(add_file(&in, header_name), h.bytes, 348);
    file *image = add_file(&in, image_name);
    if (pack)
        add_gzip(image, "__\1\0\2\0", 6);
    else
        add_bytes(image, "__\1\0\2\0", 6);
    bool ok = read_volume(&in, &v, NULL);
    TAP_RESULT(ok && plr_volume_value(&v, 0, 0, 0, 0) == 1 && plr_volume_value(&v, 1, 0, 0, 0) == 2,
               "pair %s %s", header_name, image_name);
    plr_volume_free(&v);
}

static void test_axes(void) {
    plr_volume v;
    plr_diags *diags = plr_diags_create(NULL);
    header h = make_header(2, 2, 1, 1, false);
    put_bits(&h, 40, 4, 2);
    put_bits(&h, 48, 3, 2); /* three points in time */
    CHECK(read_header(&h, "abcdef", 6, &v, diags));
    CHECK(v.components == 1 && memcmp(v.voxels, "ab", 2) == 0);
    CHECK_STR(diag_text(diags, 0),
              "scene.x3d:7:3 warning a.nii holds more than one volume; only the first is used");
    plr_volume_free(&v);
    plr_diags_destroy(&diags);
    put_bits(&h, 40, 5, 2);
    put_bits(&h, 48, 1, 2);
    put_bits(&h, 50, 3, 2); /* vectors of three, plane after plane */
    CHECK(read_header(&h, "rRgGbB", 6, &v, NULL));
    CHECK(v.components == 3 && memcmp(v.voxels, "rgbRGB", 6) == 0);
    plr_volume_free(&v);
}

/* ---- faults ---- */

static void test_fault(const header *h, size_t length, const char *message) {
    plr_volume v;
    plr_diags *diags = plr_diags_create(NULL);
    static const char data[64];
    bool ok = read_header(h, data, length, &v, diags);
    TAP_RESULT(!ok && !v.voxels, "refused: %s", message);
    CHECK_STR(diag_text(diags, 0), message);
    plr_diags_destroy(&diags);
}

static void test_faults(void) {
    header h = make_header(4, 2, 3, 2, false);
    test_fault(&h, 23,
               "scene.x3d:7:3 error a.nii holds 23 bytes of voxels, but the header says 24");
    header other = h;
    put_bits(&other, 70, 1536, 2);
    test_fault(&other, 24,
               "scene.x3d:7:3 error a.nii has voxels of NIfTI type 1536, which are not read");
    other = h;
    put_bits(&other, 40, 8, 2);
    test_fault(&other, 24, "scene.x3d:7:3 error a.nii says 8 dimensions; 1..7 are possible");
    other = h;
    put_bits(&other, 44, (uint64_t)-3, 2);
    test_fault(&other, 24, "scene.x3d:7:3 error a.nii says -3 samples along axis 2");
    other = h;
    put_bits(&other, 44, 20000, 2);
    test_fault(&other, 24, "scene.x3d:7:3 error a side of 20000 voxels is outside 1..16384");
    other = h;
    put_float(&other, 108, 100);
    test_fault(&other, 24, "scene.x3d:7:3 error a.nii says that voxels begin at byte 100");
    other = h;
    memset(other.bytes + 344, 0, 4);
    test_fault(&other, 24,
               "scene.x3d:7:3 error a.nii is in ANALYZE 7.5 format, which is not read; convert it "
               "to NIfTI");
    other = h;
    memcpy(other.bytes + 344, "ni1", 4);
    test_fault(&other, 24, "scene.x3d:7:3 error a.img does not exist");
}

int main(void) {
    test_types();
    test_values();
    test_geometry();
    test_extensions_and_gzip();
    test_pair("a.hdr", "a.img", false);
    test_pair("folder/a.b.hdr", "a.b.img", true);
    test_pair("a.hdr.gz", "a.img.gz", true);
    test_pair("A.HDR", "A.IMG", false);
    test_axes();
    test_faults();
    return tap_done();
}
