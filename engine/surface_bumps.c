/* Bumps: normals and heights from textures. */
#include "engine/surface_textures.h"

/* The alpha of an Appearance's normalMap holds heights. */
static bool has_heights(const plr_shape *shape, const plr_node *owner, const char *field) {
    const plr_texture *texture = plr_textures_in(&shape->view->textures, owner, field);
    return owner == shape->appearance && texture && texture->kind == PLR_TEXTURE_2D &&
           texture->components % 2 == 0;
}

static bool add_normals(plr_shape *shape, plr_node *owner, const char *field) {
    plr_node *texture = owner && plr_node_field(owner, field) ? plr_node_child(owner, field) : NULL;
    if (!texture)
        return false;
    const plr_field *mapping =
        plr_node_field(owner, plr_arena_format(&shape->view->arena, "%sMapping", field));
    plr_coordinates where =
        plr_shape_named_coordinates(shape, mapping ? plr_node_string(owner, mapping->name) : "", 2,
                                    mapping ? mapping->place : plr_node_place(texture));
    plr_define channel = plr_shape_define(shape, "CHANNEL", where.channel);
    bool added = where.channel >= 0 &&
                 plr_shape_field_texture(shape, owner, field, "surface/NormalMap", &channel, 1);
    if (added && where.channel == 0 && has_heights(shape, owner, field))
        plr_shape_effect(shape, "surface/HeightMap", "HeightMap", owner, 0, NULL, 0);
    return added;
}

void plr_shape_bumps(plr_shape *shape) {
    if (!shape->lit || !shape->appearance)
        return;
    if (!add_normals(shape, plr_shape_material_node(shape), "normalTexture"))
        add_normals(shape, shape->appearance, "normalMap");
}
