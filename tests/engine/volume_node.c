/* Volumes and images from the texture nodes of scenes, with their files beside them. */
#include "volume_test.h"

#include <unistd.h>

static char base[] = "/tmp/plugray-volume-XXXXXX";

static void write_file(const char *name, const void *data, size_t length) {
    char path[256];
    snprintf(path, sizeof path, "%s/%s", base, name);
    FILE *f = fopen(path, "wb");
    if (f) {
        fwrite(data, 1, length, f);
        fclose(f);
    }
}

static void remove_files(void) {
    static const char *const names[] = {
        "a.nrrd",   "a.nhdr",  "a.raw",     "a.hdr",    "a.img",   "b.nii.gz",
        "deep.png", "a.dds",   "b.nii.txt", "a.txt",    "s08.png", "s09.png",
        "s10.png",  "s11.png", "whole.png", "part.png", "t.nrrd",  "slice.nrrd"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[256];
        snprintf(path, sizeof path, "%s/%s", base, names[i]);
        unlink(path);
    }
    rmdir(base);
}

/* Reads the texture node T of a scene in Classic VRML. */
static bool read_texture(const char *text, plr_volume *volume, plr_diags *diags) {
    char all[2048], path[256];
    snprintf(path, sizeof path, "%s/scene.x3dv", base);
    snprintf(all, sizeof all, "#X3D V4.0 utf8\nPROFILE Full\nVolumeData {\nvoxels DEF T %s\n}\n",
             text);
    plr_scene *scene = plr_scene_parse(all, strlen(all), path, NULL, diags);
    plr_node *node = scene ? plr_scene_find(scene, "T") : NULL;
    bool ok = node && plr_volume_from_node(scene, node, volume, diags);
    plr_scene_destroy(&scene);
    return ok;
}

/* The last diagnostic without the folder. */
static const char *last_diag(const plr_diags *diags) {
    size_t count = plr_diags_count(diags);
    const char *text = count ? diag_text(diags, count - 1) : "(none)";
    static char clean[1024];
    size_t used = 0, skip = strlen(base) + 1;
    while (*text && used < sizeof clean - 1) {
        if (strncmp(text, base, skip - 1) == 0)
            text += skip;
        clean[used++] = *text++;
    }
    clean[used] = '\0';
    return clean;
}

static void check_fault(const char *texture, const char *message) {
    plr_volume v;
    plr_diags *diags = plr_diags_create(NULL);
    CHECK(!read_texture(texture, &v, diags));
    CHECK_STR(last_diag(diags), message);
    plr_diags_destroy(&diags);
}

/* ---- PixelTexture3D, ComposedTexture3D ---- */

static void test_pixels(void) {
    plr_volume v;
    CHECK(
        read_texture("PixelTexture3D { image [ 2 1 2 2 0x0102 0x0304 0x0506 0xff08 ] }", &v, NULL));
    CHECK(v.size[0] == 1 && v.size[1] == 2 && v.size[2] == 2 && v.components == 2);
    CHECK(v.type == PLR_VOXEL_U8 && v.minimum == 0 && v.maximum == 255 && !v.has_geometry);
    CHECK(plr_volume_value(&v, 0, 1, 0, 0) == 3 && plr_volume_value(&v, 0, 1, 1, 0) == 255 &&
          plr_volume_value(&v, 0, 1, 1, 1) == 8);
    plr_volume_free(&v);
    check_fault("PixelTexture3D { }", "scene.x3dv:4:14 error the image has no pixels");
}

static void test_slices(void) {
    plr_volume v;
    CHECK(read_texture("ComposedTexture3D { texture [ PixelTexture { image 2 1 1 1 2 } "
                       "PixelTexture { image 2 1 1 3 4 } ] }",
                       &v, NULL));
    CHECK(v.size[0] == 2 && v.size[1] == 1 && v.size[2] == 2 && v.type == PLR_VOXEL_U8);
    CHECK(memcmp(v.voxels, "\1\2\3\4", 4) == 0);
    plr_volume_free(&v);
    /* a slice of 16 bits keeps them, the one of 8 bits is widened exactly */
    CHECK(read_texture("ComposedTexture3D { texture [ PixelTexture { image 1 1 1 0xff } "
                       "ImageTexture { url \"deep.png\" } ] }",
                       &v, NULL));
    CHECK(v.type == PLR_VOXEL_U16 && v.size[2] == 2 && v.minimum == 0 && v.maximum == 65535);
    CHECK(plr_volume_value(&v, 0, 0, 0, 0) == 65535 && plr_volume_value(&v, 0, 0, 1, 0) == 0x1234);
    plr_volume_free(&v);
    check_fault("ComposedTexture3D { texture [ PixelTexture { image 1 1 1 1 }\n"
                "PixelTexture { image 2 1 1 1 1 } ] }",
                "scene.x3dv:5:1 error slice 1 is 2 x 1 with 1 components, but the first is 1 x 1 "
                "with 1");
    check_fault("ComposedTexture3D { }", "scene.x3dv:4:14 error 0 slices are outside 1..16384");
}

/* ---- ImageTexture3D ---- */

static bool is_volume(const plr_volume *v, uint32_t width, const char *bytes) {
    return v->size[0] == width && v->size[1] == 1 && v->size[2] == 1 && v->voxels &&
           memcmp(v->voxels, bytes, width) == 0;
}

static void test_files(void) {
    static const char *const names[] = {"a.nrrd", "a.nhdr", "a.hdr", "b.nii.gz"};
    for (size_t i = 0; i < 4; i++) {
        char text[128];
        plr_volume v = {0};
        plr_diags *diags = plr_diags_create(NULL);
        snprintf(text, sizeof text, "ImageTexture3D { url [ \"none.nrrd\" \"%s\" ] }", names[i]);
        bool ok =
            read_texture(text, &v, diags) && is_volume(&v, 3, "abc") && plr_diags_count(diags) == 0;
        TAP_RESULT(ok, "%s", names[i]);
        if (!ok)
            printf("# %s\n", last_diag(diags));
        plr_volume_free(&v);
        plr_diags_destroy(&diags);
    }
    plr_volume v;
    CHECK(read_texture("ImageTexture3D { url \"deep.png\" }", &v, NULL));
    CHECK(v.size[0] == 1 && v.size[2] == 1 && plr_volume_value(&v, 0, 0, 0, 0) == 0x1234 &&
          v.maximum == 65535);
    plr_volume_free(&v);
}

static void test_file_faults(void) {
    check_fault("ImageTexture3D { url \"a.dds\" }",
                "scene.x3dv:4:36 error this image cannot be read: it is cut off");
    check_fault("ImageTexture3D { url \"a.raw\" }",
                "scene.x3dv:4:36 error this image cannot be read: it is of no format "
                "that is read, or damaged");
    check_fault("ImageTexture3D { }", "scene.x3dv:4:14 error ImageTexture3D has no url");
    write_file("a.nrrd", "NRRD0004\ntype: uchar\ndimension: x\n", 34);
    check_fault("ImageTexture3D { url \"a.nrrd\" }", "a.nrrd:3:12 error 'x' is not an integer");
    static const char outside[] = "NRRD0004\ntype: uchar\ndimension: 1\nsizes: 3\nencoding: raw\n"
                                  "data file: ../../etc/hostname\n";
    write_file("a.nhdr", outside, sizeof outside - 1);
    plr_volume v;
    plr_diags *diags = plr_diags_create(NULL);
    CHECK(!read_texture("ImageTexture3D { url \"a.nhdr\" }", &v, diags));
    CHECK(strncmp(last_diag(diags), "a.nhdr:6:12 error", 17) == 0);
    const plr_diag *diag = plr_diags_get(diags, 0);
    CHECK(diag && (diag->code == PLR_CODE_NOT_ALLOWED || diag->code == PLR_CODE_MISSING_FILE));
    plr_diags_destroy(&diags);
}

/* ---- Labels beside, time points ---- */

static void check_label(const char *url, uint32_t value, const char *name) {
    char text[128];
    plr_volume v = {0};
    plr_diags *diags = plr_diags_create(NULL);
    snprintf(text, sizeof text, "ImageTexture3D { url \"%s\" }", url);
    bool fine = read_texture(text, &v, diags) && plr_diags_count(diags) == 0;
    const plr_label *label = plr_labels_find(&v.labels, value);
    TAP_RESULT(fine && (name ? label && strcmp(label->name, name) == 0 : v.labels.count == 0),
               "labels beside %s", url);
    plr_volume_free(&v);
    plr_diags_destroy(&diags);
}

static void test_labels(void) {
    check_label("b.nii.gz", 3, NULL);
    write_file("a.txt", "This is some text.\n3 three\n", 27);
    check_label("a.nrrd", 3, NULL);
    write_file("b.nii.txt", "3 three\n", 8);
    check_label("b.nii.gz", 3, "three");
    write_file("a.txt", "3 three\nmore\n", 13);
    plr_volume v;
    plr_diags *diags = plr_diags_create(NULL);
    CHECK(read_texture("ImageTexture3D { url \"a.nhdr\" }", &v, diags) && v.labels.count == 1);
    CHECK_STR(last_diag(diags), "a.txt:2:1 warning this is no label (number, name and perhaps a "
                                "colour); labels are read up to here");
    plr_volume_free(&v);
    plr_diags_destroy(&diags);
}

static void check_time(const char *field, const char *bytes, const char *message) {
    char text[128];
    plr_volume v = {0};
    plr_diags *diags = plr_diags_create(NULL);
    snprintf(text, sizeof text, "ImageTexture3D {\nurl \"t.nrrd\" %s }", field);
    bool fine = read_texture(text, &v, diags) && v.size[0] == 2 && memcmp(v.voxels, bytes, 2) == 0;
    TAP_RESULT(fine, "%s gives %s", field, bytes);
    CHECK_STR(last_diag(diags), message);
    plr_volume_free(&v);
    plr_diags_destroy(&diags);
}

static void test_time(void) {
    static const char series[] = "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 1 1 3\n"
                                 "kinds: domain domain domain time\nencoding: raw\n\nabcdef";
    write_file("t.nrrd", series, sizeof series - 1);
    check_time("timePoint 1", "cd", "(none)");
    check_time("timePoint 0", "ab", "(none)");
    check_time("timePoint 7", "ef",
               "scene.x3dv:5:14 warning there is no time point 7; t.nrrd has 3, counted from 0, "
               "and the last is taken");
    check_time("", "ab",
               "t.nrrd:4:8 warning axis 3 of 3 samples is neither space nor components of a voxel; "
               "only the first sample is used");
}

/* ---- Numbered files, atlases ---- */

static void write_grey(const char *name, uint32_t width, uint32_t height, unsigned depth,
                       const unsigned char *rows);

static void test_numbered(void) {
    write_grey("s08.png", 2, 1, 8, (const unsigned char[]){0, 1, 2});
    write_grey("s09.png", 2, 1, 8, (const unsigned char[]){0, 3, 4});
    write_grey("s10.png", 2, 1, 16, (const unsigned char[]){0, 5, 5, 6, 6});
    plr_volume v;
    CHECK(read_texture("ImageTexture3D { url \"s%02d.png 8 9\" }", &v, NULL));
    CHECK(v.size[0] == 2 && v.size[1] == 1 && v.size[2] == 2 && v.type == PLR_VOXEL_U8 &&
          memcmp(v.voxels, "\1\2\3\4", 4) == 0);
    plr_volume_free(&v);
    CHECK(read_texture("ImageTexture3D { url \"s%02d.png 9 8 -1\" }", &v, NULL));
    CHECK(v.size[2] == 2 && memcmp(v.voxels, "\3\4\1\2", 4) == 0);
    plr_volume_free(&v);
    CHECK(read_texture("ImageTexture3D { url \"s%02d.png 8 10 2\" }", &v, NULL));
    CHECK(v.type == PLR_VOXEL_U16 &&
          memcmp(v.voxels, (const uint16_t[]){0x101, 0x202, 0x505, 0x606}, 8) == 0);
    plr_volume_free(&v);
    check_fault("ImageTexture3D { url \"s%02d.png 8 11\" }",
                "scene.x3dv:4:36 error 's11.png' does not exist");
    write_grey("s11.png", 1, 1, 8, (const unsigned char[]){0, 1});
    check_fault("ImageTexture3D { url \"s%02d.png 8 11\" }",
                "scene.x3dv:4:36 error slice 3 is 1 x 1 with 1 components, but the first is 2 x 1 "
                "with 1");
    check_fault("ImageTexture3D { url \"s%02d.png 1 99999\" }",
                "scene.x3dv:4:36 error 99999 slices are outside 1..16384");
    check_fault("ImageTexture3D { url \"a.txt 1 2\" }",
                "scene.x3dv:4:36 error 'a.txt 1 2' does not exist");
    check_fault("ImageTexture3D { url \"../s%02d.png 1 2\" }",
                "scene.x3dv:4:36 error '../s01.png' is outside the folders that may be read");
}

static bool is_atlas(const char *fields, uint32_t w, uint32_t h, uint32_t d, const char *bytes) {
    char text[256];
    plr_volume v = {0};
    snprintf(text, sizeof text, "ImageTextureAtlas { %s }", fields);
    bool same = read_texture(text, &v, NULL) && v.size[0] == w && v.size[1] == h &&
                v.size[2] == d && memcmp(v.voxels, bytes, (size_t)w * h * d) == 0;
    plr_volume_free(&v);
    return same;
}

static void test_atlas(void) {
    /* 4 x 4 pixels, rows from the top 01 23 / 45 67 / 89 ab / cd ef */
    write_grey("whole.png", 4, 4, 8, (const unsigned char[]){0, 0, 1, 2,  3,  0, 4,  5,  6,  7,
                                                             0, 8, 9, 10, 11, 0, 12, 13, 14, 15});
    CHECK(is_atlas("url \"whole.png\" slicesOverX 2 slicesOverY 2", 2, 2, 4,
                   "\0\1\4\5\2\3\6\7\10\11\14\15\12\13\16\17"));
    CHECK(is_atlas("url \"whole.png\" slicesOverX 2 slicesOverY 2 numberOfSlices 3", 2, 2, 3,
                   "\0\1\4\5\2\3\6\7\10\11\14\15"));
    CHECK(is_atlas("url \"whole.png\" slicesOverX 1 slicesOverY 4", 4, 1, 4,
                   "\0\1\2\3\4\5\6\7\10\11\12\13\14\15\16\17"));
    /* 8 pixels for 3 tiles of 2.67: the pixels at a quarter and three quarters of each, 0.67 2.00
     * 3.33 4.67 6.00 7.33 */
    write_grey("part.png", 8, 1, 8, (const unsigned char[]){0, 10, 11, 12, 13, 14, 15, 16, 17});
    CHECK(is_atlas("url \"part.png\" slicesOverX 3 slicesOverY 1", 2, 1, 3, "\12\14\15\16\20\21"));
    CHECK(is_atlas("url \"whole.png\" slicesOverX 3 slicesOverY 1", 1, 4, 3,
                   "\0\4\10\14\2\6\12\16\3\7\13\17"));
    check_fault("ImageTextureAtlas { url \"whole.png\" }",
                "scene.x3dv:4:14 error slicesOverX and slicesOverY must say how the picture is "
                "divided: 0 x 0 tiles are outside 1..32768");
    check_fault("ImageTextureAtlas { url \"whole.png\" slicesOverX 5 slicesOverY 1 }",
                "scene.x3dv:4:39 error a picture of 4 x 4 pixels has no room for 5 x 1 tiles");
    check_fault("ImageTextureAtlas { url \"none.png\" slicesOverX 1 slicesOverY 1 }",
                "scene.x3dv:4:39 error 'none.png' does not exist");
    plr_volume v;
    plr_diags *diags = plr_diags_create(NULL);
    CHECK(read_texture("ImageTextureAtlas { url \"whole.png\" slicesOverX 2 slicesOverY 1 "
                       "numberOfSlices 3 }",
                       &v, diags));
    CHECK(v.size[0] == 2 && v.size[1] == 4 && v.size[2] == 2);
    CHECK_STR(last_diag(diags), "scene.x3dv:4:78 warning 3 slices are more than 2 x 1 tiles");
    plr_volume_free(&v);
    plr_diags_destroy(&diags);
}

/* A grey PNG of 8 or 16 bits; each row begins with a 0. */
static void write_grey(const char *name, uint32_t width, uint32_t height, unsigned depth,
                       const unsigned char *rows) {
    static file f;
    char head[17] = "IHDR";
    head[7] = (char)width;
    head[11] = (char)height;
    head[12] = (char)depth;
    const struct {
        const char *data;
        size_t length;
    } chunks[] = {{head, 17}, {NULL, 0}, {"IEND", 4}};
    unsigned char packed[128] = "IDAT";
    uLongf length = sizeof packed - 4;
    compress(packed + 4, &length, rows, (1 + width * depth / 8) * height);
    memset(&f, 0, sizeof f);
    add_bytes(&f, "\x89PNG\r\n\032\n", 8);
    for (size_t i = 0; i < 3; i++) {
        const void *data = chunks[i].data ? (const void *)chunks[i].data : packed;
        size_t size = chunks[i].data ? chunks[i].length : length + 4;
        add_bits(&f, size - 4, 4, true);
        add_bytes(&f, data, size);
        add_bits(&f, crc32(0, data, (uInt)size), 4, true);
    }
    write_file(name, f.data, f.length);
}

static void write_files(void) {
    static file f, packed;
    static const char attached[] = "NRRD0004\ntype: uchar\ndimension: 1\nsizes: 3\n"
                                   "encoding: raw\n\nabc";
    static const char detached[] = "NRRD0004\ntype: uchar\ndimension: 1\nsizes: 3\n"
                                   "encoding: raw\nbyte skip: 1\ndata file: a.raw\n";
    write_file("a.nrrd", attached, sizeof attached - 1);
    write_file("a.nhdr", detached, sizeof detached - 1);
    write_file("a.raw", "_abc", 4);
    memset(&f, 0, sizeof f);
    add_bits(&f, 348, 4, false);
    f.length = 40;
    for (int i = 0; i < 8; i++)
        add_bits(&f, i == 1 ? 3 : 1, 2, false);
    f.length = 70;
    add_bits(&f, 2, 2, false);
    f.length = 344;
    add_bytes(&f, "ni1", 4);
    write_file("a.hdr", f.data, 348);
    write_file("a.img", "abc", 3);
    f.data[345] = '+';
    f.length = 344;
    add_bytes(&f, "n+1\0\0\0\0\0abc", 11);
    memset(&packed, 0, sizeof packed);
    add_gzip(&packed, f.data, f.length);
    write_file("b.nii.gz", packed.data, packed.length);
    write_file("a.dds", "DDS and so on", 13);
    write_grey("deep.png", 1, 1, 16, (const unsigned char[]){0, 0x12, 0x34});
}

int main(void) {
    if (!mkdtemp(base)) {
        TAP_SKIP("texture nodes", "no folder for temporary files");
        return tap_done();
    }
    write_files();
    test_pixels();
    test_slices();
    test_files();
    test_labels();
    test_time();
    test_numbered();
    test_atlas();
    test_file_faults();
    remove_files();
    return tap_done();
}
