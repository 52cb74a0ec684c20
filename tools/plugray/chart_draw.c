/* The chart as a picture: numbers and texts for the script chart.gp, which draws. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/plugray/chart.h"
#include "tools/plugray/files.h"
#include "tools/plugray/gnuplot.h"

extern const char chart_script[]; /* chart.gp */

/* A row of panels: an error. A column of panels: a time. */
typedef struct chart_row {
    const char *label;
    double (*error)(const chart_error *error);
} chart_row;

typedef struct chart_column {
    const char *label;
    double (*time)(const chart_point *point); /* milliseconds */
} chart_column;

static double rmse_of(const chart_error *error) {
    return error->rmse;
}

static double max_of(const chart_error *error) {
    return error->max;
}

static double cpu_of(const chart_point *point) {
    return point->cpu_ms;
}

static double wall_of(const chart_point *point) {
    return point->wall_ms;
}

static const chart_row rows[] = {{"root mean square error", rmse_of}, {"greatest error", max_of}};
static const chart_column wall_column = {"wall time of a picture (ms)", wall_of};
static const chart_column cpu_column = {"CPU time of a picture, all threads (ms)", cpu_of};
static const chart_column gpu_column = {"GPU time of a picture (ms)", chart_time};

enum {
    ROW_COUNT = 2,
    COLUMN_COUNT = 2
};

typedef struct drawing {
    const chart_job *job;
    gnuplot plot;
    FILE *settings;
    const chart_column *columns[COLUMN_COUNT];
    chart_error floor;
    double times[COLUMN_COUNT][2], errors[ROW_COUNT][2]; /* ranges of the axes */
    plr_diags *diags;
    bool failed;
} drawing;

/* ---- Files and settings ---- */

static FILE *open_data(drawing *d, const char *kind, size_t first, size_t second) {
    char *name = text_format("%s-%zu-%zu", kind, first, second);
    FILE *file = gnuplot_file(&d->plot, name, d->diags);
    d->failed |= !file;
    free(name);
    return file;
}

static void close_data(drawing *d, FILE *file) {
    if (file && fclose(file) != 0 && !d->failed) {
        d->failed = true;
        plr_diags_add(d->diags, PLR_CODE_OUTPUT, (plr_place){0},
                      "the files for gnuplot cannot be written");
    }
}

static void set_text(const drawing *d, const char *name, char *text) {
    fprintf(d->settings, "%s = ", name);
    gnuplot_string(d->settings, text);
    putc('\n', d->settings);
    free(text);
}

static void set_number(const drawing *d, const char *name, size_t index, double value) {
    fprintf(d->settings, "%s_%zu = %.9g\n", name, index, value);
}

/* "1/16" where it is the inverse of a whole number. */
static char *fraction_text(double value) {
    double inverse = 1 / value, whole = round(inverse);
    if (whole > 1 && fabs(inverse - whole) < 1e-6 * whole)
        return text_format("1/%.0f", whole);
    return text_format("%.3g", value);
}

/* ---- Curves ---- */

/* How far apart values are on a logarithmic axis, as a part of its length. */
static double distance(double a, double b, const double range[2]) {
    return fabs(log(fmax(a, range[0]) / fmax(b, range[0])) / log(range[1] / range[0]));
}

/* Whether points are so near to each other that their labels would cover each other. */
static bool are_near(const drawing *d, size_t row, const chart_point *a, const chart_point *b) {
    double times = distance(d->columns[0]->time(a), d->columns[0]->time(b), d->times[0]);
    double errors =
        distance(rows[row].error(&a->error), rows[row].error(&b->error), d->errors[row]);
    return times < 0.2 && errors < 0.05;
}

/* What stands beside a point: its knob, and that of the last one that lies at the same place. NULL
 * beside a point whose knob an earlier one tells. */
static char *label_of(const drawing *d, size_t row, const chart_point *points, size_t count,
                      size_t index) {
    size_t last = index;
    if (index > 0 && are_near(d, row, &points[index - 1], &points[index]))
        return NULL;
    while (last + 1 < count && are_near(d, row, &points[last], &points[last + 1]))
        last++;
    char *from = fraction_text(points[index].knob), *to = fraction_text(points[last].knob);
    char *label =
        last > index ? text_format("%s \342\200\223 %s", from, to) : text_format("%s", from);
    free(from);
    free(to);
    return label;
}

static void write_place(const drawing *d, FILE *file, size_t row, const chart_point *point) {
    double error = fmax(rows[row].error(&point->error), rows[row].error(&d->floor));
    fprintf(file, "%.9g %.9g %.9g", d->columns[0]->time(point), d->columns[1]->time(point), error);
}

/* The points of a method lie together, from the fastest knob to the slowest. */
static void write_curve(drawing *d, size_t row, const chart_point *points, size_t count,
                        size_t method) {
    FILE *curve = open_data(d, "curve", row, method), *under = open_data(d, "under", row, method);
    FILE *labels = open_data(d, "labels", row, method);
    bool stopped = false;
    for (size_t i = 0; !d->failed && !stopped && i < count; i++) {
        double error = rows[row].error(&points[i].error);
        stopped = error <= rows[row].error(&d->floor);
        if (!isfinite(error))
            continue;
        write_place(d, stopped ? under : curve, row, &points[i]);
        putc('\n', stopped ? under : curve);
        char *label = stopped ? NULL : label_of(d, row, points, count, i);
        if (label) {
            write_place(d, labels, row, &points[i]);
            fprintf(labels, " \"%s\"\n", label);
        }
        free(label);
    }
    close_data(d, curve);
    close_data(d, under);
    close_data(d, labels);
}

static void write_chosen(drawing *d, size_t row) {
    FILE *file = open_data(d, "chosen", row, 0);
    for (size_t i = 0; file && i < d->job->points.count; i++) {
        const chart_point *point = &d->job->points.items[i];
        if (!point->chosen || !isfinite(rows[row].error(&point->error)))
            continue;
        write_place(d, file, row, point);
        putc('\n', file);
    }
    close_data(d, file);
}

typedef struct corner {
    double time, error;
} corner;

static int faster_first(const void *a, const void *b) {
    double x = ((const corner *)a)->time, y = ((const corner *)b)->time;
    return (x > y) - (x < y);
}

/* The front of a panel as a staircase: the least error to be had within a time. */
static void write_front(drawing *d, size_t row, size_t column) {
    size_t count = d->job->points.count, kept = 0;
    double *time = memory_array(NULL, count, sizeof *time);
    double *error = memory_array(NULL, count, sizeof *error);
    bool *front = memory_array(NULL, count, sizeof *front);
    corner *corners = memory_array(NULL, count, sizeof *corners);
    double floor = rows[row].error(&d->floor);
    for (size_t i = 0; i < count; i++) {
        time[i] = d->columns[column]->time(&d->job->points.items[i]);
        error[i] = rows[row].error(&d->job->points.items[i].error);
    }
    chart_front(time, error, floor, count, front);
    for (size_t i = 0; i < count; i++)
        if (front[i])
            corners[kept++] = (corner){time[i], fmax(error[i], floor)};
    qsort(corners, kept, sizeof *corners, faster_first);
    FILE *file = open_data(d, "front", row, column);
    double top = d->errors[row][1] * pow(d->errors[row][0] / d->errors[row][1], 0.01);
    for (size_t i = 0; file && i < kept; i++) {
        if (i == 0)
            fprintf(file, "%.9g %.9g\n", corners[i].time, top);
        fprintf(file, "%.9g %.9g\n", corners[i].time, corners[i].error);
    }
    if (file && kept)
        fprintf(file, "%.9g %.9g\n", d->times[column][1], corners[kept - 1].error);
    close_data(d, file);
    free(time);
    free(error);
    free(front);
    free(corners);
}

/* ---- Axes ---- */

/* Marks of a logarithmic axis: powers of ten, and 2 and 5 times them where there are few. */
static void set_marks(const drawing *d, const char *name, size_t index, const double range[2]) {
    static const double between[] = {1, 2, 5};
    size_t step = range[1] / range[0] > 300 ? 3 : 1;
    fprintf(d->settings, "%s_%zu = \"", name, index);
    const char *comma = "";
    for (int power = (int)floor(log10(range[0])); power <= (int)ceil(log10(range[1])); power++)
        for (size_t i = 0; i < 3; i += step) {
            double mark = between[i] * pow(10, power);
            if (mark < range[0] || mark > range[1])
                continue;
            fprintf(d->settings, "%s'%g' %.9g", comma, mark, mark);
            comma = ", ";
        }
    fputs("\"\n", d->settings);
}

static void widen(double range[2], double value) {
    if (isfinite(value) && value > 0) {
        range[0] = fmin(range[0], value);
        range[1] = fmax(range[1], value);
    }
}

static void range_of_times(const drawing *d, size_t column, double range[2]) {
    range[0] = INFINITY;
    range[1] = 0;
    for (size_t i = 0; i < d->job->points.count; i++)
        widen(range, d->columns[column]->time(&d->job->points.items[i]));
    if (!(range[1] > 0))
        range[0] = range[1] = 1;
    range[0] /= 1.3;
    range[1] *= 1.3;
}

static void range_of_errors(const drawing *d, size_t row, double range[2]) {
    double floor = rows[row].error(&d->floor);
    range[0] = range[1] = floor;
    for (size_t i = 0; i < d->job->points.count; i++) {
        double error = rows[row].error(&d->job->points.items[i].error);
        widen(range, fmax(error, floor));
    }
    if (row == 1)
        widen(range, d->job->asked);
    range[1] = fmax(range[1] * 2, floor * 3);
    range[0] /= pow(range[1] / range[0], 0.08); /* a band below the floor */
}

/* ---- Texts ---- */

static void set_headings(const drawing *d) {
    const chart_job *job = d->job;
    set_text(d, "title_text", text_format("Speed against accuracy: %s", job->named));
    set_text(d, "machine_text",
             text_format("%dx%d pixels%s%s. %s", job->look.width, job->look.height,
                         job->look.viewpoint ? ", viewpoint " : "",
                         job->look.viewpoint ? job->look.viewpoint : "",
                         plr_context_description(job->machine.context)));
    set_text(d, "repeat_text",
             text_format("Medians of %ld draws%s. The lower left is better.", job->repeat,
                         job->interleaved ? ", all methods in turns"
                                          : "; methods in groups, as memory allows"));
}

static void set_reference_text(const drawing *d) {
    const chart_reference *reference = &d->job->reference;
    char *steps[3], *order = NULL;
    for (int i = 0; i < 3; i++)
        steps[i] = fraction_text(reference->step * (4 >> i));
    if (isfinite(reference->order))
        order = text_format(" (observed order %.1f)", reference->order);
    set_text(d, "reference_text",
             text_format("Reference: fixed steps of %s, %s and %s voxel, extrapolated to 0%s. Its "
                         "own error: RMSE %.2g, greatest %.2g.",
                         steps[0], steps[1], steps[2], order ? order : "", reference->bar.rmse,
                         reference->bar.max));
    for (int i = 0; i < 3; i++)
        free(steps[i]);
    free(order);
}

static void set_chosen_text(const drawing *d) {
    static const char *const methods[] = {"no method", "midpoint", "preintegrated", "cells"};
    char *text = text_format("%s", "");
    for (size_t i = 0; i < d->job->points.count; i++) {
        const chart_point *point = &d->job->points.items[i];
        if (!point->chosen)
            continue;
        const plr_plan *plan = &point->plan;
        char *asked = fraction_text(point->knob);
        char *claim = plan->value < 0
                          ? text_format("nothing is said of the error")
                          : text_format("the error is %s %.2g",
                                        plan->bounded ? "at most" : "estimated to be", plan->value);
        free(text);
        text =
            text_format("Planner for %s: %s, steps of %.3g voxel; %s; greatest error found %.2g.",
                        asked, methods[plan->method], plan->step, claim, point->error.max);
        free(asked);
        free(claim);
    }
    set_text(d, "chosen_text", text);
}

/* ---- All of it ---- */

/* A method has the same colour and mark in every chart. */
static size_t style_of(const chart_method *method) {
    size_t style = 0;
    while (chart_method_at(style) != method)
        style++;
    return style;
}

static void write_methods(drawing *d) {
    const chart_points *points = &d->job->points;
    size_t method = 0;
    for (size_t i = 0, end; i < points->count; i = end, method++) {
        for (end = i; end < points->count && points->items[end].method == points->items[i].method;)
            end++;
        char *name = text_format("method_%zu", method);
        set_text(d, name,
                 text_format("%s, by %s", points->items[i].method->name,
                             points->items[i].method->knob == KNOB_STEP ? "step" : "error"));
        free(name);
        set_number(d, "style", method, (double)style_of(points->items[i].method));
        for (size_t row = 0; row < ROW_COUNT; row++)
            write_curve(d, row, &points->items[i], end - i, method);
    }
    fprintf(d->settings, "methods = %zu\n", method);
}

static void write_panels(drawing *d) {
    for (size_t column = 0; column < COLUMN_COUNT; column++) {
        set_number(d, "time_from", column, d->times[column][0]);
        set_number(d, "time_to", column, d->times[column][1]);
        set_marks(d, "time_marks", column, d->times[column]);
        char *name = text_format("time_label_%zu", column);
        set_text(d, name, text_format("%s", d->columns[column]->label));
        free(name);
    }
    for (size_t row = 0; row < ROW_COUNT; row++) {
        set_number(d, "error_from", row, d->errors[row][0]);
        set_number(d, "error_to", row, d->errors[row][1]);
        set_number(d, "floor", row, rows[row].error(&d->floor));
        set_marks(d, "error_marks", row, d->errors[row]);
        char *name = text_format("error_label_%zu", row);
        set_text(d, name, text_format("%s", rows[row].label));
        free(name);
        write_chosen(d, row);
        for (size_t column = 0; column < COLUMN_COUNT; column++)
            write_front(d, row, column);
    }
}

static void write_settings(drawing *d, bool vector) {
    set_text(d, "picture", text_format("%s", vector ? "svg" : "png"));
    set_headings(d);
    set_reference_text(d);
    set_chosen_text(d);
    fprintf(d->settings, "asked = %.9g\n", d->job->asked);
    char *asked = fraction_text(d->job->asked);
    set_text(d, "asked_text", text_format("asked: %s", asked));
    free(asked);
    for (size_t i = 0; i < COLUMN_COUNT; i++)
        range_of_times(d, i, d->times[i]);
    for (size_t i = 0; i < ROW_COUNT; i++)
        range_of_errors(d, i, d->errors[i]);
    write_methods(d);
    write_panels(d);
}

static void write_files(drawing *d, bool vector) {
    FILE *script = gnuplot_file(&d->plot, "chart.gp", d->diags);
    d->settings = gnuplot_file(&d->plot, "settings.gp", d->diags);
    d->failed = !script || !d->settings;
    if (script)
        fputs(chart_script, script);
    if (!d->failed)
        write_settings(d, vector);
    close_data(d, script);
    close_data(d, d->settings);
}

bool chart_draw(const chart_job *job, plr_diags *diags) {
    const chart_point *first = &job->points.items[0];
    drawing d = {.job = job,
                 .columns = {first->gpu_ms > 0 ? &gpu_column : &cpu_column, &wall_column},
                 .floor = chart_floor(&job->reference),
                 .diags = diags};
    bool vector = strcmp(job->path + strlen(job->path) - 4, ".svg") == 0;
    char *text = NULL;
    size_t length;
    if (gnuplot_begin(&d.plot, diags)) {
        write_files(&d, vector);
        if (!d.failed)
            text = gnuplot_run(&d.plot, "chart.gp", "chart", &length, diags);
    }
    gnuplot_end(&d.plot);
    output_file file;
    bool written = text && output_open(&file, job->path, diags);
    if (written) {
        fwrite(text, 1, length, file.stream);
        written = output_close(&file, diags);
    }
    free(text);
    return written;
}
