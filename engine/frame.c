#include "engine/frame.h"

#include <math.h>

/* ---- Planning ---- */

/* Where volumes write depths, these are between the planes, too. */
static void hold_volumes(const plr_view *view, const plr_matrix *world_to_eye, double depths[2]) {
    for (size_t i = 0; i < view->volumes.count; i++) {
        const plr_volume_state *volume = &view->volumes.volumes[i];
        if (!plr_node_bool(volume->node, "writeDepth"))
            continue;
        plr_matrix to_eye = plr_matrix_multiply(world_to_eye, &volume->to_world);
        for (int corner = 0; corner < 8; corner++) {
            double point[3];
            for (int axis = 0; axis < 3; axis++)
                point[axis] = volume->dimensions[axis] * ((corner >> axis & 1) - 0.5);
            plr_matrix_point(&to_eye, point, point);
            depths[0] = fmin(depths[0], -point[2]);
            depths[1] = fmax(depths[1], -point[2]);
        }
    }
}

/* With reversed depths the far plane is infinitely far and the near plane may be as near as it
 * likes: precision does not depend on them. Else, and in parallel projection, they hold the
 * surfaces tightly. What effects move beyond them is not cut off: depths are clamped. */
void plr_frame_depths(const plr_view *view, const plr_matrix *world_to_eye, bool parallel,
                      bool reversed, double depths[2]) {
    plr_surfaces_depths(view, world_to_eye, depths);
    hold_volumes(view, world_to_eye, depths);
    if (!(depths[1] >= depths[0])) {
        depths[0] = 0.1;
        depths[1] = 10;
    }
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

void plr_frame_plan(const plr_view *view, const plr_viewpoint *viewpoint, int width, int height,
                    bool reversed, plr_frame *frame) {
    double depths[2];
    plr_matrix world_to_eye;
    plr_matrix_invert(&viewpoint->to_world, &world_to_eye);
    bool parallel = viewpoint->node && plr_node_is(viewpoint->node, "OrthoViewpoint");
    plr_frame_depths(view, &world_to_eye, parallel, reversed, depths);
    *frame = (plr_frame){
        .viewport = {0, 0, width, height}, .time = view->desc.time, .reversed_depth = reversed};
    plr_viewpoint_cut(viewpoint, frame->cut);
    plr_viewpoint_matrices(viewpoint, width, height, depths, &frame->projection, &frame->view);
    if (reversed)
        frame->projection = plr_matrix_reversed_depth(&frame->projection);
}

/* OpenGL 3.3, table 3.19: rows are s and t of a face, and what it faces; t runs up in what is
 * drawn, and the eye looks along -z. */
plr_matrix plr_frame_cube_face(const double place[3], int face) {
    static const signed char rows[6][3][3] = {
        {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}}, {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}},
        {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},   {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
        {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}},  {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}};
    plr_matrix turn = plr_matrix_identity();
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            turn.m[column * 4 + row] = rows[face][row][column];
    plr_matrix move = plr_matrix_translation(-place[0], -place[1], -place[2]);
    return plr_matrix_multiply(&turn, &move);
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

void plr_frame_jitter(plr_frame *frame, int sample, int samples) {
    if (samples < 2)
        return;
    plr_matrix shift =
        plr_matrix_translation(2 * (radical_inverse(sample + 1, 2) - 0.5) / frame->viewport[2],
                               2 * (radical_inverse(sample + 1, 3) - 0.5) / frame->viewport[3], 0);
    frame->projection = plr_matrix_multiply(&shift, &frame->projection);
}

/* As the raycaster does it. */
void plr_frame_ray(const plr_frame *frame, double x, double y, plr_ray *ray) {
    const double *p = frame->projection.m, *v = frame->viewport;
    double ndc[2] = {(x - v[0]) / v[2] * 2 - 1, (y - v[1]) / v[3] * 2 - 1};
    *ray = (plr_ray){.direction = {0, 0, -1}};
    if (p[11] == 0) {
        ray->origin[0] = (ndc[0] - p[12]) / p[0];
        ray->origin[1] = (ndc[1] - p[13]) / p[5];
        return;
    }
    ray->direction[0] = (ndc[0] + p[8]) / p[0];
    ray->direction[1] = (ndc[1] + p[9]) / p[5];
    double length =
        sqrt(ray->direction[0] * ray->direction[0] + ray->direction[1] * ray->direction[1] + 1);
    for (int i = 0; i < 3; i++)
        ray->direction[i] /= length;
}

double plr_frame_distance(const plr_frame *frame, const plr_ray *ray, double depth) {
    const double *p = frame->projection.m;
    double ndc = frame->reversed_depth ? depth : 2 * depth - 1;
    double z = p[11] != 0 ? -p[14] / (ndc + p[10]) : (ndc - p[14]) / p[10];
    return z / ray->direction[2];
}

bool plr_frame_reversed(const plr_view *view) {
    return view->engine->gl.ClipControl != NULL;
}

/* ---- Drawing ---- */

void plr_frame_conventions(const plr_view *view, const plr_frame *frame) {
    const plr_gl *gl = &view->engine->gl;
    if (gl->ClipControl)
        gl->ClipControl(GL_LOWER_LEFT,
                        frame->reversed_depth ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    if (frame->cut[0] > 0 || isfinite(frame->cut[1]))
        gl->Disable(GL_DEPTH_CLAMP);
    else
        gl->Enable(GL_DEPTH_CLAMP);
}

static void draw_surface(plr_view *view, plr_surface *surface, const plr_frame *frame,
                         const plr_shot *shot) {
    if (!shot->avoid || !plr_bind_reads(&surface->model->pass.slots, shot->avoid))
        plr_surface_draw(view, surface, frame);
}

void plr_frame_draw_opaque(plr_view *view, const plr_frame *frame, const plr_shot *shot) {
    for (size_t i = 0; i < view->surface_count; i++)
        if (!view->surfaces[i].model->blends)
            draw_surface(view, &view->surfaces[i], frame, shot);
}

void plr_frame_draw(plr_view *view, const plr_frame *frame, const plr_shot *shot) {
    const plr_gl *gl = &view->engine->gl;
    plr_frame_conventions(view, frame);
    gl->BindFramebuffer(GL_FRAMEBUFFER, shot->framebuffer);
    gl->Viewport((GLint)frame->viewport[0], (GLint)frame->viewport[1], (GLsizei)frame->viewport[2],
                 (GLsizei)frame->viewport[3]);
    plr_background_draw(view, shot->background, frame, shot->behind);
    plr_frame_draw_opaque(view, frame, shot);
    plr_frame_draw_translucent(view, frame, shot);
}
