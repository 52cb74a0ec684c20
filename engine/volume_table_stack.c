/* Tables of several transfer functions in the textures of one. */
#include <math.h>
#include <string.h>

#include "engine/volume_table.h"

/* What is known of a number: its function's first row and last node, and where it can be seen. */
static void fill_number(const plr_table *table, uint32_t row, float out[4]) {
    static const float none[4] = {0, 1, INFINITY, -INFINITY};
    memcpy(out, none, sizeof none);
    if (!table)
        return;
    out[0] = (float)row;
    out[1] = (float)(table->sum_nodes - 1);
    plr_table_seen(table, out + 2);
}

static plr_texture *stack_ranges(plr_textures *textures, plr_arena *arena, plr_table *const *tables,
                                 uint32_t count) {
    uint32_t across = PLR_RANGES_ACROSS, side = PLR_TABLE_RANGES;
    plr_image image = plr_table_image(arena, across * side, (count + across - 1) / across * side);
    size_t row = (size_t)4 * side;
    for (uint32_t i = 0; i < count; i++) {
        float *at = (float *)image.samples + (i / across * side * across + i % across) * row;
        for (uint32_t y = 0; y < side; y++)
            memcpy(at + y * across * row, tables[i]->range_rows + y * row, row * sizeof *at);
    }
    return plr_table_numbers(textures, &image);
}

plr_table *plr_table_stack(plr_textures *textures, plr_arena *arena, plr_table *const *tables,
                           uint32_t table_count, const uint32_t *numbers, uint32_t count) {
    plr_table *t = PLR_NEW(arena, plr_table);
    uint32_t width = count;
    t->tame = t->gentle = t->clips = true;
    for (uint32_t i = 0; i < table_count; i++) {
        width = tables[i]->sum_nodes > width ? tables[i]->sum_nodes : width;
        t->tame = t->tame && tables[i]->tame;
        t->gentle = t->gentle && tables[i]->gentle;
        t->walls += tables[i]->walls;
    }
    plr_image sums = plr_table_image(arena, width, 4 * table_count + 1);
    float *at = sums.samples;
    for (uint32_t i = 0; i < 4 * table_count; i++, at += (size_t)4 * width) {
        size_t row = (size_t)4 * tables[i / 4]->sum_nodes;
        memcpy(at, tables[i / 4]->sum_rows + i % 4 * row, row * sizeof *at);
    }
    for (uint32_t i = 0; i < width; i++, at += 4) {
        uint32_t number = numbers[i < count ? i : count - 1];
        fill_number(number == PLR_TABLE_NONE ? NULL : tables[number], 4 * number, at);
    }
    t->sums = plr_table_numbers(textures, &sums);
    t->ranges = stack_ranges(textures, arena, tables, table_count);
    return t;
}
