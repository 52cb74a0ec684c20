#include "base/matrix.h"

#include <math.h>
#include <string.h>

plr_matrix plr_matrix_identity(void) {
    return (plr_matrix){{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
}

plr_matrix plr_matrix_multiply(const plr_matrix *a, const plr_matrix *b) {
    plr_matrix product;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a->m[k * 4 + row] * b->m[column * 4 + k];
            product.m[column * 4 + row] = sum;
        }
    return product;
}

plr_matrix plr_matrix_translation(double x, double y, double z) {
    plr_matrix result = plr_matrix_identity();
    result.m[12] = x;
    result.m[13] = y;
    result.m[14] = z;
    return result;
}

plr_matrix plr_matrix_scale(double x, double y, double z) {
    plr_matrix result = plr_matrix_identity();
    result.m[0] = x;
    result.m[5] = y;
    result.m[10] = z;
    return result;
}

/* Rodrigues' rotation formula. */
plr_matrix plr_matrix_rotation(double x, double y, double z, double angle) {
    plr_matrix result = plr_matrix_identity();
    double length = sqrt(x * x + y * y + z * z);
    if (!(length > 0))
        return result;
    x /= length, y /= length, z /= length;
    double c = cos(angle), s = sin(angle), t = 1 - c;
    const double columns[3][3] = {{t * x * x + c, t * x * y + s * z, t * x * z - s * y},
                                  {t * x * y - s * z, t * y * y + c, t * y * z + s * x},
                                  {t * x * z + s * y, t * y * z - s * x, t * z * z + c}};
    for (int column = 0; column < 3; column++)
        memcpy(&result.m[column * 4], columns[column], sizeof columns[column]);
    return result;
}

double plr_matrix_determinant3(const plr_matrix *a) {
    const double *m = a->m;
    return m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) +
           m[8] * (m[1] * m[6] - m[5] * m[2]);
}

/* Gauss-Jordan elimination with row pivoting. */
bool plr_matrix_invert(const plr_matrix *a, plr_matrix *inverse) {
    double rows[4][8];
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++) {
            rows[row][column] = a->m[column * 4 + row];
            rows[row][column + 4] = row == column;
        }
    *inverse = plr_matrix_identity();
    for (int k = 0; k < 4; k++) {
        int pivot = k;
        for (int row = k + 1; row < 4; row++)
            if (fabs(rows[row][k]) > fabs(rows[pivot][k]))
                pivot = row;
        if (!(fabs(rows[pivot][k]) > 0) || !isfinite(rows[pivot][k]))
            return false;
        for (int column = 0; column < 8; column++) {
            double swap = rows[k][column];
            rows[k][column] = rows[pivot][column];
            rows[pivot][column] = swap;
        }
        double scale = 1 / rows[k][k];
        for (int column = 0; column < 8; column++)
            rows[k][column] *= scale;
        for (int row = 0; row < 4; row++) {
            double factor = rows[row][k];
            for (int column = 0; row != k && column < 8; column++)
                rows[row][column] -= factor * rows[k][column];
        }
    }
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++)
            inverse->m[column * 4 + row] = rows[row][column + 4];
    return true;
}

void plr_matrix_point(const plr_matrix *a, const double point[3], double result[3]) {
    double w = a->m[3] * point[0] + a->m[7] * point[1] + a->m[11] * point[2] + a->m[15];
    double out[3];
    for (int row = 0; row < 3; row++)
        out[row] = (a->m[row] * point[0] + a->m[4 + row] * point[1] + a->m[8 + row] * point[2] +
                    a->m[12 + row]) /
                   w;
    memcpy(result, out, sizeof out);
}

plr_matrix plr_matrix_perspective(const double at_one[4], double near, double far) {
    double width = at_one[2] - at_one[0], height = at_one[3] - at_one[1];
    plr_matrix result = {{0}};
    result.m[0] = 2 / width;
    result.m[5] = 2 / height;
    result.m[8] = (at_one[2] + at_one[0]) / width;
    result.m[9] = (at_one[3] + at_one[1]) / height;
    result.m[10] = isinf(far) ? -1 : -(far + near) / (far - near);
    result.m[11] = -1;
    result.m[14] = isinf(far) ? -2 * near : -2 * far * near / (far - near);
    return result;
}

plr_matrix plr_matrix_reversed_depth(const plr_matrix *projection) {
    plr_matrix result = *projection;
    for (int column = 0; column < 4; column++)
        result.m[column * 4 + 2] =
            0.5 * (projection->m[column * 4 + 3] - projection->m[column * 4 + 2]);
    return result;
}

plr_matrix plr_matrix_orthographic(const double box[4], double near, double far) {
    double width = box[2] - box[0], height = box[3] - box[1];
    plr_matrix result = plr_matrix_identity();
    result.m[0] = 2 / width;
    result.m[5] = 2 / height;
    result.m[10] = -2 / (far - near);
    result.m[12] = -(box[2] + box[0]) / width;
    result.m[13] = -(box[3] + box[1]) / height;
    result.m[14] = -(far + near) / (far - near);
    return result;
}

void plr_matrix_to_floats(const plr_matrix *a, float values[16]) {
    for (int i = 0; i < 16; i++)
        values[i] = (float)a->m[i];
}

void plr_matrix_to_normal_floats(const plr_matrix *a, float values[9]) {
    plr_matrix linear = *a, inverse;
    linear.m[3] = linear.m[7] = linear.m[11] = linear.m[12] = linear.m[13] = linear.m[14] = 0;
    linear.m[15] = 1;
    plr_matrix_invert(&linear, &inverse);
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            values[column * 3 + row] = (float)inverse.m[row * 4 + column];
}
