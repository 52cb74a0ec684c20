/* A unit as it was read. */
#ifndef PLR_PLUGS_SOURCE_H
#define PLR_PLUGS_SOURCE_H

#include "plugs/items.h"

struct plr_source {
    plr_allocator allocator;
    plr_stage stage;
    plr_origin origin; /* file and breaks are the source's own */
    char *text;
    size_t length;
    uint32_t *lines; /* offsets of line starts, in the text */
    size_t line_count;
    plr_lexed lexed;
    plr_cut cut; /* if the text has no conditionals */
    void *block; /* the arrays of `lexed` and `cut` */
};

/* Where the line of a byte begins: O(log lines). */
size_t plr_source_line_start(const plr_source *source, size_t offset);
/* The place of a byte of the source: O(log lines). */
plr_place plr_source_place(const plr_source *source, size_t offset);
/* The text of a token, less splices; not terminated. */
const char *plr_token_text(const plr_lexed *lexed, const plr_token *token, size_t *length);

#endif
