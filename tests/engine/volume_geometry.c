/* Size, shear and place from files: where the centres of voxels come to lie in the scene. */
#include "engine/volume_geometry.h"

#include "tests/engine/volume_test.h"

/* Where the voxel comes to lie by box and matrix: its centre in the box of ISO/IEC 19775-1 41. */
static bool voxel_in_scene(const plr_volume *v, double unit, const int voxel[3], double point[3]) {
    plr_matrix matrix;
    double sides[3], centre[3];
    if (!plr_volume_file_geometry(v, unit, &matrix, sides))
        return false;
    for (int i = 0; i < 3; i++)
        centre[i] = ((voxel[i] + 0.5) / v->size[i] - 0.5) * sides[i];
    plr_matrix_point(&matrix, centre, point);
    return true;
}

/* All corner voxels lie where the file says, times `scale`, x turned round where `turned`. */
static void check_corners(const char *name, const plr_volume *v, double unit, double scale,
                          bool turned) {
    bool fine = true;
    for (int corner = 0; corner < 8; corner++) {
        int voxel[3];
        double point[3];
        for (int i = 0; i < 3; i++)
            voxel[i] = corner >> i & 1 ? (int)v->size[i] - 1 : 0;
        fine = fine && voxel_in_scene(v, unit, voxel, point);
        for (int row = 0; row < 3 && fine; row++) {
            double expected = v->origin[row];
            for (int i = 0; i < 3; i++)
                expected += v->directions[i][row] * voxel[i];
            expected *= row == 0 && turned ? -scale : scale;
            fine = fabs(point[row] - expected) <= 1e-12 * (1 + fabs(expected));
        }
    }
    TAP_RESULT(fine, "corners of %s", name);
}

#define HEADER "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 3 4\nencoding: raw\n"
#define OBLIQUE "space directions: (0,2,0) (-3,0,0.5) (0.25,0.1,4)\nspace origin: (10,-20,30)\n"
#define MM "space units: \"mm\" \"mm\" \"mm\"\n"

static void test_spaces(void) {
    static const struct {
        const char *name, *header;
        double unit, scale;
        bool turned;
    } rows[] = {
        {"RAS", HEADER "space: RAS\n" OBLIQUE MM, 1, 1e-3, false},
        {"LPS", HEADER "space: LPS\n" OBLIQUE MM, 1, 1e-3, false},
        {"LAS", HEADER "space: LAS\n" OBLIQUE MM, 1, 1e-3, true},
        {"a right-handed space", HEADER "space: 3D-right-handed\n" OBLIQUE MM, 1, 1e-3, false},
        {"a left-handed space", HEADER "space: 3D-left-handed\n" OBLIQUE MM, 1, 1e-3, true},
        {"a mirrored order of voxels",
         HEADER
         "space: RAS\nspace directions: (-1,0,0) (0,1,0) (0,0,2)\nspace origin: (5,6,7)\n" MM,
         1, 1e-3, false},
        {"a file without units", HEADER "space: LPS\n" OBLIQUE, 1, 1e-3, false},
        {"micrometres", HEADER "space: LPS\n" OBLIQUE "space units: \"um\" \"um\" \"um\"\n", 1,
         1e-6, false},
        {"a scene in centimetres", HEADER "space: LPS\n" OBLIQUE MM, 0.01, 0.1, false},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        plr_volume v;
        if (!read_nrrd(rows[i].header, "abcdefghijklmnopqrstuvwx", 24, &v, NULL)) {
            TAP_RESULT(0, "%s is read", rows[i].name);
            continue;
        }
        check_corners(rows[i].name, &v, rows[i].unit, rows[i].scale, rows[i].turned);
        plr_volume_free(&v);
    }
}

/* A gantry tilt: the third axis leans, the sides keep their true lengths, the matrix scales
 * nothing. */
static void test_shear(void) {
    plr_volume v;
    plr_matrix m;
    double sides[3];
    CHECK(read_nrrd(HEADER "space: LPS\nspace directions: (1,0,0) (0,1,0) (0,1.5,2)\n"
                           "space origin: (0,0,0)\n" MM,
                    "abcdefghijklmnopqrstuvwx", 24, &v, NULL));
    CHECK(plr_volume_file_geometry(&v, 1e-3, &m, sides));
    CHECK_NEAR(sides[0], 2, 1e-12);
    CHECK_NEAR(sides[1], 3, 1e-12);
    CHECK_NEAR(sides[2], 4 * 2.5, 1e-12);
    CHECK_NEAR(m.m[9], 0.6, 1e-12);
    CHECK_NEAR(m.m[10], 0.8, 1e-12);
    CHECK_NEAR(plr_matrix_determinant3(&m), 0.8, 1e-12);
    plr_volume_free(&v);
}

static void test_unplaced(void) {
    static const char *const headers[] = {HEADER "spacings: 1 -2 3\nunits: \"cm\" \"cm\" \"cm\"\n",
                                          HEADER "space: LPS\nspace units: \"cm\" \"cm\" \"cm\"\n"
                                                 "space directions: (1,0,0) (0,-2,0) (0,0,3)\n"};
    for (int i = 0; i < 2; i++) {
        plr_volume v;
        plr_matrix m;
        double sides[3];
        CHECK(read_nrrd(headers[i], "abcdefghijklmnopqrstuvwx", 24, &v, NULL));
        CHECK(plr_volume_file_geometry(&v, 1, &m, sides));
        CHECK(m.m[12] == 0 && m.m[13] == 0 && m.m[14] == 0);
        CHECK(m.m[0] == 1 && m.m[5] == -1 && m.m[10] == 1);
        CHECK_NEAR(sides[0], 0.02, 1e-12);
        CHECK_NEAR(sides[1], 0.06, 1e-12);
        CHECK_NEAR(sides[2], 0.12, 1e-12);
        plr_volume_free(&v);
    }
}

/* What spans no volume, or cannot be drawn with floats. */
static void test_unusable(void) {
    static const double bad[][3][3] = {
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 0}},
        {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
        {{1, 0, 0}, {0, 1, 0}, {0, 0, (double)NAN}},
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1e300}},
        {{1e-300, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {{1, 0, 0}, {0, (double)INFINITY, 0}, {0, 0, 1}},
    };
    plr_volume v = {.size = {2, 3, 4}, .has_geometry = true, .space = PLR_SPACE_RAS};
    plr_matrix m = {{7}};
    double sides[3] = {7};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        memcpy(v.directions, bad[i], sizeof bad[i]);
        TAP_RESULT(!plr_volume_file_geometry(&v, 1, &m, sides), "directions %zu are refused",
                   i + 1);
    }
    CHECK(m.m[0] == 7 && sides[0] == 7);
    memset(v.directions, 0, sizeof v.directions);
    for (int i = 0; i < 3; i++)
        v.directions[i][i] = 1;
    CHECK(plr_volume_file_geometry(&v, 1, &m, sides));
    v.origin[1] = (double)NAN;
    CHECK(!plr_volume_file_geometry(&v, 1, &m, sides));
    v.origin[1] = 0;
    v.has_geometry = false;
    CHECK(!plr_volume_file_geometry(&v, 1, &m, sides));
}

static void test_words(void) {
    char letter = 0;
    CHECK_STR(plr_space_direction(PLR_SPACE_RAS, 0, 1, &letter), "right");
    CHECK(letter == 'R');
    CHECK_STR(plr_space_direction(PLR_SPACE_LAS, 0, 1, &letter), "left");
    CHECK_STR(plr_space_direction(PLR_SPACE_LAS, 1, 1, &letter), "front");
    CHECK_STR(plr_space_direction(PLR_SPACE_LPS, 1, 1, &letter), "back");
    CHECK(letter == 'P');
    CHECK_STR(plr_space_direction(PLR_SPACE_LPS, 1, -1, &letter), "front");
    CHECK_STR(plr_space_direction(PLR_SPACE_LPS, 2, -1, &letter), "down");
    CHECK(letter == 'I');
    CHECK(!plr_space_direction(PLR_SPACE_UNKNOWN, 0, 1, &letter));
    CHECK(!plr_space_direction(PLR_SPACE_LEFT_HANDED, 0, 1, NULL));
}

int main(void) {
    test_spaces();
    test_shear();
    test_unplaced();
    test_unusable();
    test_words();
    return tap_done();
}
