#include "engine/gpu_timer.h"

#include <ctype.h>
#include <string.h>

/* Whether `text` has `word`, which is in small letters. */
static bool has_word(const char *text, const char *word) {
    size_t length = strlen(word);
    for (; *text; text++) {
        size_t i = 0;
        while (i < length && tolower((unsigned char)text[i]) == word[i])
            i++;
        if (i == length)
            return true;
    }
    return false;
}

bool plr_renderer_is_software(const char *renderer) {
    static const char *const words[] = {"llvmpipe", "softpipe", "swrast",     "swr ",
                                        "software", "lavapipe", "swiftshader"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (has_word(renderer, words[i]))
            return true;
    return false;
}

bool plr_gpu_timer_create(plr_gpu_timer *timer, const plr_gl *gl) {
    const char *renderer = (const char *)gl->GetString(GL_RENDERER);
    GLint bits = 0;
    *timer = (plr_gpu_timer){0};
    gl->GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
    if (!renderer || plr_renderer_is_software(renderer) || bits == 0)
        return false;
    gl->GenQueries(2, timer->queries);
    return true;
}

void plr_gpu_timer_start(plr_gpu_timer *timer, const plr_gl *gl) {
    gl->QueryCounter(timer->queries[0], GL_TIMESTAMP);
}

void plr_gpu_timer_stop(plr_gpu_timer *timer, const plr_gl *gl) {
    gl->QueryCounter(timer->queries[1], GL_TIMESTAMP);
}

void plr_gpu_timer_add(plr_gpu_timer *timer, const plr_gl *gl) {
    GLuint64 times[2] = {0};
    for (int i = 0; i < 2; i++)
        gl->GetQueryObjectui64v(timer->queries[i], GL_QUERY_RESULT, &times[i]);
    timer->ms += 1e-6 * (double)(times[1] - times[0]);
}

void plr_gpu_timer_destroy(plr_gpu_timer *timer, const plr_gl *gl) {
    gl->DeleteQueries(2, timer->queries);
    *timer = (plr_gpu_timer){0};
}
