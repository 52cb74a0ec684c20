/* Texture nodes of a scene as volumes: pixels and slices that the scene itself holds. */
#include "engine/volume_node.h"

#include <math.h>
#include <string.h>

void plr_volume_from_image(plr_image *image, plr_volume *volume) {
    static const plr_voxel_type types[] = {
        [PLR_UNORM8] = PLR_VOXEL_U8, [PLR_UNORM16] = PLR_VOXEL_U16, [PLR_FLOAT32] = PLR_VOXEL_F32};
    *volume = (plr_volume){.size = {image->width, image->height, image->depth},
                           .components = image->components,
                           .type = types[image->type],
                           .voxels = image->samples,
                           .slope = 1};
    bool deep = image->type == PLR_UNORM16;
    plr_volume_set_range(volume, deep ? 0 : (double)NAN, deep ? 65535 : (double)NAN);
    memset(image, 0, sizeof *image);
}

bool plr_volume_check_image(const plr_image *image, plr_place place, plr_diags *diags) {
    const uint64_t size[3] = {image->width, image->height, image->depth};
    return plr_volume_check_size(size, image->components, PLR_VOXEL_F32, place, diags);
}

/* ---- ComposedTexture3D ---- */

typedef struct children {
    plr_scene *scene;
    const plr_field *nodes;
} children;

static bool load_child(void *user, size_t index, plr_image *slice, plr_place *place,
                       plr_diags *diags) {
    const children *c = user;
    const plr_node *child = c->nodes->value.nodes[index];
    *place = plr_node_place(child);
    plr_scene_progress(c->scene, "slices", (double)index / (double)c->nodes->count);
    return plr_image_from_texture(c->scene, child, slice, diags);
}

static bool from_children(plr_scene *scene, const plr_node *texture, plr_volume *volume,
                          plr_diags *diags) {
    children c = {scene, plr_node_field(texture, "texture")};
    return plr_volume_from_slices(load_child, &c, c.nodes ? c.nodes->count : 0,
                                  plr_node_place(texture), volume, diags);
}

/* ---- PixelTexture3D ---- */

static bool from_pixels(plr_scene *scene, const plr_node *texture, plr_volume *volume,
                        plr_diags *diags) {
    (void)scene;
    plr_image image;
    const plr_field *field = plr_node_field(texture, "image");
    if (plr_image_is_refused(texture, field) || !plr_image_from_image3d(field, &image, diags))
        return false;
    bool ok = plr_volume_check_image(&image, plr_node_place(texture), diags);
    if (ok)
        plr_volume_from_image(&image, volume);
    plr_image_free(&image);
    return ok;
}

static const struct {
    const char *type;
    bool (*read)(plr_scene *, const plr_node *, plr_volume *, plr_diags *);
} readers[] = {
    {"ImageTexture3D", plr_volume_from_urls},
    {"PixelTexture3D", from_pixels},
    {"ComposedTexture3D", from_children},
    {"ImageTextureAtlas", plr_volume_from_atlas},
};

bool plr_volume_from_node(plr_scene *scene, const plr_node *texture, plr_volume *volume,
                          plr_diags *diags) {
    memset(volume, 0, sizeof *volume);
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++)
        if (plr_node_is(texture, readers[i].type))
            return readers[i].read(scene, texture, volume, diags);
    plr_diags_add(diags, PLR_CODE_NOT_DRAWN, plr_node_place(texture), "%s is not read as a volume",
                  plr_node_type(texture));
    return false;
}
