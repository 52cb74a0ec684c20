/* plr-reference JOB -o VALUES.npy [--error ERROR.npy] [--pixels LIST] [--threads N] */
#include "reference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double CONVERGED = 1e-6;

typedef struct options {
    const char *job, *output, *error, *list;
    int threads;
} options;

static bool read_options(int count, char **words, options *found) {
    *found = (options){.threads = 1};
    for (int i = 1; i < count; i++) {
        const char **place = strcmp(words[i], "-o") == 0         ? &found->output
                             : strcmp(words[i], "--error") == 0  ? &found->error
                             : strcmp(words[i], "--pixels") == 0 ? &found->list
                                                                 : NULL;
        if (place && i + 1 < count)
            *place = words[++i];
        else if (strcmp(words[i], "--threads") == 0 && i + 1 < count)
            found->threads = atoi(words[++i]);
        else if (words[i][0] != '-' && !found->job)
            found->job = words[i];
        else
            return false;
    }
    return found->job && found->output;
}

/* All pixels of the picture. */
static ref_pixel *all_pixels(const ref_scene *scene, size_t *count) {
    *count = (size_t)scene->width * (size_t)scene->height;
    ref_pixel *pixels = calloc(*count, sizeof *pixels);
    for (size_t i = 0; pixels && i < *count; i++) {
        pixels[i].x = (double)(i % (size_t)scene->width);
        pixels[i].y = (double)(i / (size_t)scene->width);
    }
    return pixels;
}

/* One line for each: x y dx dy. */
static ref_pixel *listed_pixels(const char *path, size_t *count) {
    FILE *file = fopen(path, "r");
    size_t room = 1024;
    ref_pixel *pixels = malloc(room * sizeof *pixels), p;
    *count = 0;
    while (file && pixels &&
           fscanf(file, "%lf %lf %lf %lf", &p.x, &p.y, &p.shift_x, &p.shift_y) == 4) {
        if (*count == room) {
            ref_pixel *larger = realloc(pixels, 2 * room * sizeof *pixels);
            if (!larger)
                break;
            pixels = larger;
            room *= 2;
        }
        pixels[(*count)++] = p;
    }
    bool complete = file && feof(file);
    if (file)
        fclose(file);
    if (complete)
        return pixels;
    free(pixels);
    return NULL;
}

static bool write_colors(const ref_scene *scene, const options *wanted, const ref_color *colors,
                         size_t count) {
    double *values = malloc((count + 1) * 4 * sizeof *values);
    if (!values)
        return false;
    size_t picture[] = {(size_t)scene->height, (size_t)scene->width, 4}, list[] = {count, 4};
    size_t errors[] = {count};
    for (size_t i = 0; i < count; i++)
        memcpy(values + 4 * i, colors[i].rgba, sizeof colors[i].rgba);
    bool fine =
        ref_npy_write(wanted->output, values, wanted->list ? list : picture, wanted->list ? 2 : 3);
    for (size_t i = 0; i < count; i++)
        values[i] = colors[i].error;
    if (wanted->error)
        fine = fine && ref_npy_write(wanted->error, values, wanted->list ? errors : picture,
                                     wanted->list ? 1 : 2);
    free(values);
    return fine;
}

static int cast_job(const options *wanted, const ref_scene *scene) {
    size_t count, rough = 0; /* error bars above CONVERGED */
    ref_pixel *pixels =
        wanted->list ? listed_pixels(wanted->list, &count) : all_pixels(scene, &count);
    ref_color *colors = pixels ? calloc(count + 1, sizeof *colors) : NULL;
    int status = 1;
    if (colors && ref_cast_all(scene, pixels, count, colors, wanted->threads)) {
        double worst = 0;
        for (size_t i = 0; i < count; i++) {
            rough += !(colors[i].error <= CONVERGED);
            worst = fmax(worst, fmin(colors[i].error, 1e300)); /* infinity is no JSON */
        }
        printf("{\"pixels\": %zu, \"not_converged\": %zu, \"largest_error\": %.3g}\n", count, rough,
               worst);
        status = write_colors(scene, wanted, colors, count) ? 0 : 1;
    }
    if (status)
        fprintf(stderr, "plr-reference: no pixels, or the output cannot be written\n");
    free(pixels);
    free(colors);
    return status;
}

int main(int count, char **words) {
    options wanted;
    char message[512] = "";
    if (!read_options(count, words, &wanted)) {
        fprintf(stderr,
                "usage: plr-reference JOB -o VALUES.npy [--error ERROR.npy] [--pixels LIST] "
                "[--threads N]\n");
        return 2;
    }
    ref_scene *scene = ref_scene_read(wanted.job, message, sizeof message);
    if (!scene) {
        fprintf(stderr, "plr-reference: %s\n", message);
        return 1;
    }
    int status = cast_job(&wanted, scene);
    ref_scene_free(scene);
    return status;
}
