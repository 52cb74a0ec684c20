#include "engine/targets_draw.h"

#include <math.h>

#include "engine/frame.h"

static const float black[4] = {0, 0, 0, 1};

static bool is_cube(const plr_target *target) {
    return plr_texture_dimensions(target->texture) == PLR_TEXTURE_CUBE;
}

/* Attaches a face (0 to 5, or 0 of what is no cube), makes the canvas first. */
static bool attach(plr_view *view, plr_target *target, int face) {
    const plr_texture *texture = target->texture;
    const plr_gl *gl = &view->engine->gl;
    if (!texture->name ||
        (!target->canvas.gl && !plr_canvas_create(&target->canvas, gl, (int)texture->width,
                                                  (int)texture->height, texture->depth)))
        return false;
    GLenum image = is_cube(target) ? GL_TEXTURE_CUBE_MAP_POSITIVE_X + (GLenum)face : GL_TEXTURE_2D;
    plr_canvas_attach(&target->canvas, image, texture->name);
    return gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

static void clear_bound(const plr_view *view) {
    const plr_gl *gl = &view->engine->gl;
    gl->Disable(GL_SCISSOR_TEST);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->DepthMask(GL_TRUE);
    gl->ClearColor(black[0], black[1], black[2], black[3]);
    gl->ClearDepth(1);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void plr_target_clear(plr_view *view, plr_target *target) {
    if (!target->clear)
        return;
    target->clear = false;
    for (int face = 0; face < (is_cube(target) ? 6 : 1); face++)
        if (attach(view, target, face))
            clear_bound(view);
    plr_texture_drawn(target->texture);
}

/* ---- One drawing a kind ---- */

static void draw_shot(plr_view *view, plr_target *target, plr_frame *frame) {
    frame->opaque_depth = target->canvas.depth;
    const plr_shot shot = {.framebuffer = target->canvas.name,
                           .without_depth = target->canvas.without_depth,
                           .depths = target->canvas.name,
                           .background =
                               target->background ? target->background : &view->background,
                           .behind = black,
                           .avoid = target->texture};
    plr_frame_draw(view, frame, &shot);
}

/* Depths alone: what is translucent has none. */
static void draw_depths(plr_view *view, plr_target *target, const plr_frame *frame) {
    const plr_gl *gl = &view->engine->gl;
    const plr_shot shot = {.framebuffer = target->canvas.name, .avoid = target->texture};
    plr_frame_conventions(view, frame);
    gl->Viewport(0, 0, (GLsizei)target->texture->width, (GLsizei)target->texture->height);
    clear_bound(view);
    plr_frame_draw_opaque(view, frame, &shot);
}

void plr_target_plan(plr_view *view, const plr_target *target, const plr_frame *here,
                     plr_frame *frame) {
    const plr_viewpoint *viewpoint = target->viewpoint ? target->viewpoint : view->viewpoint;
    bool reversed = !target->texture->depth && plr_frame_reversed(view);
    plr_frame_plan(view, viewpoint, (int)target->texture->width, (int)target->texture->height,
                   reversed, frame);
    if (!here || target->viewpoint)
        return;
    frame->view = here->view;
    frame->projection = here->projection;
    frame->reversed_depth = here->reversed_depth;
}

static void draw_rendered(plr_view *view, plr_target *target, const plr_frame *here) {
    plr_frame frame;
    if (!attach(view, target, 0))
        return;
    plr_target_plan(view, target, here, &frame);
    if (target->texture->depth)
        draw_depths(view, target, &frame);
    else
        draw_shot(view, target, &frame);
}

/* The middle of the shape's box, and the texture's `bias` from there, in the shape's coordinates.
 */
static void place_of(const plr_target *target, double place[3]) {
    const plr_mesh *mesh = &target->reader->model->mesh;
    float bias[3] = {0, 0, 0};
    plr_node_numbers(target->node, "bias", bias, 3);
    for (int axis = 0; axis < 3; axis++)
        place[axis] = ((double)mesh->bounds[0][axis] + (double)mesh->bounds[1][axis]) / 2 +
                      (double)bias[axis];
    plr_matrix_point(&target->reader->to_world, place, place);
}

static void draw_cube(plr_view *view, plr_target *target, const plr_frame *here) {
    (void)here;
    if (!target->reader)
        return;
    double place[3], depths[2];
    place_of(target, place);
    bool reversed = plr_frame_reversed(view);
    for (int face = 0; face < 6; face++) {
        plr_frame frame = {
            .viewport = {0, 0, target->texture->width, target->texture->height},
            .cut = {0, INFINITY},
            .time = view->desc.time,
            .reversed_depth = reversed,
            .view = plr_frame_cube_face(place, face),
        };
        plr_frame_depths(view, &frame.view, false, reversed, depths);
        frame.projection = plr_matrix_perspective((double[]){-1, -1, 1, 1}, depths[0], depths[1]);
        if (reversed)
            frame.projection = plr_matrix_reversed_depth(&frame.projection);
        if (attach(view, target, face))
            draw_shot(view, target, &frame);
    }
}

static void draw_shadow(plr_view *view, plr_target *target, const plr_frame *here) {
    (void)here;
    plr_frame frames[6];
    int count = plr_shadow_plan(view, target->shadow, frames);
    for (int face = 0; face < count; face++) {
        if (!attach(view, target, face))
            return;
        plr_frame_conventions(view, &frames[face]);
        view->engine->gl.Viewport(0, 0, (GLsizei)target->texture->width,
                                  (GLsizei)target->texture->height);
        clear_bound(view);
        plr_casters_draw(view, target->shadow, &frames[face]);
    }
}

void plr_target_draw(plr_view *view, plr_target *target, const plr_frame *here) {
    plr_world *world = target->world;
    if (world)
        plr_view_enter(view, world);
    if (target->shadow)
        draw_shadow(view, target, here);
    else if (is_cube(target))
        draw_cube(view, target, here);
    else
        draw_rendered(view, target, here);
    if (world)
        plr_view_enter(view, world);
    plr_texture_drawn(target->texture);
}
