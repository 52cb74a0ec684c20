#include "x3d/quaternion.h"

#include <math.h>
#include <string.h>

static double dot(const double *a, const double *b, int count) {
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += a[i] * b[i];
    return sum;
}

static void normalize(double q[4]) {
    double length = sqrt(dot(q, q, 4));
    for (int i = 0; i < 4; i++)
        q[i] = length > 0 ? q[i] / length : i == 3;
}

void x3d_quaternion_from(const float rotation[4], double q[4]) {
    double axis[3] = {rotation[0], rotation[1], rotation[2]}, half = (double)rotation[3] / 2;
    double length = sqrt(dot(axis, axis, 3));
    q[3] = length > 0 ? cos(half) : 1;
    for (int i = 0; i < 3; i++)
        q[i] = length > 0 ? axis[i] / length * sin(half) : 0;
}

void x3d_quaternion_to(const double q[4], float rotation[4]) {
    double sine = sqrt(dot(q, q, 3)), sign = q[3] < 0 ? -1 : 1;
    rotation[3] = (float)(2 * atan2(sine, sign * q[3]));
    for (int i = 0; i < 3; i++)
        rotation[i] = sine > 1e-12 ? (float)(sign * q[i] / sine) : i == 2;
}

void x3d_quaternion_slerp_as_is(const double a[4], const double b[4], double weight, double q[4]) {
    double cosine = fmin(fmax(dot(a, b, 4), -1), 1), angle = acos(cosine), sine = sin(angle);
    double from = 1 - weight, to = weight;
    if (sine > 1e-6) {
        from = sin((1 - weight) * angle) / sine;
        to = sin(weight * angle) / sine;
    }
    double sum[4];
    for (int i = 0; i < 4; i++)
        sum[i] = from * a[i] + to * b[i];
    memcpy(q, sum, sizeof sum);
    normalize(q);
}

void x3d_quaternion_slerp(const double a[4], const double b[4], double weight, double q[4]) {
    double near[4], sign = dot(a, b, 4) < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++)
        near[i] = sign * b[i];
    x3d_quaternion_slerp_as_is(a, near, weight, q);
}

void x3d_quaternion_multiply(const double a[4], const double b[4], double q[4]) {
    double product[4] = {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
                         a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
                         a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
                         a[3] * b[3] - dot(a, b, 3)};
    memcpy(q, product, sizeof product);
}

void x3d_quaternion_log(const double q[4], double v[3]) {
    double sine = sqrt(dot(q, q, 3)), angle = atan2(sine, q[3]);
    for (int i = 0; i < 3; i++)
        v[i] = sine > 1e-12 ? q[i] / sine * angle : 0;
}

void x3d_quaternion_exp(const double v[3], double q[4]) {
    double angle = sqrt(dot(v, v, 3));
    q[3] = cos(angle);
    for (int i = 0; i < 3; i++)
        q[i] = angle > 1e-12 ? v[i] / angle * sin(angle) : v[i];
}

void x3d_quaternion_from_matrix(const double m[16], double q[4]) {
    /* the largest of the four squares is safe to divide by */
    double squares[4] = {1 + m[0] - m[5] - m[10], 1 - m[0] + m[5] - m[10], 1 - m[0] - m[5] + m[10],
                         1 + m[0] + m[5] + m[10]};
    int most = 3;
    for (int i = 0; i < 3; i++)
        if (squares[i] > squares[most])
            most = i;
    double xy = m[1] + m[4], xz = m[2] + m[8], yz = m[6] + m[9];
    double wx = m[6] - m[9], wy = m[8] - m[2], wz = m[1] - m[4];
    const double rows[4][4] = {{squares[0], xy, xz, wx},
                               {xy, squares[1], yz, wy},
                               {xz, yz, squares[2], wz},
                               {wx, wy, wz, squares[3]}};
    memcpy(q, rows[most], sizeof rows[most]);
    normalize(q);
}
