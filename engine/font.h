/* Outlines of the glyphs of three typefaces: the DejaVu fonts, wherever the system keeps them. No
 * GL, no state: a font is a file that is open. */
#ifndef PLR_ENGINE_FONT_H
#define PLR_ENGINE_FONT_H

#include "base/arena.h"

typedef enum plr_font_family {
    PLR_FONT_SERIF,
    PLR_FONT_SANS,
    PLR_FONT_TYPEWRITER
} plr_font_family;

typedef struct plr_font plr_font;

/* All measures in em: the nominal height of the font is 1. */
typedef struct plr_glyph {
    double advance;
    double (*points)[2];  /* of all contours, curves cut into straight pieces */
    uint32_t *ends;       /* where each contour ends: one past its last point */
    size_t contour_count; /* 0: nothing to be seen (a blank) */
    size_t point_count, point_capacity, end_capacity; /* of the arrays */
} plr_glyph;

/* `folders`: where to look, NULL at the end; NULL: where systems keep fonts. A slanted face that is
 * not there is made of the upright one. NULL if there is no such font. */
plr_font *plr_font_open(const char *const *folders, plr_font_family family, bool bold, bool italic);
void plr_font_close(plr_font *font);
/* How far lines reach above and (negative) below their baseline. */
double plr_font_ascender(const plr_font *font);
double plr_font_descender(const plr_font *font);
/* The glyph of a Unicode character, a box where the font has none. Its arrays are the arena's;
 * those of an earlier glyph may be handed in and are used again. */
void plr_font_glyph(plr_font *font, plr_arena *arena, uint32_t character, plr_glyph *glyph);

#endif
