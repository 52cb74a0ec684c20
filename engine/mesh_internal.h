/* Inside the mesh builder: polygons as geometry nodes describe them, on their way to triangles. */
#ifndef PLR_ENGINE_MESH_INTERNAL_H
#define PLR_ENGINE_MESH_INTERNAL_H

#include "base/arena.h"
#include "engine/mesh.h"

/* More indices, counts or points than this in one node are refused. */
#define PLR_MESH_LIMIT ((size_t)100 * 1000 * 1000)
/* "no value": the shape has none of this kind, or it is made later. */
#define PLR_MESH_NONE UINT32_MAX

/* A corner of a polygon: indices into the values of plr_polygons. */
typedef struct plr_corner {
    uint32_t coord, normal, color, tex;
} plr_corner;

typedef struct plr_face {
    uint32_t first, count; /* corners */
} plr_face;

/* Polygons, polylines or points of one node. Memory is the arena's. */
typedef struct plr_polygons {
    plr_arena *arena;
    const plr_node *node;
    plr_diags *diags;
    plr_mesh_kind kind;
    bool concave;         /* faces may be concave, */
    size_t convex_faces;  /* all but the first so many */
    const float *points;  /* 3 each */
    const float *normals; /* 3 each; given or generated */
    const float *colors;  /* 4 each */
    /* 4 each; NULL: the default mapping by bounding box. Units beyond have none of their own. */
    const float *tex_coords[PLR_MESH_TEX_UNITS];
    uint32_t tex_counts[PLR_MESH_TEX_UNITS]; /* values of each */
    unsigned tex_units;
    bool tex_given; /* there is a texCoord node */
    uint32_t point_count;
    struct {
        plr_corner *items;
        size_t count, capacity;
    } corners;
    struct {
        plr_face *items;
        size_t count, capacity;
    } faces;
} plr_polygons;

/* mesh_read.c: reads a node that is made of coordinates. False if nothing can be drawn (reported).
 */
bool plr_mesh_is_polygons(const plr_node *node);
bool plr_polygons_read(plr_polygons *polygons);

/* mesh_values.c: the values of property nodes (Coordinate, Normal, Color, ...) as plain floats;
 * NULL and count 0 where the node has none. */
const float *plr_mesh_values(plr_arena *arena, const plr_node *property, const char *field,
                             int components, const float *missing, uint32_t *count);
/* Reads the units of a texCoord node; returns how many values all units have that have any: as many
 * as the shortest. */
uint32_t plr_polygons_tex_coords(plr_polygons *polygons, const plr_node *tex_coord);
void plr_mesh_attributes(plr_polygons *polygons, plr_mesh *mesh, const uint32_t *coords);

/* mesh_normals.c: gives every corner a normal, from the faces alone. Two neighbours are smooth
 * across their edge where the angle between them is below `crease` (radians); `clockwise`: faces
 * are seen from the side where their corners run clockwise. */
void plr_polygons_make_normals(plr_polygons *polygons, double crease, bool clockwise);
/* Twice the area of a polygon along its normal (Newell's sum). */
void plr_face_normal(const plr_polygons *polygons, const plr_face *face, double normal[3]);

/* mesh_triangulate.c: cuts a polygon into count - 2 triangles by clipping ears; `triangles` takes
 * 3 * (count - 2) corner numbers, counted from the face's first. A polygon that crosses itself
 * gives as many triangles, that may overlap. */
typedef struct plr_clipper {
    plr_arena *arena;
    struct plr_ring *ring;
    size_t ring_capacity;
    uint32_t *queue, *cells;
    size_t queue_capacity, cell_capacity;
    uint64_t budget; /* steps left before the search for ears is given up */
} plr_clipper;
void plr_triangulate(plr_clipper *clipper, const plr_polygons *polygons, const plr_face *face,
                     uint32_t *triangles);

/* mesh_outline.c: adds the area that closed contours bound, which do not cross; holes run the other
 * way around than what they are in. `ends`: where each contour ends, one past its last point. The
 * points get the numbers from `coord` on, as coordinates and texture coordinates, and normal 0;
 * they are put in the order of counterclockwise areas. */
void plr_polygons_add_outline(plr_polygons *polygons, double (*points)[2], const uint32_t *ends,
                              size_t contour_count, uint32_t coord);

/* mesh_emit.c: vertices and indices. False if there is nothing to draw. */
bool plr_polygons_emit(plr_polygons *polygons, plr_mesh *mesh);
/* malloc for the mesh's own arrays; without memory jumps as the arena does. */
void *plr_mesh_array(plr_arena *arena, size_t count, size_t size);

/* mesh_mapping.c: what both mappings rest upon. */
void plr_mesh_find_bounds(plr_mesh *mesh);

/* A shape that is described by a few numbers, on its way to a mesh. */
typedef struct plr_maker {
    plr_arena *arena;
    const plr_node *node;
    plr_mesh *mesh;
    plr_diags *diags;
    const char *const *font_folders; /* as plr_font_open takes them */
    struct plr_font *font;           /* closed when the mesh is built, whatever happens */
} plr_maker;

/* mesh_add.c: meshes put together vertex by vertex. Triangles have normals and texture coordinates,
 * lines their lengths; nothing beyond what is reserved may be added. */
void plr_mesh_reserve(plr_maker *maker, plr_mesh_kind kind, size_t vertices, size_t indices);
/* The normal need not have length 1. */
uint32_t plr_mesh_add_vertex(plr_mesh *mesh, const double position[3], const double normal[3],
                             double tex_s, double tex_t);
void plr_mesh_add_triangle(plr_mesh *mesh, uint32_t a, uint32_t b, uint32_t c);
/* One polyline or a row of points in the plane z = 0; `at` yields point i. */
void plr_mesh_add_points(plr_mesh *mesh, size_t count,
                         void (*at)(const void *data, size_t i, double point[2]), const void *data);
/* Texture coordinates by the bounding box. */
void plr_mesh_map_plane(plr_maker *maker);
/* How finely a field of the extension (`slices`, ...) says that a shape be divided: `standard`
 * where it says nothing or -1, at least `least`; what is too fine is limited (warned). */
uint32_t plr_mesh_subdivision(const plr_maker *maker, const char *field, uint32_t standard,
                              uint32_t least);

/* One function a shape; false if nothing is to be drawn. mesh_shapes.c: */
bool plr_make_box(plr_maker *maker);
bool plr_make_sphere(plr_maker *maker);
bool plr_make_cone(plr_maker *maker);
bool plr_make_cylinder(plr_maker *maker);
bool plr_make_rectangle(plr_maker *maker);
/* mesh_flat.c: */
bool plr_make_arc(plr_maker *maker);
bool plr_make_arc_close(plr_maker *maker);
bool plr_make_circle(plr_maker *maker);
bool plr_make_disk(plr_maker *maker);
bool plr_make_polyline(plr_maker *maker);
bool plr_make_polypoint(plr_maker *maker);
bool plr_make_triangles2d(plr_maker *maker);
/* mesh_extrusion.c, mesh_teapot.c, mesh_text.c: */
bool plr_make_extrusion(plr_maker *maker);
bool plr_make_text(plr_maker *maker);
bool plr_make_teapot(plr_maker *maker);

/* Segments of a full circle. */
#define PLR_MESH_SLICES 96

#endif
