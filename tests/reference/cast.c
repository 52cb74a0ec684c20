/* From a pixel to its colour: the ray, the volumes and solids on it. */
#include "walk.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static const double SAME_PLACE = 1e-13; /* entries and exits that differ by rounding alone */
static const double SEEN_THROUGH = 37;  /* the optical depth behind which nothing is seen */

static const double LIT = 1e-8; /* what cuts of lit colours may have missed */

typedef struct ray {
    double origin[3], way[3]; /* in the world, `way` of length 1 */
    double start, limit;
    double eye[3];
} ray;

static ray make_ray(const ref_scene *scene, ref_pixel pixel) {
    const ref_camera *camera = &scene->camera;
    const double *window = camera->window;
    double x = (pixel.x + 0.5 + pixel.shift_x) / scene->width;
    double y = 1 - (pixel.y + 0.5 + pixel.shift_y) / scene->height;
    double at[3] = {window[0] + x * (window[2] - window[0]),
                    window[1] + y * (window[3] - window[1]), -1};
    double origin[3] = {0}, way[3] = {0, 0, -1}, slant = 1;
    if (camera->parallel) {
        origin[0] = at[0];
        origin[1] = at[1];
    } else {
        slant = sqrt(at[0] * at[0] + at[1] * at[1] + 1);
        memcpy(way, at, sizeof way);
    }
    ray made = {.start = camera->near, .limit = camera->far};
    ref_matrix_point(camera->to_world, origin, 1, made.origin);
    ref_matrix_point(camera->to_world, way, 0, made.way);
    ref_matrix_point(camera->to_world, (double[]){0, 0, 0}, 1, made.eye);
    /* distances are lengths in the camera's own coordinates; near and far are planes */
    for (int i = 0; i < 3; i++)
        made.way[i] /= slant;
    made.start *= slant;
    made.limit *= slant;
    return made;
}

/* Places that differ by rounding alone are made one. */
static void join(double *one, double *other) {
    if (fabs(*one - *other) <= SAME_PLACE * (1 + fabs(*one)))
        *other = *one;
}

static int begin(ref_sum *sum, const ray *r, double limit, ref_walk *walks) {
    const ref_scene *scene = sum->scene;
    int count = 0;
    for (size_t i = 0; i < scene->volume_count; i++) {
        ref_walk *walk = &walks[count];
        const ref_volume *volume = &scene->volumes[i];
        bool met = ref_walk_begin(walk, volume, r->origin, r->way, r->start, limit);
        sum->is_uncertain |= walk->is_uncertain;
        if (!met)
            continue;
        double length = 0;
        for (int k = 0; k < 3; k++) {
            walk->to_light[k] = volume->shading.from_camera
                                    ? r->eye[k] - r->origin[k] - walk->enter * r->way[k]
                                    : -r->way[k];
            length += walk->to_light[k] * walk->to_light[k];
        }
        for (int k = 0; k < 3; k++)
            walk->to_light[k] /= length > 0 ? sqrt(length) : 1;
        count++;
    }
    for (int i = 0; i < count; i++)
        for (int j = i + 1; j < count; j++) {
            join(&walks[i].enter, &walks[j].enter);
            join(&walks[i].leave, &walks[j].leave);
            join(&walks[i].enter, &walks[j].leave);
            join(&walks[i].leave, &walks[j].enter);
        }
    return count;
}

/* From one face, entry or exit to the next. */
static void go(ref_sum *sum, ref_walk *walks, int count) {
    double t = INFINITY;
    for (int i = 0; i < count; i++)
        t = fmin(t, walks[i].enter);
    while (t < INFINITY && !sum->is_ended && sum->depth < SEEN_THROUGH) {
        double next = INFINITY;
        sum->count = 0;
        for (int i = 0; i < count; i++) {
            ref_walk *walk = &walks[i];
            if (t < walk->enter)
                next = fmin(next, walk->enter);
            if (t < walk->enter || t >= walk->leave)
                continue;
            ref_walk_pass(walk, t);
            ref_walk_read(walk, t);
            next = fmin(next, ref_walk_next(walk));
            if (!walk->is_clear)
                sum->walks[sum->count++] = walk;
        }
        if (sum->count)
            ref_sum_add(sum, t, next);
        t = next;
    }
}

static void put_behind(ref_sum *sum, const double color[3], double alpha) {
    double through = exp(-sum->depth);
    for (int k = 0; k < 3; k++)
        sum->color[k] += through * alpha * color[k];
    sum->depth = alpha < 1 ? sum->depth - log1p(-alpha) : INFINITY;
}

ref_color ref_cast(const ref_scene *scene, ref_pixel pixel) {
    ray r = make_ray(scene, pixel);
    double solid[3];
    bool uncertain;
    double limit = ref_solids_meet(scene, r.origin, r.way, r.start, r.limit, solid, &uncertain);
    ref_color result = {{0}, INFINITY};
    ref_walk *walks = calloc(scene->volume_count + 1, sizeof *walks);
    ref_walk **seen = calloc(scene->volume_count + 1, sizeof(ref_walk *));
    if (walks && seen) {
        ref_sum sum = {.scene = scene, .walks = seen};
        int count = begin(&sum, &r, limit, walks);
        go(&sum, walks, count);
        if (limit < r.limit)
            put_behind(&sum, solid, 1);
        put_behind(&sum, scene->background, scene->background[3]);
        memcpy(result.rgba, sum.color, sizeof sum.color);
        result.rgba[3] = -expm1(-sum.depth);
        for (int i = 0; i < count; i++) {
            sum.is_uncertain |= walks[i].is_uncertain;
            if (walks[i].volume->shading.used)
                sum.error += LIT;
        }
        result.error = sum.is_out_of_memory ? INFINITY : sum.error;
        if (sum.is_uncertain || uncertain)
            result.error = fmax(result.error, 1);
        for (int k = 0; k < 3 && sum.may_end; k++)
            result.error = fmax(result.error, fabs(sum.may_color[k] - result.rgba[k]));
        if (sum.may_end)
            result.error = fmax(result.error, 1 - result.rgba[3]);
        free(sum.cuts);
    }
    free(walks);
    free(seen);
    return result;
}

typedef struct work {
    const ref_scene *scene;
    const ref_pixel *pixels;
    ref_color *colors;
    size_t count;
    atomic_size_t next;
} work;

static void *cast_some(void *argument) {
    enum {
        BUNCH = 16
    };
    work *todo = argument;
    for (;;) {
        size_t first = atomic_fetch_add(&todo->next, BUNCH);
        if (first >= todo->count)
            return NULL;
        for (size_t i = first; i < first + BUNCH && i < todo->count; i++)
            todo->colors[i] = ref_cast(todo->scene, todo->pixels[i]);
    }
}

bool ref_cast_all(const ref_scene *scene, const ref_pixel *pixels, size_t count, ref_color *colors,
                  int threads) {
    enum {
        MOST = 64
    };
    work todo = {.scene = scene, .pixels = pixels, .colors = colors, .count = count};
    pthread_t helpers[MOST];
    int started = 0;
    while (started + 1 < threads && started < MOST &&
           pthread_create(&helpers[started], NULL, cast_some, &todo) == 0)
        started++;
    cast_some(&todo);
    for (int i = 0; i < started; i++)
        pthread_join(helpers[i], NULL);
    return true;
}
