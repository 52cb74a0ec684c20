/* Which viewpoint is looked from, and its camera. */
#include "engine/traverse.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const plr_viewpoint *plr_flat_viewpoint(const plr_flat *flat, const char *selector) {
    size_t count = flat->viewpoints.count;
    if (!selector || !*selector)
        return count ? &flat->viewpoints.items[0] : &flat->standard;
    char *end;
    unsigned long number = strtoul(selector, &end, 10);
    if (!*end && *selector != '-')
        return number >= 1 && number <= count ? &flat->viewpoints.items[number - 1] : NULL;
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < count; i++) {
            const plr_node *node = flat->viewpoints.items[i].node;
            const char *name = pass ? plr_node_string(node, "description") : plr_node_def(node);
            if (name && strcmp(name, selector) == 0)
                return &flat->viewpoints.items[i];
        }
    return NULL;
}

const plr_viewpoint *plr_flat_bound(const plr_flat *flat, const plr_viewpoint *chosen) {
    for (size_t i = 0; i < flat->viewpoints.count; i++)
        if (plr_node_bool(flat->viewpoints.items[i].node, "isBound"))
            return &flat->viewpoints.items[i];
    return chosen;
}

void plr_viewpoint_cut(const plr_viewpoint *viewpoint, double cut[2]) {
    double near = viewpoint->node ? plr_node_number(viewpoint->node, "nearDistance") : 0;
    double far = viewpoint->node ? plr_node_number(viewpoint->node, "farDistance") : 0;
    cut[0] = near > 0 ? near : 0;
    cut[1] = far > 0 ? far : viewpoint->limit > 0 ? viewpoint->limit : INFINITY;
}

/* The box of an OrthoViewpoint grows along one axis until it has the picture's shape. */
static void fit_box(double box[4], double aspect) {
    double width = box[2] - box[0], height = box[3] - box[1];
    double grow_x = width < height * aspect ? (height * aspect - width) / 2 : 0;
    double grow_y = width > height * aspect ? (width / aspect - height) / 2 : 0;
    box[0] -= grow_x;
    box[2] += grow_x;
    box[1] -= grow_y;
    box[3] += grow_y;
}

void plr_viewpoint_matrices(const plr_viewpoint *viewpoint, double width, double height,
                            const double depths[2], plr_matrix *projection, plr_matrix *view) {
    plr_matrix_invert(&viewpoint->to_world, view);
    double cut[2];
    plr_viewpoint_cut(viewpoint, cut);
    double near = cut[0] > 0 ? cut[0] : depths[0], far = isfinite(cut[1]) ? cut[1] : depths[1];
    if (!(cut[0] > 0) && near >= far) /* all that is there is beyond: nothing is seen */
        near = far > 0 ? far / 2 : far - 1;
    if (!(far > near))
        far = near + 1 + fabs(near);
    double aspect = width / height;
    if (viewpoint->node && plr_node_is(viewpoint->node, "OrthoViewpoint")) {
        float given[4] = {-1, -1, 1, 1};
        plr_node_numbers(viewpoint->node, "fieldOfView", given, 4);
        double box[4] = {given[0], given[1], given[2], given[3]};
        fit_box(box, aspect);
        *projection = plr_matrix_orthographic(box, near, far);
        return;
    }
    /* ISO/IEC 19775-1 V4 23.4.6: fieldOfView is the smaller of the two angles of the window */
    double angle = viewpoint->node ? plr_node_number(viewpoint->node, "fieldOfView") : 0;
    if (!(angle > 0 && angle < 3.14159))
        angle = 0.785398163397448;
    double half = tan(angle / 2);
    bool wide = aspect >= 1 ||
                (viewpoint->node && plr_node_bool(viewpoint->node, "fieldOfViewForceVertical"));
    double x = wide ? half * aspect : half, y = wide ? half : half / aspect;
    *projection = plr_matrix_perspective((double[]){-x, -y, x, y}, near, far);
}
