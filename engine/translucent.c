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

/* Where one thing is for somebody who looks at two. */
typedef enum side {
    MEETING, /* nobody knows: no plane was found between them */
    BEHIND,  /* it never hides the other one */
    BEFORE   /* it is never hidden by it */
} side;

/* Looks for a face of the other box beyond which this one lies, in the other's coordinates, as
 * `eye` is; that face tells which one may hide which. Touching is not meeting. */
static side find_side(const plr_matrix *to_other, double own[2][3], double other[2][3],
                      const double eye[3]) {
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
    for (int axis = 0; axis < 3; axis++) {
        if (high[axis] <= other[0][axis])
            return eye[axis] < other[0][axis] ? BEFORE : BEHIND;
        if (other[1][axis] <= low[axis])
            return eye[axis] > other[1][axis] ? BEFORE : BEHIND;
    }
    return MEETING;
}

/* The eye in other coordinates; a direction is a place very far away. */
static void look_from(const plr_matrix *from_world, const double eye[4], double place[3]) {
    const double *m = from_world->m;
    for (int row = 0; row < 3; row++) {
        place[row] = m[row] * eye[0] + m[4 + row] * eye[1] + m[8 + row] * eye[2];
        place[row] = eye[3] != 0 ? place[row] + m[12 + row] : place[row] * 1e30;
    }
}

/* Where a surface is, seen from a place or, with w = 0, from a direction of the world. */
static side side_of(const plr_volume_state *volume, const plr_surface *surface,
                    const double eye[4]) {
    plr_matrix from_world, to_volume, to_surface;
    double mesh[2][3], box[2][3], from_volume[3], from_surface[3];
    if (!plr_matrix_invert(&volume->to_world, &from_world))
        return BEHIND;
    to_volume = plr_matrix_multiply(&from_world, &surface->to_world);
    for (int axis = 0; axis < 3; axis++)
        for (int end = 0; end < 2; end++) {
            mesh[end][axis] = (double)surface->model->mesh.bounds[end][axis];
            box[end][axis] = volume->dimensions[axis] * (end - 0.5);
        }
    look_from(&from_world, eye, from_volume);
    side found = find_side(&to_volume, mesh, box, from_volume);
    if (found != MEETING || !plr_matrix_invert(&to_volume, &to_surface))
        return found;
    plr_matrix world_to_surface = plr_matrix_multiply(&to_surface, &from_world);
    look_from(&world_to_surface, eye, from_surface);
    found = find_side(&to_surface, box, mesh, from_surface);
    return found == MEETING ? MEETING : found == BEFORE ? BEHIND : BEFORE;
}

bool plr_cast_meets(const plr_view *view, const plr_cast *cast, const plr_surface *surface) {
    static const double nowhere[4] = {0, 0, 0, 1};
    const plr_model *model = surface->model;
    if (!model->pass.built || !model->mesh.index_count)
        return false;
    if (plr_model_is_moved(model))
        return true; /* nobody knows where to */
    for (size_t i = 0; i < cast->count; i++)
        if (side_of(&view->volumes.volumes[cast->members[i]], surface, nowhere) == MEETING)
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
    if (x->surface->depth != y->surface->depth && !x->surface->inside && !y->surface->inside)
        return x->surface->depth < y->surface->depth ? 1 : -1;
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

/* The middle of what is large may be nearer than that of what it is behind: then it is taken to be
 * just behind; and the other way round. */
static double place_beside(const plr_view *view, const plr_surface *surface, const double eye[4]) {
    double depth = surface->depth;
    for (size_t i = 0; i < view->volumes.cast_count; i++) {
        const plr_cast *cast = &view->volumes.casts[i];
        if (surface->depth + surface->reach < cast->nearest ||
            surface->depth - surface->reach > cast->farthest)
            continue;
        int behind = 0, before = 0;
        for (size_t k = 0; k < cast->count; k++) {
            side found = side_of(&view->volumes.volumes[cast->members[k]], surface, eye);
            behind += found == BEHIND;
            before += found == BEFORE;
        }
        if (behind && !before && !(depth > cast->depth))
            depth = nextafter(cast->depth, INFINITY);
        else if (before && !behind && depth > cast->depth)
            depth = cast->depth;
    }
    return depth;
}

/* A surface inside that has two sides and room between them is drawn twice: what lies between its
 * far and its near faces, matter and other surfaces, comes between. */
static size_t find_blends(plr_view *view, const plr_frame *frame) {
    size_t count = 0;
    plr_matrix to_world;
    plr_matrix_invert(&frame->view, &to_world);
    bool parallel = frame->projection.m[11] == 0;
    const double *m = &to_world.m[parallel ? 8 : 12], eye[4] = {m[0], m[1], m[2], !parallel};
    for (size_t i = 0; i < view->blending_count; i++) {
        plr_surface *surface = view->blending[i];
        const plr_mesh *mesh = &surface->model->mesh;
        bool encloses = surface->inside && mesh->kind == PLR_MESH_TRIANGLES && mesh->two_sided &&
                        !is_flat(mesh);
        double shift = encloses ? surface->reach / 2 : 0;
        double depth = surface->inside ? surface->depth : place_beside(view, surface, eye);
        view->blends[count++] =
            (plr_blend){surface, encloses ? PLR_FACES_BACK : PLR_FACES_ALL, depth + shift};
        if (encloses)
            view->blends[count++] = (plr_blend){surface, PLR_FACES_FRONT, depth - shift};
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
    size_t count = find_blends(view, frame);
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
