/* DICOM files as volumes: one file of one or many frames, or the files of a folder. */
#include "engine/volume_dicom.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MAX_WARNINGS = 5, /* about single files */
    MAX_LISTED = 8    /* series in one message */
};

typedef struct dicom_file {
    const char *name;
    size_t series;
} dicom_file;

typedef struct dicom_series {
    char uid[PLR_DICOM_UID];
    size_t slices;
} dicom_series;

/* All that is read of a file or folder. */
typedef struct collection {
    const plr_volume_source *source;
    bool is_folder;
    dicom_file *files;
    size_t file_count;
    dicom_series *series;
    size_t series_count;
    plr_dicom_slices slices;
    size_t damaged, unreadable;
    const char *unread; /* one of the unreadable */
    /* the file whose frames are read */
    bool is_open;
    uint32_t open_file;
    plr_bytes bytes;
    plr_dicom_frames frames;
    size_t frames_read;
} collection;

static bool fail(const collection *all, const char *name, const char *why) {
    plr_diags_add(all->source->diags, PLR_CODE_BAD_VOLUME, all->source->place,
                  "%s cannot be read as DICOM: %s", name, why);
    return false;
}

static bool no_memory(const collection *all) {
    plr_diags_add(all->source->diags, PLR_CODE_NO_MEMORY, all->source->place,
                  "there is not enough memory");
    return false;
}

static const char *file_name(const void *user, uint32_t index) {
    const collection *all = user;
    return all->files[index].name;
}

/* Half of the way are the headers, half are the frames. */
static void tell(const collection *all, double done) {
    if (all->source->progress)
        all->source->progress(all->source->user, all->source->name, done);
}

/* ---- Bytes ---- */

/* The bytes of a file: those that are there already, or loaded. */
static bool load_file(const collection *all, const char *name, plr_bytes *bytes, plr_diags *diags) {
    const plr_volume_source *source = all->source;
    if (all->is_folder)
        return source->load &&
               source->load(source->user, source->name, name, true, source->place, bytes, diags);
    *bytes = (plr_bytes){.data = (char *)(uintptr_t)source->data, .length = source->length};
    return true;
}

static void release_file(const collection *all, plr_bytes *bytes) {
    if (all->is_folder)
        all->source->release(all->source->user, bytes);
}

/* ---- Headers ---- */

static size_t find_series(collection *all, const char *uid) {
    size_t i = 0;
    while (i < all->series_count && strcmp(all->series[i].uid, uid) != 0)
        i++;
    if (i == all->series_count)
        snprintf(all->series[all->series_count++].uid, PLR_DICOM_UID, "%s", uid);
    return i;
}

static const char *read_header(collection *all, const plr_bytes *bytes, const char *name,
                               char fault[PLR_DICOM_FAULT]) {
    char uid[PLR_DICOM_UID];
    plr_dicom_set set;
    size_t before = all->slices.count;
    uint32_t index = (uint32_t)all->file_count;
    const char *wrong = plr_dicom_scan(bytes->data, bytes->length, &set);
    if (!wrong && !plr_dicom_read_slices(&set, index, &all->slices, uid, fault))
        wrong = fault;
    if (!wrong && all->slices.count > before) {
        size_t series = find_series(all, uid);
        all->files[all->file_count++] = (dicom_file){name, series};
        all->series[series].slices += all->slices.count - before;
    }
    plr_dicom_set_free(&set);
    return wrong;
}

/* A file that is damaged or may not be read is left out: what it would have shown is missing. */
static void collect_file(collection *all, const char *name) {
    plr_bytes bytes;
    char fault[PLR_DICOM_FAULT] = "";
    if (!load_file(all, name, &bytes, NULL)) {
        all->unreadable++;
        all->unread = name;
        return;
    }
    const char *wrong = NULL;
    if (plr_dicom_sniff(bytes.data, bytes.length))
        wrong = read_header(all, &bytes, name, fault);
    if (wrong && all->damaged++ < MAX_WARNINGS)
        plr_diags_add_as(all->source->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME, all->source->place,
                         "%s is left out: %s", name, wrong);
    release_file(all, &bytes);
}

static bool allocate(collection *all, size_t count) {
    all->files = calloc(count, sizeof *all->files);
    all->series = calloc(count, sizeof *all->series);
    return (all->files && all->series) || no_memory(all);
}

static bool collect_folder(collection *all) {
    const plr_volume_source *source = all->source;
    const char *end = source->data + source->length;
    size_t count = 0;
    for (const char *name = source->data; name < end; name += strlen(name) + 1)
        count++;
    if (!plr_dicom_is_built())
        return fail(all, source->name, "this plugray was built without DICOM");
    if (count == 0)
        return fail(all, source->name, "the folder is empty");
    if (!allocate(all, count))
        return false;
    size_t done = 0;
    for (const char *name = source->data; name < end; name += strlen(name) + 1) {
        collect_file(all, name);
        tell(all, (double)++done / (double)count / 2);
    }
    if (all->unreadable)
        plr_diags_add_as(source->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME, source->place,
                         "%zu files of %s cannot be read, among them %s", all->unreadable,
                         source->name, all->unread);
    return all->slices.count > 0 || fail(all, source->name, "none of its files holds pictures");
}

static bool collect_single(collection *all) {
    const plr_volume_source *source = all->source;
    const plr_bytes bytes = {.data = (char *)(uintptr_t)source->data, .length = source->length};
    char fault[PLR_DICOM_FAULT] = "";
    if (!allocate(all, 1))
        return false;
    const char *wrong = read_header(all, &bytes, source->name, fault);
    if (!wrong && all->slices.count == 0)
        wrong = "it holds no pictures";
    return !wrong || fail(all, source->name, wrong);
}

/* ---- Series ---- */

/* Names the series that are not read. */
static void warn_of_others(const collection *all, size_t chosen) {
    char text[MAX_LISTED * 100] = "";
    size_t used = 0, listed = 0;
    for (size_t i = 0; i < all->series_count && listed < MAX_LISTED; i++) {
        if (i == chosen)
            continue;
        int length = snprintf(text + used, sizeof text - used, "%s'%s' (%zu slices)",
                              listed ? ", " : "", all->series[i].uid, all->series[i].slices);
        used += (size_t)length;
        listed++;
    }
    plr_diags_add_as(all->source->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME, all->source->place,
                     "%s holds %zu series; the largest, '%s' (%zu slices), is read, but not %s%s",
                     all->source->name, all->series_count, all->series[chosen].uid,
                     all->series[chosen].slices, text,
                     all->series_count - 1 > listed ? " and others" : "");
}

static bool choose_series(collection *all, const char *wanted) {
    size_t chosen = 0;
    bool is_named = wanted && *wanted;
    for (size_t i = 0; i < all->series_count; i++)
        if (is_named ? strcmp(all->series[i].uid, wanted) == 0
                     : all->series[i].slices > all->series[chosen].slices)
            chosen = i;
    if (is_named && strcmp(all->series[chosen].uid, wanted) != 0)
        return fail(all, all->source->name, "it has no series of this SeriesInstanceUID");
    if (!is_named && all->series_count > 1)
        warn_of_others(all, chosen);
    size_t kept = 0;
    for (size_t i = 0; i < all->slices.count; i++)
        if (all->files[all->slices.items[i].file].series == chosen)
            all->slices.items[kept++] = all->slices.items[i];
    all->slices.count = kept;
    return true;
}

/* ---- Frames ---- */

static void close_file(collection *all) {
    if (!all->is_open)
        return;
    plr_dicom_frames_close(&all->frames);
    release_file(all, &all->bytes);
    all->is_open = false;
}

static bool open_file(collection *all, uint32_t index) {
    const char *name = all->files[index].name;
    char fault[PLR_DICOM_FAULT] = "";
    close_file(all);
    if (!load_file(all, name, &all->bytes, all->source->diags))
        return false;
    all->is_open = true;
    all->open_file = index;
    return plr_dicom_frames_open(&all->frames, all->bytes.data, all->bytes.length, fault) ||
           fail(all, name, fault);
}

static bool read_frame(void *user, const plr_dicom_slice *slice, void *out, size_t size,
                       bool *is_ybr) {
    collection *all = user;
    char fault[PLR_DICOM_FAULT] = "";
    if ((!all->is_open || all->open_file != slice->file) && !open_file(all, slice->file))
        return false;
    tell(all, 0.5 + (double)++all->frames_read / (double)all->slices.count / 2);
    return plr_dicom_frames_read(&all->frames, slice, out, size, is_ybr, fault) ||
           fail(all, all->files[slice->file].name, fault);
}

/* ---- Volumes ---- */

static bool read_collection(collection *all, plr_volume *volume) {
    const plr_volume_source *source = all->source;
    const plr_dicom_report report = {.diags = source->diags,
                                     .place = source->place,
                                     .name = source->name,
                                     .file_name = file_name,
                                     .user = all,
                                     .time_given = source->time_given};
    plr_dicom_grid grid;
    memset(volume, 0, sizeof *volume);
    return plr_dicom_order(&all->slices, source->time_point, &report, &grid, volume) &&
           plr_dicom_voxels(&all->slices, &grid, read_frame, all, &report, volume);
}

static void free_collection(collection *all) {
    close_file(all);
    free(all->files);
    free(all->series);
    free(all->slices.items);
}

bool plr_volume_parse_dicom(const plr_volume_source *source, plr_volume *volume) {
    collection all = {.source = source};
    bool ok = collect_single(&all) && read_collection(&all, volume);
    free_collection(&all);
    return ok;
}

bool plr_volume_parse_dicom_folder(const plr_volume_source *source, const char *series,
                                   plr_volume *volume) {
    collection all = {.source = source, .is_folder = true};
    bool ok = collect_folder(&all) && choose_series(&all, series) && read_collection(&all, volume);
    free_collection(&all);
    if (!ok)
        memset(volume, 0, sizeof *volume);
    return ok;
}
