/* What is around a surface: fog, clip planes; and the way of its colour to the picture. */
#include "engine/surface.h"

#include <string.h>

/* Every plane costs each fragment a test; the standard asks for six at least. */
enum {
    MOST_CLIP_PLANES = 32
};

static size_t add_placed(plr_shape *shape, const char *path, const plr_placed *placed,
                         const plr_define *extra, size_t extra_count) {
    plr_binding binding = {.node = placed->node,
                           .to_world = placed->to_world,
                           .place = &placed->to_world,
                           .volume = PLR_NO_EFFECT};
    return plr_recipe_builtin(&shape->view->kitchen, shape->recipe, path,
                              plr_node_type(placed->node), binding, 0, extra, extra_count);
}

/* ---- Output ---- */

/* PhysicalMaterial's colours are linear; those of all others are the picture's own. */
static bool is_linear(const plr_shape *shape) {
    const plr_node *material =
        shape->appearance ? plr_node_child(shape->appearance, "material") : NULL;
    return shape->lit && material && plr_node_is(material, "PhysicalMaterial");
}

static const char *const tone_modes[] = {"UNCHARTED", "HEJL_RICHARD", "REINHARD", "ACES"};

static bool is_tone_mode(const plr_shape *shape, const plr_node *node) {
    const char *mode = plr_node_string(node, "mode");
    for (size_t i = 0; i < sizeof tone_modes / sizeof *tone_modes; i++)
        if (strcmp(mode, tone_modes[i]) == 0)
            return true;
    plr_diags_add(shape->diags, PLR_CODE_BAD_VALUE, plr_node_field(node, "mode")->place,
                  "'%s' is no mode of ToneMapping: UNCHARTED, HEJL_RICHARD, REINHARD or ACES",
                  mode);
    return false;
}

static void add_output(plr_shape *shape) {
    plr_node *tones = shape->view->flat.tone_mapping;
    bool linear = is_linear(shape);
    if (tones && is_tone_mode(shape, tones)) {
        plr_define define = plr_shape_define(shape, "LINEAR", linear);
        plr_shape_effect(shape, "output/ToneMapping", "ToneMapping", tones, 0, &define, 1);
    }
    if (linear)
        plr_shape_effect(shape, "output/Gamma", "Gamma", NULL, 0, NULL, 0);
}

/* ---- Fog and planes ---- */

static bool is_immune_to_fog(const plr_shape *shape) {
    const plr_node *material =
        shape->appearance ? plr_node_child(shape->appearance, "material") : NULL;
    return material && plr_node_field(material, "fogImmune") &&
           plr_node_bool(material, "fogImmune");
}

/* The nearest LocalFog, else the Fog of the scene. */
static void add_fog(plr_shape *shape, bool complete) {
    const plr_placed *fog = &shape->view->flat.fog;
    for (const plr_scope *scope = shape->leaf->scope; scope; scope = scope->outer)
        if (scope->fog.node) {
            fog = &scope->fog;
            break;
        }
    if (!fog->node || is_immune_to_fog(shape))
        return;
    const plr_define extra[] = {
        plr_shape_define(shape, "HAS_FOG_COORD", shape->model->mesh.fog_coords != NULL),
        plr_shape_define(shape, "COMPLETE", complete)};
    add_placed(shape, "fog/Fog", fog, extra, sizeof extra / sizeof *extra);
}

static void add_clip_planes(plr_shape *shape) {
    size_t count = 0;
    for (const plr_scope *scope = shape->leaf->scope; scope; scope = scope->outer)
        for (size_t i = 0; i < scope->clip_planes.count; i++, count++) {
            const plr_placed *plane = &scope->clip_planes.items[i];
            if (count < MOST_CLIP_PLANES)
                add_placed(shape, "fog/ClipPlane", plane, NULL, 0);
            else if (count == MOST_CLIP_PLANES)
                plr_diags_add(shape->diags, PLR_CODE_LIMIT, plr_node_place(plane->node),
                              "more than %d clip planes cut one shape; the outer ones are left out",
                              MOST_CLIP_PLANES);
        }
}

void plr_shape_surroundings(plr_shape *shape) {
    add_output(shape);
    add_fog(shape, false);
    add_clip_planes(shape);
}

void plr_shape_complete_fog(plr_shape *shape) {
    add_fog(shape, true);
}

/* ---- Volumes ---- */

static void tell_not_in_volumes(const plr_node *node, plr_diags *diags) {
    if (node)
        plr_diags_add(diags, PLR_CODE_NOT_DRAWN, plr_node_place(node),
                      "%s changes surfaces alone, not the volumes in its reach yet",
                      plr_node_type(node));
}

void plr_volume_surroundings(const plr_view *view, const plr_scope *scope, plr_diags *diags) {
    tell_not_in_volumes(view->flat.fog.node, diags);
    for (; scope; scope = scope->outer) {
        tell_not_in_volumes(scope->fog.node, diags);
        for (size_t i = 0; i < scope->clip_planes.count; i++)
            tell_not_in_volumes(scope->clip_planes.items[i].node, diags);
    }
}
