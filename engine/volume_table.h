/* A transfer function as a table of integrals: what lies between two values, for all pairs of them.
 * The optical depth of a part of a ray along which the value runs evenly from one to the other. */
#ifndef PLR_ENGINE_VOLUME_TABLE_H
#define PLR_ENGINE_VOLUME_TABLE_H

#include "base/arena.h"
#include "engine/texture.h"

typedef struct plr_table {
    const float *texels; /* of the function: straight RGBA */
    uint32_t texel_count;
    uint32_t nodes;     /* values, evenly from 0 to 1, on which the texels of the function lie */
    double *depth;      /* at each node: extinction integrated from 0 on, per reference length */
    double (*color)[3]; /* the same times colour */
    uint32_t *visible;  /* of how many of the spans before a node anything can be seen */
    bool tame;          /* no steeper, and told apart no finer, than bounds hold for */
    bool gentle;        /* of sums: straight from node to node */
    bool clips;         /* so much of it is clear that rays are clipped to what is not */
    int walls;          /* ranges of values that are opaque */
    float wall[2];      /* from the least to the greatest of these */
    float wall_colors[2][4];
    plr_texture *texture; /* x: the one value, y: the other; mean colour * extinction, extinction */
    plr_texture *sums;    /* integrals up to nodes, and more; see cells.glsl */
    plr_texture *ranges;  /* x: the least value, y: the greatest; see cells.glsl */
    uint32_t sum_nodes;   /* of sums */
    float *sum_rows;      /* of a table that goes into a stack: what these two would hold */
    float *range_rows;
} plr_table;

/* Values are told apart that finely in `ranges`; the same in GLSL. */
#define PLR_TABLE_RANGES 64
#define PLR_RANGE_FLOATS (4 * PLR_TABLE_RANGES * PLR_TABLE_RANGES)
/* Of a stack, so many stand beside each other; the same in GLSL. */
#define PLR_RANGES_ACROSS 8
/* From where to where something can be seen is told that finely, both in one number; the same in
 * GLSL. */
#define PLR_TABLE_SEEN 4096

/* Changes of colour are told that finely; the same in GLSL. */
#define PLR_TABLE_COLORS 1000

/* Optical depths per reference length are not greater: nothing shines through. */
#define PLR_MOST_DEPTH 1e4

/* What is asked of a table. */
typedef struct plr_table_wish {
    float slack;   /* values that differ by no more from an opaque one are opaque */
    double error;  /* that may be; 0: it is to be used as if the function were not gentle */
    bool in_stack; /* it gets no textures: it is one of several in those of another
                      (plr_table_stack) */
    bool bare;     /* all it is asked for is what can be seen */
} plr_table_wish;

/* Of texels of RGBA, straight, interpolated linearly; at least two. */
plr_table *plr_table_make(plr_textures *textures, plr_arena *arena, const float *texels,
                          uint32_t count, const plr_table_wish *wish);
/* Several as one, which has `sums` and `ranges` alone: beside and above each other, and in a last
 * row of sums what of them belongs to each of `count` numbers, as cells.glsl has it;
 * PLR_TABLE_NONE: there nothing can be seen. All are gentle, or none. */
#define PLR_TABLE_NONE UINT32_MAX
plr_table *plr_table_stack(plr_textures *textures, plr_arena *arena, plr_table *const *tables,
                           uint32_t table_count, const uint32_t *numbers, uint32_t count);
/* An image of RGBA in 32-bit floats, all 0; and a texture of such, which takes it. */
plr_image plr_table_image(plr_arena *arena, uint32_t width, uint32_t height);
plr_texture *plr_table_numbers(plr_textures *textures, plr_image *image);
/* The open interval outside of which nothing can be seen; its ends may be infinite. */
void plr_table_seen(const plr_table *table, float seen[2]);
/* Whether four segments may often be taken as one. A segment is so long in reference lengths and in
 * voxels; the integral errs by 0.02 times the square of the latter at most. */
bool plr_table_joins(const plr_table *table, double length, double voxels);
/* How far up, for values in each bin of `ranges`, those of four segments may reach that they may be
 * a line of their mean; -1: nowhere, as in all bins if it is of little use. */
void plr_table_reach(const plr_table *table, double length, double voxels,
                     float reach[PLR_TABLE_RANGES]);
/* Of which part of all values, from 0 to 1, something can be seen; 0 for several functions. */
double plr_table_density(const plr_table *table);
/* Whether anything can be seen of values within a range. */
bool plr_table_sees(const plr_table *table, double low, double high);
/* A texture as `texture`: at which part of the way from the one value to the other lies, weighted
 * by extinction, the mean of what can be seen (volume_places.c). */
plr_texture *plr_table_places(const plr_table *table, plr_textures *textures, plr_arena *arena);

#endif
