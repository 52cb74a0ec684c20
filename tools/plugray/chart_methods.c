/* Which ways of sampling there are, and at which settings each is measured. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/plugray/chart.h"
#include "tools/plugray/files.h"

/* A new method is a row. */
static const chart_method methods[] = {
    {"midpoint", PLR_METHOD_MIDPOINT, KNOB_STEP, false},
    {"preintegrated", PLR_METHOD_PREINTEGRATED, KNOB_STEP, false},
    {"cells", PLR_METHOD_CELLS, KNOB_ERROR, false},
    {"planner", PLR_METHOD_AUTO, KNOB_ERROR, true},
};

static const double steps[] = {2, 1, 1.0 / 2, 1.0 / 4, 1.0 / 8, 1.0 / 16};
static const double errors[] = {1.0 / 16, 1.0 / 64, 1.0 / 255, 1.0 / 1023, 1.0 / 4095};

static const struct {
    const double *values;
    size_t count;
} knobs[] = {[KNOB_STEP] = {steps, sizeof steps / sizeof *steps},
             [KNOB_ERROR] = {errors, sizeof errors / sizeof *errors}};

enum {
    METHOD_COUNT = sizeof methods / sizeof *methods
};

_Static_assert((size_t)METHOD_COUNT <= (size_t)CHART_METHODS, "CHART_METHODS is too small");

const chart_method *chart_method_at(size_t index) {
    return index < METHOD_COUNT ? &methods[index] : NULL;
}

char *chart_method_names(void) {
    char *names = text_format("%s", methods[0].name);
    for (size_t i = 1; i < METHOD_COUNT; i++) {
        char *more = text_format("%s, %s", names, methods[i].name);
        free(names);
        names = more;
    }
    return names;
}

static void add_point(chart_points *points, const chart_method *method, double knob, bool chosen) {
    points->items = memory_array(points->items, points->count + 1, sizeof *points->items);
    points->items[points->count++] =
        (chart_point){.method = method, .knob = knob, .chosen = chosen};
}

static bool is_same(double a, double b) {
    return fabs(a - b) <= 1e-9 * fabs(a);
}

static void add_method(chart_points *points, const chart_method *method, double asked) {
    bool chosen = !method->plans; /* or it has none */
    for (size_t i = 0; i < knobs[method->knob].count; i++) {
        double knob = knobs[method->knob].values[i];
        if (!chosen && asked > knob && !is_same(asked, knob)) {
            add_point(points, method, asked, true);
            chosen = true;
        }
        bool now = !chosen && is_same(asked, knob);
        add_point(points, method, knob, now);
        chosen |= now;
    }
    if (!chosen)
        add_point(points, method, asked, true);
}

/* Marks the methods that a list names; the word that names none, or NULL. */
static const char *read_list(const char *list, bool wanted[METHOD_COUNT]) {
    for (const char *word = list; word;) {
        size_t length = strcspn(word, ","), found = METHOD_COUNT;
        for (size_t i = 0; i < METHOD_COUNT; i++)
            if (strlen(methods[i].name) == length && strncmp(methods[i].name, word, length) == 0)
                found = i;
        if (found == METHOD_COUNT)
            return word;
        wanted[found] = true;
        word = word[length] ? word + length + 1 : NULL;
    }
    return NULL;
}

bool chart_points_plan(const char *list, double asked, chart_points *points, char **unknown) {
    bool wanted[METHOD_COUNT] = {false};
    const char *word = read_list(list, wanted);
    *points = (chart_points){0};
    *unknown = word ? text_format("%.*s", (int)strcspn(word, ","), word) : NULL;
    if (word)
        return false;
    for (size_t i = 0; i < METHOD_COUNT; i++)
        if (!list || wanted[i])
            add_method(points, &methods[i], asked);
    return true;
}

void chart_point_apply(const chart_point *point, plr_view_desc *desc) {
    desc->method = point->method->method;
    desc->step = point->method->knob == KNOB_STEP ? point->knob : 0;
    desc->error = point->method->knob == KNOB_ERROR ? point->knob : 0;
}

void chart_points_filter(chart_points *points, bool (*keep)(const chart_point *point)) {
    size_t kept = 0;
    for (size_t i = 0; i < points->count; i++)
        if (keep(&points->items[i]))
            points->items[kept++] = points->items[i];
    points->count = kept;
}
