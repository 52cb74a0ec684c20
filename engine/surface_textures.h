/* Textures of a shape as effects: what other subjects than textures need of them. */
#ifndef PLR_ENGINE_SURFACE_TEXTURES_H
#define PLR_ENGINE_SURFACE_TEXTURES_H

#include "engine/surface.h"

/* Adds the effect `path`, bound to `owner` and named as its field, which gives the texture in that
 * field a meaning: it offers the plug texture_value (value), where the sampled texture arrives. The
 * field with "Mapping" behind its name chooses the texture coordinates. Nothing where the field has
 * no texture. Returns what attaches further effects to the texture, else 0. */
size_t plr_shape_field_texture(plr_shape *shape, plr_node *owner, const char *field,
                               const char *path, const plr_define *extra, size_t extra_count);

/* The most that the textures which make the colour before light ask for: of the material, else of
 * the Appearance. */
plr_texture_alpha plr_shape_texture_alpha(const plr_shape *shape);

/* ---- Coordinates (surface_coordinates.c) ---- */

/* How a texture finds its coordinates: castle_TexCoord<channel>. */
typedef struct plr_coordinates {
    int channel; /* -1: there are no more */
    bool projective, reflected;
} plr_coordinates;

/* Coordinates for a texture that a MultiTexture or an Appearance has at `unit`. */
plr_coordinates plr_shape_unit_coordinates(plr_shape *shape, unsigned unit, int dimensions);
/* Coordinates by the name in a field `mapping` of texture coordinates and their transformations;
 * "" is the first of both. `place` is where an unknown name is warned of. */
plr_coordinates plr_shape_named_coordinates(plr_shape *shape, const char *mapping, int dimensions,
                                            plr_place place);
/* Attaches to a texture what makes reflected coordinates for each fragment. */
void plr_shape_reflect(plr_shape *shape, int channel, size_t texture);
/* The channels of the textures of the Appearance, and of what the geometry has beside, which an
 * effect may read: castle_TexCoord<unit>. All other channels come after them. */
void plr_shape_main_coordinates(plr_shape *shape);
/* How many units the main textures have, and the dimensions of each: -1 where there is none. */
size_t plr_shape_units(const plr_shape *shape, int dimensions[PLR_MESH_TEX_UNITS]);

#endif
