/* The one file that knows glslang. */
#include "engine/glsl.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/resource_limits_c.h>

#include "engine/glsl_log.h"
#include "engine/spirv.h"

/* glslang keeps its tables of built-ins for the process. Making them costs far more than a check,
 * so they are made once, at the first use, and stay. */
static pthread_once_t once = PTHREAD_ONCE_INIT;

static void initialize(void) {
    glslang_initialize_process();
}

static const glslang_stage_t stages[PLR_STAGE_COUNT] = {
    [PLR_VERTEX] = GLSLANG_STAGE_VERTEX,
    [PLR_GEOMETRY] = GLSLANG_STAGE_GEOMETRY,
    [PLR_FRAGMENT] = GLSLANG_STAGE_FRAGMENT,
};

/* For checking, a text is a text of no client: GL takes what SPIR-V's clients refuse (uniforms
 * without locations). All errors are asked for, not only the first. */
static const glslang_input_t checking = {
    .language = GLSLANG_SOURCE_GLSL,
    .client = GLSLANG_CLIENT_NONE,
    .target_language = GLSLANG_TARGET_NONE,
    .default_version = 110,
    .default_profile = GLSLANG_NO_PROFILE,
    .messages = GLSLANG_MSG_CASCADING_ERRORS_BIT | GLSLANG_MSG_ENHANCED,
};

static const glslang_input_t counting = {
    .language = GLSLANG_SOURCE_GLSL,
    .client = GLSLANG_CLIENT_OPENGL,
    .client_version = GLSLANG_TARGET_OPENGL_450,
    .target_language = GLSLANG_TARGET_SPV,
    .target_language_version = GLSLANG_TARGET_SPV_1_0,
    .default_version = 110,
    .default_profile = GLSLANG_NO_PROFILE,
    .messages = GLSLANG_MSG_DEFAULT_BIT,
};

/* Takes the messages of a log; a failure without any gets one, so that no failure is silent. */
static void take_log(const char *log, bool failed, plr_glsl_messages *messages) {
    static const char silent[] = "the compiler refuses this without saying why";
    plr_glsl_parse_log(log, messages);
    bool error = false;
    for (size_t i = 0; i < messages->count; i++)
        error = error || messages->items[i].severity == PLR_ERROR;
    if (failed && !error)
        plr_glsl_messages_add(messages, &(plr_glsl_message){.severity = PLR_ERROR}, silent,
                              sizeof silent - 1, NULL, 0);
    plr_glsl_messages_sort(messages);
}

/* Parses one text. NULL with messages if it does not compile. */
static glslang_shader_t *parse(const glslang_input_t *how, const char *text, plr_stage stage,
                               plr_glsl_messages *messages) {
    glslang_input_t input = *how;
    input.stage = stages[stage];
    input.code = text;
    input.resource = glslang_default_resource();
    *messages = (plr_glsl_messages){0};
    if (!plr_glsl_check_limits(text, messages))
        return NULL;
    glslang_shader_t *shader = glslang_shader_create(&input);
    if (!shader) {
        take_log(NULL, true, messages);
        return NULL;
    }
    if (how->client == GLSLANG_CLIENT_OPENGL)
        glslang_shader_set_options(shader, GLSLANG_SHADER_AUTO_MAP_BINDINGS |
                                               GLSLANG_SHADER_AUTO_MAP_LOCATIONS);
    bool parsed = glslang_shader_preprocess(shader, &input);
    /* Macros may have made more of it. */
    bool limited =
        parsed && !plr_glsl_check_limits(glslang_shader_get_preprocessed_code(shader), messages);
    if (!limited) {
        parsed = parsed && glslang_shader_parse(shader, &input);
        take_log(glslang_shader_get_info_log(shader), !parsed, messages);
    }
    if (parsed && !limited)
        return shader;
    glslang_shader_delete(shader);
    return NULL;
}

static bool link_stages(glslang_shader_t *const shaders[PLR_STAGE_COUNT],
                        plr_glsl_messages *messages) {
    glslang_program_t *program = glslang_program_create();
    if (!program)
        return false;
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
        if (shaders[stage])
            glslang_program_add_shader(program, shaders[stage]);
    bool linked = glslang_program_link(program, (int)checking.messages);
    take_log(glslang_program_get_info_log(program), !linked, messages);
    glslang_program_delete(program);
    return linked;
}

bool plr_glsl_check(const char *const texts[PLR_STAGE_COUNT],
                    plr_glsl_messages messages[PLR_STAGE_COUNT], plr_glsl_messages *link) {
    glslang_shader_t *shaders[PLR_STAGE_COUNT] = {NULL};
    bool all = true;
    pthread_once(&once, initialize);
    *link = (plr_glsl_messages){0};
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++) {
        messages[stage] = (plr_glsl_messages){0};
        if (!texts[stage])
            continue;
        shaders[stage] = parse(&checking, texts[stage], (plr_stage)stage, &messages[stage]);
        all = all && shaders[stage];
    }
    if (all)
        all = link_stages(shaders, link);
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
        if (shaders[stage])
            glslang_shader_delete(shaders[stage]);
    return all;
}

/* ---- Counting ---- */

/* Below 3.30, asking glslang for SPIR-V makes it print its built-ins on standard output. */
static bool is_countable(const char *text) {
    static const char directive[] = "#version";
    text += strspn(text, " \t\r\n");
    return strncmp(text, directive, sizeof directive - 1) == 0 &&
           strtol(text + sizeof directive - 1, NULL, 10) >= 330;
}

/* The SPIR-V of a text, with functions inlined and without what is dead; with_lines: with names and
 * lines. The caller deletes the program; NULL if the text does not compile. */
static glslang_program_t *to_spirv(const char *text, plr_stage stage, bool with_lines) {
    plr_glsl_messages messages;
    if (!is_countable(text))
        return NULL;
    pthread_once(&once, initialize);
    glslang_shader_t *shader = parse(&counting, text, stage, &messages);
    plr_glsl_messages_free(&messages);
    glslang_program_t *program = shader ? glslang_program_create() : NULL;
    bool fine = false;
    if (program) {
        glslang_program_add_shader(program, shader);
        fine = glslang_program_link(program, (int)counting.messages) &&
               glslang_program_map_io(program);
    }
    if (fine) {
        /* only the passes for size inline functions and drop what is dead */
        glslang_spv_options_t options = {.generate_debug_info = with_lines,
                                         .strip_debug_info = !with_lines,
                                         .optimize_size = true};
        glslang_program_SPIRV_generate_with_options(program, stages[stage], &options);
        fine = glslang_program_SPIRV_get_size(program) > 0;
    }
    if (shader)
        glslang_shader_delete(shader);
    if (program && !fine) {
        glslang_program_delete(program);
        program = NULL;
    }
    return program;
}

bool plr_glsl_count(const char *text, plr_stage stage, uint32_t *instructions, uint32_t *fetches) {
    *instructions = *fetches = 0;
    glslang_program_t *program = to_spirv(text, stage, false);
    if (!program)
        return false;
    plr_spirv_count(glslang_program_SPIRV_get_ptr(program), glslang_program_SPIRV_get_size(program),
                    instructions, fetches);
    glslang_program_delete(program);
    return true;
}

bool plr_glsl_fetches(const char *text, plr_stage stage,
                      void (*visit)(void *user, uint32_t line, const char *sampler), void *user) {
    glslang_program_t *program = to_spirv(text, stage, true);
    if (!program)
        return false;
    size_t count;
    plr_spirv_fetch *fetches = plr_spirv_fetches(glslang_program_SPIRV_get_ptr(program),
                                                 glslang_program_SPIRV_get_size(program), &count);
    for (size_t i = 0; i < count; i++)
        visit(user, fetches[i].line, fetches[i].name);
    free(fetches);
    glslang_program_delete(program);
    return true;
}
