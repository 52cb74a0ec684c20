/* The teapot that Martin Newell modelled in 1975: bicubic Bezier patches, with Frank Crow's bottom.
 * Body, rim, lid and bottom are turned around the pot's axis, so their control points are written
 * as profiles; handle and spout are written as one half, which is mirrored.
 *
 * The node comes from other X3D browsers (InstantReality, Castle Game Engine) and is placed as
 * there: the spout to +X, the lid to +Y, the middle of the bounding box at the origin; `size` 3 3 3
 * makes the longest side, along X, 3 long, and scales each axis on its own. `manifold` changes
 * nothing here: it serves shadow volumes. */
#include "engine/mesh_internal.h"

#include <math.h>
#include <string.h>

#define STEPS 16 /* cells along a side of a patch */

enum {
    PROFILES = 6,
    HALVES = 4,
    PATCHES = 4 * PROFILES + 2 * HALVES
};

/* A control point of a profile: distance from the axis, the other coordinate of the control points
 * that bend the quarter circle (0.56 radius, nearly), height. */
typedef struct turned {
    double radius, bend, height;
} turned;

static const turned profiles[PROFILES][4] = {
    {{1.4, 0.784, 2.4}, {1.3375, 0.749, 2.53125}, {1.4375, 0.805, 2.53125}, {1.5, 0.84, 2.4}},
    {{1.5, 0.84, 2.4}, {1.75, 0.98, 1.875}, {2, 1.12, 1.35}, {2, 1.12, 0.9}},
    {{2, 1.12, 0.9}, {2, 1.12, 0.45}, {1.5, 0.84, 0.225}, {1.5, 0.84, 0.15}},
    {{1.5, 0.84, 0.15}, {1.5, 0.84, 0.075}, {1.425, 0.798, 0}, {0, 0, 0}},
    {{0, 0, 3.15}, {0.8, 0.45, 3.15}, {0, 0, 2.85}, {0.2, 0.112, 2.7}},
    {{0.2, 0.112, 2.7}, {0.4, 0.224, 2.55}, {1.3, 0.728, 2.55}, {1.3, 0.728, 2.4}},
};

/* Control points {x, y, z} with y <= 0, z up: handle above and below, spout at the pot and at its
 * tip. */
static const double halves[HALVES][4][4][3] = {
    {{{-1.6, 0, 2.025}, {-1.6, -0.3, 2.025}, {-1.5, -0.3, 2.25}, {-1.5, 0, 2.25}},
     {{-2.3, 0, 2.025}, {-2.3, -0.3, 2.025}, {-2.5, -0.3, 2.25}, {-2.5, 0, 2.25}},
     {{-2.7, 0, 2.025}, {-2.7, -0.3, 2.025}, {-3, -0.3, 2.25}, {-3, 0, 2.25}},
     {{-2.7, 0, 1.8}, {-2.7, -0.3, 1.8}, {-3, -0.3, 1.8}, {-3, 0, 1.8}}},
    {{{-2.7, 0, 1.8}, {-2.7, -0.3, 1.8}, {-3, -0.3, 1.8}, {-3, 0, 1.8}},
     {{-2.7, 0, 1.575}, {-2.7, -0.3, 1.575}, {-3, -0.3, 1.35}, {-3, 0, 1.35}},
     {{-2.5, 0, 1.125}, {-2.5, -0.3, 1.125}, {-2.65, -0.3, 0.9375}, {-2.65, 0, 0.9375}},
     {{-2, 0, 0.9}, {-2, -0.3, 0.9}, {-1.9, -0.3, 0.6}, {-1.9, 0, 0.6}}},
    {{{1.7, 0, 1.425}, {1.7, -0.66, 1.425}, {1.7, -0.66, 0.6}, {1.7, 0, 0.6}},
     {{2.6, 0, 1.425}, {2.6, -0.66, 1.425}, {3.1, -0.66, 0.825}, {3.1, 0, 0.825}},
     {{2.3, 0, 2.1}, {2.3, -0.25, 2.1}, {2.4, -0.25, 2.025}, {2.4, 0, 2.025}},
     {{2.7, 0, 2.4}, {2.7, -0.25, 2.4}, {3.3, -0.25, 2.4}, {3.3, 0, 2.4}}},
    {{{2.7, 0, 2.4}, {2.7, -0.25, 2.4}, {3.3, -0.25, 2.4}, {3.3, 0, 2.4}},
     {{2.8, 0, 2.475}, {2.8, -0.25, 2.475}, {3.525, -0.25, 2.49375}, {3.525, 0, 2.49375}},
     {{2.9, 0, 2.475}, {2.9, -0.15, 2.475}, {3.45, -0.15, 2.5125}, {3.45, 0, 2.5125}},
     {{2.8, 0, 2.4}, {2.8, -0.15, 2.4}, {3.2, -0.15, 2.4}, {3.2, 0, 2.4}}},
};

/* A patch in X3D's axes: rows of control points run downward (v), columns along (u). Mirrored
 * patches turn over; `flip` says which look inward when u x v is taken. */
typedef struct patch {
    double points[4][4][3];
    bool flip;
} patch;

static void set_point(double point[3], double x, double y, double z) {
    point[0] = x;
    point[1] = z;
    point[2] = -y + 0.0; /* no -0: seams match to the bit */
}

static void turned_patch(patch *p, const turned profile[4], int x_sign, int y_sign) {
    for (int v = 0; v < 4; v++) {
        double r = profile[v].radius, bend = profile[v].bend, z = profile[v].height;
        const double x[4] = {r, r, bend, 0}, y[4] = {0, bend, r, r};
        for (int u = 0; u < 4; u++)
            set_point(p->points[v][u], x_sign * x[u] + 0.0, -y_sign * y[u], z);
    }
    p->flip = x_sign * y_sign < 0;
}

static void half_patch(patch *p, double half[4][4][3], int y_sign) {
    for (int v = 0; v < 4; v++)
        for (int u = 0; u < 4; u++)
            set_point(p->points[v][u], half[v][u][0], y_sign * half[v][u][1], half[v][u][2]);
    p->flip = y_sign < 0;
}

static void make_patch(patch *p, int number) {
    if (number < 4 * PROFILES) {
        turned_patch(p, profiles[number / 4], number & 1 ? -1 : 1, number & 2 ? -1 : 1);
    } else {
        double half[4][4][3];
        memcpy(half, halves[(number - 4 * PROFILES) / 2], sizeof half);
        half_patch(p, half, number & 1 ? -1 : 1);
    }
}

/* Bernstein polynomials of degree 3 and their derivatives. */
static void bernstein(double t, double weights[4], double slopes[4]) {
    double r = 1 - t;
    weights[0] = r * r * r;
    weights[1] = 3 * r * r * t;
    weights[2] = 3 * r * t * t;
    weights[3] = t * t * t;
    slopes[0] = -3 * r * r;
    slopes[1] = 3 * r * (r - 2 * t);
    slopes[2] = 3 * t * (2 * r - t);
    slopes[3] = 3 * t * t;
}

static void sum(const patch *p, const double along_u[4], const double along_v[4],
                double result[3]) {
    for (int axis = 0; axis < 3; axis++) {
        result[axis] = 0;
        for (int v = 0; v < 4; v++) {
            double row = 0;
            for (int u = 0; u < 4; u++)
                row += along_u[u] * p->points[v][u][axis];
            result[axis] += along_v[v] * row;
        }
    }
}

static void add_patch_vertex(plr_mesh *mesh, const patch *p, double u, double v) {
    double bu[4], du[4], bv[4], dv[4], position[3], along_u[3], along_v[3];
    bernstein(u, bu, du);
    bernstein(v, bv, dv);
    sum(p, bu, bv, position);
    sum(p, du, bv, along_u);
    sum(p, bu, dv, along_v);
    double sign = p->flip ? -1 : 1;
    double normal[3] = {(along_u[1] * along_v[2] - along_u[2] * along_v[1]) * sign,
                        (along_u[2] * along_v[0] - along_u[0] * along_v[2]) * sign,
                        (along_u[0] * along_v[1] - along_u[1] * along_v[0]) * sign};
    const double(*row)[3] = p->points[v > 0.5 ? 3 : 0];
    if ((v <= 0 || v >= 1) && memcmp(row[0], row[3], sizeof row[0]) == 0) {
        /* on the axis, where a row of the patch is one point: knob and bottom are level there */
        memcpy(position, row[0], sizeof position);
        normal[0] = normal[2] = 0;
        normal[1] = position[1] > 1 ? 1 : -1;
    }
    plr_mesh_add_vertex(mesh, position, normal, 0, 0);
}

static bool same_vertex(const plr_mesh *mesh, uint32_t a, uint32_t b) {
    return memcmp(mesh->positions + 3 * (size_t)a, mesh->positions + 3 * (size_t)b,
                  3 * sizeof(float)) == 0;
}

/* Left out where a row of the patch is one point. */
static void add_facet(plr_mesh *mesh, const patch *p, uint32_t a, uint32_t b, uint32_t c) {
    if (same_vertex(mesh, a, b) || same_vertex(mesh, b, c) || same_vertex(mesh, c, a))
        return;
    if (p->flip)
        plr_mesh_add_triangle(mesh, a, c, b);
    else
        plr_mesh_add_triangle(mesh, a, b, c);
}

static void add_patch(plr_mesh *mesh, const patch *p) {
    uint32_t first = mesh->vertex_count;
    for (int v = 0; v <= STEPS; v++)
        for (int u = 0; u <= STEPS; u++)
            add_patch_vertex(mesh, p, (double)u / STEPS, (double)v / STEPS);
    for (uint32_t v = 0; v < STEPS; v++)
        for (uint32_t u = 0; u < STEPS; u++) {
            uint32_t at = first + v * (STEPS + 1) + u, below = at + STEPS + 1;
            add_facet(mesh, p, at, at + 1, below + 1);
            add_facet(mesh, p, at, below + 1, below);
        }
}

/* To the size asked for, around the origin. Normals go with the inverse of the scale. */
static void place(plr_maker *maker) {
    plr_mesh *mesh = maker->mesh;
    float size[3] = {3, 3, 3};
    plr_node_numbers(maker->node, "size", size, 3);
    plr_mesh_find_bounds(mesh);
    double length = (double)mesh->bounds[1][0] - (double)mesh->bounds[0][0];
    double scale[3], middle[3];
    for (int axis = 0; axis < 3; axis++) {
        scale[axis] = (double)size[axis] / length;
        middle[axis] = ((double)mesh->bounds[0][axis] + (double)mesh->bounds[1][axis]) / 2;
    }
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        float *position = mesh->positions + 3 * i, *normal = mesh->normals + 3 * i;
        double n[3], square = 0;
        for (int axis = 0; axis < 3; axis++) {
            position[axis] = (float)(((double)position[axis] - middle[axis]) * scale[axis]);
            n[axis] = (double)normal[axis] / scale[axis];
            square += n[axis] * n[axis];
        }
        for (int axis = 0; axis < 3; axis++)
            normal[axis] = (float)(n[axis] / sqrt(square));
    }
}

bool plr_make_teapot(plr_maker *maker) {
    plr_mesh_reserve(maker, PLR_MESH_TRIANGLES, PATCHES * (STEPS + 1) * (STEPS + 1),
                     PATCHES * STEPS * STEPS * 6);
    for (int i = 0; i < PATCHES; i++) {
        patch p;
        make_patch(&p, i);
        add_patch(maker->mesh, &p);
    }
    place(maker);
    plr_mesh_map_plane(maker);
    return true;
}
