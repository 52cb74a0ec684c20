/* Uniforms: from fields, from the frame, from the volume. */
#ifndef PLR_ENGINE_BIND_H
#define PLR_ENGINE_BIND_H

#include "engine/compose.h"

/* What every program of one picture shares. */
typedef struct plr_frame {
    plr_matrix projection, view;
    double viewport[4]; /* x, y, width, height in pixels */
    double cut[2];      /* the viewpoint's own near and far distance, or 0 and infinity */
    double time;
    GLuint opaque_depth; /* depth texture of opaque surfaces, 0: none */
    GLuint part_start; /* of translucent surfaces that divide rays; 0: the part starts at the eye */
    GLuint part_end;   /* opaque_depth: the part ends with the ray */
    /* The depth buffer holds near / distance: 0 is infinitely far. Relative precision is then that
     * of a float at any distance, without a far plane. Else it is GL's own. */
    bool reversed_depth;
} plr_frame;

/* What the effect of a shadow map needs to read it, in the picture that is drawn. */
typedef struct plr_shadow_values {
    plr_texture *texture;
    plr_matrix from_world; /* to 0..1 in the map; of a cube: to the light's place */
    double axis[3];        /* across the map, in the world, length 1 */
    double texel;          /* a texel's side, divided by w; of a cube: at distance 1 */
    double depths[2];      /* of a cube: depth is the first plus the second over the distance */
    double offset;         /* 0: the depths in the map are set back */
    double depth_bias;
} plr_shadow_values;

/* Voxels on a grid in the box of a volume: its own, or those that a style blends with it. */
typedef struct plr_grid {
    const plr_node *node; /* that has the field `voxels` */
    plr_texture *voxels;
    uint32_t size[3];
    double range[2];      /* the physical values that are 0 and 1 */
    bool bytes;           /* the voxels are bytes, whatever they are held as */
    double dimensions[3]; /* of the box, own coordinates */
    double gradient_unit; /* 0: not asked for yet */
    /* Voxels that no texture holds are cast in bricks of so many; 0: they are not. What follows is
     * of the brick that is drawn. */
    uint32_t brick_sides[3];
    plr_texture *brick;
    double brick_box[2][3];                /* in texture coordinates of the whole */
    double brick_scale[3], brick_shift[3]; /* from these to the brick's texture */
} plr_grid;

/* What a volume does along a ray. */
typedef enum plr_volume_kind {
    PLR_VOLUME_FILLED,   /* samples in steps */
    PLR_VOLUME_SURFACES, /* surfaces of equal value */
    PLR_VOLUME_PROJECTED /* one intensity */
} plr_volume_kind;

/* The same in GLSL: MOST_SURFACES. */
#define PLR_MOST_SURFACES 256

/* A volume made ready. */
typedef struct plr_volume_state {
    plr_node *node;
    plr_matrix to_world;   /* of its box */
    plr_matrix file_place; /* box to the node's coordinates: as its file says, or the identity */
    double dimensions[3];
    double voxel;     /* geometric mean of a voxel's sides, own coordinates */
    double reference; /* reference length of opacity */
    double step;      /* sample distance, own coordinates */
    size_t index;
    /* What effects of authors do with its samples (volume_skip.c). */
    bool authors_act;         /* some effect does anything */
    bool authors_colour_only; /* all promise that they change colours alone */
    bool authors_see_all;     /* some effect may make visible what is clear: it needs all samples */
    bool general;             /* of a general world: what is switched off counts, too */
    bool hidden;              /* all its styles are switched off */
    plr_grid *grid;
    plr_texture *labels;      /* segment numbers; or NULL */
    plr_texture *cell_labels; /* that cells have in common; or NULL */
    plr_volume_kind kind;
    float (*surfaces)[2]; /* value, ascending, and number; of PLR_VOLUME_SURFACES */
    size_t surface_count;
    float (*maps)[4]; /* of segments that have a transfer function and no more; or NULL */
    size_t map_count;
    uint64_t hash;                   /* of the voxels */
    const struct plr_blocks *blocks; /* of voxels of one component; or NULL */
    const struct plr_bends *bends;   /* of these; or NULL */
    /* Of a volume that one transfer function alone makes visible, and how far it is from each block
     * to the next where it makes anything visible; or NULL. */
    struct plr_table *table;
    bool styled;            /* and styles or fog change what it makes visible */
    plr_texture *integrals; /* of the table */
    plr_texture *gradients; /* at the centres of voxels; or NULL */
    plr_texture *quads;     /* values of four voxels a texel; or NULL */
    plr_texture *places;    /* where styles look; or NULL */
    plr_texture *sums;      /* the same from 0 on */
    plr_texture *ranges;    /* bounds of it */
    float seen[2];          /* outside of this open interval the table has nothing */
    size_t full_blocks;     /* where it does */
    double visible[2][3]; /* the box of these, 0 to 1; that of all where nothing may be left out */
    plr_texture *leaps;
    const uint32_t *leap_sides; /* what it holds: plr_blocks_leaps */
    bool leaping;               /* past samples in the middle of steps, by these */
} plr_volume_state;

/* A convex outline in the picture. */
#define PLR_MOST_HULL 48
typedef struct plr_hull {
    float points[PLR_MOST_HULL][2]; /* clip coordinates */
    int count;
} plr_hull;

/* Everything that the value of a uniform may depend on. */
typedef struct plr_values {
    const plr_frame *frame;
    struct plr_view *view; /* that the frame shows; for projectors */
    plr_matrix to_world;   /* of what is drawn */
    double ray_plane;      /* how far before the eye rays through volumes begin; a float */
    const plr_volume_state *volumes;
    size_t volume_count;
    plr_texture *functions; /* the transfer functions of the volumes, in one texture */
    double error;           /* of the integral along a ray */
    const plr_hull *hull;   /* of rays through volumes; or NULL */
} plr_values;

/* One uniform of a GL program and where its value comes from. */
typedef struct plr_slot plr_slot;

typedef struct plr_slots {
    plr_slot *items;
    size_t count, capacity;
    /* Set where some uniform has no source: its initialiser stands, whoever used the program
     * before. */
    const plr_defaults *defaults;
} plr_slots;

/* Compares the fields of authors' effects with the uniforms of the program: an effect whose types
 * (or kinds of textures) differ is reported and disabled (then true is returned: link again);
 * partners that lack are warned of. No GL. */
bool plr_bind_check(plr_kitchen *kitchen, plr_recipe *recipe, const plr_program *program);
/* The same for the number of samplers: the effect with the first one too many is left out. */
bool plr_bind_check_samplers(plr_kitchen *kitchen, plr_recipe *recipe, const plr_program *program);

/* Finds the locations. Needs GL. */
void plr_bind_find(plr_kitchen *kitchen, const plr_gl *gl, const plr_recipe *recipe,
                   const plr_program *program, const plr_built *built, plr_slots *slots);
/* Whether any slot takes a value that the engine knows by this name ("gradientUnit"). */
bool plr_bind_needs(const plr_slots *slots, const char *name);
/* The textures of the samplers, one a call, from *at = 0 on; NULL after the last. */
const plr_texture *plr_bind_next_texture(const plr_slots *slots, size_t *at);
/* Whether any sampler reads this texture. */
bool plr_bind_reads(const plr_slots *slots, const plr_texture *texture);
/* Sets all uniforms of the program in use and binds its textures. Needs GL. */
void plr_bind_set(const plr_gl *gl, plr_textures *textures, const plr_slots *slots,
                  const plr_values *values);

#endif
