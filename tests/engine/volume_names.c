/* Names and colours of segments: lines of text, NRRD keys, NIfTI extensions; and the choice of one
 * volume among several. */
#include "volume_test.h"

/* "3=liver(1,0.5,0,1) 7=spleen": the labels as one line. */
static const char *describe(const plr_labels *labels) {
    static char text[2048];
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < labels->count && used < sizeof text; i++) {
        const plr_label *l = &labels->items[i];
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%u=%s", i ? " " : "", l->value,
                                 l->name);
        if (l->has_color && used < sizeof text)
            used += (size_t)snprintf(text + used, sizeof text - used, "(%g,%g,%g,%g)",
                                     (double)l->color[0], (double)l->color[1], (double)l->color[2],
                                     (double)l->color[3]);
    }
    return text;
}

/* ---- Text ---- */

static void test_text(void) {
    static const struct {
        const char *text, *labels, *message;
    } cases[] = {
        {"1 one\n2 two\n", "1=one 2=two", NULL},
        {"\xef\xbb\xbf# comment\r\n\r\n  7\tleft lung \r\n3\tliver", "3=liver 7=left lung", NULL},
        {"3 left lung 255 128 0\n4 heart 255 0 0 51\n",
         "3=left lung(1,0.501961,0,1) "
         "4=heart(1,0,0,0.2)",
         NULL},
        {"3 a 1 0.5 0 0.25\n4 b 0 0 1\n", "3=a(1,0.5,0,0.25) 4=b(0,0,1,1)", NULL},
        /* an alpha that is 0 everywhere is none */
        {"0 Unknown 0 0 0 0\n2 White 245 245 245 0\n",
         "0=Unknown(0,0,0,1) 2=White(0.960784,0.960784,0.960784,1)", NULL},
        {"5,kidney,0,255,0\n", "5=kidney(0,1,0,1)", NULL},
        {"5: kidney\n6 = bladder\n", "5=kidney 6=bladder", NULL},
        {"3\tAREA 1 2 3\t0 1 0\n", "3=AREA 1 2 3(0,1,0,1)", NULL},
        {"3 \"area 1 2 3\"\n4 \"b\" 0 0 1\n", "3=area 1 2 3 4=b(0,0,1,1)", NULL},
        {"    0     0    0    0        0  0  0    \"Clear Label\"\n"
         "    1   255    0   51      0.5  1  1    \"Caudate nucleus\"\n",
         "0=Clear Label(0,0,0,0) 1=Caudate nucleus(1,0,0.2,0.5)", NULL},
        /* codes of an atlas, and numbers that are part of the name */
        {"1 Precentral_L 2001\n2 Precentral_R 2002\n", "1=Precentral_L 2=Precentral_R", NULL},
        {"1 Area 17\n2 Area 18\n", "1=Area 17 2=Area 18", NULL},
        {"1 V1 17\n2 V2\n", "1=V1 17 2=V2", NULL},
        {"2 b\n1 a\n2 c\n", "1=a 2=b", NULL},
        {"4294967295 last\n", "4294967295=last", NULL},
        {"1 na\xefve \xc3\xa9t\xc3\xa9\x01\n", "1=na?ve \xc3\xa9t\xc3\xa9 ", NULL},
        {"1 one\nsome text\n2 two\n", "1=one",
         "labels.txt:2:1 warning this is no label (number, name and perhaps a colour); labels are "
         "read up to here"},
        {"1 one\n4294967296 more\n", "1=one",
         "labels.txt:2:1 warning this is no label (number, name and perhaps a colour); labels are "
         "read up to here"},
        {"Read me first\n1 one\n", "", NULL},
        {"1 one two\n", "1=one two", NULL},
        {"17\n", "", NULL},
        {"-3 below\n", "", NULL},
        {"", "", NULL},
        {"3 \"open\n", "", NULL},
        {"3 \"\"\n", "", NULL},
        {"3 255 0 0\n", "", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        plr_labels labels = {0};
        plr_diags *diags = plr_diags_create(NULL);
        size_t length = strlen(cases[i].text);
        char *exact = malloc(length + 1);
        memcpy(exact, cases[i].text, length);
        bool found = plr_labels_read(&labels, exact, length, "labels.txt", diags);
        CHECK(found == (cases[i].labels[0] != '\0'));
        CHECK_STR(describe(&labels), cases[i].labels);
        CHECK_STR(diag_text(diags, 0), cases[i].message ? cases[i].message : "(none)");
        free(exact);
        plr_labels_free(&labels);
        plr_diags_destroy(&diags);
    }
}

static void test_limits(void) {
    enum {
        LINES = 70000
    };
    char *text = malloc(LINES * 8 + 400), *at = text;
    at += sprintf(at, "70000 ");
    for (int i = 0; i < 300; i++)
        *at++ = 'x';
    *at++ = '\n';
    for (int i = 1; i < LINES; i++)
        at += sprintf(at, "%d n\n", i);
    plr_labels labels = {0};
    CHECK(plr_labels_read(&labels, text, (size_t)(at - text), "labels.txt", NULL));
    CHECK_INT(labels.count, 65536);
    const plr_label *longest = plr_labels_find(&labels, 70000);
    CHECK(longest && strlen(longest->name) == 255);
    CHECK(plr_labels_find(&labels, 1) == &labels.items[0] && !plr_labels_find(&labels, 0));
    plr_labels_free(&labels);
    CHECK(!plr_labels_find(&labels, 1));
    /* neither text with zeros nor whole books */
    CHECK(!plr_labels_read(&labels, "1 a\0b\n", 6, "labels.txt", NULL));
    text = realloc(text, 5 << 20);
    memset(text, '\n', 5 << 20);
    memcpy(text, "1 a\n", 4);
    CHECK(!plr_labels_read(&labels, text, 5 << 20, "labels.txt", NULL) && !labels.count);
    free(text);
}

/* ---- NRRD ---- */

static void check_nrrd(const char *keys, const char *expected, const char *message) {
    char header[1024];
    plr_volume v = {0};
    plr_diags *diags = plr_diags_create(NULL);
    snprintf(header, sizeof header,
             "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 1 1\nencoding: raw\n%s", keys);
    CHECK(read_nrrd(header, "ab", 2, &v, diags));
    CHECK_STR(describe(&v.labels), expected);
    CHECK_STR(diag_text(diags, 0), message ? message : "(none)");
    plr_volume_free(&v);
    plr_diags_destroy(&diags);
}

static void test_nrrd(void) {
    check_nrrd("Segment1_LabelValue:=1\nSegment0_Name:=liver\nSegment0_LabelValue:=300\n"
               "Segment0_Color:=0.5 0.25 1\nSegment0_Extent:=0 1 2\nSegment1_Name:=left\\\\right\n",
               "1=left\\right 300=liver(0.5,0.25,1,1)", NULL);
    check_nrrd("Segment0_Name:=a\nSegment2_Name:=c\r\n", "1=a 3=c", NULL);
    check_nrrd("label 3:=liver\nlabel 65536:=the rest\nlabel x:=no\nlabel 4 :=no\nlabels:=no\n",
               "3=liver 65536=the rest", NULL);
    check_nrrd("Segment0_Name:=a\nSegment0_Layer:=0\nSegment1_Name:=b\nSegment1_Layer:=1\n", "1=a",
               "head.nrrd:8:1 warning segments of layers above 0 overlap others and have no name "
               "here");
    check_nrrd("Segment99999999999_Name:=a\nSegment70000_Name:=b\nSegment_Name:=c\nSegment3:=d\n"
               "Segment4_Color:=1 1\nSegment4_Name:=e\nSegment5_LabelValue:=5\n",
               "5=e", NULL);
}

/* ---- NIfTI ---- */

/* A file of one voxel with these bytes between header and voxel. */
static void check_nifti(const char *between, size_t length, bool big_endian, const char *expected) {
    static folder in;
    in.count = 0;
    file *f = add_file(&in, "a.nii");
    add_bits(f, 348, 4, big_endian);
    f->length = 40;
    for (int i = 0; i < 8; i++)
        add_bits(f, i == 0 ? 3 : 1, 2, big_endian);
    f->length = 70;
    add_bits(f, 2, 2, big_endian);
    f->length = 108;
    add_number(f, PLR_VOXEL_F32, (double)(348 + length), big_endian);
    f->length = 344;
    add_bytes(f, "n+1", 4);
    add_bytes(f, between, length);
    add_bytes(f, "v", 1);
    plr_volume v = {0};
    CHECK(read_volume(&in, &v, NULL) && plr_volume_value(&v, 0, 0, 0, 0) == 'v');
    CHECK_STR(describe(&v.labels), expected);
    plr_volume_free(&v);
}

static void test_nifti(void) {
    static const char packed[] = "\1\0\0\0"
                                 "\x10\0\0\0\2\0\0\0patient\0"
                                 "\x20\0\0\0\6\0\0\0"
                                 "1\tfirst\n2\tsecond\n\0\0\0\0\0\0\0";
    static const char swapped[] = "\1\0\0\0\0\0\0\x10\0\0\0\6"
                                  "3\tthree\0";
    static const char lying[] = "\1\0\0\0\x7f\xff\xff\xff\0\0\0\6"
                                "3\tthree\0";
    static const char negative[] = "\1\0\0\0\xf0\xff\xff\xff\6\0\0\0"
                                   "3\tthree\0";
    check_nifti("\0\0\0\0", 4, false, "");
    /* as some atlases do it: no extension is announced */
    check_nifti("\0\0\0\0001\tleft\n2\tright\n\0\0\0", 21, false, "1=left 2=right");
    check_nifti(packed, 52, false, "1=first 2=second");
    check_nifti(swapped, 20, true, "3=three");
    check_nifti(lying, 20, true, "");
    check_nifti(negative, 20, false, "");
    check_nifti("\1\0\0\0\0\0\0\0", 8, false, "");
}

/* ---- One of several volumes ---- */

/* Reads with a time point; `expected` are the voxels' bytes. */
static void check_time(const file *f, uint32_t point, const char *expected, const char *message) {
    plr_volume v = {0};
    plr_diags *diags = plr_diags_create(NULL);
    plr_volume_source source = {.data = (const char *)f->data,
                                .length = f->length,
                                .name = f->name,
                                .diags = diags,
                                .time_given = true,
                                .time_point = point,
                                .time_place = {"scene.x3d", 5, 6}};
    bool fine = plr_volume_parse(&source, &v) && plr_volume_count(&v) == strlen(expected) &&
                memcmp(v.voxels, expected, strlen(expected)) == 0;
    TAP_RESULT(fine, "volume %u is %s", point, expected);
    CHECK_STR(diag_text(diags, 0), message ? message : "(none)");
    plr_volume_free(&v);
    plr_diags_destroy(&diags);
}

static const file *nrrd_file(const char *fields, const char *data) {
    static folder in;
    in.count = 0;
    file *f = add_file(&in, "a.nrrd");
    add_text(f, "NRRD0004\ntype: uchar\nencoding: raw\n");
    add_text(f, fields);
    add_text(f, "\n");
    add_text(f, data);
    return f;
}

static void test_time(void) {
    static const char last[] = "dimension: 4\nsizes: 2 1 1 3\nkinds: domain domain domain time\n";
    static const char first[] = "dimension: 4\nsizes: 3 2 1 1\nkinds: time domain domain domain\n";
    static const char both[] =
        "dimension: 5\nsizes: 2 5 1 1 2\nkinds: time list domain domain domain\n";
    static const char list[] = "dimension: 4\nsizes: 5 2 1 1\nkinds: list domain domain domain\n";
    check_time(nrrd_file(last, "abcdef"), 0, "ab", NULL);
    check_time(nrrd_file(last, "abcdef"), 1, "cd", NULL);
    check_time(nrrd_file(last, "abcdef"), 2, "ef", NULL);
    check_time(nrrd_file(last, "abcdef"), 3, "ef",
               "scene.x3d:5:6 warning there is no time point 3; a.nrrd has 3, counted from 0, and "
               "the last is taken");
    check_time(nrrd_file(first, "abcdef"), 1, "be", NULL);
    /* of two axes that are neither space nor components, that of time */
    check_time(nrrd_file(both, "abcdefghijABCDEFGHIJ"), 1, "bB",
               "a.nrrd:5:8 warning axis 1 of 5 samples is neither space nor components of a voxel; "
               "only the first sample is used");
    check_time(nrrd_file(list, "abcdeABCDE"), 4, "eE", NULL);
    check_time(nrrd_file("dimension: 3\nsizes: 2 1 1\n", "ab"), 0, "ab", NULL);

    static folder in;
    in.count = 0;
    file *f = add_file(&in, "a.nii");
    const int dim[8] = {4, 2, 1, 1, 3, 1, 1, 1};
    add_bits(f, 348, 4, false);
    f->length = 40;
    for (int i = 0; i < 8; i++)
        add_bits(f, (uint64_t)dim[i], 2, false);
    f->length = 70;
    add_bits(f, 2, 2, false);
    f->length = 344;
    add_bytes(f, "n+1\0\0\0\0\0abcdef", 14);
    check_time(f, 1, "cd", NULL);
    check_time(f, 9, "ef",
               "scene.x3d:5:6 warning there is no time point 9; a.nii has 3, counted from 0, and "
               "the last is taken");
    f->length--; /* the last is cut short: the others are there */
    check_time(f, 1, "cd", NULL);
    plr_volume v;
    plr_diags *diags = plr_diags_create(NULL);
    plr_volume_source source = {.data = (const char *)f->data,
                                .length = f->length,
                                .name = f->name,
                                .diags = diags,
                                .time_given = true,
                                .time_point = 2};
    CHECK(!plr_volume_parse(&source, &v));
    CHECK_STR(diag_text(diags, 0),
              ":0:0 error a.nii holds 1 bytes of voxels, but the header says 2");
    plr_diags_destroy(&diags);
}

int main(void) {
    test_text();
    test_limits();
    test_nrrd();
    test_nifti();
    test_time();
    return tap_done();
}
