/* Shapes that a few numbers describe, with the exact normals of the true surface and the texture
 * mappings of ISO/IEC 19775-1 clauses 13.3 (Geometry3D) and 14.3 (Geometry2D). */
#include "engine/mesh_internal.h"

#include <math.h>
#include <string.h>

#define SLICES 96 /* around the axis */
#define STACKS 48 /* from pole to pole */

static void reserve(plr_arena *arena, plr_mesh *mesh, uint32_t vertices, uint32_t indices) {
    mesh->positions = plr_mesh_array(arena, vertices, 3 * sizeof(float));
    mesh->normals = plr_mesh_array(arena, vertices, 3 * sizeof(float));
    mesh->tex_coords[0] = plr_mesh_array(arena, vertices, 4 * sizeof(float));
    mesh->indices = plr_mesh_array(arena, indices, sizeof(uint32_t));
}

/* The normal need not have length 1. */
static uint32_t add_vertex(plr_mesh *mesh, const double position[3], const double normal[3],
                           double tex_s, double tex_t) {
    size_t i = mesh->vertex_count;
    double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (int axis = 0; axis < 3; axis++) {
        mesh->positions[3 * i + (size_t)axis] = (float)position[axis];
        mesh->normals[3 * i + (size_t)axis] =
            (float)(length > 0 ? normal[axis] / length : axis == 1);
    }
    float *tex = mesh->tex_coords[0] + 4 * i;
    tex[0] = (float)tex_s;
    tex[1] = (float)tex_t;
    tex[3] = 1;
    return mesh->vertex_count++;
}

static void add_triangle(plr_mesh *mesh, uint32_t a, uint32_t b, uint32_t c) {
    uint32_t *indices = mesh->indices + mesh->index_count;
    indices[0] = a;
    indices[1] = b;
    indices[2] = c;
    mesh->index_count += 3;
}

/* A rectangle: centre, half sides to the right and up as the texture lies, seen from their cross
 * product. */
static void add_rectangle(plr_mesh *mesh, const double center[3], const double right[3],
                          const double up[3]) {
    double normal[3] = {right[1] * up[2] - right[2] * up[1], right[2] * up[0] - right[0] * up[2],
                        right[0] * up[1] - right[1] * up[0]};
    uint32_t first = mesh->vertex_count;
    for (int i = 0; i < 4; i++) {
        double u = i == 1 || i == 2 ? 1 : -1, v = i >= 2 ? 1 : -1;
        double position[3];
        for (int axis = 0; axis < 3; axis++)
            position[axis] = center[axis] + u * right[axis] + v * up[axis];
        add_vertex(mesh, position, normal, (u + 1) / 2, (v + 1) / 2);
    }
    add_triangle(mesh, first, first + 1, first + 2);
    add_triangle(mesh, first, first + 2, first + 3);
}

static void make_box(plr_arena *arena, const plr_node *node, plr_mesh *mesh) {
    static const signed char sides[6][2][3] = {
        {{1, 0, 0}, {0, 1, 0}},  /* front: right along x, up along y */
        {{-1, 0, 0}, {0, 1, 0}}, /* back */
        {{0, 0, -1}, {0, 1, 0}}, /* right */
        {{0, 0, 1}, {0, 1, 0}},  /* left */
        {{1, 0, 0}, {0, 0, -1}}, /* top: upright when tilted towards the viewer at +Z */
        {{1, 0, 0}, {0, 0, 1}},  /* bottom */
    };
    float size[3] = {2, 2, 2};
    plr_node_numbers(node, "size", size, 3);
    reserve(arena, mesh, 24, 36);
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
        add_rectangle(mesh, center, right, up);
    }
}

/* The direction at the part `turn` (0 to 1) of the way around the Y axis: from the back (-Z)
 * counterclockwise as seen from above, over -X, front and +X. Exact at the seam. */
static void around(double turn, double direction[3]) {
    double angle = turn >= 1 ? 0 : 2 * acos(-1.0) * turn;
    direction[0] = -sin(angle);
    direction[1] = 0;
    direction[2] = -cos(angle);
}

static void sphere_vertex(plr_mesh *mesh, double radius, double turn, uint32_t stack) {
    double latitude = acos(-1.0) * ((double)stack / STACKS - 0.5);
    double ring = stack % STACKS == 0 ? 0 : cos(latitude);
    double normal[3], position[3];
    around(turn, normal);
    normal[0] *= ring;
    normal[1] = sin(latitude);
    normal[2] *= ring;
    for (int axis = 0; axis < 3; axis++)
        position[axis] = radius * normal[axis];
    add_vertex(mesh, position, normal, turn, (double)stack / STACKS);
}

static void make_sphere(plr_arena *arena, const plr_node *node, plr_mesh *mesh) {
    double radius = plr_node_number(node, "radius");
    reserve(arena, mesh, (SLICES + 1) * (STACKS + 1), SLICES * (STACKS - 1) * 6);
    for (uint32_t stack = 0; stack <= STACKS; stack++)
        for (uint32_t slice = 0; slice <= SLICES; slice++) {
            /* at a pole each slice has its own vertex, in its middle */
            bool pole = stack % STACKS == 0 && slice < SLICES;
            sphere_vertex(mesh, radius, (slice + (pole ? 0.5 : 0)) / SLICES, stack);
        }
    for (uint32_t stack = 0; stack < STACKS; stack++)
        for (uint32_t slice = 0; slice < SLICES; slice++) {
            uint32_t low = stack * (SLICES + 1) + slice, high = low + SLICES + 1;
            if (stack > 0)
                add_triangle(mesh, low, low + 1, high + (stack + 1 < STACKS));
            if (stack + 1 < STACKS)
                add_triangle(mesh, low, high + 1, high);
        }
}

/* A disc across the Y axis, upright when tilted towards the viewer: `facing` 1 up, -1 down. */
static void add_disc(plr_mesh *mesh, double radius, double y, double facing) {
    const double center[3] = {0, y, 0}, normal[3] = {0, facing, 0};
    uint32_t middle = add_vertex(mesh, center, normal, 0.5, 0.5);
    for (uint32_t slice = 0; slice < SLICES; slice++) {
        double position[3];
        around((double)slice / SLICES, position);
        double tex_s = 0.5 + position[0] / 2, tex_t = 0.5 - facing * position[2] / 2;
        position[0] *= radius;
        position[1] = y;
        position[2] *= radius;
        add_vertex(mesh, position, normal, tex_s, tex_t);
    }
    for (uint32_t slice = 0; slice < SLICES; slice++) {
        uint32_t here = middle + 1 + slice, next = middle + 1 + (slice + 1) % SLICES;
        if (facing > 0)
            add_triangle(mesh, middle, here, next);
        else
            add_triangle(mesh, middle, next, here);
    }
}

/* The side of a cone (top radius 0) or cylinder around the Y axis. */
static void add_side(plr_mesh *mesh, double bottom_radius, double top_radius, double height) {
    uint32_t first = mesh->vertex_count;
    for (uint32_t slice = 0; slice <= SLICES; slice++)
        for (int end = 0; end < 2; end++) {
            bool apex = end == 1 && top_radius == 0;
            double turn = (slice + (apex && slice < SLICES ? 0.5 : 0)) / SLICES;
            double radius = end ? top_radius : bottom_radius;
            double outward[3];
            around(turn, outward);
            double position[3] = {radius * outward[0], (end - 0.5) * height, radius * outward[2]};
            double normal[3] = {outward[0] * height, bottom_radius - top_radius,
                                outward[2] * height};
            add_vertex(mesh, position, normal, turn, end);
        }
    for (uint32_t slice = 0; slice < SLICES; slice++) {
        uint32_t low = first + 2 * slice;
        if (top_radius > 0) {
            add_triangle(mesh, low, low + 2, low + 3);
            add_triangle(mesh, low, low + 3, low + 1);
        } else {
            add_triangle(mesh, low, low + 2, low + 1);
        }
    }
}

static void make_cone(plr_arena *arena, const plr_node *node, plr_mesh *mesh) {
    double radius = plr_node_number(node, "bottomRadius"), height = plr_node_number(node, "height");
    reserve(arena, mesh, 3 * SLICES + 3, 6 * SLICES);
    if (plr_node_bool(node, "side"))
        add_side(mesh, radius, 0, height);
    if (plr_node_bool(node, "bottom"))
        add_disc(mesh, radius, -height / 2, -1);
}

static void make_cylinder(plr_arena *arena, const plr_node *node, plr_mesh *mesh) {
    double radius = plr_node_number(node, "radius"), height = plr_node_number(node, "height");
    reserve(arena, mesh, 4 * SLICES + 4, 12 * SLICES);
    if (plr_node_bool(node, "side"))
        add_side(mesh, radius, radius, height);
    if (plr_node_bool(node, "top"))
        add_disc(mesh, radius, height / 2, 1);
    if (plr_node_bool(node, "bottom"))
        add_disc(mesh, radius, -height / 2, -1);
}

static void make_rectangle(plr_arena *arena, const plr_node *node, plr_mesh *mesh) {
    float size[2] = {2, 2};
    plr_node_numbers(node, "size", size, 2);
    reserve(arena, mesh, 4, 6);
    add_rectangle(mesh, (double[]){0, 0, 0}, (double[]){(double)size[0] / 2, 0, 0},
                  (double[]){0, (double)size[1] / 2, 0});
}

static const struct {
    const char *type;
    void (*make)(plr_arena *arena, const plr_node *node, plr_mesh *mesh);
} shapes[] = {{"Box", make_box},
              {"Sphere", make_sphere},
              {"Cone", make_cone},
              {"Cylinder", make_cylinder},
              {"Rectangle2D", make_rectangle}};

bool plr_mesh_shape(plr_arena *arena, const plr_node *node, plr_mesh *mesh) {
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        if (strcmp(plr_node_type(node), shapes[i].type) == 0) {
            mesh->kind = PLR_MESH_TRIANGLES;
            shapes[i].make(arena, node, mesh);
            return true;
        }
    return false;
}
