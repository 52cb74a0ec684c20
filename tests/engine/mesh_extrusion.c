/* Extrusion against closed forms: the rules of ISO/IEC 19775-1 13.3.5 one by one. */
#include "tests/engine/mesh_test.h"

/* A cross-section around a regular polygon in the order that faces outward, closed. */
static size_t ring(char *text, size_t size, int corners, double radius) {
    size_t used = 0;
    for (int i = 0; i <= corners; i++) {
        double angle = 2 * PI * (i % corners) / corners;
        used += (size_t)snprintf(text + used, size - used, " %.9f %.9f,", radius * sin(angle),
                                 radius * cos(angle));
    }
    return used;
}

static double polygon_area(int corners, double radius) {
    return corners / 2.0 * radius * radius * sin(2 * PI / corners);
}

static void test_default(void) {
    fixture f = build("Extrusion { }"); /* a square prism of side 2 and height 1 */
    CHECK_INT(f.mesh.index_count, (4 * 2 + 2 * 2) * 3);
    CHECK_NEAR(volume_of(&f.mesh), 4, 1e-6);
    CHECK_NEAR(area_of(&f.mesh), 16, 1e-6);
    CHECK(f.built && faces_outward(&f.mesh) && !f.mesh.two_sided);
    CHECK_INT(euler_number(&f.mesh), 2);
    /* the side that begins at the first corner (1, 1): s along the section, t along the spine */
    const float *t = tex_at(&f.mesh, 1, 0, 1, (float[]){1, 0, 0});
    CHECK(t[0] == 0 && t[1] == 0 && t[3] == 1);
    t = tex_at(&f.mesh, 1, 1, -1, (float[]){1, 0, 0});
    CHECK(t[0] == 0.25f && t[1] == 1);
    t = tex_at(&f.mesh, 1, 1, 1, (float[]){0, 0, 1}); /* where the section ends */
    CHECK(t[0] == 1 && t[1] == 1);
    t = tex_at(&f.mesh, 1, 1, -1, (float[]){0, 1, 0}); /* caps: S along X, T along Z */
    CHECK(t[0] == 1 && t[1] == 0);
    t = tex_at(&f.mesh, -1, 0, 1, (float[]){0, -1, 0});
    CHECK(t[0] == 0 && t[1] == 1);
    finish(&f);
    f = build("Extrusion { beginCap FALSE endCap FALSE solid FALSE }");
    CHECK(f.built && f.mesh.two_sided);
    CHECK_NEAR(area_of(&f.mesh), 8, 1e-6);
    finish(&f);
    f = build("Extrusion { ccw FALSE }");
    CHECK(f.built && f.mesh.clockwise);
    CHECK_NEAR(volume_of(&f.mesh), 4, 1e-6); /* as wound; seen from inside */
    CHECK_NEAR(f.mesh.normals[0], -1, 1e-6);
    finish(&f);
}

/* Lengths along curves, not numbers of points, make texture coordinates; a cap keeps proportions.
 */
static void test_texture_lengths(void) {
    fixture f =
        build("Extrusion { crossSection [ 2 0, 2 -1, 0 -1, 0 0, 2 0 ] spine [ 0 0 0, 0 1 0, "
              "0 4 0 ] }");
    const float *t = tex_at(&f.mesh, 0, 1, -1, (float[]){0, 0, -1});
    CHECK_NEAR(t[0], 0.5, 1e-6);
    CHECK_NEAR(t[1], 0.25, 1e-6);
    t = tex_at(&f.mesh, 2, 4, 0, (float[]){0, 1, 0});
    CHECK_NEAR(t[0], 1, 1e-6);
    CHECK_NEAR(t[1], 0.5, 1e-6);
    CHECK_NEAR(volume_of(&f.mesh), 8, 1e-5);
    finish(&f);
}

/* Along any straight spine the prism is the same, turned. */
static void test_straight_spines(void) {
    static const double ends[][3] = {{0, 0, 5}, {5, 0, 0}, {-3, 0, 4}, {0, -5, 0}, {3, 4, 0}};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        char text[300];
        snprintf(text, sizeof text, "Extrusion { spine [ 0 0 0, %.9g %.9g %.9g, %.9g %.9g %.9g ] }",
                 ends[i][0] * 0.2, ends[i][1] * 0.2, ends[i][2] * 0.2, ends[i][0], ends[i][1],
                 ends[i][2]);
        fixture f = build(text);
        CHECK_NEAR(volume_of(&f.mesh), 20, 1e-4);
        CHECK(f.built && faces_outward(&f.mesh));
        finish(&f);
    }
    /* along +X: the Y axis turns to X about Z, so the section's x points to -Y and z stays */
    fixture f = build("Extrusion { crossSection [ 3 1, 3 0, 0 0, 3 1 ] spine [ 0 0 0, 1 0 0 ] }");
    CHECK_NEAR(f.mesh.bounds[0][1], -3, 1e-6);
    CHECK_NEAR(f.mesh.bounds[1][1], 0, 1e-6);
    CHECK_NEAR(f.mesh.bounds[1][2], 1, 1e-6);
    finish(&f);
}

/* At a bend the plane halves the angle: a mitre. Its volume is area times the length of the spine.
 */
static void test_bend(void) {
    fixture f = build("Extrusion { crossSection [ .5 .5, .5 -.5, -.5 -.5, -.5 .5, .5 .5 ] spine "
                      "[ 0 0 0, 0 3 0, 3 3 0 ] }");
    CHECK(f.built && faces_outward(&f.mesh));
    CHECK_INT(euler_number(&f.mesh), 2);
    /* the standard does not stretch the section in the mitre: it stands 1 wide across it */
    double reach = 0;
    for (size_t i = 0; f.built && i < f.mesh.vertex_count; i++) {
        const float *p = f.mesh.positions + 3 * i;
        if (hypot((double)p[0], (double)p[1] - 3) < 1)
            reach = fmax(reach, hypot((double)p[0], (double)p[1] - 3));
    }
    CHECK_NEAR(reach, 0.5, 1e-6);
    finish(&f);
}

/* A ring: a closed spine has no seam in its frames nor, with a crease angle, in its normals. */
static void test_closed_spine(void) {
    enum {
        STEPS = 64,
        CORNERS = 32
    };
    char text[12000], section[2000];
    ring(section, sizeof section, CORNERS, 0.25);
    size_t used = (size_t)snprintf(text, sizeof text,
                                   "Extrusion { creaseAngle 1 beginCap FALSE endCap FALSE "
                                   "crossSection [ %s ] spine [",
                                   section);
    for (int i = 0; i <= STEPS; i++) {
        double angle = 2 * PI * (i % STEPS) / STEPS;
        used += (size_t)snprintf(text + used, sizeof text - used, " %.9g 0 %.9g,", 2 * sin(angle),
                                 2 * cos(angle));
    }
    snprintf(text + used, sizeof text - used, " ] }");
    fixture f = build(text);
    CHECK_INT(euler_number(&f.mesh), 0); /* closed both ways */
    CHECK(f.built && faces_outward(&f.mesh));
    /* Pappus: area times the way of its centre, of polygons here */
    CHECK_NEAR(volume_of(&f.mesh), polygon_area(CORNERS, 0.25) * 2 * STEPS * 2 * sin(PI / STEPS),
               0.02);
    double worst = 0; /* normals against the torus */
    for (size_t i = 0; f.built && i < f.mesh.vertex_count; i++) {
        const float *p = f.mesh.positions + 3 * i, *n = f.mesh.normals + 3 * i;
        double radius = hypot((double)p[0], (double)p[2]), out = (radius - 2) / 0.25;
        double expected[3] = {(double)p[0] / radius * out, (double)p[1] / 0.25,
                              (double)p[2] / radius * out};
        for (int axis = 0; axis < 3; axis++)
            worst = fmax(worst, fabs((double)n[axis] - expected[axis]));
    }
    CHECK_NEAR(worst, 0, 0.01);
    finish(&f);
}

/* A surface of revolution: all points of the spine coincide, orientation turns the section. */
static void test_revolution(void) {
    enum {
        STEPS = 48
    };
    char text[4000];
    /* a rectangle from radius 1 to 2, 1 high, turned about Z of the plane */
    size_t used = (size_t)snprintf(text, sizeof text,
                                   "Extrusion { beginCap FALSE endCap FALSE crossSection "
                                   "[ 1 0, 2 0, 2 1, 1 1, 1 0 ] spine [");
    for (int i = 0; i <= STEPS; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, " 0 0 0,");
    used += (size_t)snprintf(text + used, sizeof text - used, " ] orientation [");
    for (int i = 0; i <= STEPS; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, " 0 0 1 %.9g,",
                                 2 * PI * (i % STEPS) / STEPS);
    snprintf(text + used, sizeof text - used, " ] }");
    fixture f = build(text);
    CHECK_NEAR(fabs(volume_of(&f.mesh)), 3 * polygon_area(STEPS, 1), 1e-4);
    CHECK_INT(euler_number(&f.mesh), 0);
    finish(&f);
}

/* Coincident points have the plane of the spine around them. */
static void test_coincident_points(void) {
    fixture f = build("Extrusion { spine [ 0 0 0, 0 0 2, 0 0 2, 0 0 4 ] scale [ 1 1, 1 1, .5 .5, "
                      ".5 .5 ] }");
    CHECK_NEAR(volume_of(&f.mesh), 4 * 2 + 1 * 2, 1e-5); /* a step in the middle */
    CHECK(f.built);
    CHECK_INT(euler_number(&f.mesh), 2);
    finish(&f);
    f = build("Extrusion { spine [ 0 0 0, 0 0 0, 0 0 2 ] }");
    CHECK_NEAR(volume_of(&f.mesh), 8, 1e-5);
    CHECK_NEAR(f.mesh.bounds[1][2], 2, 1e-6);
    finish(&f);
}

static void test_scale_and_orientation(void) {
    fixture f = build("Extrusion { spine [ 0 0 0, 0 3 0 ] scale [ 1 1, 0.001 0.001 ] }");
    CHECK_NEAR(volume_of(&f.mesh), 4, 0.01); /* a pyramid */
    finish(&f);
    f = build("Extrusion { scale 2 3 }"); /* one for all */
    CHECK_NEAR(volume_of(&f.mesh), 24, 1e-5);
    finish(&f);
    f = build("Extrusion { crossSection [ 1 .5, 1 -.5, -1 -.5, -1 .5, 1 .5 ] orientation 0 1 0 "
              "1.570796327 }");
    CHECK_NEAR(f.mesh.bounds[1][0], 0.5, 1e-6);
    CHECK_NEAR(f.mesh.bounds[1][2], 1, 1e-6);
    finish(&f);
    f = build("Extrusion { spine [ 0 0 0, 0 1 0, 0 2 0 ] scale [ 1 1, 5 5 ] }");
    CHECK_NEAR(volume_of(&f.mesh), 8, 1e-5);
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    CHECK_INT(plr_diags_count_of(f.diags, PLR_ERROR), 0);
    finish(&f);
}

/* z of planes turns over where two bends go opposite ways; the section must not. */
static void test_snake(void) {
    fixture f =
        build("Extrusion { crossSection [ .1 .1, .1 -.1, -.1 -.1, -.1 .1, .1 .1 ] spine [ 0 "
              "0 0, 1 1 0, 0 2 0, 1 3 0, 0 4 0 ] }");
    CHECK(f.built && faces_outward(&f.mesh));
    CHECK_INT(euler_number(&f.mesh), 2);
    CHECK_NEAR(f.mesh.bounds[1][2], 0.1, 1e-6);
    double volume = volume_of(&f.mesh);
    CHECK(volume > 0.1 && volume < 0.04 * 4 * sqrt(2) + 1e-6);
    finish(&f);
}

static void test_caps(void) {
    /* a star: caps are concave */
    char text[2000];
    size_t used = (size_t)snprintf(text, sizeof text, "Extrusion { convex FALSE crossSection [");
    for (int i = 0; i <= 10; i++) {
        double radius = i % 2 ? 0.3 : 1, angle = PI * (i % 10) / 5;
        used += (size_t)snprintf(text + used, sizeof text - used, " %.9f %.9f,",
                                 radius * sin(angle), radius * cos(angle));
    }
    snprintf(text + used, sizeof text - used, " ] }");
    fixture f = build(text);
    CHECK_NEAR(volume_of(&f.mesh), 5 * 0.3 * sin(PI / 5), 1e-5);
    CHECK(f.built && faces_outward(&f.mesh));
    finish(&f);
    /* an open section has caps as if it were closed */
    f = build("Extrusion { crossSection [ 1 1, 1 -1, -1 -1, -1 1 ] }");
    CHECK_INT(f.mesh.index_count, (3 * 2 + 2 * 2) * 3);
    finish(&f);
    /* however large the crease angle, caps stay flat */
    f = build("Extrusion { creaseAngle 3 }");
    size_t up = 0;
    for (size_t i = 0; i < f.mesh.vertex_count; i++)
        up += f.mesh.normals[3 * i + 1] == 1;
    CHECK_INT(up, 4);
    finish(&f);
    f = build("Extrusion { crossSection [ 0 0, 1 0 ] }"); /* a band has none */
    CHECK_INT(f.mesh.index_count, 6);
    finish(&f);
}

static void test_hostile(void) {
    fixture f = build("Extrusion { spine [ 0 0 0 ] }");
    CHECK(!f.built && !plr_diags_count_of(f.diags, PLR_ERROR));
    finish(&f);
    f = build("Extrusion { crossSection [ 0 0 ] }");
    CHECK(!f.built && !plr_diags_count_of(f.diags, PLR_ERROR));
    finish(&f);
    f = build("Extrusion { scale [ ] orientation [ ] }");
    CHECK_NEAR(volume_of(&f.mesh), 4, 1e-6);
    finish(&f);
    f = build("Extrusion { spine [ 0 0 0, 0 1 0, 0 0 0, 0 1 0 ] }"); /* to and fro */
    CHECK(f.built);
    bool sound = f.built;
    for (size_t i = 0; sound && i < (size_t)f.mesh.vertex_count * 3; i++)
        sound = isfinite(f.mesh.positions[i]) && isfinite(f.mesh.normals[i]);
    CHECK(sound);
    finish(&f);
    f = build("Extrusion { spine [ 0 0 0, 1e38 1e38 1e38, -1e38 3e38 0 ] scale 3e38 3e38 "
              "crossSection [ 9 0, 0 0, 0 9 ] }");
    CHECK(!f.built);
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    finish(&f);
    /* a product that is too large */
    char *text = malloc(40000);
    size_t used = (size_t)snprintf(text, 40000, "Extrusion { crossSection [");
    for (int i = 0; i < 2000; i++)
        used += (size_t)snprintf(text + used, 40000 - used, "%d 0,", i % 7);
    used += (size_t)snprintf(text + used, 40000 - used, "] spine [");
    for (int i = 0; i < 2000; i++)
        used += (size_t)snprintf(text + used, 40000 - used, "0 %d 0,", i);
    snprintf(text + used, 40000 - used, "] }");
    f = build(text);
    CHECK(!f.built);
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    finish(&f);
    free(text);
}

int main(void) {
    test_default();
    test_texture_lengths();
    test_straight_spines();
    test_bend();
    test_closed_spine();
    test_revolution();
    test_coincident_points();
    test_scale_and_orientation();
    test_snake();
    test_caps();
    test_hostile();
    return tap_done();
}
