/* The way of a ray through the cells of volumes, and the integral along it. Internal. */
#ifndef WALK_H
#define WALK_H

#include "reference.h"

/* From face to face of a grid of cells. */
typedef struct ref_steps {
    double start[3], way[3]; /* faces are at whole numbers */
    int cell[3];
    double next[3];
} ref_steps;

void ref_steps_begin(ref_steps *steps, double t);
double ref_steps_next(const ref_steps *steps);
/* Passes all faces up to t; returns whether there was one. */
bool ref_steps_pass(ref_steps *steps, double t);

/* One volume on one ray. */
typedef struct ref_walk {
    const ref_volume *volume;
    double enter, leave;
    double speed; /* reference lengths in own coordinates, for one of t */
    ref_steps voxels, labels;
    bool is_uncertain; /* rounding decides whether it is met, or in which segment */
    bool is_read;      /* what follows holds for the present cell */
    bool is_clear;     /* nothing is seen in it */
    double base;       /* where u of the cubics is 0 */
    double value[4];
    double gradient[3][4]; /* in the world */
    const ref_transfer *transfer;
    double label_from;            /* where the ray came to it */
    const ref_interval *interval; /* of the present piece */
    double to_light[3];           /* unit, in the world; light and viewer are in one place */
} ref_walk;

bool ref_walk_begin(ref_walk *walk, const ref_volume *volume, const double origin[3],
                    const double way[3], double start, double limit);
/* Whether t is clearly behind the entry and before the exit. */
bool ref_walk_inside(const ref_walk *walk, double t);
double ref_walk_value(const ref_walk *walk, double t);
double ref_walk_next(const ref_walk *walk);
void ref_walk_read(ref_walk *walk, double t);
void ref_walk_pass(ref_walk *walk, double t);
void ref_interval_color(const ref_interval *interval, double value, double color[3]);
/* The colour of a value, lit. */
void ref_walk_color(const ref_walk *walk, double t, double value, double color[3]);

/* A place where a piece is cut. */
typedef struct ref_cut {
    double t;
    const ref_walk *walk;         /* whose transfer function has a knot there, or NULL */
    const ref_interval *interval; /* that begins at the knot */
} ref_cut;

/* What has been gathered along a ray. */
typedef struct ref_sum {
    const ref_scene *scene;
    double color[3]; /* premultiplied */
    double depth;    /* optical */
    double error;
    bool is_ended;
    ref_walk **walks; /* those that can be seen in the present piece */
    int count;
    ref_cut *cuts;
    size_t cut_count, cut_room;
    bool is_out_of_memory;
    bool is_uncertain;   /* the pixel may be quite another */
    bool may_end;        /* it almost did: */
    double may_color[3]; /* what the pixel would then be */
} ref_sum;

void ref_sum_cut(ref_sum *sum, double t, const ref_walk *walk, const ref_interval *interval);

/* Light on a colour, which may get brighter than 1. */
void ref_light(const ref_walk *walk, double t, double color[3]);
/* Cuts where normals turn over or turn fast. */
void ref_light_cuts(ref_sum *sum, const ref_walk *walk, double from, double to);
/* Where a channel passes 1, in no order. */
int ref_light_limits(const ref_walk *walk, double from, double to, double *cuts, int most);

/* Adds what the walks have between two faces of cells. */
void ref_sum_add(ref_sum *sum, double from, double to);
/* The integral from `from` to `to`, where everything is smooth. */
void ref_sum_integrate(ref_sum *sum, double from, double to);

#endif
