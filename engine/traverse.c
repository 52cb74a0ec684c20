#include "engine/traverse.h"

#include <math.h>

#include "engine/bounds.h"

/* DEF and USE let a short file describe more nodes than any machine can draw, and deeper ones. */
enum {
    MOST_VISITS = 100000,
    MOST_DEPTH = 4000
};

typedef struct walk {
    plr_arena *arena;
    plr_flat *flat;
    plr_diags *diags;
    plr_scope *scope;
    size_t visits, depth;
    plr_bounds bounds;
} walk;

static void visit(walk *w, plr_node *node, const plr_matrix *matrix);

static bool is_a(const plr_node *node, const char *type) {
    const plr_node_info *info = plr_node_info_find(plr_node_type(node));
    return info && plr_node_info_is(info, type);
}

static void add_light(walk *w, plr_node *node, const plr_matrix *matrix) {
    *PLR_PUSH(w->arena, &w->flat->all_lights) = (plr_light){.node = node, .to_world = *matrix};
    bool global = plr_node_bool(node, "global");
    plr_lights *lights = global ? &w->flat->global_lights : &w->scope->lights;
    *PLR_PUSH(w->arena, lights) =
        (plr_light){.node = node, .to_world = *matrix, .off = !plr_node_bool(node, "on")};
}

/* At most `most` nodes of a field; what is among them is in their scope. */
static void visit_list(walk *w, plr_node *node, const char *name, size_t most,
                       const plr_matrix *matrix) {
    const plr_field *children = plr_node_field(node, name);
    if (!children || plr_type_kind(children->type) != PLR_NODE)
        return;
    plr_scope *scope = PLR_NEW(w->arena, plr_scope), *outer = w->scope;
    scope->outer = outer;
    w->scope = scope;
    for (size_t i = 0; i < children->count && i < most && w->visits <= MOST_VISITS; i++)
        visit(w, children->value.nodes[i], matrix);
    w->scope = outer;
}

static void visit_children(walk *w, plr_node *node, const char *name, const plr_matrix *matrix) {
    visit_list(w, node, name, SIZE_MAX, matrix);
}

static void visit_fog(walk *w, plr_node *node, const plr_matrix *matrix) {
    if (!w->flat->fog.node)
        w->flat->fog = (plr_placed){.node = node, .to_world = *matrix};
}

static void visit_local_fog(walk *w, plr_node *node, const plr_matrix *matrix) {
    if (!w->scope->fog.node && plr_node_bool(node, "enabled"))
        w->scope->fog = (plr_placed){.node = node, .to_world = *matrix};
}

static void visit_clip_plane(walk *w, plr_node *node, const plr_matrix *matrix) {
    *PLR_PUSH(w->arena, &w->scope->clip_planes) =
        (plr_placed){.node = node, .to_world = *matrix, .off = !plr_node_bool(node, "enabled")};
}

static void visit_tone_mapping(walk *w, plr_node *node, const plr_matrix *matrix) {
    (void)matrix;
    if (!w->flat->tone_mapping)
        w->flat->tone_mapping = node;
}

static void visit_group(walk *w, plr_node *node, const plr_matrix *matrix) {
    plr_matrix own, product = *matrix;
    if (plr_node_transform(node, own.m))
        product = plr_matrix_multiply(matrix, &own);
    static const char *const fields[] = {"children", "shape", "layers", "skeleton", "skin"};
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        visit_children(w, node, fields[i], &product);
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

/* Where the viewer is, in the coordinates of a node; false where nobody looks or the node's space
 * has no extent. */
static bool viewer_in(walk *w, const plr_matrix *matrix, plr_matrix *eye) {
    plr_matrix to_local;
    w->flat->depends_on_viewer = true;
    if (!w->flat->has_eye || !plr_matrix_invert(matrix, &to_local))
        return false;
    *eye = plr_matrix_multiply(&to_local, &w->flat->eye_to_world);
    return true;
}

/* How far the viewer is from the field `center`, in the node's own coordinates; 0 where nobody
 * looks.
 */
static double viewer_distance(walk *w, const plr_node *node, const plr_matrix *matrix) {
    float c[3] = {0};
    plr_matrix eye;
    if (!viewer_in(w, matrix, &eye))
        return 0;
    plr_node_numbers(node, "center", c, 3);
    double x = eye.m[12] - (double)c[0], y = eye.m[13] - (double)c[1], z = eye.m[14] - (double)c[2];
    return sqrt(x * x + y * y + z * z);
}

/* ISO/IEC 19775-1 V4 23.4.3: the distance counts in the node's own coordinates. */
static void visit_lod(walk *w, plr_node *node, const plr_matrix *matrix) {
    const plr_field *children = plr_node_field(node, "children");
    const char *name = children && children->count ? "children" : "level";
    const plr_field *levels = plr_node_field(node, name), *range = plr_node_field(node, "range");
    size_t level = 0;
    if (range && range->count) {
        double distance = viewer_distance(w, node, matrix);
        while (level < range->count && distance >= (double)range->value.floats[level])
            level++;
    }
    if (levels && levels->count)
        visit_one(w, node, name, level < levels->count ? level : levels->count - 1, matrix);
}

/* The proposal of 2005 for volumes, 4.6: near by eight nodes at most, far away one. Its x3d/events
 * tell the same (lowResActive). */
static void visit_octants(walk *w, plr_node *node, const plr_matrix *matrix) {
    enum {
        OCTANTS = 8
    };
    const plr_field *high = plr_node_field(node, "highRes");
    bool far =
        w->flat->has_eye && viewer_distance(w, node, matrix) >= plr_node_number(node, "range");
    w->flat->depends_on_viewer = true;
    if (high && high->count > OCTANTS)
        plr_diags_add(w->diags, PLR_CODE_NOT_DRAWN, high->place,
                      "OctTree.highRes has %zu nodes; the first %d are drawn", high->count,
                      OCTANTS);
    if (far)
        visit_list(w, node, "lowRes", 1, matrix);
    else
        visit_list(w, node, "highRes", OCTANTS, matrix);
}

static void cross(const double *a, const double *b, double *out) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool normalize(double *v) {
    double length = sqrt(dot(v, v));
    for (int i = 0; i < 3 && length > 0; i++)
        v[i] /= length;
    return length > 0;
}

/* The turn around an axis that brings the z axis as near to a direction as it comes. */
static plr_matrix turn_about(const double axis[3], const double *to) {
    const double z[3] = {0, 0, 1};
    double from_side[3], to_side[3];
    cross(axis, z, from_side);
    cross(axis, to, to_side);
    double turned[3];
    cross(from_side, to_side, turned);
    double angle = atan2(dot(axis, turned), dot(from_side, to_side));
    return plr_matrix_rotation(axis[0], axis[1], axis[2], angle);
}

/* 23.4.1: its z axis turns to the viewer, around an axis, or, without one, so that its y axis is
 * upright on the screen. */
static void visit_billboard(walk *w, plr_node *node, const plr_matrix *matrix) {
    float a[3] = {0, 1, 0};
    plr_node_numbers(node, "axisOfRotation", a, 3);
    double axis[3] = {a[0], a[1], a[2]};
    plr_matrix eye, turned = *matrix;
    if (viewer_in(w, matrix, &eye)) {
        plr_matrix turn = plr_matrix_identity();
        double *x = &turn.m[0], *y = &turn.m[4], *z = &turn.m[8];
        if (normalize(axis)) {
            turn = turn_about(axis, &eye.m[12]);
        } else {
            for (int i = 0; i < 3; i++)
                z[i] = eye.m[12 + i];
            cross(&eye.m[4], z, x);
            cross(z, x, y);
            if (!normalize(x) || !normalize(y) || !normalize(z))
                turn = plr_matrix_identity();
        }
        turned = plr_matrix_multiply(matrix, &turn);
    }
    visit_children(w, node, "children", &turned);
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
    *PLR_PUSH(w->arena, &w->flat->viewpoints) = (plr_viewpoint){.node = node, .to_world = placed};
}

static void visit_volume(walk *w, plr_node *node, const plr_matrix *matrix) {
    *PLR_PUSH(w->arena, &w->flat->volumes) = (plr_leaf){node, *matrix, w->scope};
}

/* Whether it makes points whose last component is not 1. */
static bool is_projective(const plr_matrix *matrix) {
    const double *m = matrix->m;
    return m[3] < 0 || m[3] > 0 || m[7] < 0 || m[7] > 0 || m[11] < 0 || m[11] > 0 || m[15] < 1 ||
           m[15] > 1;
}

static void visit_shape(walk *w, plr_node *node, const plr_matrix *matrix) {
    const plr_field *render = plr_node_field(node, "render");
    if (!plr_node_child(node, "geometry") || (render && !plr_node_bool(node, "render")))
        return;
    *PLR_PUSH(w->arena, &w->flat->shapes) = (plr_leaf){node, *matrix, w->scope};
    w->flat->projective = w->flat->projective || is_projective(matrix);
}

static void visit_effect(walk *w, plr_node *node, const plr_matrix *matrix) {
    (void)matrix;
    *PLR_PUSH(w->arena, &w->scope->effects) = node;
}

/* The first one is in use until events bind another one. */
static bool is_better(const plr_node *node, const plr_node *than) {
    return !than || (plr_node_bool(node, "isBound") && !plr_node_bool(than, "isBound"));
}

static void visit_background(walk *w, plr_node *node, const plr_matrix *matrix) {
    if (is_better(node, w->flat->background)) {
        w->flat->background = node;
        w->flat->background_to_world = *matrix;
    }
}

static void visit_navigation(walk *w, plr_node *node, const plr_matrix *matrix) {
    (void)matrix;
    if (is_better(node, w->flat->navigation))
        w->flat->navigation = node;
}

/* What a sensor names is drawn where it stands, not there. */
static void visit_sensor(walk *w, plr_node *node, const plr_matrix *matrix) {
    (void)w, (void)node, (void)matrix;
}

static void not_drawn(walk *w, plr_node *node, const plr_matrix *matrix) {
    (void)matrix;
    plr_diags_add(w->diags, PLR_CODE_NOT_DRAWN, plr_node_place(node), "%s is not drawn yet",
                  plr_node_type(node));
}

static void visit_screen_effect(walk *w, plr_node *node, const plr_matrix *matrix) {
    if (plr_node_bool(node, "enabled"))
        not_drawn(w, node, matrix);
}

/* By type or abstract type; the first that fits counts. */
static const struct {
    const char *type;
    void (*visit)(walk *, plr_node *, const plr_matrix *);
} visitors[] = {
    {"Transform", visit_group},
    {"Switch", visit_switch},
    {"LOD", visit_lod},
    {"OctTree", visit_octants},
    {"Billboard", visit_billboard},
    {"Collision", visit_group},
    {"X3DSensorNode", visit_sensor},
    {"Effect", visit_effect},
    {"X3DVolumeDataNode", visit_volume},
    {"Shape", visit_shape},
    {"X3DLightNode", add_light},
    {"X3DViewpointNode", visit_viewpoint},
    {"X3DBackgroundNode", visit_background},
    {"NavigationInfo", visit_navigation},
    {"Fog", visit_fog},
    {"LocalFog", visit_local_fog},
    {"ClipPlane", visit_clip_plane},
    {"ToneMapping", visit_tone_mapping},
    {"ScreenEffect", visit_screen_effect},
};

static bool is_too_deep(walk *w, const plr_node *node) {
    if (w->depth == MOST_DEPTH)
        plr_diags_add(w->diags, PLR_CODE_LIMIT, plr_node_place(node),
                      "nodes inside nodes, deeper than %d; what is deeper is left out", MOST_DEPTH);
    return w->depth >= MOST_DEPTH;
}

static bool is_too_much(walk *w, const plr_node *node) {
    if (w->visits == MOST_VISITS)
        plr_diags_add(w->diags, PLR_CODE_LIMIT, plr_node_place(node),
                      "the scene has more than %d nodes where it uses some again and again; the "
                      "rest is left out",
                      MOST_VISITS);
    return w->visits++ >= MOST_VISITS;
}

/* The box is seen where what is in it is hidden, too. It does not move with the transformation that
 * a group makes: it stands among what is inside. */
static void show_box(walk *w, const plr_node *node, const plr_matrix *matrix, bool hidden,
                     size_t first_shape, size_t first_volume) {
    plr_matrix own, inside = *matrix;
    if (plr_node_transform(node, own.m))
        inside = plr_matrix_multiply(matrix, &own);
    plr_leaves shapes = w->flat->shapes;
    plr_bounds_show(&w->bounds, node, &inside, first_shape, first_volume);
    if (!hidden)
        return;
    bool shown = w->flat->shapes.count > shapes.count;
    if (shown)
        w->flat->shapes.items[first_shape] = w->flat->shapes.items[shapes.count];
    w->flat->shapes.count = first_shape + shown;
    w->flat->volumes.count = first_volume;
}

static void visit(walk *w, plr_node *node, const plr_matrix *matrix) {
    if (!node || is_too_much(w, node) || is_too_deep(w, node))
        return;
    const plr_field *visible = plr_node_field(node, "visible");
    bool hidden = visible && !plr_node_bool(node, "visible");
    bool leaf = is_a(node, "X3DShapeNode") || is_a(node, "X3DVolumeDataNode");
    bool boxed = plr_node_bool(node, "bboxDisplay");
    if (hidden && !boxed)
        return;
    size_t i = 0, count = sizeof visitors / sizeof *visitors;
    size_t first_shape = w->flat->shapes.count, first_volume = w->flat->volumes.count;
    while (i < count && !is_a(node, visitors[i].type))
        i++;
    w->depth++;
    if (!hidden || leaf)
        (i < count ? visitors[i].visit : visit_group)(w, node, matrix);
    w->depth--;
    if (boxed)
        show_box(w, node, matrix, hidden, first_shape, first_volume);
}

/* The headlight, or another light in its place: where the viewer is. */
static void add_headlight(plr_arena *arena, plr_flat *flat) {
    plr_node *node = flat->navigation ? plr_node_child(flat->navigation, "headlightNode") : NULL;
    bool off = (flat->navigation && !plr_node_bool(flat->navigation, "headlight")) ||
               (node && !plr_node_bool(node, "on"));
    *PLR_PUSH(arena, &flat->global_lights) = (plr_light){
        .node = node, .to_world = plr_matrix_identity(), .in_eye_space = true, .off = off};
}

static void limit_views(plr_flat *flat) {
    double limit = flat->navigation ? plr_node_number(flat->navigation, "visibilityLimit") : 0;
    flat->standard.to_world = plr_matrix_translation(0, 0, 10);
    flat->standard.limit = limit;
    for (size_t i = 0; i < flat->viewpoints.count; i++)
        flat->viewpoints.items[i].limit = limit;
}

static walk begin(plr_arena *arena, plr_scene *scene, plr_flat *flat, plr_diags *diags) {
    return (walk){.arena = arena,
                  .flat = flat,
                  .diags = diags,
                  .scope = PLR_NEW(arena, plr_scope),
                  .bounds = {.arena = arena, .scene = scene, .flat = flat, .diags = diags}};
}

void plr_flatten(plr_arena *arena, plr_scene *scene, const plr_matrix *eye_to_world, plr_flat *flat,
                 plr_diags *diags) {
    *flat = (plr_flat){.has_eye = eye_to_world != NULL};
    if (eye_to_world)
        flat->eye_to_world = *eye_to_world;
    walk w = begin(arena, scene, flat, diags);
    plr_matrix identity = plr_matrix_identity();
    for (size_t i = 0; i < plr_scene_root_count(scene); i++)
        visit(&w, plr_scene_root(scene, i), &identity);
    add_headlight(arena, flat);
    limit_views(flat);
}

void plr_flatten_node(plr_arena *arena, plr_scene *scene, plr_node *node, const plr_flat *around,
                      plr_flat *flat, plr_diags *diags) {
    *flat = (plr_flat){.has_eye = around->has_eye, .eye_to_world = around->eye_to_world};
    walk w = begin(arena, scene, flat, diags);
    plr_matrix identity = plr_matrix_identity();
    visit(&w, node, &identity);
    bool *inside = PLR_NEW_ARRAY(arena, plr_scene_node_count(scene) + 1, bool);
    for (size_t i = 0; i < flat->all_lights.count; i++)
        inside[plr_node_id(flat->all_lights.items[i].node)] = true;
    for (size_t i = 0; i < around->global_lights.count; i++) {
        plr_light light = around->global_lights.items[i];
        if (light.in_eye_space ? !flat->navigation : !inside[plr_node_id(light.node)])
            *PLR_PUSH(arena, &flat->global_lights) = light;
    }
    for (size_t i = 0; i < around->all_lights.count; i++)
        if (!inside[plr_node_id(around->all_lights.items[i].node)])
            *PLR_PUSH(arena, &flat->all_lights) = around->all_lights.items[i];
    if (flat->navigation)
        add_headlight(arena, flat);
    limit_views(flat);
}
