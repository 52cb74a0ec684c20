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
    size_t inside; /* drawings that divide rays and are still to come */
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

static void draw_blend(drawing *d, const plr_blend *blend) {
    const plr_volume_pass *volumes = &d->view->volumes;
    plr_surface *surface = blend->surface;
    plr_faces faces = blend->faces;
    if (is_avoided(d, &surface->model->pass.slots))
        return;
    if (!surface->inside) {
        plr_surface_draw(d->view, surface, d->frame);
        return;
    }
    int to = d->last == 0 ? 1 : 0;
    draw_depths(d, surface, faces, to);
    for (size_t i = 0; i < volumes->cast_count; i++)
        if (volumes->casts[i].divided)
            draw_cast(d, &volumes->casts[i], to);
    d->last = to;
    plr_surface_draw_faces(d->view, surface, d->frame, faces, false);
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

/* ---- Order ---- */

static int farther_first(const void *a, const void *b) {
    const plr_blend *x = a, *y = b;
    if (x->depth != y->depth)
        return x->depth < y->depth ? 1 : -1;
    if (x->surface != y->surface)
        return x->surface < y->surface ? -1 : 1; /* as in the scene */
    return (int)x->faces - (int)y->faces;
}

static bool is_flat(const plr_mesh *mesh) {
    for (int axis = 0; axis < 3; axis++)
        if (mesh->bounds[0][axis] >= mesh->bounds[1][axis])
            return true;
    return false;
}

/* A surface inside that has two sides and room between them is drawn twice: what lies between its
 * far and its near faces, matter and other surfaces, comes between. */
static size_t find_blends(plr_view *view) {
    size_t count = 0;
    for (size_t i = 0; i < view->blending_count; i++) {
        plr_surface *surface = view->blending[i];
        const plr_mesh *mesh = &surface->model->mesh;
        bool encloses = surface->inside && mesh->kind == PLR_MESH_TRIANGLES && mesh->two_sided &&
                        !is_flat(mesh);
        double shift = encloses ? surface->reach / 2 : 0;
        view->blends[count++] =
            (plr_blend){surface, encloses ? PLR_FACES_BACK : PLR_FACES_ALL, surface->depth + shift};
        if (encloses)
            view->blends[count++] = (plr_blend){surface, PLR_FACES_FRONT, surface->depth - shift};
    }
    qsort(view->blends, count, sizeof *view->blends, farther_first);
    return count;
}

/* Finds the surfaces that divide rays. */
static void find_inside(const drawing *d) {
    plr_view *view = d->view;
    bool any = false;
    for (size_t i = 0; i < view->blending_count; i++) {
        plr_surface *surface = view->blending[i];
        surface->inside = false;
        for (size_t c = 0; c < view->volumes.cast_count && !surface->inside; c++)
            surface->inside = view->volumes.casts[c].divided &&
                              !is_avoided(d, &surface->model->pass.slots) &&
                              plr_cast_meets(view, &view->volumes.casts[c], surface);
        any = any || surface->inside;
    }
    if (any && !plr_spare_depths_fit(&view->spare, &view->engine->gl, (int)d->frame->viewport[2],
                                     (int)d->frame->viewport[3]))
        for (size_t i = 0; i < view->blending_count; i++)
            view->blending[i]->inside = false;
}

void plr_frame_draw_translucent(plr_view *view, const plr_frame *frame, const plr_shot *shot) {
    drawing d = {.view = view, .frame = frame, .shot = shot, .last = -1};
    plr_volume_depths(view, frame);
    find_inside(&d);
    size_t count = find_blends(view);
    for (size_t i = 0; i < count; i++)
        d.inside += view->blends[i].surface->inside;
    for (size_t i = 0; i < count; i++) {
        const plr_blend *blend = &view->blends[i];
        draw_casts(&d, blend->depth);
        draw_blend(&d, blend);
        d.inside -= blend->surface->inside;
    }
    draw_casts(&d, -INFINITY);
}
