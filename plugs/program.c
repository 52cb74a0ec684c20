/* Questions about a linked program: texts, the map, names, plugs. */
#include "plugs/program.h"

#include <string.h>

const char *plr_program_text(const plr_program *program, plr_stage stage, size_t *length) {
    const plr_composed *text = &program->stages[stage];
    if (length)
        *length = text->length;
    return text->text;
}

bool plr_program_is_faulty(const plr_program *program, size_t effect) {
    return effect < program->linking.effect_count && program->linking.faulty[effect];
}

bool plr_program_is_active(const plr_program *program, size_t effect) {
    return effect < program->linking.effect_count && program->linking.active[effect];
}

uint32_t plr_program_lines(const plr_program *program, plr_stage stage) {
    return program->stages[stage].line_count;
}

size_t plr_program_symbol_count(const plr_program *program) {
    return program->symbols.count;
}

const plr_symbol *plr_program_symbol(const plr_program *program, size_t index) {
    return index < program->symbols.count ? &program->symbols.items[index] : NULL;
}

size_t plr_program_plug_count(const plr_program *program) {
    return program->plugs.count;
}

const plr_plug_info *plr_program_plug(const plr_program *program, size_t index) {
    return index < program->plugs.count ? &program->plugs.items[index] : NULL;
}

static plr_place function_place(const plr_function *function) {
    return plr_token_place(function->node->unit, function->name->open);
}

size_t plr_program_plug_call(const plr_program *program, size_t plug, size_t call,
                             plr_place *function) {
    if (plug >= program->linking.sockets.count)
        return PLR_NO_EFFECT;
    const plr_socket *socket = program->linking.sockets.items[plug];
    if (call >= socket->calls.count)
        return PLR_NO_EFFECT;
    const plr_function *called = socket->calls.items[call].function;
    if (function)
        *function = plr_token_place(called->node->unit, called->name->token);
    return called->effect;
}

/* ---- The map -----------------------------------------------------------------------------------
 */

/* The text of a line, less its newline. */
static const char *line_text(const plr_composed *stage, uint32_t line, size_t *length) {
    size_t begin = stage->lines[line - 1];
    size_t end = line < stage->line_count ? stage->lines[line] : stage->length;
    while (end > begin && stage->text[end - 1] == '\n')
        end--;
    *length = end - begin;
    return stage->text + begin;
}

static const plr_run *run_at(const plr_composed *stage, size_t offset) {
    size_t low = 0, high = stage->run_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (stage->runs[middle].out <= offset)
            low = middle + 1;
        else
            high = middle;
    }
    return low ? &stage->runs[low - 1] : NULL;
}

const plr_written_call *plr_call_at(const plr_composed *stage, size_t offset) {
    const plr_run *run = run_at(stage, offset);
    bool call = run && run->origin != PLR_RUN_OWN && run->origin & PLR_RUN_CALL;
    return call ? &stage->calls[run->origin & ~PLR_RUN_CALL] : NULL;
}

static void map_call(const plr_written_call *call, plr_mapped *mapped) {
    const plr_function *function = call->function;
    const plr_unit *unit = function->node->unit;
    mapped->socket_call = true;
    mapped->effect = function->effect;
    mapped->source = unit->reading->source;
    mapped->offset = unit->lexed->tokens.items[function->name->open].offset;
    mapped->place = function_place(function);
    mapped->plug_place = plr_unit_place(call->socket->unit, call->socket->plug->offset);
}

static void map_unit(const plr_program *program, const plr_run *run, size_t distance,
                     plr_mapped *mapped) {
    const plr_unit *unit = program->units[run->origin];
    size_t offset = (run->offset & ~PLR_RUN_FIXED) + distance;
    uint32_t owner = unit->scope->owner;
    mapped->effect = owner < program->linking.effect_count ? owner : PLR_NO_EFFECT;
    mapped->source = unit->reading->source;
    mapped->offset = offset <= unit->lexed->length ? offset : unit->lexed->length;
    mapped->place = plr_unit_place(unit, mapped->offset);
}

bool plr_program_map(const plr_program *program, plr_stage stage, uint32_t line, uint32_t column,
                     plr_mapped *mapped) {
    *mapped = (plr_mapped){.effect = PLR_NO_EFFECT};
    if ((unsigned)stage >= PLR_STAGE_COUNT)
        return false;
    const plr_composed *text = &program->stages[stage];
    if (line == 0 || line > text->line_count)
        return false;
    size_t length, at = column ? column - 1 : 0;
    const char *begin = line_text(text, line, &length);
    while (column == 0 && at < length && (begin[at] == ' ' || begin[at] == '\t'))
        at++;
    if (at >= length)
        at = length ? length - 1 : 0;
    size_t offset = text->lines[line - 1] + at;
    const plr_run *run = run_at(text, offset);
    if (!run || run->origin == PLR_RUN_OWN)
        return true;
    if (run->origin & PLR_RUN_CALL) {
        map_call(&text->calls[run->origin & ~PLR_RUN_CALL], mapped);
        return true;
    }
    size_t distance = run->offset & PLR_RUN_FIXED ? 0 : offset - run->out;
    map_unit(program, run, distance, mapped);
    return true;
}

/* ---- Names -------------------------------------------------------------------------------------
 */

static bool is_word_byte(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

typedef struct spelling {
    const char *text;
    size_t length;
} spelling;

static spelling gid_spelling(const plr_linking *l, uint32_t gid) {
    return (spelling){l->idents.items[gid].text, l->idents.items[gid].length};
}

static bool same_text(const char *text, size_t length, const char *word, size_t word_length) {
    return text && length == word_length && memcmp(text, word, length) == 0;
}

/* A name plr3_... of an effect's scope as the author wrote it; NULL: it is none. */
static spelling effect_spelling(const plr_linking *l, const plr_scope *scope, const char *word,
                                size_t length, const char *rest, size_t rest_length) {
    for (uint32_t u = 0; u < scope->unit_count; u++)
        for (const plr_function *f = scope->units[u].functions; f; f = f->next)
            if (same_text(f->text, f->length, word, length))
                return gid_spelling(l, f->gid);
    for (int cut = 0; cut < 2; cut++) { /* with and without a number at the end */
        uint32_t gid = plr_gid_find(l, rest, rest_length);
        const plr_binding *binding = gid == PLR_NONE ? NULL : plr_binding_find(l, scope, gid);
        if (binding)
            return gid_spelling(l, gid);
        size_t end = rest_length;
        while (end > 0 && rest[end - 1] >= '0' && rest[end - 1] <= '9')
            end--;
        if (end == rest_length || end < 2 || rest[end - 1] != '_')
            break;
        rest_length = end - 1;
    }
    return (spelling){NULL, 0};
}

static spelling word_spelling(const char *word, size_t length) {
    bool own = length > 4 && memcmp(word, "plr_", 4) == 0;
    bool library = length > 8 && memcmp(word, "plugray_", 8) == 0;
    for (uint16_t w = 1; w < PLR_WORD_COUNT && (own || library); w++) {
        const plr_word *entry = plr_word_get(w);
        if (entry->kinds & (PLR_WORD_IS_VARIABLE | PLR_WORD_IS_OUTPUT) &&
            strlen(entry->replacement) == length && memcmp(entry->replacement, word, length) == 0)
            return (spelling){entry->text, entry->length};
        if (own && length > 8 && memcmp(word, "plr_lib_", 8) == 0)
            return (spelling){word + 8, length - 8};
        if (own && length > 9 && memcmp(word, "plr_base_", 9) == 0)
            return (spelling){word + 9, length - 9};
        if (own && entry->kinds & PLR_WORD_IS_SINCE &&
            same_text(entry->text, entry->length, word + 4, length - 4))
            return (spelling){entry->text, entry->length};
    }
    return (spelling){word, length};
}

/* A word of the program as the author spelt it. `buffer` serves names that begin with _. */
static spelling author_spelling(const plr_linking *l, const char *word, size_t length,
                                char buffer[256]) {
    const size_t passed = sizeof PLR_PASSED - 1;
    if (length > passed && memcmp(word, PLR_PASSED, passed) == 0) {
        word += passed;
        length -= passed;
    }
    spelling same = {word, length};
    if (length < 6 || memcmp(word, "pl", 2) != 0)
        return same;
    size_t at = 3, effect = 0;
    while (at < length && word[at] >= '0' && word[at] <= '9' && effect < 100000000)
        effect = effect * 10 + (size_t)(word[at++] - '0');
    if (word[2] != 'r' || at == 3)
        return word_spelling(word, length);
    bool under = at < length && word[at] == 'u';
    at += under;
    if (at >= length || word[at] != '_' || effect >= l->effect_count)
        return same;
    const char *rest = word + at + 1;
    size_t rest_length = length - at - 1;
    if (under && rest_length < 255) {
        buffer[0] = '_';
        memcpy(buffer + 1, rest, rest_length++);
        rest = buffer;
    }
    for (unsigned s = 0; s < PLR_STAGE_COUNT; s++) {
        spelling found = effect_spelling(l, &l->scopes[s][effect], word, length, rest, rest_length);
        if (found.text)
            return found;
    }
    return same;
}

static void put(char *buffer, size_t size, size_t *at, const char *text, size_t length) {
    for (size_t i = 0; i < length; i++, ++*at)
        if (*at + 1 < size)
            buffer[*at] = text[i];
}

size_t plr_program_demangle(const plr_program *program, const char *message, char *buffer,
                            size_t size) {
    size_t at = 0;
    while (*message) {
        size_t length = 0;
        while (is_word_byte(message[length]))
            length++;
        if (length) {
            char scratch[256];
            spelling s = author_spelling(&program->linking, message, length, scratch);
            put(buffer, size, &at, s.text, s.length);
            message += length;
        } else {
            put(buffer, size, &at, message++, 1);
        }
    }
    if (size)
        buffer[at < size ? at : size - 1] = '\0';
    return at;
}

uint32_t plr_program_find_word(const plr_program *program, plr_stage stage, uint32_t line,
                               const char *word, size_t length) {
    const plr_composed *text = &program->stages[stage];
    if (line == 0 || line > text->line_count || length == 0)
        return 0;
    size_t line_length;
    const char *begin = line_text(text, line, &line_length);
    for (size_t at = 0; at < line_length;) {
        size_t end = at;
        while (end < line_length && is_word_byte(begin[end]))
            end++;
        if (end == at) {
            end = at + length <= line_length && !is_word_byte(*word) &&
                          memcmp(begin + at, word, length) == 0
                      ? at
                      : at + 1;
            if (end == at)
                return (uint32_t)at + 1;
            at = end;
            continue;
        }
        char scratch[256];
        spelling s = author_spelling(&program->linking, begin + at, end - at, scratch);
        if (same_text(begin + at, end - at, word, length) ||
            same_text(s.text, s.length, word, length))
            return (uint32_t)at + 1;
        at = end;
    }
    return 0;
}
