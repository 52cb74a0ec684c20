/* Builds programs beside the drawing: on a thread of its own where a context that shares with the
 * engine's can be had, else one at a time when somebody has time for it. */
#ifndef PLR_ENGINE_BUILDER_H
#define PLR_ENGINE_BUILDER_H

#include <plugray/engine.h>
#include "engine/gl.h"

typedef struct plr_builder plr_builder;

typedef enum plr_building {
    PLR_BUILDING_WAITS, /* or is at work */
    PLR_BUILDING_DONE,
    PLR_BUILDING_FAILED /* the texts do not compile: whoever wants to know why compiles them */
} plr_building;

/* `make_current` as in plr_engine_desc, or NULL. NULL without memory. */
plr_builder *plr_builder_create(const plr_gl *gl, bool (*make_current)(void *user, bool current),
                                void *user);
/* Ends the thread after the program that is at work. Programs that it has drawn must not have been
 * deleted yet: Mesa finds what its context has of them by their names, and else leaves it to the
 * other contexts, who then reach for a context that is gone. Needs GL. */
void plr_builder_destroy(plr_builder **builder);
/* What has become of these texts (texts[stage] may be NULL), which are copied; asks for them where
 * that is new. The program of those that are done is the caller's, who is told of it once. */
plr_building plr_builder_ask(plr_builder *builder, const char *const texts[PLR_STAGE_COUNT],
                             GLuint *program);
/* Waits until nothing waits any more, or so long; without a thread, builds one program. How many
 * still wait. Needs GL. */
size_t plr_builder_wait(plr_builder *builder, double wait_ms);
size_t plr_builder_waiting(plr_builder *builder);

#endif
