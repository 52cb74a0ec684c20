/* The tree of nodes, with cameras (ISO/IEC 12113 3.10) and the lights of KHR_lights_punctual. */
#include "x3d/gltf_internal.h"

#include <math.h>
#include <string.h>

static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/* Columns first, as the format has them: r = a b. */
static void multiply(const double *a, const double *b, double *r) {
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a[4 * k + row] * b[4 * column + k];
            r[4 * column + row] = sum;
        }
}

static void add_to_box(gltf_box *box, const double *m, const gltf_box *other) {
    for (int corner = 0; other->any && corner < 8; corner++) {
        double p[3], q[3];
        for (int i = 0; i < 3; i++)
            p[i] = corner >> i & 1 ? other->most[i] : other->least[i];
        for (int i = 0; i < 3; i++)
            q[i] = m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i];
        gltf_box_add(box, q);
    }
}

/* ---- Transforms ---- */

typedef struct placement {
    double translation[3], rotation[4] /* a quaternion */, scale[3];
    double matrix[16];
    bool has_matrix;
} placement;

/* Unit length; what has none turns nothing. */
static void normalise(double q[4]) {
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4; i++)
        q[i] = length > 0 ? q[i] / length : i == 3;
}

static void compose(const double t[3], const double q[4], const double s[3], double m[16]) {
    double x = q[0], y = q[1], z = q[2], w = q[3];
    const double turn[9] = {
        1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),
        2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
        2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y)};
    memcpy(m, identity, sizeof identity);
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            m[4 * column + row] = turn[3 * column + row] * s[column];
    memcpy(m + 12, t, 3 * sizeof *t);
}

static void read_placement(gltf *g, const x3d_json *json, placement *p) {
    *p = (placement){.rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}};
    p->has_matrix = gltf_numbers(g, json, "matrix", p->matrix, 16);
    gltf_numbers(g, json, "translation", p->translation, 3);
    gltf_numbers(g, json, "rotation", p->rotation, 4);
    gltf_numbers(g, json, "scale", p->scale, 3);
    normalise(p->rotation);
    if (!p->has_matrix)
        compose(p->translation, p->rotation, p->scale, p->matrix);
}

static plr_node *make_transform(gltf *g, const x3d_json *json, const placement *p) {
    if (p->has_matrix) {
        plr_node *node = gltf_node(g, "MatrixTransform", json);
        double rows[16]; /* as the fields of X3D are kept */
        for (int i = 0; i < 16; i++)
            rows[i] = p->matrix[i % 4 * 4 + i / 4];
        gltf_set_numbers(g, node, "matrix", rows, 16);
        return node;
    }
    plr_node *node = gltf_node(g, "Transform", json);
    if (x3d_json_member(json, "translation"))
        gltf_set_numbers(g, node, "translation", p->translation, 3);
    if (x3d_json_member(json, "scale"))
        gltf_set_numbers(g, node, "scale", p->scale, 3);
    if (x3d_json_member(json, "rotation")) {
        const double *q = p->rotation;
        double sine = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
        double turn[4] = {0, 0, 1, 2 * atan2(sine, q[3])};
        for (int i = 0; i < 3 && sine > 0; i++)
            turn[i] = q[i] / sine;
        gltf_set_numbers(g, node, "rotation", turn, 4);
    }
    return node;
}

/* ---- Cameras ---- */

/* Both kinds look along -Z from the origin, as X3D's do. */
static plr_node *make_viewpoint(gltf *g, const char *type, const x3d_json *json,
                                const x3d_json *lens) {
    static const double origin[3] = {0, 0, 0};
    plr_node *node = gltf_node(g, type, json);
    gltf_set_numbers(g, node, "position", origin, 3);
    double near = gltf_number(g, lens, "znear", 0), far = gltf_number(g, lens, "zfar", 0);
    if (near > 0)
        gltf_set_number(g, node, "nearDistance", near);
    if (far > near)
        gltf_set_number(g, node, "farDistance", far);
    return node;
}

static plr_node *make_camera(gltf *g, const x3d_json *json) {
    const x3d_json *perspective = gltf_object(g, json, "perspective");
    const x3d_json *orthographic = gltf_object(g, json, "orthographic");
    if (orthographic && !perspective) {
        double x = gltf_number(g, orthographic, "xmag", 1);
        double y = gltf_number(g, orthographic, "ymag", 1);
        plr_node *node = make_viewpoint(g, "OrthoViewpoint", json, orthographic);
        if (x > 0 && y > 0)
            gltf_set_numbers(g, node, "fieldOfView", (double[]){-x, -y, x, y}, 4);
        return node;
    }
    if (!perspective) {
        x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, json),
                   "a camera is perspective or orthographic");
        return NULL;
    }
    plr_node *node = make_viewpoint(g, "Viewpoint", json, perspective);
    double angle = gltf_number(g, perspective, "yfov", 0);
    if (angle > 0 && angle < 3.14159)
        gltf_set_number(g, node, "fieldOfView", angle);
    gltf_set_bool(g, node, "fieldOfViewForceVertical", true);
    return node;
}

static void add_camera(gltf *g, const x3d_json *json, plr_node *parent) {
    size_t index;
    const x3d_json *camera = gltf_refer(g, json, "camera", GLTF_CAMERAS, &index);
    plr_node *node = camera ? make_camera(g, camera) : NULL;
    if (!node)
        return;
    const x3d_json *name = gltf_text(g, json, "name");
    if (!name)
        name = gltf_text(g, camera, "name");
    if (name)
        gltf_set_string(g, node, "description",
                        plr_arena_copy(&g->scene->arena, name->value.text, name->count),
                        name->count, name);
    gltf_define_later(g, node, camera);
    gltf_add_node(g, parent, "children", node);
    g->has_camera = true;
}

/* ---- Lights ---- */

static void set_spot(gltf *g, plr_node *node, const x3d_json *json) {
    const double right_angle = 1.57079632679489662;
    const x3d_json *spot = gltf_object(g, json, "spot");
    double inner = gltf_between(g, spot, "innerConeAngle", 0, 0, right_angle);
    double outer = gltf_between(g, spot, "outerConeAngle", right_angle / 2, 0, right_angle);
    gltf_set_number(g, node, "beamWidth", inner);
    gltf_set_number(g, node, "cutOffAngle", outer);
}

static plr_node *make_light(gltf *g, const x3d_json *json) {
    static const double inverse_square[3] = {0, 0, 1};
    static const char *const types[][2] = {
        {"directional", "DirectionalLight"}, {"point", "PointLight"}, {"spot", "SpotLight"}};
    const x3d_json *type = gltf_text(g, json, "type");
    size_t kind = 0;
    while (kind < 3 && !x3d_json_is(type, types[kind][0]))
        kind++;
    if (kind == 3) {
        x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, type ? type : json),
                   "a light is directional, point or spot");
        return NULL;
    }
    plr_node *node = gltf_node(g, types[kind][1], json);
    double color[3] = {1, 1, 1};
    if (gltf_numbers(g, json, "color", color, 3))
        gltf_set_numbers(g, node, "color", color, 3);
    gltf_set_number(g, node, "intensity", fmax(gltf_number(g, json, "intensity", 1), 0));
    gltf_set_bool(g, node, "global", true);
    if (kind == 0)
        return node;
    double range = gltf_number(g, json, "range", 0);
    gltf_set_numbers(g, node, "attenuation", inverse_square, 3);
    gltf_set_number(g, node, "radius", range > 0 ? range : 1e18); /* no end; its square is finite */
    if (kind == 2)
        set_spot(g, node, json);
    return node;
}

static void add_light(gltf *g, const x3d_json *json, plr_node *parent) {
    size_t index;
    const x3d_json *use = gltf_extension(g, json, "KHR_lights_punctual");
    const x3d_json *light = use ? gltf_refer(g, use, "light", GLTF_LIGHTS, &index) : NULL;
    if (!light)
        return;
    void **made = gltf_made(g, "light %zu", index);
    if (!*made) {
        *made = make_light(g, light);
        gltf_define_later(g, *made, light);
    }
    gltf_add_node(g, parent, "children", *made);
}

/* ---- Nodes ---- */

static plr_node *read_node(gltf *g, size_t index, const double *outer);

static void add_children(gltf *g, const x3d_json *json, plr_node *parent, const double *matrix) {
    const x3d_json *children = gltf_list(g, json, "children");
    for (size_t i = 0; children && i < children->count && !g->scene->stopped; i++) {
        size_t index;
        const x3d_json *reference = &children->value.items[i];
        if (!gltf_item(g, reference, GLTF_NODES, &index))
            continue;
        if (g->nodes[index] == GLTF_UNSEEN)
            gltf_add_node(g, parent, "children", read_node(g, index, matrix));
        else
            x3d_report(g->scene, PLR_CODE_RECURSION, gltf_place(g, reference), "node %zu %s", index,
                       g->nodes[index] == GLTF_OPEN ? "contains itself"
                                                    : "is part of the scene already");
    }
}

static void add_mesh(gltf *g, const x3d_json *json, plr_node *parent, const double *matrix) {
    size_t index;
    if (!gltf_refer(g, json, "mesh", GLTF_MESHES, &index))
        return;
    const gltf_mesh *mesh = gltf_mesh_at(g, index);
    gltf_add_node(g, parent, "children", mesh->node);
    add_to_box(&g->box, matrix, &mesh->box);
    const x3d_json *skin = x3d_json_member(json, "skin");
    if (skin && !g->told_skin) {
        x3d_report(g->scene, PLR_CODE_NOT_DRAWN, gltf_place(g, skin),
                   "skins are not drawn yet: the mesh stands as it was modelled");
        g->told_skin = true;
    }
}

/* The node with all below it; `outer`: from its parent's coordinates to those of the file. */
static plr_node *read_node(gltf *g, size_t index, const double *outer) {
    const x3d_json *json = &g->tables[GLTF_NODES]->value.items[index];
    if (!x3d_enter(g->build, gltf_place(g, json)))
        return NULL;
    placement own;
    double matrix[16];
    g->nodes[index] = GLTF_OPEN;
    read_placement(g, json, &own);
    multiply(outer, own.matrix, matrix);
    plr_node *node = make_transform(g, json, &own);
    gltf_define(g, node, gltf_text(g, json, "name"));
    add_camera(g, json, node);
    add_light(g, json, node);
    add_mesh(g, json, node, matrix);
    add_children(g, json, node, matrix);
    g->nodes[index] = GLTF_DONE;
    x3d_leave(g->build);
    return node;
}

/* ---- The scene ---- */

static void add_root(gltf *g, size_t index) {
    plr_node *node = read_node(g, index, identity);
    if (node)
        *PLR_PUSH(&g->scene->arena, &g->build->nodes) = node;
}

static void read_roots(gltf *g, const x3d_json *scene) {
    const x3d_json *roots = gltf_list(g, scene, "nodes");
    for (size_t i = 0; roots && i < roots->count && !g->scene->stopped; i++) {
        size_t index;
        const x3d_json *reference = &roots->value.items[i];
        if (!gltf_item(g, reference, GLTF_NODES, &index))
            continue;
        if (g->nodes[index] == GLTF_UNSEEN)
            add_root(g, index);
        else
            x3d_report(g->scene, PLR_CODE_RECURSION, gltf_place(g, reference),
                       "node %zu is part of the scene already", index);
    }
}

/* A document without scenes: all nodes that are no child. */
static void read_all(gltf *g) {
    size_t count = gltf_table_count(g, GLTF_NODES), index;
    bool *is_child = PLR_NEW_ARRAY(g->scratch, count, bool);
    for (size_t i = 0; i < count; i++) {
        const x3d_json *node = &g->tables[GLTF_NODES]->value.items[i];
        const x3d_json *children =
            node->kind == X3D_JSON_OBJECT ? gltf_list(g, node, "children") : NULL;
        for (size_t k = 0; children && k < children->count; k++)
            if (gltf_item(g, &children->value.items[k], GLTF_NODES, &index))
                is_child[index] = true;
    }
    for (size_t i = 0; i < count && !g->scene->stopped; i++)
        if (!is_child[i] && g->tables[GLTF_NODES]->value.items[i].kind == X3D_JSON_OBJECT)
            add_root(g, i);
}

/* From in front, all of it: for a file without a camera that is opened by itself. */
static void add_standard_viewpoint(gltf *g) {
    const gltf_box *box = &g->box;
    double center[3], radius = 0;
    for (int i = 0; i < 3; i++) {
        center[i] = (box->least[i] + box->most[i]) / 2;
        radius += pow((box->most[i] - box->least[i]) / 2, 2);
    }
    radius = radius > 0 ? sqrt(radius) : 1;
    const double angle = 0.785398163397448;
    plr_node *node = gltf_node(g, "Viewpoint", g->root);
    gltf_set_numbers(g, node, "centerOfRotation", center, 3);
    center[2] += radius / sin(angle / 2);
    gltf_set_numbers(g, node, "position", center, 3);
    gltf_set_string(g, node, "description", "all", 3, g->root);
    if (node)
        *PLR_PUSH(&g->scene->arena, &g->build->nodes) = node;
}

void gltf_read_scene(gltf *g) {
    size_t index = 0;
    const x3d_json *scene = gltf_refer(g, g->root, "scene", GLTF_SCENES, &index);
    if (!scene && gltf_table_count(g, GLTF_SCENES))
        scene = gltf_item(g, &(x3d_json){.kind = X3D_JSON_NUMBER}, GLTF_SCENES, &index);
    if (scene)
        read_roots(g, scene);
    else
        read_all(g);
    gltf_define_rest(g);
    if (g->build->is_main && !g->has_camera && g->box.any)
        add_standard_viewpoint(g);
}
