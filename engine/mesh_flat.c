/* Shapes in the plane z = 0: ISO/IEC 19775-1 14.3 (Geometry2D). What the standard does not say:
 * round areas are cut out of a texture that fills the square around the whole circle. */
#include "engine/mesh_internal.h"

#include <math.h>
#include <string.h>

typedef struct arc {
    double radius, start, sweep; /* counterclockwise from +X */
    size_t segments;
    bool full;
} arc;

static void arc_at(const void *data, size_t i, double point[2]) {
    const arc *a = data;
    if (a->full && i == a->segments)
        i = 0; /* ends where it begins, to the bit */
    double angle = a->start + a->sweep * (double)i / (double)a->segments;
    point[0] = a->radius * cos(angle);
    point[1] = a->radius * sin(angle);
}

static arc whole_circle(double radius, uint32_t slices) {
    return (arc){radius, 0, 2 * acos(-1.0), slices, true};
}

/* From startAngle counterclockwise to endAngle; equal angles are a circle. */
static arc read_arc(const plr_node *node) {
    const double turn = 2 * acos(-1.0);
    double start = plr_node_number(node, "startAngle"), end = plr_node_number(node, "endAngle");
    double sweep = fmod(end - start, turn);
    if (sweep < 0)
        sweep += turn;
    if (!(sweep > 1e-6) || sweep > turn - 1e-6)
        sweep = turn;
    return (arc){plr_node_number(node, "radius"), start, sweep,
                 (size_t)ceil(PLR_MESH_SLICES * sweep / turn), sweep == turn};
}

static bool add_arc(plr_maker *maker, const arc *a) {
    plr_mesh_reserve(maker, PLR_MESH_LINES, a->segments + 1, 2 * a->segments);
    plr_mesh_add_points(maker->mesh, a->segments + 1, arc_at, a);
    return true;
}

bool plr_make_arc(plr_maker *maker) {
    arc a = read_arc(maker->node);
    return add_arc(maker, &a);
}

bool plr_make_circle(plr_maker *maker) {
    arc a = whole_circle(plr_node_number(maker->node, "radius"),
                         plr_mesh_subdivision(maker, "slices", PLR_MESH_SLICES, 3));
    return add_arc(maker, &a);
}

/* A point at the part `scale` of the way from the middle to the point i of the arc. */
static uint32_t add_area_vertex(plr_mesh *mesh, const arc *a, size_t i, double scale) {
    double point[2];
    arc_at(a, i, point);
    double position[3] = {point[0] * scale, point[1] * scale, 0};
    double size = a->radius > 0 ? 2 * a->radius : 1;
    return plr_mesh_add_vertex(mesh, position, (double[]){0, 0, 1}, 0.5 + position[0] / size,
                               0.5 + position[1] / size);
}

/* The area between the arc and its middle, or with `chord` its chord. */
static bool add_sector(plr_maker *maker, const arc *a, bool chord) {
    plr_mesh *mesh = maker->mesh;
    plr_mesh_reserve(maker, PLR_MESH_TRIANGLES, a->segments + 2, 3 * a->segments);
    if (!chord)
        add_area_vertex(mesh, a, 0, 0);
    for (size_t i = 0; i <= a->segments; i++)
        add_area_vertex(mesh, a, i, 1);
    for (uint32_t i = 1; i + 1 < mesh->vertex_count; i++)
        plr_mesh_add_triangle(mesh, 0, i, i + 1);
    return mesh->index_count > 0;
}

bool plr_make_arc_close(plr_maker *maker) {
    arc a = read_arc(maker->node);
    bool chord = strcmp(plr_node_string(maker->node, "closureType"), "CHORD") == 0;
    return add_sector(maker, &a, chord && !a.full);
}

bool plr_make_disk(plr_maker *maker) {
    double outer = plr_node_number(maker->node, "outerRadius");
    double inner = plr_node_number(maker->node, "innerRadius");
    arc a = whole_circle(outer, PLR_MESH_SLICES);
    if (inner == outer) /* 14.3.5: then a Circle2D */
        return add_arc(maker, &a);
    if (inner > outer) {
        plr_diags_add(maker->diags, PLR_CODE_BAD_GEOMETRY,
                      plr_node_field(maker->node, "innerRadius")->place,
                      "innerRadius is larger than outerRadius");
        return false;
    }
    if (!(inner > 0))
        return add_sector(maker, &a, false);
    plr_mesh_reserve(maker, PLR_MESH_TRIANGLES, 2 * (a.segments + 1), 6 * a.segments);
    for (size_t i = 0; i <= a.segments; i++) {
        uint32_t at = add_area_vertex(maker->mesh, &a, i, inner / outer);
        add_area_vertex(maker->mesh, &a, i, 1);
        if (i) {
            plr_mesh_add_triangle(maker->mesh, at - 2, at - 1, at + 1);
            plr_mesh_add_triangle(maker->mesh, at - 2, at + 1, at);
        }
    }
    return true;
}

/* Points of a field, up to the first that is not finite (reported). */
static const float *read_points(plr_maker *maker, const char *name, size_t *count) {
    const plr_field *field = plr_node_field(maker->node, name);
    *count = 0;
    if (!field || field->type != PLR_MFVEC2F)
        return NULL;
    while (*count < field->count && *count < PLR_MESH_LIMIT &&
           isfinite(field->value.floats[2 * *count]) &&
           isfinite(field->value.floats[2 * *count + 1]))
        ++*count;
    if (*count < field->count)
        plr_diags_add(maker->diags, PLR_CODE_BAD_GEOMETRY, field->place,
                      "point %zu is not finite; it and the rest are left out", *count);
    return field->value.floats;
}

static void point_at(const void *data, size_t i, double point[2]) {
    const float *points = data;
    point[0] = (double)points[2 * i];
    point[1] = (double)points[2 * i + 1];
}

bool plr_make_polyline(plr_maker *maker) {
    size_t count;
    const float *points = read_points(maker, "lineSegments", &count);
    if (count < 2)
        return false;
    plr_mesh_reserve(maker, PLR_MESH_LINES, count, 2 * (count - 1));
    plr_mesh_add_points(maker->mesh, count, point_at, points);
    return true;
}

bool plr_make_polypoint(plr_maker *maker) {
    size_t count;
    const float *points = read_points(maker, "point", &count);
    plr_mesh_reserve(maker, PLR_MESH_POINTS, count, count);
    plr_mesh_add_points(maker->mesh, count, point_at, points);
    return count > 0;
}

bool plr_make_triangles2d(plr_maker *maker) {
    size_t count;
    const float *points = read_points(maker, "vertices", &count);
    if (count % 3)
        plr_diags_add_as(maker->diags, PLR_WARNING, PLR_CODE_BAD_GEOMETRY,
                         plr_node_field(maker->node, "vertices")->place,
                         "the last %zu vertices make no triangle", count % 3);
    count -= count % 3;
    plr_mesh_reserve(maker, PLR_MESH_TRIANGLES, count, count);
    for (size_t i = 0; i < count; i += 3) {
        double p[3][3] = {{0}};
        for (size_t corner = 0; corner < 3; corner++)
            point_at(points, i + corner, p[corner]);
        double turn =
            (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        /* a clockwise triangle shows its back: its normal points away */
        double normal[3] = {0, 0, turn < 0 ? -1 : 1};
        for (size_t corner = 0; corner < 3; corner++)
            plr_mesh_add_vertex(maker->mesh, p[corner], normal, 0, 0);
        plr_mesh_add_triangle(maker->mesh, (uint32_t)i, (uint32_t)i + 1, (uint32_t)i + 2);
    }
    if (count)
        plr_mesh_map_plane(maker);
    return count > 0;
}
