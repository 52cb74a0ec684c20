/* How fast the linker is: microseconds per effect of links with 1, 10, 100 and 1000 effects, and
 * the whole link of a scene with 20 effects against glslang's parse of the result.
 *
 * Usage: bench-link [EFFECTS-FOLDER]. Everything is warm, the base and the library are read
 * beforehand, the effects are read as a part of each link; each number is the median of 50 runs. */
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

static const char effect_text[] =
    "uniform float amount, scale;\n"
    "uniform vec3 tint;\n"
    "varying vec3 position;\n"
    "const int OCTAVES = 4;\n"
    "\n"
    "/* Smooth noise in space. */\n"
    "float hash(vec3 p) { return fract(sin(dot(p, vec3(12.9898, 78.233, 37.719))) * 43758.5453); "
    "}\n"
    "\n"
    "float noise(vec3 p)\n"
    "{\n"
    "  vec3 i = floor(p), f = fract(p);\n"
    "  f = f * f * (3.0 - 2.0 * f); // smooth\n"
    "  float a = mix(hash(i), hash(i + vec3(1.0, 0.0, 0.0)), f.x);\n"
    "  float b = mix(hash(i + vec3(0.0, 1.0, 0.0)), hash(i + vec3(1.0, 1.0, 0.0)), f.x);\n"
    "  float c = mix(hash(i + vec3(0.0, 0.0, 1.0)), hash(i + vec3(1.0, 0.0, 1.0)), f.x);\n"
    "  float d = mix(hash(i + vec3(0.0, 1.0, 1.0)), hash(i + vec3(1.0, 1.0, 1.0)), f.x);\n"
    "  return mix(mix(a, b, f.y), mix(c, d, f.y), f.z);\n"
    "}\n"
    "\n"
    "void PLUG_fragment_modify(inout vec4 fragment_color)\n"
    "{\n"
    "  float sum = 0.0, weight = 0.5;\n"
    "  vec3 p = position * scale;\n"
    "  for (int i = 0; i < OCTAVES; i++) {\n"
    "    sum += noise(p) * weight;\n"
    "    p *= 2.0;\n"
    "    weight *= 0.5;\n"
    "  }\n"
    "  fragment_color.rgb = mix(fragment_color.rgb, tint, amount * sum);\n"
    "}\n";

static const char base_text[] =
    "#version 330 core\n"
    "in vec4 castle_vertex_eye;\n"
    "in vec3 castle_normal_eye;\n"
    "uniform vec4 color;\n"
    "out vec4 result;\n"
    "/* PLUG-DECLARATIONS */\n"
    "void main()\n"
    "{\n"
    "  vec4 fragment_color = color;\n"
    "  vec3 normal_eye = normalize(castle_normal_eye);\n"
    "  /* PLUG: fragment_eye_space (castle_vertex_eye, normal_eye) */\n"
    "  fragment_color.rgb *= max(normal_eye.z, 0.0);\n"
    "  /* PLUG: lighting_apply (fragment_color, castle_vertex_eye, normal_eye) */\n"
    "  /* PLUG: fragment_modify (fragment_color) */\n"
    "  /* PLUG: fog_apply (fragment_color, normal_eye) */\n"
    "  result = fragment_color;\n"
    "}\n";

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
    plr_source *units[MOST_EFFECTS];
    plr_effect effects[MOST_EFFECTS];
} scene;

static plr_source *read_file(const char *folder, const char *name) {
    char path[1024];
    snprintf(path, sizeof path, "%s/library/%s", folder, name);
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    static char text[1 << 20];
    size_t length = fread(text, 1, sizeof text, file);
    fclose(file);
    return plr_source_read(PLR_FRAGMENT, text, length, &(plr_origin){.file = path}, NULL, NULL);
}

static void read_library(scene *s, const char *folder) {
    static const char *const names[] = {"host.glsl", "legacy.glsl",   "lighting.glsl",
                                        "mix.glsl",  "material.glsl", "space.glsl"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        plr_source *source = read_file(folder, names[i]);
        if (source)
            s->library[s->library_count++] = source;
    }
}

/* Reads the effects and links: what a host does for each new combination. */
static plr_program *link_scene(scene *s) {
    for (size_t i = 0; i < s->effect_count; i++) {
        s->units[i] =
            plr_source_read(PLR_FRAGMENT, effect_text, sizeof effect_text - 1, NULL, NULL, NULL);
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
    s.base[0] = plr_source_read(PLR_FRAGMENT, base_text, sizeof base_text - 1, NULL, NULL, NULL);
    if (argc > 1)
        read_library(&s, argv[1]);
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
