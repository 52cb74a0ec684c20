/* Nodes and fields for what a glTF file describes. */
#include "x3d/gltf_internal.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

plr_node *gltf_node(gltf *g, const char *type, const x3d_json *from) {
    plr_place place = gltf_place(g, from);
    if (g->scene->stopped)
        return NULL;
    return x3d_node_new(g->scene, x3d_type_find(g->scene, type, strlen(type), place), place);
}

static plr_field *field_of(gltf *g, plr_node *node, const char *name) {
    if (!node)
        return NULL;
    size_t index = x3d_field_index(g->scene, node, name, strlen(name), node->place);
    if (index == SIZE_MAX)
        return NULL;
    node->fields[index].given = true;
    return &node->fields[index];
}

void gltf_set_bool(gltf *g, plr_node *node, const char *field, bool value) {
    plr_field *target = field_of(g, node, field);
    if (!target)
        return;
    bool *copy = PLR_NEW(&g->scene->arena, bool);
    *copy = value;
    target->value.bools = copy;
    target->count = 1;
}

void gltf_set_numbers(gltf *g, plr_node *node, const char *field, const double *values,
                      size_t count) {
    plr_field *target = field_of(g, node, field);
    if (!target)
        return;
    float *copy = PLR_NEW_ARRAY(&g->scene->arena, count, float);
    for (size_t i = 0; i < count; i++)
        copy[i] = (float)values[i];
    target->value.floats = copy;
    target->count = count / (size_t)plr_type_components(target->type);
}

void gltf_set_number(gltf *g, plr_node *node, const char *field, double value) {
    gltf_set_numbers(g, node, field, &value, 1);
}

void gltf_set_list(gltf *g, plr_node *node, const char *field, const void *values, size_t count,
                   const x3d_json *from) {
    plr_field *target = field_of(g, node, field);
    if (!target)
        return;
    target->value.any = values;
    target->count = count;
    target->place = gltf_place(g, from);
}

void gltf_set_string(gltf *g, plr_node *node, const char *field, const char *text, size_t length,
                     const x3d_json *from) {
    plr_field *target = field_of(g, node, field);
    if (!target)
        return;
    plr_string *string = PLR_NEW(&g->scene->arena, plr_string);
    plr_place place = gltf_place(g, from);
    *string = (plr_string){text, length, {place.file, place.line, place.column, NULL, 0}};
    target->value.strings = string;
    target->count = 1;
    target->place = place;
}

void gltf_add_node(gltf *g, plr_node *node, const char *field, plr_node *child) {
    plr_field *target = child ? field_of(g, node, field) : NULL;
    if (target)
        x3d_append_node(g->scene, target, child);
}

/* ---- Names ---- */

void gltf_define(gltf *g, plr_node *node, const x3d_json *name) {
    if (!node || !name || !name->count || node->def || memchr(name->value.text, '\0', name->count))
        return;
    plr_arena *arena = &g->scene->arena;
    x3d_scope *scope = g->build->scope;
    void **slot = x3d_names_at(&scope->defs, arena, name->value.text, name->count);
    if (*slot)
        return;
    x3d_def *def = PLR_NEW(arena, x3d_def);
    def->node = def->first = node;
    *slot = def;
    node->def = plr_arena_copy(arena, name->value.text, name->count);
    *x3d_names_at(&scope->exports, arena, name->value.text, name->count) = node;
}

void gltf_define_later(gltf *g, plr_node *node, const x3d_json *object) {
    const x3d_json *name = node ? gltf_text(g, object, "name") : NULL;
    if (name)
        *PLR_PUSH(g->scratch, &g->names) = (gltf_name){node, name};
}

void gltf_define_rest(gltf *g) {
    for (size_t i = 0; i < g->names.count; i++)
        gltf_define(g, g->names.items[i].node, g->names.items[i].name);
}

void **gltf_made(gltf *g, const char *format, ...) {
    char key[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(key, sizeof key, format, arguments);
    va_end(arguments);
    return x3d_names_at(&g->made, g->scratch, key, strlen(key));
}
