/* GLSL text to tokens. Comments vanish (they are gaps between tokens), except the two magic ones.
 */
#ifndef PLR_PLUGS_LEXER_H
#define PLR_PLUGS_LEXER_H

#include "base/arena.h"
#include "plugs/words.h"

#include <plugray/plugs.h>

/* Kinds of token; every other value is the character of a punctuation. */
enum {
    PLR_T_END,
    PLR_T_IDENT,
    PLR_T_NUMBER,
    PLR_T_DIRECTIVE,    /* value: the directive; its tokens follow, up to directive.end */
    PLR_T_PLUG,         /* value: the plug; its tokens follow, up to plug.end */
    PLR_T_DECLARATIONS, /* PLUG-DECLARATIONS */
    PLR_T_OTHER = 127   /* a byte that GLSL does not know; a string of a preprocessor line */
};

enum {
    PLR_TF_GAP = 1,      /* a comment, a splice or a carriage return stands before it */
    PLR_TF_SPLICED = 2,  /* its text is not contiguous: the identifier has it */
    PLR_TF_MEMBER = 4,   /* stands after a dot */
    PLR_TF_PLAIN = 8,    /* a member's declarator or a layout key: no name of a scope */
    PLR_TF_PARAM = 16,   /* a parameter of the #define that it stands in */
    PLR_TF_LOCAL = 32,   /* a parameter or variable of the function that it stands in */
    PLR_TF_NEWLINE = 64, /* the first of its line */
    PLR_TF_DROP = 128    /* one of two storage qualifiers that do not go together */
};

#define PLR_NONE UINT32_MAX

typedef struct plr_token {
    uint32_t offset, length;
    /* identifier; match of a bracket (PLR_NONE: none); directive; plug; spliced number: identifier
     */
    uint32_t value;
    uint8_t kind, flags;
    uint16_t count; /* of `(`: the arguments up to its match, saturated */
} plr_token;

enum {
    PLR_IF_PLUG = 1,      /* begins with PLUG_ and goes on */
    PLR_IF_CASTLE = 2,    /* begins with castle_ */
    PLR_IF_RESERVED = 4,  /* plr[0-9]+u?_... */
    PLR_IF_GL = 8,        /* gl_... */
    PLR_IF_PLUGRAY = 16,  /* plugray_... */
    PLR_IF_DECLARED = 32, /* a word reserved since, declared as a name somewhere in the text */
    PLR_IF_MEMBER = 64    /* stands after a dot, or names a member, somewhere in the text */
};

typedef struct plr_ident {
    const char *text; /* not terminated */
    uint32_t length, hash;
    uint16_t word; /* PLR_WORD_... */
    uint8_t flags;
} plr_ident;

typedef enum plr_directive_kind {
    PLR_D_OTHER, /* kept as it is: #pragma, #error, what is not known */
    PLR_D_DROP,  /* #line, the empty directive */
    PLR_D_IF,
    PLR_D_IFDEF,
    PLR_D_IFNDEF,
    PLR_D_ELIF,
    PLR_D_ELSE,
    PLR_D_ENDIF,
    PLR_D_DEFINE,
    PLR_D_UNDEF,
    PLR_D_VERSION,
    PLR_D_EXTENSION
} plr_directive_kind;

typedef struct plr_directive {
    plr_directive_kind kind;
    uint32_t token, end; /* its PLR_T_DIRECTIVE and the token after its last */
    uint32_t next;       /* of a branch: the directive of the next one or #endif */
    uint32_t endif;      /* of a branch: its #endif */
} plr_directive;

/* One argument list of a plug: the tokens between its parentheses. */
typedef struct plr_list {
    uint32_t first, end, count;
} plr_list;

typedef struct plr_plug {
    uint32_t token, end;           /* its PLR_T_PLUG and the token after its last */
    uint32_t offset, length;       /* of the comment */
    uint32_t name;                 /* identifier: the name alone */
    uint32_t lists, list_count;    /* in plr_lexed.lists */
    uint32_t text_begin, text_end; /* the lists as written */
} plr_plug;

/* A PLUG-PROMISE comment; what it says is read by each link that uses it (promise.c). */
typedef struct plr_promise_comment {
    uint32_t offset;        /* of the comment */
    uint32_t words, end;    /* what stands behind its colon, up to the comment's end */
    const char *counts_not; /* why it cannot count; NULL: it can */
} plr_promise_comment;

/* What was wrong with a text, at an offset. */
typedef struct plr_fault {
    plr_code code;
    uint32_t offset;
    const char *message;
} plr_fault;

#define PLR_LIST(type)                                                                             \
    struct {                                                                                       \
        type *items;                                                                               \
        size_t count, capacity;                                                                    \
    }

typedef struct plr_lexed {
    const char *text;
    uint32_t length;
    PLR_LIST(plr_token) tokens; /* ends with PLR_T_END */
    PLR_LIST(plr_ident) idents;
    PLR_LIST(plr_directive) directives;
    PLR_LIST(plr_plug) plugs;
    PLR_LIST(plr_list) lists;
    PLR_LIST(plr_promise_comment) promises;
    PLR_LIST(plr_fault) faults; /* errors: the unit cannot be used */
    PLR_LIST(plr_fault) warnings;
    bool conditional; /* has #if and the like */
    bool dynamic;     /* asks PLUG_USED or READS */
    bool reserved;    /* has an identifier that the linker keeps for itself */
} plr_lexed;

/* Splits `text` (NUL-terminated, less than 4 GiB) into tokens; everything is allocated in `arena`,
 * but the text of words that a splice interrupts, which goes to `spare` (room for `length` bytes).
 */
void plr_lex(plr_arena *arena, const char *text, size_t length, char *spare, plr_lexed *lexed);
/* The hash of identifiers and words: FNV-1a. */
uint32_t plr_hash(const char *text, size_t length);

#endif
