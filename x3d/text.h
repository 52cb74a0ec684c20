/* Texts of files, and from which place of which file every byte of a decoded text came. */
#ifndef PLR_X3D_TEXT_H
#define PLR_X3D_TEXT_H

#include <plugray/x3d.h>
#include "base/arena.h"

/* One file that was read: kept as long as the scene, for messages. */
typedef struct x3d_file {
    struct x3d_file *next;
    const char *name;   /* as messages give it */
    const char *folder; /* absolute; where the relative urls of the file start */
    const char *real;   /* real path; NULL for text from memory */
    const char *text;   /* unpacked, UTF-8 */
    size_t length;
    bool decoded;         /* the text was brought from another encoding to UTF-8 */
    char *owned;          /* the block of the text, of x3d_block_new, or NULL */
    const char *attached; /* bytes behind the text, in the same block, or NULL */
    size_t attached_length;
    const size_t *lines; /* offset of the start of each line */
    size_t line_count;
    size_t line_hint;
} x3d_file;

/* From offset `at` of a decoded text on, the bytes stand at offset `raw` of the file. */
typedef struct x3d_span {
    size_t at, raw;
} x3d_span;

/* A text with its way back to the file. */
typedef struct x3d_view {
    x3d_file *file;
    const char *text;
    size_t length;
    size_t base;           /* raw offset of byte 0 where there are no spans */
    const x3d_span *spans; /* sorted; the first one is at 0 */
    size_t span_count;
    const plr_place *fixed; /* not NULL: every byte stands here (text that is in no file) */
} x3d_view;

/* Fills in the table of lines. */
void x3d_file_index(plr_arena *arena, x3d_file *file);
plr_place x3d_file_place(x3d_file *file, size_t offset);
plr_place x3d_view_place(const x3d_view *view, size_t offset);

enum {
    X3D_ESCAPES = 1,
    X3D_BLANK_NEWLINES = 2
};
/* Bytes [start, end) of a view as a string of its own. X3D_ESCAPES: \" and \\ stand for " and \;
 * X3D_BLANK_NEWLINES: newlines become blanks. */
plr_string x3d_view_string(plr_arena *arena, const x3d_view *view, size_t start, size_t end,
                           unsigned flags);
/* The rest of a string from byte `offset` on. */
plr_string x3d_string_tail(plr_arena *arena, const plr_string *string, size_t offset);

/* Reading tokens from a view. Commas are blanks; so are comments, in Classic VRML. */
typedef struct x3d_lexer {
    const x3d_view *view;
    const char *text;
    size_t length, at;
    bool comments;
} x3d_lexer;

void x3d_lexer_init(x3d_lexer *lexer, const x3d_view *view, bool comments);
/* Skips blanks and comments; the next character, or -1 at the end. */
int x3d_lexer_next(x3d_lexer *lexer);
plr_place x3d_lexer_place(const x3d_lexer *lexer);

typedef struct x3d_word {
    const char *text;
    size_t length, at;
} x3d_word;

/* Reads an identifier; false (and nothing is read) if there is none. */
bool x3d_lexer_word(x3d_lexer *lexer, x3d_word *word);
/* The same, but leaves it unread. */
bool x3d_lexer_peek_word(x3d_lexer *lexer, x3d_word *word);
bool x3d_word_is(const x3d_word *word, const char *text);
/* Reads this one character if it is next. */
bool x3d_lexer_accept(x3d_lexer *lexer, char character);
/* Finds the end of the string that begins at the next character, a quote: [*start, *end) is what
 * stands inside. False if it is never closed (then the rest of the text is the string). */
bool x3d_lexer_string(x3d_lexer *lexer, size_t *start, size_t *end);
/* Whether a number may begin with this character. */
bool x3d_starts_number(int character);
/* Whether a word, number or string ends before this character. */
bool x3d_is_delimiter(int character);

/* Numbers in the C notation, whatever the locale: how many bytes they take, 0: there is none. */
size_t x3d_parse_number(const char *text, size_t length, double *value);
/* Decimal or 0x; `*value` is beyond 64 bits clamped. */
size_t x3d_parse_integer(const char *text, size_t length, int64_t *value);

#endif
