/* Where rays meet surfaces of equal value of trilinear voxels, in double precision: in each cell
 * the value along a ray is a cubic, whose roots lie between its extrema. For tests; shares no code
 * with the engine.
 *
 * cell-roots VOXELS WIDTH HEIGHT DEPTH VALUE SLACK <RAYS >ROOTS
 *
 * VOXELS: float64, x fastest. RAYS: six float64 each, origin and direction in texture coordinates
 * of the box, which goes from 0 to 1; t counts directions, from 0. ROOTS: eight float64 each: the
 * first t, infinite where there is none; how many there are; the trilinear gradient of central
 * differences at the first, per voxel (three); the first t and how many of the surface's two
 * neighbours, which are SLACK below and above, as the least and the greatest of the first t, and
 * the number of crossings if both agree with the value itself, else -1. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct grid {
    int size[3];
    double *values;
} grid;

typedef struct ray {
    double origin[3], direction[3]; /* in voxels, whole numbers at their centres */
    double end;
} ray;

typedef struct roots {
    double first;
    int count;
} roots;

static int clamp_index(int i, int size) {
    return i < 0 ? 0 : i >= size ? size - 1 : i;
}

static double voxel(const grid *g, int x, int y, int z) {
    x = clamp_index(x, g->size[0]);
    y = clamp_index(y, g->size[1]);
    z = clamp_index(z, g->size[2]);
    return g->values[((size_t)z * (size_t)g->size[1] + (size_t)y) * (size_t)g->size[0] + (size_t)x];
}

/* The value along the ray in one cell: the sum over its corners of products of three linear
 * functions of t - from. */
static void find_cubic(const grid *g, const ray *r, const int cell[3], double from, double c[4]) {
    for (int i = 0; i < 4; i++)
        c[i] = 0;
    for (int corner = 0; corner < 8; corner++) {
        double product[4] = {
            voxel(g, cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)),
            0, 0, 0};
        for (int axis = 0; axis < 3; axis++) {
            double a = r->origin[axis] + from * r->direction[axis] - cell[axis];
            double b = r->direction[axis];
            if (!(corner >> axis & 1)) {
                a = 1 - a;
                b = -b;
            }
            for (int i = 3; i >= 0; i--)
                product[i] = product[i] * a + (i ? product[i - 1] * b : 0);
        }
        for (int i = 0; i < 4; i++)
            c[i] += product[i];
    }
}

static double cubic(const double c[4], double u) {
    return c[0] + u * (c[1] + u * (c[2] + u * c[3]));
}

/* The extrema inside 0..length, ascending. */
static int find_extrema(const double c[4], double length, double u[2]) {
    double a = 3 * c[3], b = 2 * c[2], d = b * b - 4 * a * c[1];
    if (d < 0)
        return 0;
    double q = -0.5 * (b + copysign(sqrt(d), b));
    double both[2] = {a != 0 ? q / a : NAN, q != 0 ? c[1] / q : NAN};
    int count = 0;
    for (int i = 0; i < 2; i++)
        if (both[i] > 0 && both[i] < length)
            u[count++] = both[i];
    if (count == 2 && u[0] > u[1]) {
        double kept = u[0];
        u[0] = u[1];
        u[1] = kept;
    }
    return count;
}

static double bisect(const double c[4], double level, double a, double b) {
    bool below = cubic(c, a) < level;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (a + b);
        if ((cubic(c, middle) < level) == below)
            a = middle;
        else
            b = middle;
    }
    return 0.5 * (a + b);
}

static void add_roots(const double c[4], double from, double length, double level, bool *below,
                      roots *found) {
    double u[4] = {0};
    int pieces = 1 + find_extrema(c, length, u + 1);
    u[pieces] = length;
    for (int i = 0; i < pieces; i++) {
        bool next = cubic(c, u[i + 1]) < level;
        if (next != *below) {
            double t = from + bisect(c, level, u[i], u[i + 1]);
            if (!found->count++)
                found->first = t;
        }
        *below = next;
    }
}

static void start_cell(const ray *r, int cell[3]) {
    for (int axis = 0; axis < 3; axis++) {
        double at = r->origin[axis];
        cell[axis] = (int)floor(at);
        if (r->direction[axis] < 0 && at == floor(at))
            cell[axis]--;
    }
}

/* Calls for each cell that the ray crosses, in order. */
static void find_roots(const grid *g, const ray *r, const double *levels, int level_count,
                       roots *found) {
    int cell[3];
    bool below[3];
    start_cell(r, cell);
    double t = 0, c[4];
    for (int i = 0; i < level_count; i++)
        found[i] = (roots){INFINITY, 0};
    for (bool first = true; t < r->end; first = false) {
        int axis = -1;
        double to = r->end;
        for (int i = 0; i < 3; i++) {
            double face = cell[i] + (r->direction[i] > 0);
            double at = r->direction[i] != 0 ? (face - r->origin[i]) / r->direction[i] : INFINITY;
            if (at < to) {
                axis = i;
                to = at;
            }
        }
        find_cubic(g, r, cell, t, c);
        for (int i = 0; i < level_count; i++) {
            if (first)
                below[i] = c[0] < levels[i];
            if (to > t)
                add_roots(c, t, to - t, levels[i], &below[i], &found[i]);
        }
        if (axis < 0)
            break;
        cell[axis] += r->direction[axis] > 0 ? 1 : -1;
        t = to > t ? to : t;
    }
}

/* Central differences at voxel centres, clamped to the outermost, interpolated. */
static void find_gradient(const grid *g, const ray *r, double t, double out[3]) {
    int base[3];
    double part[3];
    for (int axis = 0; axis < 3; axis++) {
        double at = r->origin[axis] + t * r->direction[axis];
        at = fmin(fmax(at, 0), g->size[axis] - 1);
        base[axis] = (int)floor(at);
        part[axis] = at - base[axis];
        out[axis] = 0;
    }
    for (int corner = 0; corner < 8; corner++) {
        int at[3];
        double weight = 1;
        for (int axis = 0; axis < 3; axis++) {
            at[axis] = base[axis] + (corner >> axis & 1);
            weight *= corner >> axis & 1 ? part[axis] : 1 - part[axis];
        }
        for (int axis = 0; axis < 3; axis++) {
            int low[3] = {at[0], at[1], at[2]}, high[3] = {at[0], at[1], at[2]};
            low[axis]--;
            high[axis]++;
            out[axis] += weight * 0.5 *
                         (voxel(g, high[0], high[1], high[2]) - voxel(g, low[0], low[1], low[2]));
        }
    }
}

/* From the box of texture coordinates to voxels; false where the box is missed. */
static bool set_ray(const grid *g, const double numbers[6], ray *r, double *start) {
    double enter = 0, leave = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double o = numbers[axis], d = numbers[3 + axis];
        if (d == 0) {
            if (o < 0 || o > 1)
                return false;
            continue;
        }
        double a = -o / d, b = (1 - o) / d;
        enter = fmax(enter, fmin(a, b));
        leave = fmin(leave, fmax(a, b));
    }
    for (int axis = 0; axis < 3; axis++) {
        r->origin[axis] = (numbers[axis] + enter * numbers[3 + axis]) * g->size[axis] - 0.5;
        r->direction[axis] = numbers[3 + axis] * g->size[axis];
    }
    *start = enter;
    r->end = leave - enter;
    return enter < leave;
}

static bool write_roots(const grid *g, const double numbers[6], double level, double slack) {
    const double levels[3] = {level, level - slack, level + slack};
    roots found[3] = {{INFINITY, 0}, {INFINITY, 0}, {INFINITY, 0}};
    double start = 0, gradient[3] = {0};
    ray r;
    if (set_ray(g, numbers, &r, &start))
        find_roots(g, &r, levels, 3, found);
    if (found[0].count)
        find_gradient(g, &r, found[0].first, gradient);
    bool same = found[0].count == found[1].count && found[0].count == found[2].count;
    const double out[8] = {start + found[0].first,
                           found[0].count,
                           gradient[0],
                           gradient[1],
                           gradient[2],
                           start + fmin(found[0].first, fmin(found[1].first, found[2].first)),
                           start + fmax(found[0].first, fmax(found[1].first, found[2].first)),
                           same ? found[0].count : -1};
    return fwrite(out, sizeof out, 1, stdout) == 1;
}

static bool read_grid(char **arguments, grid *g) {
    size_t count = 1;
    for (int i = 0; i < 3; i++) {
        g->size[i] = atoi(arguments[1 + i]);
        if (g->size[i] < 1 || g->size[i] > 1024)
            return false;
        count *= (size_t)g->size[i];
    }
    FILE *file = fopen(arguments[0], "rb");
    if (!file)
        return false;
    g->values = calloc(count, sizeof *g->values);
    bool fine = g->values && fread(g->values, sizeof *g->values, count, file) == count;
    fclose(file);
    return fine;
}

int main(int argc, char **argv) {
    grid g = {{0}, NULL};
    if (argc != 7 || !read_grid(argv + 1, &g)) {
        fprintf(stderr, "usage: cell-roots VOXELS WIDTH HEIGHT DEPTH VALUE SLACK <RAYS >ROOTS\n");
        free(g.values);
        return 2;
    }
    double level = strtod(argv[5], NULL), slack = strtod(argv[6], NULL), numbers[6];
    bool fine = true;
    while (fine && fread(numbers, sizeof numbers, 1, stdin) == 1)
        fine = write_roots(&g, numbers, level, slack);
    free(g.values);
    return fine && fflush(stdout) == 0 ? 0 : 1;
}
