/* A raycaster in double precision: the truth that pictures are compared with. It knows nothing of
 * plugray's own code. README.md says what it computes and how jobs are written. */
#ifndef REFERENCE_H
#define REFERENCE_H

#include <stdbool.h>
#include <stddef.h>

/* ---- Transfer functions ---- */

/* Straight RGBA at a value. Two points of one value are a jump; at the value itself the second one
 * counts. */
typedef struct ref_point {
    double value;
    double color[4];
} ref_point;

/* Between two knots every channel is base + slope (value - anchor), and stays within 0 and 1. */
typedef struct ref_interval {
    double from, to;
    double anchor; /* that end where alpha is greater */
    double base[4], slope[4];
    double clearness; /* 1 - alpha at the anchor */
    bool is_clear;    /* alpha is 0 everywhere */
    bool is_opaque;   /* alpha is 1 everywhere */
} ref_interval;

typedef struct ref_transfer {
    ref_interval *intervals; /* ascending, without gaps; cover more than 0 to 1 */
    int count;
    int *seen_before; /* how many of the intervals before are not clear */
    bool may_be_opaque;
} ref_transfer;

/* Points in ascending order; alpha is multiplied by `opacity`, RGB by `tint`, then all are clamped.
 */
bool ref_transfer_make(ref_transfer *transfer, const ref_point *points, size_t count,
                       double opacity, const double tint[3]);
/* Texels of a texture: values 0 and 1 are the centres of the outer ones. */
bool ref_transfer_texels(ref_transfer *transfer, const double (*texels)[4], size_t count,
                         double opacity, const double tint[3]);
void ref_transfer_free(ref_transfer *transfer);
/* The interval that holds a value; at a knot the upper one. */
int ref_transfer_find(const ref_transfer *transfer, double value);
bool ref_transfer_clear(const ref_transfer *transfer, double least, double greatest);
double ref_interval_alpha(const ref_interval *interval, double value);

/* ---- Cubics: c[0] + c[1] u + c[2] u^2 + c[3] u^3 ---- */

double ref_cubic_at(const double c[4], double u);
/* Where it turns inside of (from, to), ascending; returns how many. */
int ref_cubic_turns(const double c[4], double from, double to, double turns[2]);
/* Where it takes a value, in an interval in which it is monotone and whose ends enclose the value.
 */
double ref_cubic_root(const double c[4], double value, double from, double to);
/* A trilinear function of x, given at 8 corners (x fastest), along x = start + u way. */
void ref_cubic_of_cell(const double corners[8], const double start[3], const double way[3],
                       double c[4]);

/* ---- Data ---- */

typedef enum ref_type {
    REF_U8,
    REF_U16,
    REF_F32,
    REF_F64
} ref_type;

/* Numbers on a grid, x fastest, as they are stored. */
typedef struct ref_grid {
    int size[3];
    ref_type type;
    void *data;
} ref_grid;

double ref_grid_at(const ref_grid *grid, const int at[3]); /* clamped to the outermost ones */
/* The 8 numbers around a cell, whose least corner is `cell` (-1 and up). */
void ref_grid_corners(const ref_grid *grid, const int cell[3], double corners[8]);

/* How light is reflected, by the formula of VTK's mappers. */
typedef struct ref_shading {
    bool used;
    bool from_camera; /* light from the camera's place, seen from where the ray enters; else along
                         the ray */
    bool unclamped;   /* colours may exceed 1 */
    double ambient, diffuse, specular, power;
} ref_shading;

typedef struct ref_volume {
    ref_grid voxels;
    double range[2]; /* stored numbers that become 0 and 1 */
    double change;   /* added to all values, before they are clamped */
    double dimensions[3];
    double to_world[16]; /* rows; columns of coordinates are multiplied from the right */
    double to_own[16];
    double crop_min[3], crop_max[3];
    double (*planes)[4]; /* in the world; what lies on the negative side is cut away */
    size_t plane_count;
    double reference_length; /* own coordinates */
    ref_grid labels;         /* no data: none */
    ref_transfer
        *transfers; /* one; with labels one for each segment, the last for all numbers above */
    size_t transfer_count;
    ref_shading shading;
} ref_volume;

/* ---- Scenes ---- */

typedef enum ref_solid_kind {
    REF_PLANE,        /* numbers: a b c d */
    REF_SPHERE,       /* centre, radius */
    REF_BOX,          /* least and greatest corner, in the coordinates of the matrix */
    REF_PARALLELOGRAM /* corner, two edges */
} ref_solid_kind;

/* Opaque geometry of one colour. Planes and parallelograms have two sides; spheres and boxes are
 * seen from outside alone. */
typedef struct ref_solid {
    ref_solid_kind kind;
    double numbers[9];
    double to_own[16];
    double color[3];
} ref_solid;

typedef struct ref_camera {
    double to_world[16]; /* looks along -z */
    bool parallel;
    double window[4]; /* left, bottom, right, top: at distance 1, of parallel rays as it is */
    double near, far; /* 0, INFINITY: no cut */
} ref_camera;

typedef struct ref_scene {
    int width, height;
    ref_camera camera;
    double background[4]; /* straight */
    ref_volume *volumes;
    size_t volume_count;
    ref_solid *solids;
    size_t solid_count;
    double tolerance;  /* of one piece of a ray; 0: 1e-10 */
    bool touches_pass; /* alpha 1 in a single point of a ray does not stop it */
} ref_scene;

/* A ray through a pixel (column, row from the top) whose centre is shifted by parts of a pixel. */
typedef struct ref_pixel {
    double x, y, shift_x, shift_y;
} ref_pixel;

/* Premultiplied RGBA, and how much it may be wrong. */
typedef struct ref_color {
    double rgba[4];
    double error;
} ref_color;

ref_color ref_cast(const ref_scene *scene, ref_pixel pixel);
/* Casts many on several threads. False: no memory or threads. */
bool ref_cast_all(const ref_scene *scene, const ref_pixel *pixels, size_t count, ref_color *colors,
                  int threads);
/* The nearest solid in (start, limit) along a ray; returns its distance, `limit` for none.
 * `uncertain`: rounding decides whether one is met. */
double ref_solids_meet(const ref_scene *scene, const double origin[3], const double way[3],
                       double start, double limit, double color[3], bool *uncertain);

/* ---- Matrices, by rows ---- */

void ref_matrix_point(const double m[16], const double p[3], double w, double out[3]);
bool ref_matrix_invert(const double m[16], double out[16]);

/* ---- Files ---- */

/* Reads a job. NULL: `message` says why. */
ref_scene *ref_scene_read(const char *path, char *message, size_t size);
void ref_scene_free(ref_scene *scene);
/* float64, little endian; `shape` as numpy has it. */
bool ref_npy_write(const char *path, const double *values, const size_t *shape, int dimensions);

#endif
