/* Numbers on a grid; matrices. */
#include "reference.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

static double number(const ref_grid *grid, size_t at) {
    switch (grid->type) {
    case REF_U8:
        return ((const uint8_t *)grid->data)[at];
    case REF_U16:
        return ((const uint16_t *)grid->data)[at];
    case REF_F32:
        return ((const float *)grid->data)[at];
    case REF_F64:
        break;
    }
    return ((const double *)grid->data)[at];
}

static size_t clamped(int at, int size) {
    return (size_t)(at < 0 ? 0 : at < size ? at : size - 1);
}

double ref_grid_at(const ref_grid *grid, const int at[3]) {
    size_t w = (size_t)grid->size[0], h = (size_t)grid->size[1];
    return number(grid, clamped(at[0], grid->size[0]) + w * (clamped(at[1], grid->size[1]) +
                                                             h * clamped(at[2], grid->size[2])));
}

void ref_grid_corners(const ref_grid *grid, const int cell[3], double corners[8]) {
    size_t w = (size_t)grid->size[0], h = (size_t)grid->size[1];
    for (int i = 0; i < 8; i++) {
        size_t x = clamped(cell[0] + (i & 1), grid->size[0]);
        size_t y = clamped(cell[1] + (i >> 1 & 1), grid->size[1]);
        size_t z = clamped(cell[2] + (i >> 2), grid->size[2]);
        corners[i] = number(grid, x + w * (y + h * z));
    }
}

void ref_matrix_point(const double m[16], const double p[3], double w, double out[3]) {
    double at[3];
    for (int i = 0; i < 3; i++)
        at[i] = m[4 * i] * p[0] + m[4 * i + 1] * p[1] + m[4 * i + 2] * p[2] + m[4 * i + 3] * w;
    memcpy(out, at, sizeof at);
}

bool ref_matrix_invert(const double m[16], double out[16]) {
    /* affine: by cofactors of the upper left part */
    double made[16] = {0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            made[4 * i + j] = m[4 * a + c] * m[4 * b + d] - m[4 * a + d] * m[4 * b + c];
        }
    double determinant = m[0] * made[0] + m[1] * made[4] + m[2] * made[8];
    if (!(fabs(determinant) > 0) || !isfinite(1 / determinant))
        return false;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            made[4 * i + j] /= determinant;
    for (int i = 0; i < 3; i++)
        made[4 * i + 3] = -(made[4 * i] * m[3] + made[4 * i + 1] * m[7] + made[4 * i + 2] * m[11]);
    made[15] = 1;
    memcpy(out, made, sizeof made);
    return true;
}
