/* What one program is made of: base, built-in effects, authors' effects, in the order of calls,
 * with the node that each takes its uniforms from. No GL. */
#ifndef PLR_ENGINE_RECIPE_H
#define PLR_ENGINE_RECIPE_H

#include "base/arena.h"
#include "engine/catalog.h"
#include "base/matrix.h"
#include "engine/texture.h"
#include "engine/traverse.h"

/* What an effect is bound to. */
typedef struct plr_binding {
    plr_node *node;          /* its fields give the uniforms; NULL: initialisers stand */
    plr_matrix to_world;     /* of the node */
    const plr_matrix *place; /* where that is taken from when things move; NULL: it stays */
    bool in_eye_space;       /* to_world is the identity of eye space (headlight) */
    size_t volume;           /* index of the volume that it belongs to, or PLR_NO_EFFECT */
    bool is_light;           /* the effect of a light itself */
    plr_texture *texture;    /* what the sampler `self` reads; NULL: the texture of the node */
    const struct plr_shadow_values *shadow; /* of an effect that reads a shadow map; or NULL */
    const struct plr_grid *grid;            /* of an effect that reads voxels; or NULL */
    const struct plr_atlas_place *function; /* where its transfer function is; or NULL */
    int number;  /* of the segment or surface whose styles it is around */
    bool gated;  /* of a general program: a uniform says whether it is on (engine/general.h) */
    bool closed; /* it is not */
} plr_binding;

typedef struct plr_recipe {
    struct {
        plr_effect *items;
        size_t count, capacity;
    } effects;
    struct {
        plr_binding *items;
        size_t count, capacity;
    } bindings; /* parallel to effects */
    struct {
        plr_define *items;
        size_t count, capacity;
    } defines;             /* for all units */
    const char *primitive; /* what it draws: see plr_link_desc; or NULL */
    bool casts_rays;       /* textures are read in a loop along a ray */
    bool sees_lights;      /* effects of authors may know the lights */
    plr_sources base;
    plr_node
        *base_node; /* an author's complete shader: its fields give the base's uniforms; or NULL */
} plr_recipe;

/* Sources of authors' parts, read once for each part node. */
typedef struct plr_kitchen {
    plr_arena *arena;   /* of recipes: renewed when the scene changes */
    plr_arena *lasting; /* of what is kept then */
    plr_scene *scene;
    const plr_catalog *catalog;
    plr_textures *textures;
    plr_diags *diags;
    struct part {
        const plr_node *node;
        plr_source *source; /* NULL: could not be read, reported */
    } * parts;
    size_t part_count, part_capacity;
} plr_kitchen;

void plr_kitchen_finish(plr_kitchen *kitchen);

void plr_recipe_define(plr_kitchen *kitchen, plr_recipe *recipe, const char *name, int value);
/* A built-in effect by path ("lights/PointLight"; of several, separated by blanks, the units of
 * all, if there are any of the first), called as messages and targets say (`name`), with macros
 * made from the fields of the node and `extra` ones. `attached` as in plr_effect. Returns the value
 * that attaches another effect to this one, 0 if there is no such effect. */
size_t plr_recipe_builtin(plr_kitchen *kitchen, plr_recipe *recipe, const char *path,
                          const char *name, plr_binding binding, size_t attached,
                          const plr_define *extra, size_t extra_count);
/* An author's Effect node; nothing if it is disabled or in another language. */
void plr_recipe_author(plr_kitchen *kitchen, plr_recipe *recipe, plr_node *effect, size_t attached,
                       size_t volume);
/* The nodes of an MFNode field `effects`. */
void plr_recipe_author_list(plr_kitchen *kitchen, plr_recipe *recipe, const plr_node *owner,
                            size_t attached, size_t volume);
/* The effects in the fields `effects` of all nodes of an abstract type (lights, textures) that
 * built-in effects of the recipe stand for, attached to these. */
void plr_recipe_attached_authors(plr_kitchen *kitchen, plr_recipe *recipe, const char *type);
/* The effects of the groups around a leaf, from inner to outer. */
void plr_recipe_groups(plr_kitchen *kitchen, plr_recipe *recipe, const plr_scope *scope,
                       size_t attached, size_t volume);
/* The units of an author's complete shader as the base; false if none of it can be read. */
bool plr_recipe_shader_base(plr_kitchen *kitchen, plr_recipe *recipe, plr_node *shader);

#endif
