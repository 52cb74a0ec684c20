/* Scenes in Classic VRML whose geometry nodes are all built. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/mesh.h"

/* Together; so that a run takes no longer than a few seconds. */
#define MOST_VERTICES ((size_t)1 << 19)

/* What a drawing would read must be there and finite. */
static void check_mesh(plr_mesh *mesh) {
    size_t sum = 0;
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        if (mesh->indices[i] >= mesh->vertex_count)
            abort();
        for (size_t axis = 0; axis < 3; axis++)
            if (!isfinite(mesh->positions[3 * (size_t)mesh->indices[i] + axis]))
                abort();
    }
    if (mesh->kind == PLR_MESH_TRIANGLES &&
        (!mesh->normals || !mesh->tex_coords[0] || mesh->index_count % 3))
        abort();
    if (mesh->kind == PLR_MESH_LINES && (!mesh->line_distances || mesh->index_count % 2))
        abort();
    for (unsigned unit = 0; unit < PLR_MESH_TEX_UNITS; unit++)
        if (plr_mesh_tex_coords(mesh, unit))
            sum += plr_mesh_tex_coords(mesh, unit)[4 * (size_t)mesh->vertex_count - 1] > 0;
    if (plr_mesh_plane_coords(mesh) && plr_mesh_box_coords(mesh))
        sum += plr_mesh_box_coords(mesh)[4 * (size_t)mesh->vertex_count - 1] > 0;
    if (plr_mesh_tangents(mesh))
        for (size_t i = 0; i < 4 * (size_t)mesh->vertex_count; i++)
            if (!isfinite(plr_mesh_tangents(mesh)[i]))
                abort();
    for (size_t i = 0; i < mesh->attribute_count; i++) {
        const plr_mesh_attribute *a = &mesh->attributes[i];
        sum += strlen(a->name) + (a->values[(size_t)a->components * mesh->vertex_count - 1] > 0);
    }
    if (sum == SIZE_MAX)
        abort();
}

static void build_all(plr_node *node, size_t *left, plr_diags *diags) {
    if (!*left)
        return;
    const plr_node_info *info = plr_node_info_find(plr_node_type(node));
    plr_mesh mesh;
    if (info && plr_node_info_is(info, "X3DGeometryNode") && plr_mesh_build(node, &mesh, diags)) {
        check_mesh(&mesh);
        *left -= mesh.vertex_count < *left ? mesh.vertex_count : *left;
        plr_mesh_free(&mesh);
    }
    for (size_t i = 0; i < plr_node_field_count(node); i++) {
        const plr_field *field = plr_node_field_at(node, i);
        for (size_t k = 0; plr_type_kind(field->type) == PLR_NODE && k < field->count; k++)
            build_all(field->value.nodes[k], left, diags);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    plr_read_desc desc = {.max_nodes = 1000, .max_depth = 50, .max_memory = (size_t)64 << 20};
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene =
        plr_scene_parse((const char *)data, size, "/nowhere/at/all/scene", &desc, diags);
    size_t left = MOST_VERTICES;
    for (size_t i = 0; scene && i < plr_scene_root_count(scene); i++)
        build_all(plr_scene_root(scene, i), &left, diags);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
    return 0;
}
