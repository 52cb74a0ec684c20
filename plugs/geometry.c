/* The geometry stage: it is there only where an author gives it a main(), and what the vertex stage
 * hands to the fragment stage goes through it without the authors' doing. */
#include "plugs/link.h"

#include <stdlib.h>
#include <string.h>

/* ---- Whether there is one ----------------------------------------------------------------------
 */

static bool names_main(const plr_source *source) {
    if (!source || source->stage != PLR_GEOMETRY)
        return false;
    for (size_t i = 0; i < source->lexed.idents.count; i++)
        if (source->lexed.idents.items[i].word == PLR_WORD_main)
            return true;
    return false;
}

bool plr_wants_geometry(const plr_linking *l) {
    const plr_link_desc *desc = l->desc;
    bool offered = false, wanted = false;
    if (desc->glsl == PLR_GLSL_300ES)
        return false;
    for (size_t i = 0; i < desc->base_count; i++) {
        offered |= desc->base[i] && desc->base[i]->stage == PLR_GEOMETRY;
        wanted |= names_main(desc->base[i]);
    }
    for (size_t e = 0; offered && e < desc->effect_count && !wanted; e++)
        for (size_t i = 0; !desc->effects[e].disabled && i < desc->effects[e].source_count; i++)
            wanted |= names_main(desc->effects[e].sources[i]);
    return offered && wanted;
}

static plr_binding *main_of(const plr_linking *l, plr_stage stage, uint32_t scope) {
    uint32_t gid = plr_gid_find(l, "main", 4);
    plr_binding *symbol =
        gid == PLR_NONE ? NULL : plr_binding_find(l, plr_scope_of(l, stage, scope), gid);
    return symbol && symbol->function ? symbol : NULL;
}

plr_binding *plr_entry(const plr_linking *l, plr_stage stage) {
    plr_binding *own = main_of(l, stage, PLR_SCOPE_BASE(l));
    if (own || stage != PLR_GEOMETRY || l->main_effect == PLR_NONE)
        return own;
    return main_of(l, stage, l->main_effect);
}

bool plr_declare_main(plr_linking *l, plr_node *node, const plr_name *name) {
    const plr_scope *scope = node->unit->scope;
    const plr_binding *other = plr_entry(l, PLR_GEOMETRY);
    if (!other)
        other = main_of(l, PLR_GEOMETRY, scope->owner);
    bool inner = other && name->inner && other->definitions->node == node; /* of another branch */
    if (other && !inner) {
        const plr_definition *first = other->definitions;
        plr_say(l, PLR_CODE_RESERVED_NAME, plr_token_place(node->unit, name->token),
                "the geometry stage has a main() already");
        plr_say_note(l, plr_token_place(first->node->unit, first->name->token), "it stands here");
        return false;
    }
    plr_declare_name(l, node, name)->renamed = false;
    return true;
}

/* The word of `layout (word) in;` that says what comes in; PLR_NONE: the item is none such. */
static uint32_t input_word(const plr_unit *unit, const plr_item *item) {
    static const char *const words[] = {"points", "lines", "lines_adjacency", "triangles",
                                        "triangles_adjacency"};
    const plr_token *tokens = unit->lexed->tokens.items;
    if (item->kind != PLR_ITEM_KEPT || item->end < item->first + 3 ||
        tokens[item->first].kind != PLR_T_IDENT || tokens[item->end - 2].kind != PLR_T_IDENT ||
        plr_token_ident(unit, item->first)->word != PLR_WORD_layout ||
        plr_token_ident(unit, item->end - 2)->word != PLR_WORD_in)
        return PLR_NONE;
    for (uint32_t i = item->first + 1; i < item->end - 2; i++) {
        const plr_ident *ident = tokens[i].kind == PLR_T_IDENT ? plr_token_ident(unit, i) : NULL;
        for (size_t w = 0; ident && w < sizeof words / sizeof *words; w++)
            if (strlen(words[w]) == ident->length &&
                memcmp(words[w], ident->text, ident->length) == 0)
                return i;
    }
    return PLR_NONE;
}

bool plr_takes_primitive(plr_linking *l, const plr_scope *scope) {
    const char *given = l->desc->primitive;
    for (uint32_t u = 0; given && u < scope->unit_count; u++) {
        const plr_unit *unit = &scope->units[u];
        for (size_t i = 0; unit->cut && i < unit->cut->items.count; i++) {
            uint32_t word = input_word(unit, &unit->cut->items.items[i]);
            const plr_ident *ident = word == PLR_NONE ? NULL : plr_token_ident(unit, word);
            if (!ident ||
                (strlen(given) == ident->length && memcmp(given, ident->text, ident->length) == 0))
                continue;
            plr_say(l, PLR_CODE_WRONG_PRIMITIVE, plr_token_place(unit, word),
                    "this geometry stage takes %.*s, but gets %s", (int)ident->length, ident->text,
                    given);
            return false;
        }
    }
    return true;
}

/* The first unit of an effect in a stage. */
static const plr_source *first_source(const plr_effect *effect, plr_stage stage) {
    for (size_t i = 0; i < effect->source_count; i++)
        if (effect->sources[i] && effect->sources[i]->stage == stage)
            return effect->sources[i];
    return NULL;
}

void plr_say_stages(plr_linking *l) {
    unsigned offered = 0;
    for (size_t i = 0; i < l->desc->base_count; i++)
        if (l->desc->base[i])
            offered |= 1u << l->desc->base[i]->stage;
    bool said = false;
    for (uint32_t e = 0; e < l->effect_count; e++)
        for (unsigned s = 0; s < PLR_STAGE_COUNT && !l->desc->effects[e].disabled; s++) {
            const plr_source *source = first_source(&l->desc->effects[e], (plr_stage)s);
            if (!source || l->stages & 1u << s || l->faulty[e] || l->left_out[e])
                continue;
            plr_place place = plr_source_place(source, source->lexed.tokens.items[0].offset);
            if (!(offered & 1u << s))
                plr_say(l, PLR_CODE_WRONG_STAGE, place,
                        "the base shader has no %s stage; this part of %s is left out",
                        plr_stage_text((plr_stage)s), plr_effect_text(l, e));
            else if (!said)
                plr_say(l, PLR_CODE_NO_MAIN, place,
                        l->desc->glsl == PLR_GLSL_300ES
                            ? "this GLSL has no geometry stage; its parts are left out"
                            : "no geometry part has main(): there is no geometry stage");
            said |= (offered & 1u << s) != 0;
        }
}

/* ---- What goes through it ----------------------------------------------------------------------
 */

plr_binding *plr_geometry_output(plr_linking *l, const plr_unit *unit, uint32_t gid) {
    const plr_scope *scope = unit->scope;
    if (scope->stage != PLR_FRAGMENT || scope->owner >= l->effect_count ||
        !(l->stages & 1u << PLR_GEOMETRY))
        return NULL;
    plr_binding *output = plr_binding_find(l, plr_scope_of(l, PLR_GEOMETRY, scope->owner), gid);
    if (!output || output->weak || !output->variable ||
        !(output->definitions->name->qualifiers & PLR_Q_OUT))
        return NULL;
    plr_binding *symbol = PLR_NEW(l->pass, plr_binding);
    *symbol = (plr_binding){.gid = gid, .scope = unit->scope, .renamed = true};
    symbol->text = plr_binding_text(l, output, &symbol->length);
    return symbol;
}

/* A variable that joins two stages. */
typedef struct joint {
    const char *text; /* in the program; not terminated */
    uint32_t length;
    plr_binding *symbol;
    const plr_node *node;
    const plr_name *name;
} joint;

typedef PLR_LIST(joint) joints;

static int by_text(const void *a, const void *b) {
    const joint *x = a, *y = b;
    uint32_t least = x->length < y->length ? x->length : y->length;
    int order = memcmp(x->text, y->text, least);
    return order ? order : (x->length > y->length) - (x->length < y->length);
}

/* What an item declares of that kind: a variable, a block, or those of a conditional. */
static void collect_item(plr_linking *l, const plr_node *node, uint8_t qualifiers, joints *list) {
    const plr_unit *unit = node->unit;
    const plr_name *names = &unit->cut->names.items[node->item->names];
    bool group = node->item->kind == PLR_ITEM_GROUP;
    if (!node->reached || node->dropped ||
        !(group || node->item->kind == PLR_ITEM_VARIABLE || node->item->kind == PLR_ITEM_BLOCK))
        return;
    for (uint32_t n = 0; n < (group ? node->item->name_count : 1); n++) {
        plr_binding *symbol =
            group ? plr_binding_find(l, unit->scope, plr_token_gid(unit, names[n].token))
                  : node->symbol;
        if (!symbol || !(names[n].qualifiers & qualifiers))
            continue;
        joint *added = PLR_PUSH(l->pass, list);
        *added = (joint){.symbol = symbol, .node = node, .name = &names[n]};
        added->text = plr_binding_text(l, symbol, &added->length);
    }
}

/* The reached variables of a stage with one of the qualifiers, by name in the program. */
static joints collect(plr_linking *l, plr_stage stage, uint8_t qualifiers) {
    joints list = {NULL, 0, 0};
    for (uint32_t e = 0; e < l->effect_count + 3; e++) {
        const plr_scope *scope = plr_scope_of(l, stage, e);
        for (uint32_t u = 0; u < scope->unit_count; u++) {
            const plr_unit *unit = &scope->units[u];
            for (size_t i = 0; unit->nodes && i < unit->cut->items.count; i++)
                if (unit->cut->items.items[i].name_count)
                    collect_item(l, &unit->nodes[i], qualifiers, &list);
        }
    }
    if (list.count)
        qsort(list.items, list.count, sizeof *list.items, by_text);
    return list;
}

static const joint *find(const joints *list, const joint *wanted) {
    return list->count ? bsearch(wanted, list->items, list->count, sizeof *list->items, by_text)
                       : NULL;
}

static void add_word(plr_linking *l, const char **text, const plr_unit *unit, uint32_t token) {
    size_t length;
    const char *word = plr_token_text(unit->lexed, &unit->lexed->tokens.items[token], &length);
    *text = plr_arena_format(l->pass, "%s%.*s ", *text, (int)length, word);
}

/* The words of a variable's type, and apart from them how it is interpolated. */
static void read_type(plr_linking *l, const joint *variable, const char **type,
                      const char **interpolation) {
    const plr_unit *unit = variable->node->unit;
    const plr_item *item = variable->node->item;
    const plr_token *tokens = unit->lexed->tokens.items;
    *type = *interpolation = "";
    for (uint32_t i = plr_active(unit->lexed, unit->activity, item->prefix); i < item->prefix_end;
         i = plr_active(unit->lexed, unit->activity, i + 1)) {
        uint16_t word = tokens[i].kind == PLR_T_IDENT ? plr_token_ident(unit, i)->word : 0;
        if (word == PLR_WORD_layout && tokens[i + 1].value != PLR_NONE)
            i = tokens[i + 1].value;
        else if (word == PLR_WORD_flat || word == PLR_WORD_noperspective)
            add_word(l, interpolation, unit, i);
        else if (tokens[i].kind == PLR_T_IDENT &&
                 !(plr_word_get(word)->kinds & PLR_WORD_IS_QUALIFIER))
            add_word(l, type, unit, i);
    }
}

static bool is_whole(const plr_passed *passed) {
    return strchr("iud", passed->type[0]) != NULL || strstr(passed->output, "flat") != NULL;
}

/* vec4 v[8], vec4[8] v */
static uint32_t array_of(plr_linking *l, const joint *variable) {
    const plr_unit *unit = variable->node->unit;
    const plr_item *item = variable->node->item;
    uint32_t array = plr_array_size(l, unit, variable->name->token + 1, item->end);
    return array ? array : plr_array_size(l, unit, variable->name->type + 1, item->prefix_end);
}

static void pass(plr_linking *l, const joint *from, const joint *to, bool declared) {
    const char *unused;
    plr_passed passed = {.name = plr_arena_copy(l->pass, from->text, from->length),
                         .declared = declared,
                         .array = array_of(l, to)};
    passed.passed = plr_arena_format(l->pass, PLR_PASSED "%s", passed.name);
    read_type(l, from, &unused, &passed.input);
    read_type(l, to, &passed.type, &passed.output);
    passed.whole = is_whole(&passed);
    *PLR_PUSH(l->pass, &l->passed) = passed;
    to->symbol->passed = true;
    to->symbol->text = passed.passed;
    to->symbol->length = (uint32_t)strlen(passed.passed);
}

/* Why a varying cannot be handed on; NULL: it can. */
static const char *obstacle(plr_linking *l, const joint *variable) {
    const plr_unit *unit = variable->node->unit;
    const plr_token *type =
        variable->name->type == PLR_NONE ? NULL : &unit->lexed->tokens.items[variable->name->type];
    if (variable->node->item->kind == PLR_ITEM_GROUP)
        return "whether it is there is known to the compiler alone";
    if (variable->node->item->kind == PLR_ITEM_BLOCK)
        return "it is a block";
    if (!type || type->kind != PLR_T_IDENT || unit->refs[type->value])
        return "its type is none of GLSL's own";
    return array_of(l, variable) == UINT32_MAX ? "the size of its array is no number" : NULL;
}

/* Leaves out the effect that has such a varying; if the base has it, the one with main(). */
static void refuse(plr_linking *l, const joint *variable, const char *why) {
    const plr_unit *unit = variable->node->unit;
    uint32_t owner = unit->scope->owner < l->effect_count ? unit->scope->owner : l->main_effect;
    if (owner == PLR_NONE || l->unfit[owner])
        return;
    const plr_message message = {
        .severity = PLR_ERROR,
        .code = PLR_CODE_GLSL_LINK,
        .place = plr_token_place(unit, variable->name->token),
        .text = plr_arena_format(l->arena, "\"%s\" cannot go through the geometry stage: %s",
                                 plr_gid_text(l, plr_token_gid(unit, variable->name->token)), why)};
    plr_leave_out(l, owner, &message);
}

/* Names that were to be copied have another text now. */
static void rename_passed(plr_linking *l) {
    for (uint32_t e = 0; e < l->effect_count + 3; e++) {
        const plr_scope *scope = plr_scope_of(l, PLR_FRAGMENT, e);
        for (uint32_t u = 0; u < scope->unit_count; u++) {
            const plr_unit *unit = &scope->units[u];
            for (size_t i = 0; i < unit->lexed->idents.count; i++)
                if (unit->refs[i] && unit->refs[i]->passed && unit->actions[i] == PLR_ACTION_COPY)
                    unit->actions[i] = PLR_ACTION_NAME;
        }
    }
}

/* Whether the vertex stage sets the size of points. */
static bool sizes_points(const plr_linking *l) {
    for (uint32_t e = 0; e < l->effect_count + 3; e++) {
        const plr_scope *scope = plr_scope_of(l, PLR_VERTEX, e);
        for (uint32_t u = 0; u < scope->unit_count; u++) {
            const plr_unit *unit = &scope->units[u];
            for (size_t i = 0; i < unit->lexed->idents.count; i++)
                if (unit->lexed->idents.items[i].word == PLR_WORD_gl_PointSize &&
                    unit->actions[i] != PLR_ACTION_UNKNOWN)
                    return true;
        }
    }
    return false;
}

void plr_pass_varyings(plr_linking *l) {
    const unsigned all = 1u << PLR_VERTEX | 1u << PLR_GEOMETRY | 1u << PLR_FRAGMENT;
    if ((l->stages & all) != all)
        return;
    l->passes_size = sizes_points(l);
    joints given = collect(l, PLR_VERTEX, PLR_Q_OUT | PLR_Q_VARYING);
    joints taken = collect(l, PLR_FRAGMENT, PLR_Q_IN | PLR_Q_VARYING);
    joints inputs = collect(l, PLR_GEOMETRY, PLR_Q_IN | PLR_Q_VARYING);
    joints outputs = collect(l, PLR_GEOMETRY, PLR_Q_OUT);
    for (size_t i = 0; i < taken.count; i++) {
        const joint *to = &taken.items[i], *from = find(&given, to);
        if (!from || to->symbol->macro || to->symbol->passed || find(&outputs, to))
            continue;
        const char *why = obstacle(l, to);
        if (why || (why = obstacle(l, from)))
            refuse(l, to, why);
        else
            pass(l, from, to, find(&inputs, to) != NULL);
    }
    rename_passed(l);
}
