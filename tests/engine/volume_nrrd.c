/* NRRD files: types, byte orders, encodings, detached data, axes, geometry, errors. */
#include "volume_test.h"

/* ---- values ---- */

static const struct {
    const char *names; /* separated by '|' */
    plr_voxel_type type;
    double least, greatest;
} spellings[] = {
    {"signed char|int8|int8_t", PLR_VOXEL_S8, -128, 127},
    {"uchar|unsigned char|uint8|uint8_t|UNSIGNED  CHAR", PLR_VOXEL_U8, 0, 255},
    {"short|short int|signed short|signed short int|int16|int16_t", PLR_VOXEL_S16, -32768, 32767},
    {"ushort|unsigned short|unsigned short int|uint16|uint16_t", PLR_VOXEL_U16, 0, 65535},
    {"int|signed int|int32|int32_t", PLR_VOXEL_S32, -2147483648., 2147483647.},
    {"uint|unsigned int|uint32|uint32_t", PLR_VOXEL_U32, 0, 4294967295.},
    {"longlong|long long|long long int|signed long long|signed long long int|int64|int64_t",
     PLR_VOXEL_S64, -0x1p62, 0x1p62},
    {"ulonglong|unsigned long long|unsigned long long int|uint64|uint64_t", PLR_VOXEL_U64, 0,
     0x1p62},
    {"float", PLR_VOXEL_F32, -1.5, 0x1p100},
    {"double", PLR_VOXEL_F64, -1e-300, 1e300},
};

/* 2 x 1 x 3 voxels: the ends of the type between 1, 2, 3 and 4. */
static void numbers_of(size_t row, double numbers[6]) {
    const double all[6] = {spellings[row].least, 1, 2, 3, 4, spellings[row].greatest};
    memcpy(numbers, all, sizeof all);
}

static bool has_numbers(const plr_volume *volume, const double numbers[6]) {
    for (uint32_t i = 0; i < 6; i++)
        if (plr_volume_value(volume, i % 2, 0, i / 2, 0) != numbers[i])
            return false;
    return true;
}

static void add_encoded(file *f, const char *encoding, const file *raw) {
    if (strcmp(encoding, "gzip") == 0) {
        add_gzip(f, raw->data, raw->length);
    } else if (strcmp(encoding, "hex") == 0) {
        for (size_t i = 0; i < raw->length; i++) {
            char pair[4];
            snprintf(pair, sizeof pair, i % 2 ? "%02x\n" : "%02X", raw->data[i]);
            add_text(f, pair);
        }
    } else {
        add_bytes(f, raw->data, raw->length);
    }
}

static void test_type(size_t row, const char *name, const char *encoding, bool big_endian) {
    static folder in;
    static file raw;
    double numbers[6];
    char line[256];
    in.count = 0;
    memset(&raw, 0, sizeof raw);
    numbers_of(row, numbers);
    for (int i = 0; i < 6; i++) {
        if (strcmp(encoding, "ascii") != 0) {
            add_number(&raw, spellings[row].type, numbers[i], big_endian);
            continue;
        }
        snprintf(line, sizeof line, spellings[row].type < PLR_VOXEL_F32 ? "%.0f\n" : "%.17g, ",
                 numbers[i]);
        add_text(&raw, line);
    }
    file *f = add_file(&in, "a.nrrd");
    snprintf(line, sizeof line,
             "NRRD0004\ntype: %s\ndimension: 3\nsizes: 2 1 3\nendian: %s\nencoding: %s\n\n", name,
             big_endian ? "big" : "little", encoding);
    add_text(f, line);
    add_encoded(f, encoding, &raw);
    plr_volume volume;
    plr_diags *diags = plr_diags_create(NULL);
    bool ok = read_volume(&in, &volume, diags) && volume.type == spellings[row].type &&
              has_numbers(&volume, numbers);
    TAP_RESULT(ok, "%s %s %s", name, encoding, big_endian ? "big" : "little");
    if (!ok || plr_diags_count(diags))
        printf("# %s\n", diag_text(diags, 0));
    plr_volume_free(&volume);
    plr_diags_destroy(&diags);
}

static void test_types(void) {
    static const char *const encodings[] = {"raw", "gzip", "hex", "ascii"};
    for (size_t row = 0; row < sizeof spellings / sizeof *spellings; row++) {
        char names[256];
        snprintf(names, sizeof names, "%s", spellings[row].names);
        char *rest = names, *first = strtok_r(rest, "|", &rest);
        for (char *name = first; name; name = strtok_r(NULL, "|", &rest))
            test_type(row, name, "raw", false);
        for (size_t e = 0; e < 4; e++)
            for (int big = 0; big < 2; big++)
                test_type(row, first, encodings[e], big);
    }
}

static void test_range(void) {
    static const char header[] = "NRRD0005\ntype: float\ndimension: 3\nsizes: 2 2 1\n"
                                 "encoding: ascii\n";
    plr_volume volume;
    CHECK(read_nrrd(header, "nan -3.5 inf 12", 15, &volume, NULL));
    CHECK(volume.minimum == -3.5 && volume.maximum == 12 && !volume.range_declared);
    CHECK(!volume.has_geometry && volume.slope == 1 && volume.intercept == 0);
    plr_volume_free(&volume);
    CHECK(read_nrrd("NRRD0001\ntype: short\ndimension: 3\nsizes: 2 1 1\nencoding: txt\n"
                    "min: -1000\nmax: 3000\nold min: 5\nold max: 6\n",
                    "0 100", 5, &volume, NULL));
    CHECK(volume.minimum == -1000 && volume.maximum == 3000 && volume.range_declared);
    plr_volume_free(&volume);
    CHECK(read_nrrd("NRRD0001\ntype: uchar\ndimension: 3\nsizes: 2 1 1\nencoding: raw\n", "\3\7", 2,
                    &volume, NULL));
    CHECK(volume.minimum == 0 && volume.maximum == 255 && !volume.range_declared);
    plr_volume_free(&volume);
    CHECK(read_nrrd("NRRD0001\ntype: int8\ndimension: 3\nsizes: 2 1 1\nencoding: raw\n", "\3\xf7",
                    2, &volume, NULL));
    CHECK(volume.minimum == -9 && volume.maximum == 3);
    plr_volume_free(&volume);
}

/* ---- where the data are
 * --------------------------------------------------------------------------- */

#define BYTES "NRRD0004\ntype: uchar\ndimension: 3\n"

static bool is_bytes(const plr_volume *volume, const char *expected) {
    return volume->voxels && memcmp(volume->voxels, expected, strlen(expected)) == 0;
}

static void test_skips(void) {
    plr_volume volume;
    CHECK(
        read_nrrd(BYTES "sizes: 2 1 1\nencoding: raw\nbyte skip: 3\n", "xyzab", 5, &volume, NULL));
    CHECK(is_bytes(&volume, "ab"));
    plr_volume_free(&volume);
    CHECK(
        read_nrrd(BYTES "sizes: 2 1 1\nencoding: raw\nbyteskip: -1\n", "xyzab", 5, &volume, NULL));
    CHECK(is_bytes(&volume, "ab"));
    plr_volume_free(&volume);
    CHECK(read_nrrd(BYTES "sizes: 2 1 1\nencoding: raw\nline skip: 2\nbyte skip: 1\n", "P5\n2\n_ab",
                    8, &volume, NULL));
    CHECK(is_bytes(&volume, "ab"));
    plr_volume_free(&volume);
    CHECK(read_nrrd(BYTES "sizes: 2 1 1\nencoding: hex\nlineskip: 1\n", "ff\n61 62", 8, &volume,
                    NULL));
    CHECK(is_bytes(&volume, "ab"));
    plr_volume_free(&volume);
    /* gzip: lines before, bytes after unpacking */
    static file packed;
    memset(&packed, 0, sizeof packed);
    add_text(&packed, "a line\n");
    add_gzip(&packed, "xyzab", 5);
    CHECK(read_nrrd(BYTES "sizes: 2 1 1\nencoding: gz\nline skip: 1\nbyte skip: 3\n", packed.data,
                    packed.length, &volume, NULL));
    CHECK(is_bytes(&volume, "ab"));
    plr_volume_free(&volume);
}

static void test_gzip_members(void) {
    static file packed;
    plr_volume volume;
    memset(&packed, 0, sizeof packed);
    add_gzip(&packed, "ab", 2);
    add_gzip(&packed, "cd", 2);
    add_text(&packed, "padding");
    CHECK(read_nrrd(BYTES "sizes: 4 1 1\nencoding: gzip\n", packed.data, packed.length, &volume,
                    NULL));
    CHECK(is_bytes(&volume, "abcd"));
    plr_volume_free(&volume);
}

/* `expected` NULL: it fails. */
static void test_detached(const char *data_file, const char *expected, const char *message) {
    static folder in;
    in.count = 0;
    file *header = add_file(&in, "a.nhdr");
    add_text(header, BYTES "sizes: 2 1 3\nencoding: raw\n");
    add_text(header, data_file);
    add_text(add_file(&in, "all data.raw"), "abcdef");
    add_text(add_file(&in, "s01.raw"), "ab");
    add_text(add_file(&in, "s03.raw"), "cd");
    add_text(add_file(&in, "s05.raw"), "ef");
    plr_volume volume;
    plr_diags *diags = plr_diags_create(NULL);
    bool ok = read_volume(&in, &volume, diags);
    TAP_RESULT(ok ? expected && is_bytes(&volume, expected) : !expected, "detached: %.*s",
               (int)strcspn(data_file, "\r\n"), data_file);
    CHECK_STR(diag_text(diags, 0), message);
    plr_volume_free(&volume);
    plr_diags_destroy(&diags);
}

static void test_detached_forms(void) {
    test_detached("data file: all data.raw\n", "abcdef", "(none)");
    test_detached("datafile:   all data.raw", "abcdef", "(none)");
    test_detached("data file: s%02d.raw 1 5 2\n", "abcdef", "(none)");
    test_detached("data file: s%02d.raw 1 5 2 2\n", "abcdef", "(none)");
    test_detached("data file: LIST\ns01.raw\r\n# a comment\ns03.raw\ns05.raw\n", "abcdef",
                  "(none)");
    test_detached("data file: LIST 2\ns01.raw\ns03.raw\ns05.raw\n\n", "abcdef", "(none)");
    test_detached("data file: s%02d.raw 5 1 -2\n", "efcdab", "(none)");
}

static void test_detached_faults(void) {
    test_detached("data file: none.raw\n", NULL, "a.nhdr:6:12 error none.raw does not exist");
    test_detached("data file: s%02d.raw 1 3 2\n", NULL,
                  "a.nhdr:6:12 error s01.raw holds 2 bytes of voxels, but the header says 3");
    test_detached("data file: s%02d.raw 1 4 1\n", NULL,
                  "a.nhdr:6:12 error 4 data files cannot hold 6 voxels");
    test_detached("data file: s%02d.raw 1 5 2 1\n", "abcdef", "(none)");
    test_detached("data file: s%s.raw 1 5 2\n", NULL,
                  "a.nhdr:6:12 error the name of data file 1 cannot be made");
    test_detached("data file: s%02d%n.raw 1 5 2\n", NULL,
                  "a.nhdr:6:12 error the name of data file 1 cannot be made");
    test_detached("data file: LIST\n", NULL, "a.nhdr:6:12 error the list of data files is empty");
    test_detached("data file: s%d.raw 1 5 0\n", NULL,
                  "a.nhdr:6:25 error no numbers lead from 1 to 5 in steps of 0");
}

/* ---- axes
 * ------------------------------------------------------------------------------------------- */

static void test_axes(const char *fields, const char *data, uint32_t width, uint32_t height,
                      uint32_t depth, uint32_t components, const char *expected, bool warns) {
    char header[512];
    plr_volume volume;
    plr_diags *diags = plr_diags_create(NULL);
    snprintf(header, sizeof header, "NRRD0004\ntype: uchar\nencoding: raw\n%s", fields);
    bool ok = read_nrrd(header, data, strlen(data), &volume, diags);
    TAP_RESULT(
        ok && volume.size[0] == width && volume.size[1] == height && volume.size[2] == depth &&
            volume.components == components && is_bytes(&volume, expected) &&
            (plr_diags_count_of(diags, PLR_WARNING) > 0) == warns,
        "axes: %.*s", (int)strcspn(strchr(fields, '\n') + 1, "\n"), strchr(fields, '\n') + 1);
    if (plr_diags_count(diags))
        printf("# %s\n", diag_text(diags, 0));
    plr_volume_free(&volume);
    plr_diags_destroy(&diags);
}

static void test_all_axes(void) {
    test_axes("dimension: 1\nsizes: 4\n", "abcd", 4, 1, 1, 1, "abcd", false);
    test_axes("dimension: 2\nsizes: 2 2\n", "abcd", 2, 2, 1, 1, "abcd", false);
    test_axes("dimension: 4\nsizes: 3 1 2 1\nkinds: RGB-color domain domain domain\n", "rgbRGB", 1,
              2, 1, 3, "rgbRGB", false);
    test_axes("dimension: 4\nsizes: 3 1 2 1\n", "rgbRGB", 1, 2, 1, 3, "rgbRGB", false);
    test_axes("dimension: 4\nsizes: 1 2 1 3\nkinds: domain domain domain vector\n", "rRgGbB", 1, 2,
              1, 3, "rgbRGB", false);
    test_axes("dimension: 4\nsizes: 2 1 2 2\nkinds: space complex space space\n", "abcdefgh", 2, 2,
              2, 1, "abcdefgh", false);
    test_axes("dimension: 4\nsizes: 2 2 2 1\nkinds: space complex space space\n", "abcdefgh", 2, 2,
              1, 2, "acbdegfh", false);
    test_axes("dimension: 4\nsizes: 5 1 1 2\n", "abcdefghij", 5, 1, 1, 1, "abcde", true);
    test_axes("dimension: 4\nsizes: 2 1 2 2\nkinds: time domain domain domain\n", "abcdefgh", 1, 2,
              2, 1, "aceg", true);
    test_axes("dimension: 4\nsizes: 2 2 1 2\nspace dimension: 3\n"
              "space directions: none (1,0,0) (0,1,0) (0,0,1)\n",
              "abcdefgh", 2, 1, 2, 2, "abcdefgh", false);
    test_axes("dimension: 3\nsizes: 4 2 1\nkinds: RGBA-color domain domain\n", "rgbaRGBA", 2, 1, 1,
              4, "rgbaRGBA", false);
}

/* ---- geometry
 * ---------------------------------------------------------------------------------------- */

static void test_geometry(void) {
    plr_volume v;
    CHECK(read_nrrd(BYTES "sizes: 1 2 1\nencoding: raw\nspace: left-posterior-superior\n"
                          "space directions: (0,2,0) (-1, 0,0.5) (0,0,3e0)\n"
                          "space origin: (10,-20,30)\nspace units: \"mm\" \"mm\" \"mm\"\n",
                    "ab", 2, &v, NULL));
    CHECK(v.has_geometry && v.space == PLR_SPACE_LPS && fabs(v.metres - 1e-3) < 1e-12);
    CHECK(v.directions[0][1] == 2 && v.directions[1][0] == -1 && v.directions[1][2] == 0.5 &&
          v.directions[2][2] == 3);
    CHECK(v.origin[0] == 10 && v.origin[1] == -20 && v.origin[2] == 30);
    plr_volume_free(&v);
    CHECK(read_nrrd(BYTES "sizes: 1 2 1\nencoding: raw\nspacings: 1 nan 2.5\n"
                          "units: \"um\" \"um\" \"um\"\n",
                    "ab", 2, &v, NULL));
    CHECK(v.has_geometry && v.directions[0][0] == 1 && v.directions[1][1] == 1 &&
          v.directions[2][2] == 2.5 && fabs(v.metres - 1e-6) < 1e-15);
    plr_volume_free(&v);
    CHECK(read_nrrd(BYTES "sizes: 1 2 1\nencoding: raw\nspace dimension: 3\n"
                          "space directions: (1,0,0) (0,1,0) (0,0,1)\n"
                          "space units: \"mm\" \"mm\" \"cm\"\n",
                    "ab", 2, &v, NULL));
    CHECK_NEAR(v.directions[2][2], 10, 1e-12);
    plr_volume_free(&v);
}

/* ---- headers
 * ------------------------------------------------------------------------------------------ */

static void test_header_forms(void) {
    static folder in;
    plr_volume volume;
    plr_diags *diags = plr_diags_create(NULL);
    in.count = 0;
    add_text(add_file(&in, "crlf.nrrd"),
             "NRRD0004\r\n# a comment: with a colon\r\nContent: anything\r\nTYPE: UChar\r\n"
             "dimension: 3\r\nsizes: 2 1 1\r\nkey:=value: x\r\nencoding: RAW\r\n\r\nab");
    CHECK(read_volume(&in, &volume, diags));
    CHECK(is_bytes(&volume, "ab"));
    CHECK_INT(plr_diags_count(diags), 0);
    plr_volume_free(&volume);
    in.count = 0;
    static file inner;
    memset(&inner, 0, sizeof inner);
    add_text(&inner, BYTES "sizes: 2 1 1\nencoding: raw\n\nab");
    add_gzip(add_file(&in, "packed.nrrd.gz"), inner.data, inner.length);
    CHECK(read_volume(&in, &volume, diags));
    CHECK(is_bytes(&volume, "ab"));
    plr_volume_free(&volume);
    plr_diags_destroy(&diags);
}

static const struct {
    const char *text, *message;
} faults[] = {
    {"NRRD0009\ntype: uchar\n\n", "f:1:1 error 'NRRD0009' is not a version of NRRD that is known"},
    {"NRRD0004\ntype: char\n\n", "f:2:7 error 'char' is not a type of NRRD"},
    {"NRRD0004\ntype: block\n\n", "f:2:7 error data of type block have no values to draw"},
    {BYTES "sizes: 2 x 1\n\n", "f:4:10 error 'x' is not an integer"},
    {BYTES "sizes: 2 0 1\n\n", "f:4:10 error an axis has no samples"},
    {BYTES "sizes: 2 -1 1\n\n", "f:4:10 error -1 is out of range"},
    {BYTES "sizes: 2 2\nencoding: raw\n\nabcd", "f:4:8 error sizes has 2 values for 3 axes"},
    {BYTES "sizes: 2 2 1\nkinds: domain\nencoding: raw\n\nabcd",
     "f:5:8 error kinds has 1 values for 3 axes"},
    {BYTES "sizes: 2 2 1\nkinds: domain other domain\nencoding: raw\n\nabcd",
     "f:5:15 error 'other' is not a kind of axis"},
    {BYTES "sizes: 2 2 1\nencoding: raw\n\nabc",
     "f:4:8 error f holds 3 bytes of voxels, but the header says 4"},
    {BYTES "sizes: 2 2 1\nencoding: hex\n\n61 62 63 6",
     "f:4:8 error f holds 3 bytes of voxels, but the header says 4"},
    {BYTES "sizes: 2 2 1\nencoding: ascii\n\n1 2 3    ",
     "f:4:8 error f holds 3 numbers, but the header says 4"},
    {BYTES "sizes: 2 2 1\nencoding: ascii\n\n1 2\n3 256\n",
     "f:8:3 error this does not fit the type: voxels are unsigned 8-bit integers"},
    {BYTES "sizes: 2 2 1\nencoding: ascii\n\n1 2\n3 4.5\n",
     "f:8:3 error this is not an integer: voxels are unsigned 8-bit integers"},
    {BYTES "sizes: 2 2 1\nencoding: bzip2\n\n",
     "f:5:11 error data packed by bzip2 are not read; save them as raw or gzip"},
    {BYTES "sizes: 2 2 1\nencoding: zip\n\n", "f:5:11 error 'zip' is not an encoding of NRRD"},
    {BYTES "sizes: 2 2 1\nencoding: gzip\nbyte skip: -1\n\n",
     "f:5:11 error byte skip -1 needs the encoding raw"},
    {BYTES "sizes: 2 2 1\nencoding: gzip\n\nthis is not gzip data, but longer than 18",
     "f:4:8 error the data of f cannot be unpacked: they are not in gzip format after 0 of 4 "
     "bytes"},
    {BYTES "sizes: 2 2 1\nencoding: raw\nline skip: 2\n\n12345\n78",
     "f:4:8 error f has fewer than the 2 lines to skip"},
    {BYTES "sizes: 2 2 1\nencoding: raw\nbyte skip: 9\n\n12345678",
     "f:4:8 error f has fewer than the 9 bytes to skip"},
    {BYTES "sizes: 2 2 1\nencoding: raw\nabcd",
     "f:6:1 error this is no field of a header; an empty "
     "line ends the header"},
    {BYTES "sizes: 2 2 1\nencoding: raw\n",
     "f:5:1 error the header names no data file, and no empty line ends it"},
    {BYTES "encoding: raw\n\n", "f:5:1 error the header has no sizes"},
    {BYTES "sizes: 16385 1 1\nencoding: raw\n\n",
     "f:4:8 error a side of 16385 voxels is outside 1..16384"},
    {BYTES "sizes: 16384 16384 16384\nencoding: raw\n\n", "f:4:8 error there are too many voxels"},
    {BYTES "sizes: 4096 1024 1025\nencoding: raw\n\n",
     "f:4:8 error the voxels are more than 4294967296 bytes"},
    {BYTES "sizes: 9007199254740992 9007199254740992 9007199254740992\nencoding: raw\n\n",
     "f:4:8 error there are too many voxels"},
    {BYTES "sizes: 4000 4000 2\nencoding: gzip\n\n0123456789",
     "f:4:8 error f holds 10400 bytes of voxels, but the header says 32000000"},
    {"NRRD0004\ndimension: 17\n\n", "f:2:12 error 17 axes are outside 1..16"},
    {BYTES "space directions: (1,0,0) (0,1)\n\n",
     "f:4:27 error this vector has 2 numbers, the one before 3"},
    {BYTES "space directions: (1,0,0\n\n", "f:4:23 error this vector is never closed"},
    {BYTES "space units: \"mm\n\n", "f:4:14 error this string is never closed"},
    {BYTES "min: 1e\n\n", "f:4:6 error '1e' is not a number"},
    {BYTES "endian: middle\n\n", "f:4:9 error 'middle' is neither little nor big"},
    {"something else", "scene.x3d:7:3 error f is neither NRRD nor NIfTI"},
    {"", "scene.x3d:7:3 error f is neither NRRD nor NIfTI"},
};

static void test_faults(void) {
    static folder in;
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        plr_volume volume;
        plr_diags *diags = plr_diags_create(NULL);
        in.count = 0;
        add_text(add_file(&in, "f"), faults[i].text);
        bool ok = read_volume(&in, &volume, diags);
        TAP_RESULT(!ok && !volume.voxels && strcmp(diag_text(diags, 0), faults[i].message) == 0,
                   "%s", faults[i].message);
        if (strcmp(diag_text(diags, 0), faults[i].message) != 0)
            printf("# %s\n", diag_text(diags, 0));
        plr_diags_destroy(&diags);
    }
}

static void test_warnings(void) {
    plr_volume volume;
    plr_diags *diags = plr_diags_create(NULL);
    CHECK(read_nrrd("NRRD0004\ntype: short\ndimension: 3\nsizes: 1 1 1\nencoding: raw\ncolour: 1\n"
                    "min: 4\nmax: 4\n",
                    "\1\2", 2, &volume, diags));
    CHECK_STR(diag_text(diags, 0), "head.nrrd:6:1 warning 'colour' is not a field of NRRD");
    CHECK_STR(diag_text(diags, 1),
              "head.nrrd:2:7 warning the header does not say endian; little is assumed");
    CHECK_STR(diag_text(diags, 2),
              "head.nrrd:4:8 warning min is not less than max; the range of the data is used");
    CHECK(plr_volume_value(&volume, 0, 0, 0, 0) == 513 && volume.minimum == 513);
    plr_volume_free(&volume);
    plr_diags_destroy(&diags);
}

static void test_long_header(void) {
    size_t size = (1u << 20) + 100;
    char *text = malloc(size);
    memset(text, ' ', size);
    memcpy(text, "NRRD0004\n#", 10);
    plr_volume volume;
    plr_diags *diags = plr_diags_create(NULL);
    plr_volume_source source = {.data = text, .length = size, .name = "f", .diags = diags};
    CHECK(!plr_volume_parse(&source, &volume));
    CHECK_STR(diag_text(diags, 0), "f:2:1 error the header is longer than 1048576 bytes");
    plr_diags_destroy(&diags);
    free(text);
}

int main(void) {
    test_types();
    test_range();
    test_skips();
    test_gzip_members();
    test_detached_forms();
    test_detached_faults();
    test_all_axes();
    test_geometry();
    test_header_forms();
    test_faults();
    test_warnings();
    test_long_header();
    return tap_done();
}
