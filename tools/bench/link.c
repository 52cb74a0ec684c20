/* How fast the linker is: microseconds per effect of links with 1, 10, 100 and 1000 effects, and
 * the whole link of a scene with 20 effects against glslang's parse of the result.
 *
 * Usage: bench-link BENCH-FOLDER EFFECTS-FOLDER, the folders tools/bench and effects. Everything is
 * warm, the base and the library are read beforehand, the effects are read as a part of each link;
 * each number is the median of 50 runs. */
#include <plugray/plugs.h>

#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/resource_limits_c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    RUNS = 50,
    MOST_EFFECTS = 1000,
    MOST_UNITS = 32
};

/* Of the processor: other work on the machine does not count. */
static double microseconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec * 1e6 + (double)now.tv_nsec * 1e-3;
}

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, size_t count) {
    qsort(values, count, sizeof *values, by_value);
    return values[count / 2];
}

typedef struct scene {
    const plr_source *base[1], *library[MOST_UNITS];
    size_t library_count, effect_count;
    char effect[1 << 16]; /* the text of every effect */
    size_t effect_length;
    plr_source *units[MOST_EFFECTS];
    plr_effect effects[MOST_EFFECTS];
} scene;

/* The length of the text read into `text`; the program ends without the file. */
static size_t read_text(const char *folder, const char *name, char *text, size_t size) {
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    if (!file) {
        fprintf(stderr, "there is no %s\n", path);
        exit(2);
    }
    size_t length = fread(text, 1, size, file);
    fclose(file);
    return length;
}

static plr_source *read_file(const char *folder, const char *name) {
    static char text[1 << 20];
    size_t length = read_text(folder, name, text, sizeof text);
    return plr_source_read(PLR_FRAGMENT, text, length, &(plr_origin){.file = name}, NULL, NULL);
}

static void read_library(scene *s, const char *folder) {
    static const char *const names[] = {"library/host.glsl",     "library/legacy.glsl",
                                        "library/lighting.glsl", "library/mix.glsl",
                                        "library/material.glsl", "library/space.glsl"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        plr_source *source = read_file(folder, names[i]);
        if (source)
            s->library[s->library_count++] = source;
    }
}

/* Reads the effects and links: what a host does for each new combination. */
static plr_program *link_scene(scene *s) {
    for (size_t i = 0; i < s->effect_count; i++) {
        s->units[i] = plr_source_read(PLR_FRAGMENT, s->effect, s->effect_length, NULL, NULL, NULL);
        s->effects[i] = (plr_effect){
            .name = "Noise", .sources = (const plr_source *const *)&s->units[i], .source_count = 1};
    }
    plr_link_desc desc = {.base = s->base,
                          .base_count = 1,
                          .library = s->library,
                          .library_count = s->library_count,
                          .effects = s->effects,
                          .effect_count = s->effect_count};
    return plr_link(&desc, NULL);
}

static void free_scene(scene *s, plr_program *program) {
    plr_program_destroy(&program);
    for (size_t i = 0; i < s->effect_count; i++)
        plr_source_destroy(&s->units[i]);
}

static double time_link(scene *s, size_t effects) {
    double times[RUNS];
    s->effect_count = effects;
    for (int run = -3; run < RUNS; run++) {
        double start = microseconds();
        plr_program *program = link_scene(s);
        double end = microseconds();
        if (run >= 0)
            times[run] = end - start;
        free_scene(s, program);
    }
    return median(times, RUNS);
}

static bool parse(const char *text) {
    glslang_input_t input = {.language = GLSLANG_SOURCE_GLSL,
                             .stage = GLSLANG_STAGE_FRAGMENT,
                             .client = GLSLANG_CLIENT_NONE,
                             .target_language = GLSLANG_TARGET_NONE,
                             .code = text,
                             .default_version = 330,
                             .default_profile = GLSLANG_CORE_PROFILE,
                             .messages = GLSLANG_MSG_DEFAULT_BIT,
                             .resource = glslang_default_resource()};
    glslang_shader_t *shader = glslang_shader_create(&input);
    bool good = glslang_shader_preprocess(shader, &input) && glslang_shader_parse(shader, &input);
    if (!good)
        fprintf(stderr, "%s\n", glslang_shader_get_info_log(shader));
    glslang_shader_delete(shader);
    return good;
}

static double time_parse(const char *text) {
    double times[RUNS];
    for (int run = -3; run < RUNS; run++) {
        double start = microseconds();
        if (!parse(text))
            return 0;
        if (run >= 0)
            times[run] = microseconds() - start;
    }
    return median(times, RUNS);
}

int main(int argc, char **argv) {
    static scene s;
    static const size_t counts[] = {1, 10, 100, 1000};
    if (argc != 3) {
        fprintf(stderr, "usage: bench-link BENCH-FOLDER EFFECTS-FOLDER\n");
        return 2;
    }
    s.base[0] = read_file(argv[1], "base.frag.glsl");
    s.effect_length = read_text(argv[1], "noise.glsl", s.effect, sizeof s.effect);
    read_library(&s, argv[2]);
    double each[4];
    for (size_t i = 0; i < 4; i++) {
        each[i] = time_link(&s, counts[i]) / (double)counts[i];
        printf("%4zu effects: %8.2f us per effect\n", counts[i], each[i]);
    }
    printf("1000 against 100: %.2f times (at most 1.5)\n", each[3] / each[2]);
    double linked = time_link(&s, 20);
    plr_program *program = link_scene(&s);
    size_t length = 0;
    const char *text = program ? plr_program_text(program, PLR_FRAGMENT, &length) : NULL;
    glslang_initialize_process();
    double parsed = text ? time_parse(text) : 0;
    glslang_finalize_process();
    printf("20 effects: link %.0f us, glslang parses the %zu bytes in %.0f us: 1/%.1f (at most "
           "1/10)\n",
           linked, length, parsed, parsed / linked);
    free_scene(&s, program);
    for (size_t i = 0; i < s.library_count; i++) {
        plr_source *source = (plr_source *)(uintptr_t)s.library[i];
        plr_source_destroy(&source);
    }
    plr_source *base = (plr_source *)(uintptr_t)s.base[0];
    plr_source_destroy(&base);
    return parsed > 0 && each[3] <= 1.5 * each[2] && linked * 10 <= parsed ? 0 : 1;
}
