#include "tests/tap.h"

#include "base/matrix.h"

static void check_point(const plr_matrix *m, double x, double y, double z, double ex, double ey,
                        double ez) {
    double point[3] = {x, y, z};
    plr_matrix_point(m, point, point);
    CHECK_NEAR(point[0], ex, 1e-12);
    CHECK_NEAR(point[1], ey, 1e-12);
    CHECK_NEAR(point[2], ez, 1e-12);
}

static void test_rotation(void) {
    plr_matrix turn = plr_matrix_rotation(0, 0, 2, 1.5707963267948966); /* any length of axis */
    check_point(&turn, 1, 0, 5, 0, 1, 5);
    plr_matrix none = plr_matrix_rotation(0, 0, 0, 1);
    check_point(&none, 1, 2, 3, 1, 2, 3);
    /* a third of a turn about the diagonal permutes the axes */
    plr_matrix permute = plr_matrix_rotation(1, 1, 1, 2.0943951023931953);
    check_point(&permute, 1, 2, 3, 3, 1, 2);
}

static void test_inverse(void) {
    plr_matrix shear = plr_matrix_identity();
    shear.m[4] = 0.5;
    shear.m[9] = -2;
    plr_matrix scale = plr_matrix_scale(1e-3, 2, 1e3), move = plr_matrix_translation(7, -8, 1e6);
    plr_matrix product = plr_matrix_multiply(&move, &shear), inverse;
    product = plr_matrix_multiply(&product, &scale);
    CHECK(plr_matrix_invert(&product, &inverse));
    plr_matrix identity = plr_matrix_multiply(&product, &inverse);
    for (int i = 0; i < 16; i++)
        CHECK_NEAR(identity.m[i], i % 5 == 0, 1e-9);
    plr_matrix flat = plr_matrix_scale(1, 0, 1);
    CHECK(!plr_matrix_invert(&flat, &inverse));
    CHECK_NEAR(plr_matrix_determinant3(&product), 2, 1e-12);
}

static void test_normals(void) {
    /* a plane keeps its normal perpendicular under a non-uniform scale and shear */
    plr_matrix m = plr_matrix_scale(2, 1, 1);
    m.m[4] = 0.5;
    float n[9];
    plr_matrix_to_normal_floats(&m, n);
    const double normal[3] = {1, 2, 3}, along[3] = {3, 0, -1}; /* perpendicular */
    double a[3];
    plr_matrix_point(&m, along, a);
    double dot = 0;
    for (int row = 0; row < 3; row++)
        dot += a[row] * ((double)n[row] * normal[0] + (double)n[3 + row] * normal[1] +
                         (double)n[6 + row] * normal[2]);
    CHECK_NEAR(dot, 0, 1e-6);
}

static void test_projection(void) {
    plr_matrix p = plr_matrix_perspective((double[]){-1, -0.5, 1, 0.5}, 1, 100);
    check_point(&p, 1, 0.5, -1, 1, 1, -1);
    check_point(&p, -100, 50, -100, -1, 1, 1);
    plr_matrix o = plr_matrix_orthographic((double[]){-2, -1, 4, 3}, -5, 5);
    check_point(&o, -2, 3, 5, -1, 1, -1);
    check_point(&o, 4, -1, -5, 1, -1, 1);
}

int main(void) {
    test_rotation();
    test_inverse();
    test_normals();
    test_projection();
    return tap_done();
}
