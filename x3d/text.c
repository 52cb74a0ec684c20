#include "x3d/text.h"

#include <string.h>

void x3d_file_index(plr_arena *arena, x3d_file *file) {
    size_t count = 1;
    const char *end = file->text + file->length;
    for (const char *p = file->text; p < end && (p = memchr(p, '\n', (size_t)(end - p))); p++)
        count++;
    size_t *lines = PLR_NEW_ARRAY(arena, count, size_t), n = 1;
    for (const char *p = file->text; p < end && (p = memchr(p, '\n', (size_t)(end - p))); p++)
        lines[n++] = (size_t)(p + 1 - file->text);
    file->lines = lines;
    file->line_count = count;
}

/* The line of an offset. Most look-ups are near the one before. */
static size_t line_of(x3d_file *file, size_t offset) {
    size_t low = 0, high = file->line_count;
    size_t hint = file->line_hint;
    if (hint < high && file->lines[hint] <= offset) {
        low = hint;
        for (size_t i = 1; i <= 4 && hint + i < file->line_count; i++)
            if (file->lines[hint + i] > offset) {
                high = hint + i;
                break;
            }
    }
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (file->lines[middle] <= offset)
            low = middle;
        else
            high = middle;
    }
    return file->line_hint = low;
}

plr_place x3d_file_place(x3d_file *file, size_t offset) {
    if (!file->line_count)
        return (plr_place){file->name, 1, 1};
    size_t line = line_of(file, offset);
    size_t column = offset - file->lines[line];
    const uint32_t most = UINT32_MAX - 1;
    return (plr_place){file->name, line < most ? (uint32_t)line + 1 : most,
                       column < most ? (uint32_t)column + 1 : most};
}

/* The last span that begins at or before an offset. */
static size_t span_of(const x3d_view *view, size_t offset) {
    size_t low = 0, high = view->span_count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (view->spans[middle].at <= offset)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static size_t raw_of(const x3d_view *view, size_t offset) {
    if (!view->span_count)
        return view->base + offset;
    const x3d_span *span = &view->spans[span_of(view, offset)];
    return span->raw + (offset - span->at);
}

plr_place x3d_view_place(const x3d_view *view, size_t offset) {
    return view->fixed ? *view->fixed : x3d_file_place(view->file, raw_of(view, offset));
}

typedef struct break_list {
    plr_break *items;
    size_t count, capacity;
} break_list;

static void add_break(plr_arena *arena, break_list *breaks, const x3d_view *view, size_t offset,
                      size_t out) {
    plr_place place = x3d_view_place(view, offset);
    if (breaks->count && breaks->items[breaks->count - 1].offset == out)
        breaks->count--;
    *PLR_PUSH(arena, breaks) = (plr_break){out, place.line, place.column};
}

/* Whether the file, too, begins a new line after the newline before `offset`: then the rule of
 * plr_origin leads to the right place without a break. */
static bool after_true_newline(const x3d_view *view, size_t offset) {
    return offset && view->text[offset - 1] == '\n' && !view->fixed &&
           x3d_view_place(view, offset).column == 1 &&
           x3d_view_place(view, offset - 1).line + 1 == x3d_view_place(view, offset).line;
}

static void copy_with_breaks(plr_arena *arena, const x3d_view *view, size_t start, size_t end,
                             unsigned flags, char *copy, plr_string *string) {
    break_list breaks = {0};
    size_t next = view->span_count ? span_of(view, start) + 1 : 0, out = 0;
    for (size_t i = start; i < end; i++, out++) {
        bool jumps = false;
        while (next < view->span_count && view->spans[next].at <= i) {
            jumps = !after_true_newline(view, i);
            next++;
        }
        if ((flags & X3D_ESCAPES) && view->text[i] == '\\' && i + 1 < end &&
            (view->text[i + 1] == '"' || view->text[i + 1] == '\\')) {
            i++;
            jumps = true;
        }
        if (jumps && i > start && !view->fixed)
            add_break(arena, &breaks, view, i, out);
        copy[out] = view->text[i];
        if (copy[out] == '\n' && (flags & X3D_BLANK_NEWLINES)) {
            copy[out] = ' ';
            if (i + 1 < end && !view->fixed)
                add_break(arena, &breaks, view, i + 1, out + 1);
        }
    }
    copy[out] = '\0';
    string->length = out;
    string->origin.breaks = breaks.items;
    string->origin.break_count = breaks.count;
}

plr_string x3d_view_string(plr_arena *arena, const x3d_view *view, size_t start, size_t end,
                           unsigned flags) {
    size_t length = end - start;
    char *copy = plr_arena_copy(arena, view->text + start, length);
    plr_place place = x3d_view_place(view, start);
    plr_string string = {copy, length, {place.file, place.line, place.column, NULL, 0}};
    if (view->span_count > 1 || (flags & X3D_BLANK_NEWLINES) ||
        ((flags & X3D_ESCAPES) && length && memchr(copy, '\\', length)))
        copy_with_breaks(arena, view, start, end, flags, copy, &string);
    return string;
}

plr_string x3d_string_tail(plr_arena *arena, const plr_string *string, size_t offset) {
    plr_place place = plr_origin_place(&string->origin, string->text, offset);
    plr_string tail = {string->text + offset,
                       string->length - offset,
                       {string->origin.file, place.line, place.column, NULL, 0}};
    size_t first = 0;
    while (first < string->origin.break_count && string->origin.breaks[first].offset <= offset)
        first++;
    tail.origin.break_count = string->origin.break_count - first;
    plr_break *breaks = PLR_NEW_ARRAY(arena, tail.origin.break_count, plr_break);
    for (size_t i = 0; i < tail.origin.break_count; i++) {
        breaks[i] = string->origin.breaks[first + i];
        breaks[i].offset -= offset;
    }
    tail.origin.breaks = breaks;
    return tail;
}
