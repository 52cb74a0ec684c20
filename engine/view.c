#include "engine/view.h"

#include <stdlib.h>
#include <string.h>

#include "engine/dialect.h"
#include "engine/frame.h"
#include "engine/gpu_timer.h"
#include "engine/ignored.h"
#include "engine/pick.h"
#include "engine/pilot.h"
#include "engine/state.h"
#include "engine/targets.h"
#include "engine/unreached.h"
#include "engine/update.h"
#include "engine/volume.h"

/* ---- Making a view ---- */

void plr_view_set_diags(plr_view *view, plr_diags *diags) {
    view->textures.diags = diags;
    view->kitchen.diags = diags;
    view->composer.diags = diags;
}

static void init_parts(plr_view *view, const plr_catalog *catalog, plr_diags *diags) {
    view->textures = (plr_textures){.arena = &view->lasting,
                                    .scene = view->scene,
                                    .gl = view->engine ? &view->engine->gl : NULL};
    view->kitchen = (plr_kitchen){.arena = &view->arena,
                                  .lasting = &view->lasting,
                                  .scene = view->scene,
                                  .catalog = catalog,
                                  .textures = &view->textures};
    view->composer = (plr_composer){.kitchen = &view->kitchen,
                                    .cache = view->engine ? view->engine->cache : NULL,
                                    .check_unreached = !view->engine};
    if (view->engine && view->desc.interactive && !view->engine->builder)
        view->engine->builder = plr_builder_create(
            &view->engine->gl, view->engine->desc.make_shared_current, view->engine->desc.user);
    if (view->engine && view->desc.interactive)
        view->composer.builder = view->engine->builder;
    plr_view_set_diags(view, diags);
}

static void upload(plr_view *view) {
    const plr_gl *gl = &view->engine->gl;
    plr_world_find(view);
    plr_targets_find(view);
    plr_textures_upload(&view->textures);
    if (!view->empty_vertex_array) {
        gl->GenVertexArrays(1, &view->empty_vertex_array);
        gl->GenFramebuffers(1, &view->color_only);
    }
    gl->Finish();
}

bool plr_view_make(plr_view *view, const plr_matrix *eye_to_world, plr_diags *diags) {
    view->lights = (plr_light_answers){0};
    plr_flatten(&view->arena, view->scene, eye_to_world, &view->flat, diags);
    view->viewpoint = plr_view_chosen(view, &view->flat);
    if (!view->viewpoint) {
        plr_diags_add(diags, PLR_CODE_UNKNOWN_DEF, (plr_place){0}, "there is no viewpoint '%s'",
                      view->desc.viewpoint);
        return false;
    }
    view->viewpoint = plr_flat_bound(&view->flat, view->viewpoint);
    if (!view->made) {
        plr_dialect_report(view->scene, &view->flat, view->asked_dialect, diags);
        plr_ignored_report(&view->arena, view->scene, &view->flat, diags);
    }
    plr_world_prepare(view, diags);
    plr_targets_prepare(view, diags);
    plr_unreached_report(&view->composer);
    plr_view_note_textures(view);
    view->revision = plr_scene_revision(view->scene);
    view->made = true;
    plr_phase start = plr_clock();
    if (view->engine && !view->composer.waiting && !view->composer.refused)
        upload(view);
    plr_phase end = plr_clock();
    view->stats.upload = (plr_phase){end.cpu_ms - start.cpu_ms, end.wall_ms - start.wall_ms};
    return true;
}

static bool prepare(plr_view *view, plr_diags *diags) {
    plr_phase start = plr_clock();
    plr_matrix eye = plr_matrix_identity();
    view->asked_dialect = view->desc.dialect;
    plr_view_live(view, &eye, diags);
    view->eye_to_world = eye;
    if (!plr_view_make(view, &eye, diags))
        return false;
    plr_phase end = plr_clock(), upload = view->stats.upload;
    plr_phase link = {view->composer.link_cpu_ms, view->composer.link_wall_ms};
    plr_phase compile = {view->composer.compile_cpu_ms, view->composer.compile_wall_ms};
    view->stats.link = link;
    view->stats.compile = compile;
    view->stats.load =
        (plr_phase){end.cpu_ms - start.cpu_ms - link.cpu_ms - compile.cpu_ms - upload.cpu_ms,
                    end.wall_ms - start.wall_ms - link.wall_ms - compile.wall_ms - upload.wall_ms};
    return true;
}

plr_view *plr_view_create(plr_engine *engine, plr_scene *scene, const plr_view_desc *desc,
                          plr_diags *diags) {
    plr_view *volatile view = calloc(1, sizeof *view);
    if (!view)
        return NULL;
    view->engine = engine;
    view->scene = scene;
    if (desc)
        view->desc = *desc;
    jmp_buf out_of_memory;
    plr_arena_init(&view->arena, NULL, &out_of_memory);
    plr_arena_init(&view->lasting, NULL, &out_of_memory);
    plr_view *made = view;
    if (setjmp(out_of_memory)) {
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, (plr_place){0}, "there is not enough memory");
        made = view;
        plr_view_destroy(&made);
        return NULL;
    }
    if (!engine)
        view->own_catalog = plr_catalog_create(diags);
    const plr_catalog *catalog = engine ? engine->catalog : view->own_catalog;
    if (!catalog)
        longjmp(out_of_memory, 1);
    init_parts(view, catalog, diags);
    if (!prepare(view, diags))
        plr_view_destroy(&made);
    else
        plr_view_set_diags(view, NULL);
    return made;
}

void plr_view_destroy(plr_view **view) {
    plr_view *v = *view;
    if (!v)
        return;
    plr_targets_finish(v);
    plr_world_finish(v);
    if (v->engine && v->color_only) {
        plr_framebuffer_destroy(&v->framebuffer);
        plr_pilot_finish(v);
        plr_spare_depths_destroy(&v->spare);
        v->engine->gl.DeleteFramebuffers(1, &v->color_only);
        v->engine->gl.DeleteVertexArrays(1, &v->empty_vertex_array);
    }
    plr_picked_data_free(&v->picked);
    plr_textures_finish(&v->textures);
    plr_composer_finish(&v->composer);
    plr_kitchen_finish(&v->kitchen);
    plr_catalog_destroy(&v->own_catalog);
    plr_arena_finish(&v->arena);
    plr_arena_finish(&v->lasting);
    free(v);
    *view = NULL;
}

/* ---- Drawing ---- */

static void plan(const plr_view *view, const plr_draw_desc *desc, bool reversed, plr_frame *frame) {
    plr_frame_plan(view, view->viewpoint, desc->width, desc->height, reversed, frame);
    frame->opaque_depth = view->framebuffer.depth;
}

static void draw_sample(plr_view *view, const plr_frame *frame) {
    const plr_gl *gl = &view->engine->gl;
    static const float nothing[4] = {0, 0, 0, 0};
    gl->BindFramebuffer(GL_FRAMEBUFFER, view->color_only);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                             view->framebuffer.color, 0);
    const plr_shot shot = {.framebuffer = view->framebuffer.name,
                           .without_depth = view->color_only,
                           .depths = view->framebuffer.name,
                           .background = &view->background,
                           .behind = nothing};
    plr_frame_draw(view, frame, &shot);
}

static bool draw_samples(plr_view *view, const plr_draw_desc *desc, plr_picture *picture) {
    int samples = desc->samples > 1 ? desc->samples : 1;
    size_t count = (size_t)desc->width * (size_t)desc->height * 4;
    float *one = samples > 1 ? malloc(count * sizeof *one) : picture->pixels;
    plr_frame frame;
    bool fine = one != NULL;
    const plr_gl *gl = &view->engine->gl;
    plr_gpu_timer timer;
    bool timed = plr_gpu_timer_create(&timer, gl);
    if (timed)
        plr_gpu_timer_start(&timer, gl);
    if (fine) {
        plr_targets_draw(view, NULL);
        plan(view, desc, plr_frame_reversed(view), &frame);
        plr_pilot_fly(view, &frame, NULL);
    }
    for (int sample = 0; fine && sample < samples; sample++) {
        plan(view, desc, plr_frame_reversed(view), &frame);
        plr_frame_jitter(&frame, sample, samples);
        if (timed && sample > 0)
            plr_gpu_timer_start(&timer, gl);
        draw_sample(view, &frame);
        if (timed)
            plr_gpu_timer_stop(&timer, gl);
        fine = plr_framebuffer_read(&view->framebuffer, one);
        if (timed)
            plr_gpu_timer_add(&timer, gl);
        for (size_t i = 0; fine && samples > 1 && i < count; i++)
            picture->pixels[i] += one[i] / (float)samples;
    }
    view->stats.gpu_ms = timed ? timer.ms : 0;
    if (timed)
        plr_gpu_timer_destroy(&timer, gl);
    if (samples > 1)
        free(one);
    return fine;
}

void plr_view_draw_again(plr_view *view) {
    const plr_draw_desc desc = {view->framebuffer.width, view->framebuffer.height, 1};
    plr_frame frame;
    plan(view, &desc, plr_frame_reversed(view), &frame);
    draw_sample(view, &frame);
}

static bool size_framebuffer(plr_view *view, int width, int height, plr_diags *diags) {
    plr_framebuffer *framebuffer = &view->framebuffer;
    return framebuffer->name
               ? plr_framebuffer_resize(framebuffer, width, height, diags)
               : plr_framebuffer_create(framebuffer, &view->engine->gl, width, height, diags);
}

bool plr_view_draw(plr_view *view, const plr_draw_desc *desc, plr_picture *picture,
                   plr_diags *diags) {
    *picture = (plr_picture){0};
    if (!view->engine || desc->width < 1 || desc->height < 1)
        return false;
    bool sized = size_framebuffer(view, desc->width, desc->height, diags);
    size_t count = (size_t)desc->width * (size_t)desc->height * 4;
    picture->pixels = sized ? calloc(count, sizeof(float)) : NULL;
    if (!picture->pixels)
        return false;
    picture->width = desc->width;
    picture->height = desc->height;
    plr_phase start = plr_clock();
    bool fine = draw_samples(view, desc, picture);
    plr_phase end = plr_clock();
    view->stats.draw = (plr_phase){end.cpu_ms - start.cpu_ms, end.wall_ms - start.wall_ms};
    if (!fine)
        plr_picture_free(picture);
    return fine;
}

/* The depths that the host drew, in a texture of our own, which volumes can read. */
static void copy_depths(const plr_view *view, GLuint host, const GLint viewport[4]) {
    const plr_gl *gl = &view->engine->gl;
    gl->BindFramebuffer(GL_FRAMEBUFFER, view->framebuffer.name);
    gl->Disable(GL_SCISSOR_TEST);
    gl->DepthMask(GL_TRUE);
    gl->ClearDepth(1);
    gl->Clear(GL_DEPTH_BUFFER_BIT); /* what stands where the host has no depths */
    gl->BindFramebuffer(GL_FRAMEBUFFER, host);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, view->framebuffer.depth);
    gl->CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, viewport[0], viewport[1], viewport[2],
                          viewport[3]);
}

static void matrix_from(plr_matrix *matrix, const double *values) {
    if (values)
        memcpy(matrix->m, values, sizeof matrix->m);
}

bool plr_view_draw_here(plr_view *view, const double *projection, const double *camera,
                        plr_diags *diags) {
    if (!view->engine)
        return false;
    const plr_gl *gl = &view->engine->gl;
    plr_gl_state state;
    plr_gl_state_save(gl, &state);
    plr_draw_desc desc = {state.viewport[2], state.viewport[3], 1};
    bool fine =
        desc.width > 0 && desc.height > 0 && size_framebuffer(view, desc.width, desc.height, diags);
    if (fine) {
        plr_frame frame;
        plan(view, &desc, false, &frame);
        matrix_from(&frame.projection, projection);
        matrix_from(&frame.view, camera);
        plr_targets_draw(view, &frame);
        plr_pilot_fly(view, &frame, &frame);
        plr_gl_state_restore(gl, &state);
        double depths[2];
        plr_surfaces_depths(view, &frame.view, depths); /* sorts for the host's camera */
        frame.viewport[0] = state.viewport[0];
        frame.viewport[1] = state.viewport[1];
        GLuint host = (GLuint)state.draw_framebuffer;
        const plr_shot shot = {.framebuffer = host,
                               .without_depth = host,
                               .depths = view->framebuffer.name,
                               .depths_copied = true};
        plr_frame_draw_opaque(view, &frame, &shot);
        copy_depths(view, host, state.viewport);
        plr_frame_draw_translucent(view, &frame, &shot);
    }
    plr_gl_state_restore(gl, &state);
    return fine;
}

/* ---- What a view is made of ---- */

size_t plr_view_program_count(const plr_view *view) {
    return view->composer.built.count;
}

const plr_program_info *plr_view_program(const plr_view *view, size_t index) {
    if (index >= view->composer.built.count)
        return NULL;
    plr_program_info *info = &view->composer.built.items[index]->info;
    const char *text = plr_program_text(info->program, PLR_FRAGMENT, NULL);
    if (!info->instructions && text)
        plr_glsl_count(text, PLR_FRAGMENT, &info->instructions, &info->fetches);
    return info;
}

void plr_view_get_stats(const plr_view *view, plr_view_stats *stats) {
    *stats = view->stats;
    stats->building = view->composer.builder ? plr_builder_waiting(view->composer.builder) : 0;
    stats->general = view->general;
    plr_frame frame;
    plr_draw_desc desc = {view->framebuffer.width, view->framebuffer.height, 1};
    if (desc.width < 1)
        return;
    plan(view, &desc, false, &frame);
    stats->samples = plr_volume_pass_samples(view, &frame);
}

/* What says most about a picture: the plan that promises least. */
void plr_view_get_plan(const plr_view *view, plr_plan *plan) {
    const plr_volume_pass *pass = &view->volumes;
    *plan = (plr_plan){.value = -1, .why = "there are no volumes"};
    for (size_t i = 0; i < pass->cast_count; i++) {
        const plr_plan *one = &pass->casts[i].plan;
        bool worse =
            (plan->bounded && !one->bounded) ||
            (plan->bounded == one->bounded && (one->value < 0 || one->value > plan->value));
        if (i == 0 || worse)
            *plan = *one;
    }
}
