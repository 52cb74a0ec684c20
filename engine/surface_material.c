/* Materials of surfaces as effects, and what their transparency means. */
#include <string.h>

#include "engine/surface_textures.h"

/* Its node types are those of the material's colours; the field's place is the fault's. */
static plr_node *back_material(const plr_shape *shape, plr_node *material, const char *type) {
    plr_node *back = plr_node_child(shape->appearance, "backMaterial");
    if (plr_node_is(material, "TwoSidedMaterial"))
        return plr_node_bool(material, "separateBackColor") ? material : NULL;
    if (!back || plr_node_is(back, type))
        return back;
    plr_diags_add(shape->diags, PLR_CODE_BAD_VALUE, plr_node_place(back),
                  "backMaterial must be of the type of material, %s; it is left out", type);
    return NULL;
}

/* A TwoSidedMaterial is a Material with other colours on its back. */
static void add_material(plr_shape *shape, plr_node *material) {
    plr_arena *arena = &shape->view->arena;
    const char *type = plr_node_type(material);
    bool two = plr_node_is(material, "TwoSidedMaterial");
    const char *model = shape->lit ? (two ? "Material" : type) : "UnlitMaterial";
    shape->material = plr_shape_effect(shape, plr_arena_format(arena, "surface/%s", model), type,
                                       material, 0, NULL, 0);
    plr_node *back = shape->lit ? back_material(shape, material, type) : NULL;
    if (shape->material && back)
        plr_shape_effect(shape, plr_arena_format(arena, "surface/back/%s", type), type, back,
                         shape->material, NULL, 0);
}

/* Colours at the vertices stand for the material's. */
static void add_vertex_colors(plr_shape *shape) {
    if (!shape->model->mesh.colors)
        return;
    plr_node *colors = plr_node_child(shape->geometry, "color");
    const char *type = colors ? plr_node_type(colors) : "Color";
    plr_define alpha = plr_shape_define(shape, "WITH_ALPHA", strcmp(type, "ColorRGBA") == 0);
    plr_shape_effect(shape, "surface/Color", type, colors, 0, &alpha, 1);
}

/* What has no normals is not lit: its Material counts by its emissive colour (ISO/IEC 19775-1 V4
 * 11.2.2.5). */
void plr_shape_material(plr_shape *shape) {
    plr_node *material = shape->appearance ? plr_node_child(shape->appearance, "material") : NULL;
    if (material)
        add_material(shape, material);
    if (material && !shape->material)
        plr_diags_add(shape->diags, PLR_CODE_NOT_DRAWN, plr_node_place(material),
                      "%s is not drawn yet; the shape is white", plr_node_type(material));
    if (!shape->material)
        shape->material =
            plr_shape_effect(shape, "surface/UnlitMaterial", "UnlitMaterial", NULL, 0, NULL, 0);
    add_vertex_colors(shape);
}

bool plr_shape_blends(const plr_shape *shape) {
    if (!shape->appearance)
        return false;
    const plr_node *material = plr_node_child(shape->appearance, "material");
    return (material && plr_node_number(material, "transparency") > 0) ||
           plr_shape_texture_alpha(shape) != PLR_ALPHA_OPAQUE;
}
