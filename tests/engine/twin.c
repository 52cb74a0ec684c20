/* Draws a scene with its own program, then with others in its place, and says whether the pictures
 * are the same to the bit: for twins, written by hand, of programs that are composed.
 *
 *     twin SCENE WxH STEP PROGRAM VIEWPOINT,... < PAIRS
 *
 * PROGRAM is a name of `plugray dump`; its texts are written to composed.vert and composed.frag. A
 * line of PAIRS is two files, vertex and fragment stage; "-" is the stage that was composed. Their
 * uniforms have the names that the composed ones have. Prints a line a pair: "same", "differs" and
 * of how many values, or "refused" and why. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/engine/replacement.h"

enum {
    MOST_VIEWS = 4,
    PATH_SIZE = 4096
};

typedef struct comparison {
    const char *program;
    plr_draw_desc size;
    plr_engine *engine;
    plr_diags *diags;
    plr_view *views[MOST_VIEWS];
    plr_picture pictures[MOST_VIEWS]; /* of the composed program */
    plr_built *built[MOST_VIEWS];     /* that is replaced */
    size_t count;
} comparison;

/* ---- Comparing ---- */

/* How many values are not the same bits, and how far they are from each other. */
static size_t count_different(const plr_picture *a, const plr_picture *b, double *worst) {
    size_t different = 0;
    for (size_t i = 0; i < (size_t)a->width * (size_t)a->height * 4; i++) {
        different += memcmp(&a->pixels[i], &b->pixels[i], sizeof(float)) != 0;
        *worst = fmax(*worst, fabs((double)a->pixels[i] - (double)b->pixels[i]));
    }
    return different;
}

static bool compare(const comparison *c, const char *const paths[PLR_STAGE_COUNT]) {
    char why[256];
    GLuint name = replacement_compile(c->engine, c->built[0], paths, why, sizeof why);
    size_t different = 0;
    double worst = 0;
    if (!name) {
        printf("refused %.200s\n", why);
        return true;
    }
    for (size_t i = 0; i < c->count; i++) {
        plr_picture picture;
        replacement_use(c->views[i], c->built[i], name);
        if (!plr_view_draw(c->views[i], &c->size, &picture, c->diags))
            return false;
        different += count_different(&c->pictures[i], &picture, &worst);
        plr_picture_free(&picture);
    }
    if (different)
        printf("differs %zu, by %g\n", different, worst);
    else
        printf("same\n");
    return true;
}

static bool compare_all(const comparison *c) {
    static char line[2 * PATH_SIZE], paths[2][PATH_SIZE];
    bool fine = true;
    while (fine && fgets(line, sizeof line, stdin) &&
           sscanf(line, "%4095s %4095s", paths[0], paths[1]) == 2)
        fine = compare(
            c, (const char *[PLR_STAGE_COUNT]){[PLR_VERTEX] = paths[0], [PLR_FRAGMENT] = paths[1]});
    return fine;
}

/* ---- What is compared with ---- */

static bool same_text(const plr_built *a, const plr_built *b) {
    return strcmp(plr_program_text(a->info.program, PLR_FRAGMENT, NULL),
                  plr_program_text(b->info.program, PLR_FRAGMENT, NULL)) == 0;
}

static bool write_texts(const plr_program *program) {
    static const struct {
        plr_stage stage;
        const char *path;
    } stages[] = {{PLR_VERTEX, "composed.vert"}, {PLR_FRAGMENT, "composed.frag"}};
    bool fine = true;
    for (size_t i = 0; i < sizeof stages / sizeof *stages; i++) {
        FILE *file = fopen(stages[i].path, "wb");
        const char *text = plr_program_text(program, stages[i].stage, NULL);
        fine = fine && file && text && fputs(text, file) >= 0;
        fine = file && fclose(file) == 0 && fine;
    }
    return fine;
}

/* A picture that shows next to nothing would compare nothing. */
static size_t count_values(const plr_picture *picture) {
    size_t changes = 0;
    for (size_t i = 4; i < (size_t)picture->width * (size_t)picture->height * 4; i++)
        changes += memcmp(&picture->pixels[i], &picture->pixels[i - 4], sizeof(float)) != 0;
    return changes;
}

static bool add_view(comparison *c, plr_scene *scene, const char *viewpoint, double step) {
    const plr_view_desc desc = {.viewpoint = viewpoint, .step = step, .no_leaping = true};
    plr_view *view = plr_view_create(c->engine, scene, &desc, c->diags);
    size_t i = c->count;
    if (!view)
        return false;
    c->views[c->count++] = view;
    c->built[i] = replacement_find(view, c->program);
    bool fine = c->built[i] && same_text(c->built[i], c->built[0]) &&
                write_texts(c->built[i]->info.program) &&
                plr_view_draw(view, &c->size, &c->pictures[i], c->diags);
    if (fine)
        printf("drawn %zu\n", count_values(&c->pictures[i]));
    return fine;
}

static bool run(comparison *c, const char *path, char *viewpoints, double step) {
    bool fine = true;
    plr_scene *scenes[MOST_VIEWS] = {0};
    for (char *v = strtok(viewpoints, ","); v && fine && c->count < MOST_VIEWS;
         v = strtok(NULL, ",")) {
        size_t i = c->count;
        scenes[i] = plr_scene_read(path, NULL, c->diags);
        fine = scenes[i] && add_view(c, scenes[i], v, step);
    }
    fine = fine && compare_all(c);
    for (size_t i = 0; i < MOST_VIEWS; i++) {
        plr_picture_free(&c->pictures[i]);
        plr_view_destroy(&c->views[i]);
        plr_scene_destroy(&scenes[i]);
    }
    return fine;
}

static void print_diags(const plr_diags *diags) {
    for (size_t i = 0; i < plr_diags_count(diags); i++)
        fprintf(stderr, "twin: %s\n", plr_diags_get(diags, i)->message);
}

int main(int argc, char **argv) {
    comparison c = {.program = argc == 6 ? argv[4] : NULL, .diags = plr_diags_create(NULL)};
    if (argc != 6 || sscanf(argv[2], "%dx%d", &c.size.width, &c.size.height) != 2) {
        fprintf(stderr, "usage: twin SCENE WxH STEP PROGRAM VIEWPOINT,... < PAIRS\n");
        return 2;
    }
    plr_context *context = plr_context_create(PLR_BACKEND_AUTO, c.diags);
    plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address, .user = context};
    c.engine = context ? plr_engine_create(&desc, c.diags) : NULL;
    int status = !c.engine ? 3 : run(&c, argv[1], argv[5], atof(argv[3])) ? 0 : 1;
    print_diags(c.diags);
    plr_engine_destroy(&c.engine);
    plr_context_destroy(&context);
    plr_diags_destroy(&c.diags);
    return status;
}
