/* Extrusion: ISO/IEC 19775-1 13.3.5. A cross-section stands in a plane of its own at each point of
 * the spine; neighbouring sections are joined by quadrilaterals. */
#include "base/matrix.h"
#include "engine/mesh_internal.h"

#include <math.h>
#include <string.h>

/* More quadrilaterals, which grow as a product of two lists, are refused. */
#define QUAD_LIMIT ((size_t)1 << 19)
/* Below this sine of the angle between two edges they are taken as one line. */
#define STRAIGHT 1e-5

/* The plane at a point of the spine (the standard's SCP): three unit vectors. */
typedef struct frame {
    double x[3], y[3], z[3];
    bool bent; /* the spine turns here, so z is known */
} frame;

typedef struct extrusion {
    plr_polygons *polygons;
    const plr_field *spine, *section, *scale, *orientation;
    size_t rows, columns; /* points of spine and cross-section */
    bool spine_closed, section_closed;
    frame *frames;
    float *points, *tex; /* rows * columns, then those of the caps */
    uint32_t point_count;
} extrusion;

static void spine_point(const extrusion *e, size_t i, double point[3]) {
    for (int axis = 0; axis < 3; axis++)
        point[axis] = (double)e->spine->value.floats[3 * i + (size_t)axis];
}

static void subtract(const double a[3], const double b[3], double result[3]) {
    for (int axis = 0; axis < 3; axis++)
        result[axis] = a[axis] - b[axis];
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double result[3]) {
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

static bool normalize(double v[3]) {
    double length = sqrt(dot(v, v));
    for (int axis = 0; length > 0 && axis < 3; axis++)
        v[axis] /= length;
    return length > 0;
}

static bool same_values(const plr_field *field, size_t a, size_t b) {
    size_t size = (size_t)plr_type_components(field->type);
    for (size_t i = 0; i < size; i++)
        if (field->value.floats[a * size + i] != field->value.floats[b * size + i])
            return false;
    return true;
}

/* ---- Planes ---- */

/* y and, where the spine turns, z of the plane at `at` between its neighbours that stand elsewhere;
 * NULL: none on that side. */
static void find_axes(frame *f, const double at[3], const double *previous, const double *next) {
    double forward[3] = {0}, back[3] = {0};
    if (next)
        subtract(next, at, forward);
    if (previous)
        subtract(previous, at, back);
    subtract(forward, back, f->y);
    if (!normalize(f->y)) {
        /* the spine runs back the way it came, or there is one point only */
        memcpy(f->y, forward, sizeof forward);
        if (!normalize(f->y))
            f->y[1] = 1;
    }
    cross(forward, back, f->z);
    double sine = dot(f->z, f->z), lengths = dot(forward, forward) * dot(back, back);
    f->bent = sine > STRAIGHT * STRAIGHT * lengths && normalize(f->z);
}

/* The next point of the spine in one direction that stands elsewhere; a closed spine has no ends.
 * `rows` where there is none. */
static size_t neighbour(const extrusion *e, size_t from, bool forward) {
    size_t end = e->rows - 1, i = from;
    do {
        if (i == (forward ? end : 0) && !e->spine_closed)
            return e->rows;
        i = forward ? (i < end ? i + 1 : 0) : (i > 0 ? i - 1 : end);
    } while (i != from && same_values(e->spine, i, from));
    return i != from ? i : e->rows;
}

/* Coincident points first..last have one plane. */
static void find_run_axes(extrusion *e, size_t first, size_t last) {
    double at[3], previous[3], next[3];
    size_t before = neighbour(e, first, false), after = neighbour(e, last, true);
    spine_point(e, first, at);
    if (before < e->rows)
        spine_point(e, before, previous);
    if (after < e->rows)
        spine_point(e, after, next);
    find_axes(&e->frames[first], at, before < e->rows ? previous : NULL,
              after < e->rows ? next : NULL);
    for (size_t i = first + 1; i <= last; i++)
        e->frames[i] = e->frames[first];
}

/* Of a spine without bends: the Y axis is turned into the spine, and z with it. */
static void straight_z(const double y[3], double z[3]) {
    double axis[3] = {y[2], 0, -y[0]}; /* (0, 1, 0) x y */
    double angle = atan2(sqrt(dot(axis, axis)), y[1]);
    plr_matrix turn = plr_matrix_rotation(axis[0], axis[1], axis[2], angle);
    const double along_z[3] = {0, 0, 1};
    plr_matrix_point(&turn, along_z, z);
}

static void find_frames(extrusion *e) {
    e->frames = PLR_NEW_ARRAY(e->polygons->arena, e->rows, frame);
    for (size_t first = 0, last; first < e->rows; first = last + 1) {
        for (last = first; last + 1 < e->rows && same_values(e->spine, last + 1, first);)
            last++;
        find_run_axes(e, first, last);
    }
    size_t bent = 0;
    while (bent < e->rows && !e->frames[bent].bent)
        bent++;
    for (size_t i = 0; i < e->rows; i++) {
        frame *f = &e->frames[i];
        if (bent == e->rows)
            straight_z(f->y, f->z);
        else if (!f->bent)
            memcpy(f->z, e->frames[i ? i - 1 : bent].z, sizeof f->z);
        if (i && dot(f->z, e->frames[i - 1].z) < 0)
            for (int axis = 0; axis < 3; axis++)
                f->z[axis] = -f->z[axis];
        cross(f->y, f->z, f->x);
        normalize(f->x);
    }
}

/* ---- Points ---- */

/* The element that row i takes: its own, or the first where there are too few. */
static const float *of_row(const extrusion *e, const plr_field *field, size_t i) {
    size_t at = field->count < e->rows ? 0 : i;
    return field->value.floats + at * (size_t)plr_type_components(field->type);
}

static void make_row(extrusion *e, size_t i) {
    const frame *f = &e->frames[i];
    double scale[2] = {1, 1}, at[3];
    plr_matrix turn = plr_matrix_identity();
    if (e->scale->count)
        for (int k = 0; k < 2; k++)
            scale[k] = (double)of_row(e, e->scale, i)[k];
    if (e->orientation->count) {
        const float *r = of_row(e, e->orientation, i);
        turn = plr_matrix_rotation((double)r[0], (double)r[1], (double)r[2], (double)r[3]);
    }
    spine_point(e, i, at);
    for (size_t j = 0; j < e->columns; j++) {
        const float *flat = e->section->value.floats + 2 * j;
        double p[3] = {(double)flat[0] * scale[0], 0, (double)flat[1] * scale[1]};
        plr_matrix_point(&turn, p, p);
        for (int axis = 0; axis < 3; axis++)
            e->points[3 * (i * e->columns + j) + (size_t)axis] =
                (float)(at[axis] + p[0] * f->x[axis] + p[1] * f->y[axis] + p[2] * f->z[axis]);
    }
}

/* How far along a curve each of its points lies, 0 to 1; evenly where it has no length. */
static double *measure(const extrusion *e, const plr_field *curve, size_t count) {
    double *along = PLR_NEW_ARRAY(e->polygons->arena, count, double);
    size_t size = (size_t)plr_type_components(curve->type);
    for (size_t i = 1; i < count; i++) {
        double square = 0;
        for (size_t k = 0; k < size; k++) {
            double step = (double)curve->value.floats[i * size + k] -
                          (double)curve->value.floats[(i - 1) * size + k];
            square += step * step;
        }
        along[i] = along[i - 1] + sqrt(square);
    }
    double length = along[count - 1];
    for (size_t i = 0; i < count; i++)
        along[i] = length > 0 ? along[i] / length : (double)i / (double)(count - 1);
    return along;
}

static void make_points(extrusion *e) {
    size_t count = e->rows * e->columns + 2 * e->columns;
    e->points = plr_arena_array(e->polygons->arena, count, 3 * sizeof *e->points);
    e->tex = plr_arena_array(e->polygons->arena, count, 4 * sizeof *e->tex);
    double *s = measure(e, e->section, e->columns), *t = measure(e, e->spine, e->rows);
    for (size_t i = 0; i < e->rows; i++) {
        make_row(e, i);
        for (size_t j = 0; j < e->columns; j++) {
            float *tex = e->tex + 4 * (i * e->columns + j);
            tex[0] = (float)s[j];
            tex[1] = (float)t[i];
            tex[3] = 1;
        }
    }
    e->point_count = (uint32_t)(e->rows * e->columns);
}

/* ---- Faces ---- */

static void add_corner(extrusion *e, uint32_t coord, uint32_t tex) {
    *PLR_PUSH(e->polygons->arena, &e->polygons->corners) =
        (plr_corner){coord, PLR_MESH_NONE, PLR_MESH_NONE, tex};
}

static void end_face(extrusion *e, size_t first) {
    plr_polygons *p = e->polygons;
    *PLR_PUSH(p->arena, &p->faces) =
        (plr_face){(uint32_t)first, (uint32_t)(p->corners.count - first)};
}

/* Where sections are closed or the last lies on the first, the seam is one edge: normals may be
 * smooth across it. Texture coordinates stay apart. */
static void add_side_corner(extrusion *e, size_t row, size_t column, bool ends_meet) {
    size_t tex = row * e->columns + column;
    if (ends_meet && row + 1 == e->rows)
        row = 0;
    if (e->section_closed && column + 1 == e->columns)
        column = 0;
    add_corner(e, (uint32_t)(row * e->columns + column), (uint32_t)tex);
}

static void add_sides(extrusion *e) {
    bool ends_meet = e->spine_closed;
    for (size_t i = 0; i < 3 * e->columns && ends_meet; i++)
        ends_meet = e->points[i] == e->points[3 * (e->rows - 1) * e->columns + i];
    for (size_t i = 0; i + 1 < e->rows; i++)
        for (size_t j = 0; j + 1 < e->columns; j++) {
            size_t first = e->polygons->corners.count;
            add_side_corner(e, i, j, ends_meet);
            add_side_corner(e, i, j + 1, ends_meet);
            add_side_corner(e, i + 1, j + 1, ends_meet);
            add_side_corner(e, i + 1, j, ends_meet);
            end_face(e, first);
        }
}

/* A cap has points of its own, so that its normal is its plane's whatever the crease angle. Its
 * texture lies along X and Z of the cross-section, the larger side from 0 to 1. */
static void add_cap(extrusion *e, size_t row, bool reversed) {
    size_t count = e->columns - (e->section_closed ? 1 : 0), first = e->polygons->corners.count;
    if (count < 3)
        return;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    const float *flat = e->section->value.floats;
    for (size_t i = 0; i < 2 * count; i++) {
        low[i % 2] = fmin(low[i % 2], (double)flat[i]);
        high[i % 2] = fmax(high[i % 2], (double)flat[i]);
    }
    double size = fmax(high[0] - low[0], high[1] - low[1]);
    for (size_t i = 0; i < count; i++) {
        size_t j = reversed ? count - 1 - i : i;
        memcpy(e->points + 3 * (size_t)e->point_count, e->points + 3 * (row * e->columns + j),
               3 * sizeof *e->points);
        float *tex = e->tex + 4 * (size_t)e->point_count;
        for (size_t k = 0; k < 2; k++)
            tex[k] = size > 0 ? (float)(((double)flat[2 * j + k] - low[k]) / size) : 0;
        tex[3] = 1;
        add_corner(e, e->point_count, e->point_count);
        e->point_count++;
    }
    end_face(e, first);
}

/* ---- Reading ---- */

static void warn_about_count(const extrusion *e, const plr_field *field) {
    if (field->count > 1 && field->count < e->rows)
        plr_diags_add_as(e->polygons->diags, PLR_WARNING, PLR_CODE_BAD_GEOMETRY, field->place,
                         "%zu values for %zu points of the spine: the first is taken for all",
                         field->count, e->rows);
}

static bool refuse(const extrusion *e, const char *why) {
    plr_diags_add(e->polygons->diags, PLR_CODE_BAD_GEOMETRY, plr_node_place(e->polygons->node),
                  "the Extrusion %s", why);
    return false;
}

static bool all_finite(const extrusion *e) {
    for (size_t i = 0; i < e->rows * e->columns * 3; i++)
        if (!isfinite(e->points[i]))
            return false;
    return true;
}

static bool read_extrusion(extrusion *e) {
    const plr_node *node = e->polygons->node;
    e->spine = plr_node_field(node, "spine");
    e->section = plr_node_field(node, "crossSection");
    e->scale = plr_node_field(node, "scale");
    e->orientation = plr_node_field(node, "orientation");
    e->rows = e->spine->count;
    e->columns = e->section->count;
    if (e->rows < 2 || e->columns < 2)
        return false; /* nothing is spanned */
    if (e->columns > QUAD_LIMIT / e->rows)
        return refuse(e, "has more faces than plugray takes");
    e->spine_closed = e->rows > 2 && same_values(e->spine, 0, e->rows - 1);
    e->section_closed = e->columns > 2 && same_values(e->section, 0, e->columns - 1);
    warn_about_count(e, e->scale);
    warn_about_count(e, e->orientation);
    find_frames(e);
    make_points(e);
    return all_finite(e) || refuse(e, "has points that are not finite");
}

bool plr_make_extrusion(plr_maker *maker) {
    plr_polygons polygons = {.arena = maker->arena,
                             .node = maker->node,
                             .diags = maker->diags,
                             .kind = PLR_MESH_TRIANGLES,
                             .concave = true,
                             .tex_given = plr_node_child(maker->node, "texCoord") != NULL};
    extrusion e = {.polygons = &polygons};
    if (!read_extrusion(&e))
        return false;
    add_sides(&e);
    polygons.convex_faces = polygons.faces.count;
    if (plr_node_bool(maker->node, "beginCap"))
        add_cap(&e, 0, true);
    if (plr_node_bool(maker->node, "endCap"))
        add_cap(&e, e.rows - 1, false);
    polygons.points = e.points;
    polygons.point_count = e.point_count;
    polygons.tex_coords[0] = e.tex;
    polygons.tex_counts[0] = e.point_count;
    plr_polygons_make_normals(&polygons, plr_node_number(maker->node, "creaseAngle"),
                              maker->mesh->clockwise);
    return plr_polygons_emit(&polygons, maker->mesh);
}
