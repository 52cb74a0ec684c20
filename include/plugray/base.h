/* plugray/base.h - what every part of plugray shares: places in files, diagnostics, allocators.
 *
 * Thread safety: there is no global state. One object may be used by one thread at a time,
 * different objects by different threads. */
#ifndef PLUGRAY_BASE_H
#define PLUGRAY_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define PLR_API __attribute__((visibility("default")))
#define PLR_PRINTF(string, first) __attribute__((__format__(__printf__, string, first)))
#else
#define PLR_API
#define PLR_PRINTF(string, first)
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define PLR_VERSION "0.1.0"

/* Memory from the host. `reallocate` behaves like realloc (pointer NULL allocates) with a size that
 * is never 0; it returns NULL when there is no memory. `release` accepts NULL. A struct of zeros
 * means the C library's allocator. */
typedef struct plr_allocator {
    void *(*reallocate)(void *user, void *pointer, size_t size);
    void (*release)(void *user, void *pointer);
    void *user;
} plr_allocator;

/* A position in a file. `line` and `column` count from 1, columns in bytes; line 0: the whole file.
 * `file` may be NULL (nowhere in particular). */
typedef struct plr_place {
    const char *file;
    uint32_t line, column;
} plr_place;

/* From byte `offset` of a text on, the text stands at `line`:`column` of the file. */
typedef struct plr_break {
    size_t offset;
    uint32_t line, column;
} plr_break;

/* Where a text comes from. Byte 0 stands at line:column of `file` (0 means 1); after each newline
 * of the text the line grows by one and the column starts again at 1. Where decoding (an escape, an
 * entity) made text and file differ, `breaks`, sorted by offset, say where the text goes on. */
typedef struct plr_origin {
    const char *file;
    uint32_t line, column;
    const plr_break *breaks;
    size_t break_count;
} plr_origin;

/* The place of byte `offset` of `text`, that came from `origin`. Scans the text: O(offset). */
PLR_API plr_place plr_origin_place(const plr_origin *origin, const char *text, size_t offset);

typedef enum plr_severity {
    PLR_NOTE,    /* belongs to the diagnostic before it */
    PLR_INFO,    /* a fact worth a line; never changes an exit status */
    PLR_WARNING, /* the picture may not be what the author means */
    PLR_ERROR    /* something was left out */
} plr_severity;

/* Every kind of diagnostic: identifier, its stable code in messages, usual severity, help. */
typedef enum plr_code {
#define PLR_CODE(id, code, severity, help) PLR_CODE_##id,
#include <plugray/codes.def>
#undef PLR_CODE
    PLR_CODE_COUNT
} plr_code;

/* The stable text of a code ("unknown-plug"), its usual severity, and a sentence of help. */
PLR_API const char *plr_code_text(plr_code code);
PLR_API plr_severity plr_code_severity(plr_code code);
PLR_API const char *plr_code_help(plr_code code);
/* "error", "warning", "note", "info". */
PLR_API const char *plr_severity_text(plr_severity severity);

typedef struct plr_diag {
    plr_severity severity;
    plr_code code;
    plr_place place;
    const char *message; /* one line, no full stop, no newline */
} plr_diag;

/* A list of diagnostics. Strings are copied in. A diagnostic equal to one that the list already has
 * (code, place and message) is dropped, with the notes that follow it. */
typedef struct plr_diags plr_diags;

/* A new empty list, or NULL without memory. `allocator` NULL: the C library's. */
PLR_API plr_diags *plr_diags_create(const plr_allocator *allocator);
/* Frees the list and sets the pointer to NULL. */
PLR_API void plr_diags_destroy(plr_diags **diags);
/* Adds a diagnostic; printf formats of numbers and strings only. `diags` NULL: nothing happens.
 * Without memory the diagnostic is lost, but counted. */
PLR_API void plr_diags_add(plr_diags *diags, plr_code code, plr_place place, const char *format,
                           ...) PLR_PRINTF(4, 5);
/* The same with a severity other than the usual one. */
PLR_API void plr_diags_add_as(plr_diags *diags, plr_severity severity, plr_code code,
                              plr_place place, const char *format, ...) PLR_PRINTF(5, 6);
/* A note that belongs to the diagnostic added last. */
PLR_API void plr_diags_note(plr_diags *diags, plr_place place, const char *format, ...)
    PLR_PRINTF(3, 4);
PLR_API size_t plr_diags_count(const plr_diags *diags);
/* The index-th diagnostic, in the order of adding; valid until the list changes. */
PLR_API const plr_diag *plr_diags_get(const plr_diags *diags, size_t index);
/* How many of one severity, lost ones included. */
PLR_API size_t plr_diags_count_of(const plr_diags *diags, plr_severity severity);

#ifdef __cplusplus
}
#endif
#endif
