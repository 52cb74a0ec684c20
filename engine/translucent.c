/* What shows what lies behind it: translucent surfaces and volumes, from the farthest to the
 * nearest.
 *
 * A translucent surface inside a volume divides the rays through it. Around each such surface, the
 * farthest first, the part of the rays behind it is cast, up to the one before; then the surface is
 * drawn; what is left before the nearest one is cast last. Depths tell where the parts end: those
 * of the surface alone are drawn into a texture of their own, over those of what is behind. */
#include <math.h>
#include <stdlib.h>

#include "engine/frame.h"
#include "engine/shadows.h"

/* ---- Who meets whom ---- */

/* Whether a box lies beyond one of the faces of another: each has its corners in the other's
 * coordinates. Touching is not meeting. */
static bool is_beyond(const plr_matrix *to_other, double own[2][3], double other[2][3]) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int corner = 0; corner < 8; corner++) {
        double point[3];
        for (int axis = 0; axis < 3; axis++)
            point[axis] = own[corner >> axis & 1][axis];
        plr_matrix_point(to_other, point, point);
        for (int axis = 0; axis < 3; axis++) {
            low[axis] = fmin(low[axis], point[axis]);
            high[axis] = fmax(high[axis], point[axis]);
        }
    }
    for (int axis = 0; axis < 3; axis++)
        if (high[axis] <= other[0][axis] || other[1][axis] <= low[axis])
            return true;
    return false;
}

static bool meets(const plr_volume_state *volume, const plr_surface *surface) {
    plr_matrix from_world, to_volume, to_surface;
    double mesh[2][3], box[2][3];
    if (!plr_matrix_invert(&volume->to_world, &from_world))
        return false;
    to_volume = plr_matrix_multiply(&from_world, &surface->to_world);
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            mesh[side][axis] = (double)surface->model->mesh.bounds[side][axis];
            box[side][axis] = volume->dimensions[axis] * (side - 0.5);
        }
    if (is_beyond(&to_volume, mesh, box))
        return false;
    return !plr_matrix_invert(&to_volume, &to_surface) || !is_beyond(&to_surface, box, mesh);
}

bool plr_cast_meets(const plr_view *view, const plr_cast *cast, const plr_surface *surface) {
    const plr_model *model = surface->model;
    if (!model->pass.built || !model->mesh.index_count)
        return false;
    if (plr_model_is_moved(model))
        return true; /* nobody knows where to */
    for (size_t i = 0; i < cast->count; i++)
        if (meets(&view->volumes.volumes[cast->members[i]], surface))
            return true;
    return false;
}

bool plr_cast_is_divided(const plr_view *view, const plr_cast *cast) {
    for (size_t i = 0; i < view->blending_count; i++)
        if (plr_cast_meets(view, cast, view->blending[i]))
            return true;
    return false;
}

/* ---- Drawing ---- */

typedef struct drawing {
    plr_view *view;
    const plr_frame *frame;
    const plr_shot *shot;
    size_t inside; /* surfaces that divide rays and are still to be drawn */
    int last;      /* the spare depths at which the next part ends; -1: it ends with the ray */
} drawing;

static bool is_avoided(const drawing *d, const plr_slots *slots) {
    return d->shot->avoid && plr_bind_reads(slots, d->shot->avoid);
}

/* Volumes read the depths of the frame: what writes them reads a copy. */
static void draw_writing(const drawing *d, const plr_cast *cast, plr_frame *frame) {
    const plr_gl *gl = &d->view->engine->gl;
    GLuint depths = frame->opaque_depth;
    if (!d->shot->depths_copied &&
        plr_spare_depths_fit(&d->view->spare, gl, (int)frame->viewport[2],
                             (int)frame->viewport[3])) {
        frame->opaque_depth = d->view->spare.textures[PLR_SPARE_DEPTHS - 1];
        frame->part_end = frame->part_end == depths ? frame->opaque_depth : frame->part_end;
        gl->ActiveTexture(GL_TEXTURE0);
        plr_depths_copy(gl, d->shot->framebuffer, frame->viewport, frame->opaque_depth);
    }
    gl->BindFramebuffer(GL_FRAMEBUFFER, d->shot->framebuffer);
    plr_cast_draw(d->view, cast, frame);
    if (d->shot->depths_copied) {
        gl->ActiveTexture(GL_TEXTURE0);
        plr_depths_copy(gl, d->shot->framebuffer, frame->viewport, depths);
    }
}

/* From `start` (spare depths, -1: the eye) to where the part before began. */
static void draw_cast(const drawing *d, const plr_cast *cast, int start) {
    const plr_gl *gl = &d->view->engine->gl;
    plr_frame frame = *d->frame;
    if (is_avoided(d, &cast->pass.slots))
        return;
    frame.part_start = start < 0 ? 0 : d->view->spare.textures[start];
    frame.part_end = d->last < 0 ? frame.opaque_depth : d->view->spare.textures[d->last];
    if (cast->writes_depth) {
        draw_writing(d, cast, &frame);
    } else {
        gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, d->shot->without_depth);
        plr_cast_draw(d->view, cast, &frame);
    }
    gl->BindFramebuffer(GL_FRAMEBUFFER, d->shot->framebuffer);
}

/* The depths of the surface before those at which the last part began. */
static void draw_depths(const drawing *d, plr_surface *surface, plr_faces faces, int to) {
    const plr_gl *gl = &d->view->engine->gl;
    const plr_spare_depths *spare = &d->view->spare;
    const double *v = d->frame->viewport, whole[4] = {0, 0, v[2], v[3]};
    gl->ActiveTexture(GL_TEXTURE0);
    plr_depths_copy(gl, d->last < 0 ? d->shot->depths : spare->names[d->last], whole,
                    spare->textures[to]);
    gl->BindFramebuffer(GL_FRAMEBUFFER, spare->names[to]);
    gl->Viewport(0, 0, (GLsizei)v[2], (GLsizei)v[3]);
    plr_surface_draw_faces(d->view, surface, d->frame, faces, true);
    gl->Viewport((GLint)v[0], (GLint)v[1], (GLsizei)v[2], (GLsizei)v[3]);
    gl->BindFramebuffer(GL_FRAMEBUFFER, d->shot->framebuffer);
}

static void draw_inside(drawing *d, plr_surface *surface, plr_faces faces) {
    const plr_volume_pass *volumes = &d->view->volumes;
    int to = d->last == 0 ? 1 : 0;
    draw_depths(d, surface, faces, to);
    for (size_t i = 0; i < volumes->cast_count; i++)
        if (volumes->casts[i].divided)
            draw_cast(d, &volumes->casts[i], to);
    d->last = to;
    plr_surface_draw_faces(d->view, surface, d->frame, faces, false);
}

/* Of a surface that has two sides the far ones come first: what lies between them is seen through
 * the near ones. */
static void draw_surface(drawing *d, plr_surface *surface) {
    const plr_mesh *mesh = &surface->model->mesh;
    if (is_avoided(d, &surface->model->pass.slots))
        return;
    if (!surface->inside) {
        plr_surface_draw(d->view, surface, d->frame);
    } else if (mesh->kind == PLR_MESH_TRIANGLES && mesh->two_sided) {
        draw_inside(d, surface, PLR_FACES_BACK);
        draw_inside(d, surface, PLR_FACES_FRONT);
    } else {
        draw_inside(d, surface, PLR_FACES_ALL);
    }
}

/* Casts that are not nearer than this; those that are divided once nothing divides them any more.
 */
static void draw_casts(const drawing *d, double depth) {
    plr_volume_pass *volumes = &d->view->volumes;
    for (size_t i = 0; i < volumes->cast_count; i++) {
        plr_cast *cast = &volumes->casts[i];
        if (cast->drawn || cast->depth < depth || (cast->divided && d->inside))
            continue;
        cast->drawn = true;
        drawing whole = *d;
        whole.last = cast->divided ? d->last : -1;
        draw_cast(&whole, cast, -1);
    }
}

static int farther_first(const void *a, const void *b) {
    double x = (*(plr_surface *const *)a)->depth, y = (*(plr_surface *const *)b)->depth;
    return x < y ? 1 : x > y ? -1 : 0;
}

/* Counts the surfaces that divide rays. */
static size_t find_inside(const drawing *d) {
    plr_view *view = d->view;
    size_t count = 0;
    for (size_t i = 0; i < view->blending_count; i++) {
        plr_surface *surface = view->blending[i];
        surface->inside = false;
        for (size_t c = 0; c < view->volumes.cast_count && !surface->inside; c++)
            surface->inside = view->volumes.casts[c].divided &&
                              !is_avoided(d, &surface->model->pass.slots) &&
                              plr_cast_meets(view, &view->volumes.casts[c], surface);
        count += surface->inside;
    }
    if (count && !plr_spare_depths_fit(&view->spare, &view->engine->gl, (int)d->frame->viewport[2],
                                       (int)d->frame->viewport[3])) {
        for (size_t i = 0; i < view->blending_count; i++)
            view->blending[i]->inside = false;
        count = 0;
    }
    return count;
}

void plr_frame_draw_translucent(plr_view *view, const plr_frame *frame, const plr_shot *shot) {
    drawing d = {.view = view, .frame = frame, .shot = shot, .last = -1};
    qsort(view->blending, view->blending_count, sizeof *view->blending, farther_first);
    plr_volume_depths(view, frame);
    d.inside = find_inside(&d);
    for (size_t i = 0; i < view->blending_count; i++) {
        plr_surface *surface = view->blending[i];
        draw_casts(&d, surface->depth);
        draw_surface(&d, surface);
        d.inside -= surface->inside;
    }
    draw_casts(&d, -INFINITY);
}
