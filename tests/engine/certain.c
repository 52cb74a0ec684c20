/* Steps that are said to be certain: whatever the ray, their middles are as near to the true colour
 * as said; and no bound is so far above the errors that it is of no use. */
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/volume_certain.h"

enum {
    MOST_SIDE = 14,
    MOST_TEXELS = 65,
    FINE = 3000, /* steps of the true colour */
    RAYS = 16,
    CASES = 96
};

#ifndef SEED
#define SEED 7
#endif

typedef struct numbers {
    uint64_t state;
} numbers;

static double next(numbers *n) {
    n->state = n->state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(n->state >> 11) / 9007199254740992.0;
}

typedef struct volume {
    plr_arena arena;
    uint32_t size[3];
    double dimensions[3];
    float values[MOST_SIDE * MOST_SIDE * MOST_SIDE];
    float texels[4 * MOST_TEXELS];
    plr_certain certain;
} volume;

/* ---- Truth, with nothing of the engine ---- */

static double value_at(const volume *v, const double place[3]) {
    int base[3], reach[3];
    double f[3], sum = 0;
    for (int i = 0; i < 3; i++) {
        double at =
            fmin(fmax((place[i] / v->dimensions[i] + 0.5) * v->size[i] - 0.5, 0), v->size[i] - 1.0);
        base[i] = (int)at;
        f[i] = at - base[i];
        reach[i] = base[i] + 1 < (int)v->size[i] ? 1 : 0;
    }
    for (int k = 0; k < 8; k++) {
        double weight = 1;
        size_t index = 0, stride = 1;
        for (int i = 0; i < 3; i++) {
            int side = k >> i & 1;
            weight *= side ? f[i] : 1 - f[i];
            index += (size_t)(base[i] + (side ? reach[i] : 0)) * stride;
            stride *= v->size[i];
        }
        sum += weight * (double)v->values[index];
    }
    return sum;
}

static void color_at(const volume *v, const double place[3], double color[4]) {
    double at = value_at(v, place) * (v->certain.texel_count - 1);
    uint32_t i = (uint32_t)fmin(at, v->certain.texel_count - 2.0);
    for (uint32_t c = 0; c < 4; c++) {
        double a = (double)v->texels[4 * i + c], b = (double)v->texels[4 * i + 4 + c];
        color[c] = a + (at - i) * (b - a);
    }
    color[3] = color[3] < 1 ? -log1p(-color[3]) / v->certain.reference : INFINITY;
}

/* Composes `count` volumes along a ray, in steps. */
static void cast(const volume *const *volumes, size_t count, const double from[3],
                 const double to[3], double steps, double out[4]) {
    double length = 0, through = 1;
    for (int i = 0; i < 3; i++)
        length += (to[i] - from[i]) * (to[i] - from[i]);
    length = sqrt(length);
    for (int c = 0; c < 4; c++)
        out[c] = 0;
    int whole = (int)ceil(steps - 1e-9);
    for (int n = 0; n < whole && through > 0; n++) {
        double begin = n / steps, end = fmin((n + 1) / steps, 1), place[3], mixed[4] = {0, 0, 0, 0};
        bool opaque = false;
        for (int i = 0; i < 3; i++)
            place[i] = from[i] + (to[i] - from[i]) * (begin + end) / 2;
        for (size_t k = 0; k < count; k++) {
            double color[4];
            color_at(volumes[k], place, color);
            if (isinf(color[3])) {
                opaque = true;
                for (int c = 0; c < 3; c++)
                    mixed[c] = color[c];
                mixed[3] = 1;
                break;
            }
            for (int c = 0; c < 3; c++)
                mixed[c] += color[c] * color[3];
            mixed[3] += color[3];
        }
        double part = opaque ? 1 : -expm1(-mixed[3] * (end - begin) * length);
        for (int c = 0; c < 3 && mixed[3] > 0; c++)
            out[c] += through * part * mixed[c] / mixed[3];
        through *= 1 - part;
    }
    out[3] = 1 - through;
}

/* ---- Cases ---- */

/* Of functions, of a place or of a value. */
static float shape(numbers *n, int kind, double at) {
    switch (kind) {
    case 0:
        return 0.4f;
    case 1:
        return (float)(0.2 + 0.5 * at);
    case 2:
        return (float)(0.5 + 0.4 * sin(3 * at));
    case 3:
        return (float)next(n);
    case 4: /* cut off at both ends */
        return (float)fmin(fmax(2.5 * at - 0.7, 0), 1);
    case 5:
        return (float)exp(-6 * fabs(at));
    default: /* thin */
        return fabs(at - 0.5) < 0.08 ? 0.9f : 0.1f;
    }
}

enum {
    FUNCTIONS = 7, /* shapes */
    BALL = 7,
    BELL = 8,
    VOLUMES = 9
};

/* `place` is from 0 to 1 along each axis. */
static float field(numbers *n, int kind, const double place[3], const double turn[3]) {
    double along = 0, squared = 0;
    for (int i = 0; i < 3; i++) {
        along += turn[i] * place[i];
        squared += (place[i] - 0.5) * (place[i] - 0.5);
    }
    if (kind == BALL)
        return (float)fmax(1 - squared / 0.2, 0);
    return kind == BELL ? (float)exp(-12 * squared) : shape(n, kind, along);
}

static void finish(volume *v, uint32_t count, double reference) {
    v->certain = (plr_certain){.texels = v->texels, .texel_count = count, .reference = reference};
    double squared = 0;
    for (int i = 0; i < 3; i++) {
        v->certain.voxel[i] = v->dimensions[i] / v->size[i];
        squared += v->dimensions[i] * v->dimensions[i];
    }
    v->certain.longest = sqrt(squared);
    plr_image image = {.width = v->size[0],
                       .height = v->size[1],
                       .depth = v->size[2],
                       .components = 1,
                       .type = PLR_FLOAT32,
                       .samples = v->values};
    static jmp_buf failed;
    if (setjmp(failed))
        abort();
    plr_arena_init(&v->arena, NULL, &failed);
    v->certain.bends = plr_bends_make(&v->arena, &image);
}

static void make(volume *v, numbers *n) {
    int kind = (int)(VOLUMES * next(n)), function = (int)(FUNCTIONS * next(n)),
        tint = (int)(FUNCTIONS * next(n));
    double scale = pow(10, -2.5 * next(n)), turn[3] = {next(n), next(n), next(n) - 0.5},
           low = next(n);
    double thin = next(n) < 0.3 ? 0.01 : 1;
    for (int i = 0; i < 3; i++) {
        v->size[i] = 1 + (uint32_t)(MOST_SIDE * next(n));
        v->dimensions[i] = 0.3 + 0.6 * next(n);
    }
    size_t at = 0;
    for (uint32_t z = 0; z < v->size[2]; z++)
        for (uint32_t y = 0; y < v->size[1]; y++)
            for (uint32_t x = 0; x < v->size[0]; x++) {
                double place[] = {(x + 0.5) / v->size[0], (y + 0.5) / v->size[1],
                                  (z + 0.5) / v->size[2]};
                float value = fminf(fmaxf(field(n, kind, place, turn), 0), 1);
                v->values[at++] = (float)(low * (1 - thin) + thin * (double)value);
            }
    uint32_t count = 2 + (uint32_t)((MOST_TEXELS - 1) * next(n));
    bool opaque = next(n) < 0.1;
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t c = 0; c < 3; c++)
            v->texels[4 * i + c] = shape(n, tint, (i + 0.3 * c) / count);
        v->texels[4 * i + 3] =
            opaque ? 1 : (float)(scale * (double)shape(n, function, (double)i / count));
    }
    finish(v, count, 0.02 + 0.3 * next(n));
}

/* Those of the analytic tests: a ramp, extinction that falls off exponentially, a ball. */
static void make_known(volume *v, int number) {
    static const uint32_t size[] = {11, 9, 12};
    static const double dimensions[] = {0.64, 0.5, 0.56}, deepest[] = {6, 25, 18};
    size_t at = 0;
    memcpy(v->size, size, sizeof size);
    memcpy(v->dimensions, dimensions, sizeof dimensions);
    for (uint32_t z = 0; z < size[2]; z++)
        for (uint32_t y = 0; y < size[1]; y++)
            for (uint32_t x = 0; x < size[0]; x++) {
                double place[] = {(x + 0.5) / size[0], (y + 0.5) / size[1], (z + 0.5) / size[2]};
                double along = 0.6 * place[0] + 0.3 * place[1] + 0.5 * place[2], squared = 0;
                for (int i = 0; i < 3; i++)
                    squared += (place[i] - 0.5) * (place[i] - 0.5);
                double values[] = {0.75 * along - 0.08, exp(-4 * along), fmax(1 - 5 * squared, 0)};
                v->values[at++] = (float)fmax(values[number], 0);
            }
    double reference = dimensions[0] / size[0];
    for (uint32_t i = 0; i < MOST_TEXELS; i++) {
        double value = i / (MOST_TEXELS - 1.0);
        float color = number == 2 ? (float)value : 1;
        const float texel[] = {color, 1 - color, 0.5F,
                               (float)-expm1(-deepest[number] * value * reference)};
        memcpy(v->texels + 4 * (size_t)i, texel, sizeof texel);
    }
    finish(v, MOST_TEXELS, reference);
}

/* Half of it, of the box that is in all. */
static double side_of(const volume *const *volumes, size_t count, int axis) {
    double half = volumes[0]->dimensions[axis] / 2;
    for (size_t k = 1; k < count; k++)
        half = fmin(half, volumes[k]->dimensions[axis] / 2);
    return half;
}

/* A ray from side to side of that box, or to or from somewhere in it. */
static void aim(const volume *const *volumes, size_t count, numbers *n, double from[3],
                double to[3]) {
    int axis = (int)(3 * next(n));
    bool along = next(n) < 0.3;
    for (int i = 0; i < 3; i++) {
        double half = side_of(volumes, count, i);
        from[i] = i == axis ? -half : half * (2 * next(n) - 1);
        to[i] = i == axis ? half : along ? from[i] : half * (2 * next(n) - 1);
    }
    int other = (axis + 1 + (int)(2 * next(n))) % 3;
    if (next(n) < 0.2) { /* across an edge */
        double half = fabs(to[axis]);
        to[axis] = half * (2 * next(n) - 1);
        to[other] = to[other] < from[other] ? -side_of(volumes, count, other)
                                            : side_of(volumes, count, other);
    }
    double inside = next(n) < 0.3 ? 0.4 * next(n) : 0;
    for (int i = 0; i < 3; i++)
        from[i] += inside * (to[i] - from[i]);
}

/* Rays and their true colours. */
typedef struct ray {
    double from[3], to[3], length, truth[4];
} ray;

static void find_rays(const volume *const *volumes, size_t count, numbers *n, ray *rays) {
    for (ray *r = rays; r < rays + RAYS; r++) {
        aim(volumes, count, n, r->from, r->to);
        double squared = 0;
        for (int i = 0; i < 3; i++)
            squared += (r->to[i] - r->from[i]) * (r->to[i] - r->from[i]);
        r->length = sqrt(squared);
        cast(volumes, count, r->from, r->to, FINE, r->truth);
    }
}

/* The greatest error of steps so long. */
static double measure(const volume *const *volumes, size_t count, double step, const ray *rays) {
    double worst = 0;
    for (const ray *r = rays; r < rays + RAYS; r++) {
        double got[4];
        cast(volumes, count, r->from, r->to, fmax(r->length / step, 1), got);
        for (int c = 0; c < 4; c++)
            worst = fmax(worst, fabs(r->truth[c] - got[c]));
    }
    return worst;
}

static int compare(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* The longest steps, in some ratio, of which something holds; 0: none. */
typedef struct search {
    const volume *volumes[2];
    plr_certain certain[2];
    size_t count;
    double voxel, allowed;
    ray rays[RAYS];
} search;

#define LONGEST 32.0
#define SHORTEST 0.03
#define RATIO 0.8

static double find_certain(const search *s) {
    for (double length = LONGEST; length > SHORTEST; length *= RATIO) {
        const double steps[2] = {length * s->voxel, length * s->voxel};
        if (plr_certain_error(s->certain, s->count, steps) <= s->allowed)
            return length;
    }
    return 0;
}

static double find_enough(const search *s, double least) {
    for (double length = LONGEST; length > least; length *= RATIO)
        if (measure(s->volumes, s->count, length * s->voxel, s->rays) <= s->allowed)
            return length;
    return least;
}

/* For each error the longest steps that are certain to keep it; they are `useful` if in the median
 * no steps more than so many times as long would be enough. */
static void check_cases(size_t together, double allowed, double useful) {
    static volume all[2];
    numbers n = {.state = SEED + together};
    double ratios[CASES];
    size_t exceeded = 0, some = 0;
    for (int number = 0; number < CASES; number++) {
        search s = {.count = together, .allowed = allowed, .voxel = INFINITY};
        for (size_t k = 0; k < together; k++) {
            make(&all[k], &n);
            s.volumes[k] = &all[k];
            s.certain[k] = all[k].certain;
            for (int i = 0; i < 3; i++)
                s.voxel = fmin(s.voxel, s.certain[k].voxel[i]);
        }
        double step = find_certain(&s);
        if (step > 0) {
            find_rays(s.volumes, together, &n, s.rays);
            double error = measure(s.volumes, together, step * s.voxel, s.rays);
            exceeded += error > allowed + 1e-6;
            if (error > allowed + 1e-6)
                printf("# case %d: steps of %g voxels: error %g, said %g\n", number, step, error,
                       allowed);
            ratios[some++] = find_enough(&s, step) / step;
        }
        for (size_t k = 0; k < together; k++)
            plr_arena_finish(&all[k].arena);
    }
    qsort(ratios, some, sizeof *ratios, compare);
    printf("# %zu of %d cases have such steps; %g times as long ones would do (median)\n", some,
           CASES, some ? ratios[some / 2] : 0);
    TAP_RESULT(exceeded == 0, "%zu together, 1/%g: %zu above what is said", together, 1 / allowed,
               exceeded);
    TAP_RESULT(some > CASES / 4 && ratios[some / 2] < useful, "and they are of use");
}

/* Bounds are above the errors, but not so many times. */
static void check_known(int number, const char *name, double times) {
    static volume v;
    const volume *const volumes[] = {&v};
    numbers n = {.state = SEED};
    static ray rays[RAYS];
    make_known(&v, number);
    for (double length = 1; length >= 0.25; length /= 2) {
        double step = length * v.certain.voxel[0], worst = 0;
        double bound = plr_certain_error(&v.certain, 1, &step);
        for (int i = 0; i < 10; i++) {
            find_rays(volumes, 1, &n, rays);
            worst = fmax(worst, measure(volumes, 1, step, rays));
        }
        TAP_RESULT(bound >= worst && bound <= times * worst,
                   "%s, %g voxels: bound %g, greatest error %g", name, length, bound, worst);
    }
    plr_arena_finish(&v.arena);
}

int main(void) {
    static const double useful[] = {7, 20};
    for (size_t together = 1; together <= 2; together++) {
        check_cases(together, 1.0 / 64, useful[together - 1]);
        check_cases(together, 1.0 / 1023, useful[together - 1]);
    }
    check_known(0, "ramp", 35);
    check_known(1, "exponential", 70);
    check_known(2, "ball", 150);
    return tap_done();
}
