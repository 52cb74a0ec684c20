/* What authors promise of their plug functions: comments "PLUG-PROMISE: word word number". */
#include "plugs/program.h"

#include <float.h>
#include <string.h>

enum {
    MOST_WORD = 64
};

typedef enum promise_word {
    COLOUR_ONLY,
    COLOR_ONLY,
    KEEPS_TRANSPARENT,
    LIPSCHITZ,
    WORDS
} promise_word;

static const char *const words[WORDS] = {[COLOUR_ONLY] = "colour-only",
                                         [COLOR_ONLY] = "color-only",
                                         [KEEPS_TRANSPARENT] = "keeps-transparent",
                                         [LIPSCHITZ] = "lipschitz"};

/* ---- Which comments count ----------------------------------------------------------------------
 */

typedef enum comment_state {
    COMMENT_COUNTS,
    COMMENT_INACTIVE,
    COMMENT_GUARDED /* by a conditional that only the compiler can evaluate */
} comment_state;

/* Walks the directives of a unit along with its comments. */
typedef struct comment_walk {
    const plr_unit *unit;
    size_t directive; /* the next one */
    uint32_t kept;    /* conditionals that are open */
    uint32_t skipped; /* text before this offset is inactive */
} comment_walk;

static comment_state state_at(comment_walk *w, uint32_t offset) {
    const plr_lexed *lexed = w->unit->lexed;
    const plr_activity *activity = w->unit->activity;
    while (activity && w->directive < lexed->directives.count) {
        const plr_directive *directive = &lexed->directives.items[w->directive];
        if (lexed->tokens.items[directive->token].offset > offset)
            break;
        plr_kept kept = (plr_kept)activity->kept[w->directive];
        w->kept += kept == PLR_KEPT_IF;
        w->kept -= kept == PLR_KEPT_ENDIF && w->kept > 0;
        uint32_t end = activity->skipped[w->directive];
        w->directive = end ? end : w->directive + 1;
        if (end)
            w->skipped = lexed->tokens.items[lexed->directives.items[end].token].offset;
    }
    return offset < w->skipped ? COMMENT_INACTIVE : w->kept ? COMMENT_GUARDED : COMMENT_COUNTS;
}

/* Why no comment of the unit can count; NULL: it can. */
static const char *unit_reason(const plr_linking *l, const plr_unit *unit) {
    if (unit->scope->owner >= l->effect_count)
        return "a base shader promises nothing: promises are those of effects";
    if (unit->scope->stage != PLR_FRAGMENT)
        return "promises are those of fragment units: they are about colours";
    if (!unit->functions)
        return "this unit has no plug function of which this could be promised";
    return NULL;
}

/* ---- Words -------------------------------------------------------------------------------------
 */

typedef struct word {
    char text[MOST_WORD + 1]; /* less splices; cut off */
    size_t length;            /* of all of it */
    uint32_t offset;
} word;

static bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

static uint32_t splice_length(const plr_lexed *lexed, uint32_t at) {
    if (lexed->text[at] != '\\' || (lexed->text[at + 1] != '\n' && lexed->text[at + 1] != '\r'))
        return 0;
    return lexed->text[at + 1] == '\r' && lexed->text[at + 2] == '\n' ? 3 : 2;
}

/* The next word from *at on; false: there is none. */
static bool next_word(const plr_lexed *lexed, uint32_t *at, uint32_t end, word *w) {
    *w = (word){.length = 0};
    while (*at < end) {
        uint32_t splice = splice_length(lexed, *at);
        char c = lexed->text[*at];
        if (!splice && is_blank(c) && w->length)
            break;
        if (!splice && !is_blank(c)) {
            if (!w->length)
                w->offset = *at;
            if (w->length < MOST_WORD)
                w->text[w->length] = c;
            w->length++;
        }
        *at += splice ? splice : 1;
    }
    return w->length > 0;
}

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/* Digits and a dot: the number, and how many places stand behind the dot. */
static const char *read_digits(const char *text, double *number, int *places, int *digits) {
    bool dot = false;
    for (; is_digit(*text) || (*text == '.' && !dot); text++) {
        dot = dot || *text == '.';
        if (*text == '.')
            continue;
        *number = *number * 10 + (*text - '0');
        *places += dot;
        ++*digits;
    }
    return text;
}

/* A decimal number, whatever the locale; 0: it is none that is finite and greater than 0. */
static double read_number(const word *w) {
    enum {
        MOST_EXPONENT = 1000
    };
    double number = 0;
    int places = 0, digits = 0, exponent = 0;
    const char *text = w->text + (w->text[0] == '+');
    text = read_digits(text, &number, &places, &digits);
    if (digits && (*text == 'e' || *text == 'E')) {
        bool minus = *++text == '-';
        text += *text == '+' || *text == '-';
        if (!is_digit(*text))
            return 0;
        for (; is_digit(*text); text++)
            exponent = exponent < MOST_EXPONENT ? exponent * 10 + (*text - '0') : exponent;
        exponent = minus ? -exponent : exponent;
    }
    exponent -= places;
    if (!digits || *text || w->length > MOST_WORD)
        return 0;
    for (; exponent > 0; exponent--)
        number *= 10;
    for (; exponent < 0; exponent++)
        number /= 10;
    return number > 0 && number <= DBL_MAX ? number : 0;
}

static promise_word find_word(const word *w) {
    promise_word found = WORDS;
    for (int i = 0; i < WORDS; i++)
        if (strlen(words[i]) == w->length && strcmp(words[i], w->text) == 0)
            found = (promise_word)i;
    return found;
}

/* ---- Promises ----------------------------------------------------------------------------------
 */

typedef struct reader {
    plr_linking *l;
    plr_unit *unit;
    const plr_promise_comment *comment;
    uint32_t at, end;
} reader;

static void say_at(reader *r, uint32_t offset, const char *text, const char *more) {
    plr_say(r->l, PLR_CODE_PROMISE, plr_unit_place(r->unit, offset), "%s%s", text, more);
}

static void read_lipschitz(reader *r, const word *at) {
    uint32_t behind = r->at;
    word number;
    bool any = next_word(r->unit->lexed, &behind, r->end, &number);
    bool numeric = any && strchr("+-.0123456789", number.text[0]);
    double bound = numeric ? read_number(&number) : 0;
    double *most = &r->unit->promises.lipschitz;
    if (bound > *most) {
        *most = bound;
        r->unit->promised[PLR_LIPSCHITZ] = r->comment;
    } else if (bound <= 0) {
        say_at(r, numeric ? number.offset : at->offset,
               "\"lipschitz\" needs a finite number greater than 0", "");
    }
    if (numeric)
        r->at = behind;
}

static void make(reader *r, plr_promise_kind kind, bool *promise) {
    if (!*promise)
        r->unit->promised[kind] = r->comment;
    *promise = true;
}

static void read_promise(reader *r) {
    word w;
    plr_promises *promises = &r->unit->promises;
    bool any = false;
    for (; next_word(r->unit->lexed, &r->at, r->end, &w); any = true) {
        promise_word found = find_word(&w);
        if (found == LIPSCHITZ)
            read_lipschitz(r, &w);
        else if (found == WORDS)
            say_at(r, w.offset,
                   plr_arena_format(r->l->pass, "nothing is known of a promise \"%.*s\"",
                                    (int)(w.length < MOST_WORD ? w.length : MOST_WORD), w.text),
                   plr_nearest_words(r->l, w.text, w.length, words, WORDS));
        if (found == COLOUR_ONLY || found == COLOR_ONLY)
            make(r, PLR_COLOUR_ONLY, &promises->colour_only);
        if (found < LIPSCHITZ)
            make(r, PLR_KEEPS_TRANSPARENT, &promises->keeps_transparent);
    }
    if (!any)
        say_at(r, r->end, "this comment promises nothing", "");
}

static void take_unit(plr_linking *l, plr_unit *unit) {
    const plr_lexed *lexed = unit->lexed;
    const char *reason = unit_reason(l, unit);
    comment_walk walk = {.unit = unit};
    for (size_t i = 0; i < lexed->promises.count; i++) {
        const plr_promise_comment *comment = &lexed->promises.items[i];
        comment_state state = state_at(&walk, comment->offset);
        if (state == COMMENT_INACTIVE)
            continue;
        reader r = {l, unit, comment, comment->words, comment->end};
        if (comment->counts_not || reason)
            say_at(&r, comment->offset, comment->counts_not ? comment->counts_not : reason, "");
        else if (state == COMMENT_GUARDED)
            say_at(&r, comment->offset,
                   "only the compiler knows whether this promise is made: it does not count", "");
        else
            read_promise(&r);
    }
}

void plr_take_promises(plr_linking *l, plr_scope *scope) {
    for (uint32_t u = 0; u < scope->unit_count; u++)
        take_unit(l, &scope->units[u]);
}

bool plr_program_promise_place(const plr_program *program, size_t plug, size_t call,
                               plr_promise_kind kind, plr_place *place) {
    if (plug >= program->linking.sockets.count || (unsigned)kind >= PLR_PROMISE_KINDS)
        return false;
    const plr_socket *socket = program->linking.sockets.items[plug];
    if (call >= socket->calls.count)
        return false;
    const plr_unit *unit = socket->calls.items[call].function->node->unit;
    const plr_promise_comment *comment = unit->promised[kind];
    if (comment)
        *place = plr_unit_place(unit, comment->offset);
    return comment != NULL;
}

static plr_promises both(const plr_promises *a, const plr_promises *b) {
    double most = a->lipschitz > b->lipschitz ? a->lipschitz : b->lipschitz;
    return (plr_promises){.colour_only = a->colour_only && b->colour_only,
                          .keeps_transparent = a->keeps_transparent && b->keeps_transparent,
                          .lipschitz = a->lipschitz > 0 && b->lipschitz > 0 ? most : 0};
}

plr_promises plr_program_promises(const plr_program *program, size_t effect) {
    plr_promises all = {false, false, 0};
    const plr_linking *l = &program->linking;
    if (effect >= l->effect_count || l->faulty[effect] || l->left_out[effect])
        return all;
    const plr_scope *scope = plr_scope_of(l, PLR_FRAGMENT, (uint32_t)effect);
    bool first = true;
    for (uint32_t u = 0; u < scope->unit_count; u++) {
        const plr_promises *one = &scope->units[u].promises;
        if (!scope->units[u].functions)
            continue;
        all = first ? *one : both(&all, one);
        first = false;
    }
    return all;
}
