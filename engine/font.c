#include "engine/font.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

/* Curves are cut so finely that they are off by less, in em. */
#define TOLERANCE 0.0005
#define MOST_PIECES 16
/* How far a made-up slant leans. */
#define SLANT 0.2

struct plr_font {
    FT_Library library;
    FT_Face face;
    bool slanted; /* by plugray, for want of a slanted face */
};

static const char *const system_folders[] = {
    "/usr/share/fonts/truetype/dejavu", /* Debian, Ubuntu */
    "/usr/share/fonts/dejavu",          /* Alpine, older Fedora */
    "/usr/share/fonts/TTF",             /* Arch */
    "/usr/share/fonts/truetype",        /* openSUSE */
    "/usr/share/fonts/dejavu-sans-fonts",
    "/usr/share/fonts/dejavu-sans-mono-fonts", /* Fedora: a folder a family */
    "/usr/share/fonts/dejavu-serif-fonts",
    "/usr/local/share/fonts/dejavu", /* FreeBSD */
    "/Library/Fonts",                /* macOS */
    NULL,
};

/* By family, bold, italic. */
static const char *const file_names[3][2][2] = {
    {{"DejaVuSerif", "DejaVuSerif-Italic"}, {"DejaVuSerif-Bold", "DejaVuSerif-BoldItalic"}},
    {{"DejaVuSans", "DejaVuSans-Oblique"}, {"DejaVuSans-Bold", "DejaVuSans-BoldOblique"}},
    {{"DejaVuSansMono", "DejaVuSansMono-Oblique"},
     {"DejaVuSansMono-Bold", "DejaVuSansMono-BoldOblique"}},
};

/* ---- Files ---- */

static bool open_file(plr_font *font, const char *const *folders, const char *name) {
    char path[1024];
    for (; *folders; folders++) {
        int length = snprintf(path, sizeof path, "%s/%s.ttf", *folders, name);
        if (length > 0 && (size_t)length < sizeof path &&
            FT_New_Face(font->library, path, 0, &font->face) == 0) {
            if (FT_IS_SCALABLE(font->face) && font->face->units_per_EM)
                return true;
            FT_Done_Face(font->face);
        }
    }
    return false;
}

plr_font *plr_font_open(const char *const *folders, plr_font_family family, bool bold,
                        bool italic) {
    plr_font *font = calloc(1, sizeof *font);
    if (!font || FT_Init_FreeType(&font->library) != 0) {
        free(font);
        return NULL;
    }
    if (!folders)
        folders = system_folders;
    const char *const *names = file_names[family][bold];
    if (open_file(font, folders, names[italic]))
        return font;
    font->slanted = italic;
    if (italic && open_file(font, folders, names[0]))
        return font;
    FT_Done_FreeType(font->library);
    free(font);
    return NULL;
}

void plr_font_close(plr_font *font) {
    if (!font)
        return;
    FT_Done_Face(font->face);
    FT_Done_FreeType(font->library);
    free(font);
}

static double em(const plr_font *font) {
    return (double)font->face->units_per_EM;
}

double plr_font_ascender(const plr_font *font) {
    return font->face->ascender / em(font);
}

double plr_font_descender(const plr_font *font) {
    return font->face->descender / em(font);
}

/* ---- Outlines ---- */

typedef struct tracer {
    const plr_font *font;
    plr_arena *arena;
    plr_glyph *glyph;
    double at[2]; /* the pen */
} tracer;

static void to_em(const tracer *t, const FT_Vector *v, double point[2]) {
    point[1] = (double)v->y / em(t->font);
    point[0] = (double)v->x / em(t->font) + (t->font->slanted ? SLANT * point[1] : 0);
}

static bool same_point(const double a[2], const double b[2]) {
    return a[0] == b[0] && a[1] == b[1];
}

/* Where the contour in hand begins. */
static size_t contour_start(const plr_glyph *g) {
    return g->contour_count ? g->ends[g->contour_count - 1] : 0;
}

/* A point that is already there is not repeated. */
static void add_point(tracer *t, const double point[2]) {
    plr_glyph *g = t->glyph;
    memcpy(t->at, point, sizeof t->at);
    if (g->point_count > contour_start(g) && same_point(point, g->points[g->point_count - 1]))
        return;
    g->points = plr_arena_grow(t->arena, g->points, &g->point_capacity, g->point_count + 1,
                               sizeof *g->points);
    memcpy(g->points[g->point_count++], point, sizeof t->at);
}

static void end_contour(tracer *t) {
    plr_glyph *g = t->glyph;
    size_t first = contour_start(g);
    while (g->point_count > first + 1 &&
           same_point(g->points[first], g->points[g->point_count - 1]))
        g->point_count--;
    if (g->point_count < first + 3) {
        g->point_count = first;
        return;
    }
    g->ends =
        plr_arena_grow(t->arena, g->ends, &g->end_capacity, g->contour_count + 1, sizeof *g->ends);
    g->ends[g->contour_count++] = (uint32_t)g->point_count;
}

static int move_to(const FT_Vector *to, void *data) {
    tracer *t = data;
    double point[2];
    if (t->glyph->point_count)
        end_contour(t);
    to_em(t, to, point);
    add_point(t, point);
    return 0;
}

static int line_to(const FT_Vector *to, void *data) {
    tracer *t = data;
    double point[2];
    to_em(t, to, point);
    add_point(t, point);
    return 0;
}

/* Into how many pieces a curve goes whose control polygon bends by `bend` (a second difference). */
static int pieces(double bend) {
    double n = ceil(sqrt(bend / (4 * TOLERANCE)));
    return n < 1 ? 1 : n > MOST_PIECES ? MOST_PIECES : (int)n;
}

static int conic_to(const FT_Vector *control, const FT_Vector *to, void *data) {
    tracer *t = data;
    double a[2], b[2], c[2];
    memcpy(a, t->at, sizeof a);
    to_em(t, control, b);
    to_em(t, to, c);
    int n = pieces(hypot(a[0] - 2 * b[0] + c[0], a[1] - 2 * b[1] + c[1]));
    for (int i = 1; i <= n; i++) {
        double v = (double)i / n, u = 1 - v;
        double point[2] = {u * u * a[0] + 2 * u * v * b[0] + v * v * c[0],
                           u * u * a[1] + 2 * u * v * b[1] + v * v * c[1]};
        add_point(t, i < n ? point : c);
    }
    return 0;
}

static int cubic_to(const FT_Vector *first, const FT_Vector *second, const FT_Vector *to,
                    void *data) {
    tracer *t = data;
    double a[2], b[2], c[2], d[2];
    memcpy(a, t->at, sizeof a);
    to_em(t, first, b);
    to_em(t, second, c);
    to_em(t, to, d);
    double bend = fmax(hypot(a[0] - 2 * b[0] + c[0], a[1] - 2 * b[1] + c[1]),
                       hypot(b[0] - 2 * c[0] + d[0], b[1] - 2 * c[1] + d[1]));
    int n = pieces(3 * bend);
    for (int i = 1; i <= n; i++) {
        double v = (double)i / n, u = 1 - v;
        double point[2];
        for (int k = 0; k < 2; k++)
            point[k] =
                u * u * u * a[k] + 3 * u * u * v * b[k] + 3 * u * v * v * c[k] + v * v * v * d[k];
        add_point(t, i < n ? point : d);
    }
    return 0;
}

void plr_font_glyph(plr_font *font, plr_arena *arena, uint32_t character, plr_glyph *glyph) {
    static const FT_Outline_Funcs functions = {move_to, line_to, conic_to, cubic_to, 0, 0};
    glyph->advance = 0;
    glyph->point_count = glyph->contour_count = 0;
    FT_UInt index = FT_Get_Char_Index(font->face, character);
    if (FT_Load_Glyph(font->face, index, FT_LOAD_NO_SCALE | FT_LOAD_NO_BITMAP) != 0)
        return;
    FT_GlyphSlot slot = font->face->glyph;
    glyph->advance = (double)slot->advance.x / em(font);
    if (slot->format != FT_GLYPH_FORMAT_OUTLINE)
        return;
    tracer t = {.font = font, .arena = arena, .glyph = glyph};
    FT_Outline_Decompose(&slot->outline, &functions, &t);
    if (glyph->point_count)
        end_contour(&t);
}
