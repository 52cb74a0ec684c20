#include "plugs/lexer.h"

#include <string.h>

typedef struct lexer {
    plr_arena *arena;
    plr_lexed *out;
    const char *text;
    uint32_t length, at;
    bool gap;        /* something to be cleaned stands before the next token */
    bool newline;    /* the next token is the first of its line */
    bool line_start; /* a directive may begin here */
    bool after_dot;
    bool in_define;
    unsigned depth;  /* of PLUG_PLUG_... */
    char *spare;     /* room for the text of spliced words */
    uint32_t *slots; /* identifier + 1 by hash */
    uint32_t slot_mask;
} lexer;

enum {
    C_OTHER,
    C_SPACE,
    C_NEWLINE,
    C_WORD,
    C_DIGIT,
    C_PUNCT
};

static const uint8_t classes[256] = {
    [' '] = C_SPACE,    ['\t'] = C_SPACE, ['\v'] = C_SPACE, ['\f'] = C_SPACE, ['\n'] = C_NEWLINE,
    ['\r'] = C_NEWLINE, ['!'] = C_PUNCT,  ['#'] = C_PUNCT,  ['%'] = C_PUNCT,  ['&'] = C_PUNCT,
    ['('] = C_PUNCT,    [')'] = C_PUNCT,  ['*'] = C_PUNCT,  ['+'] = C_PUNCT,  [','] = C_PUNCT,
    ['-'] = C_PUNCT,    ['.'] = C_PUNCT,  ['/'] = C_PUNCT,  [':'] = C_PUNCT,  [';'] = C_PUNCT,
    ['<'] = C_PUNCT,    ['='] = C_PUNCT,  ['>'] = C_PUNCT,  ['?'] = C_PUNCT,  ['['] = C_PUNCT,
    [']'] = C_PUNCT,    ['^'] = C_PUNCT,  ['{'] = C_PUNCT,  ['|'] = C_PUNCT,  ['}'] = C_PUNCT,
    ['~'] = C_PUNCT,    ['\\'] = C_PUNCT, ['"'] = C_PUNCT,  ['\''] = C_PUNCT, ['_'] = C_WORD,
    ['0'] = C_DIGIT,    ['1'] = C_DIGIT,  ['2'] = C_DIGIT,  ['3'] = C_DIGIT,  ['4'] = C_DIGIT,
    ['5'] = C_DIGIT,    ['6'] = C_DIGIT,  ['7'] = C_DIGIT,  ['8'] = C_DIGIT,  ['9'] = C_DIGIT,
    ['a'] = C_WORD,     ['b'] = C_WORD,   ['c'] = C_WORD,   ['d'] = C_WORD,   ['e'] = C_WORD,
    ['f'] = C_WORD,     ['g'] = C_WORD,   ['h'] = C_WORD,   ['i'] = C_WORD,   ['j'] = C_WORD,
    ['k'] = C_WORD,     ['l'] = C_WORD,   ['m'] = C_WORD,   ['n'] = C_WORD,   ['o'] = C_WORD,
    ['p'] = C_WORD,     ['q'] = C_WORD,   ['r'] = C_WORD,   ['s'] = C_WORD,   ['t'] = C_WORD,
    ['u'] = C_WORD,     ['v'] = C_WORD,   ['w'] = C_WORD,   ['x'] = C_WORD,   ['y'] = C_WORD,
    ['z'] = C_WORD,     ['A'] = C_WORD,   ['B'] = C_WORD,   ['C'] = C_WORD,   ['D'] = C_WORD,
    ['E'] = C_WORD,     ['F'] = C_WORD,   ['G'] = C_WORD,   ['H'] = C_WORD,   ['I'] = C_WORD,
    ['J'] = C_WORD,     ['K'] = C_WORD,   ['L'] = C_WORD,   ['M'] = C_WORD,   ['N'] = C_WORD,
    ['O'] = C_WORD,     ['P'] = C_WORD,   ['Q'] = C_WORD,   ['R'] = C_WORD,   ['S'] = C_WORD,
    ['T'] = C_WORD,     ['U'] = C_WORD,   ['V'] = C_WORD,   ['W'] = C_WORD,   ['X'] = C_WORD,
    ['Y'] = C_WORD,     ['Z'] = C_WORD};

static unsigned class_at(const lexer *lx, uint32_t at) {
    return classes[(uint8_t)lx->text[at]];
}

uint32_t plr_hash(const char *text, size_t length) {
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < length; i++)
        hash = (hash ^ (uint8_t)text[i]) * 16777619u;
    return hash;
}

/* The bytes of a line continuation at `at`; 0: there is none. */
static uint32_t splice_length(const lexer *lx, uint32_t at) {
    if (at >= lx->length || lx->text[at] != '\\')
        return 0;
    if (lx->text[at + 1] == '\n')
        return 2;
    if (lx->text[at + 1] == '\r')
        return lx->text[at + 2] == '\n' ? 3 : 2;
    return 0;
}

/* The offset after `at` and the splices that stand there. */
static uint32_t after_splices(const lexer *lx, uint32_t at) {
    for (uint32_t length; (length = splice_length(lx, at)) > 0;)
        at += length;
    return at;
}

static void add_fault(lexer *lx, plr_code code, uint32_t offset, const char *message) {
    *PLR_PUSH(lx->arena, &lx->out->faults) = (plr_fault){code, offset, message};
}

static void add_warning(lexer *lx, plr_code code, uint32_t offset, const char *message) {
    *PLR_PUSH(lx->arena, &lx->out->warnings) = (plr_fault){code, offset, message};
}

static bool begins(const char *text, uint32_t length, const char *prefix, uint32_t prefix_length) {
    return length > prefix_length && memcmp(text, prefix, prefix_length) == 0;
}

/* plr[0-9]+u?_... */
static bool is_reserved(const char *text, uint32_t length) {
    uint32_t i = 3;
    while (i < length && text[i] >= '0' && text[i] <= '9')
        i++;
    if (i == 3)
        return false;
    if (i < length && text[i] == 'u')
        i++;
    return i < length && text[i] == '_';
}

static uint8_t ident_flags(const char *text, uint32_t length) {
    if (length < 4)
        return 0;
    switch (text[0]) {
    case 'P':
        return begins(text, length, "PLUG_", 5) ? PLR_IF_PLUG : 0;
    case 'c':
        return begins(text, length, "castle_", 7) ? PLR_IF_CASTLE : 0;
    case 'g':
        return begins(text, length, "gl_", 3) ? PLR_IF_GL : 0;
    case 'p':
        if (begins(text, length, "plugray_", 8))
            return PLR_IF_PLUGRAY;
        return begins(text, length, "plr", 3) && is_reserved(text, length) ? PLR_IF_RESERVED : 0;
    default:
        return 0;
    }
}

static void grow_slots(lexer *lx) {
    uint32_t mask = lx->slot_mask * 2 + 1;
    uint32_t *slots = PLR_NEW_ARRAY(lx->arena, (size_t)mask + 1, uint32_t);
    for (uint32_t i = 0; i < lx->out->idents.count; i++) {
        uint32_t slot = lx->out->idents.items[i].hash & mask;
        while (slots[slot])
            slot = (slot + 1) & mask;
        slots[slot] = i + 1;
    }
    lx->slots = slots;
    lx->slot_mask = mask;
}

static uint32_t intern(lexer *lx, const char *text, uint32_t length, uint32_t hash) {
    uint32_t slot = hash & lx->slot_mask;
    for (; lx->slots[slot]; slot = (slot + 1) & lx->slot_mask) {
        const plr_ident *ident = &lx->out->idents.items[lx->slots[slot] - 1];
        if (ident->hash == hash && ident->length == length &&
            memcmp(ident->text, text, length) == 0)
            return lx->slots[slot] - 1;
    }
    uint32_t index = (uint32_t)lx->out->idents.count;
    *PLR_PUSH(lx->arena, &lx->out->idents) = (plr_ident){
        text, length, hash, plr_word_find(text, length, hash), ident_flags(text, length)};
    lx->out->reserved |= (lx->out->idents.items[index].flags & PLR_IF_RESERVED) != 0;
    lx->slots[slot] = index + 1;
    if (lx->out->idents.count * 2 > lx->slot_mask)
        grow_slots(lx);
    if (lx->out->idents.items[index].flags & PLR_IF_PLUG && lx->depth < 8) {
        lx->depth++; /* the plug's name is numbered as well */
        intern(lx, text + 5, length - 5, plr_hash(text + 5, length - 5));
        lx->depth--;
    }
    return index;
}

static plr_token *push_token(lexer *lx, uint8_t kind, uint32_t begin, uint32_t value) {
    plr_token *token = PLR_PUSH(lx->arena, &lx->out->tokens);
    *token = (plr_token){.offset = begin, .length = lx->at - begin, .value = value, .kind = kind};
    token->flags = (uint8_t)((lx->gap ? PLR_TF_GAP : 0) | (lx->newline ? PLR_TF_NEWLINE : 0));
    lx->gap = lx->newline = lx->line_start = false;
    return token;
}

/* A word or number that splices interrupt, from `begin` on: its text without them. */
static uint32_t lex_spliced(lexer *lx, uint32_t begin, uint32_t limit) {
    uint32_t end = begin, length = 0;
    while (end < limit) {
        end = after_splices(lx, end);
        unsigned class = class_at(lx, end);
        if (end >= limit || (class != C_WORD && class != C_DIGIT && lx->text[end] != '.'))
            break;
        end++;
    }
    char *text = lx->spare;
    uint32_t last = begin;
    bool number = class_at(lx, begin) != C_WORD;
    for (uint32_t i = begin; i < end;) {
        i = after_splices(lx, i);
        if (i >= end || (lx->text[i] == '.' && !number))
            break;
        text[length++] = lx->text[i++];
        last = i;
    }
    lx->at = last;
    lx->spare += length;
    return intern(lx, text, length, plr_hash(text, length));
}

static void finish_word(lexer *lx, uint8_t kind, uint32_t begin, uint32_t value, bool spliced) {
    plr_token *token = push_token(lx, kind, begin, value);
    if (spliced)
        token->flags |= PLR_TF_SPLICED;
    if (lx->after_dot) {
        token->flags |= PLR_TF_MEMBER;
        if (kind == PLR_T_IDENT)
            lx->out->idents.items[value].flags |= PLR_IF_MEMBER;
    }
    lx->after_dot = false;
}

static void lex_word(lexer *lx, uint32_t limit) {
    uint32_t begin = lx->at, hash = 2166136261u, at = begin;
    while (at < limit && (class_at(lx, at) == C_WORD || class_at(lx, at) == C_DIGIT))
        hash = (hash ^ (uint8_t)lx->text[at++]) * 16777619u;
    if (at < limit && splice_length(lx, at)) {
        uint32_t ident = lex_spliced(lx, begin, limit);
        finish_word(lx, PLR_T_IDENT, begin, ident,
                    lx->at - begin != lx->out->idents.items[ident].length);
        return;
    }
    lx->at = at;
    finish_word(lx, PLR_T_IDENT, begin, intern(lx, lx->text + begin, at - begin, hash), false);
}

static void lex_number(lexer *lx, uint32_t limit) {
    uint32_t begin = lx->at, at = begin;
    for (; at < limit; at++) {
        char c = lx->text[at];
        bool sign = (c == '+' || c == '-') && at > begin &&
                    (lx->text[at - 1] == 'e' || lx->text[at - 1] == 'E') &&
                    !(lx->text[begin] == '0' && (lx->text[begin + 1] | 32) == 'x');
        if (class_at(lx, at) != C_WORD && class_at(lx, at) != C_DIGIT && c != '.' && !sign)
            break;
    }
    if (at < limit && splice_length(lx, at)) {
        uint32_t ident = lex_spliced(lx, begin, limit);
        finish_word(lx, PLR_T_NUMBER, begin, ident, true);
        return;
    }
    lx->at = at;
    finish_word(lx, PLR_T_NUMBER, begin, 0, false);
}

/* One token that is no white space, comment or directive. */
static void lex_atom(lexer *lx, uint32_t limit) {
    uint32_t begin = lx->at;
    switch (class_at(lx, begin)) {
    case C_WORD:
        lex_word(lx, limit);
        return;
    case C_DIGIT:
        lex_number(lx, limit);
        return;
    case C_PUNCT:
        if (lx->text[begin] == '.' && begin + 1 < limit && class_at(lx, begin + 1) == C_DIGIT) {
            lex_number(lx, limit);
            return;
        }
        lx->at++;
        push_token(lx, (uint8_t)lx->text[begin], begin, PLR_NONE);
        lx->after_dot = lx->text[begin] == '.';
        return;
    default:
        lx->at++;
        push_token(lx, PLR_T_OTHER, begin, PLR_NONE);
        lx->after_dot = false;
    }
}

/* ---- Magic comments ----------------------------------------------------------------------------
 */

static void skip_blank(lexer *lx, uint32_t limit) {
    while (lx->at < limit) {
        uint32_t splice = splice_length(lx, lx->at);
        if (splice)
            lx->at += splice;
        else if (class_at(lx, lx->at) == C_SPACE || class_at(lx, lx->at) == C_NEWLINE)
            lx->at++;
        else
            return;
    }
}

static bool skip_text(lexer *lx, uint32_t limit, const char *text) {
    size_t length = strlen(text);
    if (limit - lx->at < length || memcmp(lx->text + lx->at, text, length) != 0)
        return false;
    lx->at += (uint32_t)length;
    return true;
}

/* One argument list, the scan standing after its `(`. False: it is not closed. */
static bool lex_list(lexer *lx, uint32_t limit) {
    plr_list list = {(uint32_t)lx->out->tokens.count, 0, 0};
    uint32_t depth = 0;
    for (skip_blank(lx, limit); lx->at < limit; skip_blank(lx, limit)) {
        char c = lx->text[lx->at];
        if (c == ')' && depth == 0) {
            lx->at++;
            list.end = (uint32_t)lx->out->tokens.count;
            if (list.end > list.first)
                list.count++;
            *PLR_PUSH(lx->arena, &lx->out->lists) = list;
            return true;
        }
        if (c == '{' || c == '}' || c == ';')
            return false; /* no expression has one */
        if (c == '(' || c == '[')
            depth++;
        else if ((c == ')' || c == ']') && depth > 0)
            depth--;
        else if (c == ',' && depth == 0)
            list.count++;
        lex_atom(lx, limit);
    }
    return false;
}

/* name (a, b) (c): the scan stands after "PLUG:". False: it cannot be read. */
static bool lex_plug_body(lexer *lx, uint32_t limit, plr_plug *plug) {
    skip_blank(lx, limit);
    if (lx->at >= limit || class_at(lx, lx->at) != C_WORD)
        return false;
    lex_atom(lx, limit);
    plug->name = lx->out->tokens.items[--lx->out->tokens.count].value;
    plug->lists = (uint32_t)lx->out->lists.count;
    skip_blank(lx, limit);
    plug->text_begin = lx->at;
    while (lx->at < limit && lx->text[lx->at] == '(') {
        lx->at++;
        if (!lex_list(lx, limit))
            return false;
        plug->text_end = lx->at;
        plug->list_count++;
        skip_blank(lx, limit);
    }
    return lx->at == limit && plug->list_count > 0;
}

static void lex_plug(lexer *lx, uint32_t begin, uint32_t inner_end, uint32_t end) {
    plr_lexed *out = lx->out;
    size_t tokens = out->tokens.count, lists = out->lists.count;
    plr_plug plug = {.token = (uint32_t)tokens, .offset = begin, .length = end - begin};
    bool gap = lx->gap, newline = lx->newline, dot = lx->after_dot, line_start = lx->line_start;
    push_token(lx, PLR_T_PLUG, begin, (uint32_t)out->plugs.count);
    bool good = lex_plug_body(lx, inner_end, &plug);
    lx->after_dot = dot;
    lx->line_start = line_start;
    if (!good) {
        out->tokens.count = tokens;
        out->lists.count = lists;
        lx->gap = gap;
        lx->newline = newline;
        add_warning(
            lx, PLR_CODE_PLUG_SYNTAX, begin,
            "this PLUG comment cannot be read: it needs a name and argument lists in parentheses");
        return;
    }
    plug.end = (uint32_t)out->tokens.count;
    *PLR_PUSH(lx->arena, &out->plugs) = plug;
}

/* A promise, the scan standing after "PLUG-PROMISE". No token: it may stand anywhere. */
static void lex_promise(lexer *lx, uint32_t begin, uint32_t limit, bool block) {
    skip_blank(lx, limit);
    bool colon = skip_text(lx, limit, ":");
    *PLR_PUSH(lx->arena, &lx->out->promises) = (plr_promise_comment){
        begin, lx->at, limit,
        !block          ? "a promise stands in a comment of the other kind, /* ... */"
        : lx->in_define ? "a PLUG-PROMISE comment in a preprocessor line is no promise"
        : !colon        ? "what is promised stands behind a colon: /* PLUG-PROMISE: ... */"
                        : NULL};
}

/* A block comment from `begin` to `end`: plugs and PLUG-DECLARATIONS become tokens. */
static void lex_magic(lexer *lx, uint32_t begin, uint32_t end) {
    uint32_t limit = end - 2;
    lx->at = begin + 2;
    skip_blank(lx, limit);
    if (skip_text(lx, limit, "PLUG")) {
        bool declarations = skip_text(lx, limit, "-DECLARATIONS");
        bool promise = !declarations && skip_text(lx, limit, "-PROMISE");
        skip_blank(lx, limit);
        if (promise) {
            lex_promise(lx, begin, limit, true);
        } else if (declarations && lx->at == limit) {
            if (!lx->in_define) {
                bool line_start = lx->line_start;
                push_token(lx, PLR_T_DECLARATIONS, begin, 0);
                lx->line_start = line_start;
            }
        } else if (!declarations && skip_text(lx, limit, ":")) {
            if (lx->in_define)
                add_warning(lx, PLR_CODE_PLUG_IN_MACRO, begin,
                            "a PLUG comment in a preprocessor line is no plug");
            else
                lex_plug(lx, begin, limit, end);
        }
    }
    lx->at = end;
    lx->gap = true;
}

/* ---- Comments and directives -------------------------------------------------------------------
 */

static void skip_line_comment(lexer *lx, uint32_t begin) {
    uint32_t inner = lx->at;
    while (lx->at < lx->length && class_at(lx, lx->at) != C_NEWLINE) {
        uint32_t splice = splice_length(lx, lx->at);
        lx->at += splice ? splice : 1;
    }
    uint32_t end = lx->at;
    lx->at = inner;
    while (lx->at < end && class_at(lx, lx->at) == C_SPACE)
        lx->at++;
    if (skip_text(lx, end, "PLUG-PROMISE"))
        lex_promise(lx, begin, end, false);
    lx->at = end;
    lx->gap = true;
}

/* Where the block comment that begins at `begin` ends; 0: nowhere. */
static uint32_t comment_end(const lexer *lx, uint32_t from) {
    for (uint32_t at = from; at < lx->length;) {
        const char *star = memchr(lx->text + at, '*', lx->length - at);
        if (!star)
            return 0;
        at = (uint32_t)(star - lx->text) + 1;
        uint32_t slash = after_splices(lx, at);
        if (slash < lx->length && lx->text[slash] == '/')
            return slash + 1;
    }
    return 0;
}

/* A comment, if one begins here. */
static bool lex_comment(lexer *lx) {
    uint32_t begin = lx->at, second = after_splices(lx, begin + 1);
    if (second >= lx->length || (lx->text[second] != '/' && lx->text[second] != '*'))
        return false;
    lx->at = second + 1;
    if (lx->text[second] == '/') {
        skip_line_comment(lx, begin);
        return true;
    }
    uint32_t end = comment_end(lx, second + 1);
    if (!end) {
        add_fault(lx, PLR_CODE_UNTERMINATED, begin, "this comment is never closed");
        lx->at = lx->length;
        lx->gap = true;
        return true;
    }
    if (second == begin + 1 && lx->text[end - 2] == '*')
        lex_magic(lx, begin, end);
    lx->at = end;
    lx->gap = true;
    return true;
}

static const struct {
    const char *name;
    plr_directive_kind kind;
} directive_names[] = {
    {"if", PLR_D_IF},           {"ifdef", PLR_D_IFDEF},
    {"ifndef", PLR_D_IFNDEF},   {"elif", PLR_D_ELIF},
    {"else", PLR_D_ELSE},       {"endif", PLR_D_ENDIF},
    {"define", PLR_D_DEFINE},   {"undef", PLR_D_UNDEF},
    {"version", PLR_D_VERSION}, {"extension", PLR_D_EXTENSION},
    {"line", PLR_D_DROP},       {"", PLR_D_DROP},
};

static plr_directive_kind directive_kind(const char *text, uint32_t length) {
    for (size_t i = 0; i < sizeof directive_names / sizeof directive_names[0]; i++)
        if (strlen(directive_names[i].name) == length &&
            memcmp(directive_names[i].name, text, length) == 0)
            return directive_names[i].kind;
    return PLR_D_OTHER;
}

/* A string of a preprocessor line, as one token: what looks like a comment in it is none. */
static bool lex_string(lexer *lx) {
    uint32_t begin = lx->at, end = begin + 1;
    while (end < lx->length && lx->text[end] != '"' && class_at(lx, end) != C_NEWLINE)
        end++;
    if (end >= lx->length || lx->text[end] != '"')
        return false;
    lx->at = end + 1;
    push_token(lx, PLR_T_OTHER, begin, PLR_NONE);
    lx->after_dot = false;
    return true;
}

/* The rest of a preprocessor line, as tokens. */
static void lex_directive_tokens(lexer *lx) {
    while (lx->at < lx->length) {
        uint32_t splice = splice_length(lx, lx->at);
        if (splice) {
            lx->at += splice;
            lx->gap = true;
        } else if (class_at(lx, lx->at) == C_NEWLINE) {
            return;
        } else if (class_at(lx, lx->at) == C_SPACE) {
            lx->at++;
        } else if (!(lx->text[lx->at] == '/' && lex_comment(lx)) &&
                   !(lx->text[lx->at] == '"' && lex_string(lx))) {
            lex_atom(lx, lx->length);
        }
    }
}

/* Marks the parameters of a function-like macro in its body. */
static void mark_parameters(plr_lexed *out, const plr_directive *directive) {
    plr_token *tokens = out->tokens.items;
    uint32_t open = directive->token + 2, close = open;
    if (directive->end <= open || tokens[open].kind != '(' ||
        tokens[open].offset != tokens[open - 1].offset + tokens[open - 1].length)
        return;
    while (close < directive->end && tokens[close].kind != ')')
        close++;
    if (close - open > 256)
        return; /* no compiler takes so many */
    for (uint32_t i = open + 1; i < close; i++)
        tokens[i].flags |= PLR_TF_PARAM;
    for (uint32_t i = close; i < directive->end; i++)
        for (uint32_t p = open + 1; p < close && tokens[i].kind == PLR_T_IDENT; p++)
            if (tokens[p].kind == PLR_T_IDENT && tokens[p].value == tokens[i].value)
                tokens[i].flags |= PLR_TF_PARAM;
}

static void lex_directive(lexer *lx) {
    plr_lexed *out = lx->out;
    uint32_t begin = lx->at++;
    plr_directive directive = {
        .token = (uint32_t)out->tokens.count, .next = PLR_NONE, .endif = PLR_NONE};
    bool gap = lx->gap;
    while (lx->at < lx->length) { /* blanks and comments between # and the name */
        uint32_t splice = splice_length(lx, lx->at);
        if (splice)
            lx->at += splice;
        else if (class_at(lx, lx->at) == C_SPACE)
            lx->at++;
        else if (lx->text[lx->at] != '/' || !lex_comment(lx))
            break;
    }
    uint32_t name = lx->at;
    while (lx->at < lx->length && class_at(lx, lx->at) == C_WORD)
        lx->at++;
    directive.kind = directive_kind(lx->text + name, lx->at - name);
    lx->gap = gap;
    lx->newline = true;
    plr_token *token = push_token(lx, PLR_T_DIRECTIVE, begin, (uint32_t)out->directives.count);
    token->count = (uint16_t)(lx->at - name);
    lx->after_dot = false;
    lx->in_define = true;
    lex_directive_tokens(lx);
    lx->in_define = lx->after_dot = false;
    lx->gap = true;
    directive.end = (uint32_t)out->tokens.count;
    if (directive.kind == PLR_D_DEFINE)
        mark_parameters(out, &directive);
    out->conditional |= directive.kind >= PLR_D_IF && directive.kind <= PLR_D_ENDIF;
    *PLR_PUSH(lx->arena, &out->directives) = directive;
}

/* Joins the branches of conditionals. */
static void join_conditionals(lexer *lx) {
    plr_lexed *out = lx->out;
    PLR_LIST(uint32_t) open = {NULL, 0, 0}; /* the last branch of each group that is open */
    uint32_t *first = PLR_NEW_ARRAY(lx->arena, out->directives.count + 1, uint32_t);
    for (uint32_t i = 0; i < out->directives.count; i++) {
        plr_directive *directive = &out->directives.items[i];
        uint32_t offset = out->tokens.items[directive->token].offset;
        if (directive->kind < PLR_D_IF || directive->kind > PLR_D_ENDIF)
            continue;
        if (directive->kind <= PLR_D_IFNDEF) {
            *PLR_PUSH(lx->arena, &open) = i;
            first[i] = i;
            continue;
        }
        uint32_t last = open.count ? open.items[open.count - 1] : 0;
        if (!open.count ||
            (out->directives.items[last].kind == PLR_D_ELSE && directive->kind != PLR_D_ENDIF)) {
            add_fault(lx, PLR_CODE_PREPROCESSOR, offset,
                      "there is no #if that this could belong to");
            return;
        }
        out->directives.items[last].next = i;
        first[i] = first[last];
        open.items[open.count - 1] = i;
        if (directive->kind == PLR_D_ENDIF) {
            for (uint32_t b = first[i]; b != i; b = out->directives.items[b].next)
                out->directives.items[b].endif = i;
            open.count--;
        }
    }
    if (open.count) {
        uint32_t branch = first[open.items[open.count - 1]];
        add_fault(lx, PLR_CODE_PREPROCESSOR,
                  out->tokens.items[out->directives.items[branch].token].offset,
                  "this conditional has no #endif");
    }
}

/* ---- The text ----------------------------------------------------------------------------------
 */

static void lex_text(lexer *lx) {
    while (lx->at < lx->length) {
        char c = lx->text[lx->at];
        switch (class_at(lx, lx->at)) {
        case C_SPACE:
            lx->at++;
            continue;
        case C_NEWLINE:
            lx->at++;
            lx->newline = lx->line_start = true;
            lx->gap |= c == '\r';
            continue;
        case C_PUNCT:
            if (c == '/' && lex_comment(lx))
                continue;
            if (c == '#' && lx->line_start) {
                lex_directive(lx);
                continue;
            }
            if (c == '\\' && splice_length(lx, lx->at)) {
                lx->at += splice_length(lx, lx->at);
                lx->gap = true;
                continue;
            }
            break;
        default:
            break;
        }
        lex_atom(lx, lx->length);
    }
}

void plr_lex(plr_arena *arena, const char *text, size_t length, char *spare, plr_lexed *lexed) {
    *lexed = (plr_lexed){.text = text, .length = (uint32_t)length};
    lexer lx = {.arena = arena,
                .out = lexed,
                .text = text,
                .length = (uint32_t)length,
                .newline = true,
                .line_start = true,
                .spare = spare};
    lx.slot_mask = 63;
    while (lx.slot_mask < length / 24)
        lx.slot_mask = lx.slot_mask * 2 + 1;
    lx.slots = PLR_NEW_ARRAY(arena, (size_t)lx.slot_mask + 1, uint32_t);
    lexed->tokens.items = plr_arena_grow(arena, NULL, &lexed->tokens.capacity, length / 4 + 16,
                                         sizeof *lexed->tokens.items);
    lexed->idents.items = plr_arena_grow(arena, NULL, &lexed->idents.capacity, length / 48 + 16,
                                         sizeof *lexed->idents.items);
    if (length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0)
        lx.at = 3;
    lex_text(&lx);
    push_token(&lx, PLR_T_END, lx.at, 0);
    if (lexed->conditional)
        join_conditionals(&lx);
}
