#include "helper.h"

#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/resource_limits_c.h>

enum {
    MOST = PLR_MOST_ATTACHED + 8
};

static struct {
    const plr_source *base[MOST], *library[MOST], *units[MOST][MOST];
    plr_effect effects[MOST];
    plr_link_desc desc;
    plr_source *all[MOST * 4];
    size_t count;
    linked result;
} state;

static bool started; /* glslang is */

static void forget(void) {
    plr_program_destroy(&state.result.program);
    plr_diags_destroy(&state.result.diags);
    for (size_t i = 0; i < state.count; i++)
        plr_source_destroy(&state.all[i]);
    memset(&state, 0, sizeof state);
}

void free_all(void) {
    forget();
    if (started)
        glslang_finalize_process();
    started = false;
}

void begin(void) {
    forget();
    state.result.diags = plr_diags_create(NULL);
    state.desc.base = state.base;
    state.desc.library = state.library;
    state.desc.effects = state.effects;
}

static plr_source *read_text(plr_stage stage, const char *name, const char *text) {
    char file[64];
    static const char *const endings[] = {"vert", "geom", "frag"};
    snprintf(file, sizeof file, "%s.%s", name, endings[stage]);
    plr_origin origin = {.file = file};
    plr_source *source =
        plr_source_read(stage, text, strlen(text), &origin, NULL, state.result.diags);
    state.all[state.count++] = source;
    return source;
}

void base(const char *text) {
    state.base[state.desc.base_count++] = read_text(PLR_FRAGMENT, "base", text);
}

void base_vertex(const char *text) {
    state.base[state.desc.base_count++] = read_text(PLR_VERTEX, "base", text);
}

void base_geometry(const char *text) {
    state.base[state.desc.base_count++] = read_text(PLR_GEOMETRY, "base", text);
}

void library(const char *text) {
    state.library[state.desc.library_count++] = read_text(PLR_FRAGMENT, "library", text);
}

void library_vertex(const char *text) {
    state.library[state.desc.library_count++] = read_text(PLR_VERTEX, "library", text);
}

static void add_unit(plr_stage stage, const char *text) {
    size_t at = state.desc.effect_count - 1;
    char name[2] = {(char)('a' + at % 26), 0};
    state.units[at][state.effects[at].source_count++] = read_text(stage, name, text);
}

plr_effect *effect(const char *text) {
    size_t at = state.desc.effect_count++;
    state.effects[at].sources = state.units[at];
    if (text)
        add_unit(PLR_FRAGMENT, text);
    return &state.effects[at];
}

plr_effect *same_effect_again(void) {
    size_t at = state.desc.effect_count++;
    state.effects[at] = state.effects[at - 1];
    return &state.effects[at];
}

void unit(const char *text) {
    add_unit(PLR_FRAGMENT, text);
}

void vertex_unit(const char *text) {
    add_unit(PLR_VERTEX, text);
}

void geometry_unit(const char *text) {
    add_unit(PLR_GEOMETRY, text);
}

plr_link_desc *description(void) {
    return &state.desc;
}

const linked *link_all(void) {
    linked *r = &state.result;
    plr_program_destroy(&r->program);
    r->program = plr_link(&state.desc, r->diags);
    r->fragment = r->program ? plr_program_text(r->program, PLR_FRAGMENT, NULL) : NULL;
    r->vertex = r->program ? plr_program_text(r->program, PLR_VERTEX, NULL) : NULL;
    r->geometry = r->program ? plr_program_text(r->program, PLR_GEOMETRY, NULL) : NULL;
    r->fragment = r->fragment ? r->fragment : "";
    r->geometry = r->geometry ? r->geometry : "";
    r->vertex = r->vertex ? r->vertex : "";
    return r;
}

const linked *link_result(void) {
    return &state.result;
}

/* ---- glslang -----------------------------------------------------------------------------------
 */

static void print_comment(const char *text) {
    while (*text) {
        size_t length = strcspn(text, "\n");
        printf("#   %.*s\n", (int)length, text);
        text += length + (text[length] == '\n');
    }
}

static glslang_shader_t *compile(const char *text, glslang_stage_t stage, bool *good) {
    glslang_input_t input = {.language = GLSLANG_SOURCE_GLSL,
                             .stage = stage,
                             .client = GLSLANG_CLIENT_NONE,
                             .target_language = GLSLANG_TARGET_NONE,
                             .code = text,
                             .default_version = 330,
                             .default_profile = GLSLANG_CORE_PROFILE,
                             .messages = GLSLANG_MSG_DEFAULT_BIT,
                             .resource = glslang_default_resource()};
    glslang_shader_t *shader = glslang_shader_create(&input);
    if (!glslang_shader_preprocess(shader, &input) || !glslang_shader_parse(shader, &input)) {
        *good = false;
        print_comment(glslang_shader_get_info_log(shader));
    }
    return shader;
}

bool link_compiles(void) {
    if (!started) {
        glslang_initialize_process();
        started = true;
    }
    const linked *r = link_all();
    bool good = r->program != NULL;
    const char *const texts[] = {r->vertex, r->geometry, r->fragment};
    const glslang_stage_t stages[] = {GLSLANG_STAGE_VERTEX, GLSLANG_STAGE_GEOMETRY,
                                      GLSLANG_STAGE_FRAGMENT};
    glslang_shader_t *shaders[3] = {NULL, NULL, NULL};
    for (int i = 0; i < 3; i++)
        if (*texts[i])
            shaders[i] = compile(texts[i], stages[i], &good);
    glslang_program_t *program = glslang_program_create();
    for (int i = 0; i < 3; i++)
        if (shaders[i] && good)
            glslang_program_add_shader(program, shaders[i]);
    if (good && !glslang_program_link(program, GLSLANG_MSG_DEFAULT_BIT)) {
        good = false;
        print_comment(glslang_program_get_info_log(program));
    }
    glslang_program_delete(program);
    for (int i = 0; i < 3; i++)
        if (shaders[i])
            glslang_shader_delete(shaders[i]);
    return good;
}

/* ---- Looking -----------------------------------------------------------------------------------
 */

int occurrences(const char *text, const char *part) {
    int count = 0;
    for (const char *at = text; (at = strstr(at, part)) != NULL; at++)
        count++;
    return count;
}

bool in_order(const char *text, const char *first, const char *second) {
    const char *at = strstr(text, first);
    return at && strstr(at + strlen(first), second);
}

bool said(const char *place, const char *code) {
    for (size_t i = 0; i < plr_diags_count(state.result.diags); i++) {
        const plr_diag *diag = plr_diags_get(state.result.diags, i);
        char text[256];
        snprintf(text, sizeof text, "%s:%u:%u: %s", diag->place.file ? diag->place.file : "",
                 (unsigned)diag->place.line, (unsigned)diag->place.column,
                 plr_severity_text(diag->severity));
        if (strcmp(text, place) == 0 && strcmp(plr_code_text(diag->code), code) == 0)
            return true;
    }
    return false;
}

bool said_text(const char *part) {
    for (size_t i = 0; i < plr_diags_count(state.result.diags); i++)
        if (strstr(plr_diags_get(state.result.diags, i)->message, part))
            return true;
    return false;
}

void explain(void) {
    for (size_t i = 0; i < plr_diags_count(state.result.diags); i++) {
        const plr_diag *diag = plr_diags_get(state.result.diags, i);
        printf("#   %s:%u:%u: %s: %s [%s]\n", diag->place.file ? diag->place.file : "",
               (unsigned)diag->place.line, (unsigned)diag->place.column,
               plr_severity_text(diag->severity), diag->message, plr_code_text(diag->code));
    }
    print_comment(state.result.vertex ? state.result.vertex : "");
    print_comment(state.result.geometry ? state.result.geometry : "");
    print_comment(state.result.fragment ? state.result.fragment : "");
}
