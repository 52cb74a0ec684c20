#include "plugs/link.h"

static size_t slot_of(const plr_table *table, uint64_t key) {
    uint64_t hash = (key ^ key >> 29) * 0x9E3779B97F4A7C15u;
    size_t slot = (size_t)(hash >> 32) & table->mask;
    while (table->keys[slot] && table->keys[slot] != key)
        slot = (slot + 1) & table->mask;
    return slot;
}

void *plr_table_get(const plr_table *table, uint64_t key) {
    if (!table->keys)
        return NULL;
    size_t slot = slot_of(table, key);
    return table->keys[slot] ? table->values[slot] : NULL;
}

static void grow(plr_arena *arena, plr_table *table) {
    plr_table old = *table;
    table->mask = old.keys ? old.mask * 2 + 1 : 255;
    table->keys = PLR_NEW_ARRAY(arena, table->mask + 1, uint64_t);
    table->values = PLR_NEW_ARRAY(arena, table->mask + 1, void *);
    for (size_t i = 0; old.keys && i <= old.mask; i++) {
        if (!old.keys[i])
            continue;
        size_t slot = slot_of(table, old.keys[i]);
        table->keys[slot] = old.keys[i];
        table->values[slot] = old.values[i];
    }
}

void **plr_table_put(plr_arena *arena, plr_table *table, uint64_t key) {
    if (!table->keys || table->count * 2 > table->mask)
        grow(arena, table);
    size_t slot = slot_of(table, key);
    if (!table->keys[slot]) {
        table->keys[slot] = key;
        table->count++;
    }
    return &table->values[slot];
}
