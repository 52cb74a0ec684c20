/* TimeSensor (ISO/IEC 19775-1 V4, 8.4.1 and 8.2.4). Times are seconds since the scene was loaded.
 */
#include "x3d/events.h"

#include <math.h>
#include <string.h>

static double cycle_of(const plr_node *node) {
    double cycle = plr_node_number(node, "cycleInterval");
    return cycle > 0 ? cycle : 1;
}

/* -INFINITY where nobody gave one: the default of 0 is not meant, even behind a start before it. */
static double stop_of(const plr_node *node) {
    const plr_field *stop = plr_node_field(node, "stopTime");
    return stop->given ? stop->value.doubles[0] : -INFINITY;
}

/* By the standard, time began in 1970: a startTime of 0, the default, is long past, and only a loop
 * still runs. That holds unless the author says that time begins with the scene, or an event gives
 * the startTime. */
static bool is_long_past(const plr_node *node, bool told, bool origin_at_load) {
    return plr_node_number(node, "startTime") == 0 && !told && !origin_at_load &&
           !plr_node_bool(node, "loop");
}

static bool may_start(const x3d_events *ev, const x3d_event_node *clock) {
    const plr_node *node = clock->node;
    const x3d_clock *state = &clock->state.clock;
    double start = plr_node_number(node, "startTime"), stop = stop_of(node);
    if (!(ev->now >= start) || (stop > start && ev->now >= stop))
        return false;
    if (plr_node_bool(node, "loop"))
        return true;
    return !is_long_past(node, state->told, ev->origin_at_load) &&
           !(state->finished && state->start == start) && ev->now - start < cycle_of(node);
}

static void begin(x3d_events *ev, x3d_event_node *clock) {
    x3d_clock *state = &clock->state.clock;
    double start = plr_node_number(clock->node, "startTime"), cycle = cycle_of(clock->node);
    state->active = true;
    state->paused = state->finished = false;
    state->start = start;
    state->paused_sum = 0;
    state->cycles = floor((ev->now - start) / cycle);
    x3d_send_bool(ev, clock, "isActive", true);
    x3d_send_time(ev, clock, "cycleTime", start + state->cycles * cycle);
}

static void end(x3d_events *ev, x3d_event_node *clock) {
    x3d_clock *state = &clock->state.clock;
    if (state->paused)
        x3d_send_bool(ev, clock, "isPaused", false);
    state->active = state->paused = false;
    state->finished = true;
    x3d_send_bool(ev, clock, "isActive", false);
}

/* Where the cycle `count` of this run ends. */
static double cycle_end(const x3d_event_node *clock, double count) {
    const x3d_clock *state = &clock->state.clock;
    return state->start + state->paused_sum + count * cycle_of(clock->node);
}

static void tell(x3d_events *ev, x3d_event_node *clock, double time) {
    const x3d_clock *state = &clock->state.clock;
    double elapsed = time - state->start - state->paused_sum;
    double part = elapsed / cycle_of(clock->node);
    double fraction = part - floor(part);
    if (fraction == 0 && elapsed > 0)
        fraction = 1;
    if (!plr_node_bool(clock->node, "fractionIncreasing"))
        fraction = 1 - fraction;
    float told = (float)fraction;
    x3d_send_time(ev, clock, "elapsedTime", elapsed);
    x3d_send(ev, clock, "fraction_changed", &told, 1);
    x3d_send_time(ev, clock, "time", time);
}

/* True while it rests. */
static bool pause_or_resume(x3d_events *ev, x3d_event_node *clock) {
    x3d_clock *state = &clock->state.clock;
    double pause = plr_node_number(clock->node, "pauseTime");
    double resume = plr_node_number(clock->node, "resumeTime");
    if (state->paused && resume > pause && ev->now >= resume) {
        state->paused = false;
        state->paused_sum += fmax(resume - state->paused_at, 0);
        x3d_send_bool(ev, clock, "isPaused", false);
    } else if (!state->paused && pause > resume && pause >= state->start && ev->now >= pause) {
        state->paused = true;
        state->paused_at = pause;
        tell(ev, clock, pause);
        x3d_send_bool(ev, clock, "isPaused", true);
    }
    return state->paused;
}

static void step(x3d_events *ev, x3d_event_node *clock) {
    const plr_node *node = clock->node;
    x3d_clock *state = &clock->state.clock;
    if (!plr_node_bool(node, "enabled")) {
        if (state->active)
            end(ev, clock);
        return;
    }
    if (!state->active) {
        if (!may_start(ev, clock))
            return;
        begin(ev, clock);
    }
    double stop = stop_of(node), time = ev->now;
    bool stopped = stop > state->start && ev->now >= stop;
    if (pause_or_resume(ev, clock)) {
        if (stopped)
            end(ev, clock);
        return;
    }
    if (stopped)
        time = stop;
    double due = cycle_end(clock, state->cycles + 1);
    bool over = !plr_node_bool(node, "loop") && time >= due;
    if (over)
        time = due;
    if (!stopped && !over && time >= due) {
        double passed = time - state->start - state->paused_sum;
        state->cycles = fmax(state->cycles + 1, floor(passed / cycle_of(node)));
        x3d_send_time(ev, clock, "cycleTime", cycle_end(clock, state->cycles));
    }
    tell(ev, clock, time);
    if (stopped || over)
        end(ev, clock);
}

/* While it runs, its start and its length stay (8.2.4.3). */
static bool accepts(const x3d_event_node *clock, const plr_field *field, const plr_field *value) {
    if (!clock->state.clock.active)
        return true;
    if (strcmp(field->name, "stopTime") == 0)
        return value->value.doubles[0] > clock->state.clock.start;
    return strcmp(field->name, "startTime") != 0 && strcmp(field->name, "cycleInterval") != 0;
}

static void receive(x3d_events *ev, x3d_event_node *clock, const plr_field *field) {
    if (strcmp(field->name, "startTime") == 0)
        clock->state.clock.told = true;
    clock->state.clock.dirty = true;
    ev->again = true;
}

static bool cycles_are_heard(const x3d_event_node *clock) {
    for (size_t i = 0; i < clock->node->field_count; i++)
        if (strcmp(clock->node->fields[i].name, "cycleTime") == 0)
            return clock->fields[i] && clock->fields[i]->route_count > 0;
    return false;
}

static double sooner(double next, double moment, double now) {
    return moment > now && moment < next ? moment : next;
}

double x3d_clock_next(const x3d_event_node *clock, double now, bool origin_at_load) {
    const plr_node *node = clock->node;
    const x3d_clock *state = &clock->state.clock;
    double next = INFINITY, pause = plr_node_number(node, "pauseTime");
    double resume = plr_node_number(node, "resumeTime");
    if (!plr_node_bool(node, "enabled"))
        return next;
    if (!state->active)
        return is_long_past(node, state->told, origin_at_load)
                   ? next
                   : sooner(next, plr_node_number(node, "startTime"), now);
    next = sooner(next, stop_of(node), now);
    if (state->paused)
        return resume > pause ? sooner(next, resume, now) : next;
    if (pause > resume)
        next = sooner(next, pause, now);
    if (!plr_node_bool(node, "loop") || cycles_are_heard(clock))
        next = sooner(next, cycle_end(clock, state->cycles + 1), now);
    return next;
}

double x3d_clock_last(const x3d_event_node *clock, double time, bool origin_at_load) {
    const plr_node *node = clock->node;
    double start = plr_node_number(node, "startTime"), stop = stop_of(node);
    if (!plr_node_bool(node, "enabled") || !(start <= time) ||
        is_long_past(node, false, origin_at_load))
        return -1;
    double last = time;
    if (stop > start)
        last = fmin(last, stop);
    if (!plr_node_bool(node, "loop"))
        last = fmin(last, start + cycle_of(node));
    /* what was over before the scene was loaded has never run in it */
    return last > 0 || time == 0 ? last : -1;
}

static bool remembers(const char *field) {
    return strcmp(field, "metadata") != 0;
}

const x3d_behaviour x3d_clock_behaviours[] = {{.type = "TimeSensor",
                                               .accepts = accepts,
                                               .receive = receive,
                                               .step = step,
                                               .is_clock = true,
                                               .remembers = remembers},
                                              {.type = NULL}};
