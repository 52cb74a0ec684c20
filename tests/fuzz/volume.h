/* What the fuzz targets of the volume readers share. */
#ifndef TESTS_FUZZ_VOLUME_H
#define TESTS_FUZZ_VOLUME_H

#include <stdlib.h>
#include <string.h>

#include "engine/volume_internal.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Every detached file is a copy of the input: headers that name files are then read to the end. */
static bool load_copy(void *user, const char *referrer, const char *name, bool gunzip,
                      plr_place place, plr_bytes *bytes, plr_diags *diags) {
    const plr_volume_source *source = user;
    (void)referrer;
    (void)gunzip;
    if (strchr(name, '!')) {
        plr_diags_add(diags, PLR_CODE_MISSING_FILE, place, "%s", name);
        return false;
    }
    memset(bytes, 0, sizeof *bytes);
    bytes->data = malloc(source->length + 1);
    if (!bytes->data)
        return false;
    memcpy(bytes->data, source->data, source->length);
    bytes->length = source->length;
    return true;
}

static void release_copy(void *user, plr_bytes *bytes) {
    (void)user;
    free(bytes->data);
}

/* Reads the input and uses what it gives, if that is not large. */
static inline void fuzz_volume(const uint8_t *data, size_t size) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_volume_source source = {.data = (const char *)data,
                                .length = size,
                                .name = "folder/input.hdr",
                                .diags = diags,
                                .load = load_copy,
                                .release = release_copy};
    source.user = &source;
    source.time_given = size > 0;
    source.time_point = size > 0 ? data[size - 1] % 4 : 0;
    plr_volume volume;
    plr_image image;
    if (plr_volume_parse(&source, &volume)) {
        uint32_t last = volume.size[2] - 1;
        (void)plr_volume_value(&volume, volume.size[0] - 1, volume.size[1] - 1, last,
                               volume.components - 1);
        if (plr_volume_count(&volume) < 1u << 16 &&
            plr_volume_to_image(&volume, (const double[2]){0, 0}, &image)) {
            (void)plr_image_gradient_percentile(&image, (const double[3]){1, 1, 1});
            plr_image_free(&image);
        }
        plr_volume_free(&volume);
    }
    plr_diags_destroy(&diags);
}

#endif
