#include "x3d/names.h"

#include <ctype.h>
#include <string.h>

/* Seeded by the address of the map: nobody can prepare a file whose names all collide. */
static uint64_t hash_of(const x3d_names *names, const char *key, size_t length) {
    uint64_t hash = (uint64_t)(uintptr_t)names ^ UINT64_C(0x9e3779b97f4a7c15);
    for (size_t i = 0; i < length; i++) {
        hash = (hash ^ (unsigned char)key[i]) * UINT64_C(0xff51afd7ed558ccd);
        hash ^= hash >> 29;
    }
    return hash ^ hash >> 32;
}

static x3d_name *slot_of(const x3d_names *names, const char *key, size_t length, uint64_t hash) {
    size_t mask = names->capacity - 1;
    for (size_t i = (size_t)hash & mask;; i = (i + 1) & mask) {
        x3d_name *slot = &names->slots[i];
        if (!slot->key ||
            (slot->hash == hash && slot->length == length && memcmp(slot->key, key, length) == 0))
            return slot;
    }
}

void *x3d_names_find(const x3d_names *names, const char *key, size_t length) {
    if (!names->count)
        return NULL;
    return slot_of(names, key, length, hash_of(names, key, length))->value;
}

static void grow(x3d_names *names, plr_arena *arena) {
    x3d_names old = *names;
    names->capacity = old.capacity ? old.capacity * 2 : 16;
    names->slots = PLR_NEW_ARRAY(arena, names->capacity, x3d_name);
    for (size_t i = 0; i < old.capacity; i++)
        if (old.slots[i].key)
            *slot_of(names, old.slots[i].key, old.slots[i].length, old.slots[i].hash) =
                old.slots[i];
}

void **x3d_names_at(x3d_names *names, plr_arena *arena, const char *key, size_t length) {
    if (names->count * 2 >= names->capacity)
        grow(names, arena);
    uint64_t hash = hash_of(names, key, length);
    x3d_name *slot = slot_of(names, key, length, hash);
    if (!slot->key) {
        *slot = (x3d_name){plr_arena_copy(arena, key, length), length, hash, NULL};
        names->count++;
    }
    return &slot->value;
}

enum {
    LONGEST = 64,
    CHANGE = 4,
    CASE_CHANGE = 1
};

unsigned x3d_distance(const char *a, size_t a_length, const char *b, size_t b_length,
                      unsigned limit) {
    unsigned row[LONGEST + 1];
    if (a_length > LONGEST || b_length > LONGEST)
        return limit;
    for (size_t j = 0; j <= b_length; j++)
        row[j] = (unsigned)j * CHANGE;
    for (size_t i = 1; i <= a_length; i++) {
        unsigned diagonal = row[0];
        row[0] = (unsigned)i * CHANGE;
        for (size_t j = 1; j <= b_length; j++) {
            unsigned above = row[j], change = CHANGE;
            if (a[i - 1] == b[j - 1])
                change = 0;
            else if (tolower((unsigned char)a[i - 1]) == tolower((unsigned char)b[j - 1]))
                change = CASE_CHANGE;
            unsigned best = diagonal + change;
            if (above + CHANGE < best)
                best = above + CHANGE;
            if (row[j - 1] + CHANGE < best)
                best = row[j - 1] + CHANGE;
            row[j] = best;
            diagonal = above;
        }
    }
    return row[b_length] < limit ? row[b_length] : limit;
}

void x3d_nearest_offer(x3d_nearest *nearest, const char *candidate) {
    size_t length = strlen(candidate);
    size_t longer = length > nearest->length ? length : nearest->length;
    size_t shorter = length + nearest->length - longer;
    unsigned limit = (unsigned)((nearest->length + 2) / 3) * CHANGE + 1;
    if (nearest->length < 3)
        limit = 2 * CASE_CHANGE + 1;
    if (nearest->best)
        limit = nearest->distance + 1;
    if ((longer - shorter) * CHANGE >= limit)
        return;
    unsigned distance = x3d_distance(nearest->name, nearest->length, candidate, length, limit);
    if (distance >= limit)
        return;
    /* Of equals the first of the alphabet: the result must not depend on the order of offers. */
    if (!nearest->best || distance < nearest->distance || strcmp(candidate, nearest->best) < 0) {
        nearest->best = candidate;
        nearest->distance = distance;
    }
}
