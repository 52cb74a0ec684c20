#include "tests/engine/replacement.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *read_text(const char *path) {
    FILE *file = fopen(path, "rb");
    char *text = calloc(1, 1 << 20);
    if (!file || !text || !fread(text, 1, (1 << 20) - 1, file)) {
        fprintf(stderr, "cannot read %s\n", path);
        exit(2);
    }
    fclose(file);
    return text;
}

plr_built *replacement_find(const plr_view *view, const char *name) {
    for (size_t i = 0; i < view->composer.built.count; i++)
        if (strcmp(view->composer.built.items[i]->info.name, name) == 0)
            return view->composer.built.items[i];
    return NULL;
}

/* ---- Compiling ---- */

static void tell(const plr_glsl_messages messages[PLR_STAGE_COUNT], const plr_glsl_messages *link,
                 char *why, size_t size) {
    const char *first = link->count ? link->items[0].text : "";
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
        if (messages[stage].count)
            first = messages[stage].items[0].text;
    snprintf(why, size, "%s", first);
}

GLuint replacement_compile(plr_engine *engine, const plr_built *built,
                           const char *const paths[PLR_STAGE_COUNT], char *why, size_t size) {
    const char *texts[PLR_STAGE_COUNT];
    char *read[PLR_STAGE_COUNT] = {0};
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++) {
        if (paths[stage] && strcmp(paths[stage], "-") != 0)
            read[stage] = read_text(paths[stage]);
        texts[stage] = read[stage] ? read[stage]
                                   : plr_program_text(built->info.program, (plr_stage)stage, NULL);
    }
    plr_glsl_messages messages[PLR_STAGE_COUNT], link;
    GLuint name = 0;
    if (plr_glsl_check(texts, messages, &link))
        name = plr_cache_program(engine->cache, texts, messages, &link);
    if (!name)
        tell(messages, &link, why, size);
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++) {
        plr_glsl_messages_free(&messages[stage]);
        free(read[stage]);
    }
    plr_glsl_messages_free(&link);
    return name;
}

/* ---- Replacing ---- */

static void find_anew(plr_view *view, plr_pass *pass, const plr_built *built) {
    if (pass->built != built)
        return;
    pass->slots = (plr_slots){0};
    plr_pass_find(view, pass);
}

/* Every pass that has the program takes its uniforms from where they are in the new one; attributes
 * of meshes are found when they are drawn next. */
void replacement_use(plr_view *view, plr_built *built, GLuint name) {
    const plr_gl *gl = &view->engine->gl;
    built->name = name;
    built->defaults = plr_cache_defaults(view->engine->cache, name);
    for (size_t i = 0; i < view->model_count; i++) {
        plr_model *model = view->models[i];
        find_anew(view, &model->pass, built);
        if (model->pass.built == built && model->vertex_array) {
            gl->DeleteVertexArrays(1, &model->vertex_array);
            gl->DeleteBuffers(model->buffer_count, model->buffers);
            model->vertex_array = 0;
            model->buffer_count = 0;
        }
    }
    for (size_t i = 0; i < view->volumes.cast_count; i++)
        find_anew(view, &view->volumes.casts[i].pass, built);
}
