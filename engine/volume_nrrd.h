/* The two halves of the NRRD reader: the header, and the data that it describes. */
#ifndef PLR_ENGINE_VOLUME_NRRD_H
#define PLR_ENGINE_VOLUME_NRRD_H

#include "engine/volume_internal.h"

#define NRRD_MAX_AXES 16
#define NRRD_MAX_FILES 65536

typedef enum nrrd_encoding {
    NRRD_NO_ENCODING,
    NRRD_RAW,
    NRRD_GZIP,
    NRRD_ASCII,
    NRRD_HEX,
    NRRD_BZIP2
} nrrd_encoding;

/* What an axis means, for the order of the voxels. */
typedef enum nrrd_role {
    NRRD_NO_ROLE, /* the header does not say */
    NRRD_SPATIAL,
    NRRD_COMPONENTS, /* a list, a vector, a colour */
    NRRD_TIME,
    NRRD_FIRST_ONLY /* time, or what there is no room for: only one index is kept */
} nrrd_role;

/* A stretch of the header. */
typedef struct nrrd_text {
    const char *at, *end;
} nrrd_text;

typedef enum nrrd_files {
    NRRD_ATTACHED,
    NRRD_ONE_FILE,
    NRRD_PATTERN, /* name%03d.raw minimum maximum step */
    NRRD_LIST     /* one name a line */
} nrrd_files;

/* Values of a field that has one for each axis; the place is that of the field, line 0: not given.
 */
typedef struct nrrd_per_axis {
    size_t count;
    plr_place place;
} nrrd_per_axis;

typedef struct nrrd_segment nrrd_segment;

typedef struct nrrd {
    const plr_volume_source *source;
    /* reading */
    const char *line_start;
    uint32_t line;
    const char *data; /* what follows the header; NULL: nothing does */
    /* fields */
    plr_place sizes_place, encoding_place, type_place, files_place;
    bool has_type, has_endian, big_endian;
    plr_voxel_type type;
    nrrd_encoding encoding;
    uint64_t dimension;
    uint64_t sizes[NRRD_MAX_AXES];
    nrrd_role kinds[NRRD_MAX_AXES];
    double spacings[NRRD_MAX_AXES];
    double units[NRRD_MAX_AXES]; /* metres, 0: unknown */
    double directions[NRRD_MAX_AXES][3];
    bool no_direction[NRRD_MAX_AXES];
    nrrd_per_axis sizes_given, kinds_given, spacings_given, units_given, directions_given;
    uint64_t space_dimension;
    plr_volume_space space;
    double origin[3], space_units[3];
    size_t origin_count, space_unit_count, direction_components;
    double minimum, maximum; /* NAN: not declared */
    uint64_t line_skip;
    int64_t byte_skip;
    /* detached data */
    nrrd_files files;
    nrrd_text file_name; /* or the pattern, or the first line of the list */
    int64_t first, last, step;
    uint64_t file_count, file_dimension; /* the latter 0: not given */
    /* key/value pairs */
    nrrd_segment *segments; /* owned; by their number in the keys */
    size_t segment_count;
    plr_labels labels; /* owned */
} nrrd;

/* Reads the fields; false with an error at the header's own line. To be freed in both cases. */
bool plr_nrrd_read_header(nrrd *header, const plr_volume_source *source);
/* Reads the voxels into `volume` (size, components, type, voxels). */
bool plr_nrrd_read_data(const nrrd *header, plr_volume *volume);

void plr_nrrd_free(nrrd *header);
/* A key/value pair; what is no label is read over. */
void plr_nrrd_read_key(nrrd *header, nrrd_text key, nrrd_text value);
/* The labels of the keys, finished; they are the caller's. */
void plr_nrrd_take_labels(nrrd *header, plr_labels *labels);

/* Where `at`, on the line being read, stands. */
plr_place plr_nrrd_place(const nrrd *header, const char *at);
#define NRRD_FAIL(header, place, ...)                                                              \
    (plr_diags_add((header)->source->diags, PLR_CODE_BAD_VOLUME, place, __VA_ARGS__), false)

#endif
