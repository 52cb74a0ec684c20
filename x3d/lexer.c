#include "x3d/text.h"

#include <string.h>

/* What a byte may be part of. */
enum {
    BLANK = 1,
    IN_WORD = 2,
    FIRST_OF_WORD = 4,
    OF_NUMBER = 8,
    DELIMITER = 16
};

static unsigned class_of(int c) {
    if (c < 0)
        return DELIMITER;
    if (c <= ' ' || c == ',')
        return BLANK | DELIMITER;
    if (c >= '0' && c <= '9')
        return IN_WORD | OF_NUMBER;
    if (c == '+' || c == '-')
        return IN_WORD | OF_NUMBER;
    if (c == '.')
        return OF_NUMBER;
    if (strchr("\"#[]{}", c))
        return DELIMITER;
    if (strchr("'\\\x7f", c))
        return 0;
    return IN_WORD | FIRST_OF_WORD;
}

void x3d_lexer_init(x3d_lexer *lexer, const x3d_view *view, bool comments) {
    *lexer = (x3d_lexer){view, view->text, view->length, 0, comments};
}

int x3d_lexer_next(x3d_lexer *lexer) {
    while (lexer->at < lexer->length) {
        unsigned char c = (unsigned char)lexer->text[lexer->at];
        if (c == '#' && lexer->comments) {
            const char *end = memchr(lexer->text + lexer->at, '\n', lexer->length - lexer->at);
            lexer->at = end ? (size_t)(end - lexer->text) : lexer->length;
        } else if (c <= ' ' || c == ',') {
            lexer->at++;
        } else {
            return c;
        }
    }
    return -1;
}

plr_place x3d_lexer_place(const x3d_lexer *lexer) {
    return x3d_view_place(lexer->view, lexer->at);
}

bool x3d_lexer_peek_word(x3d_lexer *lexer, x3d_word *word) {
    int c = x3d_lexer_next(lexer);
    if (c < 0 || !(class_of(c) & FIRST_OF_WORD))
        return false;
    size_t end = lexer->at + 1;
    while (end < lexer->length && (class_of((unsigned char)lexer->text[end]) & IN_WORD))
        end++;
    *word = (x3d_word){lexer->text + lexer->at, end - lexer->at, lexer->at};
    return true;
}

bool x3d_lexer_word(x3d_lexer *lexer, x3d_word *word) {
    if (!x3d_lexer_peek_word(lexer, word))
        return false;
    lexer->at += word->length;
    return true;
}

bool x3d_word_is(const x3d_word *word, const char *text) {
    return strlen(text) == word->length && memcmp(word->text, text, word->length) == 0;
}

bool x3d_lexer_accept(x3d_lexer *lexer, char character) {
    if (x3d_lexer_next(lexer) != (unsigned char)character)
        return false;
    lexer->at++;
    return true;
}

bool x3d_lexer_string(x3d_lexer *lexer, size_t *start, size_t *end) {
    size_t i = *start = lexer->at + 1;
    while (i < lexer->length && lexer->text[i] != '"')
        i += lexer->text[i] == '\\' && i + 1 < lexer->length ? 2 : 1;
    bool closed = i < lexer->length;
    *end = i;
    lexer->at = closed ? i + 1 : i;
    return closed;
}

bool x3d_starts_number(int character) {
    return character >= 0 && (class_of(character) & OF_NUMBER);
}

bool x3d_is_delimiter(int character) {
    return class_of(character) & DELIMITER;
}
