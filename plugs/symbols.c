/* The uniforms, attributes and outputs of a program. */
#include "plugs/program.h"

#include <string.h>

/* The number that an identifier stands for: a const int or a macro of one number. */
static uint32_t constant_value(plr_linking *l, const plr_binding *binding, unsigned depth);

static uint32_t token_value(plr_linking *l, const plr_unit *unit, uint32_t token, unsigned depth) {
    const plr_token *t = &unit->lexed->tokens.items[token];
    if (t->kind == PLR_T_IDENT)
        return unit->refs[t->value] && depth < 16
                   ? constant_value(l, unit->refs[t->value], depth + 1)
                   : UINT32_MAX;
    if (t->kind != PLR_T_NUMBER)
        return UINT32_MAX;
    size_t length;
    const char *text = plr_token_text(unit->lexed, t, &length);
    uint32_t number = 0;
    for (size_t i = 0; i < length; i++) {
        if (i == length - 1 && i > 0 && (text[i] == 'u' || text[i] == 'U'))
            break;
        if (text[i] < '0' || text[i] > '9' || number > 100000000)
            return UINT32_MAX;
        number = number * 10 + (uint32_t)(text[i] - '0');
    }
    return number;
}

static uint32_t constant_value(plr_linking *l, const plr_binding *binding, unsigned depth) {
    const plr_definition *d = binding->definitions;
    if (!d || d->next)
        return UINT32_MAX;
    const plr_unit *unit = d->node->unit;
    const plr_token *tokens = unit->lexed->tokens.items;
    uint32_t value = d->name->token + 1, end = d->node->item->end;
    if (d->name->kind == PLR_ITEM_VARIABLE && d->name->qualifiers & PLR_Q_CONST)
        value += tokens[value].kind == '=' ? 1 : end;
    else if (d->name->kind != PLR_ITEM_MACRO)
        return UINT32_MAX;
    bool parens = value < end && tokens[value].kind == '(' && value + 2 < end &&
                  tokens[value + 2].kind == ')' &&
                  tokens[value].offset > tokens[value - 1].offset + tokens[value - 1].length;
    if (parens)
        return value + 3 == end ? token_value(l, unit, value + 1, depth) : UINT32_MAX;
    return value + 1 == end ? token_value(l, unit, value, depth) : UINT32_MAX;
}

uint32_t plr_array_size(plr_linking *l, const plr_unit *unit, uint32_t token, uint32_t end) {
    const plr_token *tokens = unit->lexed->tokens.items;
    if (token >= end || tokens[token].kind != '[')
        return 0;
    return token + 2 < end && tokens[token + 2].kind == ']' ? token_value(l, unit, token + 1, 0)
                                                            : UINT32_MAX;
}

/* What kind of symbol a variable is; false: none. */
static bool symbol_kind(const plr_name *name, plr_stage stage, plr_symbol_kind *kind) {
    if (name->qualifiers & PLR_Q_UNIFORM)
        *kind = PLR_UNIFORM;
    else if (stage == PLR_VERTEX && name->qualifiers & (PLR_Q_IN | PLR_Q_ATTRIBUTE))
        *kind = PLR_ATTRIBUTE;
    else if (stage == PLR_FRAGMENT && name->qualifiers & PLR_Q_OUT)
        *kind = PLR_OUTPUT;
    else
        return false;
    return true;
}

static const char *type_text(plr_program *program, const plr_unit *unit, uint32_t token) {
    size_t size;
    const char *text = plr_token_text(unit->lexed, &unit->lexed->tokens.items[token], &size);
    const plr_token *t = &unit->lexed->tokens.items[token];
    plr_binding *binding = t->kind == PLR_T_IDENT ? unit->refs[t->value] : NULL;
    if (binding) {
        uint32_t length;
        text = plr_binding_text(&program->linking, binding, &length);
        size = length;
    }
    return plr_arena_copy(&program->arena, text, size);
}

static bool is_initialized(const plr_unit *unit, const plr_item *item) {
    if (item->kind != PLR_ITEM_VARIABLE)
        return false;
    for (uint32_t i = item->first; i < item->end; i++)
        if (unit->lexed->tokens.items[i].kind == '=')
            return true;
    return false;
}

static void add_symbol(plr_program *program, plr_table *known, const plr_node *node,
                       const plr_name *name) {
    plr_linking *l = &program->linking;
    const plr_unit *unit = node->unit;
    plr_stage stage = unit->scope->stage;
    plr_symbol_kind kind;
    if (name->kind != PLR_ITEM_VARIABLE || name->type == PLR_NONE ||
        !symbol_kind(name, stage, &kind))
        return;
    const plr_ident *ident = plr_token_ident(unit, name->token);
    if (ident->flags & PLR_IF_GL)
        return;
    uint32_t gid = plr_token_gid(unit, name->token);
    plr_binding *binding = node->symbol;
    if (!binding || binding->gid != gid)
        binding = plr_binding_find(l, unit->scope, gid);
    uint32_t length = ident->length;
    const char *text = binding ? plr_binding_text(l, binding, &length) : ident->text;
    bool owned = binding && binding->renamed;
    uint64_t key =
        ((uint64_t)(owned ? unit->scope->owner + 1 : 0) << 34) | (uint64_t)kind << 32 | gid;
    void **slot = binding && binding->variant ? NULL : plr_table_put(&program->arena, known, key);
    if (slot && *slot) {
        program->symbols.items[(uintptr_t)*slot - 1].stages |= 1u << stage;
        return;
    }
    uint32_t array = plr_array_size(l, unit, name->token + 1, node->item->end);
    if (!array && unit->lexed->tokens.items[name->type + 1].kind == '[')
        array = plr_array_size(l, unit, name->type + 1, node->item->prefix_end);
    *PLR_PUSH(&program->arena, &program->symbols) = (plr_symbol){
        .kind = kind,
        .effect = unit->scope->owner < l->effect_count ? unit->scope->owner : PLR_NO_EFFECT,
        .name = plr_arena_copy(&program->arena, ident->text, ident->length),
        .program = plr_arena_copy(&program->arena, text, length),
        .type = type_text(program, unit, name->type),
        .array = array,
        .stages = 1u << stage,
        .initialized = is_initialized(unit, node->item),
        .place = plr_token_place(unit, name->token)};
    if (slot)
        *slot = (void *)(uintptr_t)program->symbols.count;
}

static void list_scope(plr_program *program, plr_table *known, const plr_scope *scope) {
    for (uint32_t u = 0; u < scope->unit_count; u++) {
        const plr_unit *unit = &scope->units[u];
        for (size_t i = 0; unit->nodes && i < unit->cut->items.count; i++) {
            const plr_node *node = &unit->nodes[i];
            for (uint32_t n = 0; node->emitted && n < node->item->name_count; n++)
                add_symbol(program, known, node, &unit->cut->names.items[node->item->names + n]);
        }
    }
}

static void add_output(plr_program *program, const char *name, const char *text, uint32_t array) {
    *PLR_PUSH(&program->arena, &program->symbols) = (plr_symbol){.kind = PLR_OUTPUT,
                                                                 .effect = PLR_NO_EFFECT,
                                                                 .name = name,
                                                                 .program = text,
                                                                 .type = "vec4",
                                                                 .array = array,
                                                                 .stages = 1u << PLR_FRAGMENT};
}

void plr_list_symbols(plr_program *program) {
    plr_linking *l = &program->linking;
    plr_table known = {NULL, NULL, 0, 0};
    for (uint32_t e = 0; e < l->effect_count + 2; e++) {
        /* base and library first, then the effects */
        uint32_t at = e < 2 ? l->effect_count + e : e - 2;
        for (unsigned s = 0; s < PLR_STAGE_COUNT; s++)
            if (plr_scope_of(l, (plr_stage)s, at)->units)
                list_scope(program, &known, plr_scope_of(l, (plr_stage)s, at));
    }
    if (l->stages & 1u << PLR_FRAGMENT) {
        if (l->uses_color)
            add_output(program, "gl_FragColor", "plr_FragColor", 0);
        if (l->uses_data)
            add_output(program, "gl_FragData", "plr_FragData", l->data_size);
    }
}
