#include "base/arena.h"

#include <stdalign.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK_SIZE ((size_t)64 * 1024)

struct plr_arena_block {
    struct plr_arena_block *next;
    alignas(max_align_t) char data[];
};

static void *system_reallocate(void *user, void *pointer, size_t size) {
    (void)user;
    return realloc(pointer, size);
}

static void system_release(void *user, void *pointer) {
    (void)user;
    free(pointer);
}

plr_allocator plr_allocator_resolve(const plr_allocator *allocator) {
    if (allocator && allocator->reallocate)
        return *allocator;
    return (plr_allocator){system_reallocate, system_release, NULL};
}

void plr_arena_init(plr_arena *arena, const plr_allocator *allocator, jmp_buf *out_of_memory) {
    *arena =
        (plr_arena){.allocator = plr_allocator_resolve(allocator), .out_of_memory = out_of_memory};
}

void plr_arena_finish(plr_arena *arena) {
    for (struct plr_arena_block *block = arena->blocks, *next; block; block = next) {
        next = block->next;
        arena->allocator.release(arena->allocator.user, block);
    }
    arena->blocks = NULL;
    arena->next = NULL;
    arena->left = 0;
}

static void *new_block(plr_arena *arena, size_t size) {
    struct plr_arena_block *block = NULL;
    if (size <= SIZE_MAX - sizeof *block)
        block = arena->allocator.reallocate(arena->allocator.user, NULL, sizeof *block + size);
    if (!block)
        longjmp(*arena->out_of_memory, 1);
    block->next = arena->blocks;
    arena->blocks = block;
    return block->data;
}

void *plr_arena_alloc(plr_arena *arena, size_t size) {
    const size_t align = alignof(max_align_t);
    if (!size)
        size = 1; /* so that nothing has an address of its own, never NULL */
    if (size > SIZE_MAX - align)
        longjmp(*arena->out_of_memory, 1);
    size = (size + align - 1) / align * align;
    char *memory;
    if (size > BLOCK_SIZE / 4) { /* large ones get a block of their own: no waste of the current */
        memory = new_block(arena, size);
    } else {
        if (size > arena->left) {
            arena->next = new_block(arena, BLOCK_SIZE);
            arena->left = BLOCK_SIZE;
        }
        memory = arena->next;
        arena->next += size;
        arena->left -= size;
    }
    return memset(memory, 0, size);
}

void *plr_arena_array(plr_arena *arena, size_t count, size_t size) {
    if (size && count > SIZE_MAX / size)
        longjmp(*arena->out_of_memory, 1);
    return plr_arena_alloc(arena, count * size);
}

char *plr_arena_copy(plr_arena *arena, const char *text, size_t length) {
    if (length == SIZE_MAX)
        longjmp(*arena->out_of_memory, 1);
    char *copy = plr_arena_alloc(arena, length + 1);
    if (length)
        memcpy(copy, text, length);
    return copy;
}

char *plr_arena_format(plr_arena *arena, const char *format, ...) {
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    size_t size = length < 0 ? 1 : (size_t)length + 1;
    char *text = plr_arena_alloc(arena, size);
    if (length >= 0)
        vsnprintf(text, size, format, again);
    va_end(again);
    return text;
}

void *plr_arena_grow(plr_arena *arena, void *array, size_t *capacity, size_t needed, size_t size) {
    if (needed <= *capacity)
        return array;
    size_t larger = *capacity < 8 ? 8 : *capacity;
    while (larger < needed) {
        if (larger > SIZE_MAX / 2)
            longjmp(*arena->out_of_memory, 1);
        larger *= 2;
    }
    void *copy = plr_arena_array(arena, larger, size);
    if (*capacity)
        memcpy(copy, array, *capacity * size);
    *capacity = larger;
    return copy;
}
