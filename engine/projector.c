#include "engine/projector.h"

#include <math.h>
#include <string.h>

/* ---- Placing ---- */

static void numbers_of(const plr_node *node, const char *field, double *out, size_t count) {
    float values[4] = {0};
    plr_node_numbers(node, field, values, count);
    for (size_t i = 0; i < count; i++)
        out[i] = (double)values[i];
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool normalize(double v[3]) {
    double length = sqrt(dot(v, v));
    for (int i = 0; length > 0 && i < 3; i++)
        v[i] /= length;
    return length > 0;
}

static void cross(const double a[3], const double b[3], double result[3]) {
    const double product[] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                              a[0] * b[1] - a[1] * b[0]};
    memcpy(result, product, sizeof product);
}

static void turn(const plr_matrix *matrix, double v[3]) {
    double turned[3];
    for (int row = 0; row < 3; row++)
        turned[row] = matrix->m[row] * v[0] + matrix->m[4 + row] * v[1] + matrix->m[8 + row] * v[2];
    memcpy(v, turned, sizeof turned);
}

/* From world space to that of an eye at `location` that looks along `direction`; `up` is made
 * orthogonal, and replaced where it is parallel. */
static plr_matrix look(const double location[3], const double direction[3], const double up[3]) {
    double back[3] = {-direction[0], -direction[1], -direction[2]}, above[3], side[3];
    if (!normalize(back))
        back[2] = 1;
    memcpy(above, up, sizeof above);
    normalize(above);
    if (fabs(dot(above, back)) > 1 - 1e-6) { /* the axis that is farthest from the direction */
        int least = 1;
        for (int axis = 0; axis < 3; axis += 2)
            if (fabs(back[axis]) < fabs(back[least]))
                least = axis;
        memset(above, 0, sizeof above);
        above[least] = 1;
    }
    cross(above, back, side);
    normalize(side);
    cross(back, side, above);
    plr_matrix axes = plr_matrix_identity();
    for (int column = 0; column < 3; column++) {
        axes.m[column * 4] = side[column];
        axes.m[column * 4 + 1] = above[column];
        axes.m[column * 4 + 2] = back[column];
    }
    plr_matrix move = plr_matrix_translation(-location[0], -location[1], -location[2]);
    return plr_matrix_multiply(&axes, &move);
}

static plr_matrix light_place(const plr_view *view, const plr_node *light) {
    for (size_t i = 0; i < view->flat.all_lights.count; i++)
        if (view->flat.all_lights.items[i].node == light)
            return view->flat.all_lights.items[i].to_world;
    return plr_matrix_identity();
}

static plr_matrix place_light(const plr_view *view, const plr_node *light, const char *location) {
    plr_matrix to_world = light_place(view, light);
    double at[3], direction[3] = {0, 0, -1}, up[3];
    numbers_of(light, location, at, 3);
    if (plr_node_field(light, "direction"))
        numbers_of(light, "direction", direction, 3);
    numbers_of(light, "up", up, 3);
    if (!(dot(up, up) > 0))
        up[1] = 1;
    plr_matrix_point(&to_world, at, at);
    if (!plr_node_is(light, "PointLight")) {
        turn(&to_world, direction);
        turn(&to_world, up);
    }
    return look(at, direction, up);
}

static plr_matrix place_viewpoint(const plr_view *view, const plr_node *node) {
    plr_matrix to_world = plr_matrix_identity(), inverse;
    double p[3], o[4];
    numbers_of(node, "position", p, 3);
    numbers_of(node, "orientation", o, 4);
    plr_matrix move = plr_matrix_translation(p[0], p[1], p[2]);
    plr_matrix rotation = plr_matrix_rotation(o[0], o[1], o[2], o[3]);
    to_world = plr_matrix_multiply(&move, &rotation);
    for (size_t i = 0; i < view->flat.viewpoints.count; i++)
        if (view->flat.viewpoints.items[i].node == node)
            to_world = view->flat.viewpoints.items[i].to_world;
    plr_matrix_invert(&to_world, &inverse);
    return inverse;
}

/* ---- Fitting ---- */

/* What the projector must hold: least and greatest x, y and distance in its eye space. */
typedef struct extent {
    double least[3], most[3];
} extent;

static bool casts_shadow(const plr_node *shape) {
    const plr_node *appearance = plr_node_child(shape, "appearance");
    return plr_node_bool(shape, "castShadow") &&
           (!appearance || plr_node_bool(appearance, "shadowCaster"));
}

static void add_surface(extent *e, const plr_surface *surface,
                        const plr_matrix *world_to_projector) {
    plr_matrix matrix = plr_matrix_multiply(world_to_projector, &surface->to_world);
    for (int corner = 0; corner < 8; corner++) {
        double point[3];
        for (int axis = 0; axis < 3; axis++)
            point[axis] = (double)surface->model->mesh.bounds[corner >> axis & 1][axis];
        plr_matrix_point(&matrix, point, point);
        point[2] = -point[2];
        for (int axis = 0; axis < 3; axis++) {
            e->least[axis] = fmin(e->least[axis], point[axis]);
            e->most[axis] = fmax(e->most[axis], point[axis]);
        }
    }
}

/* A hundredth more on each side, so that nothing stands on the border itself. */
static extent scene_extent(const plr_view *view, const plr_matrix *world_to_projector) {
    extent e = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < view->surface_count; i++)
        if (view->surfaces[i].model->mesh.vertex_count &&
            casts_shadow(view->flat.shapes.items[i].node))
            add_surface(&e, &view->surfaces[i], world_to_projector);
    for (int axis = 0; axis < 3; axis++) {
        if (!(e.most[axis] >= e.least[axis]) || !isfinite(e.most[axis] - e.least[axis]))
            e.least[axis] = -1, e.most[axis] = 1;
        double margin = fmax(0.01 * (e.most[axis] - e.least[axis]), 1e-6 * fabs(e.most[axis]));
        margin = fmax(margin, 1e-6);
        e.least[axis] -= margin;
        e.most[axis] += margin;
    }
    return e;
}

/* Distances of a perspective projection: as given, else what holds the scene. */
static void perspective_depths(const plr_view *view, const plr_matrix *world_to_projector,
                               double given_near, double given_far, double depths[2]) {
    extent e = scene_extent(view, world_to_projector);
    depths[1] = given_far > 0 ? given_far : e.most[2] > 0 ? e.most[2] : 1;
    depths[0] = given_near > 0 ? given_near : fmax(e.least[2], depths[1] * 1e-3);
    if (!(depths[1] > depths[0]))
        depths[1] = depths[0] * 2;
}

static plr_matrix square_perspective(double angle, const double depths[2]) {
    const double most = 170 * 3.14159265358979 / 180;
    double half = tan((angle > 0 ? fmin(angle, most) : most) / 2);
    return plr_matrix_perspective((double[]){-half, -half, half, half}, depths[0], depths[1]);
}

/* ---- Kinds of projectors ---- */

static plr_matrix directional(const plr_view *view, const plr_node *light, plr_matrix *to_eye) {
    *to_eye = place_light(view, light, "projectionLocation");
    double box[4];
    numbers_of(light, "projectionRectangle", box, 4);
    extent e = scene_extent(view, to_eye);
    double near = plr_node_number(light, "projectionNear");
    double far = plr_node_number(light, "projectionFar");
    if (!(box[2] > box[0]) || !(box[3] > box[1])) {
        memcpy(box, (double[]){e.least[0], e.least[1], e.most[0], e.most[1]}, sizeof box);
        near = far = 0; /* they would be distances from a place that nobody chose */
    }
    if (!(near > 0))
        near = far > 0 ? fmin(e.least[2], far - 1e-3 * far) : e.least[2];
    if (!(far > 0) || !(far > near))
        far = fmax(e.most[2], near + 1e-3 * fabs(near) + 1e-6);
    return plr_matrix_orthographic(box, near, far);
}

static plr_matrix spot(const plr_view *view, const plr_node *light, plr_matrix *to_eye) {
    *to_eye = place_light(view, light, "location");
    double depths[2], angle = plr_node_number(light, "projectionAngle");
    if (!(angle > 0))
        angle = 2 * plr_node_number(light, "cutOffAngle");
    perspective_depths(view, to_eye, plr_node_number(light, "projectionNear"),
                       plr_node_number(light, "projectionFar"), depths);
    return square_perspective(angle, depths);
}

/* All six directions share the distances: the nearest one is not known from a box. `to_eye` has the
 * axes of the world. */
static plr_matrix around(const plr_view *view, const plr_node *light, const plr_matrix *to_eye) {
    extent e = scene_extent(view, to_eye);
    double far = plr_node_number(light, "projectionFar"), farthest = 0;
    double near = plr_node_number(light, "projectionNear");
    for (int axis = 0; axis < 3; axis++)
        farthest = fmax(farthest, fmax(fabs(e.least[axis]), fabs(e.most[axis])));
    far = far > 0 ? far : farthest;
    near = near > 0 && near < far ? near : far * 1e-3;
    const double depths[2] = {near, far};
    return square_perspective(1.57079632679490, depths);
}

static plr_matrix point(const plr_view *view, const plr_node *light, plr_matrix *to_eye) {
    *to_eye = place_light(view, light, "location");
    return around(view, light, to_eye);
}

plr_matrix plr_projector_cube(const plr_view *view, const plr_node *light, double place[3]) {
    plr_matrix to_eye = place_light(view, light, "location"), to_world;
    plr_matrix_invert(&to_eye, &to_world);
    plr_matrix_point(&to_world, (double[]){0, 0, 0}, place);
    to_eye = plr_matrix_translation(-place[0], -place[1], -place[2]);
    return around(view, light, &to_eye);
}

static plr_matrix perspective_view(const plr_view *view, const plr_node *node, plr_matrix *to_eye) {
    double depths[2];
    *to_eye = place_viewpoint(view, node);
    perspective_depths(view, to_eye, plr_node_number(node, "nearDistance"),
                       plr_node_number(node, "farDistance"), depths);
    return square_perspective(plr_node_number(node, "fieldOfView"), depths);
}

static plr_matrix parallel_view(const plr_view *view, const plr_node *node, plr_matrix *to_eye) {
    double box[4];
    *to_eye = place_viewpoint(view, node);
    extent e = scene_extent(view, to_eye);
    numbers_of(node, "fieldOfView", box, 4);
    if (!(box[2] > box[0]) || !(box[3] > box[1]))
        memcpy(box, (double[]){-1, -1, 1, 1}, sizeof box);
    double near = plr_node_number(node, "nearDistance");
    double far = plr_node_number(node, "farDistance");
    near = near > 0 ? near : e.least[2];
    far = far > near ? far : fmax(e.most[2], near + 1);
    return plr_matrix_orthographic(box, near, far);
}

static const struct {
    const char *type;
    plr_matrix (*project)(const plr_view *, const plr_node *, plr_matrix *to_eye);
} kinds[] = {{"DirectionalLight", directional},
             {"SpotLight", spot},
             {"PointLight", point},
             {"Viewpoint", perspective_view},
             {"OrthoViewpoint", parallel_view}};

bool plr_projector_matrices(const plr_view *view, const plr_node *projector, plr_matrix *projection,
                            plr_matrix *world_to_projector) {
    for (size_t i = 0; projector && i < sizeof kinds / sizeof *kinds; i++)
        if (plr_node_is(projector, kinds[i].type)) {
            *projection = kinds[i].project(view, projector, world_to_projector);
            return true;
        }
    *projection = *world_to_projector = plr_matrix_identity();
    return false;
}

plr_matrix plr_projector_clip(plr_view *view, const plr_node *projector) {
    uint64_t revision = plr_scene_revision(view->scene);
    const size_t most = sizeof view->projections / sizeof *view->projections;
    for (size_t i = 0; i < most; i++) {
        const plr_projection *kept = &view->projections[i];
        if (kept->projector == projector && kept->surfaces == view->surfaces &&
            kept->revision == revision)
            return kept->world_to_clip;
    }
    plr_matrix projection, to_eye;
    plr_projector_matrices(view, projector, &projection, &to_eye);
    plr_projection *kept = &view->projections[view->next_projection++ % most];
    *kept = (plr_projection){projector, view->surfaces, revision,
                             plr_matrix_multiply(&projection, &to_eye)};
    return kept->world_to_clip;
}
