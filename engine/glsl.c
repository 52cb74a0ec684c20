/* The one file that knows glslang. */
#include "engine/glsl.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/resource_limits_c.h>

#include "engine/glsl_log.h"

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

/* Ranges of SPIR-V opcodes (SPIR-V specification, section 3.42). */
typedef struct opcodes {
    uint16_t first, last;
} opcodes;

/* Inside functions, but no work: structure, names of lines, storage. */
static const opcodes idle[] = {
    {0, 0},     /* OpNop */
    {8, 8},     /* OpLine */
    {54, 56},   /* OpFunction, OpFunctionParameter, OpFunctionEnd */
    {59, 59},   /* OpVariable */
    {246, 248}, /* OpLoopMerge, OpSelectionMerge, OpLabel */
    {317, 317}, /* OpNoLine */
};

/* OpImageSample* .. OpImageDrefGather, and the sparse forms. */
static const opcodes fetching[] = {{87, 97}, {305, 314}};

static bool among(const opcodes *list, size_t count, unsigned opcode) {
    for (size_t i = 0; i < count; i++)
        if (opcode >= list[i].first && opcode <= list[i].last)
            return true;
    return false;
}

static void count_words(const unsigned *words, size_t size, uint32_t *instructions,
                        uint32_t *fetches) {
    enum {
        HEADER = 5,
        FUNCTION = 54,
        FUNCTION_END = 56
    };
    bool inside = false;
    for (size_t at = HEADER; at < size;) {
        unsigned opcode = words[at] & 0xffff, length = words[at] >> 16;
        inside = (inside || opcode == FUNCTION) && opcode != FUNCTION_END;
        if (inside && !among(idle, sizeof idle / sizeof idle[0], opcode))
            ++*instructions;
        if (inside && among(fetching, sizeof fetching / sizeof fetching[0], opcode))
            ++*fetches;
        at += length ? length : 1;
    }
}

/* Below 3.30, asking glslang for SPIR-V makes it print its built-ins on standard output. */
static bool is_countable(const char *text) {
    static const char directive[] = "#version";
    text += strspn(text, " \t\r\n");
    return strncmp(text, directive, sizeof directive - 1) == 0 &&
           strtol(text + sizeof directive - 1, NULL, 10) >= 330;
}

bool plr_glsl_count(const char *text, plr_stage stage, uint32_t *instructions, uint32_t *fetches) {
    glslang_program_t *program = NULL;
    plr_glsl_messages messages;
    *instructions = *fetches = 0;
    if (!is_countable(text))
        return false;
    pthread_once(&once, initialize);
    glslang_shader_t *shader = parse(&counting, text, stage, &messages);
    plr_glsl_messages_free(&messages);
    bool counted = shader && (program = glslang_program_create());
    if (counted) {
        glslang_program_add_shader(program, shader);
        counted = glslang_program_link(program, (int)counting.messages) &&
                  glslang_program_map_io(program);
    }
    if (counted) {
        /* only the passes for size inline functions and drop what is dead */
        glslang_spv_options_t options = {.strip_debug_info = true, .optimize_size = true};
        glslang_program_SPIRV_generate_with_options(program, stages[stage], &options);
        size_t size = glslang_program_SPIRV_get_size(program);
        count_words(glslang_program_SPIRV_get_ptr(program), size, instructions, fetches);
        counted = size > 0;
    }
    if (program)
        glslang_program_delete(program);
    if (shader)
        glslang_shader_delete(shader);
    return counted;
}
