/* The edges of a box as nodes. */
#include <string.h>

#include "x3d/scene.h"

static plr_node *new_node(plr_scene *scene, const char *type) {
    const plr_place nowhere = {NULL, 0, 0};
    return x3d_node_new(scene, x3d_type_find(scene, type, strlen(type), nowhere), nowhere);
}

static void put(plr_scene *scene, plr_node *node, const char *field, plr_node *child) {
    x3d_append_node(scene, (plr_field *)(uintptr_t)plr_node_field(node, field), child);
}

static plr_node *make_edges(plr_scene *scene) {
    static const float white[3] = {1, 1, 1};
    static const bool no = false;
    static const float points[8][3] = {{-.5F, -.5F, -.5F}, {.5F, -.5F, -.5F}, {.5F, .5F, -.5F},
                                       {-.5F, .5F, -.5F},  {-.5F, -.5F, .5F}, {.5F, -.5F, .5F},
                                       {.5F, .5F, .5F},    {-.5F, .5F, .5F}};
    static const int32_t edges[] = {0, 1, 2,  3, 0, -1, 4, 5, 6,  7, 4, -1,
                                    0, 4, -1, 1, 5, -1, 2, 6, -1, 3, 7};
    static const char *const types[] = {"Shape", "Appearance", "UnlitMaterial", "IndexedLineSet",
                                        "Coordinate"};
    plr_node *nodes[5];
    for (int i = 0; i < 5; i++) {
        nodes[i] = new_node(scene, types[i]);
        if (!nodes[i])
            return NULL;
    }
    plr_node_set(scene, nodes[0], "castShadow", &no, 1);
    plr_node_set(scene, nodes[2], "emissiveColor", white, 1);
    plr_node_set(scene, nodes[3], "coordIndex", edges, sizeof edges / sizeof *edges);
    plr_node_set(scene, nodes[4], "point", points, 8);
    put(scene, nodes[0], "appearance", nodes[1]);
    put(scene, nodes[1], "material", nodes[2]);
    put(scene, nodes[0], "geometry", nodes[3]);
    put(scene, nodes[3], "coord", nodes[4]);
    return nodes[0];
}

plr_node *plr_scene_box_edges(plr_scene *scene) {
    jmp_buf out_of_memory;
    jmp_buf *outer = scene->arena.out_of_memory;
    const uint64_t revision = scene->revision, set_revision = scene->set_revision;
    if (scene->box_edges)
        return scene->box_edges;
    scene->arena.out_of_memory = &out_of_memory;
    if (setjmp(out_of_memory) == 0)
        scene->box_edges = make_edges(scene);
    scene->arena.out_of_memory = outer;
    scene->revision = revision; /* nothing that anybody saw has changed */
    scene->set_revision = set_revision;
    return scene->box_edges;
}
