/* Texture coordinates of units, and the mappings that follow from a bounding box. */
#include "engine/mesh_internal.h"

#include <math.h>
#include <stdlib.h>

void plr_mesh_find_bounds(plr_mesh *mesh) {
    for (int axis = 0; axis < 3; axis++) {
        mesh->bounds[0][axis] = INFINITY;
        mesh->bounds[1][axis] = -INFINITY;
    }
    for (size_t i = 0; i < (size_t)mesh->vertex_count * 3; i++) {
        float value = mesh->positions[i];
        if (value < mesh->bounds[0][i % 3])
            mesh->bounds[0][i % 3] = value;
        if (value > mesh->bounds[1][i % 3])
            mesh->bounds[1][i % 3] = value;
    }
}

const float *plr_mesh_tex_coords(const plr_mesh *mesh, unsigned unit) {
    if (unit >= PLR_MESH_TEX_UNITS)
        unit = PLR_MESH_TEX_UNITS - 1;
    while (unit > 0 && !mesh->tex_coords[unit])
        unit--;
    return mesh->tex_coords[unit];
}

/* One coordinate of all vertices as a function of one axis: from 0 (never -0) at `start` by
 * `scale`.
 */
static void map_axis(const plr_mesh *mesh, float *coords, int axis, double start, double scale) {
    for (size_t i = 0; i < mesh->vertex_count; i++)
        coords[4 * i] =
            (float)(((double)mesh->positions[3 * i + (size_t)axis] - start) * scale + 0.0);
}

static float *new_coords(const plr_mesh *mesh) {
    float *coords = calloc(mesh->vertex_count ? mesh->vertex_count : 1, 4 * sizeof *coords);
    for (size_t i = 0; coords && i < mesh->vertex_count; i++)
        coords[4 * i + 3] = 1;
    return coords;
}

static double side(const plr_mesh *mesh, int axis) {
    return (double)mesh->bounds[1][axis] - (double)mesh->bounds[0][axis];
}

const float *plr_mesh_plane_coords(plr_mesh *mesh) {
    if (mesh->plane_coords || !(mesh->plane_coords = new_coords(mesh)))
        return mesh->plane_coords;
    int s = side(mesh, 1) > side(mesh, 0) ? 1 : 0;
    if (side(mesh, 2) > side(mesh, s))
        s = 2;
    int t = s == 0 ? 1 : 0;
    int other = 3 - s - t;
    if (side(mesh, other) > side(mesh, t))
        t = other;
    double scale = side(mesh, s) > 0 ? 1 / side(mesh, s) : 0;
    map_axis(mesh, mesh->plane_coords, s, (double)mesh->bounds[0][s], scale);
    map_axis(mesh, mesh->plane_coords + 1, t, (double)mesh->bounds[0][t], scale);
    return mesh->plane_coords;
}

const float *plr_mesh_box_coords(plr_mesh *mesh) {
    if (mesh->box_coords || !(mesh->box_coords = new_coords(mesh)))
        return mesh->box_coords;
    for (int axis = 0; axis < 3; axis++) {
        double scale = side(mesh, axis) > 0 ? 1 / side(mesh, axis) : 0;
        if (axis == 2)
            map_axis(mesh, mesh->box_coords + axis, axis, (double)mesh->bounds[1][axis], -scale);
        else
            map_axis(mesh, mesh->box_coords + axis, axis, (double)mesh->bounds[0][axis], scale);
    }
    return mesh->box_coords;
}
