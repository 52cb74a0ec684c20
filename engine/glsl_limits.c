/* What compilers of GLSL are spared: they recurse over expressions without a limit of their own,
 * and end the process where the stack ends. */
#include <ctype.h>
#include <string.h>

#include "engine/glsl_log.h"

/* An eighth of what glslang and Mesa were seen to survive on a stack of 8 MiB. */
enum {
    OPERATOR_LIMIT = 4096,
    COMMA_LIMIT = 16384,
    DEPTH_LIMIT = 512
};

/* Where the reading stands in nested brackets. A level holds what was counted in its expression so
 * far; `total` is the sum of all open levels, which is how deep a tree of it can be. */
typedef struct counts {
    struct {
        unsigned operators, commas;
    } levels[DEPTH_LIMIT + 1], total;
    size_t depth;
} counts;

static void forget_operators(counts *c) {
    c->total.operators -= c->levels[c->depth].operators;
    c->levels[c->depth].operators = 0;
}

static void forget(counts *c) {
    forget_operators(c);
    c->total.commas -= c->levels[c->depth].commas;
    c->levels[c->depth].commas = 0;
}

/* NULL, or which limit is reached by opening a level. */
static const char *push(counts *c) {
    if (c->depth == DEPTH_LIMIT)
        return "more than 512 parentheses or braces in one another";
    c->depth++;
    c->levels[c->depth].operators = c->levels[c->depth].commas = 0;
    return NULL;
}

static void pop(counts *c) {
    forget(c);
    c->depth -= c->depth > 0;
}

/* Whether a character starts an operator; the point of a number does not. */
static bool is_operator(const char *at) {
    return *at == '.' ? !(at[1] >= '0' && at[1] <= '9') : strchr("+-*/%<>=&|^!~?:[", *at) != NULL;
}

/* Counts one character. NULL, or which limit it reaches. */
static const char *count(counts *c, const char *at) {
    if (*at == ' ' || *at == '_' || isalnum((unsigned char)*at)) /* most of a text */
        return NULL;
    if (is_operator(at)) {
        c->levels[c->depth].operators++;
        c->total.operators++;
    }
    if (c->total.operators > OPERATOR_LIMIT)
        return "an expression of more than 4096 operators";
    if (strchr(";{}", *at)) /* a statement ends */
        forget(c);
    if (strchr("([{", *at))
        return push(c);
    if (strchr(")]}", *at))
        pop(c);
    if (*at == ',') {
        forget_operators(c);
        c->levels[c->depth].commas++;
        c->total.commas++;
    }
    return c->total.commas > COMMA_LIMIT ? "a list of more than 16384 members" : NULL;
}

/* The end of the comment that starts here, or NULL if none starts here. */
static const char *skip_comment(const char *at) {
    if (at[0] == '/' && at[1] == '/')
        return at + strcspn(at, "\n");
    if (at[0] != '/' || at[1] != '*')
        return NULL;
    const char *end = strstr(at + 2, "*/");
    return end ? end + 2 : at + strlen(at);
}

/* A text that is being read. Lines of directives are counted apart: `inside` is theirs. */
typedef struct reading {
    counts outside, inside;
    bool directive, line_start;
} reading;

static const char *read_character(reading *r, const char *text, const char *at) {
    if (*at == '\n') {
        r->directive = r->directive && at > text && at[-1] == '\\';
        r->line_start = true;
    } else if (*at == '#' && r->line_start) {
        r->directive = true;
        r->line_start = false;
        r->inside = (counts){0};
    } else {
        r->line_start = r->line_start && (*at == ' ' || *at == '\t' || *at == '\r');
        return count(r->directive ? &r->inside : &r->outside, at);
    }
    return NULL;
}

bool plr_glsl_check_limits(const char *text, plr_glsl_messages *messages) {
    reading r = {.line_start = true};
    plr_glsl_message message = {.severity = PLR_ERROR, .line = 1};
    for (const char *at = text, *end; *at; at = end) {
        const char *fault = NULL;
        end = skip_comment(at);
        if (!end) {
            end = at + 1;
            fault = read_character(&r, text, at);
        }
        if (fault) {
            plr_glsl_messages_add(messages, &message, fault, strlen(fault), NULL, 0);
            return false;
        }
        for (; at < end; at++)
            message.line += *at == '\n';
    }
    return true;
}
