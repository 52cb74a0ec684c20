/* Casting rays through volumes, in a frame. */
#include "engine/volume_pass.h"

#include <math.h>
#include <stdlib.h>

static int farther_first(const void *a, const void *b) {
    double x = ((const plr_cast *)a)->depth, y = ((const plr_cast *)b)->depth;
    return x < y ? 1 : x > y ? -1 : 0;
}

void plr_volume_depths(plr_view *view, const plr_frame *frame) {
    plr_volume_pass *pass = &view->volumes;
    for (size_t i = 0; i < pass->cast_count; i++) {
        plr_cast *cast = &pass->casts[i];
        cast->depth = INFINITY;
        cast->drawn = false;
        for (size_t k = 0; k < cast->count; k++) {
            plr_matrix to_eye =
                plr_matrix_multiply(&frame->view, &pass->volumes[cast->members[k]].to_world);
            cast->depth = fmin(cast->depth, -to_eye.m[14]);
        }
    }
    if (pass->cast_count > 1)
        qsort(pass->casts, pass->cast_count, sizeof *pass->casts, farther_first);
}

void plr_cast_draw(plr_view *view, const plr_cast *cast, const plr_frame *frame) {
    const plr_volume_pass *pass = &view->volumes;
    if (!cast->pass.built)
        return;
    const plr_gl *gl = &view->engine->gl;
    /* what writes depths has found the nearest itself */
    (cast->writes_depth ? gl->Enable : gl->Disable)(GL_DEPTH_TEST);
    gl->DepthFunc(GL_ALWAYS);
    gl->DepthMask(cast->writes_depth);
    gl->Disable(GL_CULL_FACE);
    gl->Enable(GL_BLEND);
    gl->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl->UseProgram(cast->pass.built->name);
    plr_values values = {.frame = frame,
                         .view = view,
                         .to_world = pass->volumes[cast->members[0]].to_world,
                         .volumes = pass->volumes,
                         .volume_count = pass->count,
                         .default_ramp = pass->default_ramp};
    plr_bind_set(gl, &view->textures, &cast->pass.slots, &values);
    gl->BindVertexArray(view->empty_vertex_array);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

/* Length of the ray o + t d (t >= 0) inside a box centred at the origin, in units of t. */
static double chord(const double o[3], const double d[3], const double size[3]) {
    double enter = 0, leave = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double half = size[axis] / 2;
        if (d[axis] == 0) {
            if (!(fabs(o[axis]) <= half))
                return 0;
            continue;
        }
        double a = (-half - o[axis]) / d[axis], b = (half - o[axis]) / d[axis];
        enter = fmax(enter, fmin(a, b));
        leave = fmin(leave, fmax(a, b));
    }
    return leave > enter ? leave - enter : 0;
}

double plr_volume_pass_samples(const plr_view *view, const plr_frame *frame) {
    double samples = 0;
    int width = (int)frame->viewport[2], height = (int)frame->viewport[3];
    plr_matrix unproject;
    plr_matrix_invert(&frame->projection, &unproject);
    for (size_t v = 0; v < view->volumes.count; v++) {
        const plr_volume_state *state = &view->volumes.volumes[v];
        plr_matrix to_eye = plr_matrix_multiply(&frame->view, &state->to_world), to_local;
        plr_matrix_invert(&to_eye, &to_local);
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                double ndc[2] = {(x + 0.5) / width * 2 - 1, (y + 0.5) / height * 2 - 1};
                double near[3] = {ndc[0], ndc[1], -1}, far[3] = {ndc[0], ndc[1], 1}, d[3];
                plr_matrix_point(&unproject, near, near);
                plr_matrix_point(&unproject, far, far);
                bool parallel = frame->projection.m[15] != 0;
                double eye[3] = {parallel ? near[0] : 0, parallel ? near[1] : 0, 0};
                plr_matrix_point(&to_local, eye, eye);
                plr_matrix_point(&to_local, far, far);
                double length = 0;
                for (int i = 0; i < 3; i++) {
                    d[i] = far[i] - eye[i];
                    length += d[i] * d[i];
                }
                samples += ceil(chord(eye, d, state->dimensions) * sqrt(length) / state->step);
            }
    }
    return samples;
}
