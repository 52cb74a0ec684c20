/* Texture nodes as images, then as GL textures. Loaded once for each node. */
#ifndef PLR_ENGINE_TEXTURE_H
#define PLR_ENGINE_TEXTURE_H

#include "base/arena.h"
#include "engine/gl.h"
#include "engine/image.h"

typedef struct plr_texture {
    const plr_node *node; /* NULL: made by the engine */
    int dimensions;       /* 2 or 3 */
    uint32_t components;
    bool failed;      /* reported; a white texel stands in */
    bool translucent; /* some alpha is below 1 */
    bool voxels;     /* missing components read 0, the fourth 1; else L and LA read as L, L, L, A */
    plr_image image; /* freed by the upload */
    GLuint name;     /* 0: not uploaded */
} plr_texture;

typedef struct plr_textures {
    plr_arena *arena;
    plr_scene *scene;
    plr_diags *diags;
    const plr_gl *gl; /* NULL: never uploaded */
    struct {
        plr_texture **items;
        size_t count, capacity;
    } list;
    GLuint clamping; /* a sampler object for transfer functions and voxels: linear, clamped */
} plr_textures;

/* The texture of a node, loaded now if it is not yet; NULL if the node is no texture. */
plr_texture *plr_textures_get(plr_textures *textures, const plr_node *node);
/* The texture in a node's field, where there is one and it could be had; else NULL. */
plr_texture *plr_textures_in(plr_textures *textures, const plr_node *node, const char *field);
/* A texture that the engine makes from an image (which it takes over). */
plr_texture *plr_textures_make(plr_textures *textures, plr_image *image, int dimensions,
                               bool voxels);
/* Uploads what is not uploaded yet. Needs GL. False if GL refuses. */
bool plr_textures_upload(plr_textures *textures);
/* Binds to a texture unit, with the clamping sampler or the node's own repetition. Needs GL. */
void plr_texture_bind(const plr_textures *textures, const plr_texture *texture, unsigned unit,
                      bool clamp);
/* Frees images and GL names. Needs GL if there is one. */
void plr_textures_finish(plr_textures *textures);

#endif
