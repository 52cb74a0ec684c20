#include "engine/pilot.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "engine/frame.h"
#include "engine/state.h"
#include "engine/targets.h"
#include "engine/volume_hull.h"
#include "engine/volume_pass.h"

enum {
    /* Side lengths that share no factor with those of most volumes: seen from the front, rays meet
     * voxels everywhere between their centres. */
    WIDTH = PLR_PILOT_WIDTH,
    HEIGHT = PLR_PILOT_HEIGHT,
    CHANNELS = 4,
    NUMBERS = WIDTH * HEIGHT * CHANNELS
};

/* Of the steps that a rung is compared with: the golden ratio, squared. */
#define SHORTER 0.38196601125010515
/* Of the estimate to the greatest difference. */
#define SAFETY 2.0
/* What no steps change: voxels and tables of 16 bits and 32-bit numbers. */
#define ROUNDING (2.0 / 65535)

/* ---- Which casts, and how they may step ---- */

bool plr_pilot_serves(const plr_view *view, const plr_cast *cast) {
    const plr_view_desc *desc = &view->desc;
    return view->engine && desc->error > 0 && !(desc->step > 0) && !cast->plan.bounded &&
           !cast->picks;
}

/* Steps of the first rung to those that are planned: pieces of cells can only get shorter. */
static double first_rung(const plr_cast *cast) {
    return cast->plan.method == PLR_METHOD_CELLS ? 1 : 2;
}

static double rung_length(const plr_cast *cast, int rung) {
    return ldexp(first_rung(cast), -rung);
}

double plr_pilot_shortest(const plr_cast *cast) {
    return SHORTER * rung_length(cast, PLR_PILOT_RUNGS - 1);
}

static bool serves_any(const plr_view *view) {
    for (size_t i = 0; i < view->volumes.cast_count; i++)
        if (view->volumes.casts[i].piloted)
            return true;
    return false;
}

void plr_pilot_prepare(plr_view *view, plr_cast *cast) {
    if (!plr_pilot_serves(view, cast))
        return;
    plr_piloted *piloted = PLR_NEW(&view->arena, plr_piloted);
    piloted->choices = PLR_NEW_ARRAY(&view->arena, cast->plan.choice_count, plr_choice);
    memcpy(piloted->choices, cast->plan.choices,
           cast->plan.choice_count * sizeof *piloted->choices);
    cast->piloted = piloted;
}

/* What is planned, before anything is changed. */
static void remember(plr_cast *cast) {
    plr_piloted *piloted = cast->piloted;
    if (piloted->step > 0)
        return;
    piloted->step = cast->plan.step;
    piloted->allowed = cast->allowed;
    piloted->why = cast->plan.why;
}

/* Steps so much shorter or longer than planned; false if the renderer cannot. The error of parts of
 * cells goes with the square of their length. */
static bool set_steps(plr_view *view, plr_cast *cast, double length) {
    remember(cast);
    cast->plan.step = cast->piloted->step;
    if (cast->plan.method == PLR_METHOD_CELLS) {
        cast->allowed = cast->piloted->allowed * length * length;
        return true;
    }
    cast->plan.step *= length;
    for (size_t i = 0; i < cast->count; i++) {
        plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        state->step = cast->plan.step * state->voxel;
    }
    return plr_cast_fit_slabs(view, cast);
}

static bool set_all(plr_view *view, int rung, double part) {
    bool fine = true;
    for (size_t i = 0; i < view->volumes.cast_count; i++) {
        plr_cast *cast = &view->volumes.casts[i];
        if (cast->piloted && !set_steps(view, cast, part * rung_length(cast, rung)))
            fine = false;
    }
    return fine;
}

/* ---- One drawing ---- */

/* The rectangle of the picture, in clip coordinates, where the casts are; false if it is empty. */
static bool find_window(const plr_view *view, const plr_frame *frame, double window[2][2]) {
    plr_frame any_size = *frame; /* hulls are a pixel wider */
    any_size.viewport[2] = any_size.viewport[3] = 512;
    for (int axis = 0; axis < 2; axis++) {
        window[0][axis] = 1;
        window[1][axis] = -1;
    }
    for (size_t i = 0; i < view->volumes.cast_count; i++) {
        const plr_cast *cast = &view->volumes.casts[i];
        plr_hull hull;
        if (!cast->piloted)
            continue;
        plr_volume_hull(view->volumes.volumes, cast->members, cast->everywhere ? 0 : cast->count,
                        &any_size, &hull);
        for (int k = 0; k < hull.count; k++)
            for (int axis = 0; axis < 2; axis++) {
                double place = fmin(fmax((double)hull.points[k][axis], -1), 1);
                window[0][axis] = fmin(window[0][axis], place);
                window[1][axis] = fmax(window[1][axis], place);
            }
    }
    return window[1][0] > window[0][0] && window[1][1] > window[0][1];
}

/* The same camera through this window. */
static plr_frame frame_of(const plr_view *view, const plr_frame *frame, double window[2][2]) {
    plr_frame small = *frame;
    double size[2], middle[2];
    for (int axis = 0; axis < 2; axis++) {
        size[axis] = (window[1][axis] - window[0][axis]) / 2;
        middle[axis] = (window[1][axis] + window[0][axis]) / 2;
    }
    plr_matrix scale = plr_matrix_scale(1 / size[0], 1 / size[1], 1);
    plr_matrix shift = plr_matrix_translation(-middle[0], -middle[1], 0);
    scale = plr_matrix_multiply(&scale, &shift);
    small.projection = plr_matrix_multiply(&scale, &frame->projection);
    memcpy(small.viewport, (const double[4]){0, 0, WIDTH, HEIGHT}, sizeof small.viewport);
    small.opaque_depth = view->pilot.framebuffer.depth;
    return small;
}

static bool make_targets(plr_view *view) {
    plr_pilot *pilot = &view->pilot;
    const plr_gl *gl = &view->engine->gl;
    if (pilot->framebuffer.name)
        return true;
    bool fine = plr_framebuffer_create(&pilot->framebuffer, gl, WIDTH, HEIGHT, NULL);
    gl->GenFramebuffers(1, &pilot->color_only);
    gl->BindFramebuffer(GL_FRAMEBUFFER, pilot->color_only);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                             pilot->framebuffer.color, 0);
    return fine;
}

static bool draw(plr_view *view, const plr_frame *small, float *pixels) {
    static const float nothing[4] = {0, 0, 0, 0};
    const plr_framebuffer *framebuffer = &view->pilot.framebuffer;
    const plr_shot shot = {.framebuffer = framebuffer->name,
                           .without_depth = view->pilot.color_only,
                           .depths = framebuffer->name,
                           .background = &view->background,
                           .behind = nothing};
    plr_frame_draw(view, small, &shot);
    view->pilot.drawings++;
    return plr_framebuffer_read(framebuffer, pixels);
}

/* ---- Estimates ---- */

/* Not a number if there is one that is none. */
static double greatest_difference(const float *a, const float *b) {
    double most = 0;
    for (size_t i = 0; i < NUMBERS; i++) {
        double difference = fabs((double)a[i] - (double)b[i]);
        most = difference <= most ? most : difference;
        if (isnan(difference))
            return difference;
    }
    return most;
}

/* Of a rung; negative if it cannot be drawn. */
static double estimate(plr_view *view, const plr_frame *small, int rung) {
    static const double parts[2] = {1, SHORTER};
    float pixels[2][NUMBERS];
    for (int i = 0; i < 2; i++)
        if (!set_all(view, rung, parts[i]) || !draw(view, small, pixels[i]))
            return -1;
    double difference = greatest_difference(pixels[0], pixels[1]);
    if (!isfinite(difference))
        return -1;
    bool ends_early = false;
    for (size_t i = 0; i < view->volumes.cast_count; i++)
        ends_early = ends_early || !view->volumes.casts[i].everywhere;
    return SAFETY * difference + ROUNDING + (ends_early ? view->desc.error / 8 : 0);
}

/* The next rung that may do: at best each has a quarter of the error of the one before. */
static int next_rung(int rung, double value, double error) {
    const double optimism = 2; /* the estimate may be so many times too large */
    value /= optimism;
    do {
        rung++;
        value /= 4;
    } while (value > error && rung + 1 < PLR_PILOT_RUNGS);
    return rung;
}

static void choose(plr_view *view, const plr_frame *small) {
    plr_pilot *pilot = &view->pilot;
    double error = view->desc.error;
    pilot->rung = -1;
    pilot->value = -1;
    for (int rung = 0; rung > pilot->rung && rung < PLR_PILOT_RUNGS;) {
        double value = estimate(view, small, rung);
        if (value < 0) { /* too short for the renderer: perhaps longer ones are not */
            rung--;
            continue;
        }
        pilot->rung = rung;
        pilot->value = value;
        if (value <= error)
            break;
        rung = next_rung(rung, value, error);
    }
}

/* ---- What comes of it ---- */

static void say(const plr_view *view, plr_cast *cast) {
    plr_piloted *piloted = cast->piloted;
    const plr_pilot *pilot = &view->pilot;
    bool kept = pilot->value <= view->desc.error;
    snprintf(piloted->words, sizeof piloted->words,
             "%s; by %d pilot drawings of %d x %d rays these are %s", piloted->why, pilot->drawings,
             WIDTH, HEIGHT,
             kept ? "the longest steps that keep the error"
                  : "the shortest there are, and the error is out of reach");
    snprintf(piloted->error, sizeof piloted->error,
             "pilot drawings found that channels of pixels differ by about %.3g at most",
             pilot->value);
    snprintf(piloted->method, sizeof piloted->method, "%s; steps of %.3g voxels", piloted->words,
             cast->plan.step);
    cast->plan.why = piloted->words;
    cast->plan.choices = piloted->choices;
    for (size_t i = 0; i < cast->plan.choice_count; i++) {
        plr_choice *choice = &piloted->choices[i];
        if (strcmp(choice->about, "sampling") == 0)
            choice->why = piloted->method;
        if (strcmp(choice->about, "error") == 0)
            choice->why = piloted->error;
    }
}

/* Nothing that was measured: as it was planned. */
static void take_back(plr_view *view, plr_cast *cast) {
    set_steps(view, cast, 1);
    cast->plan.value = cast->plan.method == PLR_METHOD_CELLS ? cast->plan.value : -1;
    cast->plan.why = cast->piloted->why;
}

static void apply(plr_view *view) {
    for (size_t i = 0; i < view->volumes.cast_count; i++) {
        plr_cast *cast = &view->volumes.casts[i];
        if (!cast->piloted)
            continue;
        cast->piloted->applied = true;
        if (view->pilot.rung < 0 || !set_steps(view, cast, rung_length(cast, view->pilot.rung))) {
            take_back(view, cast);
            continue;
        }
        cast->plan.value = view->pilot.value;
        say(view, cast);
    }
}

static bool all_applied(const plr_view *view) {
    for (size_t i = 0; i < view->volumes.cast_count; i++) {
        const plr_cast *cast = &view->volumes.casts[i];
        if (cast->piloted && !cast->piloted->applied)
            return false;
    }
    return true;
}

/* ---- When ---- */

static bool is_known(const plr_view *view, const plr_frame *frame) {
    const plr_pilot *pilot = &view->pilot;
    return pilot->known && pilot->revision == view->revision && pilot->time == frame->time &&
           memcmp(&pilot->projection, &frame->projection, sizeof frame->projection) == 0 &&
           memcmp(&pilot->view, &frame->view, sizeof frame->view) == 0;
}

static void note(plr_view *view, const plr_frame *frame) {
    plr_pilot *pilot = &view->pilot;
    pilot->known = true;
    pilot->revision = view->revision;
    pilot->time = frame->time;
    pilot->projection = frame->projection;
    pilot->view = frame->view;
}

static void measure(plr_view *view, const plr_frame *frame) {
    const plr_gl *gl = &view->engine->gl;
    plr_gl_state state;
    double window[2][2];
    plr_phase start = plr_clock();
    plr_gl_state_save(gl, &state);
    view->pilot.drawings = 0;
    if (make_targets(view) && find_window(view, frame, window)) {
        plr_frame small = frame_of(view, frame, window);
        choose(view, &small);
    } else { /* nothing of them is in the picture */
        view->pilot.rung = 0;
        view->pilot.value = 0;
    }
    plr_gl_state_restore(gl, &state);
    note(view, frame);
    apply(view);
    plr_phase end = plr_clock();
    view->stats.pilots = (plr_phase){end.cpu_ms - start.cpu_ms, end.wall_ms - start.wall_ms};
}

/* Volumes may be seen in textures, too: a picture must not depend on what was measured when. */
static void draw_targets(plr_view *view, const plr_frame *here) {
    for (size_t i = 0; i < view->targets.count; i++)
        view->targets.items[i]->drawn = false;
    plr_targets_draw(view, here);
}

void plr_pilot_fly(plr_view *view, const plr_frame *frame, const plr_frame *here) {
    if (!serves_any(view))
        return;
    if (view->desc.interactive) {
        view->pilot.last = *frame;
        if (view->pilot.known && !all_applied(view))
            apply(view);
    } else if (!is_known(view, frame)) {
        measure(view, frame);
        draw_targets(view, here);
    } else if (!all_applied(view)) {
        apply(view);
    }
}

void plr_pilot_rest(plr_view *view) {
    const plr_frame *last = &view->pilot.last;
    if (serves_any(view) && last->viewport[2] > 0 && !is_known(view, last))
        measure(view, last);
}

void plr_pilot_finish(plr_view *view) {
    plr_pilot *pilot = &view->pilot;
    if (!pilot->framebuffer.name)
        return;
    view->engine->gl.DeleteFramebuffers(1, &pilot->color_only);
    plr_framebuffer_destroy(&pilot->framebuffer);
}
