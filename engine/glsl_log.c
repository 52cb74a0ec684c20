/* Reading info logs: text only, of any driver. */
#include "engine/glsl.h"

#include <stdlib.h>
#include <string.h>

#include "engine/glsl_log.h"

/* A stretch of the log that is being read. */
typedef struct span {
    const char *at, *end;
} span;

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

static bool is_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || is_digit(c);
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

static bool skip_text(span *s, const char *text) {
    size_t length = strlen(text);
    if ((size_t)(s->end - s->at) < length || memcmp(s->at, text, length) != 0)
        return false;
    s->at += length;
    return true;
}

static void skip_blanks(span *s) {
    while (s->at < s->end && is_blank(*s->at))
        s->at++;
}

/* A number; too large ones become the largest. '?' (glslang, no line) is 0. */
static bool skip_number(span *s, uint32_t *number) {
    const char *first = s->at;
    uint64_t value = 0;
    if (skip_text(s, "?")) {
        *number = 0;
        return true;
    }
    for (; s->at < s->end && is_digit(*s->at); s->at++)
        if (value <= UINT32_MAX)
            value = value * 10 + (uint64_t)(*s->at - '0');
    *number = value > UINT32_MAX ? UINT32_MAX : (uint32_t)value;
    return s->at > first;
}

static const struct {
    const char *word;
    plr_severity severity;
} severities[] = {
    {"INTERNAL ERROR", PLR_ERROR},     {"ERROR", PLR_ERROR},
    {"WARNING", PLR_WARNING},          {"UNIMPLEMENTED", PLR_ERROR},
    {"preprocessor error", PLR_ERROR}, {"preprocessor warning", PLR_WARNING},
    {"linker error", PLR_ERROR},       {"linker warning", PLR_WARNING},
    {"fatal error", PLR_ERROR},        {"error", PLR_ERROR},
    {"warning", PLR_WARNING},          {"Internal error", PLR_ERROR},
};

/* A word of severity; false (and nothing read) if there is none. */
static bool skip_severity(span *s, plr_severity *severity) {
    for (size_t i = 0; i < sizeof severities / sizeof severities[0]; i++)
        if (skip_text(s, severities[i].word)) {
            *severity = severities[i].severity;
            return true;
        }
    return false;
}

/* glslang: "ERROR: 0:7: 'x' : undeclared identifier"; also without a place. */
static bool read_glslang(span *s, plr_glsl_message *m) {
    uint32_t string;
    if (!skip_severity(s, &m->severity) || !skip_text(s, ":"))
        return false;
    skip_blanks(s);
    span place = *s;
    if (skip_number(&place, &string) && skip_text(&place, ":") && skip_number(&place, &m->line) &&
        skip_text(&place, ":"))
        *s = place;
    else
        m->line = 0;
    return true;
}

/* Mesa: "0:7(12): error: `x' undeclared". */
static bool read_mesa(span *s, plr_glsl_message *m) {
    uint32_t string;
    return skip_number(s, &string) && skip_text(s, ":") && skip_number(s, &m->line) &&
           skip_text(s, "(") && skip_number(s, &m->column) && skip_text(s, "): ") &&
           skip_severity(s, &m->severity) && skip_text(s, ":");
}

/* NVIDIA: "0(7) : error C1008: undefined variable "x"". The number stays in the text. */
static bool read_nvidia(span *s, plr_glsl_message *m) {
    uint32_t string;
    if (!skip_number(s, &string) || !skip_text(s, "(") || !skip_number(s, &m->line) ||
        !skip_text(s, ")"))
        return false;
    skip_blanks(s);
    if (!skip_text(s, ":"))
        return false;
    skip_blanks(s);
    return skip_severity(s, &m->severity) && (skip_text(s, " ") || skip_text(s, ":"));
}

/* What a driver writes beside messages: headings, rules, counts. */
static bool is_filler(span s) {
    static const char *const headings[] = {"Vertex info",     "Geometry info", "Fragment info",
                                           "Link info",       "Vertex shader", "Geometry shader",
                                           "Fragment shader", "Compute info"};
    for (size_t i = 0; i < sizeof headings / sizeof headings[0]; i++) {
        span rest = s;
        if (skip_text(&rest, headings[i]) && rest.at == rest.end)
            return true;
    }
    span count = s;
    uint32_t number;
    if (skip_text(&count, "ERROR: ") && skip_number(&count, &number) &&
        skip_text(&count, " compilation errors."))
        return true;
    while (s.at < s.end && (is_blank(*s.at) || *s.at == '-'))
        s.at++;
    return s.at == s.end;
}

/* The quoted name that a message is about: 'x', `x', "x", `f(int)'. */
static span find_word(span text) {
    while (text.at < text.end) {
        char c = *text.at++;
        if (c != '\'' && c != '`' && c != '"')
            continue;
        span word = {text.at, text.at};
        while (word.end < text.end && is_name(*word.end))
            word.end++;
        bool named = word.end > word.at && !is_digit(*word.at);
        if (named && word.end < text.end && strchr("'\"([.", *word.end))
            return word;
        /* Not a name (a type's text, an operator): on behind its closing quote. */
        while (text.at < text.end && *text.at != '\'' && *text.at != '"')
            text.at++;
        text.at += text.at < text.end;
    }
    return (span){NULL, NULL};
}

/* Room for one message more, or NULL without memory. */
static plr_glsl_message *push(plr_glsl_messages *messages) {
    size_t n = messages->count;
    if (n == 0 || (n >= 8 && (n & (n - 1)) == 0)) { /* capacities are 8, 16, 32, ... */
        size_t capacity = n < 8 ? 8 : n * 2;
        plr_glsl_message *items = capacity <= SIZE_MAX / sizeof *items
                                      ? realloc(messages->items, capacity * sizeof *items)
                                      : NULL;
        if (!items)
            return NULL;
        messages->items = items;
    }
    return &messages->items[n];
}

bool plr_glsl_messages_add(plr_glsl_messages *messages, const plr_glsl_message *message,
                           const char *text, size_t length, const char *word, size_t word_length) {
    /* Text and word live in one block, so that the text's pointer frees both. */
    char *block = malloc(length + 1 + word_length + 1);
    plr_glsl_message *slot = block ? push(messages) : NULL;
    if (!slot) {
        free(block);
        return false;
    }
    for (size_t i = 0; i < length; i++) {
        unsigned char c = (unsigned char)text[i];
        block[i] = c < ' ' || c == 0x7f ? ' ' : text[i];
    }
    block[length] = 0;
    if (word_length)
        memcpy(block + length + 1, word, word_length);
    block[length + 1 + word_length] = 0;
    *slot = *message;
    slot->text = block;
    slot->word = word_length ? block + length + 1 : NULL;
    messages->count++;
    return true;
}

/* Appends a line that continues the message before it; long enough ones stay as they are. */
static void extend(plr_glsl_message *message, span more) {
    enum {
        ENOUGH = 2048
    };
    size_t length = strlen(message->text), added = (size_t)(more.end - more.at);
    size_t word = message->word ? strlen(message->word) : 0;
    char *block = length < ENOUGH ? malloc(length + 1 + added + 1 + word + 1) : NULL;
    if (!block)
        return;
    memcpy(block, message->text, length);
    block[length] = ' ';
    for (size_t i = 0; i < added; i++) {
        unsigned char c = (unsigned char)more.at[i];
        block[length + 1 + i] = c < ' ' || c == 0x7f ? ' ' : more.at[i];
    }
    block[length + 1 + added] = 0;
    if (word)
        memcpy(block + length + added + 2, message->word, word);
    block[length + added + 2 + word] = 0;
    free((void *)(uintptr_t)message->text);
    message->text = block;
    message->word = word ? block + length + added + 2 : NULL;
}

/* One line of the log. */
static void read_line(span line, plr_glsl_messages *messages) {
    static bool (*const forms[])(span * s, plr_glsl_message * message) = {read_mesa, read_nvidia,
                                                                          read_glslang};
    plr_glsl_message message, *last = NULL;
    span text;
    bool formed = false;
    if (messages->count)
        last = &messages->items[messages->count - 1];
    for (size_t i = 0; !formed && i < sizeof forms / sizeof forms[0]; i++) {
        message = (plr_glsl_message){.severity = PLR_ERROR};
        text = line;
        formed = forms[i](&text, &message);
    }
    if (!formed) {
        message = (plr_glsl_message){.severity = PLR_ERROR};
        text = line;
    }
    /* Continuations are indented: of Mesa's lists of candidates, and of glslang's linker. */
    bool indented = text.end - text.at >= 3 && is_blank(text.at[0]) && is_blank(text.at[1]) &&
                    is_blank(text.at[2]);
    bool same = !formed || (last && message.line == last->line && message.column == last->column);
    skip_blanks(&text);
    if (text.at == text.end)
        return;
    if (last && indented && same) {
        extend(last, text);
        return;
    }
    span word = find_word(text);
    plr_glsl_messages_add(messages, &message, text.at, (size_t)(text.end - text.at), word.at,
                          word.at ? (size_t)(word.end - word.at) : 0);
}

void plr_glsl_parse_log(const char *log, plr_glsl_messages *messages) {
    *messages = (plr_glsl_messages){0};
    while (log && *log) {
        size_t length = strcspn(log, "\n");
        span line = {log, log + length};
        while (line.end > line.at && (line.end[-1] == '\r' || is_blank(line.end[-1])))
            line.end--;
        if (!is_filler(line))
            read_line(line, messages);
        log += length + (log[length] == '\n');
    }
}

void plr_glsl_messages_free(plr_glsl_messages *messages) {
    for (size_t i = 0; i < messages->count; i++)
        free((void *)(uintptr_t)messages->items[i].text);
    free(messages->items);
    *messages = (plr_glsl_messages){0};
}

/* A message and its number, for a stable sort. */
typedef struct numbered {
    plr_glsl_message message;
    size_t number;
} numbered;

static int compare(const void *a, const void *b) {
    const numbered *x = a, *y = b;
    if (x->message.line != y->message.line)
        return x->message.line < y->message.line ? -1 : 1;
    return (x->number > y->number) - (x->number < y->number);
}

void plr_glsl_messages_sort(plr_glsl_messages *messages) {
    size_t n = messages->count, sorted = 1;
    while (sorted < n && messages->items[sorted - 1].line <= messages->items[sorted].line)
        sorted++;
    numbered *all = sorted < n ? calloc(n, sizeof *all) : NULL;
    if (!all)
        return;
    for (size_t i = 0; i < n; i++)
        all[i] = (numbered){messages->items[i], i};
    qsort(all, n, sizeof *all, compare);
    for (size_t i = 0; i < n; i++)
        messages->items[i] = all[i].message;
    free(all);
}
