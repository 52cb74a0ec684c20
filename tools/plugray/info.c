/* plugray info: what a scene needs and costs. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/volume.h"
#include "tools/plugray/commands.h"
#include "tools/plugray/files.h"
#include "tools/plugray/progress.h"
#include "tools/plugray/scene.h"

typedef struct node_list {
    plr_node **items;
    size_t count;
    bool *seen; /* by plr_node_id */
} node_list;

static void add_node(node_list *list, plr_node *node) {
    if (!node || list->seen[plr_node_id(node)])
        return;
    list->seen[plr_node_id(node)] = true;
    list->items[list->count++] = node;
}

/* Every node of the scene, once. */
static node_list list_nodes(const plr_scene *scene) {
    size_t count = plr_scene_node_count(scene);
    node_list list = {.items = memory_array(NULL, count, sizeof *list.items),
                      .seen = memory_array(NULL, count, sizeof *list.seen)};
    memset(list.seen, 0, count * sizeof *list.seen);
    for (size_t i = 0; i < plr_scene_root_count(scene); i++)
        add_node(&list, plr_scene_root(scene, i));
    for (size_t i = 0; i < list.count; i++) {
        for (size_t f = 0; f < plr_node_field_count(list.items[i]); f++) {
            const plr_field *field = plr_node_field_at(list.items[i], f);
            if (plr_type_kind(field->type) != PLR_NODE)
                continue;
            for (size_t n = 0; n < field->count; n++)
                add_node(&list, field->value.nodes[n]);
        }
    }
    return list;
}

static void free_nodes(node_list *list) {
    free(list->items);
    free(list->seen);
}

static int compare_types(const void *a, const void *b) {
    return strcmp(plr_node_type(*(plr_node *const *)a), plr_node_type(*(plr_node *const *)b));
}

static void print_nodes(node_list *list) {
    qsort(list->items, list->count, sizeof *list->items, compare_types);
    printf("nodes: %zu\n", list->count);
    for (size_t i = 0, end; i < list->count; i = end) {
        const char *type = plr_node_type(list->items[i]);
        for (end = i; end < list->count && plr_node_is(list->items[end], type);)
            end++;
        printf("    %s %zu\n", type, end - i);
    }
}

static void print_volume(plr_scene *scene, const plr_node *node) {
    static const struct {
        const char *name;
        size_t bytes;
    } types[] = {[PLR_VOXEL_U8] = {"uint8", 1},   [PLR_VOXEL_S8] = {"int8", 1},
                 [PLR_VOXEL_U16] = {"uint16", 2}, [PLR_VOXEL_S16] = {"int16", 2},
                 [PLR_VOXEL_U32] = {"uint32", 4}, [PLR_VOXEL_S32] = {"int32", 4},
                 [PLR_VOXEL_U64] = {"uint64", 8}, [PLR_VOXEL_S64] = {"int64", 8},
                 [PLR_VOXEL_F32] = {"float", 4},  [PLR_VOXEL_F64] = {"double", 8}};
    plr_volume volume;
    if (!plr_volume_from_node(scene, node, &volume, NULL))
        return; /* reported when the view was made */
    size_t voxels = (size_t)volume.size[0] * volume.size[1] * volume.size[2];
    plr_place place = plr_node_place(node);
    printf("    %s at %s:%u:%u: %ux%ux%u, %u of %s, %zu bytes, values %g to %g\n",
           plr_node_type(node), place.file, place.line, place.column, volume.size[0],
           volume.size[1], volume.size[2], volume.components, types[volume.type].name,
           voxels * volume.components * types[volume.type].bytes, volume.minimum, volume.maximum);
    plr_volume_free(&volume);
}

static void print_volumes(plr_scene *scene, const node_list *list) {
    static const char *const types[] = {"ImageTexture3D", "PixelTexture3D", "ComposedTexture3D"};
    puts("volumes:");
    for (size_t i = 0; i < list->count; i++)
        for (size_t t = 0; t < sizeof types / sizeof *types; t++)
            if (plr_node_is(list->items[i], types[t]))
                print_volume(scene, list->items[i]);
}

static void print_programs(const plr_view *view) {
    puts("programs:");
    for (size_t i = 0; i < plr_view_program_count(view); i++) {
        const plr_program_info *info = plr_view_program(view, i);
        printf("    %s: %u instructions, %u fetches\n", info->name, info->instructions,
               info->fetches);
    }
}

int command_info(const tool_arguments *arguments) {
    tool_scene scene;
    plr_view *view;
    int status = tool_scene_view(&scene, arguments, &view);
    if (view) {
        progress(NULL);
        node_list nodes = list_nodes(scene.scene);
        print_nodes(&nodes);
        print_volumes(scene.scene, &nodes);
        print_programs(view);
        free_nodes(&nodes);
        status = tool_scene_finish(&scene);
        plr_view_destroy(&view);
    }
    tool_scene_close(&scene);
    return status;
}
