/* The words of GLSL that the linker treats in a special way; the table is words.def. */
#ifndef PLR_PLUGS_WORDS_H
#define PLR_PLUGS_WORDS_H

#include <stddef.h>
#include <stdint.h>

#include "words_table.h"

enum {
    PLR_WORD_IS_QUALIFIER = 1,
    PLR_WORD_IS_KEYWORD = 2,
    PLR_WORD_IS_BUILTIN = 4,
    PLR_WORD_IS_SINCE = 8,
    PLR_WORD_IS_TEXTURE = 16,
    PLR_WORD_IS_SHADOW = 32,
    PLR_WORD_IS_VARIABLE = 64,
    PLR_WORD_IS_OUTPUT = 128,
    PLR_WORD_IS_INOUT = 256,
    PLR_WORD_IS_INPUT = 512,
    PLR_WORD_IS_NOTHING = 1024,
    PLR_WORD_IS_FUNCTION = 2048
};

#define PLR_WORD_IS_LEGACY                                                                         \
    (PLR_WORD_IS_TEXTURE | PLR_WORD_IS_SHADOW | PLR_WORD_IS_VARIABLE | PLR_WORD_IS_OUTPUT |        \
     PLR_WORD_IS_INPUT | PLR_WORD_IS_NOTHING)

typedef struct plr_word {
    const char *text;
    uint16_t length;
    uint16_t kinds;
    const char *replacement; /* for the legacy kinds */
} plr_word;

/* The word of that spelling (PLR_WORD_...), PLR_WORD_NONE if it is none. */
uint16_t plr_word_find(const char *text, size_t length, uint32_t hash);
const plr_word *plr_word_get(uint16_t word);

#endif
