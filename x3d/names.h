/* A map from names to pointers, in an arena. */
#ifndef PLR_X3D_NAMES_H
#define PLR_X3D_NAMES_H

#include "base/arena.h"

typedef struct x3d_name {
    const char *key; /* NULL: free */
    size_t length;
    uint64_t hash;
    void *value;
} x3d_name;

/* Zero value: empty. */
typedef struct x3d_names {
    x3d_name *slots;
    size_t count, capacity;
} x3d_names;

/* The value of a name, or NULL. */
void *x3d_names_find(const x3d_names *names, const char *key, size_t length);
/* Where the value of a name is kept; a new name (copied) has the value NULL. */
void **x3d_names_at(x3d_names *names, plr_arena *arena, const char *key, size_t length);

/* How different two names are (insertions, deletions, changes; a change of case counts little), at
 * most `limit`. In units of 1/4 of a change. */
unsigned x3d_distance(const char *a, size_t a_length, const char *b, size_t b_length,
                      unsigned limit);

/* Looks for the name nearest to another one: begin with {name, length}, offer every candidate; then
 * `best` is the nearest one, or NULL where none is near enough to be meant. */
typedef struct x3d_nearest {
    const char *name;
    size_t length;
    const char *best;
    unsigned distance;
} x3d_nearest;
void x3d_nearest_offer(x3d_nearest *nearest, const char *candidate);

#endif
