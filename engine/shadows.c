#include "engine/shadows.h"

#include <math.h>
#include <string.h>

#include "engine/frame.h"
#include "engine/projector.h"
#include "engine/targets.h"

/* ---- Which lights have a map ---- */

static plr_shadow *find_shadow(const plr_view *view, const plr_node *light, const plr_node *map) {
    for (size_t i = 0; i < view->shadows.count; i++) {
        plr_shadow *shadow = view->shadows.items[i];
        if (shadow->light == light && (!map || shadow->map == map))
            return shadow;
    }
    return NULL;
}

/* Whether the depths in the map are set back while it is drawn, so that authors' own comparisons
 * are right; the built-in one needs no further offset then. A light's default is read by that
 * alone, so it needs none unless it asks for one. */
static bool is_set_back(const plr_node *light, const plr_node *map) {
    return map && (map != plr_node_child(light, "defaultShadowMap") ||
                   plr_node_field(map, "scale")->given || plr_node_field(map, "bias")->given);
}

static plr_shadow *push_shadow(plr_view *view, plr_node *light, const plr_node *map,
                               plr_texture *texture) {
    plr_shadow *shadow = PLR_NEW(&view->arena, plr_shadow);
    *shadow = (plr_shadow){.light = light, .map = map, .world = view->entered};
    shadow->values.texture = texture;
    shadow->values.from_world = plr_matrix_identity();
    shadow->values.offset = is_set_back(light, map) ? 0 : 1;
    const plr_field *bias = plr_node_field(light, "shadowBias");
    if (bias && bias->given)
        shadow->values.depth_bias = plr_node_number(light, "shadowBias");
    *PLR_PUSH(&view->arena, &view->shadows) = shadow;
    return shadow;
}

/* A cone that is wider than this is seen by the faces of a cube. */
static bool is_wide(const plr_node *light) {
    return plr_node_is(light, "PointLight") ||
           (plr_node_is(light, "SpotLight") && !(plr_node_number(light, "projectionAngle") > 0) &&
            plr_node_number(light, "cutOffAngle") > 1.0472);
}

static bool compares(const plr_texture *texture) {
    return texture->kind == PLR_TEXTURE_2D_SHADOW || texture->kind == PLR_TEXTURE_CUBE_SHADOW;
}

static bool has_map(const plr_node *light) {
    return plr_node_is(light, "DirectionalLight") || plr_node_is(light, "SpotLight") ||
           plr_node_is(light, "PointLight");
}

/* A cube of this side takes 400 megabytes. */
enum {
    MOST_SIDE = 4096
};

static plr_shadow *make_shadow(plr_view *view, plr_node *light) {
    plr_node *map = plr_node_child(light, "defaultShadowMap");
    plr_texture *texture = map ? plr_textures_get(&view->textures, map) : NULL;
    for (size_t i = 0; texture && i < view->targets.count; i++)
        if (view->targets.items[i]->texture == texture)
            texture = NULL; /* it serves another light, or another world */
    if (texture && !compares(texture))
        texture = NULL;
    if (!texture) {
        int size = plr_node_int(map ? map : light, map ? "size" : "shadowMapSize");
        uint32_t side = size < 1 ? 1 : size > MOST_SIDE ? MOST_SIDE : (uint32_t)size;
        texture = plr_textures_generate(
            &view->textures, is_wide(light) ? PLR_TEXTURE_CUBE_SHADOW : PLR_TEXTURE_2D_SHADOW, true,
            side, side);
    }
    plr_shadow *shadow = push_shadow(view, light, map, texture);
    return plr_targets_add_shadow(view, shadow) ? shadow : NULL;
}

plr_shadow *plr_shadow_of_map(plr_view *view, const plr_node *map, plr_texture *texture) {
    plr_node *light = plr_node_child(map, "light");
    for (size_t i = 0; !light && i < view->flat.all_lights.count; i++)
        if (plr_node_child(view->flat.all_lights.items[i].node, "defaultShadowMap") == map)
            light = view->flat.all_lights.items[i].node;
    if (!light || !has_map(light))
        return NULL;
    plr_shadow *shadow = find_shadow(view, light, map);
    if (!shadow)
        shadow = push_shadow(view, light, map, texture);
    return plr_targets_add_shadow(view, shadow) ? shadow : NULL;
}

/* ---- The effect ---- */

/* The GeneratedShadowMap of the light among the textures of the appearance. */
static plr_node *named_map(const plr_node *appearance, const plr_node *light) {
    plr_node *texture = appearance ? plr_node_child(appearance, "texture") : NULL;
    const plr_field *many = texture ? plr_node_field(texture, "texture") : NULL;
    size_t count = many ? many->count : texture ? 1 : 0;
    for (size_t i = 0; i < count; i++) {
        plr_node *one = many ? many->value.nodes[i] : texture;
        if (one && plr_node_is(one, "GeneratedShadowMap") && plr_node_child(one, "light") == light)
            return one;
    }
    return NULL;
}

static bool receives(const plr_node *appearance, const plr_node *light) {
    if (plr_node_bool(light, "shadows"))
        return true;
    const plr_field *lights = appearance ? plr_node_field(appearance, "receiveShadows") : NULL;
    for (size_t i = 0; lights && i < lights->count; i++)
        if (lights->value.nodes[i] == light)
            return true;
    return false;
}

/* The shadow in which a light stands on what has this appearance; NULL: none. */
static plr_shadow *shadow_for(plr_view *view, plr_node *light, const plr_node *appearance) {
    if (!has_map(light))
        return NULL;
    plr_node *map = named_map(appearance, light);
    plr_texture *texture = map ? plr_textures_get(&view->textures, map) : NULL;
    if (texture && compares(texture)) {
        plr_shadow *shadow = find_shadow(view, light, map);
        return shadow ? shadow : plr_shadow_of_map(view, map, texture);
    }
    if (!receives(appearance, light))
        return NULL;
    plr_shadow *shadow = find_shadow(view, light, plr_node_child(light, "defaultShadowMap"));
    return shadow ? shadow : make_shadow(view, light);
}

static bool is_light(const plr_recipe *recipe, size_t index) {
    const plr_node *node = recipe->bindings.items[index].node;
    const plr_effect *effect = &recipe->effects.items[index];
    if (!node || !effect->builtin || strcmp(effect->name, plr_node_type(node)) != 0)
        return false;
    const plr_node_info *info = plr_node_info_find(plr_node_type(node));
    return info && plr_node_info_is(info, "X3DLightNode");
}

void plr_recipe_shadows(plr_view *view, plr_recipe *recipe, size_t from, size_t volume,
                        const plr_node *appearance) {
    size_t count = recipe->effects.count;
    const plr_define surface = {"SURFACE", volume == PLR_NO_EFFECT ? "1" : "0"};
    for (size_t i = from; i < count; i++) {
        plr_binding binding = recipe->bindings.items[i];
        plr_shadow *shadow =
            is_light(recipe, i) ? shadow_for(view, binding.node, appearance) : NULL;
        if (!shadow)
            continue;
        bool cube = shadow->values.texture->kind == PLR_TEXTURE_CUBE_SHADOW;
        binding.shadow = &shadow->values;
        binding.is_light = false;
        binding.volume = volume;
        plr_recipe_builtin(&view->kitchen, recipe,
                           cube ? "shadows/ShadowCube" : "shadows/ShadowMap", "GeneratedShadowMap",
                           binding, i + 1, &surface, 1);
    }
}

/* ---- Casters ---- */

/* What is translucent casts none. */
static bool casts(const plr_model *model) {
    const plr_node *appearance = plr_node_child(model->node, "appearance");
    return model->pass.built && !model->blends && model->mesh.index_count &&
           plr_node_bool(model->node, "castShadow") &&
           (!appearance || plr_node_bool(appearance, "shadowCaster"));
}

/* The stages of the base before the fragments, and a fragment stage that draws depths alone. */
static void set_depth_base(plr_view *view, plr_recipe *recipe) {
    plr_sources base = {0};
    for (size_t i = 0; i < recipe->base.count; i++)
        if (plr_source_stage(recipe->base.items[i]) != PLR_FRAGMENT)
            *PLR_PUSH(&view->arena, &base) = recipe->base.items[i];
    const plr_sources *depth = plr_catalog_units(view->kitchen.catalog, "shadows/depth");
    for (size_t i = 0; i < depth->count; i++)
        *PLR_PUSH(&view->arena, &base) = depth->items[i];
    recipe->base = base;
}

/* Light changes no depth; and a map is not read while it is drawn. */
static void leave_out_lights(plr_recipe *recipe) {
    for (size_t i = 0; i < recipe->effects.count; i++)
        if (is_light(recipe, i) || recipe->bindings.items[i].shadow)
            recipe->effects.items[i].disabled = true;
}

/* The recipe of the shape with another base: whatever moves its vertices stays. Where its fragments
 * may be discarded, the whole of its fragment stage stays, but light. Faults were reported when the
 * shape was composed. */
static plr_model *make_caster(plr_view *view, const plr_model *model) {
    plr_model *caster = PLR_NEW(&view->arena, plr_model);
    caster->node = model->node;
    caster->scope = model->scope;
    plr_recipe *recipe = &caster->pass.recipe;
    *recipe = model->pass.recipe;
    recipe->effects.items = PLR_NEW_ARRAY(&view->arena, recipe->effects.count + 1, plr_effect);
    recipe->effects.capacity = recipe->effects.count;
    for (size_t i = 0; i < recipe->effects.count; i++)
        recipe->effects.items[i] = model->pass.recipe.effects.items[i];
    leave_out_lights(recipe);
    const char *text = plr_program_text(model->pass.program, PLR_FRAGMENT, NULL);
    if (!text || !strstr(text, "discard"))
        set_depth_base(view, recipe);
    caster->pass.built =
        plr_compose_program(&view->composer, recipe, "shadow", &caster->pass.program);
    return caster;
}

void plr_casters_prepare(plr_view *view) {
    plr_diags *composer = view->composer.diags, *kitchen = view->kitchen.diags;
    view->composer.diags = view->kitchen.diags = NULL;
    for (size_t i = 0; view->shadows.count && i < view->model_count; i++)
        if (!view->models[i]->caster && casts(view->models[i]))
            view->models[i]->caster = make_caster(view, view->models[i]);
    view->composer.diags = composer;
    view->kitchen.diags = kitchen;
}

void plr_casters_find(plr_view *view) {
    for (size_t i = 0; i < view->model_count; i++)
        if (view->models[i]->caster)
            plr_pass_find(view, &view->models[i]->caster->pass);
}

void plr_casters_finish(plr_view *view) {
    for (size_t i = 0; i < view->model_count; i++) {
        plr_model *caster = view->models[i]->caster;
        view->models[i]->caster = NULL;
        if (!caster)
            continue;
        caster->mesh = (plr_mesh){0}; /* the shape's */
        plr_model_finish(view, caster);
    }
}

/* ---- Drawing ---- */

/* A map that authors read, too, is what the projector of the light says, and so is one of which the
 * light says what it holds. */
static bool is_ours_to_fit(const plr_shadow *shadow) {
    float box[4] = {0, 0, 0, 0};
    plr_node_numbers(shadow->light, "projectionRectangle", box, 4);
    bool given = box[2] > box[0] && box[3] > box[1];
    return !given && !(plr_node_number(shadow->light, "projectionAngle") > 0) &&
           (!shadow->map || shadow->map == plr_node_child(shadow->light, "defaultShadowMap"));
}

static void plan_map(plr_view *view, plr_shadow *shadow, plr_frame *frame) {
    plr_projector_matrices(view, shadow->light, &frame->projection, &frame->view);
    if (is_ours_to_fit(shadow))
        plr_shadow_fit(view, shadow, frame);
    plr_matrix half = plr_matrix_scale(0.5, 0.5, 0.5);
    plr_matrix middle = plr_matrix_translation(0.5, 0.5, 0.5);
    plr_matrix to_map = plr_matrix_multiply(&middle, &half);
    to_map = plr_matrix_multiply(&to_map, &frame->projection);
    shadow->values.from_world = plr_matrix_multiply(&to_map, &frame->view);
    for (int i = 0; i < 3; i++)
        shadow->values.axis[i] = frame->view.m[i * 4 + 2];
    /* the side of the map at w = 1 is 2 / scale */
    double scale = fmin(fabs(frame->projection.m[0]), fabs(frame->projection.m[5]));
    shadow->values.texel = scale > 0 ? 2 / scale / shadow->values.texture->width : 0;
}

static void plan_cube(plr_view *view, plr_shadow *shadow, plr_frame frames[6]) {
    double place[3];
    plr_matrix projection = plr_projector_cube(view, shadow->light, place);
    for (int face = 0; face < 6; face++) {
        frames[face].projection = projection;
        frames[face].view = plr_frame_cube_face(place, face);
    }
    shadow->values.from_world = plr_matrix_translation(-place[0], -place[1], -place[2]);
    shadow->values.texel = 2.0 / shadow->values.texture->width;
    shadow->values.depths[0] = 0.5 - 0.5 * projection.m[10];
    shadow->values.depths[1] = 0.5 * projection.m[14];
}

int plr_shadow_plan(plr_view *view, plr_shadow *shadow, plr_frame frames[6]) {
    const plr_texture *texture = shadow->values.texture;
    bool cube = plr_texture_dimensions(texture) == PLR_TEXTURE_CUBE;
    int count = cube ? 6 : 1;
    for (int i = 0; i < count; i++)
        frames[i] = (plr_frame){.viewport = {0, 0, texture->width, texture->height},
                                .cut = {0, INFINITY},
                                .time = view->desc.time};
    if (cube)
        plan_cube(view, shadow, frames);
    else
        plan_map(view, shadow, &frames[0]);
    return count;
}

/* Both sides of a surface cast, whichever can be seen. */
static void draw_caster(plr_view *view, const plr_surface *surface, const plr_frame *frame) {
    plr_model *caster = surface->model->caster;
    caster->mesh = surface->model->mesh;
    caster->mesh.two_sided = true;
    plr_surface placed = {.model = caster, .to_world = surface->to_world};
    plr_surface_draw(view, &placed, frame);
}

void plr_casters_draw(plr_view *view, const plr_shadow *shadow, const plr_frame *frame) {
    const plr_gl *gl = &view->engine->gl;
    if (is_set_back(shadow->light, shadow->map)) {
        gl->Enable(GL_POLYGON_OFFSET_FILL);
        gl->PolygonOffset((float)plr_node_number(shadow->map, "scale"),
                          (float)plr_node_number(shadow->map, "bias"));
    }
    for (size_t i = 0; i < view->surface_count; i++) {
        const plr_model *model = view->surfaces[i].model;
        if (model->caster && model->caster->pass.built &&
            !plr_bind_reads(&model->caster->pass.slots, shadow->values.texture))
            draw_caster(view, &view->surfaces[i], frame);
    }
    gl->Disable(GL_POLYGON_OFFSET_FILL);
}
