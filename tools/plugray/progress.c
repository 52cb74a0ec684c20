#include "tools/plugray/progress.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

static struct {
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    pthread_t thread;
    const char *phase;
    time_t start;
    bool running, shown, end;
} state = {.mutex = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};

static void *show(void *unused) {
    (void)unused;
    pthread_mutex_lock(&state.mutex);
    while (!state.end) {
        struct timespec next;
        clock_gettime(CLOCK_REALTIME, &next);
        next.tv_sec++;
        pthread_cond_timedwait(&state.changed, &state.mutex, &next);
        long seconds = (long)(time(NULL) - state.start);
        if (state.end || seconds < 1)
            continue;
        fprintf(stderr, "\r\033[Kplugray: %s, %ld s", state.phase, seconds);
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
    state.end = !phase;
    pthread_cond_signal(&state.changed);
    if (start) {
        state.start = time(NULL);
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
