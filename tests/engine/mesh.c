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

/* Smooth normals do not depend on how flat sides are cut. */
static void test_cut_sides(void) {
    fixture f = build("IndexedFaceSet { creaseAngle 3 coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 "
                      "0, 0 1 0, 0 0 1, 1 "
                      "0 1, 1 1 1, 0 1 1 ] } coordIndex [ 3 2 1 -1 3 1 0 -1 4 5 6 -1 4 6 7 -1 0 1 "
                      "5 4 -1 2 3 7 -1 2 "
                      "7 6 -1 1 2 6 5 -1 3 0 4 7 ] }");
    CHECK_INT(f.mesh.vertex_count, 8);
    double worst = 0;
    for (size_t i = 0; f.built && i < (size_t)f.mesh.vertex_count * 3; i++) {
        double expected = (f.mesh.positions[i] > 0.5f ? 1 : -1) / sqrt(3);
        worst = fmax(worst, fabs((double)f.mesh.normals[i] - expected));
    }
    CHECK_NEAR(worst, 0, 1e-6);
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

/* Units of MultiTextureCoordinate: lists of their own, generated ones, and none. */
static void test_texture_units(void) {
    fixture f =
        build("IndexedTriangleSet { index [ 0 1 2 ] coord Coordinate { point [ 0 0 0, 4 0 0, 0 "
              "2 0 ] } texCoord MultiTextureCoordinate { texCoord [ TextureCoordinate { point "
              "[ .1 .2, 0 0, 0 0 ] } TextureCoordinateGenerator { } TextureCoordinate3D { "
              "point [ 1 2 3, 0 0 0, 0 0 0 ] } ] } }");
    CHECK(f.built && f.mesh.tex_coords_given);
    const float *unit = plr_mesh_tex_coords(&f.mesh, 0);
    CHECK(unit && unit[0] == 0.1f && unit[1] == 0.2f && unit[3] == 1);
    unit = plr_mesh_tex_coords(&f.mesh, 1); /* by the bounding box until it is generated */
    CHECK(unit && unit[4] == 1 && unit[9] == 0.5f);
    unit = plr_mesh_tex_coords(&f.mesh, 2);
    CHECK(unit && unit[2] == 3);
    CHECK(f.built && !f.mesh.tex_coords[3]);
    CHECK(plr_mesh_tex_coords(&f.mesh, 3) == unit); /* the last is replicated */
    CHECK(plr_mesh_tex_coords(&f.mesh, 400) == unit);
    finish(&f);
    f = build(
        "IndexedFaceSet { coordIndex [ 0 1 2 ] texCoordIndex [ 2 1 0 ] coord Coordinate { point "
        "[ 0 0 0, 4 0 0, 0 2 0 ] } texCoord MultiTextureCoordinate { texCoord [ "
        "TextureCoordinate { point [ 1 0, 2 0, 3 0 ] } TextureCoordinate { point [ 4 0, 5 0, 6 "
        "0 ] } ] } }");
    CHECK(f.built && f.mesh.tex_coords[0][0] == 3 && f.mesh.tex_coords[1][0] == 6);
    finish(&f);
    f = build(
        "IndexedTriangleSet { index [ 0 1 2 ] coord Coordinate { point [ 0 0 0, 4 0 0, 0 2 0 ] } "
        "}");
    CHECK(f.built && !f.mesh.tex_coords_given && f.mesh.tex_coords[0][4] == 1);
    finish(&f);
    char text[2000] = "TriangleSet { coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } texCoord "
                      "MultiTextureCoordinate { texCoord [";
    for (int i = 0; i < 20; i++) /* more than there are units */
        strcat(text, " TextureCoordinate { point [ 1 0, 2 0, 3 0 ] }");
    strcat(text, " ] } }");
    f = build(text);
    CHECK(f.built && f.mesh.tex_coords[PLR_MESH_TEX_UNITS - 1]);
    finish(&f);
    f = build("TriangleSet { coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } texCoord "
              "MultiTextureCoordinate { texCoord [ TextureCoordinate { point [ 1 0, 2 0, 3 0 ] } "
              "TextureCoordinate { point [ 1 0 ] } ] } }");
    CHECK(f.built && f.mesh.tex_coords[0][8] == 3 && f.mesh.tex_coords[1][0] == 1);
    CHECK(f.built && f.mesh.tex_coords[1][8] == 0 && f.mesh.tex_coords[1][11] == 1);
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    finish(&f);
}

static void test_box_mapping(void) {
    fixture f =
        build("IndexedFaceSet { coordIndex [ 0 1 2 ] coord Coordinate { point [ 1 2 3, 5 2 3, 1 "
              "12 -5 ] } }");
    const float *box = f.built ? plr_mesh_box_coords(&f.mesh) : NULL;
    static const float expected[12] = {0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 1, 1};
    CHECK(box && memcmp(box, expected, sizeof expected) == 0);
    CHECK(f.built && plr_mesh_box_coords(&f.mesh) == box);
    const float *plane = f.built ? plr_mesh_plane_coords(&f.mesh) : NULL;
    CHECK(plane && plane[8] == 1 && plane[9] == 0); /* s along y, t along z: 8 of 10 */
    CHECK(plane && plane[0] == 0 && plane[1] == 0.8f && plane[3] == 1);
    finish(&f);
    f = build("Sphere { radius 3 }");
    box = f.built ? plr_mesh_box_coords(&f.mesh) : NULL;
    double worst = 0;
    for (size_t i = 0; box && i < f.mesh.vertex_count; i++)
        for (size_t axis = 0; axis < 3; axis++)
            worst =
                fmax(worst, fabs((double)box[4 * i + axis] - 0.5 -
                                 (double)f.mesh.positions[3 * i + axis] / (axis == 2 ? -6 : 6)));
    CHECK(box != NULL);
    CHECK_NEAR(worst, 0, 1e-6);
    finish(&f);
}

static void test_fog_coordinates(void) {
    fixture f =
        build("IndexedFaceSet { coordIndex [ 2 0 1 3 ] fogCoord FogCoordinate { depth [ 5 6 7 ] "
              "} coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0, 1 1 0 ] } }");
    CHECK(f.built && f.mesh.fog_coords);
    static const float expected[4] = {7, 5, 6, 7}; /* the last holds on */
    for (size_t i = 0; f.built && i < 6; i++) {
        uint32_t v = f.mesh.indices[i];
        CHECK(v < 4 && f.mesh.fog_coords[v] == expected[v]);
    }
    finish(&f);
    f = build("PointSet { coord Coordinate { point [ 0 0 0 ] } }");
    CHECK(f.built && !f.mesh.fog_coords);
    finish(&f);
}

static void test_line_distances(void) {
    /* a closed polyline, and one that shares its points */
    fixture f =
        build("IndexedLineSet { coordIndex [ 0 1 2 0 -1 2 1 ] coord Coordinate { point [ 0 0 0, "
              "3 0 0, 3 4 0 ] } attrib FloatVertexAttribute { name \"w\" numComponents 1 value "
              "[ 10 11 12 ] } }");
    static const float expected[6] = {0, 3, 7, 12, 0, 4};
    CHECK(f.built && f.mesh.vertex_count == 6 && f.mesh.line_distances &&
          memcmp(f.mesh.line_distances, expected, sizeof expected) == 0);
    static const uint32_t indices[8] = {0, 1, 1, 2, 2, 3, 4, 5};
    CHECK(f.built && f.mesh.index_count == 8 &&
          memcmp(f.mesh.indices, indices, sizeof indices) == 0);
    CHECK(f.built && f.mesh.attribute_count == 1 && f.mesh.attributes[0].values[4] == 12);
    finish(&f);
    f = build("TriangleSet { coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } }");
    CHECK(f.built && !f.mesh.line_distances);
    finish(&f);
}

/* Attributes go with the points that are used, on every node that takes them. */
static void test_attributes_everywhere(void) {
    static const char *const nodes[] = {
        "IndexedFaceSet { coordIndex [ 0 1 2 3 ]",
        "IndexedTriangleSet { index [ 0 1 3 ]",
        "IndexedTriangleFanSet { index [ 0 1 2 3 ]",
        "IndexedTriangleStripSet { index [ 0 1 2 3 ]",
        "IndexedQuadSet { index [ 0 1 2 3 ]",
        "TriangleSet {",
        "TriangleFanSet { fanCount 3",
        "TriangleStripSet { stripCount 4",
        "QuadSet {",
        "IndexedLineSet { coordIndex [ 0 1 2 3 ]",
        "LineSet { vertexCount 4",
        "PointSet {",
        "ElevationGrid { xDimension 2 zDimension 2 height [ 0 0 0 0 ]",
    };
    for (size_t i = 0; i < sizeof nodes / sizeof *nodes; i++) {
        char text[600];
        snprintf(
            text, sizeof text,
            "%s %s attrib [ FloatVertexAttribute { name \"a\" numComponents 1 value [ 0 1 2 3 ] "
            "} Matrix4VertexAttribute { name \"m\" value [ 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1, 1 0 "
            "0 0 0 1 0 0 0 0 1 0 0 0 0 1, 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1, 1 0 0 7 0 1 0 8 0 0 1 "
            "9 0 0 0 1 ] } ] }",
            nodes[i],
            strncmp(nodes[i], "Elev", 4) == 0
                ? ""
                : "coord Coordinate { point [ 0 0 0, 1 0 0, 1 0 1, 0 0 1 ] }");
        fixture f = build(text);
        bool found =
            f.built && f.mesh.attribute_count == 2 && f.mesh.attributes[1].components == 16;
        if (!found)
            printf("# %s\n", text);
        CHECK(found);
        for (size_t v = 0; found && v < f.mesh.vertex_count; v++) {
            const float *p = f.mesh.positions + 3 * v;
            bool grid = strncmp(nodes[i], "Elev", 4) == 0;
            float expected = p[2] > 0 ? (grid == (p[0] > 0) ? 3 : 2) : p[0];
            found = f.mesh.attributes[0].values[v] == expected &&
                    f.mesh.attributes[1].values[16 * v + 13] == (expected == 3 ? 8 : 0);
        }
        CHECK(found);
        finish(&f);
    }
    fixture f =
        build("IndexedTriangleSet { index [ 0 1 2 ] coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 "
              "0, 9 9 9 ] } attrib FloatVertexAttribute { name \"a\" numComponents 1 value [ 0 "
              "1 2 ] } }");
    CHECK(f.built && f.mesh.attribute_count == 1); /* point 3 is in nobody's use */
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

static void test_elevation_bindings(void) {
    static const char *const grid =
        "ElevationGrid { xDimension 3 zDimension 2 height [ 0 0 0 0 0 0 ]";
    char text[500];
    snprintf(text, sizeof text,
             "%s colorPerVertex FALSE color Color { color [ 1 0 0, 0 1 0 ] } normalPerVertex FALSE "
             "normal Normal { vector [ 0 1 0, 1 1 0 ] } }",
             grid);
    fixture f = build(text);
    size_t red = 0, tilted = 0;
    for (size_t i = 0; f.built && i < f.mesh.index_count; i++) {
        const float *p = vertex(&f.mesh, i), *c = f.mesh.colors + 4 * f.mesh.indices[i];
        red += c[0] == 1 && p[0] <= 1;
        tilted += f.mesh.normals[3 * f.mesh.indices[i]] > 0.7f && p[0] >= 1;
    }
    CHECK_INT(red, 6);
    CHECK_INT(tilted, 6);
    finish(&f);
    snprintf(
        text, sizeof text,
        "%s color ColorRGBA { color [ 0 0 0 0, 1 0 0 .1, 0 0 0 .2, 0 0 0 .3, 0 0 0 .4, 0 0 0 .5 ] "
        "} texCoord MultiTextureCoordinate { texCoord [ TextureCoordinateGenerator { } "
        "TextureCoordinate { point [ 0 0, 1 0, 2 0, 3 0, 4 0, 5 0 ] } ] } }",
        grid);
    f = build(text);
    CHECK(f.built);
    for (size_t i = 0; f.built && i < f.mesh.vertex_count; i++) {
        const float *p = f.mesh.positions + 3 * i;
        float number = p[0] + 3 * p[2];
        CHECK_NEAR(f.mesh.colors[4 * i + 3], number * 0.1f, 1e-6);
        CHECK_NEAR(f.mesh.tex_coords[0][4 * i], p[0] / 2, 0); /* the grid's own mapping */
        CHECK_NEAR(f.mesh.tex_coords[1][4 * i], number, 0);
    }
    finish(&f);
    /* a roof: smooth across its ridge only where the crease angle allows it */
    for (int smooth = 0; smooth < 2; smooth++) {
        snprintf(
            text, sizeof text,
            "ElevationGrid { xDimension 3 zDimension 2 height [ 0 1 0 0 1 0 ] creaseAngle %s }",
            smooth ? "1.6" : "1.5");
        f = build(text);
        CHECK_INT(f.mesh.vertex_count, smooth ? 6 : 8);
        finish(&f);
    }
}

/* What modellers leave behind: points twice, faces without area, faces that are not flat. */
static void test_unclean_faces(void) {
    fixture f =
        build("IndexedFaceSet { creaseAngle 1 convex FALSE coordIndex [ 0 1 1 2 3 0 -1 3 2 2 -1 "
              "0 3 2 3 ] coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } }");
    CHECK_NEAR(area_of(&f.mesh), 1, 1e-6);
    bool along_z = f.built;
    for (size_t i = 0; along_z && i < f.mesh.index_count; i++)
        along_z = fabsf(f.mesh.normals[3 * (size_t)f.mesh.indices[i] + 2]) == 1;
    CHECK(along_z);
    finish(&f);
    /* a saddle: cut along one diagonal; its normal is Newell's */
    f = build(
        "IndexedFaceSet { convex FALSE coordIndex [ 0 1 2 3 ] coord Coordinate { point [ 0 0 0, 1 "
        "1 0, 1 0 -1, 0 1 -1 ] } }");
    CHECK_INT(f.mesh.index_count, 6);
    CHECK(f.built && isfinite(f.mesh.normals[0]));
    finish(&f);
    f = build(
        "IndexedFaceSet { coordIndex [ 0 1 2 3 ] coord Coordinate { point [ 0 0.1 0, 0 0 1, 1 .1 "
        "1, 1 0 0 ] } }");
    CHECK_NEAR(f.mesh.normals[1], 1, 1e-6);
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
    CHECK(f.built && f.mesh.colors[1] == 0 && f.mesh.colors[5] == 1); /* too few: white */
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    finish(&f);
    f = build(
        "IndexedFaceSet { coordIndex [ 0 1 2 ] coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } "
        "normal Normal { vector [ 1 0 0, 1 0 0 ] } }");
    CHECK(f.built && f.mesh.normals[2] == 1); /* too few: the face's own */
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
    test_cut_sides();
    test_clockwise();
    test_concave();
    test_spiral();
    test_random_polygons();
    test_default_mapping();
    test_bindings();
    test_matrix_attributes();
    test_triangle_nodes();
    test_texture_units();
    test_box_mapping();
    test_fog_coordinates();
    test_line_distances();
    test_attributes_everywhere();
    test_lines_and_points();
    test_elevation();
    test_elevation_bindings();
    test_unclean_faces();
    test_hostile();
    return tap_done();
}
