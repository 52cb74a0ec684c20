#include "engine/view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/dialect.h"
#include "engine/state.h"
#include "engine/unreached.h"
#include "engine/volume.h"

/* ---- Making a view ---- */

/* The parts of the view that are set while diagnostics are at hand. */
static void set_diags(plr_view *view, plr_diags *diags) {
    view->textures.diags = diags;
    view->kitchen.diags = diags;
    view->composer.diags = diags;
}

static void init_parts(plr_view *view, const plr_catalog *catalog, plr_diags *diags) {
    view->textures = (plr_textures){
        .arena = &view->arena, .scene = view->scene, .gl = view->engine ? &view->engine->gl : NULL};
    view->kitchen = (plr_kitchen){.arena = &view->arena,
                                  .scene = view->scene,
                                  .catalog = catalog,
                                  .textures = &view->textures};
    view->composer = (plr_composer){.kitchen = &view->kitchen,
                                    .cache = view->engine ? view->engine->cache : NULL,
                                    .check_unreached = !view->engine};
    set_diags(view, diags);
}

/* The unit of gradients that no author gave is found before the voxels leave main memory. */
static void find_gradient_units(plr_view *view) {
    bool needed = false;
    for (size_t i = 0; i < view->volumes.cast_count; i++)
        needed = needed || plr_bind_needs(&view->volumes.casts[i].pass.slots, "gradientUnit");
    for (size_t i = 0; i < view->volumes.count; i++) {
        plr_volume_state *state = &view->volumes.volumes[i];
        if (state->gradient_unit > 0 || !needed)
            continue;
        double strong = plr_image_gradient_percentile(&state->voxels->image, state->dimensions);
        state->gradient_unit = strong > 0 ? 1 / strong : 1;
    }
}

static void upload(plr_view *view) {
    const plr_gl *gl = &view->engine->gl;
    plr_phase start = plr_clock();
    plr_pass_find(view, &view->background);
    for (size_t i = 0; i < view->volumes.cast_count; i++)
        plr_pass_find(view, &view->volumes.casts[i].pass);
    for (size_t i = 0; i < view->model_count; i++)
        plr_pass_find(view, &view->models[i]->pass);
    find_gradient_units(view);
    plr_textures_upload(&view->textures);
    gl->GenVertexArrays(1, &view->empty_vertex_array);
    gl->GenFramebuffers(1, &view->color_only);
    gl->Finish();
    plr_phase end = plr_clock();
    view->stats.upload = (plr_phase){end.cpu_ms - start.cpu_ms, end.wall_ms - start.wall_ms};
}

static bool prepare(plr_view *view, plr_diags *diags) {
    plr_flatten(&view->arena, view->scene, &view->flat, diags);
    view->viewpoint = plr_flat_viewpoint(&view->flat, view->desc.viewpoint);
    if (!view->viewpoint) {
        plr_diags_add(diags, PLR_CODE_UNKNOWN_DEF, (plr_place){0}, "there is no viewpoint '%s'",
                      view->desc.viewpoint);
        return false;
    }
    plr_phase start = plr_clock();
    view->desc.dialect = plr_dialect(view->scene, &view->flat, view->desc.dialect, diags);
    plr_background_prepare(view);
    plr_surfaces_prepare(view, diags);
    plr_volume_pass_prepare(view, diags);
    plr_unreached_report(&view->composer);
    plr_phase end = plr_clock();
    plr_phase link = {view->composer.link_cpu_ms, view->composer.link_wall_ms};
    plr_phase compile = {view->composer.compile_cpu_ms, view->composer.compile_wall_ms};
    view->stats.link = link;
    view->stats.compile = compile;
    view->stats.load = (plr_phase){end.cpu_ms - start.cpu_ms - link.cpu_ms - compile.cpu_ms,
                                   end.wall_ms - start.wall_ms - link.wall_ms - compile.wall_ms};
    if (view->engine)
        upload(view);
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
        set_diags(view, NULL);
    return made;
}

void plr_view_destroy(plr_view **view) {
    plr_view *v = *view;
    if (!v)
        return;
    for (size_t i = 0; i < v->model_count; i++)
        plr_model_finish(v, v->models[i]);
    if (v->engine && v->color_only) {
        plr_framebuffer_destroy(&v->framebuffer);
        v->engine->gl.DeleteFramebuffers(1, &v->color_only);
        v->engine->gl.DeleteVertexArrays(1, &v->empty_vertex_array);
    }
    plr_textures_finish(&v->textures);
    plr_composer_finish(&v->composer);
    plr_kitchen_finish(&v->kitchen);
    plr_catalog_destroy(&v->own_catalog);
    plr_arena_finish(&v->arena);
    free(v);
    *view = NULL;
}

/* ---- Drawing ---- */

/* Near and far planes. With reversed depths the far plane is infinitely far and the near plane may
 * be as near as it likes: precision does not depend on them. Else, and in parallel projection, they
 * hold the surfaces tightly. What effects move beyond them is not cut off: depths are clamped. */
static void plan_depths(const plr_view *view, bool reversed, double depths[2]) {
    plr_matrix world_to_eye;
    plr_matrix_invert(&view->viewpoint->to_world, &world_to_eye);
    plr_surfaces_depths(view, &world_to_eye, depths);
    if (!(depths[1] >= depths[0])) {
        depths[0] = 0.1;
        depths[1] = 10;
    }
    bool parallel = view->viewpoint->node && plr_node_is(view->viewpoint->node, "OrthoViewpoint");
    double margin = 1e-3 * (depths[1] - depths[0]) + 1e-6 * fabs(depths[1]);
    depths[1] += margin;
    depths[0] -= margin;
    if (parallel)
        return;
    depths[1] = fmax(depths[1], 1e-3);
    depths[0] = fmax(depths[0], depths[1] * (reversed ? 1e-7 : 1e-4));
    if (reversed)
        depths[1] = INFINITY;
}

static int farther_first(const void *a, const void *b) {
    double x = (*(plr_surface *const *)a)->depth, y = (*(plr_surface *const *)b)->depth;
    return x < y ? 1 : x > y ? -1 : 0;
}

static void draw_opaque(plr_view *view, const plr_frame *frame) {
    for (size_t i = 0; i < view->surface_count; i++)
        if (!view->surfaces[i].model->blends)
            plr_surface_draw(view, &view->surfaces[i], frame);
}

/* Translucent surfaces and volumes, from the farthest to the nearest. `target` is the framebuffer
 * to draw into; the volumes read the depths of `frame`, so they are drawn without them where that
 * texture belongs to the target (`without_depth`). */
static void draw_translucent(plr_view *view, const plr_frame *frame, GLuint target,
                             GLuint without_depth) {
    const plr_gl *gl = &view->engine->gl;
    qsort(view->blending, view->blending_count, sizeof *view->blending, farther_first);
    plr_volume_depths(view, frame);
    size_t next = 0;
    for (size_t i = 0; i < view->volumes.cast_count; i++) {
        const plr_cast *cast = &view->volumes.casts[i];
        while (next < view->blending_count && view->blending[next]->depth > cast->depth)
            plr_surface_draw(view, view->blending[next++], frame);
        gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, without_depth);
        plr_cast_draw(view, cast, frame);
        gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
    }
    while (next < view->blending_count)
        plr_surface_draw(view, view->blending[next++], frame);
}

/* The depth conventions of our own framebuffer. */
static void set_depth_range(const plr_view *view, const plr_frame *frame) {
    const plr_gl *gl = &view->engine->gl;
    if (gl->ClipControl)
        gl->ClipControl(GL_LOWER_LEFT,
                        frame->reversed_depth ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    if (frame->cut[0] > 0 || isfinite(frame->cut[1]))
        gl->Disable(GL_DEPTH_CLAMP);
    else
        gl->Enable(GL_DEPTH_CLAMP);
}

static void draw_frame(plr_view *view, const plr_frame *frame) {
    const plr_gl *gl = &view->engine->gl;
    set_depth_range(view, frame);
    gl->BindFramebuffer(GL_FRAMEBUFFER, view->color_only);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                             view->framebuffer.color, 0);
    plr_framebuffer_bind(&view->framebuffer);
    plr_background_draw(view, frame);
    draw_opaque(view, frame);
    draw_translucent(view, frame, view->framebuffer.name, view->color_only);
}

/* The radical inverse of Halton's sequence: sample points that fill the pixel evenly. */
static double radical_inverse(int index, int base) {
    double result = 0, part = 1;
    for (; index > 0; index /= base) {
        part /= base;
        result += part * (index % base);
    }
    return result;
}

static void plan_frame(const plr_view *view, const plr_draw_desc *desc, int sample, int samples,
                       bool reversed, plr_frame *frame) {
    double depths[2];
    plan_depths(view, reversed, depths);
    *frame = (plr_frame){.viewport = {0, 0, desc->width, desc->height},
                         .time = view->desc.time,
                         .opaque_depth = view->framebuffer.depth,
                         .reversed_depth = reversed};
    plr_viewpoint_cut(view->viewpoint, frame->cut);
    plr_viewpoint_matrices(view->viewpoint, desc->width, desc->height, depths, &frame->projection,
                           &frame->view);
    if (reversed)
        frame->projection = plr_matrix_reversed_depth(&frame->projection);
    if (samples > 1) {
        plr_matrix shift =
            plr_matrix_translation(2 * (radical_inverse(sample + 1, 2) - 0.5) / desc->width,
                                   2 * (radical_inverse(sample + 1, 3) - 0.5) / desc->height, 0);
        frame->projection = plr_matrix_multiply(&shift, &frame->projection);
    }
}

static bool draw_samples(plr_view *view, const plr_draw_desc *desc, plr_picture *picture) {
    int samples = desc->samples > 1 ? desc->samples : 1;
    size_t count = (size_t)desc->width * (size_t)desc->height * 4;
    float *one = samples > 1 ? malloc(count * sizeof *one) : picture->pixels;
    plr_frame frame;
    bool fine = one != NULL;
    for (int sample = 0; fine && sample < samples; sample++) {
        plan_frame(view, desc, sample, samples, view->engine->gl.ClipControl != NULL, &frame);
        draw_frame(view, &frame);
        fine = plr_framebuffer_read(&view->framebuffer, one);
        for (size_t i = 0; fine && samples > 1 && i < count; i++)
            picture->pixels[i] += one[i] / (float)samples;
    }
    if (samples > 1)
        free(one);
    return fine;
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
        plan_frame(view, &desc, 0, 1, false, &frame);
        matrix_from(&frame.projection, projection);
        matrix_from(&frame.view, camera);
        frame.viewport[0] = state.viewport[0];
        frame.viewport[1] = state.viewport[1];
        frame.opaque_depth = view->framebuffer.depth;
        GLuint host = (GLuint)state.draw_framebuffer;
        draw_opaque(view, &frame);
        copy_depths(view, host, state.viewport);
        draw_translucent(view, &frame, host, host);
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
    plr_frame frame;
    plr_draw_desc desc = {view->framebuffer.width, view->framebuffer.height, 1};
    if (desc.width < 1)
        return;
    plan_frame(view, &desc, 0, 1, false, &frame);
    stats->samples = plr_volume_pass_samples(view, &frame);
}
