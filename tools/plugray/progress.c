#include "tools/plugray/progress.h"

#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static struct {
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    pthread_t thread;
    const char *phase;
    char file[256]; /* "name, 45 %", or nothing */
    char bar[64];   /* " [###  ] 60 %", or nothing */
    struct timespec start;
    bool running, shown, end;
} state = {.mutex = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};

/* Whole seconds since the phase began; half a tenth early, as a wait may end a little before its
 * time. */
static long seconds_shown(const struct timespec *now) {
    double seconds = (double)(now->tv_sec - state.start.tv_sec) +
                     1e-9 * (double)(now->tv_nsec - state.start.tv_nsec);
    return (long)(seconds + 0.05);
}

static void *show(void *unused) {
    (void)unused;
    pthread_mutex_lock(&state.mutex);
    while (!state.end) {
        struct timespec now;
        clock_gettime(CLOCK_REALTIME, &now);
        now.tv_sec++;
        pthread_cond_timedwait(&state.changed, &state.mutex, &now);
        clock_gettime(CLOCK_REALTIME, &now);
        long seconds = seconds_shown(&now);
        if (state.end || seconds < 1)
            continue;
        fprintf(stderr, "\r\033[Kplugray: %s%s%s, %ld s", state.phase, state.file, state.bar,
                seconds);
        fflush(stderr);
        state.shown = true;
    }
    pthread_mutex_unlock(&state.mutex);
    return NULL;
}

void progress(const char *phase) {
    if (!isatty(STDERR_FILENO))
        return;
    pthread_mutex_lock(&state.mutex);
    bool stop = !phase && state.running, start = phase && !state.running;
    if (phase)
        state.phase = phase;
    state.file[0] = '\0';
    state.end = !phase;
    if (state.end)
        state.bar[0] = '\0';
    pthread_cond_signal(&state.changed);
    if (start) {
        clock_gettime(CLOCK_REALTIME, &state.start);
        state.running = pthread_create(&state.thread, NULL, show, NULL) == 0;
    }
    pthread_mutex_unlock(&state.mutex);
    if (!stop)
        return;
    pthread_join(state.thread, NULL);
    state.running = false;
    if (state.shown)
        fputs("\r\033[K", stderr);
    state.shown = false;
}

void progress_part(double done) {
    static const char full[] = "##############################";
    double part = done > 0 ? fmin(done, 1) : 0;
    pthread_mutex_lock(&state.mutex);
    snprintf(state.bar, sizeof state.bar, " [%-30.*s] %.0f %%", (int)(part * 30), full, 100 * part);
    pthread_mutex_unlock(&state.mutex);
}

void progress_of_file(void *unused, const char *name, double done) {
    (void)unused;
    const char *slash = strrchr(name, '/');
    pthread_mutex_lock(&state.mutex);
    if (done < 1)
        snprintf(state.file, sizeof state.file, " %.200s, %.0f %%", slash ? slash + 1 : name,
                 100 * done);
    else
        state.file[0] = '\0';
    pthread_mutex_unlock(&state.mutex);
}
