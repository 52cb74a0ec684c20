#include "plugs/print.h"

#include <stdio.h>
#include <string.h>

static void put(plr_printer *p, const char *text, size_t length) {
    plr_arena *arena = p->l->arena;
    if (p->out.count + length > p->out.capacity)
        p->out.items =
            plr_arena_grow(arena, p->out.items, &p->out.capacity, p->out.count + length, 1);
    if (length)
        memcpy(p->out.items + p->out.count, text, length);
    p->out.count += length;
}

static void add_run(plr_printer *p, uint32_t origin, uint32_t offset) {
    uint32_t out = (uint32_t)p->out.count;
    if (p->runs.count) {
        plr_run *last = &p->runs.items[p->runs.count - 1];
        if (last->origin == origin &&
            (origin >= PLR_RUN_OWN || last->offset == offset ||
             (out - last->out == offset - last->offset && !(offset & PLR_RUN_FIXED))))
            return;
        if (last->out == out) {
            *last = (plr_run){out, origin, offset};
            return;
        }
    }
    *PLR_PUSH(p->l->arena, &p->runs) = (plr_run){out, origin, offset};
}

static void flush(plr_printer *p) {
    if (p->end > p->begin) {
        add_run(p, p->unit->number, p->begin);
        put(p, p->unit->lexed->text + p->begin, p->end - p->begin);
    }
    p->begin = p->end = 0;
}

void plr_print_own(plr_printer *p, const char *text) {
    flush(p);
    add_run(p, PLR_RUN_OWN, 0);
    put(p, text, strlen(text));
}

void plr_print_newline(plr_printer *p) {
    flush(p);
    if (p->out.count && p->out.items[p->out.count - 1] != '\n')
        put(p, "\n", 1);
}

/* The blanks that begin the line of a byte of the unit. */
static void put_indent(plr_printer *p, uint32_t offset) {
    const char *text = p->unit->lexed->text;
    uint32_t begin = offset;
    while (begin > 0 && text[begin - 1] != '\n')
        begin--;
    uint32_t end = begin;
    while (end < offset && (text[end] == ' ' || text[end] == '\t'))
        end++;
    put(p, text + begin, end - begin);
}

/* What stands between the token before and one at `offset`: comments and splices become blanks. */
static void put_gap(plr_printer *p, uint32_t offset) {
    flush(p);
    if (p->fresh)
        return;
    const char *text = p->unit->lexed->text;
    if (p->out.count && p->out.items[p->out.count - 1] == '\n') {
        put_indent(p, offset);
    } else if (p->broken || memchr(text + p->last, '\n', offset - p->last)) {
        put(p, "\n", 1);
        put_indent(p, offset);
    } else if (offset > p->last) {
        put(p, " ", 1);
    }
}

/* Makes ready to go on at a token: p->begin is where the text to be copied next begins. */
static void begin_token(plr_printer *p, const plr_token *token) {
    bool plain_gap = !p->fresh && !p->broken && !(token->flags & PLR_TF_GAP);
    if (!plain_gap) {
        put_gap(p, token->offset);
        p->begin = token->offset;
    } else if (p->end == 0) {
        p->begin = p->last; /* the token before was printed with another text */
    }
    p->fresh = p->broken = false;
}

static void end_token(plr_printer *p, const plr_token *token) {
    p->last = token->offset + token->length;
    p->before = token->kind;
    p->last_token = (uint32_t)(token - p->unit->lexed->tokens.items);
}

/* The text of a token, where a NUL would end the program's. */
static const char *printable_text(const plr_printer *p, const plr_token *token, size_t *length) {
    const char *text = plr_token_text(p->unit->lexed, token, length);
    return token->kind == PLR_T_OTHER && *text == '\0' ? "?" : text;
}

/* A token as it is. */
static void copy_token(plr_printer *p, const plr_token *token) {
    begin_token(p, token);
    if (token->flags & PLR_TF_SPLICED || token->kind == PLR_T_OTHER) {
        size_t length;
        const char *text = printable_text(p, token, &length);
        p->end = token->offset;
        flush(p);
        add_run(p, p->unit->number, token->offset | PLR_RUN_FIXED);
        put(p, text, length);
    } else {
        p->end = token->offset + token->length;
    }
    end_token(p, token);
}

/* A token with another text. */
static void replace_token(plr_printer *p, const plr_token *token, const char *text, size_t length) {
    begin_token(p, token);
    p->end = token->offset;
    flush(p);
    add_run(p, p->unit->number, token->offset | PLR_RUN_FIXED);
    put(p, text, length);
    end_token(p, token);
}

static void drop_token(plr_printer *p, const plr_token *token) {
    flush(p);
    p->last = token->offset + token->length;
}

/* ---- Identifiers that need a look at what follows ---------------------------------------------
 */

static uint32_t active_after(const plr_printer *p, uint32_t token) {
    return plr_active(p->unit->lexed, p->unit->activity, token + 1);
}

static uint8_t kind_after(const plr_printer *p, uint32_t token) {
    return p->unit->lexed->tokens.items[active_after(p, token)].kind;
}

static const plr_function *defined_here(const plr_printer *p, uint32_t token) {
    for (const plr_function *f = p->node->function; f && f->node == p->node; f = f->next)
        if (f->name->token == token)
            return f;
    return NULL;
}

static void put_tokens(plr_printer *p, uint32_t first, uint32_t end);

/* PLUG_x (...) ; that means several functions: a block of calls. Returns the token to go on with.
 */
static uint32_t print_sequence(plr_printer *p, uint32_t token, plr_function **found, size_t count) {
    const plr_token *tokens = p->unit->lexed->tokens.items;
    uint32_t open = active_after(p, token), close = tokens[open].value;
    uint32_t semicolon = plr_active(p->unit->lexed, p->unit->activity, close + 1);
    put_gap(p, tokens[token].offset);
    p->begin = p->end = 0;
    put(p, "{ ", 2);
    for (size_t i = 0; i < count; i++) {
        add_run(p, p->unit->number, tokens[token].offset | PLR_RUN_FIXED);
        put(p, found[i]->text, found[i]->length);
        p->fresh = true;
        p->broken = false;
        put_tokens(p, open, close + 1);
        flush(p);
        put(p, "; ", 2);
    }
    put(p, "}", 1);
    p->fresh = p->broken = false;
    end_token(p, &tokens[semicolon]);
    return semicolon + 1;
}

static uint32_t print_plug_name(plr_printer *p, uint32_t token) {
    const plr_token *tokens = p->unit->lexed->tokens.items;
    const plr_function *own = defined_here(p, token);
    plr_function *found[64];
    size_t count = own ? 0 : plr_direct_functions(p->l, p->unit, token, found, 64);
    uint32_t open = active_after(p, token);
    bool whole = p->before == ';' || p->before == '{' || p->before == '}' || p->before == ')' ||
                 p->before == ':';
    if (count > 1 && whole && tokens[open].kind == '(' && tokens[open].value != PLR_NONE &&
        kind_after(p, tokens[open].value) == ';')
        return print_sequence(p, token, found, count);
    const plr_function *f = own ? own : count ? found[0] : NULL;
    if (f)
        replace_token(p, &tokens[token], f->text, f->length);
    else
        copy_token(p, &tokens[token]);
    return token + 1;
}

/* A function with the name of a built-in one: only calls that fit its own definitions mean it. */
static bool means_own(const plr_printer *p, const plr_binding *symbol, uint32_t token) {
    uint32_t next = active_after(p, token);
    const plr_token *open = &p->unit->lexed->tokens.items[next];
    if (open->kind != '(')
        return symbol->variable || symbol->macro;
    for (const plr_definition *d = symbol->definitions; d; d = d->next)
        if (d->name->kind == PLR_ITEM_MACRO ||
            (d->name->kind == PLR_ITEM_FUNCTION && d->name->parameters == open->count))
            return true;
    return false;
}

static void print_since(plr_printer *p, uint32_t token, const plr_ident *ident) {
    const plr_token *t = &p->unit->lexed->tokens.items[token];
    plr_binding *symbol = p->unit->refs[t->value];
    bool builtin = (plr_word_get(ident->word)->kinds & PLR_WORD_IS_BUILTIN) != 0;
    uint32_t length;
    if (builtin && kind_after(p, token) == '(' &&
        !(symbol && symbol->function && means_own(p, symbol, token))) {
        copy_token(p, t);
    } else if (symbol && !(t->flags & (PLR_TF_MEMBER | PLR_TF_PLAIN))) {
        const char *text = plr_binding_text(p->l, symbol, &length);
        replace_token(p, t, text, length);
    } else {
        char text[64];
        int size = snprintf(text, sizeof text, "plr_%.*s", (int)ident->length, ident->text);
        replace_token(p, t, text, (size_t)size);
    }
}

static void push_closer(plr_printer *p, uint32_t token, const char *text) {
    if (p->closer_count < sizeof p->closers / sizeof p->closers[0])
        p->closers[p->closer_count++] = (plr_closer){token, text};
}

static void put_closers(plr_printer *p, uint32_t token) {
    while (p->closer_count && p->closers[p->closer_count - 1].token == token) {
        const char *text = p->closers[--p->closer_count].text;
        flush(p);
        put(p, text, strlen(text));
    }
}

static void print_legacy(plr_printer *p, uint32_t token, const plr_ident *ident) {
    const plr_token *t = &p->unit->lexed->tokens.items[token];
    const plr_word *word = plr_word_get(ident->word);
    uint32_t open = active_after(p, token), length;
    const plr_token *next = &p->unit->lexed->tokens.items[open];
    if (word->kinds & PLR_WORD_IS_SHADOW && next->kind == '(' && next->value != PLR_NONE &&
        p->closer_count < sizeof p->closers / sizeof p->closers[0]) {
        char text[64];
        int size = snprintf(text, sizeof text, "vec4(%s", word->replacement);
        replace_token(p, t, text, (size_t)size);
        push_closer(p, next->value, ")");
    } else if (word->kinds & (PLR_WORD_IS_SHADOW | PLR_WORD_IS_TEXTURE) && next->kind != '(') {
        copy_token(p, t); /* a local name */
    } else if (word->kinds & PLR_WORD_IS_VARIABLE && p->unit->refs[t->value]) {
        const char *text = plr_binding_text(p->l, p->unit->refs[t->value], &length);
        replace_token(p, t, text, length);
    } else {
        replace_token(p, t, word->replacement, strlen(word->replacement));
    }
}

static void print_varying(plr_printer *p, uint32_t token) {
    const plr_token *t = &p->unit->lexed->tokens.items[token];
    const plr_token *next = &p->unit->lexed->tokens.items[active_after(p, token)];
    uint16_t word = next->kind == PLR_T_IDENT ? p->unit->lexed->idents.items[next->value].word : 0;
    if (word == PLR_WORD_in || word == PLR_WORD_out)
        drop_token(p, t);
    else if (p->unit->scope->stage == PLR_VERTEX)
        replace_token(p, t, "out", 3);
    else
        replace_token(p, t, "in", 2);
}

/* Returns the token to go on with. */
static uint32_t print_special(plr_printer *p, uint32_t token) {
    const plr_token *t = &p->unit->lexed->tokens.items[token];
    const plr_ident *ident = &p->unit->lexed->idents.items[t->value];
    plr_binding *symbol = p->unit->refs[t->value];
    unsigned kinds = plr_word_get(ident->word)->kinds;
    uint32_t length;
    if (ident->flags & PLR_IF_PLUG)
        return print_plug_name(p, token);
    if (kinds & PLR_WORD_IS_SINCE && ident->flags & PLR_IF_DECLARED) {
        print_since(p, token, ident);
    } else if (t->flags & (PLR_TF_MEMBER | PLR_TF_PLAIN | PLR_TF_PARAM)) {
        copy_token(p, t);
    } else if (symbol && symbol->builtin && symbol->function) {
        if (means_own(p, symbol, token) && !(t->flags & PLR_TF_LOCAL)) {
            const char *text = plr_binding_text(p->l, symbol, &length);
            replace_token(p, t, text, length);
        } else {
            copy_token(p, t);
        }
    } else if (kinds & PLR_WORD_IS_LEGACY) {
        print_legacy(p, token, ident);
    } else if (ident->word == PLR_WORD_varying) {
        print_varying(p, token);
    } else if (ident->word == PLR_WORD_attribute) {
        replace_token(p, t, "in", 2);
    } else {
        copy_token(p, t);
    }
    return token + 1;
}

/* Returns the token to go on with. */
static uint32_t print_ident(plr_printer *p, uint32_t token) {
    const plr_token *t = &p->unit->lexed->tokens.items[token];
    uint8_t action = p->unit->actions[t->value];
    if (t->flags & PLR_TF_DROP) {
        drop_token(p, t);
        return token + 1;
    }
    plr_binding *symbol = p->unit->refs[t->value];
    if (plr_is_hidden_local(p->l, p->unit, t, symbol)) {
        const plr_ident *ident = &p->unit->lexed->idents.items[t->value];
        const char *text =
            plr_arena_format(p->l->pass, "plr%u_%.*s", (unsigned)p->unit->scope->owner,
                             (int)ident->length, ident->text);
        replace_token(p, t, text, strlen(text));
        return token + 1;
    }
    if (action == PLR_ACTION_SPECIAL)
        return print_special(p, token);
    bool plain =
        t->flags & PLR_TF_PARAM ||
        (t->flags & (PLR_TF_MEMBER | PLR_TF_PLAIN | PLR_TF_LOCAL) && !(symbol && symbol->macro));
    if (action != PLR_ACTION_NAME || plain) {
        copy_token(p, t);
    } else {
        uint32_t length;
        const char *text = plr_binding_text(p->l, symbol, &length);
        replace_token(p, t, text, length);
    }
    return token + 1;
}

/* ---- Preprocessor lines ------------------------------------------------------------------------
 */

/* A macro of the host in a condition that is kept: its value, as the program does not define it. */
static bool print_host_macro(plr_printer *p, uint32_t token) {
    uint32_t gid = plr_token_gid(p->unit, token);
    const plr_linking *l = p->l;
    const plr_macro *macro = gid < l->host_capacity ? l->hosts[gid] : NULL;
    uint32_t owner = p->unit->scope->owner;
    char number[32];
    const char *text = macro ? macro->text : NULL;
    if (owner < l->effect_count) {
        const plr_effect *effect = &l->desc->effects[owner];
        const plr_ident *ident = &l->idents.items[gid];
        for (size_t i = 0; i < effect->define_count; i++)
            if (effect->defines[i].name && strlen(effect->defines[i].name) == ident->length &&
                memcmp(effect->defines[i].name, ident->text, ident->length) == 0)
                text = effect->defines[i].value ? effect->defines[i].value : "1";
    }
    if (!text && (!macro || macro->state != PLR_MACRO_NUMBER))
        return false;
    if (!text) {
        snprintf(number, sizeof number, "%lld", (long long)macro->number);
        text = number;
    }
    put(p, " (", 2);
    put(p, text, strlen(text));
    put(p, ")", 1);
    return true;
}

/* defined (X), PLUG_USED (x), READS (m): the token after it; 0: it is none, or stays. */
static uint32_t print_query(plr_printer *p, uint32_t token, uint32_t end) {
    const plr_token *tokens = p->unit->lexed->tokens.items;
    uint16_t word = plr_token_ident(p->unit, token)->word;
    if (word != PLR_WORD_defined && word != PLR_WORD_PLUG_USED && word != PLR_WORD_READS)
        return 0;
    bool parens = token + 1 < end && tokens[token + 1].kind == '(';
    uint32_t name = token + 1 + parens;
    if (name >= end || tokens[name].kind != PLR_T_IDENT)
        return 0;
    uint32_t gid = plr_token_gid(p->unit, name);
    bool known = true, value = false;
    if (word == PLR_WORD_defined) {
        value = known = gid < p->l->host_capacity && p->l->hosts[gid];
    } else {
        value = p->l->all || (word == PLR_WORD_READS ? p->l->reads : p->l->used)[gid];
    }
    if (!known)
        return 0;
    put(p, value ? " 1" : " 0", 2);
    return name + 1 + parens;
}

static void print_condition(plr_printer *p, const plr_directive *directive) {
    const plr_token *tokens = p->unit->lexed->tokens.items;
    for (uint32_t i = directive->token + 1; i < directive->end;) {
        const plr_token *token = &tokens[i];
        uint32_t length, next = 0;
        if (token->kind == PLR_T_IDENT) {
            next = print_query(p, i, directive->end);
            plr_binding *symbol = p->unit->refs[token->value];
            if (!next && !symbol && print_host_macro(p, i))
                next = i + 1;
            if (!next && symbol && symbol->macro) {
                const char *text = plr_binding_text(p->l, symbol, &length);
                put(p, " ", 1);
                put(p, text, length);
                next = i + 1;
            }
        }
        if (!next) {
            size_t size;
            const char *text = printable_text(p, token, &size);
            const plr_token *before = token - 1;
            if (i == directive->token + 1 || before->offset + before->length != token->offset)
                put(p, " ", 1);
            put(p, text, size);
            next = i + 1;
        }
        i = next;
    }
}

/* Whether only splices stand between two tokens. */
static bool only_splices(const plr_printer *p, uint32_t begin, uint32_t end) {
    for (uint32_t i = begin; i < end; i++) {
        char c = p->unit->lexed->text[i];
        if (c != '\\' && c != '\r' && c != '\n')
            return false;
    }
    return true;
}

static void print_directive_tokens(plr_printer *p, const plr_directive *directive) {
    const plr_token *tokens = p->unit->lexed->tokens.items;
    for (uint32_t i = directive->token + 1; i < directive->end;) {
        const plr_token *token = &tokens[i];
        if (token->flags & PLR_TF_GAP && !p->fresh) {
            flush(p);
            if (!only_splices(p, p->last, token->offset))
                put(p, " ", 1);
            p->fresh = true;
        }
        uint32_t first = i;
        if (token->kind == PLR_T_IDENT) {
            i = print_ident(p, i);
        } else {
            copy_token(p, token);
            i++;
        }
        for (; first < i; first++)
            put_closers(p, first);
    }
    flush(p);
}

static void print_directive(plr_printer *p, uint32_t at) {
    const plr_lexed *lexed = p->unit->lexed;
    const plr_token *token = &lexed->tokens.items[at];
    const plr_directive *directive = &lexed->directives.items[token->value];
    const plr_activity *activity = p->unit->activity;
    static const char *const heads[] = {[PLR_KEPT_IF] = "#if",
                                        [PLR_KEPT_ELIF] = "#elif",
                                        [PLR_KEPT_ELSE] = "#else",
                                        [PLR_KEPT_ENDIF] = "#endif"};
    uint8_t kept = activity ? activity->kept[token->value] : PLR_KEPT_AS_IS;
    p->broken = true;
    flush(p);
    if (kept == PLR_KEPT_NO || directive->kind == PLR_D_DROP || directive->kind == PLR_D_VERSION ||
        directive->kind == PLR_D_EXTENSION)
        return;
    plr_print_newline(p);
    add_run(p, p->unit->number, token->offset | PLR_RUN_FIXED);
    if (kept == PLR_KEPT_AS_IS) {
        put(p, "#", 1);
        put(p, lexed->text + token->offset + token->length - token->count, token->count);
        put(p, " ", 1);
        p->fresh = true;
        p->broken = false;
        p->last = directive->token + 1 < directive->end ? lexed->tokens.items[at + 1].offset : 0;
        print_directive_tokens(p, directive);
    } else {
        bool name_only = directive->kind == PLR_D_IFDEF || directive->kind == PLR_D_IFNDEF;
        put(p, heads[kept], strlen(heads[kept]));
        if (kept == PLR_KEPT_IF && name_only)
            put(p, directive->kind == PLR_D_IFDEF ? "def" : "ndef",
                directive->kind == PLR_D_IFDEF ? 3 : 4);
        if (kept == PLR_KEPT_IF || kept == PLR_KEPT_ELIF)
            print_condition(p, directive);
    }
    put(p, "\n", 1);
    p->fresh = false;
    p->broken = true;
    p->last = token->offset;
}

/* ---- Plugs -------------------------------------------------------------------------------------
 */

/* The token after the statement that begins at `i`. */
static uint32_t statement_end(const plr_printer *p, uint32_t i, unsigned depth) {
    const plr_lexed *lexed = p->unit->lexed;
    const plr_token *tokens = lexed->tokens.items;
    while (tokens[i].kind != PLR_T_END) {
        const plr_token *t = &tokens[i];
        uint16_t word = t->kind == PLR_T_IDENT ? lexed->idents.items[t->value].word : 0;
        bool bracket = (t->kind == '(' || t->kind == '[' || t->kind == '{') && t->value != PLR_NONE;
        if (t->kind == '{' && bracket)
            return t->value + 1;
        if (t->kind == ';')
            return i + 1;
        if (t->kind == '}')
            return i;
        if ((word == PLR_WORD_if || word == PLR_WORD_for || word == PLR_WORD_while ||
             word == PLR_WORD_switch) &&
            depth < 32) {
            uint32_t open = active_after(p, i);
            if (tokens[open].kind != '(' || tokens[open].value == PLR_NONE)
                return i;
            uint32_t end = statement_end(
                p, plr_active(lexed, p->unit->activity, tokens[open].value + 1), depth + 1);
            uint32_t next = plr_active(lexed, p->unit->activity, end);
            if (word == PLR_WORD_if && tokens[next].kind == PLR_T_IDENT &&
                lexed->idents.items[tokens[next].value].word == PLR_WORD_else)
                return statement_end(p, active_after(p, next), depth + 1);
            return end;
        }
        i = plr_active(lexed, p->unit->activity, bracket ? t->value + 1 : i + 1);
    }
    return i;
}

static void print_calls(plr_printer *p, plr_socket *socket, const char *head, const char *tail) {
    const plr_lexed *lexed = p->unit->lexed;
    flush(p);
    for (size_t i = 0; i < socket->calls.count; i++) {
        const plr_call *call = &socket->calls.items[i];
        const plr_list *list = &lexed->lists.items[call->list];
        uint32_t index = (uint32_t)p->calls.count;
        *PLR_PUSH(p->l->arena, &p->calls) = (plr_written_call){socket, call->function};
        plr_print_newline(p);
        add_run(p, PLR_RUN_CALL + index, 0);
        size_t runs = p->runs.count;
        put_indent(p, socket->plug->offset);
        if (i == 0)
            put(p, head, strlen(head));
        put(p, call->function->text, call->function->length);
        put(p, "(", 1);
        for (uint32_t t = list->first; t < list->end;) {
            p->fresh = true;
            p->broken = false;
            const plr_token *token = &lexed->tokens.items[t];
            if (t > list->first && token[-1].offset + token[-1].length < token->offset)
                put(p, " ", 1);
            t = token->kind == PLR_T_IDENT ? print_ident(p, t) : (copy_token(p, token), t + 1);
            flush(p);
            put_closers(p, t - 1);
        }
        put(p, ");", 2);
        if (i + 1 == socket->calls.count)
            put(p, tail, strlen(tail));
        p->runs.count = runs; /* the whole line stands for the call */
        put(p, "\n", 1);
    }
    p->fresh = false;
    p->broken = true;
    p->before = ';';
}

typedef enum behind {
    BEHIND_STATEMENT,
    BEHIND_HEADER, /* if (x), else, do, ...: the plug is, or begins, the statement */
    BEHIND_EXPRESSION
} behind;

static behind stands_behind(const plr_printer *p) {
    const plr_token *tokens = p->unit->lexed->tokens.items;
    uint32_t last = p->last_token;
    if (p->before == ';' || p->before == '{' || p->before == '}' || p->before == ':')
        return BEHIND_STATEMENT;
    if (p->before == ')')
        last = tokens[last].kind == ')' && tokens[last].value != PLR_NONE && tokens[last].value > 0
                   ? tokens[last].value - 1
                   : last;
    uint16_t word = tokens[last].kind == PLR_T_IDENT ? plr_token_ident(p->unit, last)->word : 0;
    bool header = p->before == ')' ? word == PLR_WORD_if || word == PLR_WORD_for ||
                                         word == PLR_WORD_while || word == PLR_WORD_switch
                                   : word == PLR_WORD_else || word == PLR_WORD_do;
    return header ? BEHIND_HEADER : BEHIND_EXPRESSION;
}

/* The calls of a plug; behind `if (x)`, `else` and the like they are one statement with what
 * follows. Returns the token to go on with. */
static uint32_t print_plug(plr_printer *p, uint32_t at) {
    const plr_lexed *lexed = p->unit->lexed;
    const plr_plug *plug = &lexed->plugs.items[lexed->tokens.items[at].value];
    plr_socket *socket = p->unit->sockets[lexed->tokens.items[at].value];
    if (!socket || socket->calls.count == 0)
        return plug->end;
    if (stands_behind(p) == BEHIND_STATEMENT || p->inside) {
        print_calls(p, socket, "", "");
        p->last = plug->offset;
        return plug->end;
    }
    p->last = plug->offset;
    if (stands_behind(p) == BEHIND_EXPRESSION) {
        p->inside = socket; /* the calls come when the statement ends */
        p->inside_of = ';';
        return plug->end;
    }
    uint32_t next = plr_active(lexed, p->unit->activity, plug->end);
    uint8_t follows = lexed->tokens.items[next].kind;
    if (follows == '{') {
        p->inside = socket;
        p->inside_of = '{';
    } else if (follows == ';') {
        print_calls(p, socket, "{ ", " }");
        p->last = lexed->tokens.items[next].offset + 1;
        p->before = '}';
        return next + 1;
    } else {
        uint32_t end = statement_end(p, next, 0);
        print_calls(p, socket, "{ ", "");
        push_closer(p, end - 1, " }");
    }
    p->last = plug->offset;
    return plug->end;
}

/* ---- Ranges ------------------------------------------------------------------------------------
 */

static void put_tokens(plr_printer *p, uint32_t first, uint32_t end) {
    const plr_unit *unit = p->unit;
    const plr_token *tokens = unit->lexed->tokens.items;
    for (uint32_t i = first; i < end;) {
        const plr_token *token = &tokens[i];
        uint32_t from = i;
        if (token->kind == PLR_T_IDENT) {
            if (unit->actions[token->value] == PLR_ACTION_COPY &&
                !(token->flags & (PLR_TF_DROP | PLR_TF_LOCAL)))
                copy_token(p, token), i++;
            else
                i = print_ident(p, i);
        } else if (token->kind == PLR_T_DIRECTIVE) {
            print_directive(p, i);
            i = unit->activity ? unit->activity->next[token->value]
                               : unit->lexed->directives.items[token->value].end;
            continue;
        } else if (token->kind == PLR_T_PLUG) {
            i = print_plug(p, i);
            continue;
        } else if (token->kind == PLR_T_DECLARATIONS) {
            i++;
            continue;
        } else {
            copy_token(p, token);
            i++;
            if (p->inside && token->kind == p->inside_of) {
                plr_socket *socket = p->inside;
                p->inside = NULL;
                print_calls(p, socket, "", "");
                p->last = token->offset + 1;
            }
        }
        for (; p->closer_count && from < i; from++)
            put_closers(p, from);
    }
}

void plr_print_range(plr_printer *p, plr_node *node, uint32_t first, uint32_t end) {
    p->node = node;
    p->unit = node->unit;
    p->fresh = true;
    p->broken = false;
    p->begin = p->end = p->last = 0;
    p->before = ';';
    p->inside = NULL;
    p->closer_count = 0;
    put_tokens(p, first, end);
    flush(p);
}

void plr_print_line_end(plr_printer *p, const char *text) {
    flush(p);
    put(p, text, strlen(text));
    put(p, "\n", 1);
}

void plr_print_extensions(plr_printer *p, plr_node *node) {
    const plr_lexed *lexed = node->unit->lexed;
    const plr_activity *activity = node->unit->activity;
    p->node = node;
    p->unit = node->unit;
    for (uint32_t i = node->item->first; i < node->item->end;) {
        const plr_token *token = &lexed->tokens.items[i];
        if (token->kind != PLR_T_DIRECTIVE) {
            i++;
            continue;
        }
        const plr_directive *directive = &lexed->directives.items[token->value];
        if (directive->kind == PLR_D_EXTENSION) {
            add_run(p, p->unit->number, token->offset | PLR_RUN_FIXED);
            put(p, "#extension", 10);
            print_condition(p, directive);
            put(p, "\n", 1);
        } else if (activity && activity->kept[token->value] > PLR_KEPT_AS_IS) {
            print_directive(p, i);
        }
        i = activity ? activity->next[token->value] : directive->end;
    }
}
