/* What the tests of meshes share: building one geometry node, and measuring the result. */
#ifndef PLR_TESTS_MESH_TEST_H
#define PLR_TESTS_MESH_TEST_H

#include "engine/mesh_internal.h"
#include "tests/tap.h"

#define PI 3.14159265358979323846

typedef struct fixture {
    plr_diags *diags;
    plr_scene *scene;
    plr_mesh mesh;
    bool built;
} fixture;

/* The mesh of one geometry node, written in Classic VRML. */
static inline fixture build(const char *geometry) {
    fixture f = {.diags = plr_diags_create(NULL)};
    size_t size = strlen(geometry) + 100;
    char *text = malloc(size);
    snprintf(text, size, "#X3D V4.0 utf8\nPROFILE Full\nShape { geometry %s\n}\n", geometry);
    f.scene = plr_scene_parse(text, strlen(text), "test.x3dv", NULL, f.diags);
    free(text);
    plr_node *node = f.scene ? plr_node_child(plr_scene_root(f.scene, 0), "geometry") : NULL;
    f.built = node && plr_mesh_build(node, &f.mesh, f.diags);
    return f;
}

static inline void finish(fixture *f) {
    plr_mesh_free(&f->mesh);
    plr_scene_destroy(&f->scene);
    plr_diags_destroy(&f->diags);
}

static inline size_t count_code(const fixture *f, plr_code code) {
    size_t count = 0;
    for (size_t i = 0; i < plr_diags_count(f->diags); i++)
        count += plr_diags_get(f->diags, i)->code == code;
    return count;
}

static inline const float *vertex(const plr_mesh *mesh, size_t index) {
    return mesh->positions + 3 * (size_t)mesh->indices[index];
}

static inline void cross_of(const plr_mesh *mesh, size_t triangle, double cross[3]) {
    const float *a = vertex(mesh, triangle * 3), *b = vertex(mesh, triangle * 3 + 1),
                *c = vertex(mesh, triangle * 3 + 2);
    double u[3], v[3];
    for (int i = 0; i < 3; i++) {
        u[i] = (double)b[i] - (double)a[i];
        v[i] = (double)c[i] - (double)a[i];
    }
    cross[0] = u[1] * v[2] - u[2] * v[1];
    cross[1] = u[2] * v[0] - u[0] * v[2];
    cross[2] = u[0] * v[1] - u[1] * v[0];
}

static inline double area_of(const plr_mesh *mesh) {
    double area = 0;
    for (size_t t = 0; t < mesh->index_count / 3; t++) {
        double n[3];
        cross_of(mesh, t, n);
        area += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
    }
    return area;
}

/* Signed: positive where triangles run counterclockwise as seen from outside. */
static inline double volume_of(const plr_mesh *mesh) {
    double volume = 0;
    for (size_t t = 0; t < mesh->index_count / 3; t++) {
        double n[3];
        cross_of(mesh, t, n);
        const float *a = vertex(mesh, t * 3);
        volume += ((double)a[0] * n[0] + (double)a[1] * n[1] + (double)a[2] * n[2]) / 6;
    }
    return volume;
}

static inline int compare_points(const void *a, const void *b) {
    return memcmp(a, b, 12);
}
static inline int compare_edges(const void *a, const void *b) {
    return memcmp(a, b, 8);
}

static inline uint32_t rank_of(const float *points, size_t count, const float *point) {
    return (uint32_t)((const float *)bsearch(point, points, count, 12, compare_points) - points) /
           3;
}

/* Vertices - edges + faces, equal positions counted once: 2 for what is closed like a sphere. */
static inline long euler_number(const plr_mesh *mesh) {
    size_t n = mesh->vertex_count, edge_count = 0, faces = 0, points = 0, edges = 0;
    float *sorted = malloc(n * 12);
    for (size_t i = 0; i < n * 3; i++)
        sorted[i] = mesh->positions[i] + 0.0f; /* no -0 */
    float *lookup = malloc(n * 12);
    memcpy(lookup, sorted, n * 12);
    qsort(sorted, n, 12, compare_points);
    for (size_t i = 0; i < n; i++)
        if (!i || memcmp(sorted + 3 * i, sorted + 3 * (points - 1), 12) != 0)
            memmove(sorted + 3 * points++, sorted + 3 * i, 12);
    uint32_t(*pairs)[2] = malloc(mesh->index_count * sizeof *pairs);
    for (size_t t = 0; t < mesh->index_count; t += 3, faces++)
        for (size_t i = 0; i < 3; i++) {
            uint32_t a = rank_of(sorted, points, lookup + 3 * mesh->indices[t + i]);
            uint32_t b = rank_of(sorted, points, lookup + 3 * mesh->indices[t + (i + 1) % 3]);
            pairs[edge_count][0] = a < b ? a : b;
            pairs[edge_count++][1] = a < b ? b : a;
        }
    qsort(pairs, edge_count, 8, compare_edges);
    for (size_t i = 0; i < edge_count; i++)
        edges += !i || memcmp(pairs[i], pairs[i - 1], 8) != 0;
    free(sorted);
    free(lookup);
    free(pairs);
    return (long)points - (long)edges + (long)faces;
}

/* The largest angle (its sine) between normals and what `expected` says. */
static inline double normal_error(const plr_mesh *mesh,
                                  void (*expected)(const float *position, double normal[3])) {
    double worst = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        double n[3];
        expected(mesh->positions + 3 * i, n);
        for (int axis = 0; axis < 3; axis++)
            worst = fmax(worst, fabs((double)mesh->normals[3 * i + (size_t)axis] - n[axis]));
    }
    return worst;
}

/* Every triangle faces the way its normals do. */
static inline bool faces_outward(const plr_mesh *mesh) {
    for (size_t t = 0; t < mesh->index_count / 3; t++) {
        double n[3];
        cross_of(mesh, t, n);
        for (size_t i = 0; i < 3; i++) {
            const float *normal = mesh->normals + 3 * (size_t)mesh->indices[3 * t + i];
            if (!((double)normal[0] * n[0] + (double)normal[1] * n[1] + (double)normal[2] * n[2] >
                  0))
                return false;
        }
    }
    return true;
}

/* The texture coordinates at the vertex at this position whose normal looks most along `normal`. */
static inline const float *tex_at(const plr_mesh *mesh, float x, float y, float z,
                                  const float normal[3]) {
    const float *found = NULL;
    float best = -2;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->positions + 3 * i, *n = mesh->normals + 3 * i;
        float along = n[0] * normal[0] + n[1] * normal[1] + n[2] * normal[2];
        if (fabsf(p[0] - x) + fabsf(p[1] - y) + fabsf(p[2] - z) < 1e-5f && along > best + 1e-6f) {
            best = along;
            found = mesh->tex_coords[0] + 4 * i;
        }
    }
    static const float none[4] = {-9, -9, -9, -9};
    return found ? found : none;
}

#endif
