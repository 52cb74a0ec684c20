/* Texture nodes as images, then as GL textures. Loaded once for each node. */
#ifndef PLR_ENGINE_TEXTURE_H
#define PLR_ENGINE_TEXTURE_H

#include "base/arena.h"
#include "engine/gl.h"
#include "engine/image.h"

/* What sampler reads a texture. The lowest three bits are the number that effects see as the macro
 * f_DIMENSIONS: 2, 3, or 6 for the faces of a cube. */
typedef enum plr_texture_kind {
    PLR_TEXTURE_2D = 2,
    PLR_TEXTURE_3D = 3,
    PLR_TEXTURE_CUBE = 6,
    PLR_TEXTURE_2D_SHADOW = 8 | 2,
    PLR_TEXTURE_CUBE_SHADOW = 8 | 6,
    PLR_TEXTURE_3D_LABELS = 16 | 3 /* whole numbers, read by usampler3D; never filtered */
} plr_texture_kind;

/* Sides of textures that the engine draws into; GL may know a lower limit. */
#define PLR_TEXTURE_MAX_SIDE 16384

/* How what lies behind shows through. */
typedef enum plr_texture_alpha {
    PLR_ALPHA_OPAQUE,  /* no alpha below 1 */
    PLR_ALPHA_TEST,    /* 0 or 1: a texel is there or it is not */
    PLR_ALPHA_BLENDING /* anything between */
} plr_texture_alpha;

/* How a program reads a texture. */
typedef enum plr_texture_use {
    PLR_USE_SURFACE, /* as the node says: repetition, filters, mipmaps */
    PLR_USE_VOLUME,  /* the same without mipmaps: a loop along a ray has no derivatives */
    PLR_USE_CLAMPED  /* linear, clamped: transfer functions and voxels; labels: nearest */
} plr_texture_use;

typedef struct plr_texture {
    const plr_node *node; /* NULL: made by the engine */
    plr_texture_kind kind;
    uint32_t components;
    bool failed; /* reported; a white texel stands in */
    plr_texture_alpha alpha;
    bool voxels; /* missing components read 0, the fourth 1; else L and LA read as L, L, L, A */
    /* No image: the engine draws into it, `width` by `height` texels a face. Colours are RGBA16F;
     * `depth`: the values are depths, which shadow kinds compare and others read. */
    bool generated, depth;
    uint32_t width, height;   /* of the finest level */
    plr_image image;          /* freed by the upload */
    size_t bytes;             /* that GL needs for it, without mipmaps made by GL */
    GLuint name;              /* 0: not uploaded */
    GLuint samplers[2];       /* of the node, by use; 0: not made yet */
    bool mipmapped;           /* for PLR_USE_SURFACE */
    bool stale_mipmaps;       /* they are made when the texture is bound with them */
    uint64_t revision;        /* of its nodes, when it was loaded */
    double steepness;         /* of voxels: the gradient that counts as 1; 0: not asked for yet */
    bool numbers;             /* a table: texels are read one by one, never filtered */
    bool in_bricks;           /* never uploaded as a whole */
    bool keeps_image;         /* the image is wanted after the upload */
    bool kept;                /* made by the engine, and wanted again when the scene has changed */
    const plr_node *function; /* a TransferFunction with physical keys, baked for voxels of: */
    double range[2];
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
    size_t max_bytes; /* of the textures of all nodes together; 0: 4 GiB */
    size_t bytes;     /* that they have now */
    GLuint clamping;  /* a sampler object for transfer functions and voxels: linear, clamped */
} plr_textures;

/* 2, 3, or 6 for cubes: the macro f_DIMENSIONS. */
int plr_texture_dimensions(const plr_texture *texture);

/* The texture of a node, loaded now if it is not yet; NULL if the node is no texture of its own
 * (ShaderTexture and MultiTexture are none). Nodes that the engine draws into (RenderedTexture,
 * GeneratedCubeMapTexture, GeneratedShadowMap) give a texture that is `generated`. */
plr_texture *plr_textures_get(plr_textures *textures, const plr_node *node);
/* The texture in a node's field, where there is one and it could be had; else NULL. */
plr_texture *plr_textures_in(plr_textures *textures, const plr_node *node, const char *field);
/* A texture that the engine makes from an image (which it takes over). */
plr_texture *plr_textures_make(plr_textures *textures, plr_image *image, plr_texture_kind kind,
                               bool voxels);
/* A texture that the engine draws into, without a node: a shadow map of a light that names none. */
plr_texture *plr_textures_generate(plr_textures *textures, plr_texture_kind kind, bool depth,
                                   uint32_t width, uint32_t height);
/* Forgets what was loaded from a node whose fields have changed and loads it anew: the record stays
 * where it is, plr_textures_upload gives it a new name. Needs GL if there is one. */
void plr_textures_reload(plr_textures *textures, plr_texture *texture);
/* Frees what the engine made and does not want again. Needs GL if there is one. */
void plr_textures_sweep(plr_textures *textures);
/* Uploads what is not uploaded yet, allocates what is generated. Needs GL. False if GL refuses. */
bool plr_textures_upload(plr_textures *textures);
/* To be called after the engine drew into a generated texture: its mipmaps are made anew. */
void plr_texture_drawn(plr_texture *texture);
/* GL_TEXTURE_2D, GL_TEXTURE_3D or GL_TEXTURE_CUBE_MAP. */
GLenum plr_texture_target(plr_texture_kind kind);
/* Binds to a texture unit, with what the use asks for. Needs GL. */
void plr_texture_bind(plr_textures *textures, plr_texture *texture, unsigned unit,
                      plr_texture_use use);
/* Frees images and GL names. Needs GL if there is one. */
void plr_textures_finish(plr_textures *textures);

#endif
