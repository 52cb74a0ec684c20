/* What the files of the printer share: see print.h. */
#ifndef PLR_PLUGS_PRINTER_H
#define PLR_PLUGS_PRINTER_H

#include "plugs/print.h"

/* Macros that say which of the functions in branches that are kept are there: plr_has_plr3_plug. */
#define PLR_HAS "plr_has_"

/* Text without an origin of its own. */
void plr_put(plr_printer *p, const char *text, size_t length);
/* The text that is to be copied. */
void plr_flush(plr_printer *p);
/* From here on, the program stands for `offset` of `origin`. */
void plr_add_run(plr_printer *p, uint32_t origin, uint32_t offset);
/* What stands between the token before and one at `offset`: comments and splices become blanks. */
void plr_put_gap(plr_printer *p, uint32_t offset);
void plr_end_token(plr_printer *p, const plr_token *token);
void plr_copy_token(plr_printer *p, const plr_token *token);
void plr_replace_token(plr_printer *p, const plr_token *token, const char *text, size_t length);
void plr_drop_token(plr_printer *p, const plr_token *token);
void plr_put_tokens(plr_printer *p, uint32_t first, uint32_t end);

/* respell.c: an identifier with its name in the program. Returns the token to go on with. */
uint32_t plr_print_ident(plr_printer *p, uint32_t token);
uint32_t plr_active_after(const plr_printer *p, uint32_t token);
/* Text that is to follow a token, innermost last. */
void plr_push_closer(plr_printer *p, uint32_t token, const char *text);
void plr_put_closers(plr_printer *p, uint32_t token);

#endif
