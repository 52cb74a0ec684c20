/* Geometry nodes to triangles, lines and points, against closed forms. */
#include "tests/engine/mesh_test.h"

#define CUBE                                                                                       \
    "coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0, 0 0 1, 1 0 1, 1 1 1, 0 1 1 ] } "       \
    "coordIndex [ 3 2 1 0 -1 4 5 6 7 -1 0 1 5 4 -1 2 3 7 6 -1 1 2 6 5 -1 3 0 4 7 ] "

static void test_faces_and_crease(void) {
    fixture f = build("IndexedFaceSet { " CUBE " }");
    CHECK_INT(f.mesh.vertex_count, 24); /* flat: creaseAngle 0 */
    CHECK_INT(f.mesh.index_count, 36);
    CHECK_INT(euler_number(&f.mesh), 2);
    CHECK_NEAR(volume_of(&f.mesh), 1, 1e-6);
    CHECK(faces_outward(&f.mesh));
    finish(&f);
    f = build("IndexedFaceSet { creaseAngle 1.5 " CUBE " }");
    CHECK_INT(f.mesh.vertex_count, 24); /* a cube's angles are larger: 1.5708 */
    finish(&f);
    f = build("IndexedFaceSet { creaseAngle 1.6 " CUBE " }");
    CHECK_INT(f.mesh.vertex_count, 8);
    bool diagonal = f.built;
    for (size_t i = 0; i < (size_t)f.mesh.vertex_count * 3; i++) {
        float expected = (f.mesh.positions[i] > 0.5f ? 1.0f : -1.0f) / sqrtf(3);
        diagonal = diagonal && fabsf(f.mesh.normals[i] - expected) < 1e-6f;
    }
    CHECK(diagonal);
    finish(&f);
    f = build("IndexedFaceSet { creaseAngle 3.2 " CUBE " }");
    CHECK_INT(f.mesh.vertex_count, 8);
    finish(&f);
    /* two faces meet along one edge at 45 degrees: smooth there, and nowhere else */
    f = build(
        "IndexedFaceSet { creaseAngle 0.8 coordIndex [ 0 1 2 3 -1 1 4 5 2 ] coord Coordinate {"
        " point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0, 2 0 -1, 2 1 -1 ] } }");
    CHECK_INT(f.mesh.vertex_count, 6);
    finish(&f);
    f = build(
        "IndexedFaceSet { creaseAngle 0.7 coordIndex [ 0 1 2 3 -1 1 4 5 2 ] coord Coordinate {"
        " point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0, 2 0 -1, 2 1 -1 ] } }");
    CHECK_INT(f.mesh.vertex_count, 8);
    finish(&f);
}

static void test_clockwise(void) {
    fixture f = build("IndexedFaceSet { ccw FALSE coordIndex [ 0 1 2 ] coord Coordinate { point "
                      "[ 0 0 0, 1 0 0, 0 1 0 ] } }");
    CHECK(f.built && f.mesh.clockwise);
    CHECK_NEAR(f.mesh.normals[2], -1, 0); /* the front is where corners run clockwise */
    finish(&f);
}

/* A star of n points: outer radius 1, inner radius r. Its area is n r sin(pi / n). */
static char *star(int points, double inner, bool convex) {
    size_t size = (size_t)points * 120 + 200, used;
    char *text = malloc(size);
    used = (size_t)snprintf(text, size, "IndexedFaceSet { convex %s coord Coordinate { point [",
                            convex ? "TRUE" : "FALSE");
    for (int i = 0; i < 2 * points; i++) {
        double radius = i % 2 ? inner : 1, angle = PI * i / points;
        used += (size_t)snprintf(text + used, size - used, " %.9f 0 %.9f,", radius * sin(angle),
                                 radius * cos(angle));
    }
    used += (size_t)snprintf(text + used, size - used, "] } coordIndex [");
    for (int i = 0; i < 2 * points; i++)
        used += (size_t)snprintf(text + used, size - used, " %d", i);
    snprintf(text + used, size - used, " ] }");
    return text;
}

static void test_concave(void) {
    char *text = star(5, 0.3, false);
    fixture f = build(text);
    CHECK_INT(f.mesh.index_count, 8 * 3);
    CHECK_NEAR(area_of(&f.mesh), 5 * 0.3 * sin(PI / 5), 1e-6);
    CHECK(faces_outward(&f.mesh)); /* no triangle is turned over */
    finish(&f);
    free(text);
    text = star(20000, 0.99, false);
    f = build(text);
    CHECK_NEAR(area_of(&f.mesh), 20000 * 0.99 * sin(PI / 20000), 1e-4);
    finish(&f);
    free(text);
    /* a comb, whose teeth share one line, with corners that do not turn */
    f = build("IndexedFaceSet { convex FALSE coordIndex [ 0 1 2 3 4 5 6 7 8 9 10 11 12 ] "
              "coord Coordinate { point [ 0 0 0, 2 0 0, 5 0 0, 5 2 0, 4 2 0, 4 1 0, 3 1 0, 3 2 0, "
              "2 2 0, 2 1 0, 1 1 0, 1 2 0, 0 2 0 ] } }");
    CHECK_NEAR(area_of(&f.mesh), 8, 1e-6);
    CHECK_NEAR(volume_of(&f.mesh), 0, 1e-6);
    finish(&f);
    /* one that crosses itself, and one without area: as many triangles as ever, no crash */
    f = build(
        "IndexedFaceSet { convex FALSE coordIndex [ 0 1 2 3 4 -1 0 0 0 0 0 ] coord Coordinate "
        "{ point [ 0 1 0, -0.6 -0.8 0, 0.95 0.3 0, -0.95 0.3 0, 0.6 -0.8 0 ] } }");
    CHECK_INT(f.mesh.index_count, 18);
    finish(&f);
}

/* A long band wound around its end: no ears but at its two ends. */
static void test_spiral(void) {
    enum {
        HALF = 5000,
        COUNT = 2 * HALF
    };
    char *text = malloc(COUNT * 60 + 200);
    size_t size = COUNT * 60 + 200, used;
    used = (size_t)snprintf(text, size, "IndexedFaceSet { convex FALSE coord Coordinate { point [");
    double(*points)[2] = malloc(COUNT * sizeof *points), area = 0;
    for (int i = 0; i < COUNT; i++) {
        int step = i < HALF ? i : COUNT - 1 - i;
        double angle = step * 0.05, radius = 1 + step * 0.01 + (i < HALF ? 0 : 0.5);
        points[i][0] = radius * cos(angle);
        points[i][1] = radius * sin(angle);
        used +=
            (size_t)snprintf(text + used, size - used, " %.9f %.9f 0,", points[i][0], points[i][1]);
    }
    used += (size_t)snprintf(text + used, size - used, "] } coordIndex [");
    for (int i = 0; i < COUNT; i++)
        used += (size_t)snprintf(text + used, size - used, " %d", i);
    snprintf(text + used, size - used, " ] }");
    for (int i = 0; i < COUNT; i++)
        area += (points[i][0] * points[(i + 1) % COUNT][1] -
                 points[(i + 1) % COUNT][0] * points[i][1]) /
                2;
    fixture f = build(text);
    CHECK_NEAR(area_of(&f.mesh) / fabs(area), 1, 1e-5);
    CHECK(f.built && faces_outward(&f.mesh));
    finish(&f);
    free(points);
    free(text);
}

/* Simple polygons with random radii around a centre, in tilted planes. */
static void test_random_polygons(void) {
    uint32_t seed = 1;
    int wrong = 0;
    for (int round = 0; round < 200; round++) {
        char text[8000];
        size_t used = (size_t)snprintf(text, sizeof text,
                                       "IndexedFaceSet { convex FALSE coord Coordinate { point [");
        int count = 4 + round % 60;
        double area = 0, previous = 0, first = 0;
        double tilt = round * 0.37;
        for (int i = 0; i < count; i++) {
            seed = seed * 1664525 + 1013904223;
            double radius = 0.05 + (seed >> 16) / 65536.0, angle = 2 * PI * i / count;
            double x = radius * cos(angle), y = radius * sin(angle);
            used += (size_t)snprintf(text + used, sizeof text - used, " %.9f %.9f %.9f,", x,
                                     y * cos(tilt), y * sin(tilt));
            area += i ? previous * radius * sin(2 * PI / count) / 2 : 0;
            first = i ? first : radius;
            previous = radius;
        }
        area += previous * first * sin(2 * PI / count) / 2;
        used += (size_t)snprintf(text + used, sizeof text - used, "] } coordIndex [");
        for (int i = 0; i < count; i++)
            used += (size_t)snprintf(text + used, sizeof text - used, " %d", i);
        snprintf(text + used, sizeof text - used, " ] }");
        fixture f = build(text);
        wrong += !f.built || fabs(area_of(&f.mesh) - area) > 1e-5 || !faces_outward(&f.mesh);
        finish(&f);
    }
    CHECK_INT(wrong, 0);
}

static void test_default_mapping(void) {
    fixture f = build("IndexedFaceSet { coordIndex [ 0 1 2 3 ] coord Coordinate { point "
                      "[ 1 5 0, 3 5 0, 3 5 -8, 1 5 -8 ] } }");
    static const float up[3] = {0, 1, 0};
    const float *t = tex_at(&f.mesh, 1, 5, -8, up);
    CHECK(t[0] == 0 && t[1] == 0); /* s along z (longest), t along x */
    t = tex_at(&f.mesh, 3, 5, 0, up);
    CHECK(t[0] == 1 && t[1] == 0.25f);
    finish(&f);
    f = build("IndexedFaceSet { coordIndex [ 0 1 2 3 ] coord Coordinate { point "
              "[ 0 0 0, 2 0 0, 2 2 0, 0 2 0 ] } }");
    t = tex_at(&f.mesh, 2, 0, 0, (float[]){0, 0, 1});
    CHECK(t[0] == 1 && t[1] == 0); /* equal sides: x before y */
    finish(&f);
}

static void test_bindings(void) {
    fixture f = build(
        "IndexedFaceSet { coordIndex [ 0 1 2 -1 0 2 3 ] coord Coordinate { point [ 0 0 0, 1 0 0, 1 "
        "1 0,"
        " 0 1 0 ] } colorPerVertex FALSE colorIndex [ 1 0 ] color Color { color [ 1 0 0, 0 1 0 ] } "
        "normalPerVertex FALSE normal Normal { vector [ 0 0 2, 0 1 0 ] } "
        "texCoordIndex [ 3 2 1 -1 3 1 0 ] texCoord TextureCoordinate { point [ 0 0, .1 0, .2 0, .3 "
        "0 ] "
        "} }");
    CHECK(f.built && f.mesh.vertex_count == 6);
    if (f.built) {
        size_t a = f.mesh.indices[0], b = f.mesh.indices[3];
        CHECK(f.mesh.colors[4 * a + 1] == 1 && f.mesh.colors[4 * a + 3] == 1); /* colour 1: green */
        CHECK(f.mesh.colors[4 * b] == 1 && f.mesh.colors[4 * b + 1] == 0);
        CHECK_NEAR(f.mesh.normals[3 * a + 2], 1, 0); /* brought to length 1 */
        CHECK_NEAR(f.mesh.normals[3 * b + 1], 1, 0);
        CHECK_NEAR(f.mesh.tex_coords[0][4 * a], 0.3f, 0);
        CHECK_NEAR(f.mesh.tex_coords[0][4 * (size_t)f.mesh.indices[5]], 0, 0);
    }
    finish(&f);
    f = build(
        "IndexedFaceSet { coordIndex [ 0 1 2 ] coord CoordinateDouble { point [ 0 0 0, 1 0 0, 0 1 "
        "0 ] } color ColorRGBA { color [ 1 0 0 .5, 0 1 0 1, 0 0 1 0 ] } texCoord "
        "TextureCoordinate4D { point [ 1 2 3 4, 0 0 0 1, 0 0 0 1 ] } attrib [ "
        "FloatVertexAttribute { name \"heat\" numComponents 2 value [ 1 2 3 4 5 6 ] } ] }");
    CHECK(f.built && f.mesh.vertex_count == 3);
    CHECK(f.built && f.mesh.colors[3] == 0.5f && f.mesh.colors[11] == 0);
    CHECK(f.built && f.mesh.tex_coords[0][3] == 4);
    CHECK(f.built && f.mesh.attribute_count == 1 && f.mesh.attributes[0].components == 2);
    CHECK(f.built && strcmp(f.mesh.attributes[0].name, "heat") == 0 &&
          f.mesh.attributes[0].values[5] == 6);
    finish(&f);
}

static void test_matrix_attributes(void) {
    fixture f =
        build("PointSet { coord Coordinate { point [ 0 0 0, 1 1 1 ] } attrib [ "
              "Matrix3VertexAttribute { name \"turn\" value [ 1 0 0 0 1 0 0 0 1, 1 2 3 4 5 6 "
              "7 8 9 ] } FloatVertexAttribute { name \"few\" numComponents 3 value [ 1 2 3 ] "
              "} FloatVertexAttribute { value [ 1 2 3 4 5 6 7 8 ] } ] }");
    CHECK(f.built && f.mesh.attribute_count == 1);
    static const float expected[9] = {1, 4, 7, 2, 5, 8, 3, 6, 9}; /* by columns */
    CHECK(f.built && f.mesh.attributes[0].components == 9 &&
          memcmp(f.mesh.attributes[0].values + 9, expected, sizeof expected) == 0);
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 2); /* too few values; no name */
    finish(&f);
}

static void test_triangle_nodes(void) {
    static const char *const square = "coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0, 1 1 0 ] }";
    static const struct {
        const char *before;
        double area;
        unsigned vertices;
    } cases[] = {
        {"IndexedTriangleSet { index [ 0 1 2 2 1 3 ] ", 1, 4},
        {"IndexedTriangleStripSet { index [ 0 1 2 3 -1 ] ", 1, 4},
        {"IndexedTriangleFanSet { index [ 0 1 3 2 ] ", 1, 4},
        {"IndexedQuadSet { index [ 0 1 3 2 ] ", 1, 4},
        {"TriangleStripSet { stripCount [ 4 ] ", 1, 4},
        {"TriangleFanSet { fanCount [ 3 ] ", 0.5, 3},
        {"TriangleSet { ", 0.5, 3},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[300];
        snprintf(text, sizeof text, "%s %s }", cases[i].before, square);
        fixture f = build(text);
        CHECK_NEAR(area_of(&f.mesh), cases[i].area, 1e-6);
        CHECK_INT(f.mesh.vertex_count, cases[i].vertices);
        CHECK(f.built && faces_outward(&f.mesh) && f.mesh.normals[2] == 1);
        finish(&f);
    }
    fixture f = build("QuadSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } }");
    CHECK_NEAR(area_of(&f.mesh), 1, 1e-6);
    finish(&f);
    f = build("Rectangle2D { size 4 6 }");
    CHECK_NEAR(area_of(&f.mesh), 24, 1e-6);
    CHECK(f.built && f.mesh.two_sided && f.mesh.normals[2] == 1);
    finish(&f);
}

static void test_lines_and_points(void) {
    fixture f =
        build("IndexedLineSet { coordIndex [ 0 1 2 -1 2 0 ] colorPerVertex FALSE color Color { "
              "color [ 1 0 0, 0 0 1 ] } coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } }");
    CHECK(f.built && f.mesh.kind == PLR_MESH_LINES);
    CHECK_INT(f.mesh.index_count, 6);
    CHECK_INT(f.mesh.vertex_count, 5); /* each line has its own colour */
    CHECK(!f.mesh.normals && !f.mesh.tex_coords[0]);
    finish(&f);
    f = build(
        "LineSet { vertexCount [ 2 3 ] coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0, 0 2 0, 5 5 "
        "5 ] } }");
    CHECK_INT(f.mesh.index_count, 6);
    CHECK_NEAR(f.mesh.bounds[1][2], 5, 0);
    finish(&f);
    f = build(
        "PointSet { coord Coordinate { point [ 0 0 0, 1 2 3 ] } color Color { color [ 1 0 0, 0 1 0 "
        "] } }");
    CHECK(f.built && f.mesh.kind == PLR_MESH_POINTS && f.mesh.vertex_count == 2);
    CHECK(f.built && f.mesh.colors[5] == 1);
    finish(&f);
}

static void test_elevation(void) {
    fixture f =
        build("ElevationGrid { xDimension 3 zDimension 2 xSpacing 2 zSpacing 5 height [ 0 1 2 0 1 "
              "2 ] creaseAngle 1 }");
    CHECK_NEAR(area_of(&f.mesh), 4 * 5 * sqrt(1.25), 1e-5);
    CHECK_INT(f.mesh.vertex_count, 6);
    CHECK(f.built && faces_outward(&f.mesh) && f.mesh.normals[1] > 0);
    const float *t = tex_at(&f.mesh, 2, 1, 5, (float[]){0, 1, 0});
    CHECK(t[0] == 0.5f && t[1] == 1);
    CHECK_NEAR(f.mesh.normals[0], -1 / sqrt(5), 1e-6);
    finish(&f);
    f = build("ElevationGrid { xDimension 2147483647 zDimension 2147483647 height [ 0 1 ] }");
    CHECK(!f.built);
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    finish(&f);
}

static void test_hostile(void) {
    fixture f = build(
        "IndexedFaceSet {\n coordIndex [ 0 1 2 -1 0 1 99 -1 2 1 -7 -1 0 2147483647 1 ]\n coord "
        "Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } }");
    CHECK_INT(f.mesh.index_count, 3); /* the sound face stays */
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    for (size_t i = 0; i < plr_diags_count(f.diags); i++)
        if (plr_diags_get(f.diags, i)->code == PLR_CODE_BAD_GEOMETRY) {
            CHECK_INT(plr_diags_get(f.diags, i)->place.line, 4); /* where coordIndex stands */
            CHECK_STR(plr_diags_get(f.diags, i)->message,
                      "there is no point 99, only 0 to 2; 3 faces are left out");
        }
    finish(&f);
    f = build("IndexedFaceSet { coordIndex [ 0 1 2 ] }");
    CHECK(!f.built);
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    finish(&f);
    f = build(
        "IndexedFaceSet { coordIndex [ 0 1 2 ] coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } "
        "color Color { color [ 1 0 0 ] } }");
    CHECK(!f.built); /* too few colours */
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    finish(&f);
    f = build("IndexedFaceSet { coordIndex [ -1 -1 0 1 -1 0 1 2 -1 -1 ] coord Coordinate { point [ "
              "0 0 0, 1 "
              "0 0, 0 1 0 ] } }");
    CHECK_INT(f.mesh.index_count, 3);
    CHECK_INT(plr_diags_count_of(f.diags, PLR_ERROR), 0);
    finish(&f);
    f = build("TriangleFanSet { fanCount [ 3 2000000000 3 ] coord Coordinate { point [ 0 0 0, 1 0 "
              "0, 0 1 0, "
              "0 0 1 ] } }");
    CHECK_INT(f.mesh.index_count, 3);
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    finish(&f);
    f = build("IndexedFaceSet { coordIndex [ 0 0 0 ] coord Coordinate { point [ 1 1 1 ] } }");
    CHECK(f.built && f.mesh.normals[2] == 1); /* no area: no NaN */
    finish(&f);
    f = build("NurbsPatchSurface { }");
    CHECK(!f.built);
    CHECK_INT(count_code(&f, PLR_CODE_NOT_DRAWN), 1);
    finish(&f);
}

int main(void) {
    test_faces_and_crease();
    test_clockwise();
    test_concave();
    test_spiral();
    test_random_polygons();
    test_default_mapping();
    test_bindings();
    test_matrix_attributes();
    test_triangle_nodes();
    test_lines_and_points();
    test_elevation();
    test_hostile();
    return tap_done();
}
