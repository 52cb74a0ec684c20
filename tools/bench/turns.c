/* Draws several views in turns in one process, so that what else the machine does meets all alike,
 * and says what each frame took.
 *
 * Reads a command a line from standard input, words separated by tabs, and answers each with one
 * line of JSON:
 *
 *   scene PATH                            reads a scene; the views that follow are of it
 *   view PIXELS METHOD STEP ERROR LEAPS   METHOD as in plr_method, STEP and ERROR 0: none, LEAPS 0
 *                                         or 1. Answers what was planned, and the programs
 *   replace VIEW PROGRAM VERT FRAG        the view draws with these files in place of a program,
 *                                         whose name is that of `plugray dump`
 *   picture VIEW PATH                     draws it and writes it
 *   later VIEW TIME                       draws it at another time of the scene: what pilot
 *                                         drawings took, which are made anew then
 *   turns ROUNDS VIEW...                  draws the views ROUNDS times, every other round
 *                                         backwards: lists of CPU and wall milliseconds. The first
 *                                         drawing of a view compiles: draw a picture of it before
 *   forget                                all scenes and views
 */
#include <plugray/engine.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/engine/replacement.h"
#include "tools/plugray/json.h"

enum {
    MOST_VIEWS = 256,
    MOST_WORDS = MOST_VIEWS + 2,
    MOST_ROUNDS = 10000,
    LINE_SIZE = 8192
};

typedef struct shown {
    plr_view *view;
    plr_draw_desc draw;
} shown;

typedef struct bench {
    plr_context *context;
    plr_engine *engine;
    plr_diags *diags;
    plr_scene *scenes[MOST_VIEWS];
    shown views[MOST_VIEWS];
    size_t scene_count, view_count;
} bench;

typedef struct words {
    char *items[MOST_WORDS];
    size_t count;
} words;

/* ---- Answers ---- */

static void answer_error(bench *b, const char *text) {
    size_t count = plr_diags_count(b->diags);
    fputs("{\"failed\": ", stdout);
    json_string(stdout, count ? plr_diags_get(b->diags, count - 1)->message : text);
    puts("}");
}

static const char *method_word(plr_method method) {
    static const char *const names[] = {"auto", "midpoint", "preintegrated", "cells"};
    return names[method];
}

/* FNV-1a (Fowler, Noll, Vo) of a program's fragment stage. */
static unsigned long long hash_program(const plr_program *program) {
    size_t length = 0;
    const char *text = plr_program_text(program, PLR_FRAGMENT, &length);
    unsigned long long hash = 14695981039346656037u;
    for (size_t i = 0; text && i < length; i++)
        hash = (hash ^ (unsigned char)text[i]) * 1099511628211u;
    return hash;
}

static void answer_view(const bench *b, size_t index) {
    const plr_view *view = b->views[index].view;
    plr_plan plan;
    plr_view_get_plan(view, &plan);
    printf("{\"view\": %zu, \"bounded\": %s, \"value\": ", index, plan.bounded ? "true" : "false");
    json_number(stdout, plan.value);
    printf(", \"method\": \"%s\", \"step\": ", method_word(plan.method));
    json_number(stdout, plan.step);
    printf(", \"leaps\": %s, \"programs\": [", plan.leaps ? "true" : "false");
    for (size_t i = 0; i < plr_view_program_count(view); i++) {
        const plr_program_info *info = plr_view_program(view, i);
        printf("%s{\"name\": \"%s\", \"hash\": \"%016llx\", \"instructions\": %u, \"fetches\": %u}",
               i ? ", " : "", info->name, hash_program(info->program), info->instructions,
               info->fetches);
    }
    puts("]}");
}

static void put_times(const char *name, double *const *times, size_t views, size_t rounds) {
    printf("\"%s\": [", name);
    for (size_t i = 0; i < views; i++) {
        printf("%s[", i ? ", " : "");
        for (size_t j = 0; j < rounds; j++) {
            fputs(j ? ", " : "", stdout);
            json_number(stdout, times[i][j]);
        }
        putchar(']');
    }
    putchar(']');
}

/* ---- Commands ---- */

static void read_scene(bench *b, const words *w) {
    plr_read_desc desc = {0};
    plr_scene *scene = w->count == 2 && b->scene_count < MOST_VIEWS
                           ? plr_scene_read(w->items[1], &desc, b->diags)
                           : NULL;
    if (!scene) {
        answer_error(b, "no scene");
        return;
    }
    b->scenes[b->scene_count++] = scene;
    puts("{}");
}

static void make_view(bench *b, const words *w) {
    if (w->count != 6 || !b->scene_count || b->view_count == MOST_VIEWS) {
        answer_error(b, "view: wrong words");
        return;
    }
    int pixels = atoi(w->items[1]);
    plr_view_desc desc = {.aspect = 1,
                          .method = (plr_method)(atoi(w->items[2]) & 3),
                          .step = strtod(w->items[3], NULL),
                          .error = strtod(w->items[4], NULL),
                          .no_leaping = atoi(w->items[5]) == 0};
    plr_view *view = plr_view_create(b->engine, b->scenes[b->scene_count - 1], &desc, b->diags);
    if (!view || pixels < 1) {
        plr_view_destroy(&view);
        answer_error(b, "no view");
        return;
    }
    b->views[b->view_count] = (shown){view, {.width = pixels, .height = pixels}};
    answer_view(b, b->view_count++);
}

/* NULL where a word names none. */
static shown *find_view(bench *b, const char *word) {
    char *end;
    unsigned long index = strtoul(word, &end, 10);
    return end != word && !*end && index < b->view_count ? &b->views[index] : NULL;
}

static void replace(bench *b, const words *w) {
    shown *s = w->count == 5 ? find_view(b, w->items[1]) : NULL;
    plr_built *built = s ? replacement_find(s->view, w->items[2]) : NULL;
    char why[256] = "replace: wrong words";
    GLuint name = 0;
    if (built)
        name = replacement_compile(b->engine, built,
                                   (const char *[PLR_STAGE_COUNT]){
                                       [PLR_VERTEX] = w->items[3], [PLR_FRAGMENT] = w->items[4]},
                                   why, sizeof why);
    if (!name) {
        answer_error(b, why);
        return;
    }
    replacement_use(s->view, built, name);
    puts("{}");
}

static bool draw(bench *b, shown *s, plr_picture *picture, plr_phase *took) {
    plr_view_stats stats;
    if (!plr_view_draw(s->view, &s->draw, picture, b->diags))
        return false;
    plr_view_get_stats(s->view, &stats);
    *took = stats.draw;
    return true;
}

static void write_picture(bench *b, const words *w) {
    plr_picture picture = {0};
    plr_phase took;
    shown *s = w->count == 3 ? find_view(b, w->items[1]) : NULL;
    bool written = s && draw(b, s, &picture, &took) &&
                   plr_picture_write(&picture, w->items[2], false, b->diags);
    plr_picture_free(&picture);
    if (!written) {
        answer_error(b, "no picture");
        return;
    }
    fputs("{\"cpu_ms\": ", stdout);
    json_number(stdout, took.cpu_ms);
    fputs(", \"wall_ms\": ", stdout);
    json_number(stdout, took.wall_ms);
    puts("}");
}

static void draw_later(bench *b, const words *w) {
    plr_picture picture = {0};
    plr_phase took;
    plr_view_stats stats;
    shown *s = w->count == 3 ? find_view(b, w->items[1]) : NULL;
    bool drawn = s && plr_view_update(s->view, strtod(w->items[2], NULL), b->diags) &&
                 draw(b, s, &picture, &took);
    plr_picture_free(&picture);
    if (!drawn) {
        answer_error(b, "not drawn");
        return;
    }
    plr_view_get_stats(s->view, &stats);
    fputs("{\"pilots_cpu_ms\": ", stdout);
    json_number(stdout, stats.pilots.cpu_ms);
    puts("}");
}

/* All views once, to times[view][round] of both clocks. */
static bool draw_round(bench *b, const words *w, double **cpu, double **wall, long round) {
    size_t count = w->count - 2;
    for (size_t i = 0; i < count; i++) {
        size_t at = round % 2 ? count - 1 - i : i;
        plr_picture picture = {0};
        plr_phase took;
        shown *s = find_view(b, w->items[2 + at]);
        if (!s || !draw(b, s, &picture, &took))
            return false;
        plr_picture_free(&picture);
        cpu[at][round] = took.cpu_ms;
        wall[at][round] = took.wall_ms;
    }
    return true;
}

static void take_turns(bench *b, const words *w) {
    long rounds = w->count > 2 ? atol(w->items[1]) : 0;
    if (rounds < 1 || rounds > MOST_ROUNDS) {
        answer_error(b, "turns: wrong words");
        return;
    }
    size_t count = w->count - 2;
    double *numbers = calloc(2 * count * (size_t)rounds, sizeof *numbers);
    double *cpu[MOST_VIEWS], *wall[MOST_VIEWS];
    bool drawn = numbers != NULL;
    for (size_t i = 0; drawn && i < count; i++) {
        cpu[i] = numbers + 2 * i * (size_t)rounds;
        wall[i] = cpu[i] + rounds;
    }
    for (long round = 0; drawn && round < rounds; round++)
        drawn = draw_round(b, w, cpu, wall, round);
    if (drawn) {
        putchar('{');
        put_times("cpu_ms", cpu, count, (size_t)rounds);
        fputs(", ", stdout);
        put_times("wall_ms", wall, count, (size_t)rounds);
        puts("}");
    } else {
        answer_error(b, "not drawn");
    }
    free(numbers);
}

static void forget(bench *b) {
    while (b->view_count)
        plr_view_destroy(&b->views[--b->view_count].view);
    while (b->scene_count)
        plr_scene_destroy(&b->scenes[--b->scene_count]);
    plr_diags_destroy(&b->diags);
    b->diags = plr_diags_create(NULL);
}

static void answer_forget(bench *b, const words *w) {
    (void)w;
    forget(b);
    puts("{}");
}

static const struct {
    const char *name;
    void (*run)(bench *b, const words *w);
} commands[] = {{"scene", read_scene},      {"view", make_view},   {"replace", replace},
                {"picture", write_picture}, {"later", draw_later}, {"turns", take_turns},
                {"forget", answer_forget}};

/* ---- All ---- */

static void run_line(bench *b, char *line) {
    words w = {0};
    for (char *word = strtok(line, "\t\n"); word && w.count < MOST_WORDS;
         word = strtok(NULL, "\t\n"))
        w.items[w.count++] = word;
    for (size_t i = 0; w.count && i < sizeof commands / sizeof *commands; i++)
        if (strcmp(w.items[0], commands[i].name) == 0) {
            commands[i].run(b, &w);
            fflush(stdout);
            return;
        }
    answer_error(b, "no such command");
    fflush(stdout);
}

static bool start(bench *b) {
    b->diags = plr_diags_create(NULL);
    b->context = plr_context_create(PLR_BACKEND_AUTO, b->diags);
    if (!b->context)
        return false;
    plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address, .user = b->context};
    b->engine = plr_engine_create(&desc, b->diags);
    return b->engine != NULL;
}

int main(void) {
    static bench b;
    static char line[LINE_SIZE];
    if (!start(&b)) {
        answer_error(&b, "no GL");
        return 3;
    }
    while (fgets(line, sizeof line, stdin))
        run_line(&b, line);
    forget(&b);
    plr_engine_destroy(&b.engine);
    plr_context_destroy(&b.context);
    plr_diags_destroy(&b.diags);
    return 0;
}
