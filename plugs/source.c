#include "plugs/source.h"

#include <string.h>

#include "plugs/mark.h"

#define MAX_TEXT ((size_t)64 << 20)

const char *plr_stage_text(plr_stage stage) {
    static const char *const names[] = {"vertex", "geometry", "fragment"};
    return (unsigned)stage < PLR_STAGE_COUNT ? names[stage] : "";
}

plr_stage plr_source_stage(const plr_source *source) {
    return source->stage;
}

const char *plr_source_text(const plr_source *source, size_t *length) {
    if (length)
        *length = source->length;
    return source->text;
}

size_t plr_source_plug_count(const plr_source *source) {
    return source->lexed.plugs.count;
}

const char *plr_source_plug(const plr_source *source, size_t index, size_t *length) {
    const plr_lexed *lexed = &source->lexed;
    const plr_ident *name = &lexed->idents.items[lexed->plugs.items[index].name];
    *length = name->length;
    return name->text;
}

const char *plr_source_plug_lists(const plr_source *source, size_t index, size_t *length) {
    const plr_plug *plug = &source->lexed.plugs.items[index];
    *length = plug->text_end - plug->text_begin;
    return source->text + plug->text_begin;
}

plr_place plr_source_plug_place(const plr_source *source, size_t index) {
    return plr_source_place(source, source->lexed.plugs.items[index].offset);
}

const char *plr_token_text(const plr_lexed *lexed, const plr_token *token, size_t *length) {
    if (token->flags & PLR_TF_SPLICED) {
        const plr_ident *ident = &lexed->idents.items[token->value];
        *length = ident->length;
        return ident->text;
    }
    *length = token->length;
    return lexed->text + token->offset;
}

size_t plr_source_line_start(const plr_source *source, size_t offset) {
    size_t low = 0, high = source->line_count;
    while (low < high) { /* the lines that begin up to the offset */
        size_t middle = low + (high - low) / 2;
        if (source->lines[middle] <= offset)
            low = middle + 1;
        else
            high = middle;
    }
    return low ? source->lines[low - 1] : 0;
}

plr_place plr_source_place(const plr_source *source, size_t offset) {
    const plr_origin *origin = &source->origin;
    size_t low = 0, high = origin->break_count;
    while (low < high) { /* the breaks up to the offset */
        size_t middle = low + (high - low) / 2;
        if (origin->breaks[middle].offset <= offset)
            low = middle + 1;
        else
            high = middle;
    }
    plr_place place = {origin->file, origin->line, origin->column};
    size_t start = 0;
    if (low) {
        start = origin->breaks[low - 1].offset;
        place.line = origin->breaks[low - 1].line;
        place.column = origin->breaks[low - 1].column;
    }
    /* the lines that begin in (start, offset] */
    size_t first = 0, last = source->line_count;
    for (size_t end = source->line_count; first < end;) {
        size_t middle = first + (end - first) / 2;
        if (source->lines[middle] <= start)
            first = middle + 1;
        else
            end = middle;
    }
    for (size_t begin = first; begin < last;) {
        size_t middle = begin + (last - begin) / 2;
        if (source->lines[middle] <= offset)
            begin = middle + 1;
        else
            last = middle;
    }
    if (last > first) {
        place.line += (uint32_t)(last - first);
        place.column = 1;
        start = source->lines[last - 1];
    }
    if (start == 0 && offset >= 3 && memcmp(source->text, "\xEF\xBB\xBF", 3) == 0)
        start = 3; /* a byte-order mark takes no room */
    place.column += (uint32_t)(offset - start);
    return place;
}

/* ---- Reading -----------------------------------------------------------------------------------
 */

/* Copies the arrays of a source, which were made in a scratch arena, into one block; without a
 * block it only counts the bytes. */
typedef struct packer {
    char *block;
    size_t size;
} packer;

static void *pack(packer *p, const void *data, size_t bytes) {
    void *copy = p->block ? p->block + p->size : NULL;
    if (copy && bytes)
        memcpy(copy, data, bytes);
    p->size += (bytes + 15) / 16 * 16;
    return copy;
}

#define PACK(p, list)                                                                              \
    do {                                                                                           \
        void *packed = pack((p), (list)->items, (list)->count * sizeof *(list)->items);            \
        if (packed) {                                                                              \
            (list)->items = packed;                                                                \
            (list)->capacity = (list)->count;                                                      \
        }                                                                                          \
    } while (0)

static void pack_source(packer *p, plr_source *source) {
    plr_lexed *lexed = &source->lexed;
    PACK(p, &lexed->tokens);
    PACK(p, &lexed->idents);
    PACK(p, &lexed->directives);
    PACK(p, &lexed->plugs);
    PACK(p, &lexed->lists);
    PACK(p, &lexed->promises);
    PACK(p, &lexed->faults);
    PACK(p, &lexed->warnings);
    plr_cut *cut = &source->cut;
    PACK(p, &cut->items);
    PACK(p, &cut->names);
    PACK(p, &cut->plugs);
    PACK(p, &cut->versions);
    PACK(p, &cut->extensions);
    PACK(p, &cut->faults);
    PACK(p, &cut->warnings);
    void *lines = pack(p, source->lines, source->line_count * sizeof *source->lines);
    if (lines)
        source->lines = lines;
}

static void find_lines(plr_arena *arena, plr_source *source) {
    PLR_LIST(uint32_t) lines = {NULL, 0, 0};
    const char *end = source->text + source->length;
    lines.items =
        plr_arena_grow(arena, NULL, &lines.capacity, source->length / 24 + 8, sizeof *lines.items);
    for (const char *at = source->text;
         at < end && (at = memchr(at, '\n', (size_t)(end - at))) != NULL;) {
        at++;
        *PLR_PUSH(arena, &lines) = (uint32_t)(at - source->text);
    }
    source->lines = lines.items;
    source->line_count = lines.count;
}

static bool read_text(plr_arena *arena, plr_source *source) {
    jmp_buf out_of_memory;
    arena->out_of_memory = &out_of_memory;
    if (setjmp(out_of_memory))
        return false;
    plr_lex(arena, source->text, source->length, source->text + source->length + 1, &source->lexed);
    plr_mark(arena, &source->lexed);
    find_lines(arena, source);
    if (!source->lexed.conditional)
        plr_cut_items(arena, &source->lexed, NULL, &source->cut);
    packer p = {NULL, 0};
    pack_source(&p, source);
    source->block = source->allocator.reallocate(source->allocator.user, NULL, p.size + 1);
    if (!source->block)
        return false;
    p = (packer){source->block, 0};
    pack_source(&p, source);
    return true;
}

/* Copies text, file name and breaks. */
static bool copy_origin(plr_source *source, const char *text, size_t length,
                        const plr_origin *origin) {
    const plr_allocator *a = &source->allocator;
    bool splices = length && memchr(text, '\\', length);
    size_t size = length + 1 + (splices ? length : 0);
    size_t name = origin && origin->file ? strlen(origin->file) + 1 : 0;
    size_t breaks = origin ? origin->break_count * sizeof *origin->breaks : 0;
    source->text = a->reallocate(a->user, NULL, size + name);
    if (!source->text)
        return false;
    if (length)
        memcpy(source->text, text, length);
    source->text[length] = '\0';
    source->length = length;
    source->origin = origin ? *origin : (plr_origin){NULL, 1, 1, NULL, 0};
    source->origin.breaks = NULL;
    source->origin.line = source->origin.line ? source->origin.line : 1;
    source->origin.column = source->origin.column ? source->origin.column : 1;
    if (name) {
        memcpy(source->text + size, origin->file, name);
        source->origin.file = source->text + size;
    }
    if (breaks) {
        plr_break *copy = a->reallocate(a->user, NULL, breaks);
        if (!copy)
            return false;
        source->origin.breaks = memcpy(copy, origin->breaks, breaks);
    }
    return true;
}

plr_source *plr_source_read(plr_stage stage, const char *text, size_t length,
                            const plr_origin *origin, const plr_allocator *allocator,
                            plr_diags *diags) {
    plr_place place = {origin ? origin->file : NULL, 0, 0};
    if (length > MAX_TEXT) {
        plr_diags_add(diags, PLR_CODE_LIMIT, place, "the shader text is larger than %u MiB",
                      (unsigned)(MAX_TEXT >> 20));
        return NULL;
    }
    plr_allocator resolved = plr_allocator_resolve(allocator);
    plr_source *source = resolved.reallocate(resolved.user, NULL, sizeof *source);
    bool good = false;
    if (source) {
        memset(source, 0, sizeof *source);
        source->allocator = resolved;
        source->stage = stage;
        plr_arena scratch;
        plr_arena_init(&scratch, &resolved, NULL);
        good = copy_origin(source, text, length, origin) && read_text(&scratch, source);
        plr_arena_finish(&scratch);
    }
    if (!good) {
        plr_source_destroy(&source);
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, place, "no memory to read a shader");
    }
    return source;
}

void plr_source_destroy(plr_source **source) {
    plr_source *s = *source;
    if (!s)
        return;
    s->allocator.release(s->allocator.user, s->text);
    s->allocator.release(s->allocator.user, (void *)(uintptr_t)s->origin.breaks);
    s->allocator.release(s->allocator.user, s->block);
    s->allocator.release(s->allocator.user, s);
    *source = NULL;
}
