#include "x3d/build.h"

#include <string.h>

#include "x3d/values.h"

static int length_of(const x3d_label *label) {
    return label->length > 100 ? 100 : (int)label->length;
}

void x3d_offer(plr_scene *scene, x3d_nearest *nearest, const char *candidate) {
    if (!scene->nearest_budget)
        return;
    scene->nearest_budget--;
    x3d_nearest_offer(nearest, candidate);
}

void x3d_offer_all(plr_scene *scene, x3d_nearest *nearest, const x3d_names *names) {
    for (size_t i = 0; i < names->capacity && scene->nearest_budget; i++)
        if (names->slots[i].key)
            x3d_offer(scene, nearest, names->slots[i].key);
}

bool x3d_enter(x3d_build *build, plr_place place) {
    plr_scene *scene = build->scene;
    if (scene->stopped)
        return false;
    if (build->depth >= scene->max_depth) {
        x3d_report(scene, PLR_CODE_LIMIT, place, "nested more than %zu deep, the rest is left out",
                   scene->max_depth);
        scene->stopped = true;
        return false;
    }
    build->depth++;
    return true;
}

void x3d_leave(x3d_build *build) {
    build->depth--;
}

/* ---- Nodes ---- */

static void report_unknown_node(x3d_build *build, x3d_label type) {
    plr_scene *scene = build->scene;
    x3d_report(scene, PLR_CODE_UNKNOWN_NODE, type.place, "unknown node '%.*s'", length_of(&type),
               type.text);
    x3d_nearest nearest = {type.text, type.length, NULL, 0};
    for (size_t i = 0; i < plr_node_info_count(); i++)
        x3d_offer(scene, &nearest, plr_node_info_at(i)->name);
    for (const x3d_scope *scope = build->scope; scope; scope = scope->outer)
        x3d_offer_all(scene, &nearest, &scope->protos);
    x3d_suggest(scene, type.place, &nearest);
}

void x3d_own(x3d_build *build, plr_node *node) {
    x3d_proto *owner = build->scope->proto;
    if (!owner)
        return;
    node->owner = owner;
    node->owner_index = (uint32_t)owner->nodes.count;
    *PLR_PUSH(&build->scene->arena, &owner->nodes) = node;
}

/* A node that stands for an instance while its fields are read. */
static void begin_instance(x3d_build *build, x3d_open *open, x3d_proto *proto, plr_place place) {
    plr_scene *scene = build->scene;
    plr_node *node = x3d_node_new(scene, NULL, place);
    if (!node)
        return;
    const plr_node *interface = proto->interface;
    node->field_count = node->field_capacity = interface->field_count;
    node->fields = PLR_NEW_ARRAY(&scene->arena, node->field_count, plr_field);
    for (size_t i = 0; i < node->field_count; i++) {
        node->fields[i] = interface->fields[i];
        node->fields[i].given = false;
        if (plr_type_kind(node->fields[i].type) == PLR_NODE) {
            node->fields[i].count = 0; /* defaults are copied with the body */
            node->fields[i].value.any = NULL;
        }
    }
    node->written = proto->name;
    open->node = node;
    open->proto = proto;
}

void x3d_begin(x3d_build *build, x3d_open *open, x3d_label type, x3d_open *outer) {
    plr_scene *scene = build->scene;
    *open = (x3d_open){.outer = outer};
    if (build->scope->proto)
        open->first_is = build->scope->proto->is.count;
    x3d_proto *proto = x3d_proto_find(build, type);
    x3d_type *known = NULL;
    if (proto && proto->external) {
        if (!x3d_externproto_resolve(build, proto))
            return;
        known = proto->known;
        proto = proto->actual;
    }
    if (proto && proto->open) {
        x3d_report(scene, PLR_CODE_RECURSION, type.place, "prototype '%s' contains itself",
                   proto->name);
        return;
    }
    if (proto) {
        begin_instance(build, open, proto, type.place);
        return;
    }
    if (!known)
        known = x3d_type_find(scene, type.text, type.length, type.place);
    if (!known) {
        report_unknown_node(build, type);
        return;
    }
    open->node = x3d_node_new(scene, known, type.place);
    if (!open->node)
        return;
    if (strlen(known->info->name) != type.length ||
        memcmp(known->info->name, type.text, type.length) != 0)
        open->node->written = plr_arena_copy(&scene->arena, type.text, type.length);
    x3d_own(build, open->node);
}

static x3d_def *def_at(x3d_build *build, x3d_label name) {
    plr_arena *arena = &build->scene->arena;
    void **slot = x3d_names_at(&build->scope->defs, arena, name.text, name.length);
    if (!*slot)
        *slot = PLR_NEW(arena, x3d_def);
    return *slot;
}

void x3d_define_skipped(x3d_build *build, x3d_label name) {
    x3d_def *def = def_at(build, name);
    def->skipped = !def->node;
}

void x3d_define(x3d_build *build, x3d_open *open, x3d_label name) {
    plr_scene *scene = build->scene;
    if (!open->node) {
        x3d_define_skipped(build, name);
        return;
    }
    x3d_def *def = def_at(build, name);
    def->node = open->node;
    def->skipped = false;
    def->open = true;
    open->def = def;
    open->node->def = plr_arena_copy(&scene->arena, name.text, name.length);
}

plr_node *x3d_end(x3d_build *build, x3d_open *open) {
    plr_node *node = open->node;
    if (node && open->proto)
        node = x3d_instantiate(build, open);
    if (open->def) {
        if (open->def->node == open->node)
            open->def->node = node;
        if (!open->def->first)
            open->def->first = node;
        open->def->open = false;
        open->def->skipped = !open->def->node;
    }
    if (node && !open->proto && !build->scope->proto && x3d_is_inline(node))
        x3d_load_inline(build, node);
    return node;
}

/* A Script may know the nodes around it, and itself: nothing walks through its fields. */
static bool through_script(const plr_node *node, const x3d_open *outer) {
    for (; outer && node->type; outer = outer->outer) {
        if (outer->node && outer->node->type && plr_node_is(outer->node, "X3DScriptNode"))
            return true;
        if (outer->node == node)
            return false;
    }
    return false;
}

plr_node *x3d_use(x3d_build *build, x3d_label name, const x3d_open *outer) {
    plr_scene *scene = build->scene;
    x3d_def *def = x3d_names_find(&build->scope->defs, name.text, name.length);
    if (def && def->skipped)
        return NULL;
    if (!def || !def->node) {
        x3d_report(scene, PLR_CODE_UNKNOWN_DEF, name.place, "USE of the unknown name '%.*s'",
                   length_of(&name), name.text);
        x3d_nearest nearest = {name.text, name.length, NULL, 0};
        x3d_offer_all(scene, &nearest, &build->scope->defs);
        x3d_suggest(scene, name.place, &nearest);
        return NULL;
    }
    if (def->open && !through_script(def->node, outer)) {
        x3d_report(scene, PLR_CODE_RECURSION, name.place, "USE of '%.*s' inside itself",
                   length_of(&name), name.text);
        return NULL;
    }
    return def->node;
}

/* ---- Fields ---- */

static const char *type_name(const plr_node *node) {
    return node->type ? node->type->info->name : node->written ? node->written : "prototype";
}

static void report_unknown_field(x3d_build *build, const plr_node *node, x3d_label name) {
    plr_scene *scene = build->scene;
    x3d_report(scene, PLR_CODE_UNKNOWN_FIELD, name.place, "%s has no field '%.*s'", type_name(node),
               length_of(&name), name.text);
    x3d_nearest nearest = {name.text, name.length, NULL, 0};
    for (size_t i = 0; i < node->field_count; i++)
        x3d_offer(scene, &nearest, node->fields[i].name);
    x3d_suggest(scene, name.place, &nearest);
}

size_t x3d_field(x3d_build *build, plr_node *node, x3d_label name) {
    size_t index = x3d_field_index(build->scene, node, name.text, name.length, name.place);
    if (index == SIZE_MAX) {
        report_unknown_field(build, node, name);
        return SIZE_MAX;
    }
    plr_field *field = &node->fields[index];
    if (field->access == PLR_INPUT_ONLY || field->access == PLR_OUTPUT_ONLY) {
        x3d_report(build->scene, PLR_CODE_BAD_VALUE, name.place, "%s.%s is %s and takes no value",
                   type_name(node), field->name,
                   field->access == PLR_INPUT_ONLY ? "inputOnly" : "outputOnly");
        return SIZE_MAX;
    }
    field->given = true;
    field->place = name.place;
    return index;
}

/* components, width, height, depth, then the voxels */
static bool check_voxels(plr_scene *scene, const plr_field *field, plr_place place) {
    const int32_t *ints = field->value.ints;
    if (field->count < 4) {
        x3d_report(scene, PLR_CODE_BAD_VALUE, place,
                   "PixelTexture3D.image begins with components, width, height and depth");
        return false;
    }
    uint64_t voxels = ints[0] ? 1 : 0;
    for (int i = 1; i < 4; i++) {
        if (ints[i] < 0 || ints[0] < 0 || ints[0] > 4) {
            x3d_report(scene, PLR_CODE_BAD_VALUE, place,
                       "PixelTexture3D.image: components or sizes cannot be right");
            return false;
        }
        voxels *= (uint64_t)ints[i]; /* three times 31 bits do not fit */
        if (voxels > UINT32_MAX)
            break;
    }
    if (voxels == field->count - 4)
        return true;
    x3d_report(scene, PLR_CODE_BAD_VALUE, place,
               "PixelTexture3D.image: %dx%dx%d voxels are declared, here are %zu", ints[1], ints[2],
               ints[3], field->count - 4);
    return false;
}

bool x3d_value(x3d_build *build, plr_node *node, size_t index, x3d_lexer *lexer, bool xml) {
    plr_field *field = &node->fields[index];
    x3d_value_desc desc = {.type = field->type,
                           .info = x3d_field_info(node, index),
                           .node = type_name(node),
                           .field = field->name,
                           .owner = node,
                           .xml = xml,
                           .keep_newlines = strcmp(field->name, "url") == 0,
                           .angle_factor = build->angle_unit};
    plr_field old = *field;
    if (!x3d_value_read(build->scene, lexer, &desc, field)) {
        field->given = false;
        return false;
    }
    if (field->type == PLR_MFINT32 && strcmp(field->name, "image") == 0 && node->type &&
        plr_node_is(node, "PixelTexture3D") && !check_voxels(build->scene, field, field->place)) {
        field->value = old.value;
        field->count = old.count;
        field->given = false;
        return false;
    }
    return true;
}

static bool takes(const plr_field_info *info, const plr_node *child) {
    return !info || x3d_allows(info, child->type->info);
}

/* In 2005 VolumeData.voxels was a list: the second and later nodes are reduced copies. */
static bool add_level(x3d_build *build, plr_node *node, const plr_field *field, plr_node *child,
                      plr_place place) {
    plr_scene *scene = build->scene;
    if (!node->type || !plr_node_is(node, "VolumeData") || strcmp(field->name, "voxels") != 0)
        return false;
    size_t levels = x3d_field_index(scene, node, "voxelLevels", 11, place);
    if (levels == SIZE_MAX)
        return false;
    x3d_uses_2005(scene, place);
    node->fields[levels].given = true;
    x3d_append_node(scene, &node->fields[levels], child);
    return true;
}

void x3d_add_child(x3d_build *build, plr_node *node, size_t index, plr_node *child,
                   plr_place place) {
    plr_field *field = &node->fields[index];
    if (!takes(x3d_field_info(node, index), child)) {
        x3d_report(build->scene, PLR_CODE_BAD_NODE, place, "%s.%s does not take a %s",
                   type_name(node), field->name, type_name(child));
        return;
    }
    if (field->type == PLR_SFNODE && field->count) {
        if (add_level(build, node, field, child, place))
            return;
        x3d_report(build->scene, PLR_CODE_BAD_NODE, place, "%s.%s takes one node, this is left out",
                   type_name(node), field->name);
        return;
    }
    x3d_append_node(build->scene, field, child);
}

static bool is_open_to(const plr_node *parent, size_t index, const plr_node *child) {
    const plr_field *field = &parent->fields[index];
    return plr_type_kind(field->type) == PLR_NODE && field->access != PLR_OUTPUT_ONLY &&
           field->access != PLR_INPUT_ONLY && takes(x3d_field_info(parent, index), child);
}

static size_t find_open_field(x3d_build *build, const plr_node *parent, const char *name,
                              const plr_node *child) {
    size_t index = x3d_field_index(build->scene, parent, name, strlen(name), child->place);
    return index != SIZE_MAX && is_open_to(parent, index, child) ? index : SIZE_MAX;
}

/* The one field that takes the node; SIZE_MAX: there are none or several. */
static size_t only_open_field(const plr_node *parent, const plr_node *child, bool standard,
                              size_t *count) {
    size_t found = SIZE_MAX;
    *count = 0;
    for (size_t i = 0; i < parent->field_count; i++) {
        const plr_field_info *info = x3d_field_info(parent, i);
        if (!is_open_to(parent, i, child) || (standard && info && info->extension))
            continue;
        found = i;
        ++*count;
    }
    return *count == 1 ? found : SIZE_MAX;
}

size_t x3d_container(x3d_build *build, plr_node *parent, const plr_node *child,
                     const x3d_label *container, plr_place place) {
    if (container) {
        size_t index = x3d_field(build, parent, *container);
        if (index == SIZE_MAX || plr_type_kind(parent->fields[index].type) == PLR_NODE)
            return index;
        x3d_report(build->scene, PLR_CODE_BAD_NODE, container->place, "%s.%s takes no nodes",
                   type_name(parent), parent->fields[index].name);
        return SIZE_MAX;
    }
    size_t index = SIZE_MAX;
    if (plr_node_is(child, "Effect"))
        index = find_open_field(build, parent, "effects", child);
    if (parent->type && plr_node_is(parent, "MetadataSet")) /* as X3D 4 has it */
        index = find_open_field(build, parent, "value", child);
    if (index == SIZE_MAX)
        index = find_open_field(build, parent, child->type->info->container_field, child);
    size_t others = 0;
    if (index == SIZE_MAX)
        index = only_open_field(parent, child, true, &others);
    if (index == SIZE_MAX)
        index = only_open_field(parent, child, false, &others);
    if (index == SIZE_MAX) {
        x3d_report(build->scene, PLR_CODE_BAD_NODE, place, "%s has no field for a %s%s",
                   type_name(parent), type_name(child),
                   others > 1 ? " without containerField" : "");
        return SIZE_MAX;
    }
    if (!parent->fields[index].given) {
        parent->fields[index].given = true;
        parent->fields[index].place = place;
    }
    return index;
}

size_t x3d_declare(x3d_build *build, plr_node *node, plr_type type, plr_access access,
                   x3d_label name) {
    plr_scene *scene = build->scene;
    enum {
        MOST_DECLARED = 1000
    };
    if (node->field_count >= MOST_DECLARED) {
        x3d_report(scene, PLR_CODE_LIMIT, name.place, "more than %d fields", MOST_DECLARED);
        return SIZE_MAX;
    }
    for (size_t i = 0; i < node->field_count; i++)
        if (strlen(node->fields[i].name) == name.length &&
            memcmp(node->fields[i].name, name.text, name.length) == 0) {
            x3d_report(scene, PLR_CODE_BAD_VALUE, name.place, "%s has a field '%.*s' already",
                       type_name(node), length_of(&name), name.text);
            return SIZE_MAX;
        }
    x3d_field_declare(scene, node, name.text, name.length, type, access, name.place);
    return node->field_count - 1;
}

/* ---- Statements ---- */

bool x3d_add_unit(x3d_build *build, x3d_label category, double factor) {
    if (!(factor > 0) || factor > 1e30 || factor < 1e-30)
        return false;
    if (category.length == 6 && memcmp(category.text, "length", 6) == 0)
        build->length_unit = factor;
    if (category.length == 5 && memcmp(category.text, "angle", 5) == 0)
        build->angle_unit = factor;
    if (build->is_main) {
        build->scene->length_unit = build->length_unit;
        build->scene->angle_unit = build->angle_unit;
    }
    return true;
}

void x3d_add_meta(x3d_build *build, const char *name, const char *content) {
    if (build->is_main)
        *PLR_PUSH(&build->scene->arena, &build->scene->metas) = (x3d_meta){name, content};
}

void x3d_set_version(x3d_build *build, const char *text, size_t length) {
    if (build->is_main && length && length < 16)
        build->scene->version = plr_arena_copy(&build->scene->arena, text, length);
}
