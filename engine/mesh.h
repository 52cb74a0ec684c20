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

enum {
    PLR_MESH_TEX_UNITS = 8
};

/* Plain arrays, one entry a vertex; NULL where the mesh has none. All owned. */
typedef struct plr_mesh {
    plr_mesh_kind kind;
    uint32_t vertex_count;
    float *positions; /* 3 each */
    float *normals;   /* 3 each, unit; triangles always have them */
    /* 4 each (s, t, r, q). Triangles always have those of unit 0: given, or X3D's default mapping;
     * other units only where MultiTextureCoordinate has an entry for them. An entry that is
     * generated while drawing (TextureCoordinateGenerator, ...) has the default mapping here. */
    float *tex_coords[PLR_MESH_TEX_UNITS];
    bool tex_coords_given; /* by the file: no default stands in */
    float *colors;         /* 4 each */
    float *fog_coords;     /* 1 each: FogCoordinate */
    float *line_distances; /* 1 each, of lines: length from the start of the polyline */
    plr_mesh_attribute *attributes;
    size_t attribute_count;
    uint32_t *indices;
    uint32_t index_count;
    bool two_sided; /* solid FALSE */
    bool clockwise; /* ccw FALSE: front faces are wound clockwise */
    float bounds[2][3];
    float *plane_coords, *box_coords, *tangents; /* of the functions below, once asked for */
} plr_mesh;

/* Builds the mesh of a geometry node. Faults (bad-geometry) are reported at the node or field; what
 * is left is built. False if nothing can be drawn (unknown geometry: not-drawn). */
bool plr_mesh_build(const plr_node *geometry, plr_mesh *mesh, plr_diags *diags);
/* The same with fonts from these folders, NULL at the end. */
bool plr_mesh_build_with(const plr_node *geometry, const char *const *font_folders, plr_mesh *mesh,
                         plr_diags *diags);
void plr_mesh_free(plr_mesh *mesh);

/* The texture coordinates that unit `unit` uses: its own, or those of the last unit before it that
 * has some (ISO/IEC 19775-1 18.4.3: the last channel is replicated). NULL if none. */
const float *plr_mesh_tex_coords(const plr_mesh *mesh, unsigned unit);

/* Mappings by the bounding box, 4 each, made at the first call and owned by the mesh; NULL without
 * memory.
 * Plane: ISO/IEC 19775-1 13.3.6: s runs along the longest side from 0 to 1, t along the second
 * longest in the same measure; of equal sides x comes before y before z. The default of an
 * IndexedFaceSet, and BOUNDS2D of ShaderTexture and TextureCoordinateGenerator.
 * Box: 33.2.4: s, t and r run from 0 to 1 along x, y and -z: r is 0 in front, 1 at the back. The
 * default for 3D textures, and BOUNDS3D. A side of length 0 has 0 everywhere. */
const float *plr_mesh_plane_coords(plr_mesh *mesh);
const float *plr_mesh_box_coords(plr_mesh *mesh);
/* The directions in which s of unit 0 grows on the surface, at length 1, and 1 or -1: the direction
 * of t is that times N x T. 4 each, made at the first call, owned by the mesh; NULL without memory,
 * for lines and points. */
const float *plr_mesh_tangents(plr_mesh *mesh);

#endif
