/* plugray render: a scene into a picture. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/plugray/commands.h"
#include "tools/plugray/files.h"
#include "tools/plugray/frames.h"
#include "tools/plugray/median.h"
#include "tools/plugray/pick.h"
#include "tools/plugray/progress.h"
#include "tools/plugray/scene.h"
#include "tools/plugray/stats.h"
#include "tools/plugray/view_options.h"

typedef struct render_job {
    const tool_arguments *arguments;
    const char *path; /* of the picture, or NULL */
    view_options look;
    plr_draw_desc draw;
    double step, error;
    plr_method method;
    frame_plan frames;
    long repeat; /* 0: one draw without a warm-up */
    int stats;   /* one of the below */
    bool draws;  /* else it only picks */
    tool_scene scene;
    tool_machine machine;
    plr_view *view;
    plr_picture picture;
    plr_phase drawn; /* the median */
} render_job;

enum {
    NO_STATS,
    STATS_TEXT,
    STATS_JSON
};

/* ---- The command line ---- */

static bool has_picture_ending(const char *path) {
    static const char *const endings[] = {".png", ".exr", ".npy"};
    size_t length = strlen(path);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (length > 4 && strcmp(path + length - 4, endings[i]) == 0)
            return true;
    return false;
}

/* An option whose values are pixels. */
static bool check_pixels(const render_job *job, tool_option option, const char *name) {
    const tool_arguments *a = job->arguments;
    const char *text;
    for (size_t next = 0; (text = option_next(a, option, &next));) {
        long at[2];
        if (!read_pair(text, ',', 0, MAX_SIDE, at)) {
            usage_error(a, "%s takes X,Y in pixels from 0, not '%s'", name, text);
            return false;
        }
        if (at[0] >= job->draw.width || at[1] >= job->draw.height) {
            usage_error(a, "%s %s lies outside the %dx%d pixels", name, text, job->draw.width,
                        job->draw.height);
            return false;
        }
    }
    return true;
}

static bool read_outputs(render_job *job) {
    const tool_arguments *a = job->arguments;
    job->path = option_value(a, OPTION_PICTURE);
    const char *stats = option_value(a, OPTION_STATS);
    if (stats && *stats && strcmp(stats, "json") != 0) {
        usage_error(a, "--stats takes json or nothing, not '%s'", stats);
        return false;
    }
    job->stats = !stats ? NO_STATS : *stats ? STATS_JSON : STATS_TEXT;
    if (job->path && !has_picture_ending(job->path)) {
        usage_error(a, "-o takes a file that ends in .png, .exr or .npy, not '%s'", job->path);
        return false;
    }
    job->draws = job->path || job->stats || option_value(a, OPTION_PROBE);
    if (!job->draws && !option_value(a, OPTION_PICK)) {
        usage_error(a, "at least one of -o, --probe, --pick, --stats is needed");
        return false;
    }
    return true;
}

static bool read_sampling(render_job *job) {
    const tool_arguments *a = job->arguments;
    const char *text = option_value(a, OPTION_METHOD);
    int index = text ? word_index(option_words(OPTION_METHOD), text) : PLR_METHOD_AUTO;
    if (index < 0) {
        usage_error(a, "--method takes %s, not '%s'", option_words(OPTION_METHOD), text);
        return false;
    }
    job->method = (plr_method)index;
    if (!option_fraction(a, OPTION_ERROR_BOUND, 0, 1, &job->error) ||
        !option_number(a, OPTION_STEP, 0, 1e6, &job->step))
        return false;
    if (job->error > 0 && job->step > 0) {
        usage_error(a, "--error and --step exclude each other");
        return false;
    }
    return true;
}

static bool read_options(render_job *job) {
    const tool_arguments *a = job->arguments;
    long samples = 1;
    job->look = (view_options){.width = 640, .height = 480};
    if (!read_outputs(job) || !view_options_read(a, &job->look))
        return false;
    job->draw = (plr_draw_desc){.width = job->look.width, .height = job->look.height};
    job->frames.start = job->look.time;
    if (!check_pixels(job, OPTION_PROBE, "--probe") || !check_pixels(job, OPTION_PICK, "--pick") ||
        !frames_read(a, &job->frames) || !read_sampling(job) ||
        !option_integer(a, OPTION_SAMPLES, 1, 4096, &samples) ||
        !option_integer(a, OPTION_REPEAT, 1, 1000000, &job->repeat))
        return false;
    job->draw.samples = (int)samples;
    return true;
}

/* ---- Drawing ---- */

static bool draw_once(render_job *job, plr_phase *time) {
    plr_picture_free(&job->picture);
    if (!plr_view_draw(job->view, &job->draw, &job->picture, job->scene.diags))
        return false;
    plr_view_stats stats;
    plr_view_get_stats(job->view, &stats);
    *time = stats.draw;
    return true;
}

static bool draw(render_job *job) {
    if (!draw_once(job, &job->drawn))
        return false;
    size_t count = (size_t)job->repeat;
    double *cpu = memory_array(NULL, count, sizeof *cpu);
    double *wall = memory_array(NULL, count, sizeof *wall);
    bool drawn = true;
    for (size_t i = 0; drawn && i < count; i++) {
        plr_phase time = {0};
        drawn = draw_once(job, &time);
        cpu[i] = time.cpu_ms;
        wall[i] = time.wall_ms;
    }
    if (drawn && count)
        job->drawn = (plr_phase){median(cpu, count), median(wall, count)};
    free(cpu);
    free(wall);
    return drawn;
}

/* ---- Results ---- */

/* A decimal number with a leading digit; what is no number is said to be none. */
static void print_decimal(double value, const char *after) {
    if (isfinite(value))
        printf("%.8f%s", fabs(value) < 5e-9 ? 0.0 : value, after);
    else
        printf("%s%s", isnan(value) ? "nan" : value > 0 ? "inf" : "-inf", after);
}

static void print_probes(const render_job *job) {
    const char *text;
    for (size_t next = 0; (text = option_next(job->arguments, OPTION_PROBE, &next));) {
        long at[2];
        read_pair(text, ',', 0, MAX_SIDE, at);
        size_t pixel = (size_t)at[1] * (size_t)job->picture.width + (size_t)at[0];
        for (size_t i = 0; i < 4; i++)
            print_decimal((double)job->picture.pixels[4 * pixel + i], i < 3 ? " " : "\n");
    }
}

static bool print_picks(render_job *job) {
    const char *text;
    for (size_t next = 0; (text = option_next(job->arguments, OPTION_PICK, &next));) {
        long at[2];
        plr_pick pick;
        read_pair(text, ',', 0, MAX_SIDE, at);
        if (!plr_view_pick(job->view, &job->draw, (int)at[0], (int)at[1], &pick, job->scene.diags))
            return false;
        pick_print(stdout, &pick);
    }
    return true;
}

static void write_picture(render_job *job, long frame) {
    plr_diags *diags = job->scene.diags;
    char *path = job->path ? frames_path(&job->frames, job->path, frame) : NULL;
    if (path && folder_make_above(path, diags))
        plr_picture_write(&job->picture, path,
                          option_value(job->arguments, OPTION_TRANSPARENT) != NULL, diags);
    free(path);
    progress(NULL);
    print_probes(job);
}

static void print_stats(const render_job *job) {
    render_stats stats = {.view = job->view, .load = job->scene.load, .draw = job->drawn};
    if (job->stats == STATS_TEXT)
        stats_text(stdout, &stats);
    else if (job->stats == STATS_JSON)
        stats_json(stdout, &stats);
}

static bool draw_frames(render_job *job) {
    for (long i = 0; i == 0 || i < job->frames.count; i++) {
        if (i > 0 && !plr_view_update(job->view, frames_time(&job->frames, i), job->scene.diags))
            return false;
        progress("drawing");
        if (job->draws && !draw(job))
            return false;
        progress("writing");
        if (job->draws)
            write_picture(job, i);
        progress(NULL);
        if (!print_picks(job))
            return false;
    }
    return true;
}

/* Returns the status to end with where it is not the diagnostics that decide. */
static int render(render_job *job) {
    progress("starting GL");
    int status = tool_machine_open(&job->machine, &job->look, job->scene.diags);
    if (status != STATUS_FINE)
        return status;
    progress("linking and loading");
    job->view =
        plr_view_create(job->machine.engine, job->scene.scene, &job->scene.view, job->scene.diags);
    if (!job->view)
        return tool_view_failure(&job->scene);
    if (!draw_frames(job))
        return STATUS_MACHINE;
    print_stats(job);
    return STATUS_FINE;
}

static void close_job(render_job *job) {
    plr_picture_free(&job->picture);
    plr_view_destroy(&job->view);
    tool_machine_close(&job->machine);
    tool_scene_close(&job->scene);
}

int command_render(const tool_arguments *arguments) {
    render_job job = {.arguments = arguments};
    if (!read_options(&job))
        return STATUS_USAGE;
    int status = tool_scene_open(&job.scene, arguments, arguments->operands[0]);
    if (status == STATUS_FINE) {
        view_options_apply(&job.look, &job.scene.view);
        job.scene.view.step = job.step;
        job.scene.view.error = job.error;
        job.scene.view.method = job.method;
        job.scene.view.no_leaping = option_value(arguments, OPTION_NO_LEAPING) != NULL;
        if (job.scene.scene)
            status = render(&job);
        int told = tool_scene_finish(&job.scene);
        status = status == STATUS_FINE ? told : status;
    }
    close_job(&job);
    return status;
}
