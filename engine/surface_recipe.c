/* From a shape to its program: the base, the built-in effects, the authors' effects. */
#include "engine/shadows.h"
#include "engine/surface.h"

#include <string.h>

size_t plr_shape_effect(plr_shape *shape, const char *path, const char *name, plr_node *node,
                        size_t attached, const plr_define *extra, size_t extra_count) {
    plr_binding binding = {
        .node = node, .to_world = plr_matrix_identity(), .volume = PLR_NO_EFFECT};
    return plr_recipe_builtin(&shape->view->kitchen, shape->recipe, path, name, binding, attached,
                              extra, extra_count);
}

plr_define plr_shape_define(plr_shape *shape, const char *name, int value) {
    return (plr_define){name, plr_arena_format(&shape->view->arena, "%d", value)};
}

void plr_shape_lights(plr_shape *shape) {
    if (!shape->lit)
        return;
    size_t from = shape->recipe->effects.count;
    shape->recipe->sees_lights = plr_authors_reach(shape->appearance, shape->leaf->scope);
    plr_pass_lights(shape->view, shape->recipe, shape->leaf->scope, 0, PLR_NO_EFFECT);
    plr_recipe_receive(shape->view, shape->recipe, from);
    plr_recipe_shadows(shape->view, shape->recipe, from, PLR_NO_EFFECT, shape->appearance);
    plr_recipe_volume_shadows(shape->view, shape->recipe, false);
}

static void define_surface(plr_shape *shape) {
    const plr_model *model = shape->model;
    const plr_node *colors = shape->geometry ? plr_node_child(shape->geometry, "color") : NULL;
    bool modulate = colors && strcmp(plr_node_string(colors, "mode"), "MODULATE") == 0;
    const struct {
        const char *name;
        int value;
    } defines[] = {{"CASTLE_GLSL_VERSION_UPGRADE", 1},
                   {"HAS_COLORS", model->mesh.colors != NULL},
                   {"COLORS_MODULATE", model->mesh.colors && modulate},
                   {"HAS_NORMALS", model->mesh.normals != NULL},
                   {"TWO_SIDED", model->mesh.two_sided},
                   {"OPAQUE", !model->blends},
                   {"PROJECTIVE", shape->view->flat.projective}};
    static const char *const primitives[] = {[PLR_MESH_TRIANGLES] = "triangles",
                                             [PLR_MESH_LINES] = "lines",
                                             [PLR_MESH_POINTS] = "points"};
    for (size_t i = 0; i < sizeof defines / sizeof *defines; i++)
        plr_recipe_define(&shape->view->kitchen, shape->recipe, defines[i].name, defines[i].value);
    if (model->mesh.index_count)
        shape->recipe->primitive = primitives[model->mesh.kind];
}

/* Most local first: of lights, of textures, of the shape, of the groups from inner to outer. */
static void add_authors(plr_shape *shape) {
    plr_kitchen *k = &shape->view->kitchen;
    plr_recipe_attached_authors(k, shape->recipe, "X3DLightNode");
    plr_recipe_attached_authors(k, shape->recipe, "X3DTextureNode");
    if (shape->appearance)
        plr_recipe_author_list(k, shape->recipe, shape->appearance, 0, PLR_NO_EFFECT);
    plr_recipe_groups(k, shape->recipe, shape->leaf->scope, 0, PLR_NO_EFFECT);
}

static void compose(plr_shape *shape) {
    plr_pass *pass = &shape->model->pass;
    add_authors(shape);
    pass->built =
        plr_compose_program(&shape->view->composer, &pass->recipe, "surface", &pass->program);
}

static void compose_standard(plr_shape *shape) {
    static void (*const ingredients[])(plr_shape *) = {
        plr_shape_material, plr_shape_textures,   plr_shape_lights, /* then: what scales light */
        plr_shape_bumps,    plr_shape_properties, plr_shape_surroundings};
    *shape->recipe =
        (plr_recipe){.base = *plr_catalog_units(shape->view->kitchen.catalog, "surface/surface")};
    define_surface(shape);
    shape->channel_count = 0;
    for (size_t i = 0; i < sizeof ingredients / sizeof *ingredients; i++)
        ingredients[i](shape);
    compose(shape);
}

/* The first of the author's complete shaders that works (ISO/IEC 19775-1 V4 31.2.2.3); its own
 * fields are bound as those of an effect are. */
static bool compose_shader(plr_shape *shape) {
    const plr_field *shaders =
        shape->appearance ? plr_node_field(shape->appearance, "shaders") : NULL;
    for (size_t i = 0; shaders && i < shaders->count; i++) {
        plr_node *shader = shaders->value.nodes[i];
        shape->model->pass = (plr_pass){0};
        if (!shader || !plr_node_is(shader, "ComposedShader") ||
            !plr_recipe_shader_base(&shape->view->kitchen, shape->recipe, shader))
            continue;
        shape->recipe->base_node = shader;
        define_surface(shape);
        shape->channel_count = 0;
        plr_shape_complete_textures(shape);
        plr_shape_complete_surroundings(shape);
        compose(shape);
        if (shape->model->pass.built)
            return true;
    }
    return false;
}

static void prepare_model(plr_view *view, plr_model *model, const plr_leaf *leaf,
                          plr_diags *diags) {
    plr_shape shape = {.view = view,
                       .model = model,
                       .leaf = leaf,
                       .appearance = plr_node_child(leaf->node, "appearance"),
                       .geometry = plr_node_child(leaf->node, "geometry"),
                       .recipe = &model->pass.recipe,
                       .diags = diags};
    bool built = plr_mesh_build(shape.geometry, &model->mesh, diags);
    if (!built && view->engine)
        return; /* else the effects on it are checked all the same */
    shape.lit = model->mesh.normals != NULL;
    shape.alpha = plr_shape_alpha(&shape);
    model->blends = shape.alpha == PLR_ALPHA_BLENDING;
    plr_surface_state_read(&shape, &model->state);
    if (!compose_shader(&shape))
        compose_standard(&shape);
}

/* ---- Models and the places where they stand ---- */

static bool is_empty(const plr_scope *scope) {
    return !scope->lights.count && !scope->effects.count && !scope->fog.node &&
           !scope->clip_planes.count;
}

/* Models by shape and scope: open addressing, at most half full. */
typedef struct model_table {
    plr_model **slots;
    size_t mask;
} model_table;

static plr_model **find_slot(const model_table *table, const plr_node *node,
                             const plr_scope *scope) {
    uint64_t hash = (uint64_t)(uintptr_t)node * 0x9e3779b97f4a7c15u;
    hash = (hash ^ (uint64_t)(uintptr_t)scope) * 0x9e3779b97f4a7c15u;
    size_t at = (size_t)(hash >> 32) & table->mask;
    while (table->slots[at] && (table->slots[at]->node != node || table->slots[at]->scope != scope))
        at = (at + 1) & table->mask;
    return &table->slots[at];
}

static plr_model *model_of(plr_view *view, model_table *table, const plr_leaf *leaf,
                           plr_diags *diags) {
    const plr_scope *scope = leaf->scope;
    while (scope->outer && is_empty(scope))
        scope = scope->outer;
    plr_model **slot = find_slot(table, leaf->node, scope);
    if (!*slot) {
        *slot = PLR_NEW(&view->arena, plr_model);
        (*slot)->node = leaf->node;
        (*slot)->scope = scope;
        view->models[view->model_count++] = *slot; /* before: its mesh is freed whatever happens */
        prepare_model(view, *slot, leaf, diags);
    }
    return *slot;
}

void plr_surfaces_prepare(plr_view *view, plr_diags *diags) {
    size_t count = view->flat.shapes.count, size = 16;
    while (size < 2 * count)
        size *= 2;
    model_table table = {PLR_NEW_ARRAY(&view->arena, size, plr_model *), size - 1};
    view->models = PLR_NEW_ARRAY(&view->arena, count + 1, plr_model *);
    view->surfaces = PLR_NEW_ARRAY(&view->arena, count + 1, plr_surface);
    view->blending = PLR_NEW_ARRAY(&view->arena, count + 1, plr_surface *);
    view->blends = PLR_NEW_ARRAY(&view->arena, 2 * count + 1, plr_blend);
    for (size_t i = 0; i < count; i++) {
        const plr_leaf *leaf = &view->flat.shapes.items[i];
        plr_surface *surface = &view->surfaces[i];
        surface->model = model_of(view, &table, leaf, diags);
        surface->to_world = leaf->to_world;
        view->surface_count = i + 1;
        if (surface->model->blends)
            view->blending[view->blending_count++] = surface;
    }
}
