/* Shapes that a few numbers describe, against closed forms. */
#include "tests/engine/mesh_test.h"

static void test_box(void) {
    fixture f = build("Box { size 1 2 3 }");
    CHECK(f.built && f.mesh.kind == PLR_MESH_TRIANGLES && !f.mesh.two_sided);
    CHECK_INT(f.mesh.vertex_count, 24);
    CHECK_INT(euler_number(&f.mesh), 2);
    CHECK_NEAR(area_of(&f.mesh), 22, 1e-6);
    CHECK_NEAR(volume_of(&f.mesh), 6, 1e-6);
    CHECK(faces_outward(&f.mesh));
    CHECK_NEAR(f.mesh.bounds[0][2], -1.5, 0);
    CHECK_NEAR(f.mesh.bounds[1][1], 1, 0);
    const float *t = tex_at(&f.mesh, 0.5f, -1, 1.5f, (float[]){0, 0, 1});
    CHECK(t[0] == 1 && t[1] == 0 && t[3] == 1); /* front, lower right */
    t = tex_at(&f.mesh, 0.5f, -1, -1.5f, (float[]){0, 0, -1});
    CHECK(t[0] == 0 && t[1] == 0); /* back, lower left as seen from behind */
    t = tex_at(&f.mesh, -0.5f, 1, 1.5f, (float[]){0, 1, 0});
    CHECK(t[0] == 0 && t[1] == 0); /* top: bottom of the texture at the front */
    t = tex_at(&f.mesh, -0.5f, -1, -1.5f, (float[]){0, -1, 0});
    CHECK(t[0] == 0 && t[1] == 0); /* bottom: at the back */
    finish(&f);
    f = build("Box { solid FALSE }");
    CHECK(f.built && f.mesh.two_sided);
    finish(&f);
}

static void of_sphere(const float *position, double normal[3]) {
    for (int i = 0; i < 3; i++)
        normal[i] = (double)position[i] / 2;
}

static void test_sphere(void) {
    fixture f = build("Sphere { radius 2 }");
    CHECK_INT(euler_number(&f.mesh), 2);
    CHECK_NEAR(volume_of(&f.mesh), 32 * PI / 3, 0.1);
    CHECK_NEAR(area_of(&f.mesh), 16 * PI, 0.1);
    CHECK(volume_of(&f.mesh) < 32 * PI / 3); /* inscribed */
    CHECK_NEAR(normal_error(&f.mesh, of_sphere), 0, 1e-6);
    CHECK(faces_outward(&f.mesh));
    static const float front[3] = {0, 0, 1}, left[3] = {-1, 0, 0};
    const float *t = tex_at(&f.mesh, 0, 0, 2, front);
    CHECK_NEAR(t[0], 0.5, 1e-6);
    CHECK_NEAR(t[1], 0.5, 1e-6);
    t = tex_at(&f.mesh, -2, 0, 0, left);
    CHECK_NEAR(t[0], 0.25, 1e-6); /* from the back counterclockwise as seen from above */
    t = tex_at(&f.mesh, 0, 2, 0, left);
    CHECK_NEAR(t[1], 1, 0);
    finish(&f);
}

static void test_cone_and_cylinder(void) {
    fixture f = build("Cone { bottomRadius 1 height 3 }");
    CHECK_INT(euler_number(&f.mesh), 2);
    CHECK_NEAR(volume_of(&f.mesh), PI, 0.01);
    CHECK_NEAR(area_of(&f.mesh), PI * sqrt(10) + PI, 0.02);
    CHECK(faces_outward(&f.mesh));
    const float *n = f.mesh.normals; /* the side comes first: its lower vertex at the back */
    CHECK_NEAR(n[1], 1 / sqrt(10), 1e-6);
    CHECK_NEAR(n[2], -3 / sqrt(10), 1e-6);
    finish(&f);

    f = build("Cylinder { radius 2 height 0.5 }");
    CHECK_INT(euler_number(&f.mesh), 2);
    CHECK_NEAR(volume_of(&f.mesh), 2 * PI, 0.01);
    CHECK(faces_outward(&f.mesh));
    const float *t = tex_at(&f.mesh, 0, 0.25f, 2, (float[]){0, 1, 0});
    CHECK(fabsf(t[0] - 0.5f) < 1e-6f && fabsf(t[1]) < 1e-6f); /* top: its bottom at the front */
    t = tex_at(&f.mesh, 0, -0.25f, 2, (float[]){0, -1, 0});
    CHECK(fabsf(t[0] - 0.5f) < 1e-6f && fabsf(t[1] - 1) < 1e-6f); /* bottom: its top at the front */
    finish(&f);

    f = build("Cylinder { side FALSE top FALSE }");
    CHECK(f.built);
    CHECK_NEAR(area_of(&f.mesh), PI, 0.01);
    finish(&f);
    f = build("Cone { side FALSE bottom FALSE }");
    CHECK(!f.built && !plr_diags_count_of(f.diags, PLR_ERROR));
    finish(&f);
}

static void test_subdivision(void) {
    fixture f = build("Sphere { slices 4 stacks 2 }"); /* an octahedron */
    CHECK_INT(f.mesh.index_count, 8 * 3);
    CHECK_NEAR(volume_of(&f.mesh), 4.0 / 3, 1e-6);
    finish(&f);
    f = build("Cylinder { slices 6 stacks 5 height 3 }");
    CHECK_INT(f.mesh.index_count, (6 * 5 * 2 + 2 * 6) * 3);
    CHECK_NEAR(volume_of(&f.mesh), 3 * 1.5 * sqrt(3), 1e-5);
    CHECK_INT(euler_number(&f.mesh), 2);
    const float *t = tex_at(&f.mesh, 0, -0.3f, -1, (float[]){0, 0, -1});
    CHECK_NEAR(t[1], 0.4, 1e-6);
    finish(&f);
    f = build("Cone { slices 4 stacks 2 height 3 bottom FALSE }");
    CHECK_INT(f.mesh.index_count, (4 * 2 + 4) * 3);
    CHECK_NEAR(area_of(&f.mesh), 4 * 0.5 * sqrt(2) * sqrt(9.5), 1e-5);
    CHECK(faces_outward(&f.mesh));
    finish(&f);
    f = build("Box { divisions 2 size 1 2 3 }");
    CHECK_INT(f.mesh.index_count, 6 * 9 * 6);
    CHECK_NEAR(volume_of(&f.mesh), 6, 1e-5);
    CHECK_INT(euler_number(&f.mesh), 2);
    finish(&f);
    f = build("Sphere { slices 100000 stacks 0 }");
    CHECK(f.built);
    CHECK_INT(f.mesh.index_count, 1024 * 6); /* two stacks at least */
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    CHECK_INT(plr_diags_count_of(f.diags, PLR_ERROR), 0);
    finish(&f);
}

/* A box that is seen from inside. */
static void test_clockwise_box(void) {
    fixture f = build("Box { ccw FALSE }");
    CHECK(f.built && f.mesh.clockwise);
    double worst = -2;
    for (size_t i = 0; f.built && i < f.mesh.vertex_count; i++) {
        const float *n = f.mesh.normals + 3 * i, *p = f.mesh.positions + 3 * i;
        worst = fmax(worst, (double)(n[0] * p[0] + n[1] * p[1] + n[2] * p[2]));
    }
    CHECK_NEAR(worst, -1, 0);
    finish(&f);
}

static void test_lines_of_flat_shapes(void) {
    fixture f = build("Circle2D { radius 2 }");
    CHECK(f.built && f.mesh.kind == PLR_MESH_LINES && !f.mesh.normals && !f.mesh.tex_coords[0]);
    CHECK_INT(f.mesh.index_count, 96 * 2);
    double length = (double)f.mesh.line_distances[f.mesh.vertex_count - 1];
    CHECK_NEAR(length, 4 * PI, 1e-2);
    CHECK(length < 4 * PI);
    CHECK(memcmp(f.mesh.positions, f.mesh.positions + 96 * 3, 12) == 0); /* closed */
    finish(&f);
    f = build("Arc2D { startAngle 1.570796327 endAngle 0 radius 3 }"); /* three quarters */
    CHECK_INT(f.mesh.index_count, 72 * 2);
    CHECK_NEAR(f.mesh.positions[1], 3, 1e-6);
    CHECK_NEAR(f.mesh.bounds[0][0], -3, 1e-6);
    CHECK_NEAR(f.mesh.positions[3 * 72], 3, 1e-6);
    finish(&f);
    f = build("Arc2D { startAngle 1 endAngle 1 }");
    CHECK_INT(f.mesh.index_count, 96 * 2);
    finish(&f);
    f = build("Polyline2D { lineSegments [ 0 0, 3 4, 3 5 ] }");
    CHECK_INT(f.mesh.index_count, 4);
    CHECK_NEAR(f.mesh.line_distances[1], 5, 0);
    CHECK_NEAR(f.mesh.line_distances[2], 6, 0);
    finish(&f);
    f = build("Polyline2D { lineSegments [ 0 0 ] }");
    CHECK(!f.built && !plr_diags_count_of(f.diags, PLR_ERROR));
    finish(&f);
    f = build("Polypoint2D { point [ 1 2, 3 4 ] }");
    CHECK(f.built && f.mesh.kind == PLR_MESH_POINTS && f.mesh.vertex_count == 2);
    CHECK(f.built && f.mesh.positions[4] == 4 && f.mesh.positions[5] == 0);
    finish(&f);
}

static void test_flat_areas(void) {
    fixture f = build("Disk2D { outerRadius 2 innerRadius 1 }");
    CHECK(f.built && f.mesh.two_sided && faces_outward(&f.mesh));
    CHECK_NEAR(area_of(&f.mesh), 3 * PI, 1e-2);
    CHECK_INT(euler_number(&f.mesh), 0); /* a ring */
    const float *t = tex_at(&f.mesh, 1, 0, 0, (float[]){0, 0, 1});
    CHECK_NEAR(t[0], 0.75, 1e-6);
    CHECK_NEAR(t[1], 0.5, 1e-6);
    finish(&f);
    f = build("Disk2D { }");
    CHECK_NEAR(area_of(&f.mesh), PI, 1e-2);
    CHECK(f.built && f.mesh.normals[2] == 1);
    finish(&f);
    f = build("Disk2D { innerRadius 1 }");
    CHECK(f.built && f.mesh.kind == PLR_MESH_LINES);
    finish(&f);
    f = build("Disk2D { innerRadius 2 }");
    CHECK(!f.built);
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    finish(&f);
    f = build("ArcClose2D { radius 2 }"); /* a quarter */
    CHECK_NEAR(area_of(&f.mesh), PI, 1e-2);
    CHECK(faces_outward(&f.mesh));
    finish(&f);
    f = build("ArcClose2D { closureType \"CHORD\" radius 2 }");
    CHECK_NEAR(area_of(&f.mesh), PI - 2, 1e-2);
    finish(&f);
    f = build("ArcClose2D { closureType \"CHORD\" endAngle 0 }"); /* a circle */
    CHECK_NEAR(area_of(&f.mesh), PI, 1e-2);
    finish(&f);
    f = build("TriangleSet2D { vertices [ 0 0, 4 0, 0 2, 0 0, 0 -1, 1 0, 7 7 ] }");
    CHECK_INT(f.mesh.index_count, 6);
    CHECK_NEAR(area_of(&f.mesh), 4.5, 1e-6);
    CHECK(f.built && faces_outward(&f.mesh));
    t = tex_at(&f.mesh, 0, 2, 0, (float[]){0, 0, 1});
    CHECK(t[0] == 0 && t[1] == 0.75f); /* s along x, the longer side */
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    finish(&f);
    f = build("Plane { size 4 6 }");
    CHECK_NEAR(area_of(&f.mesh), 24, 1e-6);
    CHECK(f.built && !f.mesh.two_sided && f.mesh.normals[2] == 1);
    finish(&f);
}

/* The point of the mesh at these coordinates is there once with z and once with -z. */
static bool mirrors(const plr_mesh *mesh) {
    size_t n = mesh->vertex_count, unmatched = 0;
    float *sorted = malloc(n * 12);
    for (size_t i = 0; i < n * 3; i++)
        sorted[i] = mesh->positions[i] + 0.0f;
    qsort(sorted, n, 12, compare_points);
    for (size_t i = 0; i < n; i++) {
        float mirrored[3] = {mesh->positions[3 * i] + 0.0f, mesh->positions[3 * i + 1] + 0.0f,
                             -mesh->positions[3 * i + 2] + 0.0f};
        unmatched += !bsearch(mirrored, sorted, n, 12, compare_points);
    }
    free(sorted);
    return unmatched == 0;
}

/* How far from the plane z = 0 the mesh gets between two heights. */
static double depth_at(const plr_mesh *mesh, float low, float high) {
    double widest = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->positions + 3 * i;
        if (p[1] > low && p[1] < high)
            widest = fmax(widest, fabs((double)p[2]));
    }
    return widest;
}

static void test_teapot(void) {
    fixture f = build("Teapot { }");
    CHECK(f.built && !f.mesh.two_sided);
    CHECK_NEAR(f.mesh.bounds[1][0], 1.5, 1e-6);
    CHECK_NEAR(f.mesh.bounds[0][0], -1.5, 1e-6);
    /* in Newell's measures: 3.15 high, 4 deep; the same scale on all axes */
    double height = (double)f.mesh.bounds[1][1] - (double)f.mesh.bounds[0][1];
    double depth = (double)f.mesh.bounds[1][2] - (double)f.mesh.bounds[0][2];
    CHECK_NEAR(height / depth, 3.15 / 4, 1e-6);
    CHECK_NEAR(f.mesh.bounds[0][1] + f.mesh.bounds[1][1], 0, 1e-6);
    CHECK_NEAR(height, 1.4714, 5e-3); /* as the node's other browsers draw it */
    CHECK(mirrors(&f.mesh));
    CHECK(faces_outward(&f.mesh));
    /* Four parts: lid and pot are discs (1 each), handle and spout are tubes (0), and the handle's
     * end stands on one point of the pot (-1). An open seam would count less. */
    CHECK_INT(euler_number(&f.mesh), 1);
    CHECK_NEAR(depth_at(&f.mesh, -0.35f, -0.25f), depth / 2, 1e-6);
    /* the spout at +X is higher than the middle, the handle at -X has its grip outside */
    size_t up = 0, out = 0;
    for (size_t i = 0; i < f.mesh.vertex_count; i++) {
        const float *p = f.mesh.positions + 3 * i, *n = f.mesh.normals + 3 * i;
        up += p[0] > 1.4f && p[1] < 0;
        out += p[0] < -1.499f && n[0] > -0.9f;
    }
    CHECK_INT(up, 0);
    CHECK_INT(out, 0);
    CHECK(f.built && !f.mesh.tex_coords_given);
    finish(&f);
    f = build("Teapot { size 3 6 3 texCoord TextureCoordinateGenerator { } }");
    CHECK(f.built && f.mesh.tex_coords_given && f.mesh.tex_coords[0]);
    CHECK_NEAR(f.mesh.bounds[1][1], 1.4714, 5e-3);
    CHECK(faces_outward(&f.mesh));
    finish(&f);
}

int main(void) {
    test_box();
    test_sphere();
    test_cone_and_cylinder();
    test_subdivision();
    test_clockwise_box();
    test_lines_of_flat_shapes();
    test_flat_areas();
    test_teapot();
    return tap_done();
}
