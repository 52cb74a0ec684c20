/* Cuts a unit at file scope into items: functions, variables, structs, macros, and what is none. */
#ifndef PLR_PLUGS_ITEMS_H
#define PLR_PLUGS_ITEMS_H

#include "plugs/lexer.h"

typedef enum plr_item_kind {
    PLR_ITEM_KEPT, /* not recognised, or without a name: kept as it is, in its place */
    PLR_ITEM_FUNCTION,
    PLR_ITEM_PROTOTYPE,
    PLR_ITEM_VARIABLE,    /* one declarator of a declaration */
    PLR_ITEM_STRUCT,      /* with the variables declared behind it, if any */
    PLR_ITEM_BLOCK,       /* an interface block */
    PLR_ITEM_MACRO,       /* #define and #undef */
    PLR_ITEM_PRECISION,   /* a default precision */
    PLR_ITEM_GROUP,       /* a conditional that cannot be evaluated, with all its branches */
    PLR_ITEM_DECLARATIONS /* PLUG-DECLARATIONS */
} plr_item_kind;

enum {
    PLR_Q_UNIFORM = 1,
    PLR_Q_IN = 2,
    PLR_Q_OUT = 4,
    PLR_Q_CONST = 8,
    PLR_Q_VARYING = 16,
    PLR_Q_ATTRIBUTE = 32,
    PLR_Q_BUFFER = 64
};

/* A name that an item declares. */
typedef struct plr_name {
    uint32_t token;
    uint8_t kind; /* plr_item_kind */
    uint8_t qualifiers;
    uint16_t parameters;  /* of a function */
    uint32_t open, close; /* of a function: its parentheses */
    uint32_t type;        /* the token before a function's name; the first of a variable's type */
    bool inner;           /* declared within: a macro of a body, a declaration in a group */
    bool inner_body;      /* a macro defined inside a body */
} plr_name;

typedef struct plr_item {
    uint8_t kind;
    uint32_t prefix, prefix_end; /* of a variable: the part that its declarators share */
    uint32_t first, end;         /* its own tokens; of a variable without the `;` */
    uint32_t names, name_count;  /* in plr_cut.names; the first is the item's own */
    uint32_t plugs, plug_count;  /* in plr_cut.plugs */
    uint32_t body;               /* of a struct or block: its `{`; of a function: its `{` */
} plr_item;

/* The conditionals of one use of a unit, evaluated. */
typedef struct plr_activity {
    /* By directive: the token at which the text goes on, and whether the line itself is kept. */
    const uint32_t *next;
    const uint8_t *kept;     /* plr_kept */
    const uint32_t *skipped; /* by directive: the one up to which text is left out; 0: none is */
} plr_activity;

typedef enum plr_kept {
    PLR_KEPT_NO,
    PLR_KEPT_AS_IS, /* #define, #pragma, ... */
    PLR_KEPT_IF,    /* printed as #if, #ifdef, #ifndef */
    PLR_KEPT_ELIF,
    PLR_KEPT_ELSE,
    PLR_KEPT_ENDIF
} plr_kept;

typedef struct plr_cut {
    PLR_LIST(plr_item) items;
    PLR_LIST(plr_name) names;
    PLR_LIST(uint32_t) plugs;                /* active ones, in text order */
    PLR_LIST(uint32_t) versions, extensions; /* active directives */
    PLR_LIST(plr_fault) faults, warnings;
} plr_cut;

void plr_cut_items(plr_arena *arena, const plr_lexed *lexed, const plr_activity *activity,
                   plr_cut *cut);

/* The first active token at or after `i` that is no directive, plug or mark. */
uint32_t plr_active(const plr_lexed *lexed, const plr_activity *activity, uint32_t i);

#endif
