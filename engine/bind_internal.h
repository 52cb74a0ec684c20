/* What the files of engine/bind*.c share. */
#ifndef PLR_ENGINE_BIND_INTERNAL_H
#define PLR_ENGINE_BIND_INTERNAL_H

#include "engine/bind.h"

/* ---- GLSL types and the field types that fit them (bind_types.c) ---- */

typedef enum plr_glsl_shape {
    SHAPE_FLOAT,
    SHAPE_INT,
    SHAPE_MATRIX,
    SHAPE_SAMPLER
} plr_glsl_shape;

typedef struct plr_glsl_type {
    const char *name;
    plr_glsl_shape shape;
    int components;     /* of samplers: the kind of texture that they read */
    const char *fields; /* element types that may be bound, without SF or MF */
} plr_glsl_type;

/* NULL for types that nothing is bound to. */
const plr_glsl_type *plr_glsl_type_find(const char *name);
/* The sampler type that reads textures of a kind. */
const char *plr_glsl_sampler_name(plr_texture_kind kind);
/* Whether a uniform of this type (NULL: of none), an array or not, takes the field. */
bool plr_field_fits(const plr_field *field, const plr_glsl_type *type, bool array);

/* ---- Values that the engine knows (bind_values.c) ---- */

typedef struct plr_known_context {
    const plr_values *values;
    const plr_binding *binding; /* NULL: base or library */
    const plr_volume_state *volume;
} plr_known_context;

typedef enum plr_known_owner {
    OWNER_HOST,     /* base and library */
    OWNER_NODE,     /* a built-in effect with a node or the headlight */
    OWNER_VOLUME,   /* a built-in effect of a volume */
    OWNER_FUNCTION, /* a built-in effect whose transfer function is in the atlas */
    OWNER_GRID,     /* a built-in effect that reads voxels */
    OWNER_SHADOW,   /* the effect of a shadow map */
} plr_known_owner;

typedef struct plr_known {
    const char *name;
    plr_known_owner owner;
    void (*value)(const plr_known_context *, float *);
} plr_known;

/* The value that goes by this name in an effect that is bound so (NULL: base or library); or NULL.
 */
const plr_known *plr_known_find(const char *name, const plr_binding *binding);

#endif
