/* From a shape to its program: the base, the built-in effects, the authors' effects. */
#include "engine/surface.h"

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
    if (shape->lit)
        plr_pass_lights(shape->view, shape->recipe, shape->leaf->scope, 0, PLR_NO_EFFECT);
}

static void define_surface(plr_shape *shape) {
    const plr_surface *surface = shape->surface;
    const struct {
        const char *name;
        int value;
    } defines[] = {{"CASTLE_GLSL_VERSION_UPGRADE", 1},
                   {"HAS_COLORS", surface->mesh.colors != NULL},
                   {"HAS_NORMALS", surface->mesh.normals != NULL},
                   {"TWO_SIDED", surface->mesh.two_sided},
                   {"OPAQUE", !surface->blends}};
    for (size_t i = 0; i < sizeof defines / sizeof *defines; i++)
        plr_recipe_define(&shape->view->kitchen, shape->recipe, defines[i].name, defines[i].value);
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
    plr_pass *pass = &shape->surface->pass;
    add_authors(shape);
    pass->built =
        plr_compose_program(&shape->view->composer, &pass->recipe, "surface", &pass->program);
}

static void compose_standard(plr_shape *shape) {
    static void (*const ingredients[])(plr_shape *) = {plr_shape_material, plr_shape_textures,
                                                       plr_shape_lights, plr_shape_surroundings};
    *shape->recipe =
        (plr_recipe){.base = *plr_catalog_units(shape->view->kitchen.catalog, "surface/surface")};
    define_surface(shape);
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
        shape->surface->pass = (plr_pass){0};
        if (!shader || !plr_node_is(shader, "ComposedShader") ||
            !plr_recipe_shader_base(&shape->view->kitchen, shape->recipe, shader))
            continue;
        shape->recipe->base_node = shader;
        define_surface(shape);
        compose(shape);
        if (shape->surface->pass.built)
            return true;
    }
    return false;
}

static void prepare_surface(plr_view *view, plr_surface *surface, const plr_leaf *leaf,
                            plr_diags *diags) {
    plr_shape shape = {.view = view,
                       .surface = surface,
                       .leaf = leaf,
                       .appearance = plr_node_child(leaf->node, "appearance"),
                       .geometry = plr_node_child(leaf->node, "geometry"),
                       .recipe = &surface->pass.recipe,
                       .diags = diags};
    surface->to_world = leaf->to_world;
    bool built = plr_mesh_build(shape.geometry, &surface->mesh, diags);
    if (!built && view->engine)
        return; /* else the effects on it are checked all the same */
    shape.lit = surface->mesh.normals != NULL;
    surface->blends = plr_shape_blends(&shape);
    if (!compose_shader(&shape))
        compose_standard(&shape);
}

void plr_surfaces_prepare(plr_view *view, plr_diags *diags) {
    view->surfaces = PLR_NEW_ARRAY(&view->arena, view->flat.shapes.count + 1, plr_surface);
    view->blending = PLR_NEW_ARRAY(&view->arena, view->flat.shapes.count + 1, plr_surface *);
    for (size_t i = 0; i < view->flat.shapes.count; i++) {
        view->surface_count = i + 1; /* before: so that its mesh is freed whatever happens */
        prepare_surface(view, &view->surfaces[i], &view->flat.shapes.items[i], diags);
        if (view->surfaces[i].blends)
            view->blending[view->blending_count++] = &view->surfaces[i];
    }
}
