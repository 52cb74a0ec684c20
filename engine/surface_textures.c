/* Textures of surfaces as effects, with their coordinates. */
#include "engine/surface.h"

void plr_shape_textures(plr_shape *shape) {
    plr_node *texture = shape->appearance ? plr_node_child(shape->appearance, "texture") : NULL;
    if (!texture)
        return;
    plr_texture *image = plr_textures_get(&shape->view->textures, texture);
    if (!image || image->kind != PLR_TEXTURE_2D) {
        plr_diags_add(shape->diags, PLR_CODE_NOT_DRAWN, plr_node_place(texture),
                      "%s is not drawn on surfaces yet", plr_node_type(texture));
        return;
    }
    size_t attached =
        plr_shape_effect(shape, "surface/Texture2D", plr_node_type(texture), texture, 0, NULL, 0);
    plr_node *transform = plr_node_child(shape->appearance, "textureTransform");
    if (transform)
        plr_shape_effect(
            shape, plr_arena_format(&shape->view->arena, "surface/%s", plr_node_type(transform)),
            plr_node_type(transform), transform, attached, NULL, 0);
}
