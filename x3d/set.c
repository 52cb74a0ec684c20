/* Setting fields from outside. */
#include <string.h>

#include "x3d/build.h"
#include "x3d/events.h"
#include "x3d/values.h"

static bool is_bare_word(const plr_field *field, const char *text) {
    bool string = field->type == PLR_SFSTRING || field->type == PLR_MFSTRING;
    return string && text[strspn(text, " \t\r\n,")] != '"' && text[strspn(text, " \t\r\n,")] != '[';
}

static bool set_one(plr_scene *scene, plr_node *node, size_t index, const char *text,
                    plr_place place) {
    plr_field *field = &node->fields[index];
    const plr_place *fixed = &place;
    x3d_view view = {.text = text, .length = strlen(text), .fixed = fixed};
    x3d_lexer lexer;
    x3d_lexer_init(&lexer, &view, false);
    x3d_value_desc desc = {.type = field->type,
                           .info = x3d_field_info(node, index),
                           .node = plr_node_type(node),
                           .field = field->name,
                           .keep_newlines = true,
                           .xml = is_bare_word(field, text)};
    plr_field changed = *field;
    if (plr_type_kind(field->type) == PLR_NODE) {
        x3d_report(scene, PLR_CODE_BAD_VALUE, place, "%s.%s takes nodes, not text", desc.node,
                   field->name);
        return false;
    }
    if (!x3d_value_read(scene, &lexer, &desc, &changed))
        return false;
    if (x3d_lexer_next(&lexer) >= 0) {
        x3d_report(scene, PLR_CODE_BAD_VALUE, place, "%s.%s: '%.100s' is more than the value",
                   desc.node, field->name, text + lexer.at);
        return false;
    }
    changed.given = true;
    *field = changed;
    x3d_events_was_set(scene, node, index, false);
    return true;
}

static bool set_text(plr_scene *scene, plr_node *node, const char *name, const char *text,
                     plr_place place) {
    const x3d_instance *instance = node->instance;
    size_t length = strlen(name);
    size_t outside = instance
                         ? x3d_field_index(scene, instance->proto->interface, name, length, place)
                         : SIZE_MAX;
    if (outside != SIZE_MAX) {
        bool ok = true;
        for (size_t i = 0; i < instance->target_count; i++)
            if (instance->targets[i].interface == outside)
                ok = set_one(scene, instance->targets[i].node, instance->targets[i].field, text,
                             place) &&
                     ok;
        return ok;
    }
    size_t index = x3d_field_index(scene, node, name, length, place);
    if (index != SIZE_MAX)
        return set_one(scene, node, index, text, place);
    x3d_report(scene, PLR_CODE_BAD_VALUE, place, "%s has no field '%.100s'", plr_node_type(node),
               name);
    return false;
}

bool plr_node_set_text(plr_scene *scene, plr_node *node, const char *field, const char *text,
                       plr_place place, plr_diags *diags) {
    jmp_buf out_of_memory;
    jmp_buf *outer = scene->arena.out_of_memory;
    volatile bool ok = false;
    scene->diags = diags;
    scene->reported = 0;
    scene->arena.out_of_memory = &out_of_memory;
    if (setjmp(out_of_memory) == 0) {
        plr_place kept = place; /* strings keep the name of their file */
        if (place.file)
            kept.file = plr_arena_copy(&scene->arena, place.file, strlen(place.file));
        ok = set_text(scene, node, field, text, kept);
    } else {
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, place, "not enough memory to set the field");
    }
    scene->arena.out_of_memory = outer;
    scene->diags = NULL;
    return ok;
}

bool plr_node_set(plr_scene *scene, plr_node *node, const char *name, const void *values,
                  size_t count) {
    static const size_t sizes[] = {sizeof(bool), sizeof(int32_t), sizeof(float), sizeof(double)};
    plr_field *field = (plr_field *)(uintptr_t)plr_node_field(node, name);
    if (!field || plr_type_kind(field->type) > PLR_DOUBLE)
        return false;
    if (!plr_type_is_multiple(field->type) && field->type != PLR_SFIMAGE && count != 1)
        return false;
    size_t index = (size_t)(field - node->fields);
    size_t size = sizes[plr_type_kind(field->type)];
    size_t numbers = count * (size_t)plr_type_components(field->type);
    jmp_buf out_of_memory;
    jmp_buf *outer = scene->arena.out_of_memory;
    scene->arena.out_of_memory = &out_of_memory;
    volatile bool ok = false;
    if (setjmp(out_of_memory) == 0) {
        /* An animated field is set every frame: its memory serves again and again. */
        if (!node->room)
            node->room = PLR_NEW_ARRAY(&scene->arena, node->field_count, x3d_room);
        bool same = field->count == count &&
                    (!numbers || memcmp(field->value.any, values, numbers * size) == 0);
        x3d_room *room = &node->room[index];
        if (room->count < numbers) {
            room->memory = plr_arena_array(&scene->arena, numbers, size);
            room->count = numbers;
        }
        if (numbers)
            memcpy(room->memory, values, numbers * size);
        field->value.any = room->memory;
        field->count = count;
        field->given = true;
        x3d_events_was_set(scene, node, index, same);
        ok = true;
    }
    scene->arena.out_of_memory = outer;
    return ok;
}
