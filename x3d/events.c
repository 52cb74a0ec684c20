/* The scene in time: the public calls, and how a time is reached. */
#include "x3d/events.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Exact in binary, so that every tick is where it is however many came before. */
static const double tick = 1.0 / 32;

enum {
    /* of a clock that starts clocks at once, within one moment */
    MOST_ROUNDS = 8,
    /* moments of clocks between two ticks */
    MOST_MOMENTS = 64
};

uint64_t plr_node_revision(const plr_node *node) {
    return node->revision;
}

uint64_t plr_scene_revision(const plr_scene *scene) {
    return scene->revision;
}

void x3d_events_was_set(plr_scene *scene, plr_node *node, size_t index, bool same) {
    node->revision += !same;
    scene->revision += !same;
    if (!same)
        scene->set_revision = scene->revision;
    x3d_event_field *field = node->events ? node->events->fields[index] : NULL;
    if (!field)
        return;
    field->original = node->fields[index];
    field->changed = false;
    field->has_shown = false;
}

plr_field *x3d_events_given(plr_node *node, size_t index) {
    x3d_event_field *field = node->events ? node->events->fields[index] : NULL;
    return field && field->changed ? &field->original : &node->fields[index];
}

bool plr_scene_changes(const plr_scene *scene, uint64_t since,
                       void (*visit)(void *user, plr_node *node, const plr_field *field),
                       void *user) {
    if (scene->set_revision > since)
        return false;
    for (x3d_event_field *f = scene->events ? scene->events->listed : NULL; f; f = f->next_listed)
        if (f->changed_at > since)
            visit(user, f->owner->node, &f->owner->node->fields[f->index]);
    return true;
}

/* ---- One moment ---- */

/* Clocks come first, then what looks at where things are. A clock that gets an event has another
 * look at the same moment: it may start now. */
static void step_clocks(x3d_events *ev, bool all) {
    for (int round = 0; round < MOST_ROUNDS; round++) {
        ev->stamp++;
        ev->again = false;
        for (size_t i = 0; i < ev->clocks.count; i++) {
            x3d_event_node *clock = ev->clocks.items[i];
            if (!(all && round == 0) && !clock->state.clock.dirty)
                continue;
            clock->state.clock.dirty = false;
            clock->behaviour->step(ev, clock);
        }
        x3d_cascade(ev);
        ev->work += (double)ev->clocks.count;
        if (!ev->again || ev->work > X3D_MOST_WORK)
            return;
    }
}

static void step_others(x3d_events *ev) {
    if (!ev->steppers.count)
        return;
    ev->stamp++;
    x3d_event_places_update(ev);
    for (size_t i = 0; i < ev->steppers.count; i++)
        ev->steppers.items[i]->behaviour->step(ev, ev->steppers.items[i]);
    x3d_cascade(ev);
}

static void step(x3d_events *ev, double now) {
    ev->now = now;
    step_clocks(ev, true);
    step_others(ev);
    if (ev->again)
        step_clocks(ev, false);
}

static void start(x3d_events *ev) {
    ev->now = 0;
    ev->stamp++;
    x3d_bindables_start(ev);
    for (size_t i = 0; i < ev->starters.count; i++)
        ev->starters.items[i]->behaviour->start(ev, ev->starters.items[i]);
    x3d_cascade(ev);
}

/* ---- Scenes without a past ---- */

typedef struct turn {
    double last;
    size_t order;
    x3d_event_node *clock;
} turn;

static int compare_turns(const void *a, const void *b) {
    const turn *x = a, *y = b;
    if (x->last != y->last)
        return x->last < y->last ? -1 : 1;
    return x->order < y->order ? -1 : x->order > y->order;
}

/* Each clock runs for itself: it starts, and says what it said last. A clock that ended first has
 * the first word, so that the latest one stands where several speak to one field. */
static void go_straight_to(x3d_events *ev, double time) {
    turn *turns = x3d_events_scratch(ev, (ev->clocks.count + 1) * sizeof *turns);
    size_t count = 0;
    for (size_t i = 0; i < ev->clocks.count; i++) {
        x3d_event_node *clock = ev->clocks.items[i];
        double last = x3d_clock_last(clock, time, ev->origin_at_load);
        if (last >= 0)
            turns[count++] = (turn){last, i, clock};
    }
    qsort(turns, count, sizeof *turns, compare_turns);
    ev->scratch = NULL; /* interpolators want some, too */
    ev->scratch_room = 0;
    for (size_t i = 0; i < count; i++) {
        x3d_event_node *clock = turns[i].clock;
        const plr_node *node = clock->node;
        double began = fmax(plr_node_number(node, "startTime"), 0), last = turns[i].last;
        bool ends = !plr_node_bool(node, "loop") || plr_node_field(node, "stopTime")->given;
        for (int phase = ends && began < last ? 0 : 1; phase < 2; phase++) {
            ev->now = phase ? last : began;
            ev->stamp++;
            clock->behaviour->step(ev, clock);
            x3d_cascade(ev);
        }
    }
    ev->now = time;
    step_others(ev);
}

/* ---- Scenes with a past ---- */

static double next_moment(const x3d_events *ev) {
    double next = INFINITY;
    for (size_t i = 0; i < ev->clocks.count; i++)
        next = fmin(next, x3d_clock_next(ev->clocks.items[i], ev->now, ev->origin_at_load));
    return next;
}

static void live_through(x3d_events *ev, double time) {
    double length = tick;
    while (time / length > ev->most_steps)
        length *= 2;
    step(ev, 0);
    for (double k = 1; ev->now < time; k++) {
        double until = fmin(k * length, time);
        for (int i = 0; i < MOST_MOMENTS && ev->work < X3D_MOST_WORK; i++) {
            double moment = next_moment(ev);
            if (!(moment > ev->now && moment < until))
                break;
            step(ev, moment);
        }
        step(ev, until);
    }
}

/* ---- The public call ---- */

/* What is in a scene and does nothing in time; once each. */
static void report_what_rests(x3d_events *ev, plr_diags *diags) {
    static const char *const types[] = {"X3DScriptNode",
                                        "X3DFollowerNode",
                                        "NurbsOrientationInterpolator",
                                        "NurbsPositionInterpolator",
                                        "NurbsSurfaceInterpolator",
                                        "GeoPositionInterpolator",
                                        "GeoProximitySensor"};
    bool told[sizeof types / sizeof *types] = {false};
    for (size_t i = 0; i < ev->nodes.count; i++) {
        const plr_node *node = ev->nodes.items[i]->node;
        for (size_t t = 0; t < sizeof types / sizeof *types; t++) {
            if (told[t] || !plr_node_is(node, types[t]))
                continue;
            told[t] = true;
            plr_diags_add(diags, PLR_CODE_NOT_DRAWN, plr_node_place(node),
                          "%s does nothing: plugray does not run it", plr_node_type(node));
        }
    }
}

static void set_time(plr_scene *scene, double time, const plr_viewer *viewer, plr_diags *diags) {
    if (!scene->events) {
        scene->events = x3d_events_build(scene);
        report_what_rests(scene->events, diags);
    }
    x3d_events *ev = scene->events;
    ev->viewer = viewer;
    ev->work = 0;
    x3d_events_reset(ev);
    if (!(time > 0))
        time = 0;
    if (time > 1e15) /* beyond, seconds are not told apart */
        time = 1e15;
    start(ev);
    if (ev->has_history)
        live_through(ev, time);
    else
        go_straight_to(ev, time);
    x3d_events_compare(ev);
    ev->viewer = NULL;
}

bool plr_scene_set_time(plr_scene *scene, double time, const plr_viewer *viewer, plr_diags *diags) {
    jmp_buf out_of_memory;
    jmp_buf *outer = scene->arena.out_of_memory;
    scene->arena.out_of_memory = &out_of_memory;
    volatile bool ok = false;
    if (setjmp(out_of_memory) == 0) {
        set_time(scene, time, viewer, diags);
        ok = true;
    } else {
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, (plr_place){NULL, 0, 0},
                      "not enough memory for what happens in the scene");
    }
    scene->arena.out_of_memory = outer;
    return ok;
}
