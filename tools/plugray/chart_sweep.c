/* Draws the reference, then every point again and again in turns. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "tools/plugray/chart.h"
#include "tools/plugray/files.h"
#include "tools/plugray/median.h"
#include "tools/plugray/progress.h"

static const double reference_seconds = 120; /* what the reference may take unless it is given */
static const double finest_reference = 1.0 / 64, coarsest_reference = 1.0 / 16;
static const double pieces_guess = 1.0 / 8; /* steps that a point without fixed ones may take */

/* How much is done, in milliseconds of drawing. */
typedef struct workload {
    double done, total;
    double voxel_ms; /* what steps of one voxel take */
    double draws;    /* of each point */
} workload;

/* A point while it is measured. */
typedef struct measuring {
    chart_point *point;
    plr_view *view;
    plr_phase warm_up;
    double *cpu, *wall, *gpu; /* of each repeat */
} measuring;

static void work_done(workload *work, double milliseconds) {
    work->done += milliseconds;
    progress_part(work->total > 0 ? work->done / work->total : 0);
}

/* ---- One drawing ---- */

static plr_draw_desc draw_desc(const chart_job *job) {
    return (plr_draw_desc){.width = job->look.width, .height = job->look.height, .samples = 1};
}

/* The first view, which says what is wrong with the scene. */
static plr_view *make_first_view(chart_job *job, const plr_view_desc *desc) {
    plr_diags *diags = job->scene.diags;
    size_t before = plr_diags_count_of(diags, PLR_ERROR);
    plr_view *view = plr_view_create(job->machine.engine, job->scene.scene, desc, diags);
    job->faults = plr_diags_count_of(diags, PLR_ERROR) - before;
    return view;
}

/* Says the last error of `diags` of `name`. */
static void report_fault(chart_job *job, const plr_diags *diags, const char *name) {
    for (size_t i = plr_diags_count(diags); i-- > 0;) {
        const plr_diag *diag = plr_diags_get(diags, i);
        if (diag->severity != PLR_ERROR)
            continue;
        plr_diags_add(job->scene.diags, diag->code, diag->place, "%s: %s", name, diag->message);
        return;
    }
}

/* Another view. It has the faults of the first one, which are told already; if there are more, or
 * no memory, that is said of `name`, and there is no view. */
static plr_view *make_view(chart_job *job, const plr_view_desc *desc, const char *name) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_view *view = plr_view_create(job->machine.engine, job->scene.scene, desc, diags);
    if (!view || plr_diags_count_of(diags, PLR_ERROR) > job->faults) {
        report_fault(job, diags, name);
        plr_view_destroy(&view);
    }
    plr_diags_destroy(&diags);
    return view;
}

static bool draw(chart_job *job, plr_view *view, plr_picture *picture, plr_view_stats *stats) {
    plr_draw_desc desc = draw_desc(job);
    if (!plr_view_draw(view, &desc, picture, job->scene.diags))
        return false;
    plr_view_get_stats(view, stats);
    return true;
}

static size_t number_count(const chart_job *job) {
    return (size_t)job->look.width * (size_t)job->look.height * 4;
}

/* ---- The reference ---- */

static bool shows_volumes(const plr_view *view) {
    plr_drawable drawable;
    for (size_t i = 0; plr_view_drawable(view, i, &drawable); i++)
        if (drawable.kind[0] == 'v' && drawable.program)
            return true;
    return false;
}

/* The time of a draw with steps of one voxel, warm. */
static int try_scene(chart_job *job, double *milliseconds) {
    plr_view_desc desc = job->scene.view;
    desc.step = 1;
    plr_view *view = make_first_view(job, &desc);
    if (!view)
        return tool_view_failure(&job->scene);
    int status = STATUS_FINE;
    if (!shows_volumes(view)) {
        plr_diags_add(job->scene.diags, PLR_CODE_NO_VOLUME, (plr_place){0},
                      "the scene shows no volume: there is nothing to be sampled");
        status = STATUS_INPUT;
    }
    plr_view_stats stats[2] = {0};
    for (int i = 0; i < 2 && status == STATUS_FINE; i++) {
        plr_picture picture;
        if (!draw(job, view, &picture, &stats[i]))
            status = STATUS_MACHINE;
        plr_picture_free(&picture);
    }
    chart_compile_time(&job->compiled, view, stats[0].draw.cpu_ms, stats[1].draw.cpu_ms);
    *milliseconds = stats[1].draw.wall_ms;
    plr_view_destroy(&view);
    return status;
}

/* 4, 2 and 1 times it. */
static double reference_cost(double step, double milliseconds) {
    return milliseconds / step * (1 + 1.0 / 2 + 1.0 / 4);
}

static void choose_reference(chart_job *job, double milliseconds) {
    double step = job->reference_step > 0 ? job->reference_step : finest_reference;
    while (!(job->reference_step > 0) && step < coarsest_reference &&
           reference_cost(step, milliseconds) > 1000 * reference_seconds)
        step *= 2;
    job->reference.step = step;
}

static bool draw_level(chart_job *job, double step, plr_picture *picture, workload *work) {
    plr_view_desc desc = job->scene.view;
    desc.step = step;
    desc.error = 1e-6; /* rays go on until nothing is left */
    desc.method = PLR_METHOD_MIDPOINT;
    plr_view *view = make_view(job, &desc, "the reference");
    plr_view_stats stats = {0};
    bool drawn = view && draw(job, view, picture, &stats);
    plr_view_destroy(&view);
    job->reference.draw.cpu_ms += stats.draw.cpu_ms;
    job->reference.draw.wall_ms += stats.draw.wall_ms;
    work_done(work, stats.draw.wall_ms);
    return drawn;
}

static bool make_reference(chart_job *job, workload *work) {
    plr_picture levels[3] = {{0}};
    bool drawn = true;
    for (int i = 0; i < 3 && drawn; i++)
        drawn = draw_level(job, job->reference.step * (4 >> i), &levels[i], work);
    if (drawn) {
        const float *pixels[3] = {levels[0].pixels, levels[1].pixels, levels[2].pixels};
        chart_extrapolate(pixels, number_count(job), &job->reference);
    }
    for (int i = 0; i < 3; i++)
        plr_picture_free(&levels[i]);
    return drawn;
}

/* ---- Points ---- */

static double predicted(const chart_point *point, double milliseconds) {
    return milliseconds / (point->method->knob == KNOB_STEP ? point->knob : pieces_guess);
}

static bool warm_up(chart_job *job, measuring *m, workload *work) {
    plr_picture picture;
    plr_view_stats stats;
    if (!draw(job, m->view, &picture, &stats))
        return false;
    m->warm_up = stats.draw;
    m->point->error = chart_compare(picture.pixels, job->reference.pixels, number_count(job));
    plr_picture_free(&picture);
    work->total += work->draws * (m->warm_up.wall_ms - predicted(m->point, work->voxel_ms));
    work_done(work, m->warm_up.wall_ms);
    return true;
}

/* Without a view where the scene cannot be sampled so. False where drawing fails. */
static bool begin(chart_job *job, measuring *m, chart_point *point, workload *work) {
    plr_view_desc desc = job->scene.view;
    chart_point_apply(point, &desc);
    *m = (measuring){.point = point, .view = make_view(job, &desc, point->method->name)};
    if (!m->view)
        return true;
    plr_view_get_plan(m->view, &point->plan);
    point->plan.why = NULL;
    m->cpu = memory_array(NULL, (size_t)job->repeat, sizeof *m->cpu);
    m->wall = memory_array(NULL, (size_t)job->repeat, sizeof *m->wall);
    m->gpu = memory_array(NULL, (size_t)job->repeat, sizeof *m->gpu);
    return warm_up(job, m, work);
}

static bool measure(chart_job *job, measuring *m, long round, workload *work) {
    plr_picture picture;
    plr_view_stats stats;
    if (!m->view)
        return true;
    if (!draw(job, m->view, &picture, &stats))
        return false;
    plr_picture_free(&picture);
    m->cpu[round] = stats.draw.cpu_ms;
    m->wall[round] = stats.draw.wall_ms;
    m->gpu[round] = stats.gpu_ms;
    work_done(work, stats.draw.wall_ms);
    return true;
}

static void finish(chart_job *job, measuring *m) {
    chart_point *point = m->point;
    if (!m->view)
        return;
    point->measured = true;
    point->cpu_ms = median(m->cpu, (size_t)job->repeat);
    point->gpu_ms = median(m->gpu, (size_t)job->repeat);
    point->wall_ms = median(m->wall, (size_t)job->repeat);
    point->compile_ms =
        chart_compile_time(&job->compiled, m->view, m->warm_up.cpu_ms, point->cpu_ms);
}

static void end(measuring *m) {
    plr_view_destroy(&m->view);
    free(m->cpu);
    free(m->wall);
    free(m->gpu);
}

/* Every other round goes backwards, so that a machine that gets slower favours none. */
static bool measure_rounds(chart_job *job, measuring *batch, size_t count, workload *work) {
    for (long round = 0; round < job->repeat; round++)
        for (size_t i = 0; i < count; i++)
            if (!measure(job, &batch[round % 2 ? count - 1 - i : i], round, work))
                return false;
    for (size_t i = 0; i < count; i++)
        finish(job, &batch[i]);
    return true;
}

/* ---- All of them ---- */

/* Bytes of memory that this process uses; 0: not known. */
static double memory_used(void) {
    FILE *file = fopen("/proc/self/statm", "r");
    unsigned long size, resident = 0;
    if (file && fscanf(file, "%lu %lu", &size, &resident) != 2)
        resident = 0;
    if (file)
        fclose(file);
    return (double)resident * (double)sysconf(_SC_PAGESIZE);
}

/* How many views may live at a time where one takes `bytes`: half of what is free is left. */
static size_t view_limit(double bytes) {
    double room = (double)sysconf(_SC_AVPHYS_PAGES) * (double)sysconf(_SC_PAGESIZE) / 2;
    double limit = bytes > 0 ? 1 + room / bytes : 1e6;
    return limit < 1e6 ? (size_t)limit : 1000000;
}

/* Makes and warms up views from point `first` on, as many as memory allows; `*count` of them. */
static bool begin_batch(chart_job *job, measuring *batch, size_t first, size_t *count,
                        workload *work) {
    double before = memory_used();
    size_t limit = 1;
    for (*count = 0; first + *count < job->points.count && *count < limit; ++*count) {
        if (!begin(job, &batch[*count], &job->points.items[first + *count], work)) {
            ++*count;
            return false;
        }
        if (*count == 0)
            limit = view_limit(memory_used() - before);
    }
    return true;
}

static bool measure_points(chart_job *job, workload *work) {
    size_t count = 0;
    bool drawn = true;
    measuring *batch = memory_array(NULL, job->points.count, sizeof *batch);
    for (size_t first = 0; drawn && first < job->points.count; first += count) {
        progress("drawing");
        drawn = begin_batch(job, batch, first, &count, work);
        progress("measuring");
        drawn = drawn && measure_rounds(job, batch, count, work);
        for (size_t i = 0; i < count; i++)
            end(&batch[i]);
        job->interleaved = count == job->points.count;
    }
    free(batch);
    return drawn;
}

/* What cannot be sampled by a method is sampled otherwise: that is no point of the method. */
static bool is_of_its_method(const chart_point *point) {
    return point->measured && (point->method->plans || point->plan.method == point->method->method);
}

static size_t count_of(const chart_points *points, const chart_method *method) {
    size_t count = 0;
    for (size_t i = 0; i < points->count; i++)
        count += points->items[i].method == method;
    return count;
}

/* Takes away the points that are none, and says so. False if nothing is left. */
static bool leave_out(chart_job *job) {
    const chart_method *method;
    size_t before[CHART_METHODS];
    for (size_t i = 0; (method = chart_method_at(i)); i++)
        before[i] = count_of(&job->points, method);
    chart_points_filter(&job->points, is_of_its_method);
    for (size_t i = 0; (method = chart_method_at(i)); i++)
        if (count_of(&job->points, method) < before[i])
            plr_diags_add_as(job->scene.diags, job->points.count ? PLR_INFO : PLR_ERROR,
                             PLR_CODE_NO_METHOD, (plr_place){0},
                             "%s: the scene cannot be sampled so; it is left out", method->name);
    return job->points.count > 0;
}

int chart_sweep(chart_job *job) {
    double voxel_ms = 0;
    progress("linking and loading");
    int status = try_scene(job, &voxel_ms);
    if (status != STATUS_FINE)
        return status;
    choose_reference(job, voxel_ms);
    workload work = {.voxel_ms = voxel_ms, .draws = 1 + (double)job->repeat};
    work.total = reference_cost(job->reference.step, voxel_ms);
    for (size_t i = 0; i < job->points.count; i++)
        work.total += work.draws * predicted(&job->points.items[i], voxel_ms);
    progress("drawing the reference");
    if (!make_reference(job, &work) || !measure_points(job, &work))
        return STATUS_MACHINE;
    if (!leave_out(job))
        return STATUS_INPUT;
    chart_points_front(&job->points, &job->reference);
    return STATUS_FINE;
}
