/* What is seen in a pixel: one ray through its centre, cast by the programs that draw. */
#include "engine/pick.h"

#include <math.h>
#include <string.h>

#include "engine/frame.h"
#include "engine/state.h"
#include "engine/targets.h"
#include "engine/volume_pass.h"

/* ---- Rays ---- */

static bool is_pixel(const plr_draw_desc *desc, int x, int y) {
    return desc->width > 0 && desc->height > 0 && x >= 0 && y >= 0 && x < desc->width &&
           y < desc->height;
}

static void world_point(const plr_frame *frame, const plr_ray *ray, double t, double point[3]) {
    plr_matrix to_world;
    plr_matrix_invert(&frame->view, &to_world);
    for (int i = 0; i < 3; i++)
        point[i] = ray->origin[i] + t * ray->direction[i];
    plr_matrix_point(&to_world, point, point);
}

/* From world coordinates to the texture coordinates of the volume's box. */
static void box_point(const plr_volume_state *volume, const double world[3], double place[3]) {
    plr_matrix from_world;
    plr_matrix_invert(&volume->to_world, &from_world);
    plr_matrix_point(&from_world, world, place);
    for (int i = 0; i < 3; i++)
        place[i] = place[i] / volume->dimensions[i] + 0.5;
}

/* ---- One pixel of a picture ---- */

/* A picture of this pixel alone. */
typedef struct spot {
    plr_view *view;
    plr_framebuffer framebuffer;
    plr_frame frame;
    plr_ray ray;
} spot;

static bool open_spot(spot *s, const plr_draw_desc *desc, int x, int y, plr_diags *diags) {
    plr_view *view = s->view;
    bool reversed = plr_frame_reversed(view);
    plr_frame_plan(view, view->viewpoint, desc->width, desc->height, reversed, &s->frame);
    s->frame.viewport[0] = -x;
    s->frame.viewport[1] = y + 1 - desc->height;
    plr_frame_ray(&s->frame, 0.5, 0.5, &s->ray);
    if (!plr_framebuffer_create(&s->framebuffer, &view->engine->gl, 1, 1, diags))
        return false;
    s->frame.opaque_depth = s->framebuffer.depth;
    return true;
}

static void enter(const spot *s, GLuint framebuffer) {
    const plr_gl *gl = &s->view->engine->gl;
    plr_frame_conventions(s->view, &s->frame);
    gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->Viewport((GLint)s->frame.viewport[0], (GLint)s->frame.viewport[1],
                 (GLsizei)s->frame.viewport[2], (GLsizei)s->frame.viewport[3]);
    gl->Disable(GL_SCISSOR_TEST);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

/* The depth of the first `count` surfaces that are opaque. */
static float draw_depth(const spot *s, size_t count) {
    plr_view *view = s->view;
    const plr_gl *gl = &view->engine->gl;
    float depth = 0;
    enter(s, s->framebuffer.name);
    gl->DepthMask(GL_TRUE);
    gl->ClearDepth(s->frame.reversed_depth ? 0 : 1);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    for (size_t i = 0; i < count; i++)
        if (!view->surfaces[i].model->blends)
            plr_surface_draw(view, &view->surfaces[i], &s->frame);
    plr_framebuffer_read_depth(&s->framebuffer, &depth);
    return depth;
}

/* What is seen of a cast: distance along the ray (infinite: nothing), volume, surface. */
typedef struct sight {
    double t;
    size_t volume;
    int surface;
} sight;

static plr_cast *picking_of(plr_view *view, plr_cast *cast) {
    if (cast->picking)
        return cast->picking;
    plr_cast *picking = PLR_NEW(&view->arena, plr_cast);
    *picking = *cast;
    picking->pass = (plr_pass){0};
    picking->picks = true;
    plr_cast_build_recipe(view, picking, true, NULL);
    picking->pass.built =
        plr_compose_program(&view->composer, &picking->pass.recipe, "pick", &picking->pass.program);
    plr_pass_find(view, &picking->pass);
    return cast->picking = picking;
}

static sight look(const spot *s, plr_cast *cast) {
    plr_view *view = s->view;
    const plr_gl *gl = &view->engine->gl;
    float pixel[4] = {0};
    plr_cast *picking = picking_of(view, cast);
    picking->nearest = cast->nearest;
    picking->farthest = cast->farthest;
    enter(s, view->color_only);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                             s->framebuffer.color, 0);
    gl->ClearColor(0, 0, 0, 0);
    gl->Clear(GL_COLOR_BUFFER_BIT);
    plr_cast_draw(view, picking, &s->frame);
    plr_framebuffer_read(&s->framebuffer, pixel);
    if (!(pixel[3] > 0) || !(pixel[1] >= 0))
        return (sight){.t = INFINITY};
    return (sight){(double)pixel[0], (size_t)pixel[1], (int)pixel[2]};
}

/* ---- Answers ---- */

/* Volumes that are drawn: general worlds have hidden ones, too. */
static size_t drawn_before(const plr_view *view, size_t index) {
    size_t count = 0;
    for (size_t i = 0; i < index; i++)
        count += !view->volumes.volumes[i].hidden;
    return count;
}

static void fill_volume(const spot *s, const sight *seen, plr_pick *pick) {
    const plr_volume_state *volume = &s->view->volumes.volumes[seen->volume];
    double place[3];
    pick->volume = volume->node;
    pick->volume_index = drawn_before(s->view, seen->volume);
    pick->surface = volume->kind == PLR_VOLUME_SURFACES ? seen->surface : -1;
    pick->distance = seen->t;
    world_point(&s->frame, &s->ray, seen->t, pick->position);
    box_point(volume, pick->position, place);
    plr_pick_read(s->view, volume, place, pick);
}

/* The surface with that depth is the last one of the fewest that have it: found by halving. */
static void fill_shape(const spot *s, float depth, plr_pick *pick) {
    plr_view *view = s->view;
    size_t without = 0, with = view->surface_count;
    while (with - without > 1) {
        size_t middle = without + (with - without) / 2;
        if (draw_depth(s, middle) == depth)
            with = middle;
        else
            without = middle;
    }
    pick->shape = view->surfaces[with - 1].model->node;
    pick->shape_index = with - 1;
    pick->distance = plr_frame_distance(&s->frame, &s->ray, (double)depth);
    world_point(&s->frame, &s->ray, pick->distance, pick->position);
}

static void pick_in(const spot *s, plr_pick *pick) {
    plr_volume_pass *volumes = &s->view->volumes;
    float empty = s->frame.reversed_depth ? 0 : 1;
    float depth = draw_depth(s, s->view->surface_count);
    sight nearest = {.t = INFINITY};
    plr_volume_depths(s->view, &s->frame);
    for (size_t i = 0; i < volumes->cast_count; i++) {
        sight seen = look(s, &volumes->casts[i]);
        if (seen.t < nearest.t && seen.volume < volumes->count)
            nearest = seen;
    }
    if (isfinite(nearest.t))
        fill_volume(s, &nearest, pick);
    else if (depth != empty)
        fill_shape(s, depth, pick);
}

static bool pick_guarded(plr_view *view, const plr_draw_desc *desc, int x, int y, plr_pick *pick,
                         plr_diags *diags) {
    jmp_buf out_of_memory;
    plr_gl_state state;
    spot s = {.view = view};
    volatile bool fine = false;
    plr_gl_state_save(&view->engine->gl, &state);
    view->arena.out_of_memory = view->lasting.out_of_memory = &out_of_memory;
    if (setjmp(out_of_memory) == 0) {
        plr_targets_draw(view, NULL);
        fine = open_spot(&s, desc, x, y, diags);
        if (fine)
            pick_in(&s, pick);
    } else {
        fine = false;
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, (plr_place){0}, "there is not enough memory");
    }
    plr_framebuffer_destroy(&s.framebuffer);
    plr_gl_state_restore(&view->engine->gl, &state);
    return fine;
}

bool plr_view_pick(plr_view *view, const plr_draw_desc *desc, int x, int y, plr_pick *pick,
                   plr_diags *diags) {
    *pick = (plr_pick){.surface = -1};
    return view->engine && is_pixel(desc, x, y) && pick_guarded(view, desc, x, y, pick, diags);
}

/* ---- Boxes ---- */

bool plr_view_pick_box(const plr_view *view, const plr_draw_desc *desc, int x, int y,
                       plr_box_pick *pick) {
    *pick = (plr_box_pick){.distance = INFINITY};
    if (!is_pixel(desc, x, y))
        return false;
    plr_frame frame;
    plr_ray ray;
    plr_frame_plan(view, view->viewpoint, desc->width, desc->height, false, &frame);
    plr_frame_ray(&frame, x + 0.5, desc->height - y - 0.5, &ray);
    for (size_t i = 0; i < view->volumes.count; i++) {
        double range[2];
        const plr_volume_state *volume = &view->volumes.volumes[i];
        if (volume->hidden || !plr_volume_crossed(volume, &frame, &ray, range) ||
            !(range[0] < pick->distance))
            continue;
        pick->volume = volume->node;
        pick->volume_index = drawn_before(view, i);
        pick->distance = range[0];
        world_point(&frame, &ray, range[0], pick->entry);
        world_point(&frame, &ray, range[1], pick->exit);
    }
    return pick->volume != NULL;
}
