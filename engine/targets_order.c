/* Which targets a picture needs, and in which order. */
#include "engine/targets_draw.h"

typedef struct search {
    plr_view *view;
    const plr_frame *here; /* as in plr_targets_draw */
} search;

static void need_texture(search *s, const plr_texture *texture);

static void need_all_of(search *s, const plr_slots *slots) {
    size_t at = 0;
    const plr_texture *texture;
    while ((texture = plr_bind_next_texture(slots, &at)))
        if (texture->generated)
            need_texture(s, texture);
}

/* Whether the box of a surface may be seen through a camera: its corners are not all beyond one
 * side of the window, or behind. */
static bool may_see(const plr_matrix *world_to_clip, const plr_surface *surface) {
    plr_matrix to_clip = plr_matrix_multiply(world_to_clip, &surface->to_world);
    const double *m = to_clip.m;
    int beyond[5] = {0};
    for (int corner = 0; corner < 8; corner++) {
        double clip[4], p[3];
        for (int axis = 0; axis < 3; axis++)
            p[axis] = (double)surface->model->mesh.bounds[corner >> axis & 1][axis];
        for (int row = 0; row < 4; row++)
            clip[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row];
        beyond[0] += clip[0] < -clip[3];
        beyond[1] += clip[0] > clip[3];
        beyond[2] += clip[1] < -clip[3];
        beyond[3] += clip[1] > clip[3];
        beyond[4] += clip[3] <= 0;
    }
    for (int i = 0; i < 5; i++)
        if (beyond[i] == 8)
            return false;
    return true;
}

static bool reads_generated(const plr_model *model) {
    size_t at = 0;
    const plr_texture *texture;
    while ((texture = plr_bind_next_texture(&model->pass.slots, &at)))
        if (texture->generated)
            return true;
    return false;
}

/* What the world's programs read, seen through a camera; NULL: from everywhere. */
static void need_world(search *s, const plr_world *world, const plr_background *background,
                       const plr_matrix *world_to_clip) {
    need_all_of(s, &background->pass.slots);
    for (size_t i = 0; i < world->volumes.cast_count; i++)
        need_all_of(s, &world->volumes.casts[i].pass.slots);
    for (size_t i = 0; !world_to_clip && i < world->model_count; i++)
        need_all_of(s, &world->models[i]->pass.slots);
    for (size_t i = 0; world_to_clip && i < world->surface_count; i++) {
        const plr_surface *surface = &world->surfaces[i];
        /* what moves vertices may move them into sight */
        if (reads_generated(surface->model) &&
            (plr_model_is_moved(surface->model) || may_see(world_to_clip, surface)))
            need_all_of(s, &surface->model->pass.slots);
    }
}

/* World to clip space of a RenderedTexture's camera; false where it is drawn from elsewhere. */
static bool camera_of(const search *s, const plr_target *target, const plr_world *world,
                      plr_matrix *world_to_clip) {
    const plr_viewpoint *viewpoint = target->viewpoint ? target->viewpoint : world->viewpoint;
    plr_matrix projection, to_eye;
    if (target->reader || !viewpoint)
        return false;
    plr_viewpoint_matrices(viewpoint, target->texture->width, target->texture->height,
                           (double[]){0.1, 10}, &projection, &to_eye);
    if (s->here && !target->viewpoint) {
        projection = s->here->projection;
        to_eye = s->here->view;
    }
    *world_to_clip = plr_matrix_multiply(&projection, &to_eye);
    return true;
}

static void need_casters(search *s, const plr_world *world) {
    for (size_t i = 0; i < world->model_count; i++)
        if (world->models[i]->caster)
            need_all_of(s, &world->models[i]->caster->pass.slots);
}

static const plr_surface *find_reader(const plr_world *world, const plr_texture *texture) {
    for (size_t i = 0; i < world->surface_count; i++)
        if (plr_bind_reads(&world->surfaces[i].model->pass.slots, texture))
            return &world->surfaces[i];
    return NULL;
}

/* A cube map shows what is around the first shape that reads it, in the world of that. */
static void find_world(plr_view *view, plr_target *target) {
    target->world = target->shadow ? target->shadow->world : target->own;
    if (target->texture->kind != PLR_TEXTURE_CUBE || target->shadow)
        return;
    target->reader = find_reader(&view->world, target->texture);
    for (size_t i = 0; !target->reader && i < view->targets.count; i++) {
        target->world = view->targets.items[i]->own;
        if (target->world)
            target->reader = find_reader(target->world, target->texture);
    }
}

static void need_target(search *s, plr_target *target, size_t index) {
    if (target->state == TARGET_OPEN)
        target->clear = true; /* a circle: what it held is of the picture before */
    if (target->state != TARGET_UNSEEN)
        return;
    target->state = TARGET_OPEN;
    find_world(s->view, target);
    const plr_world *world = target->world ? target->world : &s->view->world;
    plr_matrix clip;
    bool draws = plr_target_is_due(s->view, target);
    if (draws && target->shadow)
        need_casters(s, world);
    else if (draws)
        need_world(s, world, target->background ? target->background : &world->background,
                   camera_of(s, target, world, &clip) ? &clip : NULL);
    target->state = TARGET_DONE;
    s->view->targets.order[s->view->targets.order_count++] = index;
}

static void need_texture(search *s, const plr_texture *texture) {
    const plr_targets *targets = &s->view->targets;
    for (size_t i = 0; i < targets->count; i++)
        if (targets->items[i]->texture == texture)
            need_target(s, targets->items[i], i);
}

void plr_targets_order(plr_view *view, const plr_frame *here) {
    plr_targets *targets = &view->targets;
    targets->order_count = 0;
    for (size_t i = 0; i < targets->count; i++)
        targets->items[i]->state = TARGET_UNSEEN;
    search s = {view, here};
    need_world(&s, &view->world, &view->background, NULL);
}
