/* Texture nodes: what they are made of. No GL. */
#include "engine/texture_internal.h"

#include <stdlib.h>
#include <string.h>

#include "engine/volume.h"

/* ---- Alpha ---- */

static double alpha_at(const plr_image *image, size_t texel) {
    size_t at = texel * image->components + image->components - 1;
    switch (image->type) {
    case PLR_UNORM8:
        return ((const uint8_t *)image->samples)[at] / 255.0;
    case PLR_UNORM16:
        return ((const uint16_t *)image->samples)[at] / 65535.0;
    case PLR_FLOAT32:
        return (double)((const float *)image->samples)[at];
    case PLR_UINT8:
    case PLR_UINT16:
    case PLR_UINT32:
        break; /* labels have no alpha */
    }
    return 1;
}

static plr_texture_alpha find_alpha(const plr_image *image) {
    plr_texture_alpha found = PLR_ALPHA_OPAQUE;
    if (image->components != 2 && image->components != 4)
        return found;
    size_t count = plr_image_level_samples(image, 0) / image->components;
    for (size_t i = 0; i < count; i++) {
        double alpha = alpha_at(image, i);
        if (alpha > 0 && alpha < 1)
            return PLR_ALPHA_BLENDING;
        if (!(alpha >= 1))
            found = PLR_ALPHA_TEST;
    }
    return found;
}

/* The field alphaChannel decides, where it is not AUTO. */
static plr_texture_alpha alpha_of(const plr_node *node, plr_texture_alpha found) {
    const struct {
        const char *name;
        plr_texture_alpha alpha;
    } words[] = {{"NONE", PLR_ALPHA_OPAQUE},
                 {"TEST", PLR_ALPHA_TEST},
                 {"SIMPLE_YES_NO", PLR_ALPHA_TEST}, /* the word of before 2014 */
                 {"BLENDING", PLR_ALPHA_BLENDING},
                 {"FULL_RANGE", PLR_ALPHA_BLENDING}};
    const char *word = plr_node_string(node, "alphaChannel");
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(word, words[i].name) == 0)
            return words[i].alpha;
    return found;
}

/* ---- Loaders ---- */

static bool load_image(plr_textures *t, plr_texture *texture) {
    return plr_image_from_texture(t->scene, texture->node, &texture->image, t->diags);
}

static bool load_cube(plr_textures *t, plr_texture *texture) {
    return plr_image_from_cube_node(t->scene, texture->node, &texture->image, t->diags);
}

static bool load_volume(plr_textures *t, plr_texture *texture) {
    plr_volume volume = {0};
    bool fine = plr_volume_from_node(t->scene, texture->node, &volume, t->diags) &&
                plr_volume_to_image(&volume, (double[]){0, 0}, &texture->image);
    plr_volume_free(&volume);
    return fine;
}

/* ---- Textures that the engine draws into ---- */

static uint32_t side(int64_t value) {
    return value < 1 ? 1 : value > PLR_TEXTURE_MAX_SIDE ? PLR_TEXTURE_MAX_SIDE : (uint32_t)value;
}

static bool generate_square(plr_textures *t, plr_texture *texture) {
    (void)t;
    texture->width = texture->height = side(plr_node_int(texture->node, "size"));
    return true;
}

static bool generate_picture(plr_textures *t, plr_texture *texture) {
    (void)t;
    const plr_field *sizes = plr_node_field(texture->node, "dimensions");
    texture->width = side(sizes && sizes->count > 0 ? sizes->value.ints[0] : 128);
    texture->height = side(sizes && sizes->count > 1 ? sizes->value.ints[1] : 128);
    const plr_field *depths = plr_node_field(texture->node, "depthMap");
    texture->depth = depths && depths->count > 0 && depths->value.bools[0];
    return true;
}

static bool generate_shadow_map(plr_textures *t, plr_texture *texture) {
    const plr_node *light = plr_node_child(texture->node, "light");
    bool compares = strcmp(plr_node_string(texture->node, "compareMode"), "NONE") != 0;
    bool is_cube = light && plr_node_is(light, "PointLight");
    texture->depth = true;
    texture->kind = is_cube && compares ? PLR_TEXTURE_CUBE_SHADOW
                    : is_cube           ? PLR_TEXTURE_CUBE
                    : compares          ? PLR_TEXTURE_2D_SHADOW
                                        : PLR_TEXTURE_2D;
    return generate_square(t, texture);
}

static const struct loader {
    const char *type;
    plr_texture_kind kind;
    bool generated;
    bool (*load)(plr_textures *, plr_texture *);
} loaders[] = {
    {"ImageTexture", PLR_TEXTURE_2D, false, load_image},
    {"PixelTexture", PLR_TEXTURE_2D, false, load_image},
    {"MovieTexture", PLR_TEXTURE_2D, false, load_image},
    {"TransferFunction", PLR_TEXTURE_2D, false, load_image},
    {"ComposedCubeMapTexture", PLR_TEXTURE_CUBE, false, load_cube},
    {"ImageCubeMapTexture", PLR_TEXTURE_CUBE, false, load_cube},
    {"ImageTexture3D", PLR_TEXTURE_3D, false, load_volume},
    {"PixelTexture3D", PLR_TEXTURE_3D, false, load_volume},
    {"ComposedTexture3D", PLR_TEXTURE_3D, false, load_volume},
    {"ImageTextureAtlas", PLR_TEXTURE_3D, false, load_volume},
    {"RenderedTexture", PLR_TEXTURE_2D, true, generate_picture},
    {"GeneratedCubeMapTexture", PLR_TEXTURE_CUBE, true, generate_square},
    {"GeneratedShadowMap", PLR_TEXTURE_2D_SHADOW, true, generate_shadow_map},
};

/* What stands in for an image that cannot be had: one white texel. */
static void stand_in(plr_texture *texture) {
    bool cube = plr_texture_dimensions(texture) == PLR_TEXTURE_CUBE;
    size_t bytes = cube ? 24 : 4;
    texture->image = (plr_image){.width = 1,
                                 .height = 1,
                                 .depth = cube ? 6 : 1,
                                 .components = 4,
                                 .type = PLR_UNORM8,
                                 .samples = malloc(bytes),
                                 .cube = cube};
    if (texture->image.samples)
        memset(texture->image.samples, 255, bytes);
}

/* ---- Memory ---- */

static size_t bytes_of(const plr_texture *texture) {
    const plr_image *image = &texture->image;
    size_t faces = plr_texture_dimensions(texture) == PLR_TEXTURE_CUBE ? 6 : 1, samples = 0;
    if (texture->generated)
        return (size_t)texture->width * texture->height * faces * (texture->depth ? 4 : 8);
    for (uint32_t level = 0; level <= image->mipmaps; level++)
        samples += plr_image_level_samples(image, level);
    bool widened = image->type == PLR_UNORM8; /* bytes go up as 16 bits */
    return samples * plr_image_sample_size(widened ? PLR_UNORM16 : image->type);
}

/* Whether it fits beside the others; reports if not. */
static bool take_memory(plr_textures *t, plr_texture *texture) {
    size_t most = t->max_bytes ? t->max_bytes : PLR_TEXTURES_MAX_BYTES;
    texture->bytes = bytes_of(texture);
    if (texture->bytes <= most && t->bytes <= most - texture->bytes) {
        t->bytes += texture->bytes;
        return true;
    }
    plr_diags_add(t->diags, PLR_CODE_LIMIT, plr_node_place(texture->node),
                  "the textures of the scene need more than %zu MiB; this one is left out",
                  most >> 20);
    texture->bytes = 0;
    texture->width = texture->height = 1;
    plr_image_free(&texture->image);
    return false;
}

bool plr_texture_load(plr_textures *t, plr_texture *texture) {
    const struct loader *loader = NULL;
    for (size_t i = 0; !loader && i < sizeof loaders / sizeof *loaders; i++)
        if (plr_node_is(texture->node, loaders[i].type))
            loader = &loaders[i];
    if (!loader)
        return false;
    texture->kind = loader->kind;
    texture->generated = loader->generated;
    texture->failed = !loader->load(t, texture) || !take_memory(t, texture);
    plr_texture_alpha found = PLR_ALPHA_OPAQUE;
    if (texture->generated) {
        texture->components = texture->depth ? 1 : 4;
    } else {
        if (texture->failed)
            stand_in(texture);
        texture->components = texture->image.components;
        texture->width = texture->image.width;
        texture->height = texture->image.height;
        found = find_alpha(&texture->image);
    }
    texture->alpha = alpha_of(texture->node, found);
    return true;
}
