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
    static const char *const names[] = {"a.nrrd", "a.nhdr",   "a.raw",    "a.hdr",
                                        "a.img",  "b.nii.gz", "deep.png", "a.dds"};
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

/* ---- PixelTexture3D, ComposedTexture3D
 * --------------------------------------------------------------- */

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

/* ---- ImageTexture3D
 * ------------------------------------------------------------------------------------- */

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

/* A grey PNG of one pixel of 16 bits. */
static void write_png(void) {
    static file f;
    const struct {
        const char *data;
        size_t length;
    } chunks[] = {{"IHDR\0\0\0\1\0\0\0\1\20\0\0\0\0", 17}, {NULL, 0}, {"IEND", 4}};
    unsigned char packed[64] = "IDAT";
    uLongf length = sizeof packed - 4;
    compress(packed + 4, &length, (const Bytef *)"\0\x12\x34", 3);
    memset(&f, 0, sizeof f);
    add_bytes(&f, "\x89PNG\r\n\032\n", 8);
    for (size_t i = 0; i < 3; i++) {
        const void *data = chunks[i].data ? (const void *)chunks[i].data : packed;
        size_t size = chunks[i].data ? chunks[i].length : length + 4;
        add_bits(&f, size - 4, 4, true);
        add_bytes(&f, data, size);
        add_bits(&f, crc32(0, data, (uInt)size), 4, true);
    }
    write_file("deep.png", f.data, f.length);
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
    write_png();
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
    test_file_faults();
    remove_files();
    return tap_done();
}
