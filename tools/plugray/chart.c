/* plugray chart: speed against accuracy for a scene. */
#include <stdlib.h>
#include <string.h>

#include "tools/plugray/chart.h"
#include "tools/plugray/commands.h"
#include "tools/plugray/files.h"
#include "tools/plugray/gnuplot.h"
#include "tools/plugray/progress.h"

static bool ends_with(const char *path, const char *ending) {
    size_t length = strlen(path), tail = strlen(ending);
    return length > tail && strcmp(path + length - tail, ending) == 0;
}

static bool read_path(chart_job *job) {
    job->path = option_value(job->arguments, OPTION_CHART_FILE);
    if (!job->path)
        usage_error(job->arguments, "-o CHART is missing");
    else if (ends_with(job->path, ".svg") || ends_with(job->path, ".png") ||
             ends_with(job->path, ".csv"))
        return true;
    else
        usage_error(job->arguments, "-o takes a file that ends in .svg, .png or .csv, not '%s'",
                    job->path);
    return false;
}

static bool read_methods(chart_job *job) {
    char *unknown, *names;
    const char *list = option_value(job->arguments, OPTION_METHODS);
    if (chart_points_plan(list, job->asked, &job->points, &unknown))
        return true;
    names = chart_method_names();
    usage_error(job->arguments, "--methods takes some of %s, separated by commas, not '%s'", names,
                unknown);
    free(names);
    free(unknown);
    return false;
}

static bool read_options(chart_job *job) {
    const tool_arguments *a = job->arguments;
    job->look = (view_options){.width = 320, .height = 240};
    job->asked = 1.0 / 255;
    job->repeat = 5;
    return read_path(job) && view_options_read(a, &job->look) &&
           option_fraction(a, OPTION_ERROR_BOUND, 0, 1, &job->asked) &&
           option_fraction(a, OPTION_REFERENCE, 0, 2, &job->reference_step) &&
           option_integer(a, OPTION_CHART_REPEAT, 1, 10000, &job->repeat) && read_methods(job);
}

static bool write_csv(const chart_job *job, plr_diags *diags) {
    output_file file;
    if (!output_open(&file, job->path, diags))
        return false;
    chart_csv(file.stream, job);
    return output_close(&file, diags);
}

/* Returns the status to end with where it is not the diagnostics that decide. */
static int chart(chart_job *job) {
    plr_diags *diags = job->scene.diags;
    bool table = ends_with(job->path, ".csv");
    if (!table && !gnuplot_find(diags))
        return STATUS_MACHINE; /* before all that work */
    progress("starting GL");
    int status = tool_machine_open(&job->machine, &job->look, diags);
    if (status == STATUS_FINE)
        status = chart_sweep(job);
    if (status != STATUS_FINE)
        return status;
    progress("writing");
    return (table ? write_csv : chart_draw)(job, diags) ? STATUS_FINE : STATUS_MACHINE;
}

static void name_scene(chart_job *job) {
    const char *path = job->arguments->operands[0], *slash = strrchr(path, '/');
    job->named = strcmp(path, "-") == 0 ? "standard input" : slash ? slash + 1 : path;
}

static void close_job(chart_job *job) {
    tool_machine_close(&job->machine);
    tool_scene_close(&job->scene);
    free(job->compiled.items);
    free(job->points.items);
    free(job->reference.pixels);
}

int command_chart(const tool_arguments *arguments) {
    chart_job job = {.arguments = arguments};
    int status = read_options(&job) ? STATUS_FINE : STATUS_USAGE;
    if (status == STATUS_FINE)
        status = tool_scene_open(&job.scene, arguments, arguments->operands[0]);
    if (status == STATUS_FINE) {
        name_scene(&job);
        view_options_apply(&job.look, &job.scene.view);
        if (job.scene.scene)
            status = chart(&job);
        int told = tool_scene_finish(&job.scene);
        status = status == STATUS_FINE ? told : status;
    }
    close_job(&job);
    return status;
}
