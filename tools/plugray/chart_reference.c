/* The picture that others are compared with, and how far pictures are from it. */
#include <math.h>

#include "tools/plugray/chart.h"
#include "tools/plugray/files.h"

typedef struct difference {
    double squares, max;
} difference;

static void add_difference(difference *sums, double distance) {
    distance = isnan(distance) ? INFINITY : fabs(distance);
    sums->max = fmax(sums->max, distance);
    sums->squares += distance * distance;
}

static chart_error error_of(const difference *sums, size_t count) {
    return (chart_error){count ? sqrt(sums->squares / (double)count) : 0, sums->max};
}

/* Midpoints are of second order: of the error at half the step a quarter is left, a third of the
 * difference (Richardson 1911). */
static double extrapolate(double coarse, double fine) {
    return fine + (fine - coarse) / 3;
}

void chart_extrapolate(const float *const levels[3], size_t count, chart_reference *reference) {
    difference bar = {0}, coarse = {0}, fine = {0};
    reference->pixels = memory_array(NULL, count, sizeof *reference->pixels);
    for (size_t i = 0; i < count; i++) {
        double a = (double)levels[0][i], b = (double)levels[1][i], c = (double)levels[2][i];
        reference->pixels[i] = extrapolate(b, c);
        add_difference(&bar, reference->pixels[i] - extrapolate(a, b));
        add_difference(&coarse, b - a);
        add_difference(&fine, c - b);
    }
    reference->bar = error_of(&bar, count);
    reference->order = fine.squares > 0 ? log2(coarse.squares / fine.squares) / 2 : NAN;
}

chart_error chart_compare(const float *pixels, const double *reference, size_t count) {
    difference found = {0};
    for (size_t i = 0; i < count; i++)
        add_difference(&found, (double)pixels[i] - reference[i]);
    return error_of(&found, count);
}
