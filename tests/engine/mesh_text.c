/* Text: outlines against their own areas, layout against the rules of ISO/IEC 19775-1 15.4. */
#include "tests/engine/mesh_test.h"

#include "engine/font.h"

/* ---- Glyphs ---- */

static bool inside(const plr_glyph *g, uint32_t first, uint32_t end, const double point[2]) {
    bool in = false;
    for (uint32_t i = first, j = end - 1; i < end; j = i++) {
        const double *a = g->points[i], *b = g->points[j];
        if ((a[1] > point[1]) != (b[1] > point[1]) &&
            point[0] < a[0] + (b[0] - a[0]) * (point[1] - a[1]) / (b[1] - a[1]))
            in = !in;
    }
    return in;
}

/* Holes run the other way around than what they are in. What runs so and is in nothing is no hole:
 * one accent of DejaVu Sans Mono Oblique does. */
static double outline_area(const plr_glyph *g) {
    double sum = 0;
    uint32_t first = 0;
    for (size_t c = 0; c < g->contour_count; first = g->ends[c++]) {
        double area = 0;
        bool in = false;
        for (uint32_t i = first; i < g->ends[c]; i++) {
            const double *a = g->points[i], *b = g->points[i + 1 < g->ends[c] ? i + 1 : first];
            area += (a[1] * b[0] - a[0] * b[1]) / 2; /* outer ones run clockwise in TrueType */
        }
        for (size_t other = 0; other < g->contour_count; other++)
            in = in || (other != c && inside(g, other ? g->ends[other - 1] : 0, g->ends[other],
                                             g->points[first]));
        sum += area < 0 && !in ? -area : area;
    }
    return sum;
}

/* Every letter of three alphabets in every face: the triangles cover the outline, once. */
static void test_all_glyphs(void) {
    static const uint32_t ranges[][2] = {
        {0x21, 0x7e}, {0xa1, 0x17f}, {0x391, 0x3c9}, {0x410, 0x44f}};
    static const char *const families[] = {"SERIF", "SANS", "TYPEWRITER"};
    plr_arena arena;
    jmp_buf out_of_memory;
    plr_arena_init(&arena, NULL, &out_of_memory);
    if (setjmp(out_of_memory))
        abort();
    size_t wrong = 0, drawn = 0;
    for (int face = 0; face < 12; face++) {
        bool bold = face & 1, italic = face & 2;
        plr_font *font = plr_font_open(NULL, (plr_font_family)(face / 4), bold, italic);
        CHECK(font != NULL);
        plr_glyph glyph = {0};
        for (size_t r = 0; font && r < sizeof ranges / sizeof *ranges; r++) {
            char text[3000];
            size_t used =
                (size_t)snprintf(text, sizeof text,
                                 "Text { fontStyle FontStyle { family \"%s\" style "
                                 "\"%s%s\" } string \"",
                                 families[face / 4], bold ? "BOLD" : "", italic ? "ITALIC" : "");
            double expected = 0;
            for (uint32_t c = ranges[r][0]; c <= ranges[r][1]; c++) {
                plr_font_glyph(font, &arena, c, &glyph);
                expected += outline_area(&glyph);
                if (c == '"' || c == '\\')
                    text[used++] = '\\';
                if (c < 0x80) {
                    text[used++] = (char)c;
                } else {
                    text[used++] = (char)(0xc0 | c >> 6);
                    text[used++] = (char)(0x80 | (c & 0x3f));
                }
            }
            snprintf(text + used, sizeof text - used, "\" }");
            fixture f = build(text);
            bool right =
                f.built && fabs(area_of(&f.mesh) / expected - 1) < 1e-4 && faces_outward(&f.mesh);
            if (!right)
                printf("# face %d range %zu: %.6f, not %.6f\n", face, r,
                       f.built ? area_of(&f.mesh) : 0, expected);
            wrong += !right;
            drawn += f.built;
            finish(&f);
        }
        plr_font_close(font);
    }
    CHECK_INT(wrong, 0);
    CHECK_INT(drawn, 48);
    plr_arena_finish(&arena);
}

/* ---- Holes ---- */

/* What fonts seldom have: many holes in a row and one behind the other, islands in holes. */
static void test_holes(void) {
    enum {
        HOLES = 25
    };
    double points[4 * (HOLES + 3)][2];
    uint32_t ends[HOLES + 3];
    size_t count = 0;
    double expected = 0;
    for (int i = 0; i < HOLES + 3; i++) {
        /* the outer square, holes in a grid (some in one line), a hole with an island */
        bool outer = i == 0 || i == HOLES + 2;
        double x = i == 0       ? 0
                   : i <= HOLES ? 1 + (i - 1) % 5 * 2
                                : 12,
               y = i == 0       ? 0
                   : i <= HOLES ? 1 + (i - 1) / 5 * 2
                                : 4,
               size = i == 0           ? 20
                      : i <= HOLES     ? 1
                      : i == HOLES + 1 ? 6
                                       : 2;
        if (i == HOLES + 2) {
            x += 2;
            y += 2;
        }
        const double corners[4][2] = {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
        for (int k = 0; k < 4; k++)
            memcpy(points[count++], corners[outer ? k : 3 - k], sizeof *points);
        ends[i] = (uint32_t)count;
        expected += (outer ? 1 : -1) * size * size;
    }
    float flat[4 * (HOLES + 3)][3] = {{0}};
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++)
            flat[i][k] = (float)points[i][k];
    static const float normal[3] = {0, 0, 1};
    plr_diags *diags = plr_diags_create(NULL);
    static const char source[] = "#X3D V4.0 utf8\nPROFILE Full\nText { }\n";
    plr_scene *scene = plr_scene_parse(source, sizeof source - 1, "t.x3dv", NULL, diags);
    plr_arena arena;
    jmp_buf out_of_memory;
    plr_arena_init(&arena, NULL, &out_of_memory);
    plr_mesh mesh = {0};
    plr_polygons p = {.arena = &arena,
                      .node = plr_scene_root(scene, 0),
                      .diags = diags,
                      .concave = true,
                      .points = flat[0],
                      .point_count = (uint32_t)count,
                      .normals = normal};
    plr_polygons_add_outline(&p, points, ends, HOLES + 3, 0);
    CHECK_INT(p.faces.count, 2);
    for (size_t i = 0; i < p.corners.count; i++)
        p.corners.items[i].tex = PLR_MESH_NONE;
    CHECK(plr_polygons_emit(&p, &mesh));
    CHECK_NEAR(area_of(&mesh), expected, 1e-4);
    CHECK(faces_outward(&mesh));
    plr_mesh_free(&mesh);
    plr_arena_finish(&arena);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

/* ---- Layout ---- */

typedef struct box {
    double x0, y0, x1, y1;
} box;

static box bounds_of(const char *strings, const char *style, const char *more) {
    char text[1000];
    snprintf(text, sizeof text, "Text { string [ %s ] fontStyle FontStyle { %s } %s }", strings,
             style, more);
    fixture f = build(text);
    CHECK(f.built);
    box b = {(double)f.mesh.bounds[0][0], (double)f.mesh.bounds[0][1], (double)f.mesh.bounds[1][0],
             (double)f.mesh.bounds[1][1]};
    finish(&f);
    return b;
}

/* Typewriter letters: each as wide as the next. */
#define MONO "family \"TYPEWRITER\" "

static void test_horizontal(void) {
    box h = bounds_of("\"H\"", MONO, "");
    CHECK_NEAR(h.y0, 0, 1e-6); /* stands on its baseline, the X axis */
    CHECK(h.x0 > 0 && h.x0 < 0.2 && h.y1 > 0.6 && h.y1 < 0.8);
    double width = bounds_of("\"HH\"", MONO, "").x1 - h.x1;
    CHECK(width > 0.5 && width < 0.7);
    CHECK_NEAR(bounds_of("\"HHHH\"", MONO, "").x1, h.x1 + 3 * width, 1e-5);
    box large = bounds_of("\"H\"", MONO "size 3", "");
    CHECK_NEAR(large.x0, 3 * h.x0, 1e-5);
    CHECK_NEAR(large.y1, 3 * h.y1, 1e-5);
    box end = bounds_of("\"HH\"", MONO "justify \"END\"", "");
    CHECK_NEAR(end.x0, h.x0 - 2 * width, 1e-5);
    box middle = bounds_of("\"HH\", \"HHHH\"", MONO "justify \"MIDDLE\"", "");
    CHECK_NEAR(middle.x0, h.x0 - 2 * width, 1e-5);
    CHECK_NEAR(middle.x1 + middle.x0, 0, 0.01); /* its letters are nearly in their middle */
    box back = bounds_of("\"HI\"", MONO "leftToRight FALSE", "");
    CHECK_NEAR(back.x1, h.x1 - width, 1e-5); /* H first, at the right */
    CHECK_NEAR(bounds_of("\"HH\"", MONO "leftToRight FALSE justify \"END\"", "").x0, h.x0, 1e-5);
    /* blanks take room, control characters do not */
    CHECK_NEAR(bounds_of("\"H H\"", MONO, "").x1, h.x1 + 2 * width, 1e-5);
    CHECK_NEAR(bounds_of("\"H\tH\"", MONO, "").x1, h.x1 + width, 1e-5);
}

static void test_lines(void) {
    box one = bounds_of("\"H\"", "", ""), two = bounds_of("\"H\", \"H\"", "", "");
    CHECK_NEAR(two.y0, -1, 1e-6);
    CHECK_NEAR(two.y1, one.y1, 1e-6);
    CHECK_NEAR(bounds_of("\"H\", \"\", \"H\"", "spacing 2 size .5", "").y0, -2, 1e-6);
    CHECK_NEAR(bounds_of("\"H\", \"H\"", "topToBottom FALSE", "").y1, 1 + one.y1, 1e-6);
    /* across the lines: begin at the ascender, end at the descender, middle between */
    plr_font *font = plr_font_open(NULL, PLR_FONT_SERIF, false, false);
    CHECK(font != NULL);
    double up = font ? plr_font_ascender(font) : 0, down = font ? plr_font_descender(font) : 0;
    plr_font_close(font);
    CHECK(up > 0.7 && up < 1.1 && down < -0.1 && down > -0.4);
    static const struct {
        const char *style;
        double up, down, rest; /* where the first line stands */
    } cases[] = {
        {"justify [ \"BEGIN\" \"FIRST\" ]", 0, 0, 0},
        {"justify [ \"BEGIN\" \"BEGIN\" ]", -1, 0, 0},
        {"justify [ \"BEGIN\" \"MIDDLE\" ]", -.5, -.5, .5},
        {"justify [ \"BEGIN\" \"END\" ]", 0, -1, 1},
        {"topToBottom FALSE justify [ \"BEGIN\" \"BEGIN\" ]", 0, -1, 0},
        {"topToBottom FALSE justify [ \"BEGIN\" \"MIDDLE\" ]", -.5, -.5, -.5},
        {"topToBottom FALSE justify [ \"BEGIN\" \"END\" ]", -1, 0, -1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        box b = bounds_of("\"H\", \"H\"", cases[i].style, "");
        double first = cases[i].up * up + cases[i].down * down + cases[i].rest;
        bool upward = strncmp(cases[i].style, "top", 3) == 0;
        CHECK_NEAR(upward ? b.y0 : b.y0 + 1, first, 1e-5);
    }
}

static void test_extents(void) {
    box h = bounds_of("\"H\"", MONO, "");
    double width = bounds_of("\"HH\"", MONO, "").x1 - h.x1;
    box b = bounds_of("\"HH\"", MONO, "length 6");
    CHECK_NEAR(b.x0, h.x0 * 3 / width, 1e-4); /* letters are as much wider */
    CHECK_NEAR(b.y1, h.y1, 1e-6);
    b = bounds_of("\"HHHH\", \"HH\"", MONO "justify \"END\"", "maxExtent 1");
    CHECK_NEAR(b.x0, -1 + h.x0 / (4 * width), 1e-5);
    CHECK_NEAR(bounds_of("\"H\"", MONO, "maxExtent 100").x1, h.x1, 1e-6);
    b = bounds_of("\"HHHH\", \"HH\"", MONO, "length [ 0, 8 ] maxExtent 4");
    CHECK_NEAR(b.x1, 8 * .5 - (width - h.x1) * 8 / (2 * width) * .5, 1e-4);
}

static void test_vertical(void) {
    box h = bounds_of("\"H\"", MONO, "");
    double wide = h.x1 - h.x0, high = h.y1 - h.y0;
    box one = bounds_of("\"H\"", MONO "horizontal FALSE", "");
    CHECK_NEAR(one.x1 - one.x0, wide, 1e-6);
    CHECK_NEAR(one.y1 - one.y0, high, 1e-6);
    CHECK_NEAR((one.x0 + one.x1) / 2, 0.5, 0.01); /* in the middle of its square, below y = 0 */
    CHECK(one.y1 < 0 && one.y0 > -1);
    box three = bounds_of("\"HHH\"", MONO "horizontal FALSE", "");
    CHECK_NEAR(three.y0, one.y0 - 2, 1e-6);
    CHECK_NEAR(three.x1, one.x1, 1e-6);
    box up = bounds_of("\"HHH\"", MONO "horizontal FALSE topToBottom FALSE", "");
    CHECK_NEAR(up.y1, one.y1 + 3, 1e-6);
    box columns = bounds_of("\"H\", \"H\"", MONO "horizontal FALSE spacing 2", "");
    CHECK_NEAR(columns.x1, one.x1 + 2, 1e-6);
    columns = bounds_of("\"H\", \"H\"", MONO "horizontal FALSE leftToRight FALSE", "");
    CHECK_NEAR(columns.x0, one.x0 - 2, 1e-6);
    columns = bounds_of("\"H\", \"H\"", MONO "horizontal FALSE justify [ \"END\" \"END\" ]", "");
    CHECK_NEAR(columns.x1, one.x1 - 1, 1e-6);
    CHECK_NEAR(columns.y0, one.y0 + 1, 1e-6);
    columns =
        bounds_of("\"H\", \"H\"", MONO "horizontal FALSE justify [ \"MIDDLE\" \"MIDDLE\" ]", "");
    CHECK_NEAR(columns.x0, one.x0 - 1, 1e-6);
}

static void test_styles(void) {
    double plain = bounds_of("\"l\"", "family \"SANS\"", "").x1;
    box bold = bounds_of("\"l\"", "family \"SANS\" style \"BOLD\"", "");
    CHECK(bold.x1 - bold.x0 > 0.12 && plain < 0.2);
    box italic = bounds_of("\"l\"", "family \"SANS\" style \"ITALIC\"", "");
    CHECK(italic.x1 - italic.x0 > 0.15); /* it leans */
    box both = bounds_of("\"l\"", "family \"SANS\" style \"BOLDITALIC\"", "");
    CHECK(both.x1 - both.x0 > italic.x1 - italic.x0 + 0.05);
    /* the first family that there is; a serif makes an I wide */
    box serif = bounds_of("\"I\"", "family [ \"Foo Sans\" \"SERIF\" \"SANS\" ]", "");
    box sans = bounds_of("\"I\"", "family [ \"Foo Sans\" \"SANS\" \"SERIF\" ]", "");
    CHECK(serif.x1 - serif.x0 > 2 * (sans.x1 - sans.x0));
    CHECK_NEAR(bounds_of("\"I\"", "family \"Foo\"", "").x1, serif.x1, 0);
}

static void test_mapping(void) {
    fixture f =
        build("Text { string [ \"HI\" \"H\" ] fontStyle FontStyle { size 2 justify \"END\" } }");
    CHECK(f.built && f.mesh.two_sided && !f.mesh.tex_coords_given);
    /* 1 is the height of the font; (0, 0) where the first line begins */
    double begin = -2 * (double)f.mesh.tex_coords[0][0] + (double)f.mesh.positions[0], worst = 0;
    for (size_t i = 0; f.built && i < f.mesh.vertex_count; i++) {
        const float *p = f.mesh.positions + 3 * i, *t = f.mesh.tex_coords[0] + 4 * i;
        worst = fmax(worst, fabs((double)p[0] - begin - 2 * (double)t[0]));
        worst = fmax(worst, fabs((double)p[1] - 2 * (double)t[1]));
    }
    CHECK_NEAR(worst, 0, 1e-5);
    box h = bounds_of("\"HI\"", "size 2 justify \"END\"", ""),
        plain = bounds_of("\"HI\"", "size 2", "");
    CHECK_NEAR(begin, h.x0 - plain.x0, 1e-5);
    finish(&f);
    f = build("Text { string \"H\" solid TRUE texCoord TextureCoordinateGenerator { } }");
    CHECK(f.built && !f.mesh.two_sided && f.mesh.tex_coords_given);
    finish(&f);
}

static void test_faults(void) {
    fixture f = build("Text { string [ \"\" \" \" ] }");
    CHECK(!f.built && !plr_diags_count_of(f.diags, PLR_ERROR) &&
          !plr_diags_count_of(f.diags, PLR_WARNING));
    finish(&f);
    f = build("Text3D { string \"H\" }");
    CHECK(f.built && !f.mesh.two_sided);
    finish(&f);
    f = build("Text { string \"HHHH\" maxDisplayChars 2 }");
    double two = (double)f.mesh.bounds[1][0];
    finish(&f);
    CHECK_NEAR(two, bounds_of("\"HH\"", "", "").x1, 0);
    size_t size = 60000;
    char *text = malloc(size);
    size_t used = (size_t)snprintf(text, size, "Text { string \"");
    memset(text + used, '.', 50000);
    snprintf(text + used + 50000, size - used - 50000, "\" }");
    f = build(text);
    CHECK(f.built);
    CHECK_INT(count_code(&f, PLR_CODE_BAD_GEOMETRY), 1);
    CHECK_INT(plr_diags_count_of(f.diags, PLR_ERROR), 0);
    finish(&f);
    free(text);
    f = build("Text { string \"\xff\xc3\xe2\x82\xf0\" }"); /* no UTF-8 */
    finish(&f);
    f = build("Text { string \"H\" fontStyle FontStyle { size 1e38 } length 3e38 }");
    finish(&f);
    /* no fonts: one warning, nothing to be drawn */
    f = build("Text { string \"H\" }");
    plr_mesh mesh;
    static const char *const nowhere[] = {"/nonexistent", NULL};
    plr_node *node = plr_node_child(plr_scene_root(f.scene, 0), "geometry");
    CHECK(!plr_mesh_build_with(node, nowhere, &mesh, f.diags));
    CHECK_INT(count_code(&f, PLR_CODE_MISSING_FONT), 1);
    CHECK_INT(plr_diags_count_of(f.diags, PLR_ERROR), 0);
    finish(&f);
}

int main(void) {
    plr_font *font = plr_font_open(NULL, PLR_FONT_SERIF, false, false);
    if (!font) {
        printf("1..0 # SKIP the DejaVu fonts are not installed\n");
        return 0;
    }
    plr_font_close(font);
    test_all_glyphs();
    test_holes();
    test_horizontal();
    test_lines();
    test_extents();
    test_vertical();
    test_styles();
    test_mapping();
    test_faults();
    return tap_done();
}
