/* What the fuzz targets of the scene readers share: read, then touch all that a scene offers. */
#ifndef TESTS_FUZZ_SCENE_H
#define TESTS_FUZZ_SCENE_H

#include <plugray/x3d.h>

#include <stdlib.h>
#include <string.h>

static void fuzz_fault(void) {
    abort();
}

static void fuzz_field(const plr_field *field, size_t *sum) {
    if (plr_type_kind(field->type) != PLR_STRING) {
        size_t numbers = field->count * (size_t)plr_type_components(field->type);
        if (plr_type_kind(field->type) == PLR_INT && numbers)
            *sum += (size_t)field->value.ints[numbers - 1];
        if (plr_type_kind(field->type) == PLR_NODE && numbers)
            *sum += plr_node_id(field->value.nodes[numbers - 1]);
        return;
    }
    for (size_t i = 0; i < field->count; i++) {
        const plr_string *string = &field->value.strings[i];
        if (string->text[string->length])
            fuzz_fault();
        plr_place place = plr_origin_place(&string->origin, string->text, string->length);
        *sum += place.line;
    }
}

/* Every node once; `seen` has room for all numbers. */
static void fuzz_node(plr_scene *scene, const plr_node *node, unsigned char *seen, size_t *sum) {
    uint32_t id = plr_node_id(node);
    if (id >= plr_scene_node_count(scene))
        fuzz_fault();
    if (seen[id])
        return;
    seen[id] = 1;
    plr_place place = plr_node_place(node);
    size_t length;
    plr_scene_line(scene, place.file, place.line, &length);
    plr_string code;
    if (plr_node_is(node, "EffectPart"))
        plr_scene_code(scene, node, "url", &code, NULL);
    for (size_t i = 0; i < plr_node_field_count(node); i++) {
        const plr_field *field = plr_node_field_at(node, i);
        fuzz_field(field, sum);
        for (size_t k = 0; plr_type_kind(field->type) == PLR_NODE && k < field->count; k++)
            fuzz_node(scene, field->value.nodes[k], seen, sum);
    }
}

static size_t fuzz_scene(const char *text, size_t length) {
    /* A folder that does not exist: nothing may be read from it. */
    plr_read_desc desc = {.max_nodes = 5000, .max_depth = 100, .max_memory = (size_t)64 << 20};
    desc.rules.max_bytes = (size_t)1 << 20;
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = plr_scene_parse(text, length, "/nowhere/at/all/scene", &desc, diags);
    size_t sum = 0; /* 0: no scene */
    if (scene) {
        sum = 1;
        unsigned char *seen = calloc(plr_scene_node_count(scene) + 1, 1);
        for (size_t i = 0; i < plr_scene_root_count(scene); i++)
            fuzz_node(scene, plr_scene_root(scene, i), seen, &sum);
        for (size_t i = 0; i < plr_scene_route_count(scene); i++)
            fuzz_node(scene, plr_scene_route(scene, i)->from, seen, &sum);
        /* To and fro in time, and all fields again. */
        const plr_viewer viewer = {
            .eye_to_world = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 9, 1},
            .world_to_eye = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -9, 1},
            .projection = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -2, 0}};
        plr_scene_set_time(scene, 1.3, &viewer, diags);
        plr_scene_set_2005(scene, true);
        plr_scene_set_time(scene, 0, NULL, diags);
        plr_scene_set_2005(scene, false);
        memset(seen, 0, plr_scene_node_count(scene));
        for (size_t i = 0; i < plr_scene_root_count(scene); i++)
            fuzz_node(scene, plr_scene_root(scene, i), seen, &sum);
        free(seen);
    } else if (!plr_diags_count_of(diags, PLR_ERROR)) {
        fuzz_fault(); /* no scene without a word */
    }
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
    return sum;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#endif
