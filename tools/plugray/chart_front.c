/* What no other point beats. */
#include <float.h>
#include <math.h>

#include "tools/plugray/chart.h"
#include "tools/plugray/files.h"

#include <stdlib.h>

double chart_time(const chart_point *point) {
    return point->gpu_ms > 0 ? point->gpu_ms : point->cpu_ms;
}

chart_error chart_floor(const chart_reference *reference) {
    return (chart_error){fmax(3 * reference->bar.rmse, (double)FLT_EPSILON / 2),
                         fmax(3 * reference->bar.max, (double)FLT_EPSILON / 2)};
}

static bool is_beaten(const double *times, const double *errors, double floor, size_t count,
                      size_t index) {
    double time = times[index], error = fmax(errors[index], floor);
    for (size_t i = 0; i < count; i++) {
        double other = fmax(errors[i], floor);
        if (times[i] <= time && other <= error && (times[i] < time || other < error))
            return true;
    }
    return false;
}

void chart_front(const double *times, const double *errors, double floor, size_t count,
                 bool *front) {
    for (size_t i = 0; i < count; i++)
        front[i] = isfinite(errors[i]) && !is_beaten(times, errors, floor, count, i);
}

void chart_points_front(chart_points *points, const chart_reference *reference) {
    size_t count = points->count;
    double *times = memory_array(NULL, count, sizeof *times);
    double *errors = memory_array(NULL, count, sizeof *errors);
    bool *front = memory_array(NULL, count, sizeof *front);
    for (size_t i = 0; i < count; i++) {
        times[i] = chart_time(&points->items[i]);
        errors[i] = points->items[i].error.rmse;
    }
    chart_front(times, errors, chart_floor(reference).rmse, count, front);
    for (size_t i = 0; i < count; i++)
        points->items[i].pareto = front[i];
    free(times);
    free(errors);
    free(front);
}
