#include "plugs/items.h"
#include "plugs/mark.h"

#define MAX_KEPT_DEPTH 256

typedef struct cutter {
    plr_arena *arena;
    const plr_lexed *lexed;
    const plr_token *tokens;
    const plr_activity *activity;
    plr_cut *cut;
    uint32_t at;
    /* Conditionals that are kept: how many are open, and the brackets open at each #if. */
    uint32_t kept;
    uint32_t depth, depths[MAX_KEPT_DEPTH];
    /* The group that is open, if kept > 0 at file scope. */
    bool grouping;
    uint32_t group_first, group_names, group_plugs;
    uint32_t plugs_before;
} cutter;

static const plr_directive *directive_of(const plr_lexed *lexed, uint32_t token) {
    return &lexed->directives.items[lexed->tokens.items[token].value];
}

static uint32_t after_directive(const plr_lexed *lexed, const plr_activity *activity,
                                uint32_t token) {
    return activity ? activity->next[lexed->tokens.items[token].value]
                    : directive_of(lexed, token)->end;
}

uint32_t plr_active(const plr_lexed *lexed, const plr_activity *activity, uint32_t i) {
    for (;;) {
        const plr_token *token = &lexed->tokens.items[i];
        if (token->kind == PLR_T_DIRECTIVE)
            i = after_directive(lexed, activity, i);
        else if (token->kind == PLR_T_PLUG)
            i = lexed->plugs.items[token->value].end;
        else if (token->kind == PLR_T_DECLARATIONS)
            i++;
        else
            return i;
    }
}

static uint16_t word_at(const cutter *c, uint32_t i) {
    const plr_token *token = &c->tokens[i];
    return token->kind == PLR_T_IDENT ? c->lexed->idents.items[token->value].word : PLR_WORD_NONE;
}

static void add_fault(cutter *c, plr_code code, uint32_t token, const char *message) {
    *PLR_PUSH(c->arena, &c->cut->faults) = (plr_fault){code, c->tokens[token].offset, message};
}

/* A kept branch restores the brackets that were open before its #if. */
static void pass_kept(cutter *c, plr_kept kept, uint32_t token) {
    if (kept == PLR_KEPT_IF) {
        if (c->kept == MAX_KEPT_DEPTH)
            add_fault(c, PLR_CODE_LIMIT, token, "conditionals are nested too deeply");
        else
            c->depths[c->kept] = c->depth;
        c->kept += c->kept < MAX_KEPT_DEPTH;
    } else if (kept == PLR_KEPT_ELIF || kept == PLR_KEPT_ELSE) {
        if (c->kept)
            c->depth = c->depths[c->kept - 1];
    } else if (kept == PLR_KEPT_ENDIF && c->kept) {
        c->kept--;
    }
}

static plr_name *add_name(cutter *c, plr_name name) {
    plr_name *added = PLR_PUSH(c->arena, &c->cut->names);
    *added = name;
    return added;
}

/* A directive inside an item: a macro that it defines is a name of the item. */
static void pass_directive(cutter *c) {
    const plr_directive *directive = directive_of(c->lexed, c->at);
    uint32_t index = c->tokens[c->at].value;
    if (c->activity && c->activity->kept[index] > PLR_KEPT_AS_IS)
        pass_kept(c, (plr_kept)c->activity->kept[index], c->at);
    else if (directive->kind == PLR_D_DEFINE && directive->token + 1 < directive->end &&
             c->tokens[directive->token + 1].kind == PLR_T_IDENT)
        add_name(c, (plr_name){.token = directive->token + 1,
                               .kind = PLR_ITEM_MACRO,
                               .inner = true,
                               .inner_body = true});
    else if (directive->kind == PLR_D_VERSION)
        *PLR_PUSH(c->arena, &c->cut->versions) = index;
    else if (directive->kind == PLR_D_EXTENSION)
        *PLR_PUSH(c->arena, &c->cut->extensions) = index;
    c->at = after_directive(c->lexed, c->activity, c->at);
}

/* Steps over directives, plugs and marks to the next token of the item. */
static void settle(cutter *c, bool in_body, uint32_t parens) {
    for (;;) {
        const plr_token *token = &c->tokens[c->at];
        if (token->kind == PLR_T_DIRECTIVE) {
            pass_directive(c);
        } else if (token->kind == PLR_T_PLUG) {
            if (in_body && parens == 0)
                *PLR_PUSH(c->arena, &c->cut->plugs) = token->value;
            else
                *PLR_PUSH(c->arena, &c->cut->warnings) =
                    (plr_fault){PLR_CODE_PLUG_SYNTAX, token->offset,
                                in_body ? "a plug inside parentheses can call nothing"
                                        : "a plug outside a function can call nothing"};
            c->at = c->lexed->plugs.items[token->value].end;
        } else if (token->kind == PLR_T_DECLARATIONS) {
            c->at++;
        } else {
            return;
        }
    }
}

/* Steps over a bracketed text; the scan stands at its opening. False: the text ends first. */
static bool pass_brackets(cutter *c, bool is_body) {
    uint32_t base = c->depth, parens = 0;
    do {
        uint8_t kind = c->tokens[c->at].kind;
        if (kind == PLR_T_END)
            return false;
        if (kind == '{' || (!is_body && (kind == '(' || kind == '[')))
            c->depth++;
        else if (kind == '}' || (!is_body && (kind == ')' || kind == ']')))
            c->depth -= c->depth > 0;
        if (is_body && kind == '(')
            parens++;
        else if (is_body && (kind == ')' || kind == ';' || kind == '{' || kind == '}') &&
                 parens > 0)
            parens = kind == ')' ? parens - 1 : kind == ';' ? parens : 0;
        c->at++;
        if (c->depth <= base)
            return true;
        settle(c, is_body, parens);
    } while (true);
}

/* Steps to behind the `;` or the block that ends what is not recognised. */
static void pass_unknown(cutter *c) {
    for (;;) {
        settle(c, false, 0);
        uint8_t kind = c->tokens[c->at].kind;
        if (kind == PLR_T_END)
            return;
        if (kind == '{' || kind == '(' || kind == '[') {
            if (!pass_brackets(c, false))
                return;
            if (kind == '{') {
                settle(c, false, 0);
                if (c->tokens[c->at].kind == ';')
                    c->at++;
                return;
            }
            continue;
        }
        c->at++;
        if (kind == ';' || kind == '}')
            return;
    }
}

/* ---- Recording ---------------------------------------------------------------------------------
 */

/* Ends an item at the scan; inside a kept conditional it becomes a part of the group. */
static void add_item(cutter *c, plr_item item, uint32_t names_before) {
    if (c->grouping) {
        for (size_t i = names_before; i < c->cut->names.count; i++)
            c->cut->names.items[i].inner = true;
        return;
    }
    item.names = names_before;
    item.name_count = (uint32_t)c->cut->names.count - names_before;
    item.plugs = c->plugs_before;
    item.plug_count = (uint32_t)c->cut->plugs.count - c->plugs_before;
    *PLR_PUSH(c->arena, &c->cut->items) = item;
}

static void begin_group(cutter *c, uint32_t first, uint32_t names, uint32_t plugs) {
    c->grouping = true;
    c->group_first = first;
    c->group_names = names;
    c->group_plugs = plugs;
}

static void end_group(cutter *c) {
    c->grouping = false;
    c->plugs_before = c->group_plugs;
    for (size_t i = c->group_names; i < c->cut->names.count; i++)
        c->cut->names.items[i].inner = true;
    add_item(c, (plr_item){.kind = PLR_ITEM_GROUP, .first = c->group_first, .end = c->at},
             c->group_names);
}

/* An item that began outside a kept conditional and ends inside one makes the whole a group. */
static void end_item(cutter *c, plr_item item, uint32_t names_before) {
    if (!c->grouping && c->kept > 0)
        begin_group(c, item.prefix_end > item.prefix ? item.prefix : item.first, names_before,
                    c->plugs_before);
    add_item(c, item, names_before);
    if (c->grouping && c->kept == 0)
        end_group(c);
}

/* ---- Declarations ------------------------------------------------------------------------------
 */

static uint8_t qualifier_bit(uint16_t word) {
    switch (word) {
    case PLR_WORD_uniform:
        return PLR_Q_UNIFORM;
    case PLR_WORD_in:
        return PLR_Q_IN;
    case PLR_WORD_out:
        return PLR_Q_OUT;
    case PLR_WORD_const:
        return PLR_Q_CONST;
    case PLR_WORD_varying:
        return PLR_Q_VARYING;
    case PLR_WORD_attribute:
        return PLR_Q_ATTRIBUTE;
    case PLR_WORD_buffer:
        return PLR_Q_BUFFER;
    default:
        return 0;
    }
}

typedef struct header {
    uint32_t first, type, name; /* PLR_NONE where there is none */
    uint8_t qualifiers;
    uint32_t words; /* identifiers that are no qualifiers, outside brackets */
    bool is_struct, is_precision;
} header;

static void read_word(cutter *c, header *h) {
    uint16_t word = word_at(c, c->at);
    const plr_ident *ident = &c->lexed->idents.items[c->tokens[c->at].value];
    bool declared = (ident->flags & PLR_IF_DECLARED) != 0;
    if (word == PLR_WORD_precision)
        h->is_precision = true;
    else if (word == PLR_WORD_struct)
        h->is_struct = true;
    if (!declared && (plr_word_get(word)->kinds & PLR_WORD_IS_QUALIFIER)) {
        h->qualifiers |= qualifier_bit(word);
        return;
    }
    if (declared && h->words == 0 && !h->is_struct &&
        plr_word_get(word)->kinds & PLR_WORD_IS_QUALIFIER) {
        h->qualifiers |= qualifier_bit(word);
        return;
    }
    if (word == PLR_WORD_struct)
        return;
    h->words++;
    if (h->words == 1)
        h->type = c->at;
    h->name = c->at;
}

/* Reads up to the token that tells what is declared, and returns its kind. */
static uint8_t read_header(cutter *c, header *h) {
    *h = (header){c->at, PLR_NONE, PLR_NONE, 0, 0, false, false};
    for (;; settle(c, false, 0)) {
        uint8_t kind = c->tokens[c->at].kind;
        if (kind == PLR_T_IDENT) {
            read_word(c, h);
            c->at++;
        } else if ((kind == '(' && h->words == 0) || (kind == '[' && h->words == 1)) {
            if (!pass_brackets(c, false)) /* layout (...), float[3] */
                return PLR_T_END;
        } else {
            return kind;
        }
    }
}

/* The parameters between parentheses, as far as their text is active. */
static uint16_t count_parameters(const cutter *c, uint32_t open, uint32_t close) {
    if (!c->activity)
        return c->tokens[open].count;
    uint32_t count = 0, depth = 0, words = 0;
    bool is_void = false;
    for (uint32_t i = plr_active(c->lexed, c->activity, open + 1); i < close;
         i = plr_active(c->lexed, c->activity, i + 1)) {
        uint8_t kind = c->tokens[i].kind;
        depth += kind == '(' || kind == '[';
        depth -= (kind == ')' || kind == ']') && depth > 0;
        count += kind == ',' && depth == 0;
        is_void = words++ == 0 && word_at(c, i) == PLR_WORD_void;
    }
    count += words > 0 && !is_void;
    return (uint16_t)(count < UINT16_MAX ? count : UINT16_MAX);
}

static plr_name function_name(const cutter *c, const header *h, uint32_t open, uint32_t close) {
    return (plr_name){.token = h->name,
                      .kind = PLR_ITEM_FUNCTION,
                      .parameters = count_parameters(c, open, close),
                      .open = open,
                      .close = close};
}

static const char body_open[] = "the body of this function is never closed";

/* Whether the unit defines a macro of that name before. */
static bool is_macro(const cutter *c, uint32_t token) {
    for (size_t i = c->cut->names.count; i > 0; i--) {
        const plr_name *name = &c->cut->names.items[i - 1];
        if (name->kind == PLR_ITEM_MACRO && c->tokens[name->token].value == c->tokens[token].value)
            return true;
    }
    return false;
}

/* A macro that stands for the body of a function. */
static void pass_macro_body(cutter *c, plr_item *item) {
    item->kind = PLR_ITEM_FUNCTION;
    item->body = c->at++;
    settle(c, false, 0);
    if (c->tokens[c->at].kind == '(')
        pass_brackets(c, false);
}

static void cut_function(cutter *c, const header *h, uint32_t names_before) {
    uint32_t open = c->at;
    if (!pass_brackets(c, false)) {
        add_fault(c, PLR_CODE_UNTERMINATED, h->name, "the parameter list is never closed");
        end_item(c, (plr_item){.kind = PLR_ITEM_KEPT, .first = h->first, .end = c->at},
                 names_before);
        return;
    }
    plr_name name = function_name(c, h, open, c->at - 1);
    name.type = h->words >= 2 ? h->type : PLR_NONE;
    /* the return type is the word just before the name, whatever macro stands before it */
    for (uint32_t i = open - 2; h->words >= 2 && i >= h->first && i < open; i--)
        if (c->tokens[i].kind == PLR_T_IDENT && i != h->name) {
            name.type = i;
            break;
        }
    settle(c, false, 0);
    plr_item item = {.first = h->first};
    size_t at = c->cut->names.count;
    add_name(c, name);
    if (c->tokens[c->at].kind == '{') {
        item.kind = PLR_ITEM_FUNCTION;
        item.body = c->at;
        if (!pass_brackets(c, true))
            add_fault(c, PLR_CODE_UNTERMINATED, h->name, body_open);
    } else {
        item.kind = PLR_ITEM_PROTOTYPE;
        if (c->tokens[c->at].kind == ';')
            c->at++;
        else if (h->words >= 2 && c->tokens[c->at].kind == PLR_T_IDENT && is_macro(c, c->at))
            pass_macro_body(c, &item);
        else
            item.kind = PLR_ITEM_KEPT; /* two macros in a row, or no GLSL */
    }
    if (item.kind == PLR_ITEM_KEPT)
        c->cut->names.count = at;
    else
        c->cut->names.items[at].kind = item.kind;
    item.end = c->at;
    end_item(c, item, names_before);
}

/* Steps over one declarator, to its `,` or `;`. */
static void pass_declarator(cutter *c) {
    for (;; settle(c, false, 0)) {
        uint8_t kind = c->tokens[c->at].kind;
        if (kind == '(' || kind == '[' || kind == '{') {
            if (!pass_brackets(c, false))
                return;
        } else if (kind == ',' || kind == ';' || kind == PLR_T_END || kind == '}') {
            return;
        } else {
            c->at++;
        }
    }
}

static void cut_variables(cutter *c, const header *h, uint32_t names_before) {
    uint32_t name = h->name;
    c->at = name;
    for (;;) {
        plr_item item = {
            .kind = PLR_ITEM_VARIABLE, .prefix = h->first, .prefix_end = h->name, .first = name};
        uint32_t before = (uint32_t)c->cut->names.count;
        if (names_before < before && name == h->name)
            before = names_before;
        add_name(c, (plr_name){.token = name,
                               .kind = PLR_ITEM_VARIABLE,
                               .qualifiers = h->qualifiers,
                               .type = h->type});
        /* the item's own name comes first */
        plr_name own = c->cut->names.items[c->cut->names.count - 1];
        for (size_t i = c->cut->names.count - 1; i > before; i--)
            c->cut->names.items[i] = c->cut->names.items[i - 1];
        c->cut->names.items[before] = own;
        c->at++;
        settle(c, false, 0);
        pass_declarator(c);
        item.end = c->at;
        uint8_t kind = c->tokens[c->at].kind;
        c->at += kind == ';' || kind == ',';
        if (kind != ',') {
            end_item(c, item, before);
            return;
        }
        add_item(c, item, before);
        settle(c, false, 0);
        c->plugs_before = (uint32_t)c->cut->plugs.count;
        if (c->tokens[c->at].kind != PLR_T_IDENT) {
            uint32_t first = c->at;
            pass_unknown(c);
            end_item(c, (plr_item){.kind = PLR_ITEM_KEPT, .first = first, .end = c->at},
                     (uint32_t)c->cut->names.count);
            return;
        }
        name = c->at;
    }
}

static void add_member_name(void *user, uint32_t token) {
    cutter *c = user;
    add_name(c, (plr_name){.token = token, .kind = PLR_ITEM_BLOCK, .type = PLR_NONE});
}

/* What follows the `}` of a struct or block: variables or an instance, up to the `;`. */
static void cut_instances(cutter *c, const header *h, uint8_t kind) {
    bool expect = true;
    for (;; settle(c, false, 0)) {
        uint8_t token = c->tokens[c->at].kind;
        if (token == PLR_T_END)
            return;
        if (token == PLR_T_IDENT && expect) {
            add_name(
                c, (plr_name){.token = c->at,
                              .kind = kind == PLR_ITEM_STRUCT ? PLR_ITEM_VARIABLE : PLR_ITEM_BLOCK,
                              .qualifiers = h->qualifiers,
                              .type = h->name});
            expect = false;
        }
        if (token == '(' || token == '[' || token == '{') {
            if (!pass_brackets(c, false))
                return;
            continue;
        }
        expect |= token == ',';
        c->at++;
        if (token == ';')
            return;
    }
}

static void cut_struct(cutter *c, const header *h, uint32_t names_before) {
    uint8_t kind = h->is_struct ? PLR_ITEM_STRUCT : PLR_ITEM_BLOCK;
    plr_item item = {.kind = kind, .first = h->first, .body = c->at};
    if (h->name != PLR_NONE)
        add_name(c,
                 (plr_name){
                     .token = h->name, .kind = kind, .qualifiers = h->qualifiers, .type = h->type});
    else
        item.kind = PLR_ITEM_KEPT;
    uint32_t open = c->at;
    if (!pass_brackets(c, false))
        add_fault(c, PLR_CODE_UNTERMINATED, h->name != PLR_NONE ? h->name : h->first,
                  "the members are never closed");
    uint32_t close = c->at - 1;
    settle(c, false, 0);
    if (kind == PLR_ITEM_BLOCK && c->tokens[c->at].kind == ';')
        plr_each_member(c->lexed, open, close, add_member_name, c);
    cut_instances(c, h, kind);
    item.end = c->at;
    end_item(c, item, names_before);
}

static void cut_kept(cutter *c, const header *h, uint32_t names_before) {
    c->at = h->first;
    c->cut->names.count = names_before;
    pass_unknown(c);
    if (c->at == h->first) /* nothing else can take it */
        c->at++;
    uint8_t kind = h->is_precision ? PLR_ITEM_PRECISION : PLR_ITEM_KEPT;
    end_item(c, (plr_item){.kind = kind, .first = h->first, .end = c->at}, names_before);
}

/* A call at file scope: a macro that stands for declarations. */
static void cut_macro_call(cutter *c, const header *h, uint32_t names_before) {
    if (pass_brackets(c, false)) {
        settle(c, false, 0);
        if (c->tokens[c->at].kind == ';')
            c->at++;
    }
    end_item(c, (plr_item){.kind = PLR_ITEM_KEPT, .first = h->first, .end = c->at}, names_before);
}

/* PLUG_x (...) { ... } without any type: a plug function, if a wrong one. */
static bool lacks_type(const cutter *c, const header *h) {
    const plr_token *open = &c->tokens[c->at];
    return c->lexed->idents.items[c->tokens[h->name].value].flags & PLR_IF_PLUG &&
           open->value != PLR_NONE &&
           c->tokens[plr_active(c->lexed, c->activity, open->value + 1)].kind == '{';
}

static void cut_declaration(cutter *c) {
    header h;
    uint32_t names_before = (uint32_t)c->cut->names.count, kept = c->kept;
    uint8_t kind = read_header(c, &h);
    bool function = kind == '(' && !h.is_struct && !h.is_precision &&
                    (h.words >= 2 || (h.words == 1 && lacks_type(c, &h)));
    if (function) {
        cut_function(c, &h, names_before);
    } else if (kind == '(' && h.words == 1 && h.name == h.first) {
        cut_macro_call(c, &h, names_before);
    } else if (kind == '{' && (h.is_struct || (h.qualifiers && h.words == 1))) {
        cut_struct(c, &h, names_before);
    } else if ((kind == ';' || kind == ',' || kind == '=' || kind == '[') && h.words >= 2 &&
               !h.is_precision && c->kept == kept) {
        cut_variables(c, &h, names_before);
    } else {
        c->kept = kept;
        cut_kept(c, &h, names_before);
    }
}

/* ---- File scope --------------------------------------------------------------------------------
 */

static void cut_directive(cutter *c) {
    uint32_t index = c->tokens[c->at].value, first = c->at;
    const plr_directive *directive = &c->lexed->directives.items[index];
    plr_kept kept = c->activity ? (plr_kept)c->activity->kept[index] : PLR_KEPT_AS_IS;
    uint32_t names_before = (uint32_t)c->cut->names.count;
    plr_item item = {.kind = PLR_ITEM_KEPT, .first = first, .end = directive->end};
    if (kept > PLR_KEPT_AS_IS) {
        if (kept == PLR_KEPT_IF && !c->grouping)
            begin_group(c, first, names_before, (uint32_t)c->cut->plugs.count);
        pass_directive(c);
        if (c->grouping && c->kept == 0)
            end_group(c);
        return;
    }
    c->at = after_directive(c->lexed, c->activity, c->at);
    if (kept == PLR_KEPT_NO || directive->kind == PLR_D_DROP)
        return;
    if (directive->kind == PLR_D_VERSION) {
        *PLR_PUSH(c->arena, &c->cut->versions) = index;
        return;
    }
    if (directive->kind == PLR_D_EXTENSION) {
        *PLR_PUSH(c->arena, &c->cut->extensions) = index;
        return;
    }
    bool macro = directive->kind == PLR_D_DEFINE || directive->kind == PLR_D_UNDEF;
    if (macro && first + 1 < directive->end && c->tokens[first + 1].kind == PLR_T_IDENT) {
        item.kind = PLR_ITEM_MACRO;
        add_name(c, (plr_name){.token = first + 1, .kind = PLR_ITEM_MACRO});
    }
    add_item(c, item, names_before);
}

void plr_cut_items(plr_arena *arena, const plr_lexed *lexed, const plr_activity *activity,
                   plr_cut *cut) {
    cutter c = {.arena = arena,
                .lexed = lexed,
                .tokens = lexed->tokens.items,
                .activity = activity,
                .cut = cut};
    for (;;) {
        uint8_t kind = c.tokens[c.at].kind;
        if (kind == PLR_T_END)
            break;
        c.depth = 0;
        c.plugs_before = (uint32_t)cut->plugs.count;
        if (kind == PLR_T_DIRECTIVE) {
            cut_directive(&c);
        } else if (kind == PLR_T_PLUG) {
            settle(&c, false, 0);
        } else if (kind == PLR_T_DECLARATIONS) {
            plr_item item = {.kind = PLR_ITEM_DECLARATIONS, .first = c.at, .end = c.at + 1};
            c.at++;
            add_item(&c, item, (uint32_t)cut->names.count);
        } else if (kind == ';') {
            c.at++;
        } else {
            cut_declaration(&c);
        }
    }
    if (c.grouping)
        end_group(&c);
}
