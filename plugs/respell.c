/* Identifiers in the program: new names of scopes, today's words for old ones. */
#include "plugs/printer.h"

#include <stdio.h>
#include <string.h>

uint32_t plr_active_after(const plr_printer *p, uint32_t token) {
    return plr_active(p->unit->lexed, p->unit->activity, token + 1);
}

static uint8_t kind_after(const plr_printer *p, uint32_t token) {
    return p->unit->lexed->tokens.items[plr_active_after(p, token)].kind;
}

static const plr_function *defined_here(const plr_printer *p, uint32_t token) {
    for (const plr_function *f = p->node->function; f && f->node == p->node; f = f->next)
        if (f->name->token == token)
            return f;
    return NULL;
}

/* PLUG_x (...) ; that means several functions: a block of calls. Returns the token to go on with.
 */
static uint32_t print_sequence(plr_printer *p, uint32_t token, plr_function **found, size_t count) {
    const plr_token *tokens = p->unit->lexed->tokens.items;
    uint32_t open = plr_active_after(p, token), close = tokens[open].value;
    uint32_t semicolon = plr_active(p->unit->lexed, p->unit->activity, close + 1);
    plr_put_gap(p, tokens[token].offset);
    p->begin = p->end = 0;
    plr_put(p, "{ ", 2);
    for (size_t i = 0; i < count; i++) {
        plr_add_run(p, p->unit->number, tokens[token].offset | PLR_RUN_FIXED);
        plr_put(p, found[i]->text, found[i]->length);
        p->fresh = true;
        p->broken = false;
        plr_put_tokens(p, open, close + 1);
        plr_flush(p);
        plr_put(p, "; ", 2);
    }
    plr_put(p, "}", 1);
    p->fresh = p->broken = false;
    plr_end_token(p, &tokens[semicolon]);
    return semicolon + 1;
}

static uint32_t print_plug_name(plr_printer *p, uint32_t token) {
    const plr_token *tokens = p->unit->lexed->tokens.items;
    const plr_function *own = defined_here(p, token);
    plr_function *found[64];
    size_t count = own ? 0 : plr_direct_functions(p->l, p->unit, token, found, 64);
    uint32_t open = plr_active_after(p, token);
    bool whole = p->before == ';' || p->before == '{' || p->before == '}' || p->before == ')' ||
                 p->before == ':';
    if (count > 1 && whole && tokens[open].kind == '(' && tokens[open].value != PLR_NONE &&
        kind_after(p, tokens[open].value) == ';')
        return print_sequence(p, token, found, count);
    const plr_function *f = own ? own : count ? found[0] : NULL;
    if (own && (own->twin ? own->twin : own)->guarded)
        plr_push_closer(p, plr_function_end(p->unit, own->name),
                        plr_arena_format(p->l->pass, "\n#define " PLR_HAS "%s\n", own->text));
    if (f)
        plr_replace_token(p, &tokens[token], f->text, f->length);
    else
        plr_copy_token(p, &tokens[token]);
    return token + 1;
}

/* A function with the name of a built-in one: only calls that fit its own definitions mean it. */
static bool means_own(const plr_printer *p, const plr_binding *symbol, uint32_t token) {
    uint32_t next = plr_active_after(p, token);
    const plr_token *open = &p->unit->lexed->tokens.items[next];
    if (open->kind != '(')
        return symbol->variable || symbol->macro;
    for (const plr_definition *d = symbol->definitions; d; d = d->next)
        if (d->name->kind == PLR_ITEM_MACRO ||
            (d->name->kind == PLR_ITEM_FUNCTION && d->name->parameters == open->count))
            return true;
    return false;
}

/* `texture` in "#define texture2D texture". */
static bool is_alias(const plr_printer *p, uint32_t token) {
    const plr_item *item = p->node->item;
    return item->kind == PLR_ITEM_MACRO && token > item->first + 1 &&
           plr_word_get(plr_token_ident(p->unit, item->first + 1)->word)->kinds &
               (PLR_WORD_IS_TEXTURE | PLR_WORD_IS_SHADOW);
}

static void print_since(plr_printer *p, uint32_t token, const plr_ident *ident) {
    const plr_token *t = &p->unit->lexed->tokens.items[token];
    plr_binding *symbol = p->unit->refs[t->value];
    bool builtin = (plr_word_get(ident->word)->kinds & PLR_WORD_IS_BUILTIN) != 0;
    uint32_t length;
    if (builtin && (kind_after(p, token) == '(' || is_alias(p, token)) &&
        !(symbol && (symbol->function || symbol->macro) && means_own(p, symbol, token))) {
        plr_copy_token(p, t);
    } else if (symbol && !(t->flags & (PLR_TF_MEMBER | PLR_TF_PLAIN))) {
        const char *text = plr_binding_text(p->l, symbol, &length);
        plr_replace_token(p, t, text, length);
    } else {
        char text[64];
        int size = snprintf(text, sizeof text, "plr_%.*s", (int)ident->length, ident->text);
        plr_replace_token(p, t, text, (size_t)size);
    }
}

void plr_push_closer(plr_printer *p, uint32_t token, const char *text) {
    if (p->closer_count < sizeof p->closers / sizeof p->closers[0])
        p->closers[p->closer_count++] = (plr_closer){token, text};
}

void plr_put_closers(plr_printer *p, uint32_t token) {
    while (p->closer_count && p->closers[p->closer_count - 1].token == token) {
        const char *text = p->closers[--p->closer_count].text;
        plr_flush(p);
        plr_put(p, text, strlen(text));
    }
}

static void print_legacy(plr_printer *p, uint32_t token, const plr_ident *ident) {
    const plr_token *t = &p->unit->lexed->tokens.items[token];
    const plr_word *word = plr_word_get(ident->word);
    uint32_t open = plr_active_after(p, token), length;
    const plr_token *next = &p->unit->lexed->tokens.items[open];
    if (word->kinds & PLR_WORD_IS_SHADOW && next->kind == '(' && next->value != PLR_NONE &&
        p->closer_count < sizeof p->closers / sizeof p->closers[0]) {
        char text[64];
        int size = snprintf(text, sizeof text, "vec4(%s", word->replacement);
        plr_replace_token(p, t, text, (size_t)size);
        plr_push_closer(p, next->value, ")");
    } else if (word->kinds & PLR_WORD_IS_NOTHING) {
        plr_drop_token(p, t);
    } else if (word->kinds & PLR_WORD_IS_INPUT) {
        plr_replace_token(p, t, word->replacement, strlen(word->replacement));
        if (next->kind == '[' && next->value != PLR_NONE)
            plr_push_closer(p, next->value, ".gl_Position");
    } else if (word->kinds & (PLR_WORD_IS_SHADOW | PLR_WORD_IS_TEXTURE) && next->kind != '(') {
        plr_copy_token(p, t); /* a local name */
    } else if (word->kinds & PLR_WORD_IS_VARIABLE && p->unit->refs[t->value]) {
        const char *text = plr_binding_text(p->l, p->unit->refs[t->value], &length);
        plr_replace_token(p, t, text, length);
    } else {
        plr_replace_token(p, t, word->replacement, strlen(word->replacement));
    }
}

static void print_varying(plr_printer *p, uint32_t token) {
    const plr_token *t = &p->unit->lexed->tokens.items[token];
    const plr_token *next = &p->unit->lexed->tokens.items[plr_active_after(p, token)];
    uint16_t word = next->kind == PLR_T_IDENT ? p->unit->lexed->idents.items[next->value].word : 0;
    if (word == PLR_WORD_in || word == PLR_WORD_out)
        plr_drop_token(p, t);
    else if (p->unit->scope->stage == PLR_VERTEX)
        plr_replace_token(p, t, "out", 3);
    else
        plr_replace_token(p, t, "in", 2);
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
        plr_copy_token(p, t);
    } else if (symbol && symbol->builtin && symbol->function) {
        if (means_own(p, symbol, token) && !(t->flags & PLR_TF_LOCAL)) {
            const char *text = plr_binding_text(p->l, symbol, &length);
            plr_replace_token(p, t, text, length);
        } else {
            plr_copy_token(p, t);
        }
    } else if (kinds & PLR_WORD_IS_LEGACY) {
        print_legacy(p, token, ident);
    } else if (ident->word == PLR_WORD_varying) {
        print_varying(p, token);
    } else if (ident->word == PLR_WORD_attribute) {
        plr_replace_token(p, t, "in", 2);
    } else {
        plr_copy_token(p, t);
    }
    return token + 1;
}

/* Returns the token to go on with. */
uint32_t plr_print_ident(plr_printer *p, uint32_t token) {
    const plr_token *t = &p->unit->lexed->tokens.items[token];
    uint8_t action = p->unit->actions[t->value];
    if (t->flags & PLR_TF_DROP) {
        plr_drop_token(p, t);
        return token + 1;
    }
    plr_binding *symbol = p->unit->refs[t->value];
    if (plr_is_hidden_local(p->l, p->unit, t, symbol)) {
        const plr_ident *ident = &p->unit->lexed->idents.items[t->value];
        const char *text =
            plr_arena_format(p->l->pass, "plr%u_%.*s", (unsigned)p->unit->scope->owner,
                             (int)ident->length, ident->text);
        plr_replace_token(p, t, text, strlen(text));
        return token + 1;
    }
    if (action == PLR_ACTION_SPECIAL)
        return print_special(p, token);
    bool plain = t->flags & PLR_TF_PARAM || plr_is_plain(p->unit, t, symbol);
    if (action != PLR_ACTION_NAME || plain) {
        plr_copy_token(p, t);
    } else {
        uint32_t length;
        const char *text = plr_binding_text(p->l, symbol, &length);
        plr_replace_token(p, t, text, length);
    }
    return token + 1;
}
