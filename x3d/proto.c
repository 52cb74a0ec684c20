/* Prototypes: the nodes of a body are read once, as a mould; each instance is a copy. */
#include "x3d/build.h"

#include <string.h>

x3d_proto *x3d_proto_find(const x3d_build *build, x3d_label name) {
    for (const x3d_scope *scope = build->scope; scope; scope = scope->outer) {
        x3d_proto *proto = x3d_names_find(&scope->protos, name.text, name.length);
        if (proto)
            return proto;
    }
    return NULL;
}

x3d_scope *x3d_scope_new(plr_scene *scene, x3d_scope *outer, x3d_proto *proto) {
    x3d_scope *scope = PLR_NEW(&scene->arena, x3d_scope);
    scope->outer = outer;
    scope->proto = proto;
    return scope;
}

static x3d_proto *declare(x3d_build *build, x3d_label name) {
    plr_scene *scene = build->scene;
    plr_node *interface = x3d_node_new(scene, NULL, name.place);
    if (!interface)
        return NULL;
    x3d_proto *proto = PLR_NEW(&scene->arena, x3d_proto);
    proto->name = plr_arena_copy(&scene->arena, name.text, name.length);
    proto->place = name.place;
    proto->interface = interface;
    interface->written = proto->name;
    *x3d_names_at(&build->scope->protos, &scene->arena, name.text, name.length) = proto;
    return proto;
}

x3d_proto *x3d_proto_begin(x3d_build *build, x3d_label name) {
    x3d_proto *proto = declare(build, name);
    if (!proto)
        return NULL;
    proto->open = true;
    build->scope = x3d_scope_new(build->scene, build->scope, proto);
    return proto;
}

void x3d_proto_end(x3d_build *build, x3d_proto *proto, const x3d_node_list *nodes) {
    if (nodes->count)
        proto->first = nodes->items[0];
    else if (!build->scene->stopped)
        x3d_report(build->scene, PLR_CODE_BAD_PROTO, proto->place,
                   "prototype '%s' has no node in its body", proto->name);
    x3d_scope_end(build);
    build->scope = build->scope->outer;
    proto->open = false;
}

x3d_proto *x3d_externproto_begin(x3d_build *build, x3d_label name) {
    x3d_proto *proto = declare(build, name);
    if (proto)
        proto->external = true;
    return proto;
}

/* ---- IS ---- */

static size_t find_with_affixes(x3d_build *build, const plr_node *node, x3d_label name) {
    size_t index = x3d_field_index(build->scene, node, name.text, name.length, name.place);
    if (index == SIZE_MAX && name.length > 4 && memcmp(name.text, "set_", 4) == 0)
        index = x3d_field_index(build->scene, node, name.text + 4, name.length - 4, name.place);
    if (index == SIZE_MAX && name.length > 8 &&
        memcmp(name.text + name.length - 8, "_changed", 8) == 0)
        index = x3d_field_index(build->scene, node, name.text, name.length - 8, name.place);
    return index;
}

static bool flows_in(plr_access access) {
    return access == PLR_INPUT_ONLY || access == PLR_INPUT_OUTPUT;
}

static bool flows_out(plr_access access) {
    return access == PLR_OUTPUT_ONLY || access == PLR_INPUT_OUTPUT;
}

/* ISO/IEC 19775-1, 4.4.4.3: what the interface promises the field must be able to do. An
 * inputOutput on an initializeOnly field is common and harmless: it is then merely never changed.
 */
static bool may_carry(plr_access interface, plr_access field) {
    switch (interface) {
    case PLR_INPUT_ONLY:
        return flows_in(field);
    case PLR_OUTPUT_ONLY:
        return flows_out(field);
    default:
        return field == PLR_INITIALIZE_ONLY || field == PLR_INPUT_OUTPUT;
    }
}

static int shown(x3d_label label) {
    return label.length > 100 ? 100 : (int)label.length;
}

/* Through prototypes of prototypes the list could grow without bound. */
static void push_is(plr_scene *scene, x3d_proto *proto, x3d_is is) {
    enum {
        MOST_IS = 100000
    };
    if (proto->is.count < MOST_IS) {
        *PLR_PUSH(&scene->arena, &proto->is) = is;
        return;
    }
    if (!scene->stopped)
        x3d_report(scene, PLR_CODE_LIMIT, is.place, "prototype '%s' has more than %d IS",
                   proto->name, MOST_IS);
    scene->stopped = true;
}

void x3d_add_is(x3d_build *build, plr_node *node, x3d_label field, x3d_label interface) {
    plr_scene *scene = build->scene;
    x3d_proto *proto = build->scope->proto;
    if (!proto || !proto->open) {
        x3d_report(scene, PLR_CODE_BAD_PROTO, interface.place, "IS outside of a prototype");
        return;
    }
    size_t to = find_with_affixes(build, node, field);
    if (to == SIZE_MAX) {
        x3d_field(build, node, field); /* reports it */
        return;
    }
    size_t from = find_with_affixes(build, proto->interface, interface);
    if (from == SIZE_MAX) {
        x3d_report(scene, PLR_CODE_BAD_PROTO, interface.place, "prototype '%s' has no field '%.*s'",
                   proto->name, shown(interface), interface.text);
        x3d_nearest nearest = {interface.text, interface.length, NULL, 0};
        for (size_t i = 0; i < proto->interface->field_count; i++)
            x3d_offer(scene, &nearest, proto->interface->fields[i].name);
        x3d_suggest(scene, interface.place, &nearest);
        return;
    }
    const plr_field *outside = &proto->interface->fields[from], *inside = &node->fields[to];
    if (outside->type != inside->type) {
        x3d_report(scene, PLR_CODE_BAD_PROTO, interface.place, "'%s' is %s, but '%s' is %s",
                   outside->name, plr_type_name(outside->type), inside->name,
                   plr_type_name(inside->type));
        return;
    }
    if (!may_carry(outside->access, inside->access)) {
        x3d_report(scene, PLR_CODE_BAD_PROTO, interface.place,
                   "the access of '%s' does not allow '%s' to stand for it", inside->name,
                   outside->name);
        return;
    }
    push_is(scene, proto, (x3d_is){node, (uint32_t)to, (uint32_t)from, interface.place});
}

/* ---- Instances ---- */

typedef struct copier {
    x3d_build *build;
    x3d_proto *proto;
    plr_node *stand_in;
    plr_node **copies; /* by owner_index */
} copier;

static plr_node *copy_of(const copier *c, plr_node *node) {
    return node->owner == c->proto ? c->copies[node->owner_index] : node;
}

/* The array is as large as appending by doubling expects it. */
static plr_node *const *copy_nodes(const copier *c, const plr_field *field) {
    size_t room = 1;
    while (room < field->count)
        room *= 2;
    plr_node **nodes = PLR_NEW_ARRAY(&c->build->scene->arena, room, plr_node *);
    for (size_t i = 0; i < field->count; i++)
        nodes[i] = copy_of(c, field->value.nodes[i]);
    return nodes;
}

static bool copy_body(copier *c) {
    plr_scene *scene = c->build->scene;
    x3d_proto *proto = c->proto;
    size_t count = proto->nodes.count;
    c->copies = PLR_NEW_ARRAY(&scene->arena, count, plr_node *);
    for (size_t i = 0; i < count; i++) {
        const plr_node *mould = proto->nodes.items[i];
        if (!x3d_node_count_up(scene, c->stand_in->place))
            return false;
        plr_node *copy = PLR_NEW(&scene->arena, plr_node);
        *copy = *mould;
        copy->id = scene->node_count - 1;
        copy->owner = NULL;
        copy->instance = NULL;
        if (copy->type && copy->type->others.count)
            *PLR_PUSH(&scene->arena, &scene->two_dialects) = copy;
        copy->fields = PLR_NEW_ARRAY(&scene->arena, copy->field_count, plr_field);
        copy->field_capacity = copy->field_count;
        if (copy->field_count)
            memcpy(copy->fields, mould->fields, copy->field_count * sizeof *copy->fields);
        c->copies[i] = copy;
    }
    for (size_t i = 0; i < count; i++) {
        plr_node *copy = c->copies[i];
        for (size_t f = 0; f < copy->field_count; f++)
            if (plr_type_kind(copy->fields[f].type) == PLR_NODE && copy->fields[f].count)
                copy->fields[f].value.nodes = copy_nodes(c, &copy->fields[f]);
        x3d_own(c->build, copy);
    }
    return true;
}

static void apply_nodes(const copier *c, plr_node *node, size_t index, const plr_field *from) {
    plr_field *to = &node->fields[index];
    const plr_field_info *info = x3d_field_info(node, index);
    size_t kept = 0;
    plr_node **nodes = (plr_node **)(uintptr_t)copy_nodes(c, from);
    for (size_t i = 0; i < from->count; i++) {
        if (!info || x3d_allows(info, nodes[i]->type->info))
            nodes[kept++] = nodes[i];
        else
            x3d_report(c->build->scene, PLR_CODE_BAD_NODE, from->place, "%s.%s does not take a %s",
                       node->type->info->name, to->name, plr_node_type(nodes[i]));
    }
    to->value.nodes = nodes;
    to->count = kept;
}

static void apply_field(const copier *c, const x3d_is *is) {
    plr_node *node = copy_of(c, is->node);
    plr_field *to = &node->fields[is->field];
    const plr_field *from = &c->stand_in->fields[is->interface];
    if (!from->given)
        from = &c->proto->interface->fields[is->interface];
    if (!from->given || from->access == PLR_INPUT_ONLY || from->access == PLR_OUTPUT_ONLY)
        return;
    to->given = true;
    to->place = from->place;
    if (plr_type_kind(from->type) == PLR_NODE) {
        apply_nodes(c, node, is->field, from);
    } else {
        to->value = from->value;
        to->count = from->count;
    }
}

static x3d_instance *make_instance(const copier *c) {
    plr_arena *arena = &c->build->scene->arena;
    x3d_instance *instance = PLR_NEW(arena, x3d_instance);
    x3d_is *targets = PLR_NEW_ARRAY(arena, c->proto->is.count, x3d_is);
    for (size_t i = 0; i < c->proto->is.count; i++) {
        targets[i] = c->proto->is.items[i];
        targets[i].node = copy_of(c, targets[i].node);
    }
    instance->proto = c->proto;
    instance->targets = targets;
    instance->target_count = c->proto->is.count;
    return instance;
}

static void copy_routes(const copier *c) {
    plr_scene *scene = c->build->scene;
    x3d_proto *outer = c->build->scope->proto;
    for (size_t i = 0; i < c->proto->routes.count; i++) {
        plr_route route = c->proto->routes.items[i];
        route.from = copy_of(c, route.from);
        route.to = copy_of(c, route.to);
        *PLR_PUSH(&scene->arena, outer ? &outer->routes : &scene->routes) = route;
    }
}

/* "field IS outer" on an instance inside another body: the fields behind it carry the outer one. */
static void forward_is(const copier *c, const x3d_open *open, const x3d_instance *instance) {
    x3d_proto *outer = c->build->scope->proto;
    x3d_is_list old = outer->is;
    outer->is.count = open->first_is;
    size_t end = old.count;
    x3d_is *entries = PLR_NEW_ARRAY(&c->build->scene->arena, end - open->first_is, x3d_is);
    if (end > open->first_is)
        memcpy(entries, old.items + open->first_is, (end - open->first_is) * sizeof *entries);
    for (size_t i = 0; i < end - open->first_is; i++) {
        if (entries[i].node != c->stand_in) {
            *PLR_PUSH(&c->build->scene->arena, &outer->is) = entries[i];
            continue;
        }
        if (!x3d_spend(c->build->scene, instance->target_count, entries[i].place))
            return;
        for (size_t t = 0; t < instance->target_count; t++)
            if (instance->targets[t].interface == entries[i].field)
                push_is(c->build->scene, outer,
                        (x3d_is){instance->targets[t].node, instance->targets[t].field,
                                 entries[i].interface, entries[i].place});
    }
}

plr_node *x3d_instantiate(x3d_build *build, x3d_open *open) {
    copier c = {build, open->proto, open->node, NULL};
    if (!c.proto->first || !copy_body(&c))
        return NULL;
    plr_node *first = copy_of(&c, c.proto->first);
    first->place = c.stand_in->place;
    first->written = c.proto->name;
    if (c.stand_in->def)
        first->def = c.stand_in->def;
    for (size_t i = 0; i < c.proto->is.count; i++)
        apply_field(&c, &c.proto->is.items[i]);
    first->instance = make_instance(&c);
    copy_routes(&c);
    if (build->scope->proto) {
        forward_is(&c, open, first->instance);
        return first;
    }
    for (size_t i = 0; i < c.proto->nodes.count; i++)
        if (x3d_is_inline(c.copies[i]))
            x3d_load_inline(build, c.copies[i]);
    return first;
}
