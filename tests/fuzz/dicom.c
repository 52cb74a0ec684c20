/* DICOM files, alone and as folders: the input is cut into files where "====" stands. */
#include "volume.h"

enum {
    MAX_FILES = 8
};

typedef struct cut {
    const char *files[MAX_FILES];
    size_t lengths[MAX_FILES], count;
} cut;

static void cut_input(const char *data, size_t size, cut *c) {
    size_t start = 0;
    c->count = 0;
    for (size_t i = 0; i <= size && c->count < MAX_FILES; i++) {
        bool ends = i == size || (size - i >= 4 && memcmp(data + i, "====", 4) == 0);
        if (!ends)
            continue;
        c->files[c->count] = data + start;
        c->lengths[c->count++] = i - start;
        start = i + 4;
        i += 3;
    }
}

/* Files are called "0", "1", ... */
static bool load_cut(void *user, const char *referrer, const char *name, bool gunzip,
                     plr_place place, plr_bytes *bytes, plr_diags *diags) {
    const cut *c = user;
    size_t index = (size_t)(*name - '0');
    (void)referrer;
    (void)gunzip;
    (void)place;
    (void)diags;
    /* a block of its exact length: a read behind it is seen */
    *bytes = (plr_bytes){.data = malloc(c->lengths[index] + 1), .length = c->lengths[index]};
    if (bytes->data)
        memcpy(bytes->data, c->files[index], bytes->length);
    return bytes->data != NULL;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char names[] = "0\0001\0002\0003\0004\0005\0006\0007";
    cut c;
    cut_input((const char *)data, size, &c);
    if (c.count == 1 && plr_dicom_sniff((const char *)data, size))
        fuzz_volume(data, size);
    plr_diags *diags = plr_diags_create(NULL);
    plr_volume_source source = {.data = names,
                                .length = 2 * c.count,
                                .name = "scan/",
                                .diags = diags,
                                .load = load_cut,
                                .release = release_copy,
                                .user = &c};
    plr_volume volume;
    if (plr_volume_parse_dicom_folder(&source, NULL, &volume)) {
        uint32_t last = volume.size[2] - 1;
        (void)plr_volume_value(&volume, volume.size[0] - 1, volume.size[1] - 1, last,
                               volume.components - 1);
        plr_volume_free(&volume);
    }
    plr_diags_destroy(&diags);
    return 0;
}
