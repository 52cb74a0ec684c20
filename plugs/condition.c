/* Conditionals: which text of a unit is active, as far as that can be told. */
#include "plugs/link.h"

#include <stdlib.h>
#include <string.h>

#define MAX_TERMS 4096
#define MAX_EXPANSION 24
#define MAX_NESTING 200

/* ---- Macros ------------------------------------------------------------------------------------
 */

static plr_macro *number_macro(plr_linking *l, int64_t number) {
    plr_macro *macro = PLR_NEW(l->arena, plr_macro);
    *macro = (plr_macro){.state = PLR_MACRO_NUMBER, .host = true, .number = number};
    return macro;
}

static plr_macro *host_macro(plr_linking *l, const char *value) {
    if (!value)
        value = "1";
    char *end;
    long long number = strtoll(value, &end, 0);
    plr_macro *macro = number_macro(l, number);
    macro->text = plr_arena_copy(l->arena, value, strlen(value));
    if (end == value || *end) {
        size_t length = strlen(value);
        plr_lexed *lexed = PLR_NEW(l->arena, plr_lexed);
        char *spare = plr_arena_alloc(l->arena, length + 1);
        plr_lex(l->arena, macro->text, length, spare, lexed);
        uint32_t *gids = PLR_NEW_ARRAY(l->arena, lexed->idents.count + 1, uint32_t);
        for (size_t i = 0; i < lexed->idents.count; i++)
            gids[i] = plr_gid(l, lexed->idents.items[i].text, lexed->idents.items[i].length);
        macro->state = PLR_MACRO_TOKENS;
        macro->lexed = lexed;
        macro->gids = gids;
        macro->end = (uint32_t)lexed->tokens.count - 1;
    }
    return macro;
}

static void set_host(plr_linking *l, const char *name, plr_macro *macro) {
    uint32_t gid = plr_gid(l, name, strlen(name));
    l->hosts =
        plr_arena_grow(l->arena, l->hosts, &l->host_capacity, (size_t)gid + 1, sizeof(plr_macro *));
    l->hosts[gid] = macro;
}

void plr_set_version(plr_linking *l) {
    set_host(l, "__VERSION__", number_macro(l, l->version));
}

void plr_set_hosts(plr_linking *l) {
    bool es = l->desc->glsl == PLR_GLSL_300ES;
    plr_set_version(l);
    set_host(l, es ? "GL_ES" : "GL_core_profile", number_macro(l, 1));
    if (es)
        set_host(l, "GL_es_profile", number_macro(l, 1));
    set_host(l, "HAS_GEOMETRY_SHADER", l->no_geometry ? NULL : number_macro(l, 1));
    for (size_t i = 0; i < l->desc->define_count; i++)
        if (l->desc->defines[i].name)
            set_host(l, l->desc->defines[i].name, host_macro(l, l->desc->defines[i].value));
    for (uint32_t e = 0; e < l->effect_count; e++)
        for (size_t i = 0; i < l->desc->effects[e].define_count; i++)
            host_macro(l, l->desc->effects[e].defines[i].value); /* numbers its identifiers */
}

static void set_macro(plr_linking *l, uint32_t gid, plr_macro *macro) {
    if (!l->macros[gid])
        *PLR_PUSH(l->pass, &l->touched) = gid;
    l->macros[gid] = macro;
}

void plr_begin_macros(plr_linking *l, const plr_scope *scope) {
    static const char *const stages[] = {"PLUGRAY_VERTEX", "PLUGRAY_GEOMETRY", "PLUGRAY_FRAGMENT"};
    for (size_t i = 0; i < l->touched.count; i++)
        l->macros[l->touched.items[i]] = NULL;
    l->touched.count = 0;
    uint32_t stage = plr_gid_find(l, stages[scope->stage], strlen(stages[scope->stage]));
    if (stage != PLR_NONE)
        set_macro(l, stage, number_macro(l, 1));
    if (scope->owner >= l->effect_count)
        return;
    const plr_effect *effect = &l->desc->effects[scope->owner];
    for (size_t i = 0; i < effect->define_count; i++) {
        const char *name = effect->defines[i].name;
        uint32_t gid = name ? plr_gid_find(l, name, strlen(name)) : PLR_NONE;
        if (gid != PLR_NONE) /* else nothing asks for it */
            set_macro(l, gid, host_macro(l, effect->defines[i].value));
    }
}

/* Whether a macro of the driver may have that name. */
static bool may_be_drivers(const plr_ident *ident) {
    return ident->length > 3 && memcmp(ident->text, "GL_", 3) == 0 &&
           !(ident->length == 5 && memcmp(ident->text, "GL_ES", 5) == 0) &&
           !(ident->length > 8 && memcmp(ident->text + ident->length - 8, "_profile", 8) == 0);
}

static const plr_macro *find_macro(const plr_linking *l, uint32_t gid) {
    static const plr_macro unknown = {.state = PLR_MACRO_UNKNOWN};
    if (l->macros[gid])
        return l->macros[gid];
    if (gid < l->host_capacity && l->hosts[gid])
        return l->hosts[gid];
    return may_be_drivers(&l->idents.items[gid]) ? &unknown : NULL;
}

/* ---- Expressions -------------------------------------------------------------------------------
 */

enum {
    TERM_END,
    TERM_NUMBER,
    TERM_UNKNOWN,
    TERM_OR = 128,
    TERM_AND,
    TERM_EQUAL,
    TERM_UNEQUAL,
    TERM_LESS_EQUAL,
    TERM_GREATER_EQUAL,
    TERM_LEFT,
    TERM_RIGHT
};

typedef struct term {
    uint8_t kind; /* or a character */
    int64_t number;
} term;

typedef struct expression {
    plr_linking *l;
    PLR_LIST(term) terms;
    size_t at;
    unsigned nesting;
    bool bad; /* no expression, or too large: nothing is known */
} expression;

typedef struct text_range {
    const plr_lexed *lexed;
    const uint32_t *gids;
    uint32_t at, end;
} text_range;

static void add_term(expression *e, uint8_t kind, int64_t number) {
    if (e->terms.count == MAX_TERMS)
        e->bad = true;
    else
        *PLR_PUSH(e->l->pass, &e->terms) = (term){kind, number};
}

static bool range_is(const text_range *r, uint32_t at, uint8_t kind) {
    return at < r->end && r->lexed->tokens.items[at].kind == kind;
}

/* name or (name) after `defined`, PLUG_USED, READS: its gid; PLR_NONE: there is none. */
static uint32_t read_operand(text_range *r) {
    bool parens = range_is(r, r->at, '(');
    uint32_t at = r->at + parens;
    if (!range_is(r, at, PLR_T_IDENT) || (parens && !range_is(r, at + 1, ')')))
        return PLR_NONE;
    r->at = at + 1 + parens;
    return r->gids[r->lexed->tokens.items[at].value];
}

static void expand_query(expression *e, text_range *r, uint16_t word) {
    uint32_t gid = read_operand(r);
    if (gid == PLR_NONE) {
        e->bad = true;
    } else if (word == PLR_WORD_defined) {
        const plr_macro *macro = find_macro(e->l, gid);
        bool unknown = macro && macro->state == PLR_MACRO_UNKNOWN;
        add_term(e, unknown ? TERM_UNKNOWN : TERM_NUMBER,
                 macro && macro->state != PLR_MACRO_UNDEFINED);
    } else {
        const uint8_t *set = word == PLR_WORD_READS ? e->l->reads : e->l->used;
        add_term(e, TERM_NUMBER, e->l->all || set[gid]);
    }
}

static void expand_number(expression *e, const text_range *r, const plr_token *token) {
    size_t length;
    const char *text = plr_token_text(r->lexed, token, &length);
    char digits[32];
    if (length >= sizeof digits) {
        e->bad = true;
        return;
    }
    memcpy(digits, text, length);
    digits[length] = '\0';
    char *end;
    long long number = strtoll(digits, &end, 0);
    if (*end == 'u' || *end == 'U')
        end++;
    e->bad |= *end != '\0';
    add_term(e, TERM_NUMBER, number);
}

static const struct {
    char first, second;
    uint8_t kind;
} pairs[] = {{'|', '|', TERM_OR},      {'&', '&', TERM_AND},        {'=', '=', TERM_EQUAL},
             {'!', '=', TERM_UNEQUAL}, {'<', '=', TERM_LESS_EQUAL}, {'>', '=', TERM_GREATER_EQUAL},
             {'<', '<', TERM_LEFT},    {'>', '>', TERM_RIGHT}};

static void expand_operator(expression *e, text_range *r, const plr_token *token) {
    const plr_token *next = token + 1;
    for (size_t i = 0; r->at < r->end && i < sizeof pairs / sizeof pairs[0]; i++)
        if (token->kind == (uint8_t)pairs[i].first && next->kind == (uint8_t)pairs[i].second &&
            next->offset == token->offset + 1) {
            r->at++;
            add_term(e, pairs[i].kind, 0);
            return;
        }
    add_term(e, token->kind, 0);
}

/* A call of a function-like macro: its value is not looked for. */
static void skip_call(text_range *r) {
    const plr_token *open = &r->lexed->tokens.items[r->at];
    if (range_is(r, r->at, '('))
        r->at = open->value != PLR_NONE && open->value < r->end ? open->value + 1 : r->end;
}

static void expand_text(expression *e, text_range r, unsigned depth) {
    while (r.at < r.end && !e->bad) {
        const plr_token *token = &r.lexed->tokens.items[r.at++];
        if (token->kind == PLR_T_NUMBER) {
            expand_number(e, &r, token);
            continue;
        }
        if (token->kind != PLR_T_IDENT) {
            expand_operator(e, &r, token);
            continue;
        }
        uint16_t word = r.lexed->idents.items[token->value].word;
        if (word == PLR_WORD_defined || word == PLR_WORD_PLUG_USED || word == PLR_WORD_READS) {
            expand_query(e, &r, word);
            continue;
        }
        const plr_macro *macro = find_macro(e->l, r.gids[token->value]);
        if (macro && macro->state == PLR_MACRO_NUMBER) {
            add_term(e, TERM_NUMBER, macro->number);
        } else if (macro && macro->state == PLR_MACRO_TOKENS && !macro->function_like &&
                   depth < MAX_EXPANSION) {
            expand_text(e, (text_range){macro->lexed, macro->gids, macro->first, macro->end},
                        depth + 1);
        } else {
            skip_call(&r);
            add_term(e, TERM_UNKNOWN, 0);
        }
    }
}

typedef struct value {
    bool known;
    int64_t number;
} value;

static const uint8_t levels[][5] = {
    {TERM_OR},
    {TERM_AND},
    {'|'},
    {'^'},
    {'&'},
    {TERM_EQUAL, TERM_UNEQUAL},
    {'<', '>', TERM_LESS_EQUAL, TERM_GREATER_EQUAL},
    {TERM_LEFT, TERM_RIGHT},
    {'+', '-'},
    {'*', '/', '%'},
};
#define LEVELS (sizeof levels / sizeof levels[0])

static int64_t wrap(uint64_t number) {
    return (int64_t)number;
}

static value calculate(uint8_t operation, value a, value b) {
    bool both = a.known && b.known;
    if (operation == TERM_OR && ((a.known && a.number) || (b.known && b.number)))
        return (value){true, 1};
    if (operation == TERM_AND && ((a.known && !a.number) || (b.known && !b.number)))
        return (value){true, 0};
    if (!both)
        return (value){false, 0};
    uint64_t x = (uint64_t)a.number, y = (uint64_t)b.number;
    bool divides = b.number != 0 && !(b.number == -1);
    switch (operation) {
    case TERM_OR:
    case TERM_AND:
        return (value){true, a.number && b.number};
    case '|':
        return (value){true, wrap(x | y)};
    case '^':
        return (value){true, wrap(x ^ y)};
    case '&':
        return (value){true, wrap(x & y)};
    case TERM_EQUAL:
        return (value){true, x == y};
    case TERM_UNEQUAL:
        return (value){true, x != y};
    case '<':
        return (value){true, a.number < b.number};
    case '>':
        return (value){true, a.number > b.number};
    case TERM_LESS_EQUAL:
        return (value){true, a.number <= b.number};
    case TERM_GREATER_EQUAL:
        return (value){true, a.number >= b.number};
    case TERM_LEFT:
        return (value){y < 63, y < 63 ? wrap(x << y) : 0};
    case TERM_RIGHT:
        return (value){y < 63, y < 63 ? a.number >> y : 0};
    case '+':
        return (value){true, wrap(x + y)};
    case '-':
        return (value){true, wrap(x - y)};
    case '*':
        return (value){true, wrap(x * y)};
    case '/':
        return (value){b.number != 0, divides ? a.number / b.number : wrap(0 - x)};
    default: /* % */
        return (value){b.number != 0, divides ? a.number % b.number : 0};
    }
}

static value parse_level(expression *e, size_t level);

static value parse_unary(expression *e) {
    if (++e->nesting > MAX_NESTING || e->at >= e->terms.count) {
        e->bad = true;
        return (value){false, 0};
    }
    term t = e->terms.items[e->at++];
    value v = {false, 0};
    if (t.kind == TERM_NUMBER) {
        v = (value){true, t.number};
    } else if (t.kind == '(') {
        v = parse_level(e, 0);
        if (e->at < e->terms.count && e->terms.items[e->at].kind == ')')
            e->at++;
        else
            e->bad = true;
    } else if (t.kind == '!' || t.kind == '-' || t.kind == '+' || t.kind == '~') {
        v = parse_unary(e);
        if (t.kind == '!')
            v.number = !v.number;
        else if (t.kind == '-')
            v.number = wrap(0 - (uint64_t)v.number);
        else if (t.kind == '~')
            v.number = ~v.number;
    } else if (t.kind != TERM_UNKNOWN) {
        e->bad = true;
    }
    e->nesting--;
    return v;
}

static value parse_level(expression *e, size_t level) {
    if (level == LEVELS)
        return parse_unary(e);
    value left = parse_level(e, level + 1);
    while (!e->bad && e->at < e->terms.count &&
           memchr(levels[level], e->terms.items[e->at].kind, sizeof levels[level])) {
        uint8_t operation = e->terms.items[e->at++].kind;
        left = calculate(operation, left, parse_level(e, level + 1));
    }
    return left;
}

static value evaluate_text(plr_linking *l, text_range range) {
    if (range.end == range.at + 1 && range_is(&range, range.at, PLR_T_NUMBER)) {
        const plr_token *token = &range.lexed->tokens.items[range.at];
        if (token->length == 1 && !(token->flags & PLR_TF_SPLICED))
            return (value){true, range.lexed->text[token->offset] - '0'};
    }
    expression e = {.l = l};
    expand_text(&e, range, 0);
    if (e.bad)
        return (value){false, 0};
    value v = parse_level(&e, 0);
    return e.bad || e.at != e.terms.count ? (value){false, 0} : v;
}

/* ---- Conditionals ------------------------------------------------------------------------------
 */

typedef enum mode {
    MODE_SEARCHING, /* no branch has held so far */
    MODE_TAKEN,
    MODE_KEPT,
    MODE_KEPT_LAST /* kept, and no further branch can hold */
} mode;

typedef struct frame {
    mode mode;
    uint32_t endif;
} frame;

typedef struct evaluator {
    plr_linking *l;
    plr_unit *unit;
    const plr_directive *directives;
    uint32_t *next;
    uint8_t *kept;
    uint32_t *skipped;
    PLR_LIST(frame) frames;
    uint32_t keeping; /* frames that are kept */
} evaluator;

static void define_macro(evaluator *v, const plr_directive *directive) {
    plr_linking *l = v->l;
    const plr_lexed *lexed = v->unit->lexed;
    uint32_t name = directive->token + 1;
    if (name >= directive->end || lexed->tokens.items[name].kind != PLR_T_IDENT)
        return;
    plr_macro *macro = PLR_NEW(l->pass, plr_macro);
    uint32_t gid = plr_token_gid(v->unit, name);
    set_macro(l, gid, macro);
    if (v->keeping) {
        macro->state = PLR_MACRO_UNKNOWN;
        return;
    }
    if (directive->kind == PLR_D_UNDEF)
        return;
    *macro = (plr_macro){.state = PLR_MACRO_TOKENS,
                         .lexed = lexed,
                         .gids = v->unit->reading->gids,
                         .first = name + 1,
                         .end = directive->end};
    const plr_token *token = &lexed->tokens.items[name];
    macro->function_like = name + 1 < directive->end && token[1].kind == '(' &&
                           token[1].offset == token->offset + token->length;
}

static value evaluate_branch(evaluator *v, const plr_directive *directive) {
    plr_linking *l = v->l;
    const plr_lexed *lexed = v->unit->lexed;
    uint32_t first = directive->token + 1;
    if (directive->kind == PLR_D_ELSE)
        return (value){true, 1};
    if (directive->kind == PLR_D_IF || directive->kind == PLR_D_ELIF)
        return evaluate_text(l, (text_range){lexed, v->unit->reading->gids, first, directive->end});
    if (first >= directive->end || lexed->tokens.items[first].kind != PLR_T_IDENT)
        return (value){false, 0};
    const plr_macro *macro = find_macro(l, plr_token_gid(v->unit, first));
    if (macro && macro->state == PLR_MACRO_UNKNOWN)
        return (value){false, 0};
    bool defined = macro && macro->state != PLR_MACRO_UNDEFINED;
    return (value){true, defined == (directive->kind == PLR_D_IFDEF)};
}

/* Where the text goes on if a branch does not hold: at the next one. Returns that directive. */
static uint32_t skip_branch(evaluator *v, uint32_t i) {
    uint32_t next = v->directives[i].next;
    v->next[i] = v->directives[next].token;
    v->skipped[i] = next;
    return next;
}

static uint32_t leave_group(evaluator *v, uint32_t i) {
    frame *f = &v->frames.items[v->frames.count - 1];
    uint32_t endif = f->endif;
    v->skipped[i] = endif;
    if (f->mode == MODE_KEPT_LAST) {
        v->next[i] = v->directives[endif].token;
        return endif; /* which is printed */
    }
    v->next[i] = v->directives[endif].end;
    v->next[endif] = v->directives[endif].end;
    v->frames.count--;
    return endif + 1;
}

/* A branch that may be entered: #if, or #elif and #else while nothing has held. */
static uint32_t try_branch(evaluator *v, uint32_t i) {
    frame *f = &v->frames.items[v->frames.count - 1];
    const plr_directive *directive = &v->directives[i];
    value held = evaluate_branch(v, directive);
    if (held.known && !held.number)
        return skip_branch(v, i);
    v->next[i] = directive->end;
    if (f->mode == MODE_SEARCHING) {
        f->mode = held.known ? MODE_TAKEN : MODE_KEPT;
        v->keeping += !held.known;
        v->kept[i] = held.known ? PLR_KEPT_NO : PLR_KEPT_IF;
    } else {
        f->mode = held.known ? MODE_KEPT_LAST : MODE_KEPT;
        v->kept[i] = held.known ? PLR_KEPT_ELSE : PLR_KEPT_ELIF;
    }
    return i + 1;
}

static uint32_t pass_conditional(evaluator *v, uint32_t i) {
    const plr_directive *directive = &v->directives[i];
    if (directive->kind <= PLR_D_IFNDEF) {
        *PLR_PUSH(v->l->pass, &v->frames) = (frame){MODE_SEARCHING, directive->endif};
        return try_branch(v, i);
    }
    frame *f = &v->frames.items[v->frames.count - 1];
    if (directive->kind != PLR_D_ENDIF) {
        if (f->mode == MODE_TAKEN || f->mode == MODE_KEPT_LAST)
            return leave_group(v, i);
        return try_branch(v, i);
    }
    bool kept = f->mode == MODE_KEPT || f->mode == MODE_KEPT_LAST;
    v->keeping -= kept;
    v->kept[i] = kept ? PLR_KEPT_ENDIF : PLR_KEPT_NO;
    v->next[i] = directive->end;
    v->frames.count--;
    return i + 1;
}

void plr_evaluate(plr_linking *l, plr_unit *unit) {
    const plr_lexed *lexed = unit->lexed;
    uint32_t count = (uint32_t)lexed->directives.count;
    evaluator v = {.l = l, .unit = unit, .directives = lexed->directives.items};
    if (lexed->conditional) {
        v.next = PLR_NEW_ARRAY(l->pass, count, uint32_t);
        v.kept = PLR_NEW_ARRAY(l->pass, count, uint8_t);
        v.skipped = PLR_NEW_ARRAY(l->pass, count, uint32_t);
        unit->own_activity = (plr_activity){v.next, v.kept, v.skipped};
        unit->activity = &unit->own_activity;
    }
    for (uint32_t i = 0; i < count;) {
        const plr_directive *directive = &lexed->directives.items[i];
        if (directive->kind >= PLR_D_IF && directive->kind <= PLR_D_ENDIF) {
            i = pass_conditional(&v, i);
            continue;
        }
        if (directive->kind == PLR_D_DEFINE || directive->kind == PLR_D_UNDEF)
            define_macro(&v, directive);
        if (v.next) {
            v.next[i] = directive->end;
            v.kept[i] = PLR_KEPT_AS_IS;
        }
        i++;
    }
}
