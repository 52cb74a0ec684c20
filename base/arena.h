/* Memory that lives and dies together. An allocation that fails does not return: it jumps to the
 * arena's `out_of_memory`, which its owner must have set; so code between needs no checks. */
#ifndef PLR_BASE_ARENA_H
#define PLR_BASE_ARENA_H

#include <setjmp.h>
#include <plugray/base.h>

struct plr_arena_block;

typedef struct plr_arena {
    plr_allocator allocator;
    struct plr_arena_block *blocks;
    char *next;
    size_t left;
    jmp_buf *out_of_memory;
} plr_arena;

/* `allocator` NULL or of zeros: the C library's. */
void plr_arena_init(plr_arena *arena, const plr_allocator *allocator, jmp_buf *out_of_memory);
void plr_arena_finish(plr_arena *arena);
/* Zeroed memory, aligned for anything. */
void *plr_arena_alloc(plr_arena *arena, size_t size);
/* `count` * `size`, checked for overflow. */
void *plr_arena_array(plr_arena *arena, size_t count, size_t size);
char *plr_arena_copy(plr_arena *arena, const char *text, size_t length);
char *plr_arena_format(plr_arena *arena, const char *format, ...) PLR_PRINTF(2, 3);
/* An array of `*capacity` elements with room for at least `needed`: the old one, or a copy. */
void *plr_arena_grow(plr_arena *arena, void *array, size_t *capacity, size_t needed, size_t size);

#define PLR_NEW(arena, type) ((type *)plr_arena_alloc((arena), sizeof(type)))
#define PLR_NEW_ARRAY(arena, count, type) ((type *)plr_arena_array((arena), (count), sizeof(type)))
/* Makes room for one more element of a {items, count, capacity} and yields a pointer to it. */
#define PLR_PUSH(arena, list)                                                                      \
    ((list)->items = plr_arena_grow((arena), (list)->items, &(list)->capacity, (list)->count + 1,  \
                                    sizeof *(list)->items),                                        \
     &(list)->items[(list)->count++])

/* The allocator that NULL or a struct of zeros stands for, or the one given. */
plr_allocator plr_allocator_resolve(const plr_allocator *allocator);

#endif
