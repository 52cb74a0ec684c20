#include "dump.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct text {
    char *data;
    size_t length, capacity;
} text;

static void add(text *t, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    char *piece = NULL;
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    piece = malloc((size_t)length + 1);
    va_start(arguments, format);
    vsnprintf(piece, (size_t)length + 1, format, arguments);
    va_end(arguments);
    if (t->length + (size_t)length + 1 > t->capacity) {
        t->capacity = (t->length + (size_t)length + 1) * 2;
        t->data = realloc(t->data, t->capacity);
    }
    memcpy(t->data + t->length, piece, (size_t)length + 1);
    t->length += (size_t)length;
    free(piece);
}

static void add_node(text *t, const plr_scene *scene, const plr_node *node, int *numbers, int *next,
                     int depth);

static void add_value(text *t, const plr_scene *scene, const plr_field *field, int *numbers,
                      int *next, int depth) {
    size_t numbers_there = field->count * (size_t)plr_type_components(field->type);
    for (size_t i = 0; i < numbers_there; i++)
        switch (plr_type_kind(field->type)) {
        case PLR_BOOL:
            add(t, " %s", field->value.bools[i] ? "TRUE" : "FALSE");
            break;
        case PLR_INT:
            add(t, " %d", field->value.ints[i]);
            break;
        case PLR_FLOAT:
            add(t, " %.9g", (double)field->value.floats[i]);
            break;
        case PLR_DOUBLE:
            add(t, " %.17g", field->value.doubles[i]);
            break;
        case PLR_STRING:
            add(t, " \"%s\"", field->value.strings[i].text);
            break;
        case PLR_NODE:
            add(t, "\n");
            add_node(t, scene, field->value.nodes[i], numbers, next, depth + 1);
            break;
        }
}

static void add_node(text *t, const plr_scene *scene, const plr_node *node, int *numbers, int *next,
                     int depth) {
    uint32_t id = plr_node_id(node);
    add(t, "%*s", depth * 2, "");
    if (numbers[id]) {
        add(t, "(%d)", numbers[id]);
        return;
    }
    numbers[id] = ++*next;
    add(t, "%d %s %s", numbers[id], plr_node_type(node),
        plr_node_def(node) ? plr_node_def(node) : "-");
    for (size_t i = 0; i < plr_node_field_count(node); i++) {
        const plr_field *field = plr_node_field_at(node, i);
        if (!field->given && !field->declared && strcmp(field->name, "children") != 0)
            continue;
        if (!field->count && (!field->given || plr_type_kind(field->type) == PLR_NODE))
            continue; /* an empty list of nodes is the same as none */
        add(t, "\n%*s.%s %s%s", depth * 2 + 1, "", field->name, plr_type_name(field->type),
            field->declared ? " declared" : "");
        add_value(t, scene, field, numbers, next, depth);
    }
}

char *dump_scene(const plr_scene *scene) {
    text t = {0};
    int *numbers = calloc(plr_scene_node_count(scene) + 1, sizeof *numbers), next = 0;
    for (size_t i = 0; i < plr_scene_root_count(scene); i++) {
        add_node(&t, scene, plr_scene_root(scene, i), numbers, &next, 0);
        add(&t, "\n");
    }
    for (size_t i = 0; i < plr_scene_route_count(scene); i++) {
        const plr_route *route = plr_scene_route(scene, i);
        add(&t, "ROUTE %d.%s TO %d.%s\n", numbers[plr_node_id(route->from)], route->from_field,
            numbers[plr_node_id(route->to)], route->to_field);
    }
    free(numbers);
    return t.data ? t.data : calloc(1, 1);
}

char *dump_diags(const plr_diags *diags) {
    text t = {0};
    for (size_t i = 0; i < plr_diags_count(diags); i++) {
        const plr_diag *diag = plr_diags_get(diags, i);
        add(&t, "%u:%u %s %s: %s\n", diag->place.line, diag->place.column,
            plr_severity_text(diag->severity), plr_code_text(diag->code), diag->message);
    }
    return t.data ? t.data : calloc(1, 1);
}

plr_scene *parse_text(const char *content, const char *name, plr_diags **diags) {
    *diags = plr_diags_create(NULL);
    return plr_scene_parse(content, strlen(content), name, NULL, *diags);
}
