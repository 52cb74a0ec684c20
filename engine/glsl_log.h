/* Lists of compiler messages, inside. */
#ifndef PLR_ENGINE_GLSL_LOG_H
#define PLR_ENGINE_GLSL_LOG_H

#include "engine/glsl.h"

/* Adds a copy of `message` with that text and word (may be NULL). False without memory. */
bool plr_glsl_messages_add(plr_glsl_messages *messages, const plr_glsl_message *message,
                           const char *text, size_t length, const char *word, size_t word_length);
/* Sorts by line; messages of one line keep their order. */
void plr_glsl_messages_sort(plr_glsl_messages *messages);
/* Whether the text keeps to the limits of nesting and length below which compilers do not run out
 * of stack; adds a message if not. */
bool plr_glsl_check_limits(const char *text, plr_glsl_messages *messages);

#endif
