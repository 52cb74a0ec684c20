/* The list of textures of a picture. */
#include "engine/texture_internal.h"

int plr_texture_dimensions(const plr_texture *texture) {
    return (int)texture->kind & 7;
}

GLenum plr_texture_target(plr_texture_kind kind) {
    switch ((int)kind & 7) {
    case PLR_TEXTURE_3D:
        return GL_TEXTURE_3D;
    case PLR_TEXTURE_CUBE:
        return GL_TEXTURE_CUBE_MAP;
    default:
        return GL_TEXTURE_2D;
    }
}

static plr_texture *push_texture(plr_textures *t, const plr_texture *texture) {
    plr_texture *copy = PLR_NEW(t->arena, plr_texture);
    *copy = *texture;
    *PLR_PUSH(t->arena, &t->list) = copy;
    return copy;
}

plr_texture *plr_textures_get(plr_textures *t, const plr_node *node) {
    for (size_t i = 0; i < t->list.count; i++)
        if (t->list.items[i]->node == node)
            return t->list.items[i];
    plr_texture texture = {.node = node};
    return plr_texture_load(t, &texture) ? push_texture(t, &texture) : NULL;
}

plr_texture *plr_textures_in(plr_textures *t, const plr_node *node, const char *field) {
    const plr_node *child = node ? plr_node_child(node, field) : NULL;
    plr_texture *texture = child ? plr_textures_get(t, child) : NULL;
    return texture && !texture->failed ? texture : NULL;
}

plr_texture *plr_textures_make(plr_textures *t, plr_image *image, plr_texture_kind kind,
                               bool voxels) {
    plr_texture texture = {.kind = kind,
                           .components = image->components,
                           .voxels = voxels,
                           .width = image->width,
                           .height = image->height,
                           .image = *image};
    *image = (plr_image){0};
    return push_texture(t, &texture);
}

plr_texture *plr_textures_generate(plr_textures *t, plr_texture_kind kind, bool depth,
                                   uint32_t width, uint32_t height) {
    plr_texture texture = {.kind = kind,
                           .components = depth ? 1 : 4,
                           .generated = true,
                           .depth = depth,
                           .width = width,
                           .height = height};
    return push_texture(t, &texture);
}

static void release(plr_textures *t, plr_texture *texture) {
    plr_image_free(&texture->image);
    if (!t->gl)
        return;
    if (texture->name)
        t->gl->DeleteTextures(1, &texture->name);
    t->gl->DeleteSamplers(2, texture->samplers);
    texture->name = texture->samplers[0] = texture->samplers[1] = 0;
}

void plr_textures_reload(plr_textures *t, plr_texture *texture) {
    release(t, texture);
    t->bytes -= texture->bytes;
    *texture = (plr_texture){.node = texture->node};
    plr_texture_load(t, texture);
}

void plr_textures_sweep(plr_textures *t) {
    size_t kept = 0;
    for (size_t i = 0; i < t->list.count; i++) {
        plr_texture *texture = t->list.items[i];
        if (texture->node || texture->kept)
            t->list.items[kept++] = texture;
        else
            release(t, texture);
    }
    t->list.count = kept;
}

bool plr_textures_upload(plr_textures *t) {
    bool fine = true;
    for (size_t i = 0; i < t->list.count; i++) {
        plr_texture *texture = t->list.items[i];
        if (texture->name || texture->in_bricks || !(texture->image.samples || texture->generated))
            continue;
        if (plr_texture_upload(t, texture))
            continue;
        fine = false;
        plr_place place = texture->node ? plr_node_place(texture->node) : (plr_place){0};
        plr_diags_add(t->diags,
                      texture->kind == PLR_TEXTURE_3D ? PLR_CODE_BAD_VOLUME : PLR_CODE_BAD_IMAGE,
                      place, "the GL implementation refuses a texture of %ux%u texels",
                      texture->width, texture->height);
    }
    return fine;
}

void plr_textures_finish(plr_textures *t) {
    for (size_t i = 0; i < t->list.count; i++)
        release(t, t->list.items[i]);
    t->list.count = 0;
    if (t->gl && t->clamping)
        t->gl->DeleteSamplers(1, &t->clamping);
    t->clamping = 0;
}
