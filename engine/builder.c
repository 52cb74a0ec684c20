#include "engine/builder.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "engine/cache.h"

typedef struct job {
    char *texts[PLR_STAGE_COUNT];
    plr_building state;
    GLuint program;
    struct job *next;
} job;

struct plr_builder {
    const plr_gl *gl;
    bool (*make_current)(void *user, bool current);
    void *user;
    pthread_t thread;
    bool threaded; /* there is a thread, with a context */
    bool at_work;  /* somebody builds the first of the jobs that wait */
    bool ends;
    pthread_mutex_t lock; /* of all that follows and of the states of jobs */
    pthread_cond_t changed;
    job *jobs; /* in the order in which they were asked for */
    size_t waiting;
};

/* ---- Jobs ---- */

static void free_job(job *j) {
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
        free(j->texts[stage]);
    free(j);
}

static bool is_for(const job *j, const char *const texts[PLR_STAGE_COUNT]) {
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
        if (!texts[stage] != !j->texts[stage] ||
            (texts[stage] && strcmp(texts[stage], j->texts[stage]) != 0))
            return false;
    return true;
}

static job *make_job(const char *const texts[PLR_STAGE_COUNT]) {
    job *j = calloc(1, sizeof *j);
    bool fine = j != NULL;
    for (int stage = 0; fine && stage < PLR_STAGE_COUNT; stage++) {
        size_t size = texts[stage] ? strlen(texts[stage]) + 1 : 0;
        j->texts[stage] = size ? malloc(size) : NULL;
        fine = !size || j->texts[stage];
        if (size && fine)
            memcpy(j->texts[stage], texts[stage], size);
    }
    if (fine)
        return j;
    if (j)
        free_job(j);
    return NULL;
}

/* ---- Building ---- */

/* Many drivers compile for good only when something is drawn: here nothing is, in one pixel. */
static void draw_nothing(const plr_gl *gl, GLuint program) {
    GLuint framebuffer, color, array;
    gl->GenFramebuffers(1, &framebuffer);
    gl->GenRenderbuffers(1, &color);
    gl->GenVertexArrays(1, &array);
    gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->BindRenderbuffer(GL_RENDERBUFFER, color);
    gl->RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, 1, 1);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    gl->Viewport(0, 0, 1, 1);
    gl->Enable(GL_SCISSOR_TEST);
    gl->Scissor(0, 0, 0, 0);
    gl->BindVertexArray(array);
    gl->UseProgram(program);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->UseProgram(0);
    gl->DeleteVertexArrays(1, &array);
    gl->DeleteRenderbuffers(1, &color);
    gl->DeleteFramebuffers(1, &framebuffer);
}

static GLuint build(const plr_gl *gl, const job *j, bool draws) {
    plr_glsl_messages messages[PLR_STAGE_COUNT] = {{0}}, link = {0};
    const char *texts[PLR_STAGE_COUNT];
    GLuint program = 0;
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
        texts[stage] = j->texts[stage];
    for (int round = 0; round < 2; round++) { /* as plr_compose_program asks: glslang, the driver */
        bool fine = round ? (program = plr_cache_build(gl, texts, messages, &link)) != 0
                          : plr_glsl_check(texts, messages, &link);
        for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
            plr_glsl_messages_free(&messages[stage]);
        plr_glsl_messages_free(&link);
        if (!fine)
            return 0;
    }
    if (draws)
        draw_nothing(gl, program);
    gl->Finish(); /* then other contexts may use it */
    return program;
}

/* The first job that waits, built; the lock is held before and after. */
static void build_next(plr_builder *b, bool draws) {
    job *j = b->jobs;
    while (j && j->state != PLR_BUILDING_WAITS)
        j = j->next;
    if (!j)
        return;
    b->at_work = true;
    pthread_mutex_unlock(&b->lock);
    GLuint program = build(b->gl, j, draws);
    pthread_mutex_lock(&b->lock);
    b->at_work = false;
    j->program = program;
    j->state = program ? PLR_BUILDING_DONE : PLR_BUILDING_FAILED;
    b->waiting--;
    pthread_cond_broadcast(&b->changed);
}

static void *work(void *user) {
    plr_builder *b = user;
    bool current = b->make_current(b->user, true);
    pthread_mutex_lock(&b->lock);
    b->threaded = current;
    while (current && !b->ends) {
        if (b->waiting)
            build_next(b, true);
        else
            pthread_cond_wait(&b->changed, &b->lock);
    }
    pthread_cond_broadcast(&b->changed);
    pthread_mutex_unlock(&b->lock);
    b->make_current(b->user, false);
    return NULL;
}

/* ---- All ---- */

plr_builder *plr_builder_create(const plr_gl *gl, bool (*make_current)(void *user, bool current),
                                void *user) {
    plr_builder *b = calloc(1, sizeof *b);
    if (!b)
        return NULL;
    b->gl = gl;
    b->make_current = make_current;
    b->user = user;
    pthread_mutex_init(&b->lock, NULL);
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_cond_init(&b->changed, &attributes);
    pthread_condattr_destroy(&attributes);
    b->threaded = make_current != NULL; /* until the thread says otherwise */
    if (b->threaded && pthread_create(&b->thread, NULL, work, b) != 0) {
        b->threaded = false;
        b->make_current = NULL;
    }
    return b;
}

void plr_builder_destroy(plr_builder **builder) {
    plr_builder *b = *builder;
    if (!b)
        return;
    pthread_mutex_lock(&b->lock);
    b->ends = true;
    pthread_cond_broadcast(&b->changed);
    pthread_mutex_unlock(&b->lock);
    if (b->make_current)
        pthread_join(b->thread, NULL);
    while (b->jobs) {
        job *j = b->jobs;
        b->jobs = j->next;
        if (j->program)
            b->gl->DeleteProgram(j->program);
        free_job(j);
    }
    pthread_cond_destroy(&b->changed);
    pthread_mutex_destroy(&b->lock);
    free(b);
    *builder = NULL;
}

plr_building plr_builder_ask(plr_builder *b, const char *const texts[PLR_STAGE_COUNT],
                             GLuint *program) {
    pthread_mutex_lock(&b->lock);
    job **at = &b->jobs;
    while (*at && !is_for(*at, texts))
        at = &(*at)->next;
    plr_building state = PLR_BUILDING_FAILED;
    if (*at) {
        job *j = *at;
        state = j->state;
        *program = j->program;
        if (state == PLR_BUILDING_DONE) {
            *at = j->next;
            free_job(j);
        }
    } else if ((*at = make_job(texts))) {
        state = PLR_BUILDING_WAITS;
        b->waiting++;
        pthread_cond_broadcast(&b->changed);
    }
    pthread_mutex_unlock(&b->lock);
    return state;
}

static struct timespec after(double wait_ms) {
    struct timespec end;
    clock_gettime(CLOCK_MONOTONIC, &end);
    double seconds = wait_ms / 1e3 < 1e6 ? wait_ms / 1e3 : 1e6;
    end.tv_sec += (time_t)seconds;
    end.tv_nsec += (long)((seconds - (double)(time_t)seconds) * 1e9);
    if (end.tv_nsec >= 1000000000) {
        end.tv_sec++;
        end.tv_nsec -= 1000000000;
    }
    return end;
}

size_t plr_builder_wait(plr_builder *b, double wait_ms) {
    struct timespec end = after(wait_ms > 0 ? wait_ms : 0);
    bool late = !(wait_ms > 0);
    pthread_mutex_lock(&b->lock);
    while (b->waiting && b->threaded && !late)
        late = pthread_cond_timedwait(&b->changed, &b->lock, &end) != 0;
    if (b->waiting && !b->threaded && !b->at_work)
        build_next(b, false);
    size_t waiting = b->waiting;
    pthread_mutex_unlock(&b->lock);
    return waiting;
}

size_t plr_builder_waiting(plr_builder *b) {
    pthread_mutex_lock(&b->lock);
    size_t waiting = b->waiting;
    pthread_mutex_unlock(&b->lock);
    return waiting;
}
