#include "engine/view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/dialect.h"
#include "engine/volume.h"

/* ---- Data
 * -------------------------------------------------------------------------------------------- */

static const plr_node *voxels_node(const plr_node *volume) {
    return plr_node_child(volume, "voxels");
}

/* Sizes, reference length and step; ISO/IEC 19775-1 41.2 and the project's numbers for voxels. */
static void measure(plr_view *view, plr_volume_state *state, const plr_image *image) {
    float dimensions[3] = {1, 1, 1};
    plr_node_numbers(state->node, "dimensions", dimensions, 3);
    const uint32_t size[3] = {image->width, image->height, image->depth};
    double cell = 1;
    for (int i = 0; i < 3; i++) {
        state->dimensions[i] = dimensions[i];
        cell *= state->dimensions[i] / size[i];
    }
    state->voxel = cbrt(cell);
    double unit = plr_node_number(state->node, "opacityUnitDistance");
    state->reference = unit > 0 ? unit : state->voxel;
    state->step = (view->desc.step > 0 ? view->desc.step : 0.5) * state->voxel;
    state->gradient_unit = plr_node_number(state->node, "gradientUnit");
}

static bool load_volume(plr_view *view, const plr_leaf *leaf, plr_volume_state *state,
                        plr_diags *diags) {
    *state = (plr_volume_state){.node = leaf->node, .to_world = leaf->to_world};
    plr_matrix inverse;
    if (!plr_matrix_invert(&leaf->to_world, &inverse)) {
        plr_diags_add(diags, PLR_CODE_BAD_VOLUME, plr_node_place(leaf->node),
                      "the volume has no extent: its transformation is singular");
        return false;
    }
    const plr_node *node = voxels_node(leaf->node);
    if (!node)
        return false; /* a volume without voxels is empty space */
    float range[2] = {0, 0};
    plr_node_numbers(leaf->node, "valueRange", range, 2);
    plr_volume volume = {0};
    plr_image image = {0};
    bool fine = plr_volume_from_node(view->scene, node, &volume, diags) &&
                plr_volume_to_image(&volume, (double[]){range[0], range[1]}, &image);
    plr_volume_free(&volume);
    if (!fine)
        return false;
    measure(view, state, &image);
    state->voxels = plr_textures_make(&view->textures, &image, 3, true);
    return state->voxel > 0;
}

/* ---- Styles
 * ------------------------------------------------------------------------------------------ */

typedef struct style_list {
    plr_view *view;
    plr_recipe *recipe;
    size_t volume, attached;
    const char *components;
    bool leading; /* only opacity maps so far */
    plr_diags *diags;
} style_list;

static void add_style(style_list *list, plr_node *node) {
    const char *type = node ? plr_node_type(node) : "OpacityMapVolumeStyle";
    list->leading = list->leading && strcmp(type, "OpacityMapVolumeStyle") == 0;
    plr_arena *arena = &list->view->arena;
    const plr_define defines[] = {{"LEADING", list->leading ? "1" : "0"},
                                  {"voxels_COMPONENTS", list->components},
                                  {"transferFunction_DIMENSIONS", "2"}};
    bool has_function = node && plr_node_child(node, "transferFunction");
    plr_define *extra = PLR_NEW_ARRAY(arena, 3, plr_define);
    memcpy(extra, defines, sizeof defines);
    size_t done = plr_recipe_builtin(&list->view->kitchen, list->recipe,
                                     plr_arena_format(arena, "volume/%s", type), type,
                                     (plr_binding){.node = node, .volume = list->volume},
                                     list->attached, extra, has_function ? 2 : 3);
    if (!done)
        plr_diags_add(list->diags, PLR_CODE_NOT_DRAWN, plr_node_place(node),
                      "%s is not drawn yet; the style is skipped", type);
}

static void add_styles(style_list *list, plr_node *node) {
    if (node && !plr_node_bool(node, "enabled"))
        return;
    if (node && plr_node_is(node, "ComposedVolumeStyle")) {
        const plr_field *styles = plr_node_field(node, "renderStyle");
        for (size_t i = 0; styles && i < styles->count; i++)
            if (styles->value.nodes[i])
                add_styles(list, styles->value.nodes[i]);
        return;
    }
    add_style(list, node);
}

/* A volume whose styles are all disabled draws nothing. */
static bool any_enabled(const plr_node *node) {
    if (!node)
        return true;
    if (!plr_node_bool(node, "enabled"))
        return false;
    if (!plr_node_is(node, "ComposedVolumeStyle"))
        return true;
    const plr_field *styles = plr_node_field(node, "renderStyle");
    for (size_t i = 0; styles && i < styles->count; i++)
        if (styles->value.nodes[i] && any_enabled(styles->value.nodes[i]))
            return true;
    return !styles || !styles->count;
}

/* ---- The program
 * ------------------------------------------------------------------------------------- */

static void add_volume(plr_view *view, plr_recipe *recipe, size_t index, const plr_scope *scope,
                       size_t *attached, plr_diags *diags) {
    const plr_volume_state *state = &view->volumes.volumes[index];
    const char *components = plr_arena_format(&view->arena, "%u", state->voxels->components);
    plr_define *extra = PLR_NEW_ARRAY(&view->arena, 1, plr_define);
    *extra = (plr_define){"voxels_COMPONENTS", components};
    *attached = plr_recipe_builtin(
        &view->kitchen, recipe, "volume/Volume", plr_node_type(state->node),
        (plr_binding){.node = state->node, .to_world = state->to_world, .volume = index}, 0, extra,
        1);
    style_list list = {view, recipe, index, *attached, components, true, diags};
    add_styles(&list, plr_node_child(state->node, "renderStyle"));
    plr_pass_lights(view, recipe, scope, *attached, index);
}

/* Keeps the volumes that have data and an enabled style. */
static const plr_leaf **usable(plr_view *view, plr_diags *diags) {
    plr_volume_pass *pass = &view->volumes;
    size_t leaf_count = view->flat.volumes.count;
    pass->volumes = PLR_NEW_ARRAY(&view->arena, leaf_count + 1, plr_volume_state);
    const plr_leaf **leaves = PLR_NEW_ARRAY(&view->arena, leaf_count + 1, const plr_leaf *);
    for (size_t i = 0; i < leaf_count; i++) {
        const plr_leaf *leaf = &view->flat.volumes.items[i];
        if (!any_enabled(plr_node_child(leaf->node, "renderStyle")) ||
            !load_volume(view, leaf, &pass->volumes[pass->count], diags))
            continue;
        pass->volumes[pass->count].index = pass->count;
        leaves[pass->count++] = leaf;
    }
    return leaves;
}

/* Whether an effect of an author's decides how the ray accumulates: then no ray may end early. */
static bool author_composites(const plr_pass *pass) {
    for (size_t i = 0; i < plr_program_plug_count(pass->program); i++) {
        const plr_plug_info *plug = plr_program_plug(pass->program, i);
        if (strcmp(plug->name, "volume_composite") != 0 &&
            strcmp(plug->name, "volume_ray_end") != 0)
            continue;
        for (size_t call = 0; call < plug->call_count; call++) {
            plr_place place;
            size_t effect = plr_program_plug_call(pass->program, i, call, &place);
            if (effect != PLR_NO_EFFECT && !pass->recipe.effects.items[effect].builtin)
                return true;
        }
    }
    return false;
}

static void build_recipe(plr_view *view, const plr_leaf **leaves, bool early_end,
                         plr_diags *diags) {
    plr_volume_pass *pass = &view->volumes;
    plr_recipe *recipe = &pass->pass.recipe;
    plr_kitchen *k = &view->kitchen;
    *recipe = (plr_recipe){.base = *plr_catalog_units(k->catalog, "volume/raycaster")};
    plr_recipe_define(k, recipe, "VOLUME_COUNT", (int)pass->count);
    plr_recipe_define(k, recipe, "HAS_OPAQUE",
                      view->flat.shapes.count > 0 || view->desc.host_depths);
    plr_recipe_define(k, recipe, "EARLY_END", early_end);
    double cut[2];
    plr_viewpoint_cut(view->viewpoint, cut);
    plr_recipe_define(k, recipe, "HAS_CUT", cut[0] > 0 || isfinite(cut[1]));
    plr_recipe_define(k, recipe, "CASTLE_GLSL_VERSION_UPGRADE", 1);
    size_t *attached = PLR_NEW_ARRAY(&view->arena, pass->count, size_t);
    for (size_t i = 0; i < pass->count; i++)
        add_volume(view, recipe, i, leaves[i]->scope, &attached[i], diags);
    plr_recipe_builtin(k, recipe, "volume/Composite", "Composite",
                       (plr_binding){.volume = PLR_NO_EFFECT}, 0, NULL, 0);
    plr_pass_light_authors(view, recipe);
    for (size_t i = 0; i < pass->count; i++)
        plr_recipe_author_list(k, recipe, leaves[i]->node, attached[i], i);
    for (size_t i = 0; i < pass->count; i++)
        plr_recipe_groups(k, recipe, leaves[i]->scope, attached[i], i);
}

void plr_volume_pass_prepare(plr_view *view, plr_diags *diags) {
    plr_volume_pass *pass = &view->volumes;
    const plr_leaf **leaves = usable(view, diags);
    if (!pass->count)
        return;
    for (int early_end = 1; early_end >= 0; early_end--) {
        build_recipe(view, leaves, early_end, diags);
        pass->pass.built =
            plr_compose_program(&view->composer, &pass->pass.recipe, "volume", &pass->pass.program);
        if (!pass->pass.built || !author_composites(&pass->pass))
            break;
    }
    plr_image ramp = {2, 1, 1, 4, PLR_FLOAT32, calloc(8, sizeof(float))};
    if (!ramp.samples)
        longjmp(*view->arena.out_of_memory, 1);
    bool reversed = view->desc.dialect == PLR_DIALECT_2005;
    for (int i = 0; i < 8;
         i++) /* the default ramp: 0 is black and transparent, 1 white and opaque */
        ((float *)ramp.samples)[i] = (i % 4 == 3 && reversed) ? (float)(i < 4) : (float)(i >= 4);
    pass->default_ramp = plr_textures_make(&view->textures, &ramp, 2, false);
}

/* ---- Drawing
 * ------------------------------------------------------------------------------------------ */

void plr_volume_pass_draw(plr_view *view, const plr_frame *frame) {
    const plr_volume_pass *pass = &view->volumes;
    if (!pass->pass.built)
        return;
    const plr_gl *gl = &view->engine->gl;
    gl->Disable(GL_DEPTH_TEST);
    gl->DepthMask(GL_FALSE);
    gl->Disable(GL_CULL_FACE);
    gl->Enable(GL_BLEND);
    gl->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl->UseProgram(pass->pass.built->name);
    plr_values values = {.frame = frame,
                         .to_world = pass->volumes[0].to_world,
                         .volumes = pass->volumes,
                         .volume_count = pass->count,
                         .default_ramp = pass->default_ramp};
    plr_bind_set(gl, &view->textures, &pass->pass.slots, &values);
    gl->BindVertexArray(view->empty_vertex_array);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

/* Length of the ray o + t d (t >= 0) inside a box centred at the origin, in units of t. */
static double chord(const double o[3], const double d[3], const double size[3]) {
    double enter = 0, leave = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double half = size[axis] / 2;
        if (d[axis] == 0) {
            if (!(fabs(o[axis]) <= half))
                return 0;
            continue;
        }
        double a = (-half - o[axis]) / d[axis], b = (half - o[axis]) / d[axis];
        enter = fmax(enter, fmin(a, b));
        leave = fmin(leave, fmax(a, b));
    }
    return leave > enter ? leave - enter : 0;
}

double plr_volume_pass_samples(const plr_view *view, const plr_frame *frame) {
    double samples = 0;
    int width = (int)frame->viewport[2], height = (int)frame->viewport[3];
    plr_matrix unproject;
    plr_matrix_invert(&frame->projection, &unproject);
    for (size_t v = 0; v < view->volumes.count && view->volumes.pass.built; v++) {
        const plr_volume_state *state = &view->volumes.volumes[v];
        plr_matrix to_eye = plr_matrix_multiply(&frame->view, &state->to_world), to_local;
        plr_matrix_invert(&to_eye, &to_local);
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                double ndc[2] = {(x + 0.5) / width * 2 - 1, (y + 0.5) / height * 2 - 1};
                double near[3] = {ndc[0], ndc[1], -1}, far[3] = {ndc[0], ndc[1], 1}, d[3];
                plr_matrix_point(&unproject, near, near);
                plr_matrix_point(&unproject, far, far);
                bool parallel = frame->projection.m[15] != 0;
                double eye[3] = {parallel ? near[0] : 0, parallel ? near[1] : 0, 0};
                plr_matrix_point(&to_local, eye, eye);
                plr_matrix_point(&to_local, far, far);
                double length = 0;
                for (int i = 0; i < 3; i++) {
                    d[i] = far[i] - eye[i];
                    length += d[i] * d[i];
                }
                samples += ceil(chord(eye, d, state->dimensions) * sqrt(length) / state->step);
            }
    }
    return samples;
}
