#include "plugs/compose.h"

#include <string.h>

typedef struct frame {
    plr_node *node;
    const plr_function *function; /* whose prototype is meant, of those in the node */
    bool declare;                 /* only a prototype */
    bool ready;                   /* what it names stands before */
} frame;

typedef struct composer {
    plr_linking *l;
    plr_stage stage;
    plr_printer *printer;
    PLR_LIST(frame) stack;
    bool declared; /* PLUG-DECLARATIONS was passed */
} composer;

/* ---- One item ----------------------------------------------------------------------------------
 */

static void print_item(composer *c, plr_node *node) {
    plr_printer *p = c->printer;
    const plr_item *item = node->item;
    if (item->kind == PLR_ITEM_FUNCTION && p->out.count)
        plr_print_own(p, "\n");
    if (node->undefine_before) {
        uint32_t length;
        const char *name = plr_binding_text(c->l, node->symbol, &length);
        plr_print_own(p, "#undef ");
        plr_print_own(p, plr_arena_copy(c->l->pass, name, length));
        plr_print_own(p, "\n");
    }
    if (item->kind == PLR_ITEM_VARIABLE) {
        plr_print_range(p, node, item->prefix, item->prefix_end);
        plr_print_own(p, " ");
        plr_print_range(p, node, item->first, item->end);
        plr_print_line_end(p, ";");
        return;
    }
    plr_print_range(p, node, item->first, item->end);
    plr_print_newline(p);
}

static void print_prototype(composer *c, plr_node *node) {
    const plr_name *name = &node->unit->cut->names.items[node->item->names];
    for (uint32_t n = 0; n < node->item->name_count; n++)
        if (name[n].kind == PLR_ITEM_FUNCTION && !name[n].inner) {
            plr_print_range(c->printer, node, node->item->first, name[n].close + 1);
            plr_print_line_end(c->printer, ";");
            return;
        }
}

/* ---- What an item needs before it -------------------------------------------------------------
 */

static void need(composer *c, plr_node *node, bool declare) {
    if (node->emitted || (declare ? node->declared : node->entered))
        return;
    *PLR_PUSH(c->l->pass, &c->stack) = (frame){node, NULL, declare, false};
}

/* Whether a definition needs nothing more, for whoever names it. */
static bool is_done(const plr_definition *d) {
    const plr_node *node = d->node;
    return !node->reached || node->dropped || node->emitted ||
           (d->name->inner && d->name->inner_body) ||
           (node->declared && node->item->kind == PLR_ITEM_FUNCTION);
}

/* A macro that is defined only after the text that names it. */
static bool is_later_macro(const plr_node *user, const plr_definition *d) {
    const plr_unit *unit = d->node->unit;
    return d->name->kind == PLR_ITEM_MACRO && unit->scope == user->unit->scope &&
           (unit->index > user->unit->index || (unit == user->unit && d->node->item > user->item));
}

static void need_symbol(composer *c, const plr_node *user, plr_binding *symbol, bool types_only) {
    while (symbol->pending && is_done(symbol->pending))
        symbol->pending = symbol->pending->next; /* for good: so that time stays linear */
    for (const plr_definition *d = symbol->pending; d && !is_later_macro(user, d); d = d->next) {
        bool function = d->node->item->kind == PLR_ITEM_FUNCTION;
        if (d->node != user && !is_done(d) && !(function && types_only))
            need(c, d->node, function);
    }
}

/* What a prototype names: the types and constants of its parameters. */
static void need_of_prototype(composer *c, plr_node *node) {
    plr_unit *unit = node->unit;
    const plr_name *names = &unit->cut->names.items[node->item->names];
    uint32_t close = 0, own = 0;
    for (uint32_t n = 0; n < node->item->name_count && !close; n++)
        if (names[n].kind == PLR_ITEM_FUNCTION && !names[n].inner) {
            close = names[n].close;
            own = names[n].token;
        }
    for (uint32_t i = node->item->first; i < close; i++) {
        const plr_token *token = &unit->lexed->tokens.items[i];
        plr_binding *symbol =
            token->kind == PLR_T_IDENT && i != own ? unit->refs[token->value] : NULL;
        if (symbol && !(token->flags & (PLR_TF_MEMBER | PLR_TF_PLAIN | PLR_TF_LOCAL)))
            need_symbol(c, node, symbol, true);
    }
}

static void need_all(composer *c, plr_node *node) {
    for (const plr_edge *edge = node->edges; edge; edge = edge->next) {
        if (edge->symbol)
            need_symbol(c, node, edge->symbol, false);
        else if (edge->function->node->item->kind == PLR_ITEM_FUNCTION)
            need(c, edge->function->node, true);
        else if (edge->function->node != node)
            need(c, edge->function->node, false);
    }
}

/* Prints what is on the stack, each after what it needs; a circle is broken where it closes. */
static void work(composer *c) {
    while (c->stack.count) {
        frame *top = &c->stack.items[c->stack.count - 1];
        plr_node *node = top->node;
        bool declare = top->declare;
        if (!top->ready) {
            bool *entered = declare ? &node->declaring : &node->entered;
            if (node->emitted || *entered) {
                c->stack.count--;
                continue;
            }
            *entered = top->ready = true;
            if (declare)
                need_of_prototype(c, node);
            else
                need_all(c, node);
            continue;
        }
        c->stack.count--;
        if (node->emitted || (declare && node->declared))
            continue;
        if (declare) {
            node->declared = true;
            print_prototype(c, node);
        } else {
            node->emitted = node->declared = true;
            print_item(c, node);
        }
    }
}

static void emit(composer *c, plr_node *node) {
    if (!node->reached || node->dropped || node->emitted)
        return;
    need(c, node, false);
    work(c);
}

static void declare(composer *c, plr_node *node) {
    if (!node->reached || node->item->kind != PLR_ITEM_FUNCTION)
        return;
    need(c, node, true);
    work(c);
}

/* ---- The text ----------------------------------------------------------------------------------
 */

typedef struct extension {
    uint32_t gid;
    unsigned behaviour;
} extension;

typedef PLR_LIST(extension) extensions;

static const char *const behaviours[] = {"disable", "warn", "enable", "require"};

/* Extensions whose words are written anew, and that the program's version has in itself. */
static bool is_replaced(const plr_ident *ident) {
    static const char *const names[] = {"GL_EXT_geometry_shader4", "GL_ARB_geometry_shader4"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strlen(names[i]) == ident->length && memcmp(names[i], ident->text, ident->length) == 0)
            return true;
    return false;
}

/* The strongest behaviour that anyone asks for holds. */
static void merge_extension(composer *c, extensions *list, plr_table *known, const plr_unit *unit,
                            const plr_directive *directive) {
    const plr_lexed *lexed = unit->lexed;
    uint32_t name = directive->token + 1;
    if (directive->end < name + 3 || lexed->tokens.items[name].kind != PLR_T_IDENT ||
        lexed->tokens.items[name + 2].kind != PLR_T_IDENT)
        return;
    const plr_ident *asked = plr_token_ident(unit, name + 2);
    unsigned behaviour = 0;
    for (unsigned b = 0; b < 4; b++)
        if (strlen(behaviours[b]) == asked->length &&
            memcmp(behaviours[b], asked->text, asked->length) == 0)
            behaviour = b;
    if (is_replaced(plr_token_ident(unit, name)))
        return;
    uint32_t gid = plr_token_gid(unit, name);
    void **slot = plr_table_put(c->l->pass, known, (uint64_t)gid + 1);
    if (!*slot) {
        *PLR_PUSH(c->l->pass, list) = (extension){gid, behaviour};
        *slot = (void *)(uintptr_t)list->count;
        return;
    }
    extension *other = &list->items[(uintptr_t)*slot - 1];
    if (behaviour > other->behaviour)
        other->behaviour = behaviour;
}

/* Whether a directive stands in a conditional that is kept. */
static bool is_in_group(const plr_unit *unit, uint32_t token) {
    size_t low = 0, high = unit->cut->items.count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (unit->cut->items.items[middle].end <= token)
            low = middle + 1;
        else
            high = middle;
    }
    return low < unit->cut->items.count && unit->cut->items.items[low].first <= token &&
           unit->cut->items.items[low].kind == PLR_ITEM_GROUP;
}

static void collect_extensions(composer *c, const plr_scope *scope, extensions *list,
                               plr_table *known) {
    for (uint32_t u = 0; u < scope->unit_count; u++) {
        const plr_unit *unit = &scope->units[u];
        for (size_t i = 0; unit->nodes && i < unit->cut->extensions.count; i++) {
            const plr_directive *directive =
                &unit->lexed->directives.items[unit->cut->extensions.items[i]];
            if (!is_in_group(unit, directive->token))
                merge_extension(c, list, known, unit, directive);
        }
    }
}

static void print_group_extensions(composer *c, const plr_scope *scope) {
    for (uint32_t u = 0; u < scope->unit_count; u++) {
        const plr_unit *unit = &scope->units[u];
        if (!unit->nodes || !unit->cut->extensions.count)
            continue;
        for (size_t i = 0; i < unit->cut->items.count; i++) {
            plr_node *node = &unit->nodes[i];
            bool has = false;
            for (size_t k = 0; k < unit->cut->extensions.count; k++) {
                uint32_t token =
                    unit->lexed->directives.items[unit->cut->extensions.items[k]].token;
                has |= token >= node->item->first && token < node->item->end;
            }
            if (has && node->reached && node->item->kind == PLR_ITEM_GROUP)
                plr_print_extensions(c->printer, node);
        }
    }
}

static void print_extensions(composer *c) {
    plr_linking *l = c->l;
    extensions list = {NULL, 0, 0};
    plr_table known = {NULL, NULL, 0, 0};
    plr_scope *scopes = l->scopes[c->stage];
    for (uint32_t e = 0; e < l->effect_count + 2; e++) {
        uint32_t at = e == 0 ? PLR_SCOPE_BASE(l) : e - 1; /* base first */
        if (e == l->effect_count + 1)
            break;
        if (scopes[at].live)
            collect_extensions(c, &scopes[at], &list, &known);
    }
    for (size_t i = 0; i < list.count; i++)
        plr_print_own(c->printer, plr_arena_format(l->pass, "#extension %s : %s\n",
                                                   plr_gid_text(l, list.items[i].gid),
                                                   behaviours[list.items[i].behaviour]));
    print_group_extensions(c, &scopes[PLR_SCOPE_BASE(l)]);
    for (uint32_t e = 0; e < l->effect_count; e++)
        if (scopes[e].live)
            print_group_extensions(c, &scopes[e]);
}

/* ---- The geometry stage ------------------------------------------------------------------------
 */

/* `layout (triangles) in;`: what an input array's size follows from; or a built-in block. */
static bool is_shape(const plr_node *node) {
    const plr_item *item = node->item;
    const plr_unit *unit = node->unit;
    if (item->kind == PLR_ITEM_BLOCK || item->kind == PLR_ITEM_VARIABLE)
        return !node->symbol;
    if (item->kind != PLR_ITEM_KEPT || item->end < item->first + 3)
        return false;
    const plr_token *tokens = unit->lexed->tokens.items;
    uint16_t word = tokens[item->end - 2].kind == PLR_T_IDENT
                        ? plr_token_ident(unit, item->end - 2)->word
                        : PLR_WORD_NONE;
    return tokens[item->first].kind == PLR_T_IDENT &&
           plr_token_ident(unit, item->first)->word == PLR_WORD_layout &&
           (word == PLR_WORD_in || word == PLR_WORD_out);
}

/* An array of arrays is what 3.30 does not have. */
static bool passes_arrays(const plr_linking *l) {
    for (size_t i = 0; i < l->passed.count; i++)
        if (l->passed.items[i].array)
            return true;
    return false;
}

static void print_passed(composer *c) {
    plr_linking *l = c->l;
    for (size_t i = 0; i < l->passed.count; i++) {
        const plr_passed *p = &l->passed.items[i];
        const char *array = p->array ? plr_arena_format(l->pass, "[%u]", (unsigned)p->array) : "";
        if (!p->declared)
            plr_print_own(c->printer, plr_arena_format(l->pass, "%sin %s%s[]%s;\n", p->input,
                                                       p->type, p->name, array));
        plr_print_own(c->printer, plr_arena_format(l->pass, "%sout %s%s%s;\n", p->output, p->type,
                                                   p->passed, array));
    }
}

typedef enum way {
    WAY_SET,
    WAY_ZERO,
    WAY_ADD
} way;

static void print_way(composer *c, const plr_passed *p, way w) {
    plr_linking *l = c->l;
    const char *to = p->passed, *from = plr_arena_format(l->pass, "%s[index]", p->name);
    if (p->array) {
        plr_print_own(c->printer,
                      plr_arena_format(l->pass, "    for (int i = 0; i < %u; i++)\n    ",
                                       (unsigned)p->array));
        to = plr_arena_format(l->pass, "%s[i]", to);
        from = plr_arena_format(l->pass, "%s[i]", from);
    }
    const char *line = plr_arena_format(l->pass, "%s = %s", to, from);
    if (w == WAY_ZERO)
        line = plr_arena_format(l->pass, "%s = %s(0)", to, p->type);
    else if (w == WAY_ADD && !p->whole)
        line = plr_arena_format(l->pass, "%s += %s * scale", to, from);
    plr_print_own(c->printer, plr_arena_format(l->pass, "    %s;\n", line));
}

/* The functions that a base of the stage declares, for its own to call. */
static void print_ways(composer *c) {
    static const struct {
        const char *name, *head;
    } ways[] = {
        [WAY_SET] = {"plugray_varyings_set", "\nvoid plugray_varyings_set(const int index) {\n"},
        [WAY_ZERO] = {"plugray_varyings_zero", "\nvoid plugray_varyings_zero() {\n"},
        [WAY_ADD] = {"plugray_varyings_add",
                     "\nvoid plugray_varyings_add(const int index, const float scale) {\n"},
    };
    plr_linking *l = c->l;
    for (unsigned w = 0; w <= WAY_ADD; w++) {
        uint32_t gid = plr_gid_find(l, ways[w].name, strlen(ways[w].name));
        const plr_binding *symbol =
            gid == PLR_NONE
                ? NULL
                : plr_binding_find(l, plr_scope_of(l, c->stage, PLR_SCOPE_BASE(l)), gid);
        if (!symbol || !symbol->weak || !symbol->reached)
            continue;
        plr_print_own(c->printer, ways[w].head);
        if (l->passes_size && w != WAY_ZERO)
            plr_print_own(c->printer, "    gl_PointSize = gl_in[index].gl_PointSize;\n");
        for (size_t i = 0; i < l->passed.count; i++)
            print_way(c, &l->passed.items[i], (way)w);
        plr_print_own(c->printer, "}\n");
    }
}

static void print_head(composer *c) {
    static const char *const precisions[] = {
        "float",           "int",        "sampler2D",
        "samplerCube",     "sampler3D",  "sampler2DArray",
        "sampler2DShadow", "isampler2D", "isampler3D",
        "usampler2D",      "usampler3D",
    };
    plr_linking *l = c->l;
    bool es = l->desc->glsl == PLR_GLSL_300ES;
    int version = l->version;
    if (c->stage == PLR_GEOMETRY && passes_arrays(l) && version < 430)
        version = 430;
    plr_print_own(c->printer,
                  plr_arena_format(l->pass, "#version %d %s\n", version, es ? "es" : "core"));
    print_extensions(c);
    for (size_t i = 0; es && i < sizeof precisions / sizeof precisions[0]; i++)
        plr_print_own(c->printer,
                      plr_arena_format(l->pass, "precision highp %s;\n", precisions[i]));
    if (c->stage != PLR_FRAGMENT)
        return;
    if (l->uses_color)
        plr_print_own(c->printer, "out vec4 plr_FragColor;\n");
    if (l->uses_data)
        plr_print_own(c->printer, plr_arena_format(l->pass, "out vec4 plr_FragData[%u];\n",
                                                   (unsigned)l->data_size));
}

/* The prototypes of plug functions and of library functions, with what they name. */
static void print_declarations(composer *c) {
    plr_linking *l = c->l;
    if (c->declared)
        return;
    c->declared = true;
    for (uint32_t e = 0; e < l->effect_count; e++) {
        const plr_scope *scope = plr_scope_of(l, c->stage, e);
        for (uint32_t u = 0; scope->live && u < scope->unit_count; u++)
            for (plr_function *f = scope->units[u].functions; f; f = f->next)
                declare(c, f->node);
    }
    const plr_scope *library = plr_scope_of(l, c->stage, PLR_SCOPE_LIBRARY(l));
    for (uint32_t u = 0; u < library->unit_count; u++)
        for (size_t i = 0; library->units[u].nodes && i < library->units[u].cut->items.count; i++)
            declare(c, &library->units[u].nodes[i]);
}

static void print_scope(composer *c, plr_scope *scope) {
    for (uint32_t u = 0; u < scope->unit_count; u++) {
        plr_unit *unit = &scope->units[u];
        for (size_t i = 0; unit->nodes && i < unit->cut->items.count; i++) {
            if (unit->nodes[i].item->kind != PLR_ITEM_DECLARATIONS)
                emit(c, &unit->nodes[i]);
            else if (scope->owner == PLR_OWNER_BASE)
                print_declarations(c);
        }
    }
}

static void print_shapes(composer *c, plr_scope *scope) {
    for (uint32_t u = 0; u < scope->unit_count; u++) {
        plr_unit *unit = &scope->units[u];
        for (size_t i = 0; unit->nodes && i < unit->cut->items.count; i++)
            if (is_shape(&unit->nodes[i]))
                emit(c, &unit->nodes[i]);
    }
}

static bool has_mark(const plr_scope *base) {
    for (uint32_t u = 0; u < base->unit_count; u++)
        for (size_t i = 0; i < base->units[u].cut->items.count; i++)
            if (base->units[u].cut->items.items[i].kind == PLR_ITEM_DECLARATIONS)
                return true;
    return false;
}

void plr_compose(plr_linking *l, plr_stage stage, plr_printer *printer) {
    composer c = {.l = l, .stage = stage, .printer = printer};
    plr_scope *scopes = l->scopes[stage];
    print_head(&c);
    if (stage == PLR_GEOMETRY) {
        for (uint32_t e = 0; e < l->effect_count + 1; e++) /* the effects and the base */
            if (scopes[e].live)
                print_shapes(&c, &scopes[e]);
        print_passed(&c);
    }
    if (!has_mark(&scopes[PLR_SCOPE_BASE(l)]))
        print_declarations(&c);
    print_scope(&c, &scopes[PLR_SCOPE_BASE(l)]);
    for (uint32_t e = 0; e < l->effect_count; e++)
        if (scopes[e].live)
            print_scope(&c, &scopes[e]);
    print_scope(&c, &scopes[PLR_SCOPE_LIBRARY(l)]);
    if (stage == PLR_GEOMETRY)
        print_ways(&c);
}
