/* Casting rays through volumes, in a frame. */
#include "engine/frame.h"
#include "engine/volume_hull.h"
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
        cast->depth = cast->nearest = INFINITY;
        cast->farthest = -INFINITY;
        cast->drawn = false;
        for (size_t k = 0; k < cast->count; k++) {
            plr_matrix to_eye =
                plr_matrix_multiply(&frame->view, &pass->volumes[cast->members[k]].to_world);
            cast->depth = fmin(cast->depth, -to_eye.m[14]);
            double reach = 0; /* of the corners, along the view */
            for (int axis = 0; axis < 3; axis++)
                reach += fabs(to_eye.m[4 * axis + 2] *
                              pass->volumes[cast->members[k]].dimensions[axis]) /
                         2;
            cast->nearest = fmin(cast->nearest, -to_eye.m[14] - reach);
            cast->farthest = fmax(cast->farthest, -to_eye.m[14] + reach);
        }
    }
    if (pass->cast_count > 1)
        qsort(pass->casts, pass->cast_count, sizeof *pass->casts, farther_first);
}

/* Where rays begin. An eye that is many times as far away as the volumes are large leaves them no
 * digits of floats; from near enough, the eye itself is best. */
static double ray_plane(const plr_cast *cast) {
    const double far_away = 16;
    bool is_far = cast->nearest > far_away * (cast->farthest - cast->nearest);
    return is_far && isfinite(cast->nearest) ? (double)(float)cast->nearest : 0;
}

/* One casting of rays. */
typedef struct casting {
    plr_view *view;
    const plr_cast *cast;
    const plr_frame *frame;
} casting;

static void run_once(void *user) {
    const casting *c = user;
    plr_view *view = c->view;
    const plr_cast *cast = c->cast;
    const plr_frame *frame = c->frame;
    const plr_volume_pass *pass = &view->volumes;
    const plr_gl *gl = &view->engine->gl;
    gl->Disable(GL_CULL_FACE);
    gl->UseProgram(cast->pass.built->name);
    plr_hull hull;
    plr_volume_hull(pass->volumes, cast->members, cast->everywhere ? 0 : cast->count, frame, &hull);
    if (!hull.count)
        return;
    plr_values values = {.hull = &hull,
                         .error = cast->allowed,
                         .frame = frame,
                         .view = view,
                         .to_world = pass->volumes[cast->members[0]].to_world,
                         .ray_plane = ray_plane(cast),
                         .volumes = pass->volumes,
                         .volume_count = pass->count,
                         .functions = pass->functions.texture};
    plr_bind_set(gl, &view->textures, &cast->pass.slots, &values);
    gl->BindVertexArray(view->empty_vertex_array);
    gl->DrawArrays(GL_TRIANGLES, 0, 3 * (hull.count - 2));
}

static void run(plr_view *view, const plr_cast *cast, const plr_frame *frame) {
    casting once = {view, cast, frame};
    const plr_volume_state *first = &view->volumes.volumes[cast->members[0]];
    if (first->grid->brick_sides[0]) {
        plr_bricks_cast(view, first, frame, run_once, &once);
        return;
    }
    for (unsigned slab = cast->slabs; slab-- > 0;) {
        plr_frame part = *frame;
        plr_cast_slab(cast, slab, part.cut);
        once.frame = &part;
        run_once(&once);
    }
}

void plr_cast_draw(plr_view *view, const plr_cast *cast, const plr_frame *frame) {
    if (!cast->pass.built)
        return;
    const plr_gl *gl = &view->engine->gl;
    /* what writes depths has found the nearest itself */
    (cast->writes_depth ? gl->Enable : gl->Disable)(GL_DEPTH_TEST);
    gl->DepthFunc(GL_ALWAYS);
    gl->DepthMask(cast->writes_depth);
    gl->Enable(GL_BLEND);
    gl->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    run(view, cast, frame);
}

static plr_matrix eye_to_local(const plr_volume_state *volume, const plr_frame *frame) {
    plr_matrix to_eye = plr_matrix_multiply(&frame->view, &volume->to_world), to_local;
    plr_matrix_invert(&to_eye, &to_local);
    return to_local;
}

/* Where the ray runs in the box; returns how much faster it is in own coordinates, 0 if nowhere. */
static double cross(const plr_volume_state *volume, const plr_matrix *to_local, const plr_ray *ray,
                    double range[2]) {
    const double *m = to_local->m, *v = ray->direction;
    double from[3], length = 0;
    plr_matrix_point(to_local, ray->origin, from);
    range[0] = 0;
    range[1] = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double half = volume->dimensions[axis] / 2;
        double d = m[axis] * v[0] + m[4 + axis] * v[1] + m[8 + axis] * v[2];
        length += d * d;
        if (d == 0 && !(fabs(from[axis]) <= half))
            return 0;
        if (d == 0)
            continue;
        double a = (-half - from[axis]) / d, b = (half - from[axis]) / d;
        range[0] = fmax(range[0], fmin(a, b));
        range[1] = fmin(range[1], fmax(a, b));
    }
    return range[1] > range[0] ? sqrt(length) : 0;
}

bool plr_volume_crossed(const plr_volume_state *volume, const plr_frame *frame, const plr_ray *ray,
                        double range[2]) {
    plr_matrix to_local = eye_to_local(volume, frame);
    return cross(volume, &to_local, ray, range) > 0;
}

double plr_volume_pass_samples(const plr_view *view, const plr_frame *frame) {
    double samples = 0;
    int width = (int)frame->viewport[2], height = (int)frame->viewport[3];
    for (size_t v = 0; v < view->volumes.count; v++) {
        const plr_volume_state *state = &view->volumes.volumes[v];
        plr_matrix to_local = eye_to_local(state, frame);
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                plr_ray ray;
                double range[2], speed;
                plr_frame_ray(frame, x + 0.5, y + 0.5, &ray);
                if ((speed = cross(state, &to_local, &ray, range)) > 0)
                    samples += ceil((range[1] - range[0]) * speed / state->step);
            }
    }
    return samples;
}
