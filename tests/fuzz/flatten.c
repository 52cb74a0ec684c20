/* Scenes in Classic VRML, flattened as a viewer sees them in both dialects of volumes; bounding
 * boxes and transfer functions with them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/bounds.h"
#include "engine/transfer_function.h"

static void bake(const plr_node *node, plr_diags *diags) {
    static const double ranges[][2] = {{0, 1}, {-1000, 3000}, {5, 5}, {3, -2}, {1e-300, 1e300}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        plr_image image;
        if (!plr_transfer_function_bake(node, ranges[i], &image, diags))
            abort();
        const float *samples = image.samples;
        if (image.width < 2 || image.width > PLR_TRANSFER_MAX_TEXELS)
            abort();
        for (size_t k = 0; k < 4 * (size_t)image.width; k++)
            if (!isfinite(samples[k]))
                abort();
        plr_image_free(&image);
    }
}

static void bake_all(const plr_node *node, bool *seen, plr_diags *diags) {
    if (seen[plr_node_id(node)])
        return;
    seen[plr_node_id(node)] = true;
    if (plr_node_is(node, "TransferFunction"))
        bake(node, diags);
    for (size_t i = 0; i < plr_node_field_count(node); i++) {
        const plr_field *field = plr_node_field_at(node, i);
        for (size_t k = 0; plr_type_kind(field->type) == PLR_NODE && k < field->count; k++)
            bake_all(field->value.nodes[k], seen, diags);
    }
}

static void flatten(plr_scene *scene, const plr_matrix *eye, plr_diags *diags) {
    jmp_buf out_of_memory;
    plr_arena arena;
    plr_arena_init(&arena, NULL, &out_of_memory);
    if (setjmp(out_of_memory) == 0) {
        plr_flat flat;
        plr_flatten(&arena, scene, eye, &flat, diags);
        for (size_t i = 0; i < flat.shapes.count; i++)
            if (!plr_node_child(flat.shapes.items[i].node, "geometry") ||
                plr_node_id(flat.shapes.items[i].node) >= plr_scene_node_count(scene))
                abort();
    }
    plr_arena_finish(&arena);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    plr_read_desc desc = {.max_nodes = 1000, .max_depth = 50, .max_memory = (size_t)64 << 20};
    const plr_viewer viewer = {.eye_to_world = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 9, 1},
                               .world_to_eye = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -9, 1},
                               .projection = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -2, 0}};
    const plr_matrix eye = plr_matrix_translation(0, 0, 9);
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene =
        plr_scene_parse((const char *)data, size, "/nowhere/at/all/scene", &desc, diags);
    if (scene) {
        bool *seen = calloc(plr_scene_node_count(scene) + 1, sizeof *seen);
        for (size_t i = 0; i < plr_scene_root_count(scene); i++)
            bake_all(plr_scene_root(scene, i), seen, diags);
        free(seen);
        plr_scene_set_2005(scene, true);
        plr_scene_set_time(scene, 0.3, &viewer, diags);
        flatten(scene, &eye, diags);
        plr_scene_set_2005(scene, false);
        plr_scene_set_time(scene, 0.7, NULL, diags);
        flatten(scene, NULL, diags);
    }
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
    return 0;
}
