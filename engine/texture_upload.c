/* Textures as GL objects. Needs GL. */
#include "engine/image_internal.h"
#include "engine/texture_internal.h"

#include <stdlib.h>
#include <string.h>

/* 8-bit samples go up as 16-bit ones (v * 257, the same value): some drivers filter 8-bit textures
 * in 8-bit arithmetic, which is seen in volumes and transfer functions. Not so those that nothing
 * filters. */
static uint16_t *widen(const uint8_t *samples, size_t count) {
    uint16_t *wide = malloc(count * sizeof *wide);
    for (size_t i = 0; wide && i < count; i++)
        wide[i] = (uint16_t)(samples[i] * 257u);
    return wide;
}

static const GLenum formats[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};

/* How samples go up, by the type that they have then. */
static const struct {
    GLenum inner[4]; /* by components */
    GLenum type;
} uploads[] = {
    [PLR_UNORM8] = {{GL_R8, GL_RG8, GL_RGB8, GL_RGBA8}, GL_UNSIGNED_BYTE},
    [PLR_UNORM16] = {{GL_R16, GL_RG16, GL_RGB16, GL_RGBA16}, GL_UNSIGNED_SHORT},
    [PLR_FLOAT32] = {{GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F}, GL_FLOAT},
    [PLR_UINT8] = {{GL_R8UI}, GL_UNSIGNED_BYTE},
    [PLR_UINT16] = {{GL_R16UI}, GL_UNSIGNED_SHORT},
    [PLR_UINT32] = {{GL_R32UI}, GL_UNSIGNED_INT},
};

static GLsizei halved(uint32_t side, uint32_t level) {
    uint32_t half = level < 32 ? side >> level : 0;
    return half ? (GLsizei)half : 1;
}

/* Storage of one level, filled from `samples` where there are some. */
static void define_level(const plr_gl *gl, const plr_texture *texture, GLint level, GLint inner,
                         GLenum format, GLenum type, const char *samples, size_t face_bytes) {
    GLsizei width = halved(texture->width, (uint32_t)level);
    GLsizei height = halved(texture->height, (uint32_t)level);
    switch (plr_texture_dimensions(texture)) {
    case PLR_TEXTURE_3D:
        gl->TexImage3D(GL_TEXTURE_3D, level, inner, width, height,
                       halved(texture->image.depth, (uint32_t)level), 0, format, type, samples);
        break;
    case PLR_TEXTURE_CUBE:
        for (GLuint face = 0; face < 6; face++)
            gl->TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, level, inner, width, height, 0,
                           format, type, samples ? samples + face * face_bytes : NULL);
        break;
    default:
        gl->TexImage2D(GL_TEXTURE_2D, level, inner, width, height, 0, format, type, samples);
        break;
    }
}

static bool is_labels(const plr_texture *texture) {
    return texture->kind == PLR_TEXTURE_3D_LABELS;
}

static bool define_image(const plr_gl *gl, plr_texture *texture) {
    const plr_image *image = &texture->image;
    bool widens = image->type == PLR_UNORM8 && !texture->numbers;
    plr_sample_type sent = widens ? PLR_UNORM16 : image->type;
    GLint inner = (GLint)uploads[sent].inner[image->components - 1];
    GLenum format = is_labels(texture) ? GL_RED_INTEGER : formats[image->components - 1];
    const char *samples = image->samples;
    for (uint32_t level = 0; level <= image->mipmaps; level++) {
        size_t count = plr_image_level_samples(image, level);
        uint16_t *wide = NULL;
        if (widens && !(wide = widen((const uint8_t *)samples, count)))
            return false;
        size_t bytes = count * plr_image_sample_size(sent);
        define_level(gl, texture, (GLint)level, inner, format, uploads[sent].type,
                     wide ? (const char *)wide : samples, bytes / 6);
        free(wide);
        samples += count * plr_image_sample_size(image->type);
    }
    return true;
}

static void define_generated(const plr_gl *gl, const plr_texture *texture) {
    if (texture->depth)
        define_level(gl, texture, 0, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, NULL, 0);
    else
        define_level(gl, texture, 0, GL_RGBA16F, GL_RGBA, GL_FLOAT, NULL, 0);
}

/* L and LA read as L, L, L, A; so do depths. */
static void set_swizzle(const plr_gl *gl, const plr_texture *texture, GLenum target) {
    if (texture->voxels || texture->components > 2)
        return;
    GLint alpha = texture->components == 2 ? GL_GREEN : GL_ONE;
    const GLint swizzle[] = {GL_RED, GL_RED, GL_RED, alpha};
    gl->TexParameteriv(target, GL_TEXTURE_SWIZZLE_RGBA, swizzle);
}

/* Without a sampler object: linear or nearest, no mipmaps but those of the file. */
static void set_parameters(const plr_gl *gl, const plr_texture *texture, GLenum target) {
    static const GLenum wraps[] = {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R};
    for (int i = 0; i < 3; i++)
        gl->TexParameteri(target, wraps[i], GL_CLAMP_TO_EDGE);
    /* integers have no other */
    GLint filter = is_labels(texture) || texture->numbers ? GL_NEAREST : GL_LINEAR;
    gl->TexParameteri(target, GL_TEXTURE_MIN_FILTER, filter);
    gl->TexParameteri(target, GL_TEXTURE_MAG_FILTER, filter);
    gl->TexParameteri(target, GL_TEXTURE_MAX_LEVEL, (GLint)texture->image.mipmaps);
    set_swizzle(gl, texture, target);
}

/* ---- Limits of GL ---- */

static void find_limits(const plr_gl *gl, const plr_texture *texture, uint32_t limits[3]) {
    int dimensions = plr_texture_dimensions(texture);
    GLint most = 1024;
    gl->GetIntegerv(dimensions == PLR_TEXTURE_3D     ? GL_MAX_3D_TEXTURE_SIZE
                    : dimensions == PLR_TEXTURE_CUBE ? GL_MAX_CUBE_MAP_TEXTURE_SIZE
                                                     : GL_MAX_TEXTURE_SIZE,
                    &most);
    limits[0] = limits[1] = most < 1 ? 1 : (uint32_t)most;
    limits[2] = dimensions == PLR_TEXTURE_3D ? limits[0] : 6;
}

/* A texture that GL cannot hold is made smaller: coordinates go from 0 to 1 all the same. */
static bool fit(plr_textures *t, plr_texture *texture) {
    uint32_t limits[3];
    find_limits(t->gl, texture, limits);
    if (!texture->node || (texture->width <= limits[0] && texture->height <= limits[1] &&
                           texture->image.depth <= limits[2]))
        return true;
    plr_diags_add_as(
        t->diags, PLR_WARNING, PLR_CODE_LIMIT, plr_node_place(texture->node),
        "GL takes textures of at most %u texels a side; one of %u x %u is made smaller", limits[0],
        texture->width, texture->height);
    texture->width = texture->width < limits[0] ? texture->width : limits[0];
    texture->height = texture->height < limits[1] ? texture->height : limits[1];
    return texture->generated || plr_image_shrink(&texture->image, limits);
}

/* ---- All ---- */

bool plr_texture_upload(plr_textures *t, plr_texture *texture) {
    const plr_gl *gl = t->gl;
    if (!fit(t, texture))
        return false;
    GLenum target = plr_texture_target(texture->kind);
    while (gl->GetError() != GL_NO_ERROR)
        ;
    gl->GenTextures(1, &texture->name);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(target, texture->name);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    bool fine = true;
    if (texture->generated)
        define_generated(gl, texture);
    else
        fine = define_image(gl, texture);
    set_parameters(gl, texture, target);
    plr_texture_make_samplers(t, texture);
    fine = fine && gl->GetError() == GL_NO_ERROR;
    texture->stale_mipmaps = texture->image.mipmaps == 0;
    if (!texture->keeps_image)
        plr_image_free(&texture->image);
    return fine;
}

void plr_texture_drawn(plr_texture *texture) {
    texture->stale_mipmaps = true;
}
