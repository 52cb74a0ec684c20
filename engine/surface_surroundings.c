/* What is around a surface: fog, clip planes; and the way of its colour to the picture. */
#include "engine/surface.h"

#include <string.h>

#include "engine/general.h"

/* Every plane costs each fragment a test; the standard asks for six at least. */
enum {
    MOST_CLIP_PLANES = 32
};

static size_t add_placed(plr_shape *shape, const char *path, const plr_placed *placed,
                         const plr_define *extra, size_t extra_count) {
    plr_binding binding = {.node = placed->node,
                           .to_world = placed->to_world,
                           .place = &placed->to_world,
                           .volume = PLR_NO_EFFECT,
                           .gated = shape->view->general,
                           .closed = placed->off};
    return plr_recipe_builtin(&shape->view->kitchen, shape->recipe, path,
                              placed->node ? plr_node_type(placed->node) : "ClipPlane", binding, 0,
                              extra, extra_count);
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

static void add_fog(plr_shape *shape, bool complete) {
    const plr_placed *fog = plr_pass_fog(shape->view, shape->leaf->scope);
    if (!fog->node || is_immune_to_fog(shape))
        return;
    const plr_define extra[] = {
        plr_shape_define(shape, "HAS_FOG_COORD", shape->model->mesh.fog_coords != NULL),
        plr_shape_define(shape, "COMPLETE", complete), plr_shape_define(shape, "VOLUME", 0)};
    add_placed(shape, "fog/Fog", fog, extra, sizeof extra / sizeof *extra);
}

static void add_clip_planes(plr_shape *shape) {
    const plr_define on_surface = plr_shape_define(shape, "VOLUME", 0);
    size_t count = 0;
    for (const plr_scope *scope = shape->leaf->scope; scope; scope = scope->outer)
        for (size_t i = 0; i < scope->clip_planes.count; i++) {
            const plr_placed *plane = &scope->clip_planes.items[i];
            if (!plr_general_has(shape->view, plane->off, plane->node))
                continue;
            if (count++ < MOST_CLIP_PLANES)
                add_placed(shape, "fog/ClipPlane", plane, &on_surface, 1);
            else if (count == MOST_CLIP_PLANES + 1)
                plr_diags_add(shape->diags, PLR_CODE_LIMIT, plr_node_place(plane->node),
                              "more than %d clip planes cut one shape; the outer ones are left out",
                              MOST_CLIP_PLANES);
        }
    static const plr_placed spare = {.off = true};
    for (size_t i = plr_general_spares(shape->view, PLR_SLOT_PLANE, count);
         i > 0 && count < MOST_CLIP_PLANES; i--, count++)
        add_placed(shape, "fog/ClipPlane", &spare, &on_surface, 1);
}

void plr_shape_surroundings(plr_shape *shape) {
    add_output(shape);
    add_fog(shape, false);
    add_clip_planes(shape);
}

void plr_shape_complete_fog(plr_shape *shape) {
    add_fog(shape, true);
}
