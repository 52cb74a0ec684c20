/* Which texture fetches a program makes, and for whom. */
#include <stdlib.h>
#include <string.h>

#include <plugray/engine.h>
#include "engine/glsl.h"

typedef struct fetch {
    uint32_t line;
    size_t symbol; /* SIZE_MAX: not known */
} fetch;

typedef struct fetch_list {
    const plr_program *program;
    fetch *items;
    size_t count, capacity;
    bool no_memory;
} fetch_list;

static size_t find_symbol(const plr_program *program, const char *name) {
    for (size_t i = 0; name && i < plr_program_symbol_count(program); i++)
        if (strcmp(plr_program_symbol(program, i)->program, name) == 0)
            return i;
    return SIZE_MAX;
}

static void add_fetch(void *user, uint32_t line, const char *sampler) {
    fetch_list *list = user;
    if (list->count == list->capacity) {
        size_t capacity = list->capacity * 2 + 64;
        fetch *items = realloc(list->items, capacity * sizeof *items);
        if (!items) {
            list->no_memory = true;
            return;
        }
        list->items = items;
        list->capacity = capacity;
    }
    list->items[list->count++] = (fetch){line, find_symbol(list->program, sampler)};
}

static int compare(const void *a, const void *b) {
    const fetch *x = a, *y = b;
    if (x->line != y->line)
        return x->line < y->line ? -1 : 1;
    return x->symbol < y->symbol ? -1 : x->symbol > y->symbol;
}

static plr_fetch_info describe(const plr_program *program, const fetch *f, size_t count) {
    plr_mapped mapped;
    plr_program_map(program, PLR_FRAGMENT, f->line, 0, &mapped);
    const plr_symbol *symbol = plr_program_symbol(program, f->symbol);
    return (plr_fetch_info){.place = mapped.place,
                            .effect = symbol ? symbol->effect : mapped.effect,
                            .sampler = symbol ? symbol->name : NULL,
                            .count = (uint32_t)count};
}

size_t plr_program_fetches(const plr_program *program, plr_fetch_info *fetches, size_t capacity) {
    fetch_list list = {.program = program};
    const char *text = plr_program_text(program, PLR_FRAGMENT, NULL);
    size_t rows = 0;
    if (text && plr_glsl_fetches(text, PLR_FRAGMENT, add_fetch, &list) && !list.no_memory) {
        if (list.count)
            qsort(list.items, list.count, sizeof *list.items, compare);
        for (size_t i = 0, end; i < list.count; i = end, rows++) {
            for (end = i + 1; end < list.count && !compare(&list.items[i], &list.items[end]);)
                end++;
            if (rows < capacity)
                fetches[rows] = describe(program, &list.items[i], end - i);
        }
    }
    free(list.items);
    return rows;
}
