#include "engine/traverse.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* DEF and USE let a short file describe more nodes than any machine can draw. */
enum {
    MOST_VISITS = 100000
};

typedef struct walk {
    plr_arena *arena;
    plr_flat *flat;
    plr_diags *diags;
    plr_scope *scope;
    size_t visits;
} walk;

static void visit(walk *w, plr_node *node, const plr_matrix *matrix);

static bool is_a(const plr_node *node, const char *type) {
    const plr_node_info *info = plr_node_info_find(plr_node_type(node));
    return info && plr_node_info_is(info, type);
}

/* ISO/IEC 19775-1 V4 10.4.4: P' = T C R SR S -SR -C P. */
static plr_matrix transform_matrix(const plr_node *node) {
    float t[3] = {0}, c[3] = {0}, r[4] = {0, 0, 1, 0}, s[3] = {1, 1, 1}, o[4] = {0, 0, 1, 0};
    plr_node_numbers(node, "translation", t, 3);
    plr_node_numbers(node, "center", c, 3);
    plr_node_numbers(node, "rotation", r, 4);
    plr_node_numbers(node, "scale", s, 3);
    plr_node_numbers(node, "scaleOrientation", o, 4);
    const plr_matrix parts[] = {
        plr_matrix_translation((double)t[0] + (double)c[0], (double)t[1] + (double)c[1],
                               (double)t[2] + (double)c[2]),
        plr_matrix_rotation(r[0], r[1], r[2], r[3]),
        plr_matrix_rotation(o[0], o[1], o[2], o[3]),
        plr_matrix_scale(s[0], s[1], s[2]),
        plr_matrix_rotation(o[0], o[1], o[2], -o[3]),
        plr_matrix_translation(-c[0], -c[1], -c[2]),
    };
    plr_matrix result = parts[0];
    for (size_t i = 1; i < sizeof parts / sizeof *parts; i++)
        result = plr_matrix_multiply(&result, &parts[i]);
    return result;
}

static void add_light(walk *w, plr_node *node, const plr_matrix *matrix) {
    *PLR_PUSH(w->arena, &w->flat->all_lights) = (plr_light){node, *matrix};
    if (!plr_node_bool(node, "on"))
        return;
    bool global = plr_node_bool(node, "global");
    plr_lights *lights = global ? &w->flat->global_lights : &w->scope->lights;
    *PLR_PUSH(w->arena, lights) = (plr_light){node, *matrix};
}

static void visit_children(walk *w, plr_node *node, const char *name, const plr_matrix *matrix) {
    const plr_field *children = plr_node_field(node, name);
    if (!children || plr_type_kind(children->type) != PLR_NODE)
        return;
    plr_scope *scope = PLR_NEW(w->arena, plr_scope), *outer = w->scope;
    scope->outer = outer;
    w->scope = scope;
    for (size_t i = 0; i < children->count && w->visits <= MOST_VISITS; i++)
        visit(w, children->value.nodes[i], matrix);
    w->scope = outer;
}

static void visit_transform(walk *w, plr_node *node, const plr_matrix *matrix) {
    plr_matrix own = transform_matrix(node);
    plr_matrix product = plr_matrix_multiply(matrix, &own);
    visit_children(w, node, "children", &product);
}

static void visit_one(walk *w, plr_node *node, const char *field, size_t index,
                      const plr_matrix *matrix) {
    const plr_field *children = plr_node_field(node, field);
    if (!children || index >= children->count)
        return;
    plr_scope *scope = PLR_NEW(w->arena, plr_scope), *outer = w->scope;
    scope->outer = outer;
    w->scope = scope;
    visit(w, children->value.nodes[index], matrix);
    w->scope = outer;
}

static void visit_switch(walk *w, plr_node *node, const plr_matrix *matrix) {
    int choice = plr_node_int(node, "whichChoice");
    const plr_field *children = plr_node_field(node, "children");
    const char *field = children && children->count ? "children" : "choice";
    if (choice >= 0)
        visit_one(w, node, field, (size_t)choice, matrix);
}

static void visit_lod(walk *w, plr_node *node, const plr_matrix *matrix) {
    const plr_field *children = plr_node_field(node, "children");
    visit_one(w, node, children && children->count ? "children" : "level", 0, matrix);
}

static void visit_viewpoint(walk *w, plr_node *node, const plr_matrix *matrix) {
    float p[3] = {0}, o[4] = {0, 0, 1, 0};
    plr_node_numbers(node, "position", p, 3);
    plr_node_numbers(node, "orientation", o, 4);
    plr_matrix move = plr_matrix_translation(p[0], p[1], p[2]);
    plr_matrix turn = plr_matrix_rotation(o[0], o[1], o[2], o[3]);
    plr_matrix placed = plr_matrix_multiply(matrix, &move);
    placed = plr_matrix_multiply(&placed, &turn);
    for (int column = 0; column < 3; column++) { /* lengths of eye space are those of the world */
        double *v = &placed.m[column * 4];
        double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        for (int k = 0; length > 0 && k < 3; k++)
            v[k] /= length;
    }
    *PLR_PUSH(w->arena, &w->flat->viewpoints) = (plr_viewpoint){node, placed};
}

static void visit_volume(walk *w, plr_node *node, const plr_matrix *matrix) {
    *PLR_PUSH(w->arena, &w->flat->volumes) = (plr_leaf){node, *matrix, w->scope};
}

static void visit_shape(walk *w, plr_node *node, const plr_matrix *matrix) {
    if (plr_node_child(node, "geometry"))
        *PLR_PUSH(w->arena, &w->flat->shapes) = (plr_leaf){node, *matrix, w->scope};
}

static void visit_effect(walk *w, plr_node *node, const plr_matrix *matrix) {
    (void)matrix;
    *PLR_PUSH(w->arena, &w->scope->effects) = node;
}

static void visit_background(walk *w, plr_node *node, const plr_matrix *matrix) {
    if (!w->flat->background) {
        w->flat->background = node;
        w->flat->background_to_world = *matrix;
    }
}

static void visit_navigation(walk *w, plr_node *node, const plr_matrix *matrix) {
    (void)matrix;
    if (!w->flat->navigation)
        w->flat->navigation = node;
}

static void visit_group(walk *w, plr_node *node, const plr_matrix *matrix) {
    visit_children(w, node, "children", matrix);
}

static void not_drawn(walk *w, plr_node *node, const plr_matrix *matrix) {
    (void)matrix;
    plr_diags_add(w->diags, PLR_CODE_NOT_DRAWN, plr_node_place(node), "%s is not drawn yet",
                  plr_node_type(node));
}

/* By type or abstract type; the first that fits counts. */
static const struct {
    const char *type;
    void (*visit)(walk *, plr_node *, const plr_matrix *);
} visitors[] = {
    {"Transform", visit_transform},
    {"Switch", visit_switch},
    {"LOD", visit_lod},
    {"Effect", visit_effect},
    {"VolumeData", visit_volume},
    {"X3DVolumeDataNode", not_drawn},
    {"Shape", visit_shape},
    {"X3DLightNode", add_light},
    {"X3DViewpointNode", visit_viewpoint},
    {"X3DBackgroundNode", visit_background},
    {"NavigationInfo", visit_navigation},
    {"KambiNavigationInfo", visit_navigation},
    {"Fog", not_drawn},
    {"LocalFog", not_drawn},
    {"ClipPlane", not_drawn},
};

static bool is_too_much(walk *w, const plr_node *node) {
    if (w->visits == MOST_VISITS)
        plr_diags_add(w->diags, PLR_CODE_LIMIT, plr_node_place(node),
                      "the scene has more than %d nodes where it uses some again and again; the "
                      "rest is left out",
                      MOST_VISITS);
    return w->visits++ >= MOST_VISITS;
}

static void visit(walk *w, plr_node *node, const plr_matrix *matrix) {
    if (!node || is_too_much(w, node))
        return;
    const plr_field *visible = plr_node_field(node, "visible");
    if (visible && !plr_node_bool(node, "visible"))
        return;
    for (size_t i = 0; i < sizeof visitors / sizeof *visitors; i++)
        if (is_a(node, visitors[i].type)) {
            visitors[i].visit(w, node, matrix);
            return;
        }
    visit_group(w, node, matrix);
}

void plr_flatten(plr_arena *arena, plr_scene *scene, plr_flat *flat, plr_diags *diags) {
    *flat = (plr_flat){0};
    plr_scope *top = PLR_NEW(arena, plr_scope);
    walk w = {arena, flat, diags, top, 0};
    plr_matrix identity = plr_matrix_identity();
    for (size_t i = 0; i < plr_scene_root_count(scene); i++)
        visit(&w, plr_scene_root(scene, i), &identity);
    bool headlight = !flat->navigation || plr_node_bool(flat->navigation, "headlight");
    if (headlight)
        *PLR_PUSH(arena, &flat->global_lights) = (plr_light){NULL, identity};
}

void plr_flatten_node(plr_arena *arena, plr_scene *scene, plr_node *node, const plr_flat *around,
                      plr_flat *flat, plr_diags *diags) {
    *flat = (plr_flat){0};
    walk w = {arena, flat, diags, PLR_NEW(arena, plr_scope), 0};
    plr_matrix identity = plr_matrix_identity();
    visit(&w, node, &identity);
    bool *inside = PLR_NEW_ARRAY(arena, plr_scene_node_count(scene) + 1, bool);
    for (size_t i = 0; i < flat->all_lights.count; i++)
        inside[plr_node_id(flat->all_lights.items[i].node)] = true;
    for (size_t i = 0; i < around->global_lights.count; i++) {
        plr_light light = around->global_lights.items[i];
        if (light.node ? !inside[plr_node_id(light.node)] : !flat->navigation)
            *PLR_PUSH(arena, &flat->global_lights) = light;
    }
    if (flat->navigation && plr_node_bool(flat->navigation, "headlight"))
        *PLR_PUSH(arena, &flat->global_lights) = (plr_light){NULL, identity};
}

const plr_viewpoint *plr_flat_viewpoint(const plr_flat *flat, const char *selector) {
    static const plr_viewpoint standard = {NULL,
                                           {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 10, 1}}};
    size_t count = flat->viewpoints.count;
    if (!selector || !*selector)
        return count ? &flat->viewpoints.items[0] : &standard;
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

void plr_viewpoint_cut(const plr_viewpoint *viewpoint, double cut[2]) {
    double near = viewpoint->node ? plr_node_number(viewpoint->node, "nearDistance") : 0;
    double far = viewpoint->node ? plr_node_number(viewpoint->node, "farDistance") : 0;
    cut[0] = near > 0 ? near : 0;
    cut[1] = far > 0 ? far : INFINITY;
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
    double x = aspect >= 1 ? half * aspect : half, y = aspect >= 1 ? half : half / aspect;
    *projection = plr_matrix_perspective((double[]){-x, -y, x, y}, near, far);
}
