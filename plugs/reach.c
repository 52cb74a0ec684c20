/* What the program needs: from main on, whatever reached text names. */
#include "plugs/link.h"

#include <stdlib.h>

static void reach_range(plr_linking *l, plr_node *node, uint32_t first, uint32_t end);

static void reach_node(plr_linking *l, plr_node *node) {
    if (node->reached || node->dropped)
        return;
    node->reached = true;
    *PLR_PUSH(l->pass, &l->queue) = node;
}

static void reach_symbol(plr_linking *l, plr_binding *symbol) {
    if (symbol->reached)
        return;
    symbol->reached = true;
    for (const plr_definition *d = symbol->definitions; d; d = d->next)
        if (d->name->kind != PLR_ITEM_PROTOTYPE || symbol->weak || d->name->inner)
            reach_node(l, d->node);
}

static void add_edge(plr_linking *l, plr_node *node, plr_binding *symbol, plr_function *function) {
    plr_edge *edge = PLR_NEW(l->pass, plr_edge);
    *edge = (plr_edge){symbol, function, node->edges};
    node->edges = edge;
}

static void reach_function(plr_linking *l, plr_node *node, plr_function *function) {
    add_edge(l, node, NULL, function);
    reach_node(l, function->node);
}

static void note_output(plr_linking *l, const plr_unit *unit, uint32_t token, uint16_t word) {
    const plr_token *t = &unit->lexed->tokens.items[token];
    if (word == PLR_WORD_gl_FragColor) {
        l->uses_color = true;
        return;
    }
    l->uses_data = true;
    uint32_t size = 8;
    if (t[1].kind == '[' && t[2].kind == PLR_T_NUMBER && t[2].length == 1 && t[3].kind == ']')
        size = (uint32_t)(unit->lexed->text[t[2].offset] - '0') + 1;
    if (size > l->data_size)
        l->data_size = size;
}

static void reach_special(plr_linking *l, plr_node *node, uint32_t token) {
    plr_unit *unit = node->unit;
    const plr_ident *ident = plr_token_ident(unit, token);
    if (ident->flags & PLR_IF_PLUG) {
        plr_function *found[64];
        size_t count = plr_direct_functions(l, unit, token, found, 64);
        for (size_t i = 0; i < count; i++)
            if (found[i]->name->token != token || found[i]->node != node)
                reach_function(l, node, found[i]);
    } else if (plr_word_get(ident->word)->kinds & PLR_WORD_IS_OUTPUT) {
        note_output(l, unit, token, ident->word);
    }
}

/* READS (name): `.name`, or an input `name` of a stage after the vertex stage. */
static void note_read(plr_linking *l, uint32_t gid) {
    if (!l->reads[gid]) {
        l->reads[gid] = 1;
        l->grown |= (l->asked[gid] & PLR_ASKED_READS) != 0;
    }
}

static void reach_ident(plr_linking *l, plr_node *node, uint32_t token) {
    plr_unit *unit = node->unit;
    const plr_token *t = &unit->lexed->tokens.items[token];
    uint8_t action = unit->actions[t->value];
    if (t->flags & (PLR_TF_MEMBER | PLR_TF_PARAM)) {
        if (t->flags & PLR_TF_MEMBER)
            note_read(l, unit->reading->gids[t->value]);
        if (t->flags & PLR_TF_PARAM)
            return;
    }
    if (action == PLR_ACTION_UNKNOWN)
        action = (uint8_t)plr_resolve(l, unit, t->value);
    plr_binding *symbol = unit->refs[t->value];
    if (symbol) {
        if (symbol->stamp == l->stamp)
            return;
        if (plr_is_plain(unit, t, symbol) || plr_is_hidden_local(l, unit, t, symbol))
            return;
        symbol->stamp = l->stamp;
        if (unit->scope->stage != PLR_VERTEX && symbol->definitions &&
            symbol->definitions->name->qualifiers & (PLR_Q_IN | PLR_Q_VARYING))
            note_read(l, unit->reading->gids[t->value]);
        add_edge(l, node, symbol, NULL);
        reach_symbol(l, symbol);
    } else if (action == PLR_ACTION_SPECIAL) {
        reach_special(l, node, token);
    } else if (!(t->flags & (PLR_TF_MEMBER | PLR_TF_PLAIN | PLR_TF_LOCAL))) {
        plr_lacks_name(l, unit, token);
    }
}

static void reach_socket(plr_linking *l, plr_node *node, plr_socket *socket) {
    uint32_t last = PLR_NONE;
    socket->reached = true;
    for (size_t i = 0; i < socket->calls.count; i++) {
        const plr_call *call = &socket->calls.items[i];
        reach_function(l, node, call->function);
        if (call->list == last)
            continue;
        last = call->list;
        const plr_list *list = &socket->unit->lexed->lists.items[call->list];
        reach_range(l, node, list->first, list->end);
    }
}

static void reach_range(plr_linking *l, plr_node *node, uint32_t first, uint32_t end) {
    const plr_unit *unit = node->unit;
    const plr_lexed *lexed = unit->lexed;
    const plr_token *tokens = lexed->tokens.items;
    for (uint32_t i = first; i < end;) {
        if (tokens[i].kind == PLR_T_IDENT) {
            reach_ident(l, node, i++);
        } else if (tokens[i].kind == PLR_T_DIRECTIVE) {
            uint32_t index = tokens[i].value;
            const plr_directive *directive = &lexed->directives.items[index];
            bool kept = !unit->activity || unit->activity->kept[index] != PLR_KEPT_NO;
            for (uint32_t k = i + 1; kept && k < directive->end; k++)
                if (tokens[k].kind == PLR_T_IDENT)
                    reach_ident(l, node, k);
            i = unit->activity ? unit->activity->next[index] : directive->end;
        } else if (tokens[i].kind == PLR_T_PLUG) {
            plr_socket *socket = unit->sockets[tokens[i].value];
            if (socket)
                reach_socket(l, node, socket);
            i = lexed->plugs.items[tokens[i].value].end;
        } else {
            i++;
        }
    }
}

/* Items that are there even if nothing names them. */
static bool is_root(const plr_linking *l, const plr_node *node) {
    switch (node->item->kind) {
    case PLR_ITEM_PRECISION: /* means nothing here, and on ES everything is highp */
        return l->desc->glsl != PLR_GLSL_300ES;
    case PLR_ITEM_KEPT:
    case PLR_ITEM_GROUP:
        return true;
    case PLR_ITEM_VARIABLE:
    case PLR_ITEM_BLOCK:
        return !node->symbol; /* a built-in variable, declared again */
    default:
        return false;
    }
}

static void reach_roots(plr_linking *l, plr_scope *scope, bool all) {
    if (scope->live)
        return;
    scope->live = true;
    for (uint32_t u = 0; u < scope->unit_count; u++) {
        const plr_unit *unit = &scope->units[u];
        for (size_t i = 0; unit->nodes && i < unit->cut->items.count; i++)
            if (is_root(l, &unit->nodes[i]) ||
                (all && unit->nodes[i].item->kind != PLR_ITEM_PRECISION &&
                 (unit->nodes[i].item->kind != PLR_ITEM_PROTOTYPE ||
                  (unit->nodes[i].symbol && unit->nodes[i].symbol->weak))))
                reach_node(l, &unit->nodes[i]);
    }
}

/* What a macro stands for; its name is no use of it, but must be known. */
static void reach_macro(plr_linking *l, plr_node *node) {
    plr_unit *unit = node->unit;
    uint32_t name = node->item->first + 1;
    uint32_t local = unit->lexed->tokens.items[name].value;
    if (unit->actions[local] == PLR_ACTION_UNKNOWN)
        plr_resolve(l, unit, local);
    reach_range(l, node, name + 1, node->item->end);
}

/* Plug functions of a gated effect name the gate, which their text does not (print.c). */
static void reach_gate(plr_linking *l, plr_node *node) {
    plr_binding *gate = plr_gate_of(l, node);
    if (!gate)
        return;
    add_edge(l, node, gate, NULL);
    reach_symbol(l, gate);
}

/* The text of an item; a function's own name is no use of it. */
static void reach_item(plr_linking *l, plr_node *node) {
    const plr_item *item = node->item;
    plr_unit *unit = node->unit;
    uint32_t first = item->first;
    reach_range(l, node, item->prefix, item->prefix_end);
    reach_gate(l, node);
    if (item->kind == PLR_ITEM_MACRO) {
        reach_macro(l, node);
        return;
    }
    if (item->kind == PLR_ITEM_FUNCTION && node->symbol) {
        const plr_name *name = &unit->cut->names.items[item->names];
        uint32_t local = unit->lexed->tokens.items[name->token].value;
        if (!name->inner && name->kind == PLR_ITEM_FUNCTION && name->token >= first) {
            if (unit->actions[local] == PLR_ACTION_UNKNOWN)
                plr_resolve(l, unit, local);
            reach_range(l, node, first, name->token);
            first = name->token + 1;
        }
    }
    reach_range(l, node, first, item->end);
}

static void drain(plr_linking *l) {
    while (l->queue.count) {
        plr_node *node = l->queue.items[--l->queue.count];
        plr_scope *scope = node->unit->scope;
        if (scope->owner < l->effect_count) {
            l->active[scope->owner] = true;
            reach_roots(l, scope, false);
        }
        l->stamp++;
        reach_item(l, node);
    }
}

void plr_reach(plr_linking *l) {
    for (unsigned s = 0; s < PLR_STAGE_COUNT; s++) {
        if (!(l->stages & 1u << s))
            continue;
        plr_scope *base = plr_scope_of(l, (plr_stage)s, PLR_SCOPE_BASE(l));
        plr_binding *entry = plr_entry(l, (plr_stage)s);
        bool all = l->desc->keep_all || !entry;
        reach_roots(l, base, all);
        if (entry)
            reach_symbol(l, entry);
        for (uint32_t e = 0; e < l->effect_count && l->desc->keep_all; e++)
            if (!l->faulty[e] && !l->left_out[e])
                reach_roots(l, plr_scope_of(l, (plr_stage)s, e), true);
        drain(l);
    }
}
