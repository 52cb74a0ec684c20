/* Whether two declarations say the same. */
#include "plugs/link.h"

#include <string.h>

bool plr_same_tokens(const plr_unit *a, uint32_t a_first, uint32_t a_end, const plr_unit *b,
                     uint32_t b_first, uint32_t b_end) {
    uint32_t i = plr_active(a->lexed, a->activity, a_first);
    uint32_t k = plr_active(b->lexed, b->activity, b_first);
    while (i < a_end && k < b_end) {
        size_t a_length, b_length;
        const plr_token *ta = &a->lexed->tokens.items[i], *tb = &b->lexed->tokens.items[k];
        const char *a_text = plr_token_text(a->lexed, ta, &a_length);
        const char *b_text = plr_token_text(b->lexed, tb, &b_length);
        if (ta->kind != tb->kind || a_length != b_length || memcmp(a_text, b_text, a_length) != 0)
            return false;
        i = plr_active(a->lexed, a->activity, i + 1);
        k = plr_active(b->lexed, b->activity, k + 1);
    }
    return i >= a_end && k >= b_end;
}

bool plr_same_item(const plr_unit *a, const plr_item *x, const plr_unit *b, const plr_item *y) {
    if (x->kind == PLR_ITEM_MACRO && y->kind == PLR_ITEM_MACRO) {
        const plr_lexed *la = a->lexed, *lb = b->lexed;
        bool same_kind = la->directives.items[la->tokens.items[x->first].value].kind ==
                         lb->directives.items[lb->tokens.items[y->first].value].kind;
        return same_kind && plr_same_tokens(a, x->first + 1, x->end, b, y->first + 1, y->end);
    }
    return x->kind == y->kind &&
           plr_same_tokens(a, x->prefix, x->prefix_end, b, y->prefix, y->prefix_end) &&
           plr_same_tokens(a, x->first, x->end, b, y->first, y->end);
}

/* The next token of a type, less layout, precision and interpolation; storage in today's words. */
static uint32_t next_of_type(const plr_unit *unit, uint32_t i, uint32_t end) {
    const plr_lexed *lexed = unit->lexed;
    for (i = plr_active(lexed, unit->activity, i); i < end;
         i = plr_active(lexed, unit->activity, i + 1)) {
        const plr_token *token = &lexed->tokens.items[i];
        if (token->kind == PLR_T_IDENT) {
            uint16_t word = lexed->idents.items[token->value].word;
            if (word == PLR_WORD_layout) {
                uint32_t open = plr_active(lexed, unit->activity, i + 1);
                if (open < end && lexed->tokens.items[open].kind == '(' &&
                    lexed->tokens.items[open].value != PLR_NONE)
                    i = lexed->tokens.items[open].value;
                continue;
            }
            if (word != PLR_WORD_uniform && word != PLR_WORD_const &&
                (plr_word_get(word)->kinds & PLR_WORD_IS_QUALIFIER))
                continue;
        }
        return i;
    }
    return end;
}

static bool same_type_tokens(const plr_unit *a, uint32_t a_first, uint32_t a_end, const plr_unit *b,
                             uint32_t b_first, uint32_t b_end) {
    uint32_t i = next_of_type(a, a_first, a_end), k = next_of_type(b, b_first, b_end);
    while (i < a_end && k < b_end) {
        if (!plr_same_tokens(a, i, i + 1, b, k, k + 1))
            return false;
        i = next_of_type(a, i + 1, a_end);
        k = next_of_type(b, k + 1, b_end);
    }
    return i >= a_end && k >= b_end;
}

/* The end of a declarator's type: its initialiser. */
static uint32_t declarator_end(const plr_unit *unit, const plr_item *item) {
    for (uint32_t i = item->first; i < item->end; i++)
        if (unit->lexed->tokens.items[i].kind == '=')
            return i;
    return item->end;
}

bool plr_same_type(const plr_unit *a, const plr_item *x, const plr_unit *b, const plr_item *y) {
    if (x->kind != PLR_ITEM_VARIABLE || y->kind != PLR_ITEM_VARIABLE)
        return plr_same_item(a, x, b, y);
    return same_type_tokens(a, x->prefix, x->prefix_end, b, y->prefix, y->prefix_end) &&
           plr_same_tokens(a, x->first, declarator_end(a, x), b, y->first, declarator_end(b, y));
}

static uint32_t parameter_type(const plr_unit *unit, uint32_t i, uint32_t end) {
    i = next_of_type(unit, i, end);
    while (i < end && unit->lexed->tokens.items[i].kind == PLR_T_IDENT &&
           plr_token_ident(unit, i)->word == PLR_WORD_const)
        i = next_of_type(unit, i + 1, end);
    return i;
}

/* Whether two functions have parameters of the same types: the words of each less the last. */
bool plr_same_signature(const plr_unit *a, const plr_name *x, const plr_unit *b,
                        const plr_name *y) {
    if (x->parameters != y->parameters)
        return false;
    const plr_token *ta = a->lexed->tokens.items, *tb = b->lexed->tokens.items;
    uint32_t i = x->open + 1, k = y->open + 1;
    while (i < x->close && k < y->close) {
        uint32_t i_end = i, k_end = k;
        while (i_end < x->close && ta[i_end].kind != ',')
            i_end++;
        while (k_end < y->close && tb[k_end].kind != ',')
            k_end++;
        uint32_t i_type = parameter_type(a, i, i_end), k_type = parameter_type(b, k, k_end);
        if (i_type < i_end && k_type < k_end && ta[i_type].kind == PLR_T_IDENT &&
            !plr_same_tokens(a, i_type, i_type + 1, b, k_type, k_type + 1))
            return false;
        i = i_end + 1;
        k = k_end + 1;
    }
    return true;
}
