/* What the volume readers share. Nothing here knows scenes: detached data come through a callback.
 */
#ifndef PLR_ENGINE_VOLUME_INTERNAL_H
#define PLR_ENGINE_VOLUME_INTERNAL_H

#include <locale.h>

#include "engine/volume.h"

#define PLR_VOLUME_MAX_SIDE 16384u
#define PLR_VOLUME_MAX_BYTES (UINT64_C(4) << 30)

/* A volume file in memory, and how to get at what it refers to. */
typedef struct plr_volume_source {
    const char *data;
    size_t length;
    const char *name; /* of the file, for messages and as the referrer of detached data */
    plr_place place;  /* of the url: where faults without a line of their own are reported */
    plr_diags *diags;
    /* Of data with more than three dimensions: which volume. Not given: the first, and a warning.
     */
    bool time_given;
    uint32_t time_point;
    plr_place time_place;
    /* Loads the file `name` beside `referrer`; NULL: detached data are refused. */
    bool (*load)(void *user, const char *referrer, const char *name, bool gunzip, plr_place place,
                 plr_bytes *bytes, plr_diags *diags);
    void (*release)(void *user, plr_bytes *bytes);
    /* Told how much of the file is decoded, 0 to 1; NULL: nobody asks. */
    void (*progress)(void *user, const char *name, double done);
    void *user;
} plr_volume_source;

typedef enum plr_volume_format {
    PLR_VOLUME_UNKNOWN,
    PLR_VOLUME_NRRD,
    PLR_VOLUME_NIFTI,
    PLR_VOLUME_DICOM,
    PLR_VOLUME_ANALYZE /* recognised so that the message can say so; not read */
} plr_volume_format;

/* By content, never by name. */
plr_volume_format plr_volume_sniff(const char *data, size_t length);
/* Any format, gzipped or not. False with an error; the volume is then empty. */
bool plr_volume_parse(const plr_volume_source *source, plr_volume *volume);
/* One format, not gzipped. They fill everything but the range, and free what they allocated where
 * they fail. A declared range is set with range_declared. */
bool plr_volume_parse_nrrd(const plr_volume_source *source, plr_volume *volume);
bool plr_volume_parse_nifti(const plr_volume_source *source, plr_volume *volume);
/* Whether bytes look like a DICOM file. */
bool plr_dicom_sniff(const char *data, size_t length);
bool plr_volume_parse_dicom(const plr_volume_source *source, plr_volume *volume);
/* The DICOM files of a folder: `source->name` is its name and ends with '/', `source->data` are the
 * names of its files, each with its NUL. `series`: the SeriesInstanceUID of the one to read; NULL
 * or "": the largest. */
bool plr_volume_parse_dicom_folder(const plr_volume_source *source, const char *series,
                                   plr_volume *volume);

/* The volume to read of `count` of them, told by `source`; warns where that is none. */
uint64_t plr_volume_time_point(const plr_volume_source *source, uint64_t count);

/* Gives minimum and maximum their values where the file declares none (NAN: not declared). */
void plr_volume_set_range(plr_volume *volume, double declared_minimum, double declared_maximum);

/* size[0] * size[1] * size[2] * components of a volume within the limits. */
size_t plr_volume_count(const plr_volume *volume);
/* Checks sides and bytes against the limits; false with an error at `place`. */
bool plr_volume_check_size(const uint64_t size[3], uint64_t components, plr_voxel_type type,
                           plr_place place, plr_diags *diags);

/* The pattern with its one %d (%03d, %i, %u) replaced; false where it has another form. */
bool plr_pattern_expand(const char *pattern, size_t length, int64_t number, char *name,
                        size_t size);

/* ---- Names of segments ---- */

/* Adds one to a list that is not finished. `color`: straight RGBA, or NULL. False beyond the limit
 * or without memory. */
bool plr_labels_add(plr_labels *labels, uint32_t value, const char *name, size_t length,
                    const float *color);
/* Sorts and drops what comes twice. */
void plr_labels_finish(plr_labels *labels);
/* Reads lines "number name [red green blue [alpha]]" into an empty list and finishes it. False,
 * silently, for text that is something else. A bad line further on is reported where `file` names
 * the text. */
bool plr_labels_read(plr_labels *labels, const char *text, size_t length, const char *file,
                     plr_diags *diags);

/* The labels in a NIfTI file's bytes from the end of the header on, if there are any. */
void plr_nifti_read_labels(const char *data, size_t start, size_t end, bool swapped,
                           plr_labels *labels);

/* strtod must not follow the host's language: between these it does not. */
typedef struct plr_plain_numbers {
    locale_t plain, before;
} plr_plain_numbers;
plr_plain_numbers plr_plain_numbers_begin(void);
void plr_plain_numbers_end(plr_plain_numbers *numbers);

/* ---- Encodings of voxel data ---- */

size_t plr_voxel_size(plr_voxel_type type); /* bytes */
/* "unsigned 16-bit integers" */
const char *plr_voxel_type_text(plr_voxel_type type);
bool plr_host_is_big_endian(void);
/* Reverses the bytes of each of `count` elements of `size` bytes (1, 2, 4 or 8), in place. */
void plr_swap_bytes(void *data, size_t count, size_t size);

/* Unpacks one or more gzip members: drops `skip` bytes, then writes up to `size` bytes to `out`.
 * Returns how many were written; `fault` is NULL, or says why the packed data ended early. */
size_t plr_inflate(const plr_volume_source *source, const char *data, size_t length, uint64_t skip,
                   void *out, size_t size, const char **fault);
/* Unpacks a whole file of at most `limit` bytes to malloc'ed memory; NULL with `fault` set. */
char *plr_gunzip(const char *data, size_t length, size_t limit, size_t *out_length,
                 const char **fault);
bool plr_is_gzip(const char *data, size_t length);

/* Pairs of hexadecimal digits, blanks anywhere. Returns bytes written; stops at what is no digit.
 */
size_t plr_read_hex(const char *text, size_t length, void *out, size_t size);
/* Numbers in text, separated by blanks or commas. Returns how many were read; where that is less
 * than `count`, `offset` is where reading stopped and `fault` says why (NULL: the text ended). */
size_t plr_read_numbers(const char *text, size_t length, plr_voxel_type type, void *out,
                        size_t count, size_t *offset, const char **fault);

/* Copies a volume of any order of axes: `out` gets `count[0]` fastest, stepping `stride[i]`
 * elements of `size` bytes in `in` along axis i. */
void plr_gather(void *out, const void *in, size_t size, const uint64_t count[4],
                const uint64_t stride[4]);

#endif
