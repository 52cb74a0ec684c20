/* The GLSL front end (glslang), behind one file: validation and counting. No GL, no context. */
#ifndef PLR_ENGINE_GLSL_H
#define PLR_ENGINE_GLSL_H

#include <plugray/plugs.h>

/* One message of a compiler about a line of the text that it was given. */
typedef struct plr_glsl_message {
    plr_severity severity; /* PLR_ERROR or PLR_WARNING */
    uint32_t line;         /* from 1; 0: no line */
    uint32_t column;       /* from 1; 0: not given */
    const char *text;      /* one line, as the compiler worded it, without place and severity */
    const char *word;      /* the name that the message is about ('densty'), or NULL */
} plr_glsl_message;

typedef struct plr_glsl_messages {
    plr_glsl_message *items;
    size_t count;
} plr_glsl_messages;

/* Parses (and if every text parses, links) the stages; texts[stage] may be NULL. All errors are
 * asked for, not only the first. `messages[stage]` are in order of lines; those of linking the
 * stages are in `link`. True if all is well. Free the messages with plr_glsl_messages_free.
 * Thread-safe. */
bool plr_glsl_check(const char *const texts[PLR_STAGE_COUNT],
                    plr_glsl_messages messages[PLR_STAGE_COUNT], plr_glsl_messages *link);
void plr_glsl_messages_free(plr_glsl_messages *messages);

/* Reads a driver's info log (Mesa "0:7(12): error: ...", NVIDIA "0(7) : error C1008: ...", glslang
 * "ERROR: 0:7: 'x' : ...") into messages; lines that fit no form become messages without a line. */
void plr_glsl_parse_log(const char *log, plr_glsl_messages *messages);

/* Instructions and texture fetches in the functions of the text, counted in optimised SPIR-V where
 * glslang can optimise. False if the text does not compile. */
bool plr_glsl_count(const char *text, plr_stage stage, uint32_t *instructions, uint32_t *fetches);

/* Visits the same fetches one by one: the line of the text where each stands (0: not known) and the
 * name of the uniform that it reads (NULL: not known), which is gone after the visit. */
bool plr_glsl_fetches(const char *text, plr_stage stage,
                      void (*visit)(void *user, uint32_t line, const char *sampler), void *user);

#endif
