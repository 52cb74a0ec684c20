/* Reads jobs: cameras, solids, the whole scene. */
#include "job.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool ref_fail(ref_reader *reader, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reader->message, reader->size, format, arguments);
    va_end(arguments);
    return false;
}

bool ref_is_array(yajl_val value) {
    return YAJL_IS_ARRAY(value);
}

yajl_val ref_member(yajl_val object, const char *name) {
    if (!YAJL_IS_OBJECT(object))
        return NULL;
    for (size_t i = 0; i < object->u.object.len; i++)
        if (strcmp(object->u.object.keys[i], name) == 0)
            return YAJL_IS_NULL(object->u.object.values[i]) ? NULL : object->u.object.values[i];
    return NULL;
}

bool ref_known(ref_reader *reader, yajl_val object, const char *what, const char *const *names) {
    if (!YAJL_IS_OBJECT(object))
        return ref_fail(reader, "%s is no object", what);
    for (size_t i = 0; i < object->u.object.len; i++) {
        const char *const *name = names;
        while (*name && strcmp(*name, object->u.object.keys[i]) != 0)
            name++;
        if (!*name)
            return ref_fail(reader, "%s has no '%s'", what, object->u.object.keys[i]);
    }
    return true;
}

bool ref_numbers(ref_reader *reader, yajl_val object, const char *name, double *values,
                 size_t count) {
    yajl_val member = ref_member(object, name);
    if (!member)
        return true;
    if (count == 1 && YAJL_IS_NUMBER(member)) {
        *values = YAJL_GET_DOUBLE(member);
        return true;
    }
    if (!YAJL_IS_ARRAY(member) || member->u.array.len != count)
        return ref_fail(reader, "'%s' wants %zu numbers", name, count);
    for (size_t i = 0; i < count; i++) {
        if (!YAJL_IS_NUMBER(member->u.array.values[i]))
            return ref_fail(reader, "'%s' wants %zu numbers", name, count);
        values[i] = YAJL_GET_DOUBLE(member->u.array.values[i]);
    }
    return true;
}

bool ref_bool(yajl_val object, const char *name) {
    return YAJL_IS_TRUE(ref_member(object, name));
}

const char *ref_string(yajl_val object, const char *name) {
    yajl_val member = ref_member(object, name);
    return YAJL_IS_STRING(member) ? YAJL_GET_STRING(member) : NULL;
}

/* ISO/IEC 19775-1 V4 23.4.6: fieldOfView is the smaller of the two angles; 23.3.5: the box of
 * parallel rays grows along one axis until it has the picture's shape. */
static void fit_window(ref_camera *camera, double angle, double aspect) {
    double *w = camera->window;
    if (!camera->parallel) {
        double half = tan(angle / 2), x = aspect >= 1 ? half * aspect : half;
        double y = aspect >= 1 ? half : half / aspect;
        memcpy(w, (double[]){-x, -y, x, y}, sizeof camera->window);
        return;
    }
    double width = w[2] - w[0], height = w[3] - w[1];
    double more_x = fmax(height * aspect - width, 0) / 2;
    double more_y = fmax(width / aspect - height, 0) / 2;
    w[0] -= more_x;
    w[2] += more_x;
    w[1] -= more_y;
    w[3] += more_y;
}

static void multiply(const double a[16], const double b[16], double out[16]) {
    double made[16] = {0};
    for (int i = 0; i < 16; i++)
        for (int k = 0; k < 4; k++)
            made[i] += a[i / 4 * 4 + k] * b[4 * k + i % 4];
    memcpy(out, made, sizeof made);
}

/* Where the camera is: moved to its position, turned by axis and angle. */
static void place_camera(ref_camera *camera, const double position[3], const double turn[4],
                         const double outer[16]) {
    double length = sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
    double c = cos(turn[3]), s = sin(turn[3]), k[3] = {0, 0, 1};
    for (int i = 0; i < 3 && length > 0; i++)
        k[i] = turn[i] / length;
    double cross[9] = {0, -k[2], k[1], k[2], 0, -k[0], -k[1], k[0], 0}, own[16] = {0};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            own[4 * i + j] = (i == j ? c : 0) + s * cross[3 * i + j] + (1 - c) * k[i] * k[j];
        own[4 * i + 3] = position[i];
    }
    own[15] = 1;
    multiply(outer, own, camera->to_world);
}

static const double IDENTITY[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

static bool read_camera(ref_reader *reader, yajl_val object, ref_scene *scene) {
    static const char *const names[] = {"position",     "orientation", "fieldOfView", "matrix",
                                        "nearDistance", "farDistance", NULL};
    ref_camera *camera = &scene->camera;
    double position[3] = {0, 0, 10}, turn[4] = {0, 0, 1, 0}, outer[16], angle = 0.785398163397448;
    memcpy(outer, IDENTITY, sizeof outer);
    if (!ref_known(reader, object, "camera", names))
        return false;
    camera->parallel = ref_is_array(ref_member(object, "fieldOfView"));
    bool fine = camera->parallel ? ref_numbers(reader, object, "fieldOfView", camera->window, 4)
                                 : ref_numbers(reader, object, "fieldOfView", &angle, 1);
    if (!fine || !ref_numbers(reader, object, "position", position, 3) ||
        !ref_numbers(reader, object, "orientation", turn, 4) ||
        !ref_numbers(reader, object, "matrix", outer, 16) ||
        !ref_numbers(reader, object, "nearDistance", &camera->near, 1) ||
        !ref_numbers(reader, object, "farDistance", &camera->far, 1))
        return false;
    camera->near = fmax(camera->near, 0);
    camera->far = camera->far > 0 ? camera->far : INFINITY;
    fit_window(camera, angle, (double)scene->width / scene->height);
    place_camera(camera, position, turn, outer);
    return true;
}

static bool read_solid(ref_reader *reader, yajl_val object, ref_solid *solid) {
    static const char *const names[] = {"plane", "sphere", "box", "parallelogram",
                                        "color", "matrix", NULL};
    static const size_t counts[] = {
        [REF_PLANE] = 4, [REF_SPHERE] = 4, [REF_BOX] = 6, [REF_PARALLELOGRAM] = 9};
    double matrix[16];
    memcpy(matrix, IDENTITY, sizeof matrix);
    if (!ref_known(reader, object, "an opaque solid", names))
        return false;
    int kind = 0;
    while (kind <= REF_PARALLELOGRAM && !ref_member(object, names[kind]))
        kind++;
    if (kind > REF_PARALLELOGRAM)
        return ref_fail(reader, "an opaque solid wants plane, sphere, box or parallelogram");
    solid->kind = (ref_solid_kind)kind;
    if (!ref_numbers(reader, object, names[kind], solid->numbers, counts[kind]) ||
        !ref_numbers(reader, object, "color", solid->color, 3) ||
        !ref_numbers(reader, object, "matrix", matrix, 16))
        return false;
    return ref_matrix_invert(matrix, solid->to_own) || ref_fail(reader, "a matrix is singular");
}

static void *list(ref_reader *reader, yajl_val root, const char *name, size_t size, size_t *count) {
    yajl_val member = ref_member(root, name);
    *count = ref_is_array(member) ? member->u.array.len : 0;
    void *made = calloc(*count + 1, size);
    if (!made || (member && !ref_is_array(member))) {
        ref_fail(reader, "'%s' is no list", name);
        free(made);
        *count = 0;
        return NULL;
    }
    return made;
}

static bool read_scene(ref_reader *reader, yajl_val root, ref_scene *scene) {
    static const char *const names[] = {"size",      "camera",      "background",
                                        "volumes",   "opaque",      "clipPlanes",
                                        "tolerance", "touchesPass", NULL};
    double size[2] = {0, 0};
    if (!ref_known(reader, root, "the job", names) || !ref_numbers(reader, root, "size", size, 2) ||
        !ref_numbers(reader, root, "background", scene->background, 4) ||
        !ref_numbers(reader, root, "tolerance", &scene->tolerance, 1))
        return false;
    if (!(size[0] >= 1 && size[0] <= 65536 && size[1] >= 1 && size[1] <= 65536))
        return ref_fail(reader, "'size' wants width and height");
    scene->width = (int)size[0];
    scene->height = (int)size[1];
    scene->touches_pass = ref_bool(root, "touchesPass");
    if (!read_camera(reader, ref_member(root, "camera"), scene))
        return false;
    yajl_val volumes = ref_member(root, "volumes"), solids = ref_member(root, "opaque");
    scene->volumes = list(reader, root, "volumes", sizeof *scene->volumes, &scene->volume_count);
    scene->solids = list(reader, root, "opaque", sizeof *scene->solids, &scene->solid_count);
    if (!scene->volumes || !scene->solids)
        return false;
    for (size_t i = 0; i < scene->volume_count; i++)
        if (!ref_volume_read(reader, volumes->u.array.values[i], &scene->volumes[i]))
            return false;
    for (size_t i = 0; i < scene->solid_count; i++)
        if (!read_solid(reader, solids->u.array.values[i], &scene->solids[i]))
            return false;
    return true;
}

static char *read_text(ref_reader *reader, const char *path) {
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    if (file && fseek(file, 0, SEEK_END) == 0) {
        long size = ftell(file);
        rewind(file);
        text = size >= 0 ? calloc((size_t)size + 1, 1) : NULL;
        if (text && fread(text, 1, (size_t)size, file) != (size_t)size) {
            free(text);
            text = NULL;
        }
    }
    if (file)
        fclose(file);
    if (!text)
        ref_fail(reader, "%s cannot be read", path);
    return text;
}

ref_scene *ref_scene_read(const char *path, char *message, size_t size) {
    ref_reader reader = {message, size, path};
    char *text = read_text(&reader, path), error[256] = "";
    if (!text)
        return NULL;
    yajl_val root = yajl_tree_parse(text, error, sizeof error);
    free(text);
    ref_scene *scene = calloc(1, sizeof *scene);
    if (!root || !scene)
        ref_fail(&reader, "%s: %s", path, *error ? error : "no JSON");
    if (!root || !scene || !read_scene(&reader, root, scene)) {
        ref_scene_free(scene);
        scene = NULL;
    }
    yajl_tree_free(root);
    return scene;
}

void ref_scene_free(ref_scene *scene) {
    if (!scene)
        return;
    for (size_t i = 0; scene->volumes && i < scene->volume_count; i++)
        ref_volume_free(&scene->volumes[i]);
    free(scene->volumes);
    free(scene->solids);
    free(scene);
}
