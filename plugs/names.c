/* Scopes: which names each effect declares, and what an identifier of a unit means. */
#include "plugs/link.h"

#include <stdio.h>
#include <string.h>

static uint64_t scope_key(uint32_t number, uint32_t gid) {
    return (uint64_t)number << 32 | gid;
}

/* Names that one unit has for itself among several of its scope. */
static uint64_t unit_key(const plr_unit *unit, uint32_t gid) {
    return scope_key(0x80000000u + unit->number, gid);
}

plr_binding *plr_binding_find(const plr_linking *l, const plr_scope *scope, uint32_t gid) {
    return plr_table_get(&l->symbols, scope_key(scope->number, gid));
}

static plr_binding *find_own(const plr_linking *l, const plr_unit *unit, uint32_t gid) {
    plr_binding *own = unit->scope->split ? plr_table_get(&l->symbols, unit_key(unit, gid)) : NULL;
    return own ? own : plr_binding_find(l, unit->scope, gid);
}

static bool is_effect(const plr_linking *l, const plr_scope *scope) {
    return scope->owner < l->effect_count;
}

plr_binding *plr_gate_of(const plr_linking *l, const plr_node *node) {
    const plr_scope *scope = node->unit->scope;
    const char *gate =
        node->function && is_effect(l, scope) ? l->desc->effects[scope->owner].gate : NULL;
    uint32_t gid = gate ? plr_gid_find(l, gate, strlen(gate)) : PLR_NONE;
    return gid == PLR_NONE ? NULL : plr_binding_find(l, scope, gid);
}

/* ---- Declaring ---------------------------------------------------------------------------------
 */

static void add_definition(plr_linking *l, plr_binding *symbol, plr_node *node,
                           const plr_name *name) {
    plr_definition *definition = PLR_NEW(l->pass, plr_definition);
    *definition = (plr_definition){node, name, NULL};
    if (symbol->last)
        symbol->last->next = definition;
    else
        symbol->pending = symbol->definitions = definition;
    symbol->last = definition;
    symbol->macro |= name->kind == PLR_ITEM_MACRO;
    symbol->function |= name->kind == PLR_ITEM_FUNCTION;
    symbol->variable |= name->kind == PLR_ITEM_VARIABLE;
    symbol->weak &= name->kind == PLR_ITEM_PROTOTYPE;
    if (!node->symbol && !name->inner)
        node->symbol = symbol;
}

static plr_binding *new_symbol(plr_linking *l, uint64_t key, plr_scope *scope, uint32_t gid) {
    plr_binding *symbol = PLR_NEW(l->pass, plr_binding);
    const plr_ident *ident = &l->idents.items[gid];
    symbol->gid = gid;
    symbol->scope = scope;
    symbol->weak = true;
    symbol->renamed = is_effect(l, scope);
    symbol->builtin = (plr_word_get(ident->word)->kinds & PLR_WORD_IS_BUILTIN) != 0;
    *plr_table_put(l->pass, &l->symbols, key) = symbol;
    return symbol;
}

static plr_binding *get_symbol(plr_linking *l, plr_scope *scope, uint32_t gid) {
    plr_binding *symbol = plr_binding_find(l, scope, gid);
    return symbol ? symbol : new_symbol(l, scope_key(scope->number, gid), scope, gid);
}

/* A uniform or varying of the same type, in other words: `uniform highp float`. */
static bool is_interface_again(const plr_definition *d, const plr_node *node,
                               const plr_name *name) {
    const uint8_t interface =
        PLR_Q_UNIFORM | PLR_Q_IN | PLR_Q_OUT | PLR_Q_VARYING | PLR_Q_ATTRIBUTE;
    return d->name->qualifiers & interface && name->qualifiers & interface &&
           d->node->item->kind == PLR_ITEM_VARIABLE && node->item->kind == PLR_ITEM_VARIABLE &&
           plr_same_type(d->node->unit, d->node->item, node->unit, node->item);
}

typedef enum verdict {
    VERDICT_DECLARE, /* another declaration of the same symbol: overloads, one unit's own business
                      */
    VERDICT_DROP,    /* says the same again */
    VERDICT_SPLIT    /* the unit's own */
} verdict;

/* What a name that the scope has already means in another unit. */
static verdict judge(const plr_linking *l, const plr_binding *symbol, plr_node *node,
                     const plr_name *name) {
    bool effect = is_effect(l, node->unit->scope);
    for (const plr_definition *d = symbol->definitions; d; d = d->next) {
        if (d->node->unit == node->unit || name->inner || d->name->inner)
            continue;
        if (name->kind == PLR_ITEM_PROTOTYPE || d->name->kind == PLR_ITEM_PROTOTYPE)
            continue;
        bool functions = name->kind == PLR_ITEM_FUNCTION && d->name->kind == PLR_ITEM_FUNCTION;
        if (functions && !plr_same_signature(d->node->unit, d->name, node->unit, name))
            continue;
        if (plr_same_item(d->node->unit, d->node->item, node->unit, node->item) ||
            is_interface_again(d, node, name))
            return VERDICT_DROP;
        if (name->kind == PLR_ITEM_MACRO && d->name->kind == PLR_ITEM_MACRO)
            node->undefine_before = true;
        else if (effect)
            return VERDICT_SPLIT;
    }
    return VERDICT_DECLARE;
}

plr_binding *plr_declare_name(plr_linking *l, plr_node *node, const plr_name *name) {
    plr_binding *symbol = get_symbol(l, node->unit->scope, plr_token_gid(node->unit, name->token));
    add_definition(l, symbol, node, name);
    return symbol;
}

static void declare(plr_linking *l, plr_node *node, const plr_name *name, uint32_t gid) {
    plr_unit *unit = node->unit;
    plr_scope *scope = unit->scope;
    plr_binding *own = scope->split ? plr_table_get(&l->symbols, unit_key(unit, gid)) : NULL;
    if (own) {
        add_definition(l, own, node, name);
        return;
    }
    plr_binding *symbol = plr_binding_find(l, scope, gid);
    if (symbol && symbol->last->node->unit != unit) {
        verdict v = judge(l, symbol, node, name);
        if (v == VERDICT_DROP) {
            node->dropped = true;
            return;
        }
        if (v == VERDICT_SPLIT) {
            scope->split = true;
            plr_binding *variant = new_symbol(l, unit_key(unit, gid), scope, gid);
            variant->variant = unit->index + 1;
            add_definition(l, variant, node, name);
            return;
        }
    }
    add_definition(l, get_symbol(l, scope, gid), node, name);
}

/* ---- What effects may not own ------------------------------------------------------------------
 */

static void refuse(plr_linking *l, const plr_unit *unit, uint32_t token, const char *why) {
    const plr_ident *ident = plr_token_ident(unit, token);
    plr_say(l, PLR_CODE_RESERVED_NAME, plr_token_place(unit, token), "the name \"%.*s\" %s",
            (int)(ident->length < 200 ? ident->length : 200), ident->text, why);
}

/* gl_...: a built-in variable may be declared again, with its storage. */
static bool check_gl(plr_linking *l, plr_node *node, const plr_name *name) {
    uint16_t word = plr_token_ident(node->unit, name->token)->word;
    bool variable = name->kind == PLR_ITEM_VARIABLE || name->kind == PLR_ITEM_BLOCK;
    uint8_t storage = PLR_Q_IN | PLR_Q_OUT | PLR_Q_VARYING;
    if (variable && (name->qualifiers & storage || name->kind == PLR_ITEM_BLOCK)) {
        if (plr_word_get(word)->kinds & (PLR_WORD_IS_VARIABLE | PLR_WORD_IS_OUTPUT))
            node->dropped = true; /* the old ones become names that are declared elsewhere */
        return true;
    }
    if (variable && plr_word_get(word)->kinds & PLR_WORD_IS_LEGACY) {
        node->dropped = true;
        return true;
    }
    refuse(l, node->unit, name->token, "belongs to GLSL");
    return false;
}

/* In the geometry stage an array of them comes in: the host's declaration is not meant. */
static bool is_varying(const plr_binding *symbol) {
    return symbol->variable && symbol->definitions->name->qualifiers & (PLR_Q_IN | PLR_Q_VARYING);
}

/* The declaration that a host name has already. */
static const plr_definition *host_definition(const plr_linking *l, const plr_scope *scope,
                                             uint32_t gid, bool base_too) {
    const uint32_t owners[] = {PLR_SCOPE_BASE(l), PLR_SCOPE_LIBRARY(l), PLR_SCOPE_HOST(l)};
    for (unsigned i = base_too ? 0 : 1; i < 3; i++) {
        const plr_binding *symbol = plr_binding_find(l, &l->scopes[scope->stage][owners[i]], gid);
        if (symbol && !symbol->weak && !(scope->stage == PLR_GEOMETRY && is_varying(symbol)))
            return symbol->definitions;
    }
    return NULL;
}

static bool is_host_variable(const plr_linking *l, const plr_scope *scope, const plr_name *name,
                             uint32_t gid) {
    uint8_t given = PLR_Q_UNIFORM | PLR_Q_IN | PLR_Q_ATTRIBUTE | PLR_Q_VARYING;
    if (name->kind != PLR_ITEM_VARIABLE || !(name->qualifiers & given))
        return false;
    if (scope->stage == PLR_VERTEX && name->qualifiers & (PLR_Q_IN | PLR_Q_ATTRIBUTE))
        return true;
    const plr_binding *symbol =
        plr_binding_find(l, plr_scope_of(l, scope->stage, PLR_SCOPE_LIBRARY(l)), gid);
    return symbol && symbol->variable &&
           symbol->definitions->name->qualifiers & (PLR_Q_UNIFORM | PLR_Q_IN | PLR_Q_VARYING);
}

/* A name that is shared by all: said again it is dropped, said otherwise it is an error. */
static bool share_host(plr_linking *l, plr_node *node, const plr_name *name, uint32_t gid) {
    const plr_definition *host = host_definition(l, node->unit->scope, gid, true);
    if (!host) {
        plr_scope *scope = plr_scope_of(l, node->unit->scope->stage, PLR_SCOPE_HOST(l));
        add_definition(l, get_symbol(l, scope, gid), node, name);
        return true;
    }
    if (host->node->unit == node->unit && host->node == node)
        return true;
    bool overload = name->kind == PLR_ITEM_FUNCTION || name->kind == PLR_ITEM_PROTOTYPE;
    if (plr_same_type(host->node->unit, host->node->item, node->unit, node->item)) {
        node->dropped = true;
        return true;
    }
    if (overload && !plr_same_signature(host->node->unit, host->name, node->unit, name)) {
        plr_scope *scope = plr_scope_of(l, node->unit->scope->stage, PLR_SCOPE_HOST(l));
        add_definition(l, get_symbol(l, scope, gid), node, name);
        return true;
    }
    if (name->kind == PLR_ITEM_PROTOTYPE) {
        node->dropped = true;
        return true;
    }
    plr_say(l, PLR_CODE_HOST_TYPE, plr_token_place(node->unit, name->token),
            "the host name \"%s\" is declared again as something else", plr_gid_text(l, gid));
    plr_say_note(l, plr_token_place(host->node->unit, host->name->token),
                 "it is declared first here");
    return false;
}

static plr_binding *struct_like(plr_linking *l, plr_node *node, const plr_scope *other,
                                uint32_t gid) {
    plr_binding *symbol = plr_binding_find(l, other, gid);
    if (!symbol || !symbol->definitions)
        return NULL;
    const plr_definition *d = symbol->definitions;
    if (d->node->item->kind != PLR_ITEM_STRUCT || d->name->inner || d->node->dropped ||
        !plr_same_item(d->node->unit, d->node->item, node->unit, node->item))
        return NULL;
    /* the types of its members must be shared as well */
    const plr_unit *unit = node->unit;
    for (uint32_t i = node->item->body; i < node->item->end; i++) {
        const plr_token *token = &unit->lexed->tokens.items[i];
        if (token->kind != PLR_T_IDENT || token->flags & PLR_TF_PLAIN)
            continue;
        uint32_t member = unit->reading->gids[token->value];
        const plr_binding *own = find_own(l, unit, member);
        if (own && own != find_own(l, d->node->unit, member))
            return NULL;
    }
    return symbol;
}

/* A struct that is spelt as in an effect whose plug this one implements, in the base or in the
 * library, is that one. */
static plr_binding *shared_struct(plr_linking *l, plr_node *node, uint32_t gid) {
    const plr_scope *scope = node->unit->scope;
    plr_binding *symbol = NULL;
    if (node->item->kind != PLR_ITEM_STRUCT || node->item->name_count != 1)
        return NULL;
    for (size_t i = 0; i < scope->providers.count && !symbol; i++)
        symbol =
            struct_like(l, node, plr_scope_of(l, scope->stage, scope->providers.items[i]), gid);
    if (!symbol)
        symbol = struct_like(l, node, plr_scope_of(l, scope->stage, PLR_SCOPE_BASE(l)), gid);
    if (!symbol)
        symbol = struct_like(l, node, plr_scope_of(l, scope->stage, PLR_SCOPE_LIBRARY(l)), gid);
    return symbol;
}

/* ---- The names of a scope ----------------------------------------------------------------------
 */

static bool declare_in_effect(plr_linking *l, plr_node *node, const plr_name *name, uint32_t gid) {
    plr_unit *unit = node->unit;
    const plr_scope *scope = unit->scope;
    const plr_ident *ident = plr_token_ident(unit, name->token);
    bool builtin = l->desc->effects[scope->owner].builtin;
    if (ident->flags & PLR_IF_PLUG) {
        node->dropped |= name->kind == PLR_ITEM_PROTOTYPE;
        if (name->kind == PLR_ITEM_FUNCTION || name->kind == PLR_ITEM_PROTOTYPE)
            return true;
    }
    if (ident->flags & PLR_IF_GL)
        return check_gl(l, node, name);
    if (scope->stage == PLR_GEOMETRY && ident->word == PLR_WORD_main &&
        name->kind == PLR_ITEM_FUNCTION)
        return plr_declare_main(l, node, name);
    if (ident->flags & PLR_IF_CASTLE || is_host_variable(l, scope, name, gid))
        return name->kind == PLR_ITEM_MACRO ? (declare(l, node, name, gid), true)
                                            : share_host(l, node, name, gid);
    if (ident->flags & PLR_IF_PLUGRAY && !builtin) {
        refuse(l, unit, name->token, "belongs to plugray");
        return false;
    }
    plr_binding *shared = shared_struct(l, node, gid);
    if (shared) { /* known under this name here too, for those who build on this effect */
        node->dropped = true;
        *plr_table_put(l->pass, &l->symbols, scope_key(scope->number, gid)) = shared;
        return true;
    }
    declare(l, node, name, gid);
    return true;
}

/* Any use of a name that the linker makes itself. */
static bool check_reserved(plr_linking *l, const plr_unit *unit) {
    if (!unit->lexed->reserved)
        return true;
    for (uint32_t i = 0; i < unit->lexed->tokens.count; i++)
        if (unit->lexed->tokens.items[i].kind == PLR_T_IDENT &&
            plr_token_ident(unit, i)->flags & PLR_IF_RESERVED) {
            refuse(l, unit, i, "is of the form that plugray gives to names of effects");
            return false;
        }
    return true;
}

static bool define_unit(plr_linking *l, plr_unit *unit) {
    const plr_cut *cut = unit->cut;
    bool effect = is_effect(l, unit->scope), good = check_reserved(l, unit);
    unit->nodes = PLR_NEW_ARRAY(l->pass, cut->items.count, plr_node);
    for (size_t i = 0; i < cut->items.count; i++) {
        plr_node *node = &unit->nodes[i];
        const plr_item *item = &cut->items.items[i];
        node->unit = unit;
        node->item = item;
        for (uint32_t n = 0; n < item->name_count; n++) {
            const plr_name *name = &cut->names.items[item->names + n];
            uint32_t gid = plr_token_gid(unit, name->token);
            uint8_t flags = plr_token_ident(unit, name->token)->flags;
            if (effect)
                good &= declare_in_effect(l, node, name, gid);
            else if (!(flags & PLR_IF_GL) || !check_gl(l, node, name))
                declare(l, node, name, gid);
        }
    }
    return good;
}

bool plr_define_names(plr_linking *l, plr_scope *scope) {
    bool good = true;
    for (uint32_t u = 0; u < scope->unit_count; u++)
        if (scope->units[u].cut)
            good &= define_unit(l, &scope->units[u]);
    return good;
}

/* ---- Meaning -----------------------------------------------------------------------------------
 */

static plr_binding *strong(plr_binding *symbol) {
    return symbol && !symbol->weak ? symbol : NULL;
}

static plr_binding *find_provided(const plr_linking *l, const plr_scope *scope, uint32_t gid) {
    for (size_t i = 0; i < scope->providers.count; i++) {
        uint32_t provider = scope->providers.items[i];
        plr_binding *symbol =
            strong(plr_binding_find(l, plr_scope_of(l, scope->stage, provider), gid));
        if (symbol)
            return symbol;
    }
    return NULL;
}

static bool is_host_binding(const plr_binding *symbol) {
    return symbol->variable &&
           symbol->definitions->name->qualifiers &
               (PLR_Q_UNIFORM | PLR_Q_IN | PLR_Q_OUT | PLR_Q_VARYING | PLR_Q_ATTRIBUTE);
}

/* A library name that the base has for something else. */
static bool is_hidden_by_base(const plr_linking *l, const plr_binding *symbol) {
    if (symbol->scope->owner != PLR_OWNER_LIBRARY || is_host_binding(symbol))
        return false;
    const plr_binding *base =
        plr_binding_find(l, plr_scope_of(l, symbol->scope->stage, PLR_SCOPE_BASE(l)), symbol->gid);
    return base && !base->weak;
}

/* A macro of the base or the library that would replace members of effects. */
static bool is_macro_like_member(const plr_linking *l, const plr_binding *symbol) {
    return symbol->macro && l->members[symbol->gid] &&
           (symbol->scope->owner == PLR_OWNER_BASE || symbol->scope->owner == PLR_OWNER_LIBRARY);
}

static plr_binding *find_meaning(const plr_linking *l, const plr_unit *unit, uint32_t gid) {
    const plr_scope *scope = unit->scope;
    const plr_scope *scopes = l->scopes[scope->stage];
    plr_binding *own = find_own(l, unit, gid), *symbol = strong(own);
    const plr_scope *library = &scopes[PLR_SCOPE_LIBRARY(l)], *base = &scopes[PLR_SCOPE_BASE(l)];
    if (symbol && scope == library && is_host_binding(symbol)) {
        plr_binding *again = strong(plr_binding_find(l, base, gid));
        return again ? again : symbol; /* what the base declares as well is the same */
    }
    if (symbol)
        return symbol;
    if (is_effect(l, scope)) {
        if ((symbol = strong(plr_binding_find(l, &scopes[PLR_SCOPE_HOST(l)], gid))) != NULL ||
            (symbol = find_provided(l, scope, gid)) != NULL)
            return symbol;
    }
    if ((symbol = strong(plr_binding_find(l, base, gid))) != NULL ||
        (symbol = strong(plr_binding_find(l, library, gid))) != NULL)
        return symbol;
    return own;
}

plr_action plr_resolve(plr_linking *l, plr_unit *unit, uint32_t local) {
    const plr_ident *ident = &unit->lexed->idents.items[local];
    unsigned kinds = plr_word_get(ident->word)->kinds;
    bool since = kinds & PLR_WORD_IS_SINCE && ident->flags & PLR_IF_DECLARED;
    plr_action action = PLR_ACTION_COPY;
    plr_binding *symbol = NULL;
    if (kinds & PLR_WORD_IS_KEYWORD) {
        if (ident->word == PLR_WORD_PLUG_USED || ident->word == PLR_WORD_READS ||
            ident->word == PLR_WORD_defined)
            action = PLR_ACTION_SPECIAL;
    } else if (ident->flags & PLR_IF_PLUG && is_effect(l, unit->scope)) {
        symbol = find_own(l, unit, unit->reading->gids[local]);
        action = symbol ? PLR_ACTION_NAME : PLR_ACTION_SPECIAL;
    } else {
        symbol = find_meaning(l, unit, unit->reading->gids[local]);
        if (symbol) {
            uint32_t length;
            const char *text = plr_binding_text(l, symbol, &length);
            bool same = length == ident->length && memcmp(text, ident->text, length) == 0;
            if (since || (symbol->builtin && symbol->function && symbol->renamed))
                action = PLR_ACTION_SPECIAL;
            else
                action = same ? PLR_ACTION_COPY : PLR_ACTION_NAME;
        } else if (since || kinds & PLR_WORD_IS_LEGACY || ident->word == PLR_WORD_varying ||
                   ident->word == PLR_WORD_attribute) {
            action = PLR_ACTION_SPECIAL;
        }
    }
    if (!symbol && action == PLR_ACTION_COPY && !kinds) {
        symbol = plr_geometry_output(l, unit, unit->reading->gids[local]);
        action = symbol ? PLR_ACTION_NAME : action;
    }
    if (!symbol && kinds & PLR_WORD_IS_VARIABLE) {
        const char *name = plr_word_get(ident->word)->replacement;
        uint32_t gid = plr_gid_find(l, name, strlen(name));
        symbol = gid == PLR_NONE ? NULL : find_meaning(l, unit, gid);
    }
    unit->refs[local] = symbol;
    unit->actions[local] = (uint8_t)action;
    return action;
}

/* ---- Names in the program ----------------------------------------------------------------------
 */

/* plr3_name, plr3u_name for _name, plr3_name_2 for a variant. */
static const char *effect_name(plr_linking *l, uint32_t effect, const plr_ident *ident,
                               uint32_t variant, uint32_t *length) {
    char head[24], tail[16] = "";
    bool under = ident->text[0] == '_';
    int head_length = snprintf(head, sizeof head, under ? "plr%uu" : "plr%u_", (unsigned)effect);
    int tail_length = variant ? snprintf(tail, sizeof tail, "_%u", (unsigned)variant) : 0;
    size_t size = (size_t)head_length + ident->length + (size_t)tail_length;
    char *text = plr_arena_alloc(l->pass, size + 1);
    memcpy(text, head, (size_t)head_length);
    memcpy(text + head_length, ident->text, ident->length);
    memcpy(text + (size_t)head_length + ident->length, tail, (size_t)tail_length);
    *length = (uint32_t)size;
    return text;
}

/* Whether the effect declares a name of that text itself, in that stage. */
static bool is_taken(const plr_linking *l, const plr_scope *scope, const char *text,
                     uint32_t length) {
    uint32_t gid = plr_gid_find(l, text, length);
    return gid != PLR_NONE && plr_binding_find(l, scope, gid) != NULL;
}

static void name_variant(plr_linking *l, plr_binding *symbol, const plr_ident *ident) {
    char text[160];
    for (;; symbol->variant++) {
        int length = snprintf(text, sizeof text, "%.*s_%u", (int)ident->length, ident->text,
                              (unsigned)symbol->variant);
        if (length < 0 || (size_t)length >= sizeof text ||
            !is_taken(l, symbol->scope, text, (uint32_t)length))
            break;
    }
    symbol->text = effect_name(l, symbol->scope->owner, ident, symbol->variant, &symbol->length);
}

const char *plr_binding_text(plr_linking *l, plr_binding *symbol, uint32_t *length) {
    if (!symbol->text) {
        const plr_ident *ident = &l->idents.items[symbol->gid];
        unsigned kinds = plr_word_get(ident->word)->kinds;
        bool since =
            kinds & PLR_WORD_IS_SINCE && (!(kinds & PLR_WORD_IS_BUILTIN) || !symbol->function);
        if (symbol->renamed && !symbol->weak) {
            if (symbol->variant)
                name_variant(l, symbol, ident);
            else
                symbol->text = effect_name(l, symbol->scope->owner, ident, 0, &symbol->length);
        } else if (is_macro_like_member(l, symbol)) {
            bool library = symbol->scope->owner == PLR_OWNER_LIBRARY;
            symbol->text = plr_arena_format(l->pass, "plr_%s_%.*s", library ? "lib" : "base",
                                            (int)ident->length, ident->text);
            symbol->length = (uint32_t)strlen(symbol->text);
        } else if (is_hidden_by_base(l, symbol)) {
            symbol->text =
                plr_arena_format(l->pass, "plr_lib_%.*s", (int)ident->length, ident->text);
            symbol->length = ident->length + 8;
        } else if (since && !symbol->macro) {
            symbol->text = plr_arena_format(l->pass, "plr_%.*s", (int)ident->length, ident->text);
            symbol->length = ident->length + 4;
        } else {
            symbol->text = ident->text;
            symbol->length = ident->length;
        }
    }
    *length = symbol->length;
    return symbol->text;
}
