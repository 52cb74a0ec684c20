/* The two dialects of volume rendering: what fields are that a file does not give. */
#include <string.h>

#include "x3d/events.h"

static size_t index_of(const plr_node_info *info, const char *field) {
    for (size_t i = 0; field && i < info->field_count; i++)
        if (strcmp(info->fields[i].name, field) == 0)
            return i;
    return SIZE_MAX;
}

void x3d_find_other_defaults(plr_scene *scene, x3d_type *type) {
    const plr_node_info *info = type->info;
    for (const x3d_default_2005 *row = x3d_defaults_2005(); row->node; row++) {
        if (strcmp(row->node, info->name) != 0)
            continue;
        x3d_other_default other = {.index = index_of(info, row->field),
                                   .from = index_of(info, row->from)};
        if (other.index == SIZE_MAX)
            continue;
        const plr_field_info *field = &info->fields[other.index];
        other.value = (plr_field){.name = field->name, .type = field->type};
        if (row->initial)
            x3d_read_default(scene, info, field, row->initial, &other.value);
        *PLR_PUSH(&scene->arena, &type->others) = other;
    }
}

static void set_default(plr_scene *scene, plr_node *node, const x3d_other_default *other) {
    plr_field *field = x3d_events_given(node, other->index);
    const plr_field *value = &node->type->defaults[other->index];
    if (field->given)
        return;
    if (scene->is_2005)
        value = other->from < SIZE_MAX ? x3d_events_given(node, other->from) : &other->value;
    if (field->value.any == value->value.any)
        return;
    field->value = value->value;
    field->count = value->count;
    node->revision++;
    scene->set_revision = ++scene->revision;
}

void plr_scene_set_2005(plr_scene *scene, bool proposal) {
    scene->is_2005 = proposal;
    for (size_t i = 0; i < scene->two_dialects.count; i++) {
        plr_node *node = scene->two_dialects.items[i];
        for (size_t k = 0; k < node->type->others.count; k++)
            set_default(scene, node, &node->type->others.items[k]);
    }
}

/* A field that takes the value of another one goes with it in time. */
static void hand_on(x3d_events *ev, x3d_event_node *node, const plr_field *field) {
    const x3d_other_defaults *others = &node->node->type->others;
    for (size_t i = 0; ev->scene->is_2005 && i < others->count; i++) {
        const x3d_other_default *other = &others->items[i];
        if (other->from < SIZE_MAX && &node->node->fields[other->from] == field &&
            !x3d_events_given(node->node, other->index)->given)
            x3d_send(ev, node, other->value.name, field->value.any, field->count);
    }
}

const x3d_behaviour x3d_dialect_behaviours[] = {
    {.type = "SilhouetteEnhancementVolumeStyle", .receive = hand_on}, {.type = NULL}};
