/* Triangles, lines and points from geometry nodes. No GL. */
#ifndef PLR_ENGINE_MESH_H
#define PLR_ENGINE_MESH_H

#include <plugray/engine.h>

typedef enum plr_mesh_kind {
    PLR_MESH_TRIANGLES,
    PLR_MESH_LINES,
    PLR_MESH_POINTS
} plr_mesh_kind;

/* A named vertex attribute of the author's (FloatVertexAttribute, ...). */
typedef struct plr_mesh_attribute {
    char *name;
    int components; /* 1..4, 9, 16: matrices, column by column */
    float *values;
} plr_mesh_attribute;

/* Plain arrays, one entry a vertex; NULL where the mesh has none. All owned. */
typedef struct plr_mesh {
    plr_mesh_kind kind;
    uint32_t vertex_count;
    float *positions; /* 3 each */
    float *normals;   /* 3 each, unit; triangles always have them */
    float *
        tex_coords; /* 4 each (s, t, r, q); always for triangles: given, or X3D's default mapping */
    float *colors;  /* 4 each */
    plr_mesh_attribute *attributes;
    size_t attribute_count;
    uint32_t *indices;
    uint32_t index_count;
    bool two_sided; /* solid FALSE */
    bool clockwise; /* ccw FALSE: front faces are wound clockwise */
    float bounds[2][3];
} plr_mesh;

/* Builds the mesh of a geometry node. Faults (bad-geometry) are reported at the node or field; what
 * is left is built. False if nothing can be drawn (unknown geometry: not-drawn). */
bool plr_mesh_build(const plr_node *geometry, plr_mesh *mesh, plr_diags *diags);
void plr_mesh_free(plr_mesh *mesh);

#endif
