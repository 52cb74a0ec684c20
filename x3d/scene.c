#include "x3d/scene.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "x3d/values.h"

enum {
    MOST_REPORTS = 1000,
    MESSAGE_SIZE = 512
};

/* How many bytes the UTF-8 character at `p` has; 0: it is none. */
static size_t utf8_length(const unsigned char *p) {
    static const unsigned char least[] = {0, 0, 0xc2, 0xe0, 0xf0};
    size_t length = *p < 0x80 ? 1 : *p < 0xe0 ? 2 : *p < 0xf0 ? 3 : 4;
    if (length > 1 && (*p < least[length] || *p > 0xf4))
        return 0;
    for (size_t i = 1; i < length; i++)
        if ((p[i] & 0xc0) != 0x80)
            return 0;
    return length;
}

/* Messages hold names from the file, perhaps cut: what is not text must not get through. */
static void clean_message(char *text) {
    for (unsigned char *p = (unsigned char *)text; *p;) {
        size_t length = utf8_length(p);
        if (!length || *p < ' ' || *p == 0x7f)
            *p = '?';
        p += length ? length : 1;
    }
}

static bool may_report(plr_scene *scene, plr_place place) {
    if (scene->reported < MOST_REPORTS) {
        scene->reported++;
        return true;
    }
    if (scene->reported == MOST_REPORTS) {
        scene->reported++;
        plr_diags_add(scene->diags, PLR_CODE_LIMIT, place,
                      "more than %d faults, the rest is not shown", MOST_REPORTS);
    }
    return false;
}

void x3d_report(plr_scene *scene, plr_code code, plr_place place, const char *format, ...) {
    if (!may_report(scene, place))
        return;
    char message[MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    clean_message(message);
    plr_diags_add(scene->diags, code, place, "%s", message);
}

void x3d_warn(plr_scene *scene, plr_code code, plr_place place, const char *format, ...) {
    if (!may_report(scene, place))
        return;
    char message[MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    clean_message(message);
    plr_diags_add_as(scene->diags, PLR_WARNING, code, place, "%s", message);
}

bool x3d_spend(plr_scene *scene, size_t steps, plr_place place) {
    if (steps <= scene->work_budget) {
        scene->work_budget -= steps;
        return true;
    }
    if (!scene->stopped)
        x3d_report(scene, PLR_CODE_LIMIT, place, "ROUTEs and prototypes are too many");
    scene->stopped = true;
    return false;
}

void x3d_suggest(plr_scene *scene, plr_place place, const x3d_nearest *nearest) {
    if (nearest->best && scene->reported <= MOST_REPORTS)
        plr_diags_note(scene->diags, place, "did you mean '%s'?", nearest->best);
}

/* ---- Memory ---- */

static void *counting_reallocate(void *user, void *pointer, size_t size) {
    plr_scene *scene = user;
    if (size > scene->max_memory - scene->used_memory)
        return NULL;
    void *memory = scene->allocator.reallocate(scene->allocator.user, pointer, size);
    if (memory)
        scene->used_memory += size;
    return memory;
}

static void counting_release(void *user, void *pointer) {
    plr_scene *scene = user;
    scene->allocator.release(scene->allocator.user, pointer);
}

plr_allocator x3d_counting_allocator(plr_scene *scene) {
    return (plr_allocator){counting_reallocate, counting_release, scene};
}

/* ---- Types ---- */

static void add_alias(plr_scene *scene, const x3d_alias *alias) {
    x3d_type *type = x3d_names_find(&scene->types, alias->name, strlen(alias->name));
    if (type)
        *x3d_names_at(&scene->types, &scene->arena, alias->alias, strlen(alias->alias)) = type;
}

static void add_field_aliases(plr_scene *scene) {
    for (const x3d_alias *alias = x3d_field_aliases(); alias->alias; alias++) {
        x3d_type *type = x3d_names_find(&scene->types, alias->node, strlen(alias->node));
        if (!type)
            continue;
        const x3d_alias **list =
            PLR_NEW_ARRAY(&scene->arena, type->alias_count + 1, const x3d_alias *);
        for (size_t i = 0; i < type->alias_count; i++)
            list[i] = type->aliases[i];
        list[type->alias_count++] = alias;
        type->aliases = list;
    }
}

static void index_types(plr_scene *scene) {
    size_t count = plr_node_info_count();
    x3d_type *types = PLR_NEW_ARRAY(&scene->arena, count, x3d_type);
    for (size_t i = 0; i < count; i++) {
        const plr_node_info *info = plr_node_info_at(i);
        types[i].info = info;
        *x3d_names_at(&scene->types, &scene->arena, info->name, strlen(info->name)) = &types[i];
    }
    for (const x3d_alias *alias = x3d_node_aliases(); alias->alias; alias++)
        add_alias(scene, alias);
    add_field_aliases(scene);
}

void x3d_uses_2005(plr_scene *scene, plr_place place) {
    if (!scene->uses_2005) {
        scene->uses_2005 = true;
        scene->place_2005 = place;
    }
}

x3d_type *x3d_type_find(plr_scene *scene, const char *name, size_t length, plr_place place) {
    if (!scene->types.count)
        index_types(scene);
    x3d_type *type = x3d_names_find(&scene->types, name, length);
    if (!type)
        return NULL;
    if (type->info->dialect_2005)
        x3d_uses_2005(scene, place);
    if (strlen(type->info->name) == length && memcmp(type->info->name, name, length) == 0)
        return type;
    for (const x3d_alias *alias = x3d_node_aliases(); alias->alias; alias++)
        if (alias->dialect_2005 && strlen(alias->alias) == length &&
            memcmp(alias->alias, name, length) == 0)
            x3d_uses_2005(scene, place);
    return type;
}

void x3d_read_default(plr_scene *scene, const plr_node_info *info, const plr_field_info *row,
                      const char *text, plr_field *field) {
    const plr_place nowhere = {NULL, 0, 0};
    x3d_view view = {.text = text, .length = strlen(text), .fixed = &nowhere};
    x3d_lexer lexer;
    x3d_lexer_init(&lexer, &view, true);
    x3d_value_desc desc = {.type = row->type, .node = info->name, .field = row->name};
    x3d_value_read(scene, &lexer, &desc, field);
}

static void make_defaults(plr_scene *scene, x3d_type *type) {
    const plr_node_info *info = type->info;
    plr_field *fields = PLR_NEW_ARRAY(&scene->arena, info->field_count, plr_field);
    for (size_t i = 0; i < info->field_count; i++) {
        const plr_field_info *row = &info->fields[i];
        fields[i] = (plr_field){.name = row->name, .type = row->type, .access = row->access};
        if (*row->initial && plr_type_kind(row->type) != PLR_NODE)
            x3d_read_default(scene, info, row, row->initial, &fields[i]);
    }
    type->defaults = fields;
    x3d_find_other_defaults(scene, type);
}

/* ---- Nodes and fields ---- */

bool x3d_node_count_up(plr_scene *scene, plr_place place) {
    if (scene->node_count < scene->max_nodes) {
        scene->node_count++;
        return true;
    }
    if (!scene->stopped)
        x3d_report(scene, PLR_CODE_LIMIT, place, "more than %zu nodes, the rest is left out",
                   scene->max_nodes);
    scene->stopped = true;
    return false;
}

plr_node *x3d_node_new(plr_scene *scene, x3d_type *type, plr_place place) {
    if (!x3d_node_count_up(scene, place))
        return NULL;
    plr_node *node = PLR_NEW(&scene->arena, plr_node);
    node->id = scene->node_count - 1;
    node->place = place;
    node->type = type;
    if (!type)
        return node;
    if (!type->defaults)
        make_defaults(scene, type);
    if (type->others.count)
        *PLR_PUSH(&scene->arena, &scene->two_dialects) = node;
    size_t count = type->info->field_count;
    node->written = type->info->name;
    node->fields = PLR_NEW_ARRAY(&scene->arena, count, plr_field);
    node->field_count = node->field_capacity = count;
    for (size_t i = 0; i < count; i++) {
        node->fields[i] = type->defaults[i];
        node->fields[i].place = place;
    }
    return node;
}

static size_t find_field(const plr_node *node, const char *name, size_t length) {
    for (size_t i = 0; i < node->field_count; i++)
        if (strncmp(node->fields[i].name, name, length) == 0 && !node->fields[i].name[length])
            return i;
    return SIZE_MAX;
}

size_t x3d_field_index(plr_scene *scene, const plr_node *node, const char *name, size_t length,
                       plr_place place) {
    size_t index = find_field(node, name, length);
    for (size_t i = 0; index == SIZE_MAX && node->type && i < node->type->alias_count; i++) {
        const x3d_alias *alias = node->type->aliases[i];
        if (strlen(alias->alias) != length || memcmp(alias->alias, name, length) != 0)
            continue;
        if (alias->dialect_2005)
            x3d_uses_2005(scene, place);
        index = find_field(node, alias->name, strlen(alias->name));
    }
    const plr_field_info *info = index == SIZE_MAX ? NULL : x3d_field_info(node, index);
    if (info && info->dialect_2005)
        x3d_uses_2005(scene, place);
    return index;
}

const plr_field_info *x3d_field_info(const plr_node *node, size_t index) {
    return node->type && index < node->type->info->field_count ? &node->type->info->fields[index]
                                                               : NULL;
}

plr_field *x3d_field_declare(plr_scene *scene, plr_node *node, const char *name, size_t length,
                             plr_type type, plr_access access, plr_place place) {
    node->fields = plr_arena_grow(&scene->arena, node->fields, &node->field_capacity,
                                  node->field_count + 1, sizeof *node->fields);
    plr_field *field = &node->fields[node->field_count++];
    *field = (plr_field){.name = plr_arena_copy(&scene->arena, name, length),
                         .type = type,
                         .access = access,
                         .declared = true,
                         .place = place};
    if (!plr_type_is_multiple(type) && type != PLR_SFNODE && type != PLR_SFIMAGE) {
        field->count = 1; /* until a value is read: zeros, FALSE, "" */
        field->value.any = plr_arena_alloc(&scene->arena, sizeof(double) * 16);
    }
    if (type == PLR_SFSTRING) {
        plr_string *string = PLR_NEW(&scene->arena, plr_string);
        string->text = "";
        string->origin = (plr_origin){place.file, place.line, place.column, NULL, 0};
        field->value.strings = string;
    }
    return field;
}

void x3d_append_node(plr_scene *scene, plr_field *field, plr_node *node) {
    size_t count = field->count;
    plr_node **items = (plr_node **)(uintptr_t)field->value.any;
    if (count == 0) {
        items = PLR_NEW_ARRAY(&scene->arena, 1, plr_node *);
    } else if ((count & (count - 1)) == 0) {
        plr_node **larger = PLR_NEW_ARRAY(&scene->arena, 2 * count, plr_node *);
        memcpy(larger, items, count * sizeof(plr_node *));
        items = larger;
    }
    items[count] = node;
    field->value.nodes = items;
    field->count = count + 1;
}

x3d_file *x3d_file_of_name(const plr_scene *scene, const char *name) {
    x3d_file *last = NULL;
    for (x3d_file *file = scene->files; file; file = file->next) {
        if (file->name == name)
            return file;
        last = file; /* files are added in front: the last one is the main file */
    }
    return last;
}
