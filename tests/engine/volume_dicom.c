/* What DICOM slices become in memory: geometry, types, ranges, and files that change meanwhile. */
#include <math.h>
#include <stdio.h>

#include "engine/volume_dicom_file.h"
#include "tests/engine/volume_test.h"

/* ---- Files ---- */

static void add_element(file *f, uint32_t tag, const char *vr, const void *value, size_t length) {
    size_t padded = length + length % 2;
    bool is_long = strcmp(vr, "OW") == 0 || strcmp(vr, "SQ") == 0;
    add_bits(f, tag >> 16, 2, false);
    add_bits(f, tag & 0xffff, 2, false);
    add_text(f, vr);
    if (is_long)
        add_bits(f, 0, 2, false);
    add_bits(f, padded, is_long ? 4 : 2, false);
    add_bytes(f, value, length);
    add_bytes(f, " ", length % 2);
}

static void add_string(file *f, uint32_t tag, const char *vr, const char *text) {
    if (text)
        add_element(f, tag, vr, text, strlen(text));
}

static void add_short(file *f, uint32_t tag, unsigned value) {
    const unsigned char bytes[2] = {(unsigned char)value, (unsigned char)(value >> 8)};
    add_element(f, tag, "US", bytes, 2);
}

/* A slice of 2 x 2 pixels; what is NULL or 0 is left out. */
typedef struct slice {
    const char *position, *orientation, *spacing, *thickness, *gap;
    const char *slope, *center, *width;
    unsigned bits, is_signed;
    const char *pixels; /* of 4 pixels */
} slice;

static const slice plain = {.position = "0\\0\\0",
                            .orientation = "1\\0\\0\\0\\1\\0",
                            .spacing = "3\\2",
                            .bits = 16,
                            .pixels = "\1\0\2\0\3\0\4\0"};

static void add_slice(folder *in, const char *name, const slice *s) {
    file *f = add_file(in, name);
    unsigned bits = s->bits ? s->bits : 16;
    add_string(f, 0x00080018, "UI", "1.2");
    add_string(f, 0x00180050, "DS", s->thickness);
    add_string(f, 0x00180088, "DS", s->gap);
    add_string(f, 0x00200032, "DS", s->position);
    add_string(f, 0x00200037, "DS", s->orientation);
    add_short(f, 0x00280002, 1);
    add_string(f, 0x00280004, "CS", "MONOCHROME2");
    add_short(f, 0x00280010, 2);
    add_short(f, 0x00280011, 2);
    add_string(f, 0x00280030, "DS", s->spacing);
    add_short(f, 0x00280100, bits);
    add_short(f, 0x00280101, bits);
    add_short(f, 0x00280102, bits - 1);
    add_short(f, 0x00280103, s->is_signed);
    add_string(f, 0x00281050, "DS", s->center);
    add_string(f, 0x00281051, "DS", s->width);
    add_string(f, 0x00281053, "DS", s->slope);
    add_element(f, 0x7fe00010, "OW", s->pixels, bits / 2);
}

/* Slices that differ in position alone. */
static void add_stack(folder *in, const slice *like, const char *const *positions, size_t count) {
    static const char *const names[] = {"a", "b", "c", "d", "e", "f", "g", "h"};
    in->count = 0;
    for (size_t i = 0; i < count; i++) {
        slice one = *like;
        one.position = positions[i];
        add_slice(in, names[i], &one);
    }
}

static double told;

static void tell(void *user, const char *name, double done) {
    (void)user;
    (void)name;
    if (done < told || done > 1)
        told = (double)NAN;
    told = done;
}

static bool read_with(folder *in, plr_volume_source source, plr_volume *volume) {
    char names[256] = "";
    size_t used = 0;
    for (size_t i = 0; i < in->count; i++)
        used += (size_t)snprintf(names + used, sizeof names - used, "%s", in->files[i].name) + 1;
    source.data = names;
    source.length = used;
    source.name = "scan/";
    source.place = (plr_place){"scene.x3d", 7, 3};
    source.release = release_bytes;
    source.progress = tell;
    told = 0;
    return plr_volume_parse_dicom_folder(&source, NULL, volume);
}

static bool read_folder(folder *in, plr_volume *volume, plr_diags *diags) {
    return read_with(in, (plr_volume_source){.load = load_from_folder, .user = in, .diags = diags},
                     volume);
}

/* ---- Geometry ---- */

static bool near3(const double v[3], double x, double y, double z) {
    return fabs(v[0] - x) < 1e-9 && fabs(v[1] - y) < 1e-9 && fabs(v[2] - z) < 1e-9;
}

static folder in;

static void test_axial(void) {
    plr_volume v;
    slice s = plain;
    s.thickness = "99"; /* positions count more */
    add_stack(&in, &s, (const char *const[]){"-10\\20\\35", "-10\\20\\30", "-10\\20\\32.5"}, 3);
    CHECK(read_folder(&in, &v, NULL));
    CHECK(v.size[0] == 2 && v.size[1] == 2 && v.size[2] == 3 && v.components == 1);
    CHECK(near3(v.directions[0], 2, 0, 0)); /* the distance between rows comes first in the file */
    CHECK(near3(v.directions[1], 0, 3, 0));
    CHECK(near3(v.directions[2], 0, 0, 2.5));
    CHECK(near3(v.origin, -10, 20, 30));
    CHECK(v.has_geometry && !v.unplaced && v.space == PLR_SPACE_LPS && v.metres == 1e-3);
    CHECK_NEAR(told, 1, 1e-9);
    plr_volume_free(&v);
}

static void test_oblique(void) {
    plr_volume v;
    slice s = plain;
    s.orientation = "0\\.6\\.8\\1\\0\\0"; /* the normal is 0 .8 -.6 */
    add_stack(&in, &s, (const char *const[]){"0\\8\\-6", "0\\0\\0"}, 2);
    CHECK(read_folder(&in, &v, NULL));
    CHECK(near3(v.directions[0], 0, 1.2, 1.6) && near3(v.directions[1], 3, 0, 0));
    CHECK(near3(v.directions[2], 0, 8, -6) && near3(v.origin, 0, 0, 0));
    plr_volume_free(&v);
}

static void test_tilt(void) {
    plr_volume v;
    add_stack(&in, &plain, (const char *const[]){"0\\0\\0", "0\\-1.5\\5", "0\\-3\\10"}, 3);
    CHECK(read_folder(&in, &v, NULL));
    CHECK(near3(v.directions[1], 0, 3, 0) && near3(v.directions[2], 0, -1.5, 5));
    plr_volume_free(&v);
    /* and where slices are missing */
    add_stack(&in, &plain,
              (const char *const[]){"0\\0\\0", "0\\-1.5\\5", "0\\-4.5\\15", "0\\-6\\20"}, 4);
    CHECK(read_folder(&in, &v, NULL));
    CHECK(v.size[2] == 5 && near3(v.directions[2], 0, -1.5, 5));
    plr_volume_free(&v);
}

static void test_beside_a_line(void) {
    plr_volume v;
    plr_diags *diags = plr_diags_create(NULL);
    add_stack(&in, &plain, (const char *const[]){"0\\0\\0", "2\\0\\1", "0\\0\\2"}, 3);
    CHECK(read_folder(&in, &v, diags));
    CHECK_STR(diag_text(diags, 0),
              "scene.x3d:7:3 warning the slices of scan/ do not lie on a line, "
              "but up to 1 pixels beside it");
    plr_volume_free(&v);
    plr_diags_destroy(&diags);
}

static void test_single(void) {
    plr_volume v;
    slice s = plain;
    s.thickness = "4";
    add_stack(&in, &s, &plain.position, 1);
    CHECK(read_folder(&in, &v, NULL) && near3(v.directions[2], 0, 0, 4));
    plr_volume_free(&v);
    s.gap = "5";
    add_stack(&in, &s, &plain.position, 1);
    CHECK(read_folder(&in, &v, NULL) && near3(v.directions[2], 0, 0, 5));
    plr_volume_free(&v);
    CHECK(read_volume(&in, &v, NULL) && near3(v.directions[2], 0, 0, 5));
    plr_volume_free(&v);
}

static void test_without_place(void) {
    plr_volume v;
    slice s = plain;
    s.thickness = "4";
    add_stack(&in, &s, (const char *const[]){NULL, NULL}, 2);
    CHECK(read_folder(&in, &v, NULL));
    CHECK(v.has_geometry && v.unplaced && v.space == PLR_SPACE_UNKNOWN);
    CHECK(near3(v.directions[0], 2, 0, 0) && near3(v.directions[1], 0, 3, 0) &&
          near3(v.directions[2], 0, 0, 4));
    plr_volume_free(&v);
    s.spacing = NULL;
    add_stack(&in, &s, &plain.position, 1);
    CHECK(read_folder(&in, &v, NULL) && !v.has_geometry);
    plr_volume_free(&v);
}

/* ---- Numbers ---- */

static void test_types(void) {
    plr_volume v;
    slice s = plain;
    const char *const two[] = {"0\\0\\0", "0\\0\\1"};
    s.slope = "0.5";
    add_stack(&in, &s, two, 2);
    CHECK(read_folder(&in, &v, NULL) && v.type == PLR_VOXEL_U16);
    CHECK(v.slope == 0.5 && v.minimum == 0.5 && v.maximum == 2 && !v.range_declared);
    plr_volume_free(&v);
    s.center = "1.5";
    s.width = "2";
    s.is_signed = 1;
    add_stack(&in, &s, two, 2);
    CHECK(read_folder(&in, &v, NULL) && v.type == PLR_VOXEL_S16);
    CHECK(v.range_declared && v.minimum == 0.5 && v.maximum == 1.5);
    plr_volume_free(&v);
    /* slopes that differ need physical values */
    s.slope = "1";
    s.position = "0\\0\\2";
    add_slice(&in, "z", &s);
    CHECK(read_folder(&in, &v, NULL) && v.type == PLR_VOXEL_F32 && v.slope == 1);
    CHECK(plr_volume_value(&v, 1, 1, 0, 0) == 2 && plr_volume_value(&v, 1, 1, 2, 0) == 4);
    plr_volume_free(&v);
    s = (slice){.bits = 8, .pixels = "\1\2\3\4", .orientation = plain.orientation};
    add_stack(&in, &s, two, 2);
    CHECK(read_folder(&in, &v, NULL) && v.type == PLR_VOXEL_U8);
    CHECK(v.minimum == 0 && v.maximum == 255);
    plr_volume_free(&v);
    /* values between slices of 32 bits need doubles */
    s = (slice){.bits = 32,
                .pixels = "\1\0\0\x7f\2\0\0\x7f\3\0\0\x7f\4\0\0\x7f",
                .orientation = plain.orientation};
    add_stack(&in, &s, (const char *const[]){"0\\0\\0", "0\\0\\1", "0\\0\\3"}, 3);
    CHECK(read_folder(&in, &v, NULL) && v.type == PLR_VOXEL_F64 && v.size[2] == 4);
    CHECK(plr_volume_value(&v, 0, 0, 2, 0) == 0x7f000001);
    plr_volume_free(&v);
}

/* ---- Files that change while they are read ---- */

/* After so many files the second folder is read. */
typedef struct changing {
    folder *before, *after;
    size_t left;
} changing;

static bool load_changing(void *user, const char *referrer, const char *name, bool gunzip,
                          plr_place place, plr_bytes *bytes, plr_diags *diags) {
    changing *c = user;
    folder *now = c->left ? c->before : c->after;
    c->left -= c->left > 0;
    return load_from_folder(now, referrer, name, gunzip, place, bytes, diags);
}

static void test_change(const char *what, const char *message) {
    static folder after;
    plr_volume v;
    plr_diags *diags = plr_diags_create(NULL);
    add_stack(&in, &plain, (const char *const[]){"0\\0\\0", "0\\0\\1"}, 2);
    after = in;
    file *last = &after.files[1];
    if (strcmp(what, "cut") == 0)
        last->length -= 2;
    else if (strcmp(what, "gone") == 0)
        last->name = "other";
    else { /* other sizes */
        slice small = plain;
        small.bits = 8;
        after.count = 1;
        add_slice(&after, "b", &small);
    }
    changing c = {&in, &after, 3};
    CHECK(!read_with(&in, (plr_volume_source){.load = load_changing, .user = &c, .diags = diags},
                     &v));
    CHECK(!v.voxels);
    CHECK_STR(diag_text(diags, 0), message);
    plr_diags_destroy(&diags);
}

int main(void) {
    if (!plr_dicom_is_built()) {
        TAP_SKIP("DICOM", "built without a library that reads it");
        return tap_done();
    }
    test_axial();
    test_oblique();
    test_tilt();
    test_beside_a_line();
    test_single();
    test_without_place();
    test_types();
    test_change("cut", "scene.x3d:7:3 error b cannot be read as DICOM: an element is longer than "
                       "what is left of the file");
    test_change("gone", "scene.x3d:7:3 error b does not exist");
    test_change("smaller",
                "scene.x3d:7:3 error b cannot be read as DICOM: its pixel data are damaged");
    return tap_done();
}
