#include "engine/view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/dialect.h"
#include "engine/shadows.h"
#include "engine/update.h"
#include "engine/volume.h"

/* ---- Data ---- */

static const plr_node *voxels_node(const plr_node *volume) {
    return plr_node_child(volume, "voxels");
}

/* Sizes, reference length and step; ISO/IEC 19775-1 41.2 and the project's numbers for voxels. */
static void measure(plr_view *view, plr_volume_state *state, const uint32_t size[3]) {
    float dimensions[3] = {1, 1, 1};
    plr_node_numbers(state->node, "dimensions", dimensions, 3);
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

/* One voxel in place of data that cannot be had. */
static plr_image placeholder(const plr_view *view) {
    plr_image image = {.width = 1, .height = 1, .depth = 1, .components = 1};
    image.samples = calloc(1, 1);
    if (!image.samples)
        longjmp(*view->arena.out_of_memory, 1);
    return image;
}

static bool read_voxels(plr_view *view, const plr_node *node, plr_image *image, plr_diags *diags) {
    const plr_node *voxels = voxels_node(node);
    if (!voxels)
        return false; /* a volume without voxels is empty space */
    float range[2] = {0, 0};
    plr_node_numbers(node, "valueRange", range, 2);
    plr_volume volume = {0};
    bool fine = plr_volume_from_node(view->scene, voxels, &volume, diags) &&
                plr_volume_to_image(&volume, (double[]){range[0], range[1]}, image);
    plr_volume_free(&volume);
    return fine;
}

/* The voxels of a volume that the view had before the scene changed, where they are still those. */
static const plr_kept_volume *find_kept(plr_view *view, const plr_node *node, uint64_t revision) {
    for (size_t i = 0; i < view->kept_volumes.count; i++) {
        plr_kept_volume *kept = &view->kept_volumes.items[i];
        if (kept->node != node)
            continue;
        if (kept->revision == revision)
            return kept;
        kept->voxels->kept = false;
        *kept = view->kept_volumes.items[--view->kept_volumes.count];
        return NULL;
    }
    return NULL;
}

static bool load_volume(plr_view *view, const plr_leaf *leaf, plr_volume_state *state,
                        plr_diags *diags) {
    enum {
        VOXELS_DEPTH = 2 /* of nodes that voxels are made of */
    };
    *state = (plr_volume_state){.node = leaf->node, .to_world = leaf->to_world};
    plr_matrix inverse;
    if (!plr_matrix_invert(&leaf->to_world, &inverse)) {
        plr_diags_add(diags, PLR_CODE_BAD_VOLUME, plr_node_place(leaf->node),
                      "the volume has no extent: its transformation is singular");
        return false;
    }
    const plr_node *voxels = voxels_node(leaf->node);
    uint64_t revision =
        plr_node_revision(leaf->node) + (voxels ? plr_deep_revision(voxels, VOXELS_DEPTH) : 0);
    const plr_kept_volume *kept = find_kept(view, leaf->node, revision);
    if (kept) {
        state->voxels = kept->voxels;
        measure(view, state, kept->size);
        return state->voxel > 0;
    }
    plr_image image = {0};
    if (!read_voxels(view, leaf->node, &image, diags)) {
        if (view->engine)
            return false;
        image = placeholder(view); /* the effects on it are checked all the same */
    }
    plr_kept_volume made = {leaf->node, revision, NULL, {image.width, image.height, image.depth}};
    measure(view, state, made.size);
    made.voxels = plr_textures_make(&view->textures, &image, PLR_TEXTURE_3D, true);
    made.voxels->kept = true;
    state->voxels = made.voxels;
    *PLR_PUSH(&view->lasting, &view->kept_volumes) = made;
    return state->voxel > 0;
}

double plr_volume_steepness(plr_view *view, const plr_volume_state *state) {
    plr_image again = {0};
    const plr_image *image = &state->voxels->image;
    if (!image->samples && read_voxels(view, state->node, &again, NULL))
        image = &again;
    double strong = image->samples ? plr_image_gradient_percentile(image, state->dimensions) : 0;
    plr_image_free(&again);
    return strong > 0 ? strong : 1;
}

/* ---- Styles ---- */

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
    bool has_function = plr_textures_in(list->view->kitchen.textures, node, "transferFunction");
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

/* ---- The program ---- */

static void add_volume(plr_view *view, plr_recipe *recipe, size_t index, const plr_scope *scope,
                       size_t *attached, plr_diags *diags) {
    const plr_volume_state *state = &view->volumes.volumes[index];
    const char *components = plr_arena_format(&view->arena, "%u", state->voxels->components);
    plr_define *extra = PLR_NEW_ARRAY(&view->arena, 1, plr_define);
    *extra = (plr_define){"voxels_COMPONENTS", components};
    *attached =
        plr_recipe_builtin(&view->kitchen, recipe, "volume/Volume", plr_node_type(state->node),
                           (plr_binding){.node = state->node,
                                         .to_world = state->to_world,
                                         .place = &state->to_world,
                                         .volume = index},
                           0, extra, 1);
    style_list list = {view, recipe, index, *attached, components, true, diags};
    add_styles(&list, plr_node_child(state->node, "renderStyle"));
    size_t from = recipe->effects.count;
    plr_pass_lights(view, recipe, scope, *attached, index);
    plr_recipe_shadows(view, recipe, from, index, NULL);
}

/* What a scene may say and is not drawn yet is not passed over in silence. */
static void warn_of_fields(const plr_node *volume, plr_diags *diags) {
    static const char *const later[] = {"cropMin", "cropMax", "clipPlanes", "fileGeometry",
                                        "writeDepth"};
    for (size_t i = 0; i < sizeof later / sizeof *later; i++) {
        const plr_field *field = plr_node_field(volume, later[i]);
        if (field && field->given)
            plr_diags_add(diags, PLR_CODE_NOT_DRAWN, field->place,
                          "the field '%s' has no effect on the picture yet", later[i]);
    }
}

/* Keeps the volumes that have data and an enabled style. */
static void find_usable(plr_view *view, plr_diags *diags) {
    plr_volume_pass *pass = &view->volumes;
    size_t leaf_count = view->flat.volumes.count;
    pass->volumes = PLR_NEW_ARRAY(&view->arena, leaf_count + 1, plr_volume_state);
    pass->leaves = PLR_NEW_ARRAY(&view->arena, leaf_count + 1, const plr_leaf *);
    for (size_t i = 0; i < leaf_count; i++) {
        const plr_leaf *leaf = &view->flat.volumes.items[i];
        warn_of_fields(leaf->node, diags);
        if (!any_enabled(plr_node_child(leaf->node, "renderStyle")) ||
            !load_volume(view, leaf, &pass->volumes[pass->count], diags))
            continue;
        pass->volumes[pass->count].index = pass->count;
        pass->leaves[pass->count++] = leaf;
    }
}

static bool scope_has(const plr_scope *scope, const plr_node *effect) {
    for (; scope; scope = scope->outer)
        for (size_t i = 0; i < scope->effects.count; i++)
            if (scope->effects.items[i] == effect)
                return true;
    return false;
}

/* The groups' effects: what is around all volumes of the cast is one effect on the whole, what is
 * around some is one on each of them. */
static void add_group_effects(plr_view *view, plr_cast *cast, const size_t *attached) {
    plr_recipe *recipe = &cast->pass.recipe;
    const plr_leaf *const *leaves = view->volumes.leaves;
    for (size_t i = 0; i < cast->count; i++)
        for (const plr_scope *scope = leaves[cast->members[i]]->scope; scope; scope = scope->outer)
            for (size_t e = 0; e < scope->effects.count; e++) {
                plr_node *effect = scope->effects.items[e];
                bool whole = true;
                for (size_t other = 0; other < cast->count; other++)
                    whole = whole && scope_has(leaves[cast->members[other]]->scope, effect);
                if (!whole)
                    plr_recipe_author(&view->kitchen, recipe, effect, attached[i],
                                      cast->members[i]);
                else if (i == 0)
                    plr_recipe_author(&view->kitchen, recipe, effect,
                                      cast->count == 1 ? attached[0] : 0,
                                      cast->count == 1 ? cast->members[0] : PLR_NO_EFFECT);
            }
}

static void build_recipe(plr_view *view, plr_cast *cast, bool early_end, plr_diags *diags) {
    plr_volume_pass *pass = &view->volumes;
    plr_recipe *recipe = &cast->pass.recipe;
    plr_kitchen *k = &view->kitchen;
    double cut[2];
    plr_viewpoint_cut(view->viewpoint, cut);
    *recipe = (plr_recipe){.base = *plr_catalog_units(k->catalog, "volume/raycaster")};
    plr_recipe_define(k, recipe, "VOLUME_COUNT", (int)cast->count);
    plr_recipe_define(k, recipe, "HAS_OPAQUE",
                      view->flat.shapes.count > 0 || view->desc.host_depths);
    plr_recipe_define(k, recipe, "EARLY_END", early_end);
    plr_recipe_define(k, recipe, "HAS_CUT", cut[0] > 0 || isfinite(cut[1]));
    plr_recipe_define(k, recipe, "CASTLE_GLSL_VERSION_UPGRADE", 1);
    size_t *attached = PLR_NEW_ARRAY(&view->arena, cast->count, size_t);
    for (size_t i = 0; i < cast->count; i++)
        add_volume(view, recipe, cast->members[i], pass->leaves[cast->members[i]]->scope,
                   &attached[i], diags);
    plr_recipe_builtin(k, recipe, "volume/Composite", "Composite",
                       (plr_binding){.volume = PLR_NO_EFFECT}, 0, NULL, 0);
    plr_recipe_attached_authors(&view->kitchen, recipe, "X3DLightNode");
    for (size_t i = 0; i < cast->count; i++)
        plr_recipe_author_list(k, recipe, pass->leaves[cast->members[i]]->node, attached[i],
                               cast->members[i]);
    add_group_effects(view, cast, attached);
}

/* What the effects of authors do to the ray as a whole, found by linking alone. */
typedef struct ray_use {
    bool accumulates; /* some author decides how: then no ray may end early */
    bool *layers;     /* by volume: an effect of its own composites */
} ray_use;

static void note_calls(const plr_program *program, size_t plug, const plr_recipe *recipe,
                       ray_use *use) {
    const plr_plug_info *info = plr_program_plug(program, plug);
    bool composite = strcmp(info->name, "volume_composite") == 0;
    if (!composite && strcmp(info->name, "volume_ray_end") != 0)
        return;
    for (size_t call = 0; call < info->call_count; call++) {
        plr_place place;
        size_t effect = plr_program_plug_call(program, plug, call, &place);
        if (effect == PLR_NO_EFFECT || recipe->effects.items[effect].builtin)
            continue;
        use->accumulates = true;
        size_t volume = recipe->bindings.items[effect].volume;
        if (composite && volume != PLR_NO_EFFECT)
            use->layers[volume] = true;
    }
}

static ray_use find_ray_use(plr_view *view, plr_cast *cast) {
    ray_use use = {.layers = PLR_NEW_ARRAY(&view->arena, view->volumes.count, bool)};
    plr_program *program = plr_link_recipe(&view->composer, &cast->pass.recipe, false, NULL);
    for (size_t i = 0; program && i < plr_program_plug_count(program); i++)
        note_calls(program, i, &cast->pass.recipe, &use);
    plr_program_destroy(&program);
    return use;
}

static void world_bounds(const plr_volume_state *state, double bounds[2][3]) {
    for (int axis = 0; axis < 3; axis++) {
        bounds[0][axis] = INFINITY;
        bounds[1][axis] = -INFINITY;
    }
    for (int corner = 0; corner < 8; corner++) {
        double point[3];
        for (int axis = 0; axis < 3; axis++)
            point[axis] = state->dimensions[axis] * ((corner >> axis & 1) - 0.5);
        plr_matrix_point(&state->to_world, point, point);
        for (int axis = 0; axis < 3; axis++) {
            bounds[0][axis] = fmin(bounds[0][axis], point[axis]);
            bounds[1][axis] = fmax(bounds[1][axis], point[axis]);
        }
    }
}

static bool overlaps_another(const plr_volume_pass *pass, size_t index) {
    double own[2][3], other[2][3];
    world_bounds(&pass->volumes[index], own);
    for (size_t i = 0; i < pass->count; i++) {
        bool apart = i == index;
        world_bounds(&pass->volumes[i], other);
        for (int axis = 0; axis < 3; axis++)
            apart = apart || own[1][axis] <= other[0][axis] || other[1][axis] <= own[0][axis];
        if (!apart)
            return true;
    }
    return false;
}

static plr_cast *add_cast(plr_view *view) {
    plr_cast *cast = &view->volumes.casts[view->volumes.cast_count++];
    cast->members = PLR_NEW_ARRAY(&view->arena, view->volumes.count, size_t);
    return cast;
}

/* Takes the volumes that are layers out of the first cast. */
static void split_layers(plr_view *view, const bool *layers, plr_diags *diags) {
    plr_volume_pass *pass = &view->volumes;
    plr_cast *together = &pass->casts[0];
    size_t kept = 0;
    for (size_t i = 0; i < pass->count; i++) {
        if (!layers[i]) {
            together->members[kept++] = i;
            continue;
        }
        plr_cast *own = add_cast(view);
        own->members[own->count++] = i;
        if (overlaps_another(pass, i))
            plr_diags_add(diags, PLR_CODE_LAYERED, plr_node_place(pass->volumes[i].node),
                          "an effect of this volume composites: it is a layer of its own, not "
                          "mixed with the volumes that it overlaps");
    }
    together->count = kept;
    if (!kept)
        *together = pass->casts[--pass->cast_count];
}

static size_t sampler_count(plr_view *view, const plr_cast *cast) {
    plr_program *program = plr_link_recipe(&view->composer, &cast->pass.recipe, false, NULL);
    size_t count = 0;
    for (size_t i = 0; program && i < plr_program_symbol_count(program); i++) {
        const plr_symbol *symbol = plr_program_symbol(program, i);
        if (symbol->kind == PLR_UNIFORM && strncmp(symbol->type, "sampler", 7) == 0)
            count += symbol->array ? symbol->array : 1;
    }
    plr_program_destroy(&program);
    return count;
}

/* Volumes whose textures do not fit into one program with the others are cast apart. */
static void split_by_textures(plr_view *view, plr_cast *cast, plr_diags *diags) {
    GLint most = 16; /* what GL 3.3 has at least */
    if (view->engine)
        view->engine->gl.GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &most);
    size_t samplers = sampler_count(view, cast);
    while (samplers > (size_t)most && cast->count > 1) {
        size_t kept = cast->count * (size_t)most / samplers;
        kept = kept < 1 ? 1 : kept < cast->count ? kept : cast->count - 1;
        plr_cast *rest = add_cast(view);
        memcpy(rest->members, cast->members + kept, (cast->count - kept) * sizeof *rest->members);
        rest->count = cast->count - kept;
        cast->count = kept;
        plr_diags_add(diags, PLR_CODE_LAYERED,
                      plr_node_place(view->volumes.volumes[rest->members[0]].node),
                      "%zu volumes have more textures than fit into one program: from here on they "
                      "are layers, not mixed with those before",
                      kept + rest->count);
        build_recipe(view, cast, true, NULL);
        samplers = sampler_count(view, cast);
    }
}

static void make_default_ramp(plr_view *view) {
    plr_image ramp = {.width = 2,
                      .height = 1,
                      .depth = 1,
                      .components = 4,
                      .type = PLR_FLOAT32,
                      .samples = calloc(8, sizeof(float))};
    if (!ramp.samples)
        longjmp(*view->arena.out_of_memory, 1);
    bool reversed = view->desc.dialect == PLR_DIALECT_2005;
    for (int i = 0; i < 8; i++) /* 0 is black and transparent, 1 white and opaque */
        ((float *)ramp.samples)[i] = (i % 4 == 3 && reversed) ? (float)(i < 4) : (float)(i >= 4);
    view->volumes.default_ramp = plr_textures_make(&view->textures, &ramp, PLR_TEXTURE_2D, false);
}

void plr_volume_pass_prepare(plr_view *view, plr_diags *diags) {
    plr_volume_pass *pass = &view->volumes;
    find_usable(view, diags);
    if (!pass->count)
        return;
    pass->casts = PLR_NEW_ARRAY(&view->arena, pass->count + 1, plr_cast);
    plr_cast *together = add_cast(view);
    for (size_t i = 0; i < pass->count; i++)
        together->members[together->count++] = i;
    build_recipe(view, together, true, NULL);
    ray_use use = find_ray_use(view, together);
    if (pass->count > 1)
        split_layers(view, use.layers, diags);
    for (size_t i = 0; i < pass->cast_count; i++) {
        plr_cast *cast = &pass->casts[i];
        build_recipe(view, cast, !use.accumulates, NULL);
        split_by_textures(view, cast, diags);
        build_recipe(view, cast, !use.accumulates, diags);
        cast->pass.built =
            plr_compose_program(&view->composer, &cast->pass.recipe, "volume", &cast->pass.program);
    }
    make_default_ramp(view);
    for (size_t i = 0; i < pass->count; i++)
        plr_volume_surroundings(view, pass->leaves[i]->scope, diags);
}

/* ---- Drawing ---- */

static int farther_first(const void *a, const void *b) {
    double x = ((const plr_cast *)a)->depth, y = ((const plr_cast *)b)->depth;
    return x < y ? 1 : x > y ? -1 : 0;
}

void plr_volume_depths(plr_view *view, const plr_frame *frame) {
    plr_volume_pass *pass = &view->volumes;
    for (size_t i = 0; i < pass->cast_count; i++) {
        plr_cast *cast = &pass->casts[i];
        cast->depth = INFINITY;
        for (size_t k = 0; k < cast->count; k++) {
            plr_matrix to_eye =
                plr_matrix_multiply(&frame->view, &pass->volumes[cast->members[k]].to_world);
            cast->depth = fmin(cast->depth, -to_eye.m[14]);
        }
    }
    if (pass->cast_count > 1)
        qsort(pass->casts, pass->cast_count, sizeof *pass->casts, farther_first);
}

void plr_cast_draw(plr_view *view, const plr_cast *cast, const plr_frame *frame) {
    const plr_volume_pass *pass = &view->volumes;
    if (!cast->pass.built)
        return;
    const plr_gl *gl = &view->engine->gl;
    gl->Disable(GL_DEPTH_TEST);
    gl->DepthMask(GL_FALSE);
    gl->Disable(GL_CULL_FACE);
    gl->Enable(GL_BLEND);
    gl->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl->UseProgram(cast->pass.built->name);
    plr_values values = {.frame = frame,
                         .to_world = pass->volumes[cast->members[0]].to_world,
                         .volumes = pass->volumes,
                         .volume_count = pass->count,
                         .default_ramp = pass->default_ramp};
    plr_bind_set(gl, &view->textures, &cast->pass.slots, &values);
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
    for (size_t v = 0; v < view->volumes.count; v++) {
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
