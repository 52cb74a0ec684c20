/* Geometry nodes that are made of coordinates, as polygons. ISO/IEC 19775-1 clauses 11 (Rendering),
 * 13 (Geometry3D) and 32 (CAD geometry). */
#include "engine/mesh_internal.h"

#include <math.h>
#include <string.h>

/* How one run of coordinates becomes faces. */
typedef enum pattern {
    POLYGON, /* the run is one face */
    FAN,
    STRIP,
    GROUPS /* faces of `size` corners */
} pattern;

/* Where runs end. */
typedef enum ending {
    AT_MINUS_ONE, /* an index of -1 */
    BY_COUNTS,    /* a field of lengths */
    NEVER
} ending;

typedef struct form {
    const char *type;
    const char *index;  /* field of coordinate indices, or NULL: all points in order */
    const char *counts; /* field of lengths of runs */
    ending ending;
    pattern pattern;
    uint32_t size; /* corners of a face; of a polygon: at least */
    plr_mesh_kind kind;
} form;

static const form forms[] = {
    {"IndexedFaceSet", "coordIndex", NULL, AT_MINUS_ONE, POLYGON, 3, PLR_MESH_TRIANGLES},
    {"IndexedTriangleSet", "index", NULL, NEVER, GROUPS, 3, PLR_MESH_TRIANGLES},
    {"IndexedTriangleFanSet", "index", NULL, AT_MINUS_ONE, FAN, 3, PLR_MESH_TRIANGLES},
    {"IndexedTriangleStripSet", "index", NULL, AT_MINUS_ONE, STRIP, 3, PLR_MESH_TRIANGLES},
    {"IndexedQuadSet", "index", NULL, NEVER, GROUPS, 4, PLR_MESH_TRIANGLES},
    {"TriangleSet", NULL, NULL, NEVER, GROUPS, 3, PLR_MESH_TRIANGLES},
    {"TriangleFanSet", NULL, "fanCount", BY_COUNTS, FAN, 3, PLR_MESH_TRIANGLES},
    {"TriangleStripSet", NULL, "stripCount", BY_COUNTS, STRIP, 3, PLR_MESH_TRIANGLES},
    {"QuadSet", NULL, NULL, NEVER, GROUPS, 4, PLR_MESH_TRIANGLES},
    {"ElevationGrid", NULL, NULL, NEVER, GROUPS, 4, PLR_MESH_TRIANGLES},
    {"IndexedLineSet", "coordIndex", NULL, AT_MINUS_ONE, POLYGON, 2, PLR_MESH_LINES},
    {"LineSet", NULL, "vertexCount", BY_COUNTS, POLYGON, 2, PLR_MESH_LINES},
    {"PointSet", NULL, NULL, NEVER, GROUPS, 1, PLR_MESH_POINTS},
};

static const form *find_form(const plr_node *node) {
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        if (strcmp(plr_node_type(node), forms[i].type) == 0)
            return &forms[i];
    return NULL;
}

bool plr_mesh_is_polygons(const plr_node *node) {
    return find_form(node) != NULL;
}

/* One kind of value at the corners: which of them a corner takes. */
typedef struct binding {
    const plr_field *index; /* NULL: coordinate index or number of the face */
    const plr_node *property;
    uint32_t count; /* values; 0: the shape has none */
    bool per_face;
} binding;

enum {
    NORMAL,
    COLOR,
    TEX,
    BINDINGS
};

/* What is wrong with indices of one field, told once. */
typedef struct index_fault {
    const plr_field *field;
    int64_t first; /* the first bad index */
    size_t range, times;
} index_fault;

typedef struct reader {
    plr_polygons *polygons;
    const form *form;
    const plr_field *index; /* NULL: i */
    size_t length;          /* of the index list */
    binding bindings[BINDINGS];
    uint32_t face_number; /* of the next face, faulty ones counted */
    index_fault coord_fault, binding_faults[BINDINGS];
    size_t short_faces;
} reader;

static bool complain(index_fault *fault, const plr_field *field, int64_t index, size_t range) {
    if (!fault->times++) {
        fault->field = field;
        fault->first = index;
        fault->range = range;
    }
    return false;
}

static bool is_finite(const float *point) {
    return isfinite(point[0]) && isfinite(point[1]) && isfinite(point[2]);
}

/* The value that a corner takes; without one the corner is drawn all the same. */
static void bind(reader *r, int kind, size_t at, uint32_t coord, uint32_t *value) {
    const binding *b = &r->bindings[kind];
    *value = PLR_MESH_NONE;
    if (!b->count)
        return;
    int64_t index = b->per_face ? (int64_t)r->face_number : (int64_t)coord;
    if (b->index) {
        size_t position = b->per_face ? r->face_number : at;
        index = position < b->index->count ? b->index->value.ints[position] : -1;
    }
    if (index < 0 || index >= (int64_t)b->count)
        complain(&r->binding_faults[kind], b->index, index, b->count);
    if (index >= 0 && index < (int64_t)(kind == TEX ? PLR_MESH_NONE : b->count))
        *value = (uint32_t)index; /* units of texture coordinates may differ in length */
}

/* The corner at place `at` of the index list. */
static bool make_corner(reader *r, size_t at, plr_corner *corner) {
    int64_t index = r->index ? r->index->value.ints[at] : (int64_t)at;
    if (index < 0 || index >= (int64_t)r->polygons->point_count)
        return complain(&r->coord_fault, r->index, index, r->polygons->point_count);
    corner->coord = (uint32_t)index;
    if (!is_finite(r->polygons->points + 3 * (size_t)index))
        return complain(&r->coord_fault, r->index, index, 0);
    bind(r, NORMAL, at, corner->coord, &corner->normal);
    bind(r, COLOR, at, corner->coord, &corner->color);
    bind(r, TEX, at, corner->coord, &corner->tex);
    return true;
}

/* A face whose corners stand at `places`, or at first, first + 1, ...; left out where one is
 * faulty. */
static void add_face(reader *r, const size_t *places, size_t first, size_t count) {
    plr_polygons *p = r->polygons;
    size_t before = p->corners.count;
    bool sound = true;
    for (size_t i = 0; i < count && sound; i++) {
        plr_corner corner;
        sound = make_corner(r, places ? places[i] : first + i, &corner);
        if (sound)
            *PLR_PUSH(p->arena, &p->corners) = corner;
    }
    if (sound)
        *PLR_PUSH(p->arena, &p->faces) = (plr_face){(uint32_t)before, (uint32_t)count};
    else
        p->corners.count = before;
    r->face_number++;
}

static void add_run(reader *r, size_t first, size_t count) {
    if (!count)
        return;
    size_t size = r->form->size;
    if (count < size) {
        r->short_faces++;
        r->face_number += r->form->pattern == POLYGON;
        return;
    }
    switch (r->form->pattern) {
    case POLYGON:
        add_face(r, NULL, first, count);
        break;
    case FAN:
        for (size_t i = 2; i < count; i++)
            add_face(r, (size_t[]){first, first + i - 1, first + i}, 0, 3);
        break;
    case STRIP:
        for (size_t i = 2; i < count; i++)
            add_face(r, (size_t[]){first + i - 2 + i % 2, first + i - 1 - i % 2, first + i}, 0, 3);
        break;
    case GROUPS:
        for (size_t i = 0; i + size <= count; i += size)
            add_face(r, NULL, first + i, size);
        r->short_faces += count % size != 0;
        break;
    }
}

static void add_runs_by_index(reader *r) {
    size_t first = 0;
    for (size_t i = 0; i < r->length; i++)
        if (r->index->value.ints[i] == -1) {
            add_run(r, first, i - first);
            first = i + 1;
        }
    add_run(r, first, r->length - first);
}

static void add_runs_by_counts(reader *r, const plr_field *counts) {
    size_t first = 0;
    for (size_t i = 0; counts && i < counts->count; i++) {
        int32_t count = counts->value.ints[i];
        if (count < 0 || (size_t)count > r->length - first) {
            plr_diags_add(r->polygons->diags, PLR_CODE_BAD_GEOMETRY, counts->place,
                          "%s asks for %lld points, %zu are left; the rest is left out",
                          counts->name, (long long)count, r->length - first);
            return;
        }
        add_run(r, first, (size_t)count);
        first += (size_t)count;
    }
}

static void tell(reader *r, const index_fault *fault, const plr_node *property, const char *what,
                 const char *outcome) {
    if (!fault->times)
        return;
    plr_place place = fault->field ? fault->field->place
                                   : plr_node_place(property ? property : r->polygons->node);
    if (!fault->range)
        plr_diags_add(r->polygons->diags, PLR_CODE_BAD_GEOMETRY, place,
                      "%s %lld is not finite; %zu %s", what, (long long)fault->first, fault->times,
                      outcome);
    else
        plr_diags_add(r->polygons->diags, PLR_CODE_BAD_GEOMETRY, place,
                      "there is no %s %lld, only 0 to %zu; %zu %s", what, (long long)fault->first,
                      fault->range - 1, fault->times, outcome);
}

static void tell_all(reader *r) {
    static const char *const names[BINDINGS] = {"normal", "colour", "texture coordinate"};
    static const char *const outcomes[BINDINGS] = {
        "corners lack one; normals are made from the faces", "corners are white",
        "corners have none"};
    const plr_node *coord = plr_node_child(r->polygons->node, "coord");
    tell(r, &r->coord_fault, coord, "point", "faces are left out");
    for (int i = 0; i < BINDINGS; i++)
        tell(r, &r->binding_faults[i], r->bindings[i].property, names[i], outcomes[i]);
    if (r->short_faces)
        plr_diags_add_as(r->polygons->diags, PLR_WARNING, PLR_CODE_BAD_GEOMETRY,
                         r->index ? r->index->place : plr_node_place(r->polygons->node),
                         "%zu faces have fewer than %u corners and are left out", r->short_faces,
                         r->form->size);
}

/* An index field that is given and not empty, or NULL. */
static const plr_field *index_field(const plr_node *node, const char *name) {
    const plr_field *field = plr_node_field(node, name);
    return field && field->type == PLR_MFINT32 && field->count ? field : NULL;
}

static bool bool_field(const plr_node *node, const char *name, bool missing) {
    const plr_field *field = plr_node_field(node, name);
    return field && field->type == PLR_SFBOOL ? field->value.bools[0] : missing;
}

static void read_properties(reader *r) {
    static const float missing[4] = {0, 0, 0, 1};
    plr_polygons *p = r->polygons;
    binding *b = r->bindings;
    b[NORMAL].property = plr_node_child(p->node, "normal");
    b[COLOR].property = plr_node_child(p->node, "color");
    b[TEX].property = plr_node_child(p->node, "texCoord");
    p->normals =
        plr_mesh_values(p->arena, b[NORMAL].property, "vector", 3, missing, &b[NORMAL].count);
    p->colors = plr_mesh_values(p->arena, b[COLOR].property, "color", 4, missing, &b[COLOR].count);
    b[TEX].count = plr_polygons_tex_coords(p, b[TEX].property);
    b[NORMAL].index = index_field(p->node, "normalIndex");
    b[COLOR].index = index_field(p->node, "colorIndex");
    b[TEX].index = index_field(p->node, "texCoordIndex");
    b[NORMAL].per_face = !bool_field(p->node, "normalPerVertex", true);
    b[COLOR].per_face = !bool_field(p->node, "colorPerVertex", true);
}

/* The default mapping of an ElevationGrid, s along x and t along z, for all units that have no list
 * of their own. */
static void map_grid(reader *r, size_t columns, size_t rows) {
    plr_polygons *p = r->polygons;
    float *tex = NULL;
    for (unsigned unit = 0; unit < (p->tex_units ? p->tex_units : 1); unit++) {
        if (p->tex_coords[unit])
            continue;
        if (!tex)
            tex = plr_arena_array(p->arena, columns * rows, 4 * sizeof *tex);
        p->tex_coords[unit] = tex;
        p->tex_counts[unit] = (uint32_t)(columns * rows);
    }
    for (size_t i = 0; tex && i < columns * rows; i++) {
        tex[4 * i] = (float)((double)(i % columns) / (double)(columns - 1));
        tex[4 * i + 1] = (float)((double)(i / columns) / (double)(rows - 1));
        tex[4 * i + 3] = 1;
    }
    if (tex && !r->bindings[TEX].count)
        r->bindings[TEX].count = (uint32_t)(columns * rows);
}

static void make_grid_points(reader *r, size_t columns, size_t rows) {
    plr_polygons *p = r->polygons;
    const float *heights = plr_node_field(p->node, "height")->value.floats;
    double spacing_x = plr_node_number(p->node, "xSpacing");
    double spacing_z = plr_node_number(p->node, "zSpacing");
    float *points = plr_arena_array(p->arena, columns * rows, 3 * sizeof *points);
    for (size_t i = 0; i < columns * rows; i++) {
        points[3 * i] = (float)((double)(i % columns) * spacing_x);
        points[3 * i + 1] = heights[i];
        points[3 * i + 2] = (float)((double)(i / columns) * spacing_z);
    }
    p->points = points;
    p->point_count = (uint32_t)(columns * rows);
    map_grid(r, columns, rows);
}

static bool read_grid(reader *r) {
    plr_polygons *p = r->polygons;
    int64_t columns = plr_node_int(p->node, "xDimension");
    int64_t rows = plr_node_int(p->node, "zDimension");
    const plr_field *heights = plr_node_field(p->node, "height");
    if (columns < 2 || rows < 2)
        return false; /* nothing to draw, by the standard */
    if (columns > (int64_t)PLR_MESH_LIMIT / rows || columns * rows > (int64_t)heights->count) {
        plr_diags_add(p->diags, PLR_CODE_BAD_GEOMETRY, heights->place,
                      "%lld x %lld points need as many heights, there are %zu", (long long)columns,
                      (long long)rows, heights->count);
        return false;
    }
    make_grid_points(r, (size_t)columns, (size_t)rows);
    for (size_t z = 0; z + 1 < (size_t)rows; z++)
        for (size_t x = 0; x + 1 < (size_t)columns; x++) {
            /* counterclockwise from above */
            size_t places[4] = {z * (size_t)columns + x, (z + 1) * (size_t)columns + x,
                                (z + 1) * (size_t)columns + x + 1, z * (size_t)columns + x + 1};
            add_face(r, places, 0, 4);
        }
    return true;
}

static bool read_coordinates(reader *r) {
    static const float missing[3] = {0, 0, 0};
    plr_polygons *p = r->polygons;
    const plr_node *coord = plr_node_child(p->node, "coord");
    p->points = plr_mesh_values(p->arena, coord, "point", 3, missing, &p->point_count);
    r->index = r->form->index ? plr_node_field(p->node, r->form->index) : NULL;
    r->length = r->form->index ? (r->index ? r->index->count : 0) : p->point_count;
    if (r->length > PLR_MESH_LIMIT) {
        plr_diags_add(p->diags, PLR_CODE_BAD_GEOMETRY,
                      r->index ? r->index->place : plr_node_place(p->node),
                      "%zu indices are more than plugray takes (%zu)", r->length, PLR_MESH_LIMIT);
        return false;
    }
    if (!p->point_count && r->index && r->length) {
        plr_diags_add(p->diags, PLR_CODE_BAD_GEOMETRY, r->index->place,
                      "there are indices, but no points");
        return false;
    }
    if (r->form->ending == AT_MINUS_ONE)
        add_runs_by_index(r);
    else if (r->form->ending == BY_COUNTS)
        add_runs_by_counts(r, plr_node_field(p->node, r->form->counts));
    else
        add_run(r, 0, r->length);
    return true;
}

/* The crease angle in force: of the node, else by normalPerVertex. */
static double crease_angle(const plr_node *node) {
    if (plr_node_field(node, "creaseAngle"))
        return plr_node_number(node, "creaseAngle");
    return bool_field(node, "normalPerVertex", true) ? 4.0 : 0.0; /* 4: more than any angle */
}

bool plr_polygons_read(plr_polygons *p) {
    reader r = {.polygons = p, .form = find_form(p->node)};
    p->kind = r.form->kind;
    p->concave = !bool_field(p->node, "convex", true);
    read_properties(&r);
    bool grid = strcmp(r.form->type, "ElevationGrid") == 0;
    if (!(grid ? read_grid(&r) : read_coordinates(&r)))
        return false;
    tell_all(&r);
    if (r.binding_faults[NORMAL].times)
        p->normals = NULL;
    if (p->faces.count && !p->normals && p->kind == PLR_MESH_TRIANGLES)
        plr_polygons_make_normals(p, crease_angle(p->node), !bool_field(p->node, "ccw", true));
    return p->faces.count > 0;
}
