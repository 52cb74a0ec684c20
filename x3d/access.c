/* The public accessors of scenes, nodes and values. */
#include "x3d/scene.h"

#include <string.h>

#include "x3d/build.h"

size_t plr_scene_root_count(const plr_scene *scene) {
    return scene->nodes.count;
}

plr_node *plr_scene_root(const plr_scene *scene, size_t index) {
    return index < scene->nodes.count ? scene->nodes.items[index] : NULL;
}

plr_node *plr_scene_find(const plr_scene *scene, const char *def) {
    x3d_def *found = scene->scope ? x3d_names_find(&scene->scope->defs, def, strlen(def)) : NULL;
    return found ? found->first : NULL;
}

const char *plr_scene_version(const plr_scene *scene) {
    return scene->version;
}
double plr_scene_length_unit(const plr_scene *scene) {
    return scene->length_unit;
}
double plr_scene_angle_unit(const plr_scene *scene) {
    return scene->angle_unit;
}

const char *plr_scene_meta(const plr_scene *scene, size_t index, const char **content) {
    if (index >= scene->metas.count)
        return NULL;
    if (content)
        *content = scene->metas.items[index].content;
    return scene->metas.items[index].name;
}

bool plr_scene_uses_2005(const plr_scene *scene, plr_place *where) {
    if (scene->uses_2005 && where)
        *where = scene->place_2005;
    return scene->uses_2005;
}

const char *plr_scene_line(const plr_scene *scene, const char *file, uint32_t line,
                           size_t *length) {
    if (!file || !line)
        return NULL;
    for (const x3d_file *f = scene->files; f; f = f->next) {
        if ((f->name != file && strcmp(f->name, file) != 0) || line > f->line_count)
            continue;
        size_t start = f->lines[line - 1];
        size_t end = line < f->line_count ? f->lines[line] - 1 : f->length;
        if (end > start && f->text[end - 1] == '\r')
            end--;
        *length = end - start;
        return f->text + start;
    }
    return NULL;
}

size_t plr_scene_route_count(const plr_scene *scene) {
    return scene->routes.count;
}

const plr_route *plr_scene_route(const plr_scene *scene, size_t index) {
    return index < scene->routes.count ? &scene->routes.items[index] : NULL;
}

uint32_t plr_scene_node_count(const plr_scene *scene) {
    return scene->node_count;
}

const char *plr_node_type(const plr_node *node) {
    return node->type->info->name;
}

bool plr_node_is(const plr_node *node, const char *type) {
    return node && plr_node_info_is(node->type->info, type);
}

const char *plr_node_def(const plr_node *node) {
    return node->def;
}
plr_place plr_node_place(const plr_node *node) {
    return node->place;
}
uint32_t plr_node_id(const plr_node *node) {
    return node->id;
}
const char *plr_node_written_type(const plr_node *node) {
    return node->written;
}

const plr_field *plr_node_field(const plr_node *node, const char *name) {
    for (size_t i = 0; node && i < node->field_count; i++)
        if (strcmp(node->fields[i].name, name) == 0)
            return &node->fields[i];
    return NULL;
}

size_t plr_node_field_count(const plr_node *node) {
    return node->field_count;
}

const plr_field *plr_node_field_at(const plr_node *node, size_t index) {
    return index < node->field_count ? &node->fields[index] : NULL;
}

static const plr_field *field_of_kind(const plr_node *node, const char *name, plr_kind kind) {
    const plr_field *field = plr_node_field(node, name);
    return field && field->count && plr_type_kind(field->type) == kind ? field : NULL;
}

bool plr_node_bool(const plr_node *node, const char *field) {
    const plr_field *found = field_of_kind(node, field, PLR_BOOL);
    return found && found->value.bools[0];
}

int32_t plr_node_int(const plr_node *node, const char *field) {
    const plr_field *found = field_of_kind(node, field, PLR_INT);
    return found ? found->value.ints[0] : 0;
}

static double number_at(const plr_field *field, size_t index) {
    switch (plr_type_kind(field->type)) {
    case PLR_INT:
        return field->value.ints[index];
    case PLR_FLOAT:
        return (double)field->value.floats[index];
    case PLR_DOUBLE:
        return field->value.doubles[index];
    default:
        return 0;
    }
}

double plr_node_number(const plr_node *node, const char *field) {
    const plr_field *found = plr_node_field(node, field);
    return found && found->count ? number_at(found, 0) : 0;
}

const char *plr_node_string(const plr_node *node, const char *field) {
    const plr_field *found = field_of_kind(node, field, PLR_STRING);
    return found ? found->value.strings[0].text : "";
}

plr_node *plr_node_child(const plr_node *node, const char *field) {
    const plr_field *found = field_of_kind(node, field, PLR_NODE);
    return found ? found->value.nodes[0] : NULL;
}

size_t plr_node_numbers(const plr_node *node, const char *field, float *numbers, size_t count) {
    const plr_field *found = plr_node_field(node, field);
    if (!found)
        return 0;
    plr_kind kind = plr_type_kind(found->type);
    if (kind != PLR_INT && kind != PLR_FLOAT && kind != PLR_DOUBLE)
        return 0;
    size_t there = found->count * (size_t)plr_type_components(found->type);
    if (there < count)
        count = there;
    for (size_t i = 0; i < count; i++)
        numbers[i] = (float)number_at(found, i);
    return count;
}
