/* What the tests of the volume readers share: files in memory, reading them, bytes of numbers. */
#ifndef TESTS_ENGINE_VOLUME_TEST_H
#define TESTS_ENGINE_VOLUME_TEST_H

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "engine/volume_internal.h"
#include "tests/tap.h"

typedef struct file {
    const char *name;
    unsigned char data[4096];
    size_t length;
} file;

/* The folder that detached data are loaded from. */
typedef struct folder {
    file files[8];
    size_t count;
} folder;

static inline void add_bytes(file *f, const void *data, size_t length) {
    memcpy(f->data + f->length, data, length);
    f->length += length;
}

static inline void add_text(file *f, const char *text) {
    add_bytes(f, text, strlen(text));
}

static inline file *add_file(folder *in, const char *name) {
    file *f = &in->files[in->count++];
    memset(f, 0, sizeof *f);
    f->name = name;
    return f;
}

/* The lowest `size` bytes of the bits, in either order. */
static inline void add_bits(file *f, uint64_t bits, size_t size, bool big_endian) {
    for (size_t i = 0; i < size; i++) {
        size_t shift = 8 * (big_endian ? size - 1 - i : i);
        unsigned char byte = (unsigned char)(bits >> shift);
        add_bytes(f, &byte, 1);
    }
}

static inline void add_number(file *f, plr_voxel_type type, double number, bool big_endian) {
    uint64_t bits = 0;
    uint32_t narrow;
    float single = (float)number;
    switch (type) {
    case PLR_VOXEL_F32:
        memcpy(&narrow, &single, 4);
        bits = narrow;
        break;
    case PLR_VOXEL_F64:
        memcpy(&bits, &number, 8);
        break;
    default:
        bits = (uint64_t)(int64_t)number;
        break;
    }
    add_bits(f, bits, plr_voxel_size(type), big_endian);
}

static inline void add_gzip(file *f, const void *data, size_t length) {
    z_stream stream;
    memset(&stream, 0, sizeof stream);
    deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
    stream.next_in = (Bytef *)(uintptr_t)data;
    stream.avail_in = (uInt)length;
    stream.next_out = f->data + f->length;
    stream.avail_out = (uInt)(sizeof f->data - f->length);
    deflate(&stream, Z_FINISH);
    f->length += stream.total_out;
    deflateEnd(&stream);
}

static inline bool load_from_folder(void *user, const char *referrer, const char *name, bool gunzip,
                                    plr_place place, plr_bytes *bytes, plr_diags *diags) {
    const folder *in = user;
    (void)referrer;
    for (size_t i = 0; i < in->count; i++) {
        const file *f = &in->files[i];
        if (strcmp(f->name, name) != 0)
            continue;
        const char *fault;
        memset(bytes, 0, sizeof *bytes);
        bytes->length = f->length;
        if (gunzip && plr_is_gzip((const char *)f->data, f->length)) {
            bytes->data =
                plr_gunzip((const char *)f->data, f->length, 65536, &bytes->length, &fault);
        } else {
            bytes->data = malloc(f->length + 1);
            memcpy(bytes->data, f->data, f->length);
        }
        bytes->name = malloc(strlen(name) + 1);
        strcpy(bytes->name, name);
        return bytes->data != NULL;
    }
    plr_diags_add(diags, PLR_CODE_MISSING_FILE, place, "%s does not exist", name);
    return false;
}

static inline void release_bytes(void *user, plr_bytes *bytes) {
    (void)user;
    free(bytes->data);
    free(bytes->name);
}

/* Reads the first file of the folder. The bytes are copied to a block of their exact length, so
 * that a read behind it is seen. */
static inline bool read_volume(folder *in, plr_volume *volume, plr_diags *diags) {
    const file *f = &in->files[0];
    char *exact = malloc(f->length ? f->length : 1);
    memcpy(exact, f->data, f->length);
    plr_volume_source source = {.data = exact,
                                .length = f->length,
                                .name = f->name,
                                .place = {"scene.x3d", 7, 3},
                                .diags = diags,
                                .load = load_from_folder,
                                .release = release_bytes,
                                .user = in};
    bool ok = plr_volume_parse(&source, volume);
    free(exact);
    return ok;
}

/* An attached NRRD of this header (an empty line is added) and these bytes. */
static inline bool read_nrrd(const char *header, const void *data, size_t length,
                             plr_volume *volume, plr_diags *diags) {
    static folder in;
    in.count = 0;
    file *f = add_file(&in, "head.nrrd");
    add_text(f, header);
    add_text(f, "\n");
    add_bytes(f, data, length);
    return read_volume(&in, volume, diags);
}

/* "file:line:column severity message" of the index-th diagnostic. */
static inline const char *diag_text(const plr_diags *diags, size_t index) {
    static char text[1024];
    const plr_diag *diag = plr_diags_get(diags, index);
    if (!diag)
        return "(none)";
    snprintf(text, sizeof text, "%s:%u:%u %s %s", diag->place.file ? diag->place.file : "",
             diag->place.line, diag->place.column, plr_severity_text(diag->severity),
             diag->message);
    return text;
}

#endif
