/* The surfaces of equal value that a volume node asks for. */
#include "engine/volume_pass.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ISO/IEC 19775-1 V4 41.4.3, IsoSurfaceVolumeData: one value and a step: every value that lies
 * whole steps away, within the data; several values: these. A number says which style a surface
 * has: its place in the list, or, of steps, 0 for the value given and the others from the least on.
 */

typedef struct surface_list {
    float (*items)[2];
    size_t count;
    bool full;
} surface_list;

static void add_surface(surface_list *list, double value, size_t number) {
    if (!isfinite(value))
        return;
    if (list->count == PLR_MOST_SURFACES) {
        list->full = true;
        return;
    }
    list->items[list->count][0] = (float)value;
    list->items[list->count++][1] = (float)number;
}

static void add_contours(surface_list *list, double value, double step) {
    step = fabs(step);
    double first = ceil(-value / step - 1e-6), last = floor((1 - value) / step + 1e-6);
    if (first > 0 || last < 0)
        add_surface(list, value,
                    0); /* outside the data, where it may be after an author's effect */
    if (last - first >= PLR_MOST_SURFACES) {
        list->full = true;
        first = fmax(first, -PLR_MOST_SURFACES / 2.0);
        last = fmin(last, first + PLR_MOST_SURFACES - 1);
    }
    size_t number = 1;
    for (int i = 0; i < PLR_MOST_SURFACES && first + i <= last; i++) {
        double k = first + i;
        add_surface(list, value + k * step, k == 0 ? 0 : number++);
    }
}

static int by_value(const void *a, const void *b) {
    const float *x = a, *y = b;
    return x[0] != y[0] ? (x[0] < y[0] ? -1 : 1) : (x[1] > y[1]) - (x[1] < y[1]);
}

/* From what the author writes to 0..1. */
typedef struct scale {
    double low, size;
} scale;

static scale find_scale(const plr_volume_state *state) {
    const plr_field *physical = plr_node_field(state->node, "physicalUnits");
    const double *range = state->grid->range;
    if (!physical || !plr_node_bool(state->node, "physicalUnits") || range[0] == range[1])
        return (scale){0, 1};
    return (scale){range[0], range[1] - range[0]};
}

static void add_given(const plr_volume_state *state, surface_list *list) {
    const plr_field *values = plr_node_field(state->node, "surfaceValues");
    scale s = find_scale(state);
    double step = plr_node_number(state->node, "contourStepSize") / s.size;
    if (values->count == 1 && step != 0 && isfinite(step)) {
        add_contours(list, ((double)values->value.floats[0] - s.low) / s.size, step);
        return;
    }
    for (size_t i = 0; i < values->count; i++)
        add_surface(list, ((double)values->value.floats[i] - s.low) / s.size, i);
}

enum {
    MOST_LOOKS = 4096 /* at styles of one volume: DEF and USE can make a few lines into very many */
};

static const plr_node *find_style(const plr_node *style, size_t *left) {
    if (!style || !*left || !plr_node_bool(style, "enabled"))
        return NULL;
    --*left;
    if (plr_node_is(style, "ISOSurfaceVolumeStyle"))
        return style;
    const plr_field *members = plr_node_field(style, "renderStyle");
    if (!plr_node_is(style, "ComposedVolumeStyle"))
        return NULL;
    for (size_t i = 0; members && i < members->count; i++) {
        const plr_node *found = find_style(members->value.nodes[i], left);
        if (found)
            return found;
    }
    return NULL;
}

const plr_node *plr_surface_style(const plr_node *style) {
    size_t left = MOST_LOOKS;
    return find_style(style, &left);
}

/* The style of 2005 has no value: this one is taken. */
#define SURFACE_OF_2005 0.5

void plr_volume_find_surfaces(plr_view *view, plr_volume_state *state, plr_diags *diags) {
    surface_list list = {.items =
                             plr_arena_alloc(&view->arena, PLR_MOST_SURFACES * sizeof *list.items)};
    const plr_node *style = NULL;
    if (plr_node_is(state->node, "IsoSurfaceVolumeData"))
        add_given(state, &list);
    else if (plr_node_is(state->node, "VolumeData"))
        style = plr_surface_style(plr_node_child(state->node, "renderStyle"));
    else
        return;
    if (style) {
        add_surface(&list, SURFACE_OF_2005, 0);
        plr_diags_add_as(diags, PLR_WARNING, PLR_CODE_BAD_VALUE, plr_node_place(style),
                         "an ISOSurfaceVolumeStyle has no value of its own: the surface at %g is "
                         "drawn; IsoSurfaceVolumeData has surfaceValues",
                         SURFACE_OF_2005);
    } else if (plr_node_is(state->node, "VolumeData")) {
        return;
    }
    if (list.full)
        plr_diags_add(diags, PLR_CODE_LIMIT, plr_node_place(state->node),
                      "more than %d surfaces of one volume; the rest is left out",
                      PLR_MOST_SURFACES);
    qsort(list.items, list.count, sizeof *list.items, by_value);
    state->kind = PLR_VOLUME_SURFACES;
    state->surfaces = list.items;
    state->surface_count = list.count;
}
