/* Text and FontStyle: ISO/IEC 19775-1 15. What it leaves open: `size` is the em of the font; a line
 * reaches from the font's descender to its ascender; `length` and `maxExtent` scale letters along
 * the line; upright letters of vertical text stand in squares of side `size`; letters are neither
 * kerned nor joined. */
#include "engine/font.h"
#include "engine/mesh_internal.h"

#include <math.h>
#include <string.h>

/* More characters in one node are left out. */
#define CHARACTER_LIMIT 20000

typedef enum alignment {
    BEGIN,
    MIDDLE,
    END,
    FIRST
} alignment;

typedef struct line {
    const uint32_t *characters;
    size_t count;
    double length;  /* along the line */
    double stretch; /* of the letters, along the line */
} line;

typedef struct text {
    plr_maker *maker;
    plr_polygons *polygons;
    plr_font *font;
    plr_glyph glyph;
    plr_font_family family;
    bool bold, italic, horizontal, left_to_right, top_to_bottom;
    alignment major, minor;
    double size, step; /* step: from line to line */
    line *lines;
    size_t line_count;
    double origin[2]; /* of the first string: where textures begin */
    struct {
        float *items;
        size_t count, capacity;
    } points, tex;
} text;

/* ---- Reading ---- */

static alignment read_alignment(const char *word, alignment missing) {
    static const char *const words[] = {"BEGIN", "MIDDLE", "END", "FIRST"};
    for (int i = 0; i < 4; i++)
        if (strcmp(word, words[i]) == 0)
            return (alignment)i;
    return missing;
}

static const char *string_at(const plr_node *node, const char *name, size_t i) {
    const plr_field *field = node ? plr_node_field(node, name) : NULL;
    return field && plr_type_kind(field->type) == PLR_STRING && i < field->count
               ? field->value.strings[i].text
               : "";
}

static bool flag(const plr_node *node, const char *name) {
    const plr_field *field = node ? plr_node_field(node, name) : NULL;
    return !field || field->type != PLR_SFBOOL || field->value.bools[0];
}

static double number(const plr_node *node, const char *name, double missing) {
    return node && plr_node_field(node, name) ? plr_node_number(node, name) : missing;
}

/* The first family of the list that there is; the others are names of fonts. */
static plr_font_family read_family(const plr_node *style) {
    static const char *const names[] = {"SERIF", "SANS", "TYPEWRITER"};
    const plr_field *field = style ? plr_node_field(style, "family") : NULL;
    for (size_t i = 0; field && i < field->count; i++)
        for (int k = 0; k < 3; k++)
            if (strcmp(string_at(style, "family", i), names[k]) == 0)
                return (plr_font_family)k;
    return PLR_FONT_SERIF;
}

static void read_style(text *t) {
    const plr_node *style = plr_node_child(t->maker->node, "fontStyle");
    const char *face = style ? plr_node_string(style, "style") : "";
    t->family = read_family(style);
    t->bold = strstr(face, "BOLD") != NULL;
    t->italic = strstr(face, "ITALIC") != NULL;
    t->horizontal = flag(style, "horizontal");
    t->left_to_right = flag(style, "leftToRight");
    t->top_to_bottom = flag(style, "topToBottom");
    t->major = read_alignment(string_at(style, "justify", 0), BEGIN);
    t->minor = read_alignment(string_at(style, "justify", 1), FIRST);
    t->size = number(style, "size", 1);
    t->step = t->size * number(style, "spacing", 1);
}

/* UTF-8, which the reader has checked or not: a byte that fits nowhere counts as a character. */
static uint32_t next_character(const plr_string *s, size_t *at) {
    const unsigned char *bytes = (const unsigned char *)s->text;
    uint32_t first = bytes[(*at)++];
    int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
    uint32_t value = more ? first & (0x3fU >> more) : first;
    for (; more && *at < s->length && (bytes[*at] & 0xc0) == 0x80; more--)
        value = value << 6 | (bytes[(*at)++] & 0x3f);
    return value;
}

static void read_line(text *t, const plr_string *s, size_t *left, line *l) {
    size_t capacity = s->length < *left ? s->length : *left;
    uint32_t *characters = PLR_NEW_ARRAY(t->maker->arena, capacity + 1, uint32_t);
    l->characters = characters;
    for (size_t at = 0; at < s->length && l->count < capacity;) {
        uint32_t character = next_character(s, &at);
        if (character >= 0x20) /* control characters are not seen */
            characters[l->count++] = character;
    }
    *left -= l->count;
}

static void read_lines(text *t) {
    const plr_field *strings = plr_node_field(t->maker->node, "string");
    const plr_field *shown = plr_node_field(t->maker->node, "maxDisplayChars");
    size_t left = CHARACTER_LIMIT;
    bool limited = true;
    if (shown && shown->value.ints[0] >= 0 && (size_t)shown->value.ints[0] < left) {
        left = (size_t)shown->value.ints[0];
        limited = false;
    }
    size_t count = strings ? strings->count : 0;
    if (count > CHARACTER_LIMIT)
        count = CHARACTER_LIMIT;
    t->lines = PLR_NEW_ARRAY(t->maker->arena, count + 1, line);
    for (t->line_count = 0; t->line_count < count && left; t->line_count++)
        read_line(t, &strings->value.strings[t->line_count], &left, &t->lines[t->line_count]);
    if (!left && limited)
        plr_diags_add_as(t->maker->diags, PLR_WARNING, PLR_CODE_BAD_GEOMETRY, strings->place,
                         "only the first %d characters are drawn", CHARACTER_LIMIT);
}

/* ---- Layout ---- */

/* How far the pen moves along the line for the glyph in hand, before stretching. */
static double advance(const text *t) {
    return t->size * (t->horizontal ? t->glyph.advance : 1);
}

static void measure(text *t) {
    const plr_field *lengths = plr_node_field(t->maker->node, "length");
    double longest = 0, most = number(t->maker->node, "maxExtent", 0);
    for (size_t i = 0; i < t->line_count; i++) {
        line *l = &t->lines[i];
        l->stretch = 1;
        for (size_t k = 0; k < l->count; k++) {
            plr_font_glyph(t->font, t->maker->arena, l->characters[k], &t->glyph);
            l->length += advance(t);
        }
        double wanted = lengths && i < lengths->count ? (double)lengths->value.floats[i] : 0;
        if (wanted > 0 && l->length > 0) {
            l->stretch = wanted / l->length;
            l->length = wanted;
        }
        longest = fmax(longest, l->length);
    }
    for (size_t i = 0; most > 0 && longest > most && i < t->line_count; i++) {
        t->lines[i].stretch *= most / longest;
        t->lines[i].length *= most / longest;
    }
}

/* Where the first line lies across the lines, counted in the direction in which lines follow:
 * `before` and `after` is how far a line reaches against and along that direction. */
static double across(const text *t, double before, double after, bool first_is_begin) {
    double rest = (double)(t->line_count - 1) * t->step;
    switch (t->minor) {
    case FIRST:
        return first_is_begin ? before : 0;
    case BEGIN:
        return before;
    case MIDDLE:
        return (before - after - rest) / 2;
    case END:
        break;
    }
    return -after - rest;
}

static double along(const text *t, const line *l) {
    return t->major == MIDDLE ? -l->length / 2 : t->major == END ? -l->length : 0;
}

/* Where the glyph in hand goes whose square or advance begins `pen` along the line. */
static void place(const text *t, const line *l, size_t number_of_line, double pen, double at[2]) {
    double up = plr_font_ascender(t->font) * t->size, down = plr_font_descender(t->font) * t->size;
    double lines = (double)number_of_line * t->step, moved = advance(t) * l->stretch;
    if (t->horizontal) {
        double y = t->top_to_bottom ? across(t, up, -down, false) : across(t, -down, up, false);
        at[0] = t->left_to_right ? pen : -pen - moved;
        at[1] = t->top_to_bottom ? -(y + lines) : y + lines;
    } else {
        double x = across(t, 0, t->size, true) + lines;
        double left = t->left_to_right ? x : -x - t->size;
        double middle = t->top_to_bottom ? -pen - moved / 2 : pen + moved / 2;
        at[0] = left + (t->size - t->size * t->glyph.advance) / 2;
        at[1] = middle - (up + down) / 2 * l->stretch;
    }
}

/* ---- Glyphs ---- */

static void add_glyph(text *t, const line *l, const double at[2]) {
    plr_glyph *g = &t->glyph;
    double scale[2] = {t->size, t->size};
    scale[t->horizontal ? 0 : 1] *= l->stretch;
    uint32_t first = (uint32_t)(t->points.count / 3);
    plr_polygons_add_outline(t->polygons, g->points, g->ends, g->contour_count, first);
    for (size_t i = 0; i < g->point_count; i++) {
        double tex[4] = {0, 0, 0, 1};
        for (int k = 0; k < 3; k++) {
            double value = k < 2 ? at[k] + g->points[i][k] * scale[k] : 0;
            *PLR_PUSH(t->maker->arena, &t->points) = (float)value;
            /* 15.4.2: the texture begins at the origin of the first string; 1 is the font's size */
            tex[k] = k < 2 ? (value - t->origin[k]) / t->size : 0;
        }
        for (int k = 0; k < 4; k++)
            *PLR_PUSH(t->maker->arena, &t->tex) = (float)tex[k];
    }
}

static void add_lines(text *t) {
    bool begun = false;
    for (size_t i = 0; i < t->line_count; i++) {
        const line *l = &t->lines[i];
        double pen = along(t, l);
        for (size_t k = 0; k < l->count; k++) {
            double at[2];
            plr_font_glyph(t->font, t->maker->arena, l->characters[k], &t->glyph);
            place(t, l, i, pen, at);
            if (!begun)
                memcpy(t->origin, at, sizeof at);
            begun = true;
            add_glyph(t, l, at);
            pen += advance(t) * l->stretch;
        }
    }
}

static bool open_font(text *t) {
    t->font = t->maker->font = plr_font_open(t->maker->font_folders, t->family, t->bold, t->italic);
    if (!t->font)
        plr_diags_add(t->maker->diags, PLR_CODE_MISSING_FONT, plr_node_place(t->maker->node),
                      "the DejaVu fonts are not installed; the text is not drawn");
    return t->font != NULL;
}

bool plr_make_text(plr_maker *maker) {
    static const float normal[3] = {0, 0, 1};
    plr_polygons polygons = {.arena = maker->arena,
                             .node = maker->node,
                             .diags = maker->diags,
                             .kind = PLR_MESH_TRIANGLES,
                             .concave = true,
                             .normals = normal,
                             .tex_given = plr_node_child(maker->node, "texCoord") != NULL};
    text t = {.maker = maker, .polygons = &polygons};
    read_style(&t);
    read_lines(&t);
    if (!t.line_count || !(t.size > 0) || !open_font(&t))
        return false;
    measure(&t);
    add_lines(&t);
    polygons.points = t.points.items;
    polygons.point_count = (uint32_t)(t.points.count / 3);
    polygons.tex_coords[0] = t.tex.items;
    polygons.tex_counts[0] = polygons.point_count;
    return polygons.faces.count && plr_polygons_emit(&polygons, maker->mesh);
}
