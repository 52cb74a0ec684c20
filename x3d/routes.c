/* What waits for the end of its scope: IMPORT, EXPORT and ROUTE. */
#include "x3d/build.h"

#include <string.h>

void x3d_add_route(x3d_build *build, const x3d_pending_route *route) {
    *PLR_PUSH(&build->scene->arena, &build->scope->routes) = *route;
}

static int shown(x3d_label label) {
    return label.length > 100 ? 100 : (int)label.length;
}

static x3d_def *find_def(const x3d_build *build, x3d_label name) {
    return x3d_names_find(&build->scope->defs, name.text, name.length);
}

static void unknown_def(x3d_build *build, x3d_label name, const char *statement) {
    x3d_report(build->scene, PLR_CODE_UNKNOWN_DEF, name.place, "%s of the unknown name '%.*s'",
               statement, shown(name), name.text);
    x3d_nearest nearest = {name.text, name.length, NULL, 0};
    x3d_offer_all(build->scene, &nearest, &build->scope->defs);
    x3d_suggest(build->scene, name.place, &nearest);
}

/* ---- IMPORT and EXPORT ---- */

static bool import_now(x3d_build *build, const x3d_pending_import *import) {
    x3d_def *inlined = find_def(build, import->inlined);
    if (!inlined || !inlined->node || !inlined->node->inlined)
        return false;
    plr_node *node = x3d_names_find(&inlined->node->inlined->exports, import->exported.text,
                                    import->exported.length);
    if (!node)
        return false;
    plr_arena *arena = &build->scene->arena;
    void **slot =
        x3d_names_at(&build->scope->defs, arena, import->local.text, import->local.length);
    if (!*slot)
        *slot = PLR_NEW(arena, x3d_def);
    ((x3d_def *)*slot)->node = node; /* `first` stays: the node is not of this file */
    return true;
}

void x3d_add_import(x3d_build *build, const x3d_pending_import *import) {
    if (!import_now(build, import))
        *PLR_PUSH(&build->scene->arena, &build->scope->imports) = *import;
}

static void end_import(x3d_build *build, const x3d_pending_import *import) {
    if (import_now(build, import))
        return;
    x3d_def *inlined = find_def(build, import->inlined);
    x3d_define_skipped(build, import->local);
    if (!inlined || (!inlined->node && !inlined->skipped))
        unknown_def(build, import->inlined, "IMPORT");
    else if (inlined->node && !x3d_is_inline(inlined->node))
        x3d_report(build->scene, PLR_CODE_UNKNOWN_DEF, import->inlined.place,
                   "IMPORT from '%.*s', which is no Inline", shown(import->inlined),
                   import->inlined.text);
    else if (inlined->node && inlined->node->inlined)
        x3d_report(build->scene, PLR_CODE_UNKNOWN_DEF, import->exported.place,
                   "the inlined file exports no '%.*s'", shown(import->exported),
                   import->exported.text);
}

void x3d_add_export(x3d_build *build, const x3d_pending_import *export) {
    *PLR_PUSH(&build->scene->arena, &build->scope->export_names) = *export;
}

static void end_export(x3d_build *build, const x3d_pending_import *export) {
    x3d_def *def = find_def(build, export->exported);
    if (!def || (!def->node && !def->skipped))
        unknown_def(build, export->exported, "EXPORT");
    else if (def->node)
        *x3d_names_at(&build->scope->exports, &build->scene->arena, export->local.text,
                      export->local.length) = def->node;
}

/* ---- ROUTE ---- */

typedef struct route_end {
    plr_node *node;
    size_t field;
} route_end;

typedef struct end_list {
    route_end *items;
    size_t count, capacity;
} end_list;

static size_t index_in(const plr_node *node, const char *name, size_t length) {
    for (size_t i = 0; i < node->field_count; i++)
        if (strlen(node->fields[i].name) == length &&
            memcmp(node->fields[i].name, name, length) == 0)
            return i;
    return SIZE_MAX;
}

/* By its own name, or as set_x or x_changed. */
static size_t find_event(x3d_build *build, const plr_node *node, x3d_label name, bool output) {
    size_t index = index_in(node, name.text, name.length);
    if (index != SIZE_MAX || !x3d_spend(build->scene, 3 * node->field_count, name.place))
        return index;
    if (!output && name.length > 4 && memcmp(name.text, "set_", 4) == 0)
        index = index_in(node, name.text + 4, name.length - 4);
    if (output && name.length > 8 && memcmp(name.text + name.length - 8, "_changed", 8) == 0)
        index = index_in(node, name.text, name.length - 8);
    return index != SIZE_MAX
               ? index
               : x3d_field_index(build->scene, node, name.text, name.length, name.place);
}

static const plr_node *outside_of(const plr_node *node) {
    return node->instance ? node->instance->proto->interface : node;
}

static bool may_flow(const plr_field *field, bool output) {
    return field->access == PLR_INPUT_OUTPUT ||
           field->access == (output ? PLR_OUTPUT_ONLY : PLR_INPUT_ONLY);
}

/* The field that one end of a ROUTE names; NULL: reported. */
static const plr_field *find_end(x3d_build *build, x3d_label node_name, x3d_label field_name,
                                 bool output, plr_node **node, size_t *index) {
    plr_scene *scene = build->scene;
    x3d_def *def = find_def(build, node_name);
    if (def && def->skipped)
        return NULL;
    if (!def || !def->node) {
        unknown_def(build, node_name, "ROUTE");
        return NULL;
    }
    *node = def->node;
    const plr_node *outside = outside_of(def->node);
    *index = find_event(build, outside, field_name, output);
    if (*index == SIZE_MAX) {
        x3d_report(scene, PLR_CODE_BAD_ROUTE, field_name.place, "%s has no field '%.*s'",
                   def->node->written, shown(field_name), field_name.text);
        x3d_nearest nearest = {field_name.text, field_name.length, NULL, 0};
        for (size_t i = 0; i < outside->field_count; i++)
            if (may_flow(&outside->fields[i], output))
                x3d_offer(scene, &nearest, outside->fields[i].name);
        x3d_suggest(scene, field_name.place, &nearest);
        return NULL;
    }
    const plr_field *field = &outside->fields[*index];
    if (may_flow(field, output))
        return field;
    x3d_report(scene, PLR_CODE_BAD_ROUTE, field_name.place, "%s.%s does not %s events",
               def->node->written, field->name, output ? "send" : "receive");
    return NULL;
}

static void collect(x3d_build *build, plr_node *node, size_t index, plr_place place,
                    end_list *ends) {
    plr_arena *arena = &build->scene->arena;
    if (!node->instance) {
        *PLR_PUSH(arena, ends) = (route_end){node, index};
        return;
    }
    if (!x3d_spend(build->scene, node->instance->target_count, place))
        return;
    for (size_t i = 0; i < node->instance->target_count; i++)
        if (node->instance->targets[i].interface == index)
            *PLR_PUSH(arena, ends) =
                (route_end){node->instance->targets[i].node, node->instance->targets[i].field};
}

static void end_route(x3d_build *build, const x3d_pending_route *route) {
    plr_scene *scene = build->scene;
    plr_node *from_node = NULL, *to_node = NULL;
    size_t from_index = 0, to_index = 0;
    const plr_field *from =
        find_end(build, route->from, route->from_field, true, &from_node, &from_index);
    const plr_field *to = find_end(build, route->to, route->to_field, false, &to_node, &to_index);
    if (!from || !to)
        return;
    if (from->type != to->type) {
        x3d_report(scene, PLR_CODE_BAD_ROUTE, route->place, "'%s' is %s, but '%s' is %s",
                   from->name, plr_type_name(from->type), to->name, plr_type_name(to->type));
        return;
    }
    end_list sources = {0}, targets = {0};
    collect(build, from_node, from_index, route->place, &sources);
    collect(build, to_node, to_index, route->place, &targets);
    x3d_proto *proto = build->scope->proto;
    enum {
        MOST_BRANCHES = 1000000
    };
    if (sources.count && targets.count > MOST_BRANCHES / sources.count) {
        x3d_report(scene, PLR_CODE_LIMIT, route->place, "the ROUTE has too many branches");
        return;
    }
    for (size_t i = 0; i < sources.count; i++)
        for (size_t k = 0; k < targets.count; k++)
            *PLR_PUSH(&scene->arena, proto ? &proto->routes : &scene->routes) =
                (plr_route){sources.items[i].node,
                            targets.items[k].node,
                            sources.items[i].node->fields[sources.items[i].field].name,
                            targets.items[k].node->fields[targets.items[k].field].name,
                            (uint32_t)sources.items[i].field,
                            (uint32_t)targets.items[k].field,
                            route->place};
}

void x3d_scope_end(x3d_build *build) {
    x3d_scope *scope = build->scope;
    for (size_t i = 0; i < scope->imports.count && !build->scene->stopped; i++)
        end_import(build, &scope->imports.items[i]);
    for (size_t i = 0; i < scope->export_names.count && !build->scene->stopped; i++)
        end_export(build, &scope->export_names.items[i]);
    for (size_t i = 0; i < scope->routes.count && !build->scene->stopped; i++)
        end_route(build, &scope->routes.items[i]);
}
