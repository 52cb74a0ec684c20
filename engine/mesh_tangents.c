/* Tangents at the vertices, for the effects that ask for them. */
#include <math.h>
#include <stdlib.h>

#include "engine/mesh_internal.h"

/* Adds to the corners of one triangle the directions in which s and t grow in it: p = T s + B t is
 * solved for T and B (E. Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh",
 * 2001). */
static void add_triangle(const plr_mesh *mesh, const float *coords, const uint32_t corner[3],
                         float *along) {
    float p[2][3], c[2][2];
    for (size_t e = 0; e < 2; e++) {
        for (size_t k = 0; k < 3; k++)
            p[e][k] = mesh->positions[3 * corner[e + 1] + k] - mesh->positions[3 * corner[0] + k];
        for (size_t k = 0; k < 2; k++)
            c[e][k] = coords[4 * corner[e + 1] + k] - coords[4 * corner[0] + k];
    }
    float area = c[0][0] * c[1][1] - c[1][0] * c[0][1];
    if (!(area != 0) || !isfinite(area))
        return;
    for (size_t k = 0; k < 3; k++) {
        float s = (p[0][k] * c[1][1] - p[1][k] * c[0][1]) / area;
        float t = (p[1][k] * c[0][0] - p[0][k] * c[1][0]) / area;
        for (size_t v = 0; v < 3; v++) {
            along[6 * corner[v] + k] += s;
            along[6 * corner[v] + 3 + k] += t;
        }
    }
}

/* The part of T that lies on the surface, at length 1, and on which side B lies: B = w N x T. */
static void orthogonalise(const float n[3], const float along[6], float tangent[4]) {
    const float *t = along, *b = along + 3;
    float in_normal = n[0] * t[0] + n[1] * t[1] + n[2] * t[2], length = 0;
    for (int k = 0; k < 3; k++) {
        tangent[k] = t[k] - n[k] * in_normal;
        length += tangent[k] * tangent[k];
    }
    length = sqrtf(length);
    for (int k = 0; k < 3; k++)
        tangent[k] = length > 0 && isfinite(length) ? tangent[k] / length : 0;
    float across[3] = {n[1] * tangent[2] - n[2] * tangent[1], n[2] * tangent[0] - n[0] * tangent[2],
                       n[0] * tangent[1] - n[1] * tangent[0]};
    tangent[3] = across[0] * b[0] + across[1] * b[1] + across[2] * b[2] < 0 ? -1 : 1;
}

const float *plr_mesh_tangents(plr_mesh *mesh) {
    const float *coords = plr_mesh_tex_coords(mesh, 0);
    if (mesh->tangents || mesh->kind != PLR_MESH_TRIANGLES || !mesh->normals || !coords)
        return mesh->tangents;
    size_t count = mesh->vertex_count;
    float *along = calloc(count + 1, 6 * sizeof *along);
    float *tangents = along ? calloc(count + 1, 4 * sizeof *tangents) : NULL;
    for (size_t i = 0; tangents && i + 2 < mesh->index_count; i += 3)
        add_triangle(mesh, coords, &mesh->indices[i], along);
    for (size_t i = 0; tangents && i < count; i++)
        orthogonalise(&mesh->normals[3 * i], &along[6 * i], &tangents[4 * i]);
    free(along);
    return mesh->tangents = tangents;
}
