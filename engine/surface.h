/* A shape on its way to a program: what adds built-in effects to its recipe, one file a subject. */
#ifndef PLR_ENGINE_SURFACE_H
#define PLR_ENGINE_SURFACE_H

#include "engine/view.h"

/* Texture coordinates in use: castle_TexCoord<index> of the program. */
typedef struct plr_channel {
    unsigned unit;              /* of the geometry's coordinates */
    plr_node *node, *transform; /* texture coordinates and their transformation, or NULL */
    int dimensions;             /* of the texture that they were asked for */
    bool projective, reflects;
} plr_channel;

typedef struct plr_shape {
    plr_view *view;
    plr_model *model; /* its mesh is built */
    const plr_leaf *leaf;
    plr_node *appearance, *geometry; /* or NULL */
    plr_recipe *recipe;
    plr_diags *diags;
    bool lit; /* has normals: light may change it */
    plr_texture_alpha alpha;
    size_t material; /* attaches further built-in effects to the material's; 0: none */
    plr_channel channels[PLR_MESH_TEX_UNITS];
    size_t channel_count;
} plr_shape;

/* A built-in effect by path, named as messages and targets say, bound to a node (NULL: to none).
 * Returns what attaches others to it, 0 if there is none of that path. */
size_t plr_shape_effect(plr_shape *shape, const char *path, const char *name, plr_node *node,
                        size_t attached, const plr_define *extra, size_t extra_count);
/* A macro of this effect alone, for plr_shape_effect; the value is copied. */
plr_define plr_shape_define(plr_shape *shape, const char *name, int value);

/* What gives the surface its colours: a CommonSurfaceShader among the shaders of the Appearance,
 * else its material; or NULL. */
plr_node *plr_shape_material_node(const plr_shape *shape);

/* ---- In the order of calls ---- */

void plr_shape_material(plr_shape *shape);
void plr_shape_textures(plr_shape *shape);
/* Instead, of a shape with an author's complete shader, where that shader takes them. */
void plr_shape_complete_textures(plr_shape *shape);
/* The same of fog: where it has the plugs vertex_eye_space and fog_apply. */
void plr_shape_complete_surroundings(plr_shape *shape);
/* Normals and heights from textures. */
void plr_shape_bumps(plr_shape *shape);
void plr_shape_lights(plr_shape *shape);
/* Patterns of lines and areas, sizes of points, the test of alpha. */
void plr_shape_properties(plr_shape *shape);
/* Fog, clip planes, tone mapping and gamma. */
void plr_shape_surroundings(plr_shape *shape);
/* Fog for a complete shader, which has no places of the base's own. */
void plr_shape_complete_fog(plr_shape *shape);

/* ---- State beside the program ---- */

/* How the shape shows what lies behind it: by its appearance, its material, its textures. */
plr_texture_alpha plr_shape_alpha(const plr_shape *shape);

#endif
