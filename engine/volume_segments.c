#include "engine/volume_segments.h"

#include <math.h>
#include <string.h>

#include "engine/volume_blocks.h"
#include "engine/volume_maps.h"
#include "engine/volume_pass.h"

enum {
    MOST_FUNCTIONS = 256, /* that differ: their rows are in one texture */
    MOST_GENTLE = 16,     /* these have many nodes */
    MOST_NUMBERS = 8192   /* a side that textures may have everywhere */
};

/* The functions of the segments. */
typedef struct segments {
    plr_view *view;
    plr_volume_state *state;
    const plr_field *styles;
    uint32_t *numbers; /* which function each has; PLR_TABLE_NONE: it is hidden */
    uint32_t count;    /* of numbers; the last one stands for all above, too */
    plr_function functions[MOST_FUNCTIONS];
    uint32_t function_count;
    plr_table *tables[MOST_FUNCTIONS];
    uint64_t seen_by[MOST_FUNCTIONS]; /* the labels of each */
} segments;

static bool add_function(segments *s, const plr_function *function, uint32_t *number) {
    uint32_t i = 0;
    while (i < s->function_count &&
           (s->functions[i].place != function->place || s->functions[i].factor != function->factor))
        i++;
    *number = i;
    if (i == MOST_FUNCTIONS)
        return false;
    s->functions[i] = *function;
    s->function_count += i == s->function_count;
    return true;
}

/* Which labels of blocks a number is among, the last one with all above. */
static uint64_t labels_of(const segments *s, uint32_t number) {
    uint32_t first = number < PLR_BLOCK_LABELS ? number : PLR_BLOCK_LABELS;
    return number + 1 < s->count ? UINT64_C(1) << first : UINT64_MAX << first;
}

/* Whether a number is in the data, or may be; without labels all are of segment 0. */
static bool is_there(const segments *s, uint32_t number) {
    const plr_blocks *blocks = s->state->blocks;
    if (!blocks->labels)
        return number == 0;
    return number <= blocks->most_label && (labels_of(s, number) & blocks->all_labels) != 0;
}

/* In general worlds what is hidden counts, too: a switch may show it. */
static bool add_number(segments *s, uint32_t number) {
    const plr_node *style = number < s->styles->count ? s->styles->value.nodes[number] : NULL;
    bool drawn = plr_volume_draws_segment(s->state->node, style, number);
    plr_style_map found;
    uint32_t *which = &s->numbers[number];
    *which = PLR_TABLE_NONE;
    if (!is_there(s, number) || (!drawn && !s->state->general))
        return true;
    if (!plr_style_find_map(style, s->state->general, &found))
        return false;
    plr_function function = {NULL, found.factor, false};
    if (!found.bare && !(function.place = plr_style_place(s->view, found.map, s->state->grid)))
        return false;
    if (!add_function(s, &function, which))
        return false;
    if (drawn)
        s->seen_by[*which] |= labels_of(s, number);
    else
        *which = PLR_TABLE_NONE;
    return true;
}

static bool add_numbers(segments *s) {
    const plr_field *enabled = plr_node_field(s->state->node, "segmentEnabled");
    size_t count = s->styles->count;
    if (enabled && enabled->count > count)
        count = enabled->count;
    if (count >= MOST_NUMBERS)
        return false;
    s->count = (uint32_t)count + 1;
    s->numbers = PLR_NEW_ARRAY(&s->view->arena, s->count, uint32_t);
    for (uint32_t i = 0; i < s->count; i++)
        if (!add_number(s, i))
            return false;
    return true;
}

/* All with the same means within nodes. */
static void make_tables(segments *s) {
    bool gentle = s->function_count <= MOST_GENTLE, again = true;
    while (again) {
        bool all = gentle, any = false;
        for (uint32_t i = 0; i < s->function_count; i++) {
            s->tables[i] = plr_volume_make_table(s->view, s->state, &s->functions[i], true, gentle);
            all = all && s->tables[i]->gentle;
            any = any || s->tables[i]->gentle;
        }
        again = any && !all;
        gentle = false;
    }
}

static bool sees(const void *user, size_t block) {
    const segments *s = user;
    const plr_blocks *blocks = s->state->blocks;
    const float *range = blocks->range[block];
    bool seen = false;
    for (uint32_t i = 0; i < s->function_count && !seen; i++)
        seen = (blocks->labels[block] & s->seen_by[i]) != 0 &&
               plr_table_sees(s->tables[i], (double)range[0], (double)range[1]);
    return seen;
}

/* All of one segment. */
static void make_single(segments *s) {
    plr_volume_state *state = s->state;
    plr_function function = {NULL, 0, false}; /* hidden */
    if (s->numbers[0] != PLR_TABLE_NONE)
        function = s->functions[s->numbers[0]];
    state->table = plr_volume_make_table(s->view, state, &function, false, true);
    state->integrals = state->table->texture;
    plr_table_seen(state->table, state->seen);
    state->leaps = plr_volume_make_leaps(s->view, state, NULL, NULL);
}

static void make_stack(segments *s) {
    plr_volume_state *state = s->state;
    if (!s->function_count) /* all are hidden */
        s->functions[s->function_count++] = (plr_function){NULL, 0, false};
    make_tables(s);
    state->seen[0] = INFINITY;
    state->seen[1] = -INFINITY;
    for (uint32_t i = 0; i < s->function_count; i++) {
        float seen[2];
        plr_table_seen(s->tables[i], seen);
        state->seen[0] = s->seen_by[i] ? fminf(state->seen[0], seen[0]) : state->seen[0];
        state->seen[1] = s->seen_by[i] ? fmaxf(state->seen[1], seen[1]) : state->seen[1];
    }
    state->table = plr_table_stack(&s->view->textures, &s->view->arena, s->tables,
                                   s->function_count, s->numbers, s->count);
    state->leaps = plr_volume_make_leaps(s->view, state, sees, s);
}

/* Whether nobody but styles decides on colours. */
static bool is_plain(plr_view *view, const plr_volume_state *state) {
    return state->blocks && state->kind == PLR_VOLUME_FILLED && !state->authors_act &&
           !(state->general && view->general_state.no_tables) &&
           !plr_pass_fog(view, view->volumes.leaves[state->index]->scope)->node;
}

bool plr_volume_find_segments(plr_view *view, plr_volume_state *state) {
    segments s = {
        .view = view, .state = state, .styles = plr_node_field(state->node, "renderStyle")};
    if (!is_plain(view, state) || !add_numbers(&s))
        return false;
    if (state->labels)
        make_stack(&s);
    else
        make_single(&s);
    state->sums = state->table->sums;
    state->ranges = state->table->ranges;
    return true;
}
