/* Reads jobs: volumes, their data and transfer functions. */
#include "job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static FILE *open_beside(ref_reader *reader, const char *name) {
    const char *slash = strrchr(reader->path, '/');
    char path[4096];
    int folder = slash && *name != '/' ? (int)(slash - reader->path + 1) : 0;
    int length = snprintf(path, sizeof path, "%.*s%s", folder, reader->path, name);
    FILE *file = length > 0 && (size_t)length < sizeof path ? fopen(path, "rb") : NULL;
    if (!file)
        ref_fail(reader, "%s cannot be opened", name);
    return file;
}

bool ref_grid_read(ref_reader *reader, yajl_val object, ref_grid *grid) {
    static const struct {
        const char *name;
        size_t size;
    } types[] = {[REF_U8] = {"u8", 1},
                 [REF_U16] = {"u16", 2},
                 [REF_F32] = {"f32", 4},
                 [REF_F64] = {"f64", 8}};
    const char *name = ref_string(object, "file"), *type = ref_string(object, "type");
    double size[3] = {0}, offset = 0, most = 1e10;
    int kind = 0;
    while (type && kind < 4 && strcmp(types[kind].name, type) != 0)
        kind++;
    if (!name || !type || kind == 4)
        return ref_fail(reader, "data want 'file', and 'type' u8, u16, f32 or f64");
    if (!ref_numbers(reader, object, "size", size, 3) ||
        !ref_numbers(reader, object, "offset", &offset, 1))
        return false;
    if (!(size[0] >= 1 && size[1] >= 1 && size[2] >= 1 && size[0] * size[1] * size[2] <= most) ||
        !(offset >= 0 && offset < 1e15))
        return ref_fail(reader, "data want 'size'");
    grid->type = (ref_type)kind;
    size_t count = 1;
    for (int i = 0; i < 3; i++) {
        grid->size[i] = (int)size[i];
        count *= (size_t)grid->size[i];
    }
    FILE *file = open_beside(reader, name);
    if (!file)
        return false;
    grid->data = malloc(count * types[kind].size);
    bool fine = grid->data && fseek(file, (long)offset, SEEK_SET) == 0 &&
                fread(grid->data, types[kind].size, count, file) == count;
    fclose(file);
    return fine || ref_fail(reader, "%s is too short", name);
}

/* Points are value and RGBA, texels RGBA alone; without either the ramp that volumes have by
 * default. */
static bool read_transfer(ref_reader *reader, yajl_val object, ref_transfer *transfer) {
    static const char *const names[] = {"texels", "points", "opacity", "tint", "hidden", NULL};
    static const ref_point ramp[] = {{0, {0}}, {1, {1, 1, 1, 1}}}, hidden[] = {{0, {0}}};
    double opacity = 1, tint[3] = {1, 1, 1};
    if (object && !ref_known(reader, object, "transfer", names))
        return false;
    yajl_val texels = ref_member(object, "texels"), points = ref_member(object, "points");
    yajl_val given = texels ? texels : points;
    if (!ref_numbers(reader, object, "opacity", &opacity, 1) ||
        !ref_numbers(reader, object, "tint", tint, 3))
        return false;
    if (ref_bool(object, "hidden"))
        return ref_transfer_make(transfer, hidden, 1, 1, tint);
    if (!given)
        return ref_transfer_make(transfer, ramp, 2, opacity, tint);
    size_t count = ref_is_array(given) ? given->u.array.len : 0, width = texels ? 4 : 5;
    ref_point *made = calloc(count + 1, sizeof *made);
    bool fine = made && count;
    for (size_t i = 0; i < count && fine; i++) {
        yajl_val row = given->u.array.values[i];
        double numbers[5] = {0};
        fine = ref_is_array(row) && row->u.array.len == width;
        for (size_t k = 0; k < width && fine; k++) {
            fine = YAJL_IS_NUMBER(row->u.array.values[k]);
            numbers[k + 5 - width] = fine ? YAJL_GET_DOUBLE(row->u.array.values[k]) : 0;
        }
        made[i].value = !texels ? numbers[0] : count > 1 ? (double)i / (double)(count - 1) : 0;
        memcpy(made[i].color, numbers + 1, sizeof made[i].color);
    }
    fine = fine && ref_transfer_make(transfer, made, count, opacity, tint);
    free(made);
    return fine ||
           ref_fail(reader, "transfer wants texels (r g b a) or ascending points (value r g b a)");
}

/* With segments one function each, and 'otherSegments' for all numbers above. */
static bool read_transfers(ref_reader *reader, yajl_val object, ref_volume *volume) {
    yajl_val segments = ref_member(object, "segments");
    size_t count = ref_is_array(segments) ? segments->u.array.len : 0;
    volume->transfers = calloc(count + 1, sizeof *volume->transfers);
    if (!volume->transfers)
        return ref_fail(reader, "no memory");
    volume->transfer_count = count + 1;
    for (size_t i = 0; i < count; i++)
        if (!read_transfer(reader, segments->u.array.values[i], &volume->transfers[i]))
            return false;
    const char *rest = volume->labels.data ? "otherSegments" : "transfer";
    return read_transfer(reader, ref_member(object, rest), &volume->transfers[count]);
}

static bool read_shading(ref_reader *reader, yajl_val object, ref_shading *shading) {
    static const char *const names[] = {"ambient", "diffuse",   "specular", "power",
                                        "light",   "unclamped", NULL};
    if (!object)
        return true;
    if (!ref_known(reader, object, "shading", names))
        return false;
    const char *light = ref_string(object, "light");
    *shading = (ref_shading){
        true, light && strcmp(light, "camera") == 0, ref_bool(object, "unclamped"), 0.2, 0.7, 0.3,
        20};
    return ref_numbers(reader, object, "ambient", &shading->ambient, 1) &&
           ref_numbers(reader, object, "diffuse", &shading->diffuse, 1) &&
           ref_numbers(reader, object, "specular", &shading->specular, 1) &&
           ref_numbers(reader, object, "power", &shading->power, 1);
}

static bool read_planes(ref_reader *reader, yajl_val object, ref_volume *volume) {
    yajl_val planes = ref_member(object, "clipPlanes");
    size_t count = ref_is_array(planes) ? planes->u.array.len : 0;
    volume->planes = calloc(count + 1, sizeof *volume->planes);
    for (; volume->planes && volume->plane_count < count; volume->plane_count++) {
        yajl_val row = planes->u.array.values[volume->plane_count];
        for (size_t k = 0; k < 4; k++) {
            if (!ref_is_array(row) || row->u.array.len != 4 ||
                !YAJL_IS_NUMBER(row->u.array.values[k]))
                return ref_fail(reader, "a clip plane wants four numbers");
            volume->planes[volume->plane_count][k] = YAJL_GET_DOUBLE(row->u.array.values[k]);
        }
    }
    return volume->planes;
}

/* The values that become 0 and 1: given; of 8 bits all there are; else the data's own. */
static void find_range(ref_volume *volume) {
    const ref_grid *grid = &volume->voxels;
    double least = INFINITY, greatest = -INFINITY;
    int at[3];
    for (at[2] = 0; at[2] < grid->size[2]; at[2]++)
        for (at[1] = 0; at[1] < grid->size[1]; at[1]++)
            for (at[0] = 0; at[0] < grid->size[0]; at[0]++) {
                double value = ref_grid_at(grid, at);
                if (isfinite(value)) {
                    least = fmin(least, value);
                    greatest = fmax(greatest, value);
                }
            }
    volume->range[0] = grid->type == REF_U8 ? 0 : least;
    volume->range[1] = grid->type == REF_U8 ? 255 : greatest;
}

static bool read_numbers(ref_reader *reader, yajl_val object, ref_volume *volume) {
    double matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, length = 0, sides = 1;
    memcpy(volume->dimensions, (double[]){1, 1, 1}, sizeof volume->dimensions);
    memcpy(volume->crop_max, volume->dimensions, sizeof volume->crop_max);
    if (!ref_member(object, "range"))
        find_range(volume);
    if (!ref_numbers(reader, object, "range", volume->range, 2) ||
        !ref_numbers(reader, object, "voxelChange", &volume->change, 1) ||
        !ref_numbers(reader, object, "dimensions", volume->dimensions, 3) ||
        !ref_numbers(reader, object, "matrix", matrix, 16) ||
        !ref_numbers(reader, object, "cropMin", volume->crop_min, 3) ||
        !ref_numbers(reader, object, "cropMax", volume->crop_max, 3) ||
        !ref_numbers(reader, object, "opacityUnitDistance", &length, 1))
        return false;
    for (int i = 0; i < 3; i++)
        sides *= volume->dimensions[i] / volume->voxels.size[i];
    volume->reference_length = length > 0 ? length : cbrt(sides);
    if (!(volume->dimensions[0] > 0 && volume->dimensions[1] > 0 && volume->dimensions[2] > 0))
        return ref_fail(reader, "'dimensions' are positive");
    memcpy(volume->to_world, matrix, sizeof matrix);
    return ref_matrix_invert(matrix, volume->to_own) || ref_fail(reader, "a matrix is singular");
}

bool ref_volume_read(ref_reader *reader, yajl_val object, ref_volume *volume) {
    static const char *const names[] = {
        "file",       "type",   "offset",   "size",          "range",      "voxelChange",
        "dimensions", "matrix", "cropMin",  "cropMax",       "clipPlanes", "opacityUnitDistance",
        "transfer",   "labels", "segments", "otherSegments", "shading",    NULL};
    static const char *const label_names[] = {"file", "type", "offset", "size", NULL};
    yajl_val labels = ref_member(object, "labels");
    if (!ref_known(reader, object, "a volume", names) ||
        !ref_grid_read(reader, object, &volume->voxels) || !read_numbers(reader, object, volume) ||
        !read_planes(reader, object, volume))
        return false;
    if (labels && (!ref_known(reader, labels, "labels", label_names) ||
                   !ref_grid_read(reader, labels, &volume->labels)))
        return false;
    return read_transfers(reader, object, volume) &&
           read_shading(reader, ref_member(object, "shading"), &volume->shading);
}

void ref_volume_free(ref_volume *volume) {
    for (size_t i = 0; i < volume->transfer_count; i++)
        ref_transfer_free(&volume->transfers[i]);
    free(volume->transfers);
    free(volume->planes);
    free(volume->voxels.data);
    free(volume->labels.data);
}
