/* Materials of surfaces as effects, and what their transparency means. */
#include "engine/surface.h"

/* What has no normals is not lit: its Material counts by its emissive colour (ISO/IEC 19775-1 V4
 * 11.2.2.5). */
void plr_shape_material(plr_shape *shape) {
    plr_node *material = shape->appearance ? plr_node_child(shape->appearance, "material") : NULL;
    const char *type = material ? plr_node_type(material) : "UnlitMaterial";
    const char *path = shape->lit ? plr_arena_format(&shape->view->arena, "surface/%s", type)
                                  : "surface/UnlitMaterial";
    shape->material = plr_shape_effect(shape, path, type, material, 0, NULL, 0);
    if (shape->material)
        return;
    plr_diags_add(shape->diags, PLR_CODE_NOT_DRAWN, plr_node_place(material),
                  "%s is not drawn yet; the shape is white", type);
    shape->material =
        plr_shape_effect(shape, "surface/UnlitMaterial", "UnlitMaterial", NULL, 0, NULL, 0);
}

bool plr_shape_blends(const plr_shape *shape) {
    if (!shape->appearance)
        return false;
    const plr_node *material = plr_node_child(shape->appearance, "material");
    const plr_node *texture = plr_node_child(shape->appearance, "texture");
    const plr_texture *image = texture ? plr_textures_get(&shape->view->textures, texture) : NULL;
    return (material && plr_node_number(material, "transparency") > 0) ||
           (image && image->translucent);
}
