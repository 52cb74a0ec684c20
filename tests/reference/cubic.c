/* Cubics along a ray: values of a trilinear cell, turns, crossings. */
#include "reference.h"

#include <math.h>

double ref_cubic_at(const double c[4], double u) {
    return c[0] + u * (c[1] + u * (c[2] + u * c[3]));
}

int ref_cubic_turns(const double c[4], double from, double to, double turns[2]) {
    double a = 3 * c[3], b = 2 * c[2], found[2];
    int count = 0;
    double discriminant = b * b - 4 * a * c[1];
    if (discriminant < 0)
        return 0;
    double q = -0.5 * (b + copysign(sqrt(discriminant), b));
    if (a != 0)
        found[count++] = q / a;
    if (q != 0)
        found[count++] = c[1] / q;
    if (count == 2 && found[0] > found[1]) {
        double larger = found[0];
        found[0] = found[1];
        found[1] = larger;
    }
    int kept = 0;
    for (int i = 0; i < count; i++)
        if (found[i] > from && found[i] < to && (!kept || found[i] > turns[0]))
            turns[kept++] = found[i];
    return kept;
}

double ref_cubic_root(const double c[4], double value, double from, double to) {
    double low = from, high = to;
    double at_low = ref_cubic_at(c, low) - value, at_high = ref_cubic_at(c, high) - value;
    if (at_low == 0)
        return low;
    if (at_high == 0 || (at_low < 0) == (at_high < 0))
        return high;
    double u = low - at_low * (high - low) / (at_high - at_low);
    for (int i = 0; i < 100; i++) {
        if (!(u > low && u < high))
            u = 0.5 * (low + high);
        double at = ref_cubic_at(c, u) - value;
        if (at == 0 || u == low || u == high)
            return u;
        if ((at < 0) == (at_low < 0))
            low = u;
        else
            high = u;
        double slope = c[1] + u * (2 * c[2] + u * 3 * c[3]);
        double next = u - at / slope;
        /* Newton where it stays inside and does not crawl, else halves */
        if (!(next > low && next < high) || i % 8 == 7)
            next = 0.5 * (low + high);
        if (fabs(next - u) <= 1e-16 * (to - from) || high - low <= 1e-16 * (to - from))
            return next;
        u = next;
    }
    return u;
}

void ref_cubic_of_cell(const double corners[8], const double start[3], const double way[3],
                       double c[4]) {
    /* differences, so that equal corners give exactly their value */
    const double *f = corners;
    double x = f[1] - f[0], y = f[2] - f[0], z = f[4] - f[0];
    double xy = (f[3] - f[2]) - x, xz = (f[5] - f[4]) - x, yz = (f[6] - f[4]) - y;
    double xyz = ((f[7] - f[6]) - (f[5] - f[4])) - xy;
    double p = start[0], q = start[1], r = start[2], a = way[0], b = way[1], d = way[2];
    c[0] = f[0] + x * p + y * q + z * r + xy * p * q + xz * p * r + yz * q * r + xyz * p * q * r;
    c[1] = x * a + y * b + z * d + xy * (a * q + b * p) + xz * (a * r + d * p) +
           yz * (b * r + d * q) + xyz * (a * q * r + b * p * r + d * p * q);
    c[2] = xy * a * b + xz * a * d + yz * b * d + xyz * (a * b * r + a * d * q + b * d * p);
    c[3] = xyz * a * b * d;
}
