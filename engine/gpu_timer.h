/* Time by the GPU's own clock. Needs GL. */
#ifndef PLR_ENGINE_GPU_TIMER_H
#define PLR_ENGINE_GPU_TIMER_H

#include "engine/gl.h"

typedef struct plr_gpu_timer {
    GLuint queries[2]; /* timestamps, which unlike spans of time may overlap those of a host */
    double ms;         /* of all spans since it was made */
} plr_gpu_timer;

/* Whether what GL calls its renderer draws on processors, so that there is no GPU to ask. */
bool plr_renderer_is_software(const char *renderer);

/* False where there is no GPU: then the others must not be called. */
bool plr_gpu_timer_create(plr_gpu_timer *timer, const plr_gl *gl);
void plr_gpu_timer_start(plr_gpu_timer *timer, const plr_gl *gl);
void plr_gpu_timer_stop(plr_gpu_timer *timer, const plr_gl *gl);
/* Adds the span to `ms`; waits until the GPU has done what came before the stop. */
void plr_gpu_timer_add(plr_gpu_timer *timer, const plr_gl *gl);
void plr_gpu_timer_destroy(plr_gpu_timer *timer, const plr_gl *gl);

#endif
