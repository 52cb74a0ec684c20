/* The scene graph flattened: what is drawn, where, lit and affected by what. No GL. */
#ifndef PLR_ENGINE_TRAVERSE_H
#define PLR_ENGINE_TRAVERSE_H

#include <plugray/engine.h>
#include "base/arena.h"
#include "base/matrix.h"

typedef struct plr_light {
    plr_node *node; /* NULL: a headlight as the standard has it */
    plr_matrix to_world;
    bool in_eye_space; /* a headlight: it goes with the viewer */
    bool off;          /* general programs have it all the same */
} plr_light;

typedef struct plr_lights {
    plr_light *items;
    size_t count, capacity;
} plr_lights;

typedef struct plr_nodes {
    plr_node **items;
    size_t count, capacity;
} plr_nodes;

/* A node in its place: a fog, a clip plane. */
typedef struct plr_placed {
    plr_node *node; /* or NULL */
    plr_matrix to_world;
    bool off; /* of a clip plane: general programs have it all the same */
} plr_placed;

typedef struct plr_placed_list {
    plr_placed *items;
    size_t count, capacity;
} plr_placed_list;

/* What a group gives to everything inside it, siblings before included. */
typedef struct plr_scope {
    const struct plr_scope *outer; /* NULL at the top level */
    plr_lights lights;             /* with global FALSE, those that are off, too */
    plr_nodes effects;
    plr_placed fog; /* the first LocalFog that is enabled */
    plr_placed_list clip_planes;
} plr_scope;

/* A volume or a shape in its place. */
typedef struct plr_leaf {
    plr_node *node;
    plr_matrix to_world;
    const plr_scope *scope;
} plr_leaf;

typedef struct plr_leaves {
    plr_leaf *items;
    size_t count, capacity;
} plr_leaves;

typedef struct plr_viewpoint {
    plr_node *node;      /* NULL: the standard's default */
    plr_matrix to_world; /* without scale */
    double limit;        /* NavigationInfo's visibilityLimit, or 0 */
} plr_viewpoint;

typedef struct plr_flat {
    plr_leaves volumes, shapes;
    plr_lights global_lights; /* the headlight among them; those that are off, too */
    plr_lights all_lights;    /* that have a place in the scene, those that are off, too */
    struct {
        plr_viewpoint *items;
        size_t count, capacity;
    } viewpoints;
    plr_viewpoint standard;            /* where there is none */
    plr_node *background, *navigation; /* the bound one of each, else the first, or NULL */
    plr_matrix background_to_world;
    plr_placed fog;         /* the first Fog */
    plr_node *tone_mapping; /* the first, or NULL */
    bool has_eye; /* somebody looks: levels of detail and billboards are as he sees them */
    plr_matrix eye_to_world;
    bool depends_on_viewer; /* there are such */
    bool projective;        /* some shape stands in a space that is no affine one */
} plr_flat;

/* Flattens the scene; everything is allocated in the arena. Nodes that cannot be drawn yet give a
 * `not-drawn` warning. `eye_to_world` NULL: nobody looks. */
void plr_flatten(plr_arena *arena, plr_scene *scene, const plr_matrix *eye_to_world, plr_flat *flat,
                 plr_diags *diags);
/* Flattens one node and what is inside it, in world coordinates of its own. The global lights
 * around it light it, too; the headlight is as around where it has no NavigationInfo. */
void plr_flatten_node(plr_arena *arena, plr_scene *scene, plr_node *node, const plr_flat *around,
                      plr_flat *flat, plr_diags *diags);

/* The viewpoint that `selector` names: NULL or "" the first, a number from 1, a DEF name, a
 * description; NULL if there is none such. */
const plr_viewpoint *plr_flat_viewpoint(const plr_flat *flat, const char *selector);
/* The one that is bound, where events have bound one; else `chosen`. */
const plr_viewpoint *plr_flat_bound(const plr_flat *flat, const plr_viewpoint *chosen);

/* Projection and world -> eye for a picture of this shape. near and far must hold the depths of
 * what is drawn with a depth buffer; the viewpoint's own distances override them. */
void plr_viewpoint_matrices(const plr_viewpoint *viewpoint, double width, double height,
                            const double depths[2], plr_matrix *projection, plr_matrix *view);
/* The cut that the viewpoint asks for: its nearDistance and farDistance, else the limit of what is
 * visible; or 0 and INFINITY. */
void plr_viewpoint_cut(const plr_viewpoint *viewpoint, double cut[2]);

#endif
