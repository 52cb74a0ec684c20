/* 4x4 matrices in double precision, column-major as GL has them: element (row, column) is
 * m[column * 4 + row]. Composed in double so that far places and tiny scales keep their digits. */
#ifndef PLR_BASE_MATRIX_H
#define PLR_BASE_MATRIX_H

#include <stdbool.h>

typedef struct plr_matrix {
    double m[16];
} plr_matrix;

plr_matrix plr_matrix_identity(void);
plr_matrix plr_matrix_multiply(const plr_matrix *a, const plr_matrix *b);
plr_matrix plr_matrix_translation(double x, double y, double z);
plr_matrix plr_matrix_scale(double x, double y, double z);
/* Axis and angle (radians); an axis of length 0 gives the identity. */
plr_matrix plr_matrix_rotation(double x, double y, double z, double angle);
/* The inverse; false and the identity where the matrix is singular. */
bool plr_matrix_invert(const plr_matrix *a, plr_matrix *inverse);
double plr_matrix_determinant3(const plr_matrix *a); /* of the upper left 3x3 */
void plr_matrix_point(const plr_matrix *a, const double point[3], double result[3]);
/* Symmetric or oblique frustum through the corners at distance 1: left, bottom, right, top. `far`
 * may be INFINITY. */
plr_matrix plr_matrix_perspective(const double at_one[4], double near, double far);
plr_matrix plr_matrix_orthographic(const double box[4], double near, double far);
/* The same projection with clip depths from 1 (near) to 0 (far) instead of -1 to 1. */
plr_matrix plr_matrix_reversed_depth(const plr_matrix *projection);
/* 16 floats for GL; the transpose of the inverse of the upper 3x3 as 9 floats (normals). */
void plr_matrix_to_floats(const plr_matrix *a, float values[16]);
void plr_matrix_to_normal_floats(const plr_matrix *a, float values[9]);

#endif
