#include "engine/bounds.h"

#include <math.h>

#include "engine/mesh.h"

enum {
    MOST_WORK = 1000000 /* boxes of things, put into boxes of groups */
};

static plr_box nothing(void) {
    return (plr_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static bool is_empty(const plr_box *box) {
    return !(box->low[0] <= box->high[0]);
}

static plr_box around(const float center[3], const float size[3]) {
    plr_box box;
    for (int i = 0; i < 3; i++) {
        box.low[i] = (double)center[i] - (double)size[i] / 2;
        box.high[i] = (double)center[i] + (double)size[i] / 2;
    }
    return box;
}

static void add_box(plr_box *to, const plr_matrix *matrix, const plr_box *box) {
    for (int corner = 0; corner < 8 && !is_empty(box); corner++) {
        double point[3];
        for (int i = 0; i < 3; i++)
            point[i] = (corner >> i & 1 ? box->high : box->low)[i];
        plr_matrix_point(matrix, point, point);
        for (int i = 0; i < 3; i++) {
            to->low[i] = fmin(to->low[i], point[i]);
            to->high[i] = fmax(to->high[i], point[i]);
        }
    }
}

/* ---- What is in a box ---- */

static const plr_box *box_of_geometry(plr_bounds *b, const plr_node *geometry) {
    if (!b->known)
        b->known = PLR_NEW_ARRAY(b->arena, plr_scene_node_count(b->scene) + 1, plr_box *);
    plr_box **known = &b->known[plr_node_id(geometry)];
    if (*known)
        return *known;
    *known = PLR_NEW(b->arena, plr_box);
    **known = nothing();
    plr_mesh mesh = {0};
    if (plr_mesh_build(geometry, &mesh, NULL) && mesh.vertex_count)
        for (int i = 0; i < 3; i++) {
            (*known)->low[i] = (double)mesh.bounds[0][i];
            (*known)->high[i] = (double)mesh.bounds[1][i];
        }
    plr_mesh_free(&mesh);
    return *known;
}

static plr_box box_of_volume(const plr_node *volume) {
    float size[3] = {1, 1, 1};
    plr_node_numbers(volume, "dimensions", size, 3);
    return around((const float[3]){0, 0, 0}, size);
}

/* The box that a node gives; false where it gives none. */
static bool given_box(const plr_node *node, plr_box *box) {
    float center[3] = {0, 0, 0}, size[3] = {-1, -1, -1};
    plr_node_numbers(node, "bboxCenter", center, 3);
    plr_node_numbers(node, "bboxSize", size, 3);
    *box = around(center, size);
    return size[0] >= 0 && size[1] >= 0 && size[2] >= 0;
}

static plr_box box_of_leaves(plr_bounds *b, const plr_matrix *inside, size_t first_shape,
                             size_t first_volume) {
    plr_box box = nothing();
    plr_matrix to_inside;
    if (!plr_matrix_invert(inside, &to_inside))
        return box;
    const plr_leaves *shapes = &b->flat->shapes, *volumes = &b->flat->volumes;
    b->work += shapes->count - first_shape + volumes->count - first_volume;
    for (size_t i = first_shape; i < shapes->count && b->work <= MOST_WORK; i++) {
        plr_matrix matrix = plr_matrix_multiply(&to_inside, &shapes->items[i].to_world);
        const plr_node *geometry = plr_node_child(shapes->items[i].node, "geometry");
        if (shapes->items[i].node != plr_scene_box_edges(b->scene))
            add_box(&box, &matrix, box_of_geometry(b, geometry));
    }
    for (size_t i = first_volume; i < volumes->count && b->work <= MOST_WORK; i++) {
        plr_matrix matrix = plr_matrix_multiply(&to_inside, &volumes->items[i].to_world);
        plr_box volume = box_of_volume(volumes->items[i].node);
        add_box(&box, &matrix, &volume);
    }
    return box;
}

/* ---- Showing ---- */

void plr_bounds_show(plr_bounds *b, const plr_node *node, const plr_matrix *inside,
                     size_t first_shape, size_t first_volume) {
    plr_box box;
    plr_node *edges = plr_scene_box_edges(b->scene);
    bool given = given_box(node, &box);
    if (!given && plr_node_bool(node, "fileGeometry")) {
        plr_diags_add(b->diags, PLR_CODE_NOT_DRAWN, plr_node_place(node),
                      "the bounding box of a volume that takes its size from its file is drawn "
                      "only where bboxSize is given");
        return;
    }
    bool may_work = b->work <= MOST_WORK;
    if (!given)
        box = box_of_leaves(b, inside, first_shape, first_volume);
    if (may_work && b->work > MOST_WORK)
        plr_diags_add(b->diags, PLR_CODE_LIMIT, plr_node_place(node),
                      "too many things are in boxes: from here on boxes that are not given are "
                      "left out");
    if (!edges || is_empty(&box) || (!given && b->work > MOST_WORK))
        return;
    plr_matrix move =
        plr_matrix_translation((box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2,
                               (box.low[2] + box.high[2]) / 2);
    for (int i = 0; i < 3; i++)
        move.m[5 * i] = box.high[i] - box.low[i];
    *PLR_PUSH(b->arena, &b->flat->shapes) =
        (plr_leaf){edges, plr_matrix_multiply(inside, &move), PLR_NEW(b->arena, plr_scope)};
}
