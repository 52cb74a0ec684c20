#include "engine/texture.h"

#include <stdlib.h>
#include <string.h>

#include "engine/volume.h"

static bool is_translucent(const plr_image *image) {
    if (image->components != 2 && image->components != 4)
        return false;
    size_t count = (size_t)image->width * image->height * image->depth;
    for (size_t i = 0; i < count; i++) {
        size_t at = i * image->components + image->components - 1;
        bool below = image->type == PLR_UNORM8    ? ((const uint8_t *)image->samples)[at] < 255
                     : image->type == PLR_UNORM16 ? ((const uint16_t *)image->samples)[at] < 65535
                                                  : ((const float *)image->samples)[at] < 1;
        if (below)
            return true;
    }
    return false;
}

static bool load_image(plr_textures *t, const plr_node *node, plr_image *image) {
    return plr_image_from_texture(t->scene, node, image, t->diags);
}

static bool load_volume(plr_textures *t, const plr_node *node, plr_image *image) {
    plr_volume volume = {0};
    bool fine = plr_volume_from_node(t->scene, node, &volume, t->diags) &&
                plr_volume_to_image(&volume, (double[]){0, 0}, image);
    plr_volume_free(&volume);
    return fine;
}

static const struct {
    const char *type;
    int dimensions;
    bool (*load)(plr_textures *, const plr_node *, plr_image *);
} loaders[] = {
    {"ImageTexture", 2, load_image},       {"PixelTexture", 2, load_image},
    {"ImageTexture3D", 3, load_volume},    {"PixelTexture3D", 3, load_volume},
    {"ComposedTexture3D", 3, load_volume},
};

static plr_texture *push_texture(plr_textures *t, plr_texture texture) {
    plr_texture *copy = PLR_NEW(t->arena, plr_texture);
    *copy = texture;
    *PLR_PUSH(t->arena, &t->list) = copy;
    return copy;
}

/* What stands in for an image that cannot be had: one white texel. */
static void white(plr_image *image) {
    *image = (plr_image){1, 1, 1, 4, PLR_UNORM8, malloc(4)};
    if (image->samples)
        memset(image->samples, 255, 4);
}

plr_texture *plr_textures_get(plr_textures *t, const plr_node *node) {
    for (size_t i = 0; i < t->list.count; i++)
        if (t->list.items[i]->node == node)
            return t->list.items[i];
    for (size_t i = 0; i < sizeof loaders / sizeof *loaders; i++) {
        if (!plr_node_is(node, loaders[i].type))
            continue;
        plr_texture *texture =
            push_texture(t, (plr_texture){.node = node, .dimensions = loaders[i].dimensions});
        texture->failed = !loaders[i].load(t, node, &texture->image);
        if (texture->failed)
            white(&texture->image);
        texture->components = texture->image.components;
        texture->translucent = is_translucent(&texture->image);
        return texture;
    }
    return NULL;
}

plr_texture *plr_textures_in(plr_textures *t, const plr_node *node, const char *field) {
    const plr_node *child = node ? plr_node_child(node, field) : NULL;
    plr_texture *texture = child ? plr_textures_get(t, child) : NULL;
    return texture && !texture->failed ? texture : NULL;
}

plr_texture *plr_textures_make(plr_textures *t, plr_image *image, int dimensions, bool voxels) {
    plr_texture *texture = push_texture(t, (plr_texture){.dimensions = dimensions,
                                                         .components = image->components,
                                                         .voxels = voxels,
                                                         .image = *image});
    *image = (plr_image){0};
    return texture;
}

/* 8-bit samples go up as 16-bit ones (v * 257, the same value): some drivers filter 8-bit textures
 * in 8-bit arithmetic, which is seen in volumes and transfer functions. */
static uint16_t *widen(const plr_image *image, size_t count) {
    uint16_t *wide = malloc(count * sizeof *wide);
    for (size_t i = 0; wide && i < count; i++)
        wide[i] = (uint16_t)(((const uint8_t *)image->samples)[i] * 257u);
    return wide;
}

static const GLenum formats[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
static const GLenum unorm16_formats[] = {GL_R16, GL_RG16, GL_RGB16, GL_RGBA16};
static const GLenum float_formats[] = {GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F};

static GLenum target_of(const plr_texture *texture) {
    return texture->dimensions == 3 ? GL_TEXTURE_3D : GL_TEXTURE_2D;
}

static void set_swizzle(const plr_gl *gl, const plr_texture *texture) {
    if (texture->voxels || texture->components > 2)
        return;
    GLint alpha = texture->components == 2 ? GL_GREEN : GL_ONE;
    const GLint swizzle[] = {GL_RED, GL_RED, GL_RED, alpha};
    gl->TexParameteriv(target_of(texture), GL_TEXTURE_SWIZZLE_RGBA, swizzle);
}

static bool upload(plr_textures *t, plr_texture *texture) {
    const plr_gl *gl = t->gl;
    const plr_image *image = &texture->image;
    size_t count = (size_t)image->width * image->height * image->depth * image->components;
    uint16_t *wide = image->type == PLR_UNORM8 ? widen(image, count) : NULL;
    const void *samples = wide ? wide : image->samples;
    bool is_float = image->type == PLR_FLOAT32;
    GLint inner = (GLint)(is_float ? float_formats : unorm16_formats)[image->components - 1];
    GLenum format = formats[image->components - 1], type = is_float ? GL_FLOAT : GL_UNSIGNED_SHORT;
    GLenum target = target_of(texture);
    while (gl->GetError() != GL_NO_ERROR)
        ;
    gl->GenTextures(1, &texture->name);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(target, texture->name);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (texture->dimensions == 3)
        gl->TexImage3D(target, 0, inner, (GLsizei)image->width, (GLsizei)image->height,
                       (GLsizei)image->depth, 0, format, type, samples);
    else
        gl->TexImage2D(target, 0, inner, (GLsizei)image->width, (GLsizei)image->height, 0, format,
                       type, samples);
    gl->TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl->TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
    const struct {
        GLenum name;
        const char *field;
    } wraps[] = {{GL_TEXTURE_WRAP_S, "repeatS"},
                 {GL_TEXTURE_WRAP_T, "repeatT"},
                 {GL_TEXTURE_WRAP_R, "repeatR"}};
    for (int i = 0; i < 3; i++)
        gl->TexParameteri(target, wraps[i].name,
                          texture->node && plr_node_bool(texture->node, wraps[i].field)
                              ? GL_REPEAT
                              : GL_CLAMP_TO_EDGE);
    set_swizzle(gl, texture);
    free(wide);
    bool fine = gl->GetError() == GL_NO_ERROR;
    plr_image_free(&texture->image);
    return fine;
}

bool plr_textures_upload(plr_textures *t) {
    const plr_gl *gl = t->gl;
    if (!t->clamping) {
        gl->GenSamplers(1, &t->clamping);
        static const GLenum wraps[] = {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R};
        for (int i = 0; i < 3; i++)
            gl->SamplerParameteri(t->clamping, wraps[i], GL_CLAMP_TO_EDGE);
        gl->SamplerParameteri(t->clamping, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        gl->SamplerParameteri(t->clamping, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    }
    bool fine = true;
    for (size_t i = 0; i < t->list.count; i++) {
        plr_texture *texture = t->list.items[i];
        if (texture->name || !texture->image.samples)
            continue;
        uint32_t width = texture->image.width, height = texture->image.height;
        if (upload(t, texture))
            continue;
        fine = false;
        plr_place place = texture->node ? plr_node_place(texture->node) : (plr_place){0};
        plr_diags_add(t->diags, texture->dimensions == 3 ? PLR_CODE_BAD_VOLUME : PLR_CODE_BAD_IMAGE,
                      place, "the GL implementation refuses a texture of %ux%u texels", width,
                      height);
    }
    return fine;
}

void plr_texture_bind(const plr_textures *t, const plr_texture *texture, unsigned unit,
                      bool clamp) {
    t->gl->ActiveTexture(GL_TEXTURE0 + unit);
    t->gl->BindTexture(target_of(texture), texture->name);
    t->gl->BindSampler(unit, clamp ? t->clamping : 0);
}

void plr_textures_finish(plr_textures *t) {
    for (size_t i = 0; i < t->list.count; i++) {
        plr_image_free(&t->list.items[i]->image);
        if (t->gl && t->list.items[i]->name)
            t->gl->DeleteTextures(1, &t->list.items[i]->name);
    }
    t->list.count = 0;
    if (t->gl && t->clamping)
        t->gl->DeleteSamplers(1, &t->clamping);
    t->clamping = 0;
}
