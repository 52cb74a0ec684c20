/* What can be told of tokens without knowing which conditionals hold: brackets, members, locals. */
#ifndef PLR_PLUGS_MARK_H
#define PLR_PLUGS_MARK_H

#include "plugs/lexer.h"

/* Matches brackets, counts arguments, and sets PLR_TF_PLAIN and PLR_TF_LOCAL. */
void plr_mark(plr_arena *arena, plr_lexed *lexed);

/* Calls `found` for each member's declarator between the braces `open` and `close`. */
typedef void plr_member_function(void *user, uint32_t token);
void plr_each_member(const plr_lexed *lexed, uint32_t open, uint32_t close,
                     plr_member_function *found, void *user);

#endif
