/* Which part of a light's view its map must hold, so that its texels are as small as can be. */
#include "engine/shadows.h"

#include <math.h>

/* In normalised device coordinates: x from, y from, x to, y to. */
typedef struct box {
    double side[4];
} box;

static const box nothing = {{INFINITY, INFINITY, -INFINITY, -INFINITY}};
static const box everything = {{-1, -1, 1, 1}};

/* Whether an author's effect may move the vertices of the shape. */
bool plr_model_is_moved(const plr_model *model) {
    const plr_recipe *recipe = &model->pass.recipe;
    for (size_t i = 0; i < recipe->effects.count; i++) {
        const plr_effect *effect = &recipe->effects.items[i];
        for (size_t s = 0; !effect->builtin && s < effect->source_count; s++)
            if (plr_source_stage(effect->sources[s]) != PLR_FRAGMENT)
                return true;
    }
    return recipe->base_node != NULL;
}

/* The bounds of the shape, vertices that are moved included where its bboxSize tells of them. */
static void bounds_of(const plr_model *model, bool moved, double bounds[2][3]) {
    float size[3] = {-1, -1, -1}, center[3] = {0, 0, 0};
    if (moved) {
        plr_node_numbers(model->node, "bboxSize", size, 3);
        plr_node_numbers(model->node, "bboxCenter", center, 3);
    }
    for (int axis = 0; axis < 3; axis++) {
        bounds[0][axis] = (double)model->mesh.bounds[0][axis];
        bounds[1][axis] = (double)model->mesh.bounds[1][axis];
        double half = (double)size[axis] / 2, middle = (double)center[axis];
        if (half >= 0) {
            bounds[0][axis] = fmin(bounds[0][axis], middle - half);
            bounds[1][axis] = fmax(bounds[1][axis], middle + half);
        }
    }
}

static bool tells_bounds(const plr_model *model) {
    float size[3] = {-1, -1, -1};
    plr_node_numbers(model->node, "bboxSize", size, 3);
    return size[0] >= 0 && size[1] >= 0 && size[2] >= 0;
}

static box box_of(const plr_matrix *world_to_clip, const plr_surface *surface) {
    plr_matrix to_clip = plr_matrix_multiply(world_to_clip, &surface->to_world);
    const double *m = to_clip.m;
    double bounds[2][3];
    bool moved = plr_model_is_moved(surface->model);
    bounds_of(surface->model, moved, bounds);
    /* else nobody knows how far: it is hoped that they stay among what the light sees */
    box b = moved && !tells_bounds(surface->model) ? everything : nothing;
    for (int corner = 0; corner < 8; corner++) {
        double clip[4];
        for (int row = 0; row < 4; row++)
            clip[row] = m[row] * bounds[corner & 1][0] + m[4 + row] * bounds[corner >> 1 & 1][1] +
                        m[8 + row] * bounds[corner >> 2][2] + m[12 + row];
        if (!(clip[3] > 1e-6))
            return everything;
        for (int axis = 0; axis < 2; axis++) {
            b.side[axis] = fmin(b.side[axis], clip[axis] / clip[3]);
            b.side[axis + 2] = fmax(b.side[axis + 2], clip[axis] / clip[3]);
        }
    }
    return b;
}

/* A flat shape never shadows itself. */
static bool is_flat(const plr_model *model) {
    for (int axis = 0; axis < 3; axis++)
        if (model->mesh.bounds[0][axis] >= model->mesh.bounds[1][axis])
            return !plr_model_is_moved(model);
    return false;
}

/* For each side of the union of all shapes: the two farthest of them, so that the union of all but
 * one is known at once. */
typedef struct ranks {
    double first[4], second[4];
    size_t owner[4];
} ranks;

static void rank(ranks *r, const box *b, size_t owner) {
    for (int i = 0; i < 4; i++) {
        double outward = i < 2 ? -b->side[i] : b->side[i];
        if (outward > r->first[i]) {
            r->second[i] = r->first[i];
            r->first[i] = outward;
            r->owner[i] = owner;
        } else if (outward > r->second[i]) {
            r->second[i] = outward;
        }
    }
}

/* What of this box the others may lie under. */
static box within_others(const ranks *r, const box *b, size_t owner) {
    box result = *b;
    for (int i = 0; i < 4; i++) {
        double others = r->owner[i] == owner ? r->second[i] : r->first[i];
        result.side[i] = i < 2 ? fmax(b->side[i], -others) : fmin(b->side[i], others);
    }
    return result;
}

static bool is_empty(const box *b) {
    return !(b->side[2] > b->side[0]) || !(b->side[3] > b->side[1]);
}

static box needed_part(const plr_view *view, const plr_matrix *world_to_clip) {
    ranks r = {{-INFINITY, -INFINITY, -INFINITY, -INFINITY},
               {-INFINITY, -INFINITY, -INFINITY, -INFINITY},
               {0, 0, 0, 0}};
    box needed = nothing;
    for (size_t i = 0; i < view->surface_count; i++)
        if (view->surfaces[i].model->mesh.vertex_count) {
            box b = box_of(world_to_clip, &view->surfaces[i]);
            rank(&r, &b, i);
        }
    for (size_t i = 0; i < view->surface_count; i++) {
        const plr_surface *surface = &view->surfaces[i];
        if (!surface->model->caster)
            continue;
        box b = box_of(world_to_clip, surface);
        if (is_flat(surface->model))
            b = within_others(&r, &b, i);
        for (int s = 0; s < 4 && !is_empty(&b); s++)
            needed.side[s] =
                s < 2 ? fmin(needed.side[s], b.side[s]) : fmax(needed.side[s], b.side[s]);
    }
    return needed;
}

/* A cone is not left, and each side keeps some texels where nothing stands: what is beyond them is
 * lit. */
void plr_shadow_fit(const plr_view *view, const plr_shadow *shadow, plr_frame *frame) {
    plr_matrix world_to_clip = plr_matrix_multiply(&frame->projection, &frame->view);
    box b = needed_part(view, &world_to_clip);
    bool cone = plr_node_is(shadow->light, "SpotLight");
    for (int i = 0; cone && i < 4; i++)
        b.side[i] = fmin(fmax(b.side[i], -1), 1);
    if (is_empty(&b) || !isfinite(b.side[0] + b.side[1] + b.side[2] + b.side[3]))
        return;
    plr_matrix crop = plr_matrix_identity();
    double size = shadow->values.texture->width, kept = size > 16 ? (size - 8) / size : 0.5;
    for (int axis = 0; axis < 2; axis++) {
        double half = (b.side[axis + 2] - b.side[axis]) / 2 / kept;
        double middle = (b.side[axis + 2] + b.side[axis]) / 2;
        crop.m[axis * 5] = 1 / half;
        crop.m[12 + axis] = -middle / half;
    }
    frame->projection = plr_matrix_multiply(&crop, &frame->projection);
}
