#include "plugs/words.h"

#include <string.h>

#define PLR_WORDS_TABLE
#include "words_table.h"

uint16_t plr_word_find(const char *text, size_t length, uint32_t hash) {
    const size_t mask = sizeof word_slots / sizeof word_slots[0] - 1;
    for (size_t slot = hash & mask; word_slots[slot]; slot = (slot + 1) & mask) {
        const plr_word *word = &words[word_slots[slot]];
        if (word->length == length && memcmp(word->text, text, length) == 0)
            return word_slots[slot];
    }
    return PLR_WORD_NONE;
}

const plr_word *plr_word_get(uint16_t word) {
    return &words[word];
}
