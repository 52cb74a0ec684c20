/* A linked program: the texts and what is known about them. */
#ifndef PLR_PLUGS_PROGRAM_H
#define PLR_PLUGS_PROGRAM_H

#include "plugs/compose.h"

typedef struct plr_composed {
    const char *text; /* NULL: the base has no such stage */
    size_t length;
    const plr_run *runs;
    size_t run_count;
    const plr_written_call *calls;
    const uint32_t *lines; /* offsets of line starts */
    uint32_t line_count;
} plr_composed;

struct plr_program {
    plr_allocator allocator;
    plr_arena arena; /* everything but the rounds */
    plr_arena pass;  /* the last round */
    plr_linking linking;
    plr_composed stages[PLR_STAGE_COUNT];
    const plr_unit **units; /* by number */
    PLR_LIST(plr_plug_info) plugs;
    PLR_LIST(plr_symbol) symbols;
};

/* The socket call that stands at an offset of the text; NULL: something else does. */
const plr_written_call *plr_call_at(const plr_composed *stage, size_t offset);

/* symbols.c */
void plr_list_symbols(plr_program *program);

#endif
