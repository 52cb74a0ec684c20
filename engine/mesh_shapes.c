/* Shapes that a few numbers describe, with the exact normals of the true surface and the texture
 * mappings of ISO/IEC 19775-1 clauses 13.3 (Geometry3D) and 14.3 (Geometry2D). */
#include "engine/mesh_internal.h"

#include <math.h>

/* A rectangle: centre, half sides to the right and up as the texture lies, seen from their cross
 * product; cut into n * n. */
static void add_rectangle(plr_mesh *mesh, const double center[3], const double right[3],
                          const double up[3], uint32_t n) {
    double normal[3] = {right[1] * up[2] - right[2] * up[1], right[2] * up[0] - right[0] * up[2],
                        right[0] * up[1] - right[1] * up[0]};
    uint32_t first = mesh->vertex_count;
    for (uint32_t row = 0; row <= n; row++)
        for (uint32_t column = 0; column <= n; column++) {
            double s = (double)column / n, t = (double)row / n, position[3];
            for (int axis = 0; axis < 3; axis++)
                position[axis] = center[axis] + (2 * s - 1) * right[axis] + (2 * t - 1) * up[axis];
            plr_mesh_add_vertex(mesh, position, normal, s, t);
        }
    for (uint32_t row = 0; row < n; row++)
        for (uint32_t column = 0; column < n; column++) {
            uint32_t low = first + row * (n + 1) + column, high = low + n + 1;
            plr_mesh_add_triangle(mesh, low, low + 1, high + 1);
            plr_mesh_add_triangle(mesh, low, high + 1, high);
        }
}

bool plr_make_box(plr_maker *maker) {
    static const signed char sides[6][2][3] = {
        {{1, 0, 0}, {0, 1, 0}},  /* front: right along x, up along y */
        {{-1, 0, 0}, {0, 1, 0}}, /* back */
        {{0, 0, -1}, {0, 1, 0}}, /* right */
        {{0, 0, 1}, {0, 1, 0}},  /* left */
        {{1, 0, 0}, {0, 0, -1}}, /* top: upright when tilted towards the viewer at +Z */
        {{1, 0, 0}, {0, 0, 1}},  /* bottom: when the top is tilted away */
    };
    float size[3] = {2, 2, 2};
    plr_node_numbers(maker->node, "size", size, 3);
    /* divisions: how many cuts; 0: none */
    uint32_t n = plr_mesh_subdivision(maker, "divisions", 0, 0) + 1;
    size_t lines = n + 1, squares = (size_t)n * n;
    plr_mesh_reserve(maker, PLR_MESH_TRIANGLES, 6 * lines * lines, 36 * squares);
    for (int i = 0; i < 6; i++) {
        double right[3], up[3], center[3];
        const signed char *r = sides[i][0], *u = sides[i][1];
        const int normal[3] = {r[1] * u[2] - r[2] * u[1], r[2] * u[0] - r[0] * u[2],
                               r[0] * u[1] - r[1] * u[0]};
        for (int axis = 0; axis < 3; axis++) {
            double half = (double)size[axis] / 2;
            right[axis] = r[axis] * half;
            up[axis] = u[axis] * half;
            center[axis] = normal[axis] * half;
        }
        add_rectangle(maker->mesh, center, right, up, n);
    }
    return true;
}

/* The direction at the part `turn` (0 to 1) of the way around the Y axis: from the back (-Z)
 * counterclockwise as seen from above, over -X, front and +X. Exact at the seam. */
static void around(double turn, double direction[3]) {
    double angle = turn >= 1 ? 0 : 2 * acos(-1.0) * turn;
    direction[0] = -sin(angle);
    direction[1] = 0;
    direction[2] = -cos(angle);
}

static void sphere_vertex(plr_mesh *mesh, double radius, double turn, double height) {
    double latitude = acos(-1.0) * (height - 0.5);
    double ring = height <= 0 || height >= 1 ? 0 : cos(latitude);
    double normal[3], position[3];
    around(turn, normal);
    normal[0] *= ring;
    normal[1] = sin(latitude);
    normal[2] *= ring;
    for (int axis = 0; axis < 3; axis++)
        position[axis] = radius * normal[axis];
    plr_mesh_add_vertex(mesh, position, normal, turn, height);
}

bool plr_make_sphere(plr_maker *maker) {
    plr_mesh *mesh = maker->mesh;
    double radius = plr_node_number(maker->node, "radius");
    uint32_t slices = plr_mesh_subdivision(maker, "slices", PLR_MESH_SLICES, 3);
    uint32_t stacks = plr_mesh_subdivision(maker, "stacks", PLR_MESH_SLICES / 2, 2);
    plr_mesh_reserve(maker, PLR_MESH_TRIANGLES, ((size_t)slices + 1) * (stacks + 1),
                     (size_t)slices * (stacks - 1) * 6);
    for (uint32_t stack = 0; stack <= stacks; stack++)
        for (uint32_t slice = 0; slice <= slices; slice++) {
            /* at a pole each slice has its own vertex, in its middle */
            bool pole = stack % stacks == 0 && slice < slices;
            sphere_vertex(mesh, radius, (slice + (pole ? 0.5 : 0)) / slices,
                          (double)stack / stacks);
        }
    for (uint32_t stack = 0; stack < stacks; stack++)
        for (uint32_t slice = 0; slice < slices; slice++) {
            uint32_t low = stack * (slices + 1) + slice, high = low + slices + 1;
            if (stack > 0)
                plr_mesh_add_triangle(mesh, low, low + 1, high + (stack + 1 < stacks));
            if (stack + 1 < stacks)
                plr_mesh_add_triangle(mesh, low, high + 1, high);
        }
    return true;
}

/* What stands around the Y axis. */
typedef struct round_shape {
    plr_mesh *mesh;
    double bottom_radius, top_radius, height;
    uint32_t slices, stacks;
    bool side, top, bottom;
} round_shape;

/* A disc across the Y axis, upright when tilted towards the viewer: `facing` 1 up, -1 down. */
static void add_disc(const round_shape *shape, double radius, double facing) {
    plr_mesh *mesh = shape->mesh;
    double y = facing * shape->height / 2;
    const double center[3] = {0, y, 0}, normal[3] = {0, facing, 0};
    uint32_t middle = plr_mesh_add_vertex(mesh, center, normal, 0.5, 0.5);
    for (uint32_t slice = 0; slice < shape->slices; slice++) {
        double position[3];
        around((double)slice / shape->slices, position);
        double tex_s = 0.5 + position[0] / 2, tex_t = 0.5 - facing * position[2] / 2;
        position[0] *= radius;
        position[1] = y;
        position[2] *= radius;
        plr_mesh_add_vertex(mesh, position, normal, tex_s, tex_t);
    }
    for (uint32_t slice = 0; slice < shape->slices; slice++) {
        uint32_t here = middle + 1 + slice, next = middle + 1 + (slice + 1) % shape->slices;
        if (facing > 0)
            plr_mesh_add_triangle(mesh, middle, here, next);
        else
            plr_mesh_add_triangle(mesh, middle, next, here);
    }
}

static void add_side(const round_shape *shape) {
    plr_mesh *mesh = shape->mesh;
    uint32_t first = mesh->vertex_count, slices = shape->slices, stacks = shape->stacks;
    for (uint32_t stack = 0; stack <= stacks; stack++)
        for (uint32_t slice = 0; slice <= slices; slice++) {
            double t = (double)stack / stacks;
            double radius = shape->bottom_radius + (shape->top_radius - shape->bottom_radius) * t;
            bool apex = stack == stacks && shape->top_radius == 0;
            double turn = (slice + (apex && slice < slices ? 0.5 : 0)) / slices, outward[3];
            around(turn, outward);
            if (apex)
                radius = 0;
            double position[3] = {radius * outward[0], (t - 0.5) * shape->height,
                                  radius * outward[2]};
            double normal[3] = {outward[0] * shape->height,
                                shape->bottom_radius - shape->top_radius,
                                outward[2] * shape->height};
            plr_mesh_add_vertex(mesh, position, normal, turn, t);
        }
    for (uint32_t stack = 0; stack < stacks; stack++)
        for (uint32_t slice = 0; slice < slices; slice++) {
            uint32_t low = first + stack * (slices + 1) + slice, high = low + slices + 1;
            bool apex = stack + 1 == stacks && shape->top_radius == 0;
            plr_mesh_add_triangle(mesh, low, low + 1, apex ? high : high + 1);
            if (!apex)
                plr_mesh_add_triangle(mesh, low, high + 1, high);
        }
}

static bool make_round(plr_maker *maker, round_shape *shape) {
    shape->mesh = maker->mesh;
    shape->height = plr_node_number(maker->node, "height");
    shape->side = plr_node_bool(maker->node, "side");
    shape->bottom = plr_node_bool(maker->node, "bottom");
    shape->slices = plr_mesh_subdivision(maker, "slices", PLR_MESH_SLICES, 3);
    shape->stacks = plr_mesh_subdivision(maker, "stacks", 1, 1);
    size_t slices = shape->slices, stacks = shape->stacks;
    plr_mesh_reserve(maker, PLR_MESH_TRIANGLES, (slices + 1) * (stacks + 3),
                     6 * slices * (stacks + 1));
    if (shape->side)
        add_side(shape);
    if (shape->top)
        add_disc(shape, shape->top_radius, 1);
    if (shape->bottom)
        add_disc(shape, shape->bottom_radius, -1);
    return true;
}

bool plr_make_cone(plr_maker *maker) {
    round_shape shape = {.bottom_radius = plr_node_number(maker->node, "bottomRadius")};
    return make_round(maker, &shape);
}

bool plr_make_cylinder(plr_maker *maker) {
    double radius = plr_node_number(maker->node, "radius");
    round_shape shape = {
        .bottom_radius = radius, .top_radius = radius, .top = plr_node_bool(maker->node, "top")};
    return make_round(maker, &shape);
}

bool plr_make_rectangle(plr_maker *maker) {
    float size[2] = {2, 2};
    plr_node_numbers(maker->node, "size", size, 2);
    plr_mesh_reserve(maker, PLR_MESH_TRIANGLES, 4, 6);
    add_rectangle(maker->mesh, (double[]){0, 0, 0}, (double[]){(double)size[0] / 2, 0, 0},
                  (double[]){0, (double)size[1] / 2, 0}, 1);
    return true;
}
