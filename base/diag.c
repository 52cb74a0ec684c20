#include <plugray/base.h>

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/arena.h"

struct plr_diags {
    plr_arena arena;
    struct {
        plr_diag *items;
        size_t count, capacity;
    } list;
    size_t counts[PLR_ERROR + 1];
    bool dropping; /* the diagnostic added last was a repetition: its notes go too */
};

static const struct {
    const char *text;
    plr_severity severity;
    const char *help;
} codes[] = {
#define PLR_CODE(id, code, severity, help) {code, severity, help},
#include <plugray/codes.def>
#undef PLR_CODE
};

const char *plr_code_text(plr_code code) {
    return (unsigned)code < PLR_CODE_COUNT ? codes[code].text : "";
}

plr_severity plr_code_severity(plr_code code) {
    return (unsigned)code < PLR_CODE_COUNT ? codes[code].severity : PLR_ERROR;
}

const char *plr_code_help(plr_code code) {
    return (unsigned)code < PLR_CODE_COUNT ? codes[code].help : "";
}

const char *plr_severity_text(plr_severity severity) {
    static const char *const names[] = {"note", "info", "warning", "error"};
    return (unsigned)severity <= PLR_ERROR ? names[severity] : "";
}

plr_diags *plr_diags_create(const plr_allocator *allocator) {
    plr_allocator resolved = plr_allocator_resolve(allocator);
    plr_diags *diags = resolved.reallocate(resolved.user, NULL, sizeof *diags);
    if (!diags)
        return NULL;
    memset(diags, 0, sizeof *diags);
    plr_arena_init(&diags->arena, &resolved, NULL);
    return diags;
}

void plr_diags_destroy(plr_diags **diags) {
    if (!*diags)
        return;
    plr_allocator allocator = (*diags)->arena.allocator;
    plr_arena_finish(&(*diags)->arena);
    allocator.release(allocator.user, *diags);
    *diags = NULL;
}

static bool same_text(const char *a, const char *b) {
    return a == b || (a && b && strcmp(a, b) == 0);
}

static bool is_repetition(const plr_diags *diags, const plr_diag *diag) {
    for (size_t i = 0; i < diags->list.count; i++) {
        const plr_diag *other = &diags->list.items[i];
        if (other->code == diag->code && other->severity == diag->severity &&
            other->place.line == diag->place.line && other->place.column == diag->place.column &&
            same_text(other->place.file, diag->place.file) &&
            same_text(other->message, diag->message))
            return true;
    }
    return false;
}

static char *format_message(plr_arena *arena, const char *format, va_list arguments)
    PLR_PRINTF(2, 0);
static void add(plr_diags *diags, plr_diag diag, const char *format, va_list arguments)
    PLR_PRINTF(3, 0);

static char *format_message(plr_arena *arena, const char *format, va_list arguments) {
    va_list again;
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    size_t size = length < 0 ? 1 : (size_t)length + 1;
    char *text = plr_arena_alloc(arena, size);
    vsnprintf(text, size, format, again);
    va_end(again);
    return text;
}

static void add(plr_diags *diags, plr_diag diag, const char *format, va_list arguments) {
    if (diag.severity != PLR_NOTE)
        diags->dropping = false;
    if (diags->dropping)
        return;
    jmp_buf out_of_memory;
    diags->arena.out_of_memory = &out_of_memory;
    if (setjmp(out_of_memory) == 0) {
        diag.message = format_message(&diags->arena, format, arguments);
        if (diag.severity != PLR_NOTE && is_repetition(diags, &diag)) {
            diags->dropping = true;
            return;
        }
        if (diag.place.file)
            diag.place.file =
                plr_arena_copy(&diags->arena, diag.place.file, strlen(diag.place.file));
        *PLR_PUSH(&diags->arena, &diags->list) = diag;
    }
    diags->counts[diag.severity]++;
}

void plr_diags_add(plr_diags *diags, plr_code code, plr_place place, const char *format, ...) {
    if (!diags)
        return;
    va_list arguments;
    va_start(arguments, format);
    add(diags, (plr_diag){plr_code_severity(code), code, place, NULL}, format, arguments);
    va_end(arguments);
}

void plr_diags_add_as(plr_diags *diags, plr_severity severity, plr_code code, plr_place place,
                      const char *format, ...) {
    if (!diags)
        return;
    va_list arguments;
    va_start(arguments, format);
    add(diags, (plr_diag){severity, code, place, NULL}, format, arguments);
    va_end(arguments);
}

void plr_diags_note(plr_diags *diags, plr_place place, const char *format, ...) {
    if (!diags)
        return;
    plr_code code =
        diags->list.count ? diags->list.items[diags->list.count - 1].code : PLR_CODE_LACKS;
    va_list arguments;
    va_start(arguments, format);
    add(diags, (plr_diag){PLR_NOTE, code, place, NULL}, format, arguments);
    va_end(arguments);
}

size_t plr_diags_count(const plr_diags *diags) {
    return diags ? diags->list.count : 0;
}

const plr_diag *plr_diags_get(const plr_diags *diags, size_t index) {
    return index < plr_diags_count(diags) ? &diags->list.items[index] : NULL;
}

size_t plr_diags_count_of(const plr_diags *diags, plr_severity severity) {
    return diags ? diags->counts[severity] : 0;
}
