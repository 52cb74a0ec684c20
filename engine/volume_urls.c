/* ImageTexture3D: volumes from files, and what stands beside them. */
#include "engine/volume_node.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/node_file.h"

/* ---- files of a scene ---- */

static bool load_beside(void *user, const char *referrer, const char *name, bool gunzip,
                        plr_place place, plr_bytes *bytes, plr_diags *diags) {
    return plr_scene_load_beside(user, referrer, name, gunzip, place, bytes, diags);
}

static void release(void *user, plr_bytes *bytes) {
    (void)user;
    plr_bytes_free(bytes);
}

static void report_progress(void *user, const char *name, double done) {
    plr_scene_progress(user, name, done);
}

/* What there is to make: which node, and whose volume. */
typedef struct reading {
    const plr_node *texture;
    plr_volume *volume;
} reading;

static plr_volume_source make_source(const reading *r, plr_scene *scene, const plr_bytes *bytes,
                                     plr_place place, plr_diags *diags) {
    plr_volume_source source = {.data = bytes->data,
                                .length = bytes->length,
                                .name = bytes->name ? bytes->name : "the data",
                                .place = place,
                                .diags = diags,
                                .load = load_beside,
                                .release = release,
                                .progress = report_progress,
                                .user = scene};
    const plr_field *time = plr_node_field(r->texture, "timePoint");
    if (time && time->given) {
        int64_t point = plr_node_int(r->texture, "timePoint");
        source.time_given = true;
        source.time_point = point < 0 ? 0 : (uint32_t)point;
        source.time_place = time->place;
    }
    return source;
}

static bool read_volume(const reading *r, plr_scene *scene, const plr_bytes *bytes, plr_place place,
                        plr_diags *diags) {
    plr_volume_source source = make_source(r, scene, bytes, place, diags);
    return plr_volume_parse(&source, r->volume);
}

/* ---- Labels beside ---- */

/* The name without its folder, and without .gz. */
static size_t stem(const char *name, const char **base) {
    const char *slash = strrchr(name, '/');
    *base = slash ? slash + 1 : name;
    size_t length = strlen(*base);
    return length > 3 && strcmp(*base + length - 3, ".gz") == 0 ? length - 3 : length;
}

/* aal.nii.gz: aal.nii.txt, then aal.txt. Where neither is a list of labels, nothing is said: it is
 * some other text. */
static void read_labels_beside(plr_scene *scene, const char *name, plr_volume *volume,
                               plr_diags *diags) {
    const char *base;
    size_t length = stem(name, &base);
    for (int try = 0; try < 2 && !volume->labels.count; try++) {
        char beside[4096];
        plr_bytes bytes;
        while (try && length && base[length - 1] != '.')
            length--;
        if (length < 2 || length + 5 > sizeof beside)
            return;
        snprintf(beside, sizeof beside, "%.*s.txt", (int)(length - (size_t)try), base);
        if (!plr_scene_load_beside(scene, name, beside, false, (plr_place){0}, &bytes, NULL))
            continue;
        plr_labels_read(&volume->labels, bytes.data, bytes.length, bytes.name ? bytes.name : beside,
                        diags);
        plr_bytes_free(&bytes);
    }
}

/* Nothing is asked of the network that nobody named. */
static bool may_have_labels(const plr_bytes *bytes, const plr_volume *volume) {
    return bytes->name && !strstr(bytes->name, "://") && strncmp(bytes->name, "data:", 5) != 0 &&
           volume->components == 1 && !volume->labels.count;
}

/* ---- ImageTexture3D ---- */

/* Files of other volume formats, so that the message can name what they are. */
static const struct {
    const char *magic, *name;
    size_t offset, length;
} other_formats[] = {
    {"\xabKTX ", "KTX", 0, 5},
    {"\x89HDF", "HDF5", 0, 4},
    {"# vtk", "VTK", 0, 5},
};

static const char *name_other_format(const plr_bytes *bytes) {
    for (size_t i = 0; i < sizeof other_formats / sizeof *other_formats; i++)
        if (bytes->length >= other_formats[i].offset + other_formats[i].length &&
            memcmp(bytes->data + other_formats[i].offset, other_formats[i].magic,
                   other_formats[i].length) == 0)
            return other_formats[i].name;
    return NULL;
}

static bool read_image(const plr_bytes *bytes, plr_place place, plr_volume *volume,
                       plr_diags *diags) {
    plr_image image;
    if (!plr_image_decode(bytes->data, bytes->length, place, &image, diags))
        return false;
    bool ok = !image.cube && plr_volume_check_image(&image, place, diags);
    if (image.cube)
        plr_diags_add(diags, PLR_CODE_BAD_VOLUME, place, "%s is a cube map, not a volume",
                      bytes->name);
    if (ok)
        plr_volume_from_image(&image, volume);
    plr_image_free(&image);
    return ok;
}

/* By content: NRRD, NIfTI, else a picture: DDS volumes, others as a volume of one slice. */
static bool from_bytes(const reading *r, plr_scene *scene, const plr_bytes *bytes, plr_place place,
                       plr_diags *diags) {
    const char *other = name_other_format(bytes);
    if (other) {
        plr_diags_add(diags, PLR_CODE_BAD_VOLUME, place,
                      "%s is a file of format %s, which is not read; convert it to NRRD or NIfTI",
                      bytes->name, other);
        return false;
    }
    bool is_volume = plr_is_gzip(bytes->data, bytes->length) ||
                     plr_volume_sniff(bytes->data, bytes->length) != PLR_VOLUME_UNKNOWN;
    bool fine = is_volume ? read_volume(r, scene, bytes, place, diags)
                          : read_image(bytes, place, r->volume, diags);
    if (fine && may_have_labels(bytes, r->volume))
        read_labels_beside(scene, bytes->name, r->volume, diags);
    return fine;
}

/* ---- Stacks of files ---- */

typedef struct numbered {
    plr_scene *scene;
    const plr_string *url;
    plr_place place;
    plr_file_pattern pattern;
    bool loaded; /* the last one was there */
} numbered;

static bool load_numbered(void *user, size_t index, plr_image *slice, plr_place *place,
                          plr_diags *diags) {
    numbered *n = user;
    char name[4096];
    plr_bytes bytes;
    int64_t number = n->pattern.first + (int64_t)index * n->pattern.step;
    *place = n->place;
    n->loaded = false;
    if (!plr_pattern_expand(n->pattern.name, n->pattern.length, number, name, sizeof name)) {
        plr_diags_add(diags, PLR_CODE_BAD_VOLUME, n->place, "the name of file %lld cannot be made",
                      (long long)number);
        return false;
    }
    const plr_string url = {name, strlen(name), n->url->origin};
    if (!plr_scene_load(n->scene, &url, true, &bytes, diags))
        return false;
    n->loaded = true;
    /* faults are those of the file */
    plr_place file = {bytes.name ? bytes.name : name, 0, 0};
    bool fine = plr_image_decode(bytes.data, bytes.length, file, slice, diags);
    plr_bytes_free(&bytes);
    if (fine)
        plr_image_flatten(slice);
    plr_scene_progress(n->scene, name, (double)(index + 1) / (double)n->pattern.count);
    return fine;
}

/* ---- Folders ---- */

enum {
    MAX_FILES = 10000
};

/* "scans/" or "scans/#SeriesInstanceUID": the slices that lie there. */
static plr_url_outcome read_folder(const reading *r, plr_scene *scene, const plr_string *url,
                                   plr_place place, plr_diags *diags) {
    plr_bytes names;
    if (!plr_scene_list(scene, url, MAX_FILES, &names, diags))
        return PLR_URL_NOT_LOADED;
    plr_volume_source source = make_source(r, scene, &names, place, diags);
    const char *mark = strchr(url->text, '#');
    bool fine = plr_volume_parse_dicom_folder(&source, mark ? mark + 1 : NULL, r->volume);
    plr_bytes_free(&names);
    return fine ? PLR_URL_FINE : PLR_URL_NOT_UNDERSTOOD;
}

static plr_url_outcome read_url(void *user, plr_scene *scene, const plr_string *url,
                                plr_place place, plr_diags *diags) {
    const reading *r = user;
    numbered n = {.scene = scene, .url = url, .place = place};
    if (plr_url_is_folder(url))
        return read_folder(r, scene, url, place, diags);
    bool is_name = url->length < 4096 && strncmp(url->text, "data:", 5) != 0;
    if (is_name && plr_file_pattern_parse(&n.pattern, url->text, url->length))
        return plr_volume_from_slices(load_numbered, &n, n.pattern.count, place, r->volume, diags)
                   ? PLR_URL_FINE
               : n.loaded ? PLR_URL_NOT_UNDERSTOOD
                          : PLR_URL_NOT_LOADED;
    plr_bytes bytes;
    if (!plr_scene_load(scene, url, true, &bytes, diags))
        return PLR_URL_NOT_LOADED;
    bool fine = from_bytes(r, scene, &bytes, place, diags);
    plr_bytes_free(&bytes);
    return fine ? PLR_URL_FINE : PLR_URL_NOT_UNDERSTOOD;
}

bool plr_volume_from_urls(plr_scene *scene, const plr_node *texture, plr_volume *volume,
                          plr_diags *diags) {
    reading r = {texture, volume};
    return plr_node_bool(texture, "load") && plr_node_urls(scene, texture, read_url, &r, diags);
}
