#include "engine/mesh_internal.h"

#include <math.h>
#include <string.h>

void plr_mesh_reserve(plr_maker *maker, plr_mesh_kind kind, size_t vertices, size_t indices) {
    plr_mesh *mesh = maker->mesh;
    mesh->kind = kind;
    mesh->positions = plr_mesh_array(maker->arena, vertices, 3 * sizeof(float));
    mesh->indices = plr_mesh_array(maker->arena, indices, sizeof(uint32_t));
    if (kind == PLR_MESH_LINES)
        mesh->line_distances = plr_mesh_array(maker->arena, vertices, sizeof(float));
    if (kind != PLR_MESH_TRIANGLES)
        return;
    mesh->normals = plr_mesh_array(maker->arena, vertices, 3 * sizeof(float));
    mesh->tex_coords[0] = plr_mesh_array(maker->arena, vertices, 4 * sizeof(float));
    /* such nodes have a texCoord for generators alone */
    mesh->tex_coords_given = plr_node_child(maker->node, "texCoord") != NULL;
}

uint32_t plr_mesh_add_vertex(plr_mesh *mesh, const double position[3], const double normal[3],
                             double tex_s, double tex_t) {
    size_t i = mesh->vertex_count;
    double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    /* front faces look along their normals: with ccw FALSE that is inward */
    double scale = mesh->clockwise ? -1 / length : 1 / length;
    for (int axis = 0; axis < 3; axis++) {
        mesh->positions[3 * i + (size_t)axis] = (float)position[axis];
        mesh->normals[3 * i + (size_t)axis] =
            (float)(length > 0 ? normal[axis] * scale : axis == 1);
    }
    float *tex = mesh->tex_coords[0] + 4 * i;
    tex[0] = (float)tex_s;
    tex[1] = (float)tex_t;
    tex[3] = 1;
    return mesh->vertex_count++;
}

void plr_mesh_add_triangle(plr_mesh *mesh, uint32_t a, uint32_t b, uint32_t c) {
    uint32_t *indices = mesh->indices + mesh->index_count;
    indices[0] = a;
    indices[1] = b;
    indices[2] = c;
    mesh->index_count += 3;
}

void plr_mesh_add_points(plr_mesh *mesh, size_t count,
                         void (*at)(const void *data, size_t i, double point[2]),
                         const void *data) {
    double last[2] = {0, 0}, distance = 0;
    for (size_t i = 0; i < count; i++) {
        double point[2];
        at(data, i, point);
        uint32_t vertex = mesh->vertex_count++;
        mesh->positions[3 * (size_t)vertex] = (float)point[0];
        mesh->positions[3 * (size_t)vertex + 1] = (float)point[1];
        if (mesh->kind == PLR_MESH_POINTS) {
            mesh->indices[mesh->index_count++] = vertex;
            continue;
        }
        if (i) {
            distance += hypot(point[0] - last[0], point[1] - last[1]);
            mesh->indices[mesh->index_count++] = vertex - 1;
            mesh->indices[mesh->index_count++] = vertex;
        }
        mesh->line_distances[vertex] = (float)distance;
        memcpy(last, point, sizeof last);
    }
}

void plr_mesh_map_plane(plr_maker *maker) {
    plr_mesh *mesh = maker->mesh;
    plr_mesh_find_bounds(mesh);
    const float *mapping = plr_mesh_plane_coords(mesh);
    if (!mapping)
        longjmp(*maker->arena->out_of_memory, 1);
    memcpy(mesh->tex_coords[0], mapping, mesh->vertex_count * 4 * sizeof *mapping);
}

uint32_t plr_mesh_subdivision(const plr_maker *maker, const char *name, uint32_t standard,
                              uint32_t least) {
    const uint32_t most = 1024;
    const plr_field *field = plr_node_field(maker->node, name);
    int32_t wanted = field && field->type == PLR_SFINT32 ? field->value.ints[0] : -1;
    if (wanted < 0)
        return standard;
    if ((uint32_t)wanted > most) {
        plr_diags_add_as(maker->diags, PLR_WARNING, PLR_CODE_BAD_GEOMETRY, field->place,
                         "%s is limited to %u", name, most);
        return most;
    }
    return (uint32_t)wanted < least ? least : (uint32_t)wanted;
}
