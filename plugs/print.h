/* Writes text of units into a program, with new names and a map back. */
#ifndef PLR_PLUGS_PRINT_H
#define PLR_PLUGS_PRINT_H

#include "plugs/link.h"

/* Where a part of the text comes from, up to the next run. */
typedef struct plr_run {
    uint32_t out;    /* offset in the program */
    uint32_t origin; /* unit, PLR_RUN_OWN, or PLR_RUN_CALL + index of a call */
    uint32_t offset; /* in the unit's text; with PLR_RUN_FIXED all of the run stands for it */
} plr_run;

#define PLR_RUN_CALL 0x80000000u
#define PLR_RUN_OWN 0x7fffffffu
#define PLR_RUN_FIXED 0x80000000u

/* A socket call in the text. */
typedef struct plr_written_call {
    const plr_socket *socket;
    const plr_function *function;
} plr_written_call;

typedef struct plr_closer {
    uint32_t token; /* after which */
    const char *text;
} plr_closer;

typedef struct plr_printer {
    plr_linking *l;
    PLR_LIST(char) out;
    PLR_LIST(plr_run) runs;
    PLR_LIST(plr_written_call) calls;
    plr_node *node; /* whose text it is */
    plr_unit *unit;
    uint32_t begin, end; /* text of the unit that is to be copied next */
    uint32_t last;       /* end of the token before */
    bool fresh;          /* nothing of the range was printed yet */
    bool broken;         /* text was skipped since the token before */
    uint8_t before;      /* kind of the token before */
    uint32_t last_token; /* the token before */
    plr_socket *inside;  /* a plug whose calls come after the next token of kind inside_of */
    uint8_t inside_of;
    uint32_t body; /* the token behind which a gate is asked; PLR_NONE: none is */
    plr_closer closers[32];
    unsigned closer_count;
} plr_printer;

/* Text of the linker's own. */
void plr_print_own(plr_printer *p, const char *text);
void plr_print_newline(plr_printer *p); /* unless a line begins here */
/* The tokens from `first` to `end` of the node's unit. */
void plr_print_range(plr_printer *p, plr_node *node, uint32_t first, uint32_t end);
/* The directives of a kept group alone: its #extension lines and the conditionals around them. */
void plr_print_extensions(plr_printer *p, plr_node *node);
/* Text that belongs to the run before, and the end of the line. */
void plr_print_line_end(plr_printer *p, const char *text);

#endif
