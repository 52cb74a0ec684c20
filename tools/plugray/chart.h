/* plugray chart: time against error of each way to sample the volumes of a scene. */
#ifndef PLUGRAY_TOOL_CHART_H
#define PLUGRAY_TOOL_CHART_H

#include "tools/plugray/scene.h"
#include "tools/plugray/view_options.h"

/* ---- Methods (chart_methods.c) ---- */

/* What a method is turned by. */
typedef enum chart_knob {
    KNOB_STEP, /* fixed steps, in voxels */
    KNOB_ERROR /* the error that is asked for */
} chart_knob;

enum {
    CHART_METHODS = 16 /* at most */
};

typedef struct chart_method {
    const char *name;
    plr_method method;
    chart_knob knob;
    bool plans; /* it is the planner: its point for the error asked for is the one chosen */
} chart_method;

typedef struct chart_error {
    double rmse, max; /* of a channel, premultiplied; infinite where a picture has no number */
} chart_error;

typedef struct chart_point {
    const chart_method *method;
    double knob;
    double cpu_ms, wall_ms, gpu_ms; /* medians; gpu_ms 0: there is no GPU */
    double compile_ms;
    chart_error error;
    plr_plan plan; /* `why` is not kept */
    bool measured, pareto, chosen;
} chart_point;

typedef struct chart_points {
    chart_point *items;
    size_t count;
} chart_points;

/* The points to be measured: of the methods in `list` (separated by commas; NULL: all), and of the
 * planner that for `asked`. False where the list names none; then `*unknown` is the word. */
bool chart_points_plan(const char *list, double asked, chart_points *points, char **unknown);
/* NULL beyond the last. */
const chart_method *chart_method_at(size_t index);
/* "midpoint, preintegrated, ..."; free it. */
char *chart_method_names(void);
/* What a point asks of a view. */
void chart_point_apply(const chart_point *point, plr_view_desc *desc);
/* Leaves out the points that `keep` does not want. */
void chart_points_filter(chart_points *points, bool (*keep)(const chart_point *point));

/* ---- The reference (chart_reference.c) ---- */

/* Fixed steps of 4, 2 and 1 times `step` with midpoints, extrapolated to steps of nothing. */
typedef struct chart_reference {
    double step;
    double *pixels; /* as those of plr_picture */
    chart_error
        bar;      /* how far the extrapolations from the two coarser and the two finer are apart */
    double order; /* of convergence, as observed; NaN: nothing changes */
    plr_phase draw; /* what the three draws took */
} chart_reference;

/* Richardson's extrapolation of three pictures of `count` numbers, the coarsest first. */
void chart_extrapolate(const float *const levels[3], size_t count, chart_reference *reference);
chart_error chart_compare(const float *pixels, const double *reference, size_t count);

/* ---- Programs (chart_compile.c) ---- */

typedef struct chart_compiled_view {
    uint64_t hash; /* of its programs */
    double cpu_ms;
} chart_compiled_view;

typedef struct chart_compiled {
    chart_compiled_view *items;
    size_t count;
} chart_compiled;

/* What linking and compiling a view's programs took, of all processors, when the first view that
 * has them was made; what the first draw takes more than others is the driver's part of it. */
double chart_compile_time(chart_compiled *compiled, const plr_view *view, double first_draw_ms,
                          double draw_ms);

/* ---- Drawing it all (chart_sweep.c) ---- */

typedef struct chart_job {
    const tool_arguments *arguments;
    const char *path;
    view_options look;
    double asked, reference_step; /* reference_step 0: as fine as two minutes allow */
    long repeat;
    tool_scene scene;
    tool_machine machine;
    chart_points points;
    chart_reference reference;
    chart_compiled compiled;
    size_t faults;     /* errors of every view of the scene */
    bool interleaved;  /* all points were measured in turns */
    const char *named; /* the scene, for people */
} chart_job;

/* Makes the reference and measures all points. Returns STATUS_FINE or what to end with. */
int chart_sweep(chart_job *job);

/* ---- The front (chart_front.c) ---- */

/* The time that counts: that of the GPU where it is known, else that of the processors. */
double chart_time(const chart_point *point);
/* Below this, errors cannot be told from those of the reference: three times its bar, and at least
 * the rounding of a float. */
chart_error chart_floor(const chart_reference *reference);
/* Marks in front[] the points to which no other one is equal or better in time and error and better
 * in one of the two. Errors below `floor` count as `floor`. */
void chart_front(const double *times, const double *errors, double floor, size_t count,
                 bool *front);
/* Marks the points' own front of chart_time and RMSE. */
void chart_points_front(chart_points *points, const chart_reference *reference);

/* ---- Output ---- */

/* chart_csv.c */
void chart_csv(FILE *out, const chart_job *job);
/* chart_draw.c: a picture by gnuplot. False with an error. */
bool chart_draw(const chart_job *job, plr_diags *diags);

#endif
