/* Values of uniforms that the engine knows by name. */
#include <math.h>
#include <string.h>

#include "engine/bind_internal.h"
#include "engine/brightness.h"
#include "engine/light_values.h"
#include "engine/projector.h"
#include "engine/transfer_atlas.h"
#include "engine/volume_blocks.h"
#include "engine/volume_table.h"

static plr_matrix model_view(const plr_known_context *c) {
    return plr_matrix_multiply(&c->values->frame->view, &c->values->to_world);
}

static void put(const plr_matrix *m, float *out) {
    plr_matrix_to_floats(m, out);
}

static void put_inverse(const plr_matrix *m, float *out) {
    plr_matrix inverse;
    plr_matrix_invert(m, &inverse);
    put(&inverse, out);
}

static void v_model_view(const plr_known_context *c, float *out) {
    plr_matrix m = model_view(c);
    put(&m, out);
}
static void v_inverse_model_view(const plr_known_context *c, float *out) {
    plr_matrix m = model_view(c);
    put_inverse(&m, out);
}
static void v_normal(const plr_known_context *c, float *out) {
    plr_matrix m = model_view(c);
    plr_matrix_to_normal_floats(&m, out);
}
static void v_projection(const plr_known_context *c, float *out) {
    put(&c->values->frame->projection, out);
}
static void v_inverse_projection(const plr_known_context *c, float *out) {
    put_inverse(&c->values->frame->projection, out);
}
static void v_view(const plr_known_context *c, float *out) {
    put(&c->values->frame->view, out);
}
static void v_inverse_view(const plr_known_context *c, float *out) {
    put_inverse(&c->values->frame->view, out);
}
static void v_model(const plr_known_context *c, float *out) {
    put(&c->values->to_world, out);
}
static void v_inverse_model(const plr_known_context *c, float *out) {
    put_inverse(&c->values->to_world, out);
}
static void v_viewport(const plr_known_context *c, float *out) {
    for (int i = 0; i < 4; i++)
        out[i] = (float)c->values->frame->viewport[i];
}
static void v_viewport_size(const plr_known_context *c, float *out) {
    out[0] = (float)c->values->frame->viewport[2];
    out[1] = (float)c->values->frame->viewport[3];
}
static void v_cut(const plr_known_context *c, float *out) {
    out[0] = (float)c->values->frame->cut[0];
    out[1] = (float)fmin(c->values->frame->cut[1], 3e38);
}
static void v_depth_to_clip(const plr_known_context *c, float *out) {
    out[0] = c->values->frame->reversed_depth ? 1 : 2;
    out[1] = c->values->frame->reversed_depth ? 0 : -1;
}
static void v_empty_depth(const plr_known_context *c, float *out) {
    out[0] = c->values->frame->reversed_depth ? 0 : 1;
}
static void v_has_part_start(const plr_known_context *c, float *out) {
    out[0] = c->values->frame->part_start != 0;
}
static void v_time(const plr_known_context *c, float *out) {
    out[0] = (float)c->values->frame->time;
}
/* A ray ends where what is left is below an eighth of the error that is asked for; if none is, of
 * an 8-bit step. */
static void v_transparency_left(const plr_known_context *c, float *out) {
    const double least = 1.0 / (1 << 25); /* 1 - alpha of floats is 0, or more than that */
    double error = c->values->view->desc.error;
    double left = (error > 0 ? error : 1.0 / 255) / 8 / plr_view_brightest(c->values->view);
    out[0] = (float)fmax(left, least);
}
static void v_error_allowed(const plr_known_context *c, float *out) {
    out[0] = (float)c->values->error;
}
static void v_node_to_eye(const plr_known_context *c, float *out) {
    plr_matrix m = c->binding->to_world;
    if (!c->binding->in_eye_space)
        m = plr_matrix_multiply(&c->values->frame->view, &m);
    put(&m, out);
}
static void v_light_direction(const plr_known_context *c, float *out) {
    plr_light_direction(c->binding, &c->values->frame->view, out);
}
static void v_light_location(const plr_known_context *c, float *out) {
    plr_light_location(c->binding, &c->values->frame->view, out);
}
static void v_gate(const plr_known_context *c, float *out) {
    out[0] = !c->binding->closed;
}
/* From lengths in eye space to the node's own; of a node that is scaled otherwise along each axis,
 * their geometric mean. */
static void v_length_to_node(const plr_known_context *c, float *out) {
    double scale = cbrt(fabs(plr_matrix_determinant3(&c->binding->to_world)));
    out[0] = scale > 0 ? (float)(1 / scale) : 0;
}
static void v_eye_to_node(const plr_known_context *c, float *out) {
    plr_matrix m = c->binding->to_world;
    if (!c->binding->in_eye_space)
        m = plr_matrix_multiply(&c->values->frame->view, &m);
    put_inverse(&m, out);
}
static void v_eye_to_local(const plr_known_context *c, float *out) {
    plr_matrix m = plr_matrix_multiply(&c->values->frame->view, &c->volume->to_world);
    put_inverse(&m, out);
}
static void v_local_start(const plr_known_context *c, float *out) {
    plr_matrix m = plr_matrix_multiply(&c->values->frame->view, &c->volume->to_world), to_local;
    plr_matrix_invert(&m, &to_local);
    double place[3] = {0, 0, -c->values->ray_plane};
    plr_matrix_point(&to_local, place, place);
    for (int i = 0; i < 3; i++)
        out[i] = (float)place[i];
}
static void v_ray_plane(const plr_known_context *c, float *out) {
    out[0] = (float)c->values->ray_plane;
}
static void v_dimensions(const plr_known_context *c, float *out) {
    for (int i = 0; i < 3; i++)
        out[i] = (float)c->volume->dimensions[i];
}
static void v_step(const plr_known_context *c, float *out) {
    out[0] = (float)c->volume->step;
}
static void v_reference(const plr_known_context *c, float *out) {
    out[0] = (float)c->volume->reference;
}
static void v_gradient_unit(const plr_known_context *c, float *out) {
    out[0] = (float)c->binding->grid->gradient_unit;
}
/* A unit that the scene gives clamps nothing. */
static void v_gradient_most(const plr_known_context *c, float *out) {
    out[0] = plr_node_number(c->volume->node, "gradientUnit") > 0 ? 3e38f : 1;
}
static void put_vector(const double *from, float *out) {
    for (int i = 0; i < 3; i++)
        out[i] = (float)from[i];
}
static void v_voxel_count(const plr_known_context *c, float *out) {
    for (int i = 0; i < 3; i++)
        out[i] = (float)c->binding->grid->size[i];
}
static void v_brick_low(const plr_known_context *c, float *out) {
    put_vector(c->binding->grid->brick_box[0], out);
}
static void v_brick_high(const plr_known_context *c, float *out) {
    put_vector(c->binding->grid->brick_box[1], out);
}
static void v_brick_scale(const plr_known_context *c, float *out) {
    put_vector(c->binding->grid->brick_scale, out);
}
static void v_brick_shift(const plr_known_context *c, float *out) {
    put_vector(c->binding->grid->brick_shift, out);
}
static void v_surface_count(const plr_known_context *c, float *out) {
    out[0] = (float)c->volume->surface_count;
}
static void v_map_count(const plr_known_context *c, float *out) {
    out[0] = (float)c->volume->map_count;
}
static void v_transfer_place(const plr_known_context *c, float *out) {
    memcpy(out, c->binding->function->rect, sizeof c->binding->function->rect);
}
static void v_visible_values(const plr_known_context *c, float *out) {
    memcpy(out, c->binding->function->visible, sizeof c->binding->function->visible);
}
static void v_wall_values(const plr_known_context *c, float *out) {
    memcpy(out, c->volume->table->wall, sizeof c->volume->table->wall);
}
static void v_wall_colors(const plr_known_context *c, float *out) {
    memcpy(out, c->volume->table->wall_colors, sizeof c->volume->table->wall_colors);
}
static void v_block_cells(const plr_known_context *c, float *out) {
    out[0] = (float)c->volume->blocks->cells;
}
static void v_seen_values(const plr_known_context *c, float *out) {
    memcpy(out, c->volume->seen, sizeof c->volume->seen);
}
static void v_join_reach(const plr_known_context *c, float *out) {
    const plr_volume_state *v = c->volume;
    plr_table_reach(v->table, v->step / v->reference, v->step / v->voxel, out);
}
static void v_choice_number(const plr_known_context *c, float *out) {
    out[0] = (float)c->binding->number;
}

static void v_voxel_length(const plr_known_context *c, float *out) {
    out[0] = (float)c->volume->voxel;
}

static double distance(const double a[3], const double b[3]) {
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

/* How far the viewer is from the volume's middle, to how far he was where he first stood. */
static void v_approach(const plr_known_context *c, float *out) {
    plr_matrix eye;
    plr_matrix_invert(&c->values->frame->view, &eye);
    const double *middle = c->volume->to_world.m + 12;
    double first = distance(c->values->view->first.to_world.m + 12, middle);
    out[0] = first > 0 ? (float)(distance(eye.m + 12, middle) / first) : 1;
}

static void v_volume_index(const plr_known_context *c, float *out) {
    out[0] = (float)c->volume->index;
}

static void v_eye_to_shadow(const plr_known_context *c, float *out) {
    plr_matrix to_world;
    plr_matrix_invert(&c->values->frame->view, &to_world);
    plr_matrix m = plr_matrix_multiply(&c->binding->shadow->from_world, &to_world);
    put(&m, out);
}
static void v_shadow_axis(const plr_known_context *c, float *out) {
    const double *axis = c->binding->shadow->axis, *m = c->values->frame->view.m;
    for (int row = 0; row < 3; row++)
        out[row] = (float)(m[row] * axis[0] + m[4 + row] * axis[1] + m[8 + row] * axis[2]);
}
static void v_shadow_texel(const plr_known_context *c, float *out) {
    out[0] = (float)c->binding->shadow->texel;
}
static void v_shadow_depths(const plr_known_context *c, float *out) {
    out[0] = (float)c->binding->shadow->depths[0];
    out[1] = (float)c->binding->shadow->depths[1];
}
static void v_shadow_offset(const plr_known_context *c, float *out) {
    out[0] = (float)c->binding->shadow->offset;
}
static void v_shadow_depth_bias(const plr_known_context *c, float *out) {
    out[0] = (float)c->binding->shadow->depth_bias;
}

/* From eye space to the projector's clip space, from 0 to 1 in s, t and r. */
static void v_eye_to_projector(const plr_known_context *c, float *out) {
    const plr_node *node = c->binding->node;
    const plr_node *projector = node ? plr_node_child(node, "projector") : NULL;
    plr_matrix from_world = plr_projector_clip(c->values->view, projector), to_world;
    plr_matrix scale = plr_matrix_scale(0.5, 0.5, 0.5);
    plr_matrix product = plr_matrix_translation(0.5, 0.5, 0.5);
    plr_matrix_invert(&c->values->frame->view, &to_world);
    const plr_matrix *steps[] = {&scale, &from_world, &to_world};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        product = plr_matrix_multiply(&product, steps[i]);
    put(&product, out);
}

static const plr_known known[] = {
    {"castle_ModelViewMatrix", OWNER_HOST, v_model_view},
    {"castle_ProjectionMatrix", OWNER_HOST, v_projection},
    {"castle_NormalMatrix", OWNER_HOST, v_normal},
    {"plugray_ModelMatrix", OWNER_HOST, v_model},
    {"plugray_InverseModelMatrix", OWNER_HOST, v_inverse_model},
    {"plugray_ViewMatrix", OWNER_HOST, v_view},
    {"plugray_InverseViewMatrix", OWNER_HOST, v_inverse_view},
    {"plugray_ModelViewMatrix", OWNER_HOST, v_model_view},
    {"plugray_InverseModelViewMatrix", OWNER_HOST, v_inverse_model_view},
    {"plugray_ProjectionMatrix", OWNER_HOST, v_projection},
    {"plugray_InverseProjectionMatrix", OWNER_HOST, v_inverse_projection},
    {"plugray_NormalMatrix", OWNER_HOST, v_normal},
    {"plugray_ViewportSize", OWNER_HOST, v_viewport_size},
    {"plugray_Time", OWNER_HOST, v_time},
    {"viewport", OWNER_HOST, v_viewport},
    {"viewpointCut", OWNER_HOST, v_cut},
    {"rayPlane", OWNER_HOST, v_ray_plane},
    {"depthToClip", OWNER_HOST, v_depth_to_clip},
    {"emptyDepth", OWNER_HOST, v_empty_depth},
    {"hasPartStart", OWNER_HOST, v_has_part_start},
    {"transparencyLeft", OWNER_HOST, v_transparency_left},
    {"errorAllowed", OWNER_HOST, v_error_allowed},
    {"nodeToEye", OWNER_NODE, v_node_to_eye},
    {"eyeToProjector", OWNER_NODE, v_eye_to_projector},
    {"eyeToNode", OWNER_NODE, v_eye_to_node},
    {"lengthToNode", OWNER_NODE, v_length_to_node},
    {"gate", OWNER_NODE, v_gate},
    {"light_direction_eye", OWNER_NODE, v_light_direction},
    {"light_location_eye", OWNER_NODE, v_light_location},
    {"eyeToLocal", OWNER_VOLUME, v_eye_to_local},
    {"localStart", OWNER_VOLUME, v_local_start},
    {"dimensions", OWNER_VOLUME, v_dimensions},
    {"sampleDistance", OWNER_VOLUME, v_step},
    {"referenceLength", OWNER_VOLUME, v_reference},
    {"gradientUnit", OWNER_GRID, v_gradient_unit},
    {"gradientMost", OWNER_VOLUME, v_gradient_most},
    {"voxelCount", OWNER_GRID, v_voxel_count},
    {"brickLow", OWNER_GRID, v_brick_low},
    {"brickHigh", OWNER_GRID, v_brick_high},
    {"brickScale", OWNER_GRID, v_brick_scale},
    {"brickShift", OWNER_GRID, v_brick_shift},
    {"surfaceCount", OWNER_VOLUME, v_surface_count},
    {"choiceNumber", OWNER_VOLUME, v_choice_number},
    {"segmentMapCount", OWNER_VOLUME, v_map_count},
    {"transferPlace", OWNER_FUNCTION, v_transfer_place},
    {"wallValues", OWNER_VOLUME, v_wall_values},
    {"wallColors", OWNER_VOLUME, v_wall_colors},
    {"blockCells", OWNER_VOLUME, v_block_cells},
    {"seenValues", OWNER_VOLUME, v_seen_values},
    {"joinReach", OWNER_VOLUME, v_join_reach},
    {"visibleValues", OWNER_FUNCTION, v_visible_values},
    {"voxelLength", OWNER_VOLUME, v_voxel_length},
    {"approach", OWNER_VOLUME, v_approach},
    {"volumeIndex", OWNER_VOLUME, v_volume_index},
    {"eyeToShadow", OWNER_SHADOW, v_eye_to_shadow},
    {"shadowAxis", OWNER_SHADOW, v_shadow_axis},
    {"shadowTexel", OWNER_SHADOW, v_shadow_texel},
    {"shadowDepths", OWNER_SHADOW, v_shadow_depths},
    {"shadowOffset", OWNER_SHADOW, v_shadow_offset},
    {"shadowDepthBias", OWNER_SHADOW, v_shadow_depth_bias},
};

const plr_known *plr_known_find(const char *name, const plr_binding *binding) {
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        bool fits = known[i].owner == OWNER_HOST       ? !binding
                    : known[i].owner == OWNER_NODE     ? binding != NULL
                    : known[i].owner == OWNER_SHADOW   ? binding && binding->shadow
                    : known[i].owner == OWNER_FUNCTION ? binding && binding->function
                    : known[i].owner == OWNER_GRID     ? binding && binding->grid
                                                   : binding && binding->volume != PLR_NO_EFFECT;
        if (fits && strcmp(known[i].name, name) == 0)
            return &known[i];
    }
    return NULL;
}
