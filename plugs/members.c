/* Who reads and who writes a member of a struct: `.name` in the text of a program. */
#include <string.h>

#include "plugs/program.h"

static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

static size_t skip_comment(const char *text, size_t at, size_t end) {
    bool line = text[at + 1] == '/';
    for (at += 2; at < end; at++) {
        if (line && text[at] == '\n')
            return at;
        if (!line && text[at] == '*' && at + 1 < end && text[at + 1] == '/')
            return at + 2;
    }
    return end;
}

/* To the next byte that is neither blank nor comment. */
static size_t skip_blanks(const char *text, size_t at, size_t end) {
    while (at < end) {
        if (text[at] == '/' && at + 1 < end && (text[at + 1] == '/' || text[at + 1] == '*'))
            at = skip_comment(text, at, end);
        else if (memchr(" \t\r\n\v\f", text[at], 6))
            at++;
        else
            break;
    }
    return at;
}

static size_t skip_word(const char *text, size_t at, size_t end) {
    while (at < end && (is_letter(text[at]) || is_digit(text[at])))
        at++;
    return at;
}

/* Behind a number: 1.5e-3, 0x1fu, .5, and its dots, which begin no member. */
static size_t skip_number(const char *text, size_t at, size_t end) {
    while (at < end && (is_letter(text[at]) || is_digit(text[at]) || text[at] == '.'))
        at++;
    return at;
}

/* Whether what stands behind a member gives it, or a part of it, another value. */
static bool is_written(const char *text, size_t at, size_t end) {
    at = skip_blanks(text, at, end);
    while (at < end && text[at] == '.') {
        at = skip_blanks(text, at + 1, end);
        at = skip_blanks(text, skip_word(text, at, end), end);
    }
    return at < end && text[at] == '=' && (at + 1 == end || text[at + 1] != '=');
}

/* The line that an offset stands in; offsets only grow from call to call. */
static uint32_t line_at(const plr_composed *stage, uint32_t line, size_t offset) {
    while (line < stage->line_count && stage->lines[line] <= offset)
        line++;
    return line;
}

/* The arguments of a socket call are written by who offers the plug, not by whose function it is.
 */
static void map_use(const plr_program *program, plr_stage stage, uint32_t line, size_t offset,
                    plr_mapped *at) {
    const plr_composed *composed = &program->stages[stage];
    const plr_written_call *call = plr_call_at(composed, offset);
    plr_program_map(program, stage, line, (uint32_t)(offset - composed->lines[line - 1]) + 1, at);
    if (!call)
        return;
    const plr_unit *unit = call->socket->unit;
    at->effect =
        call->socket->effect < program->linking.effect_count ? call->socket->effect : PLR_NO_EFFECT;
    at->source = unit->reading->source;
    at->offset = call->socket->plug->offset;
    at->place = at->plug_place;
}

size_t plr_program_member_uses(const plr_program *program, plr_stage stage, const char *name,
                               plr_member_use *uses, size_t capacity) {
    if ((unsigned)stage >= PLR_STAGE_COUNT || !program->stages[stage].text)
        return 0;
    const plr_composed *composed = &program->stages[stage];
    const char *text = composed->text;
    size_t length = strlen(name), end = composed->length, count = 0;
    uint32_t line = 1;
    for (size_t at = 0; (at = skip_blanks(text, at, end)) < end;) {
        if (is_letter(text[at])) {
            at = skip_word(text, at, end);
        } else if (is_digit(text[at]) ||
                   (text[at] == '.' && at + 1 < end && is_digit(text[at + 1]))) {
            at = skip_number(text, at, end);
        } else if (text[at] != '.') {
            at++;
        } else {
            size_t word = skip_blanks(text, at + 1, end);
            at = skip_word(text, word, end);
            if (at - word != length || memcmp(text + word, name, length) != 0)
                continue;
            line = line_at(composed, line, word);
            if (count < capacity) {
                uses[count].written = is_written(text, at, end);
                map_use(program, stage, line, word, &uses[count].at);
            }
            count++;
        }
    }
    return count;
}
