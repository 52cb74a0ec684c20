/* DICOM images as volumes: what the files of the reader share. In the order of work: the structure
 * of a file is checked (scan), its elements are read through a library (volume_dicom_file.h) into
 * slices (header), slices are put in order (order), and their frames become voxels (pixels). */
#ifndef PLR_ENGINE_VOLUME_DICOM_H
#define PLR_ENGINE_VOLUME_DICOM_H

#include "engine/volume_dicom_file.h"
#include "engine/volume_internal.h"

#define PLR_DICOM_UID 65 /* PS3.5, 9: at most 64 characters */

/* ---- Scan ---- */

/* A data set (PS3.5, 7) whose lengths, depth and order have been checked. */
typedef struct plr_dicom_set {
    const char *data; /* without preamble and file meta information */
    size_t header;    /* bytes before the pixel data */
    size_t length;    /* with the pixel data; what follows is left out */
    char syntax[PLR_DICOM_UID];
    size_t fragments; /* of packed pixel data, with the table of offsets; 0: not packed */
    size_t value;     /* where the value of the pixel data begins */
    bool big;         /* the most significant byte first */
    bool is_bytes;    /* the pixel data are of VR OB */
    bool has_pixels;
    size_t pixels; /* bytes of pixel data */
    uint32_t pixel_tag;
    char *unpacked; /* owned memory that `data` lies in, or NULL */
} plr_dicom_set;

/* Returns NULL, or says what is wrong. */
const char *plr_dicom_scan(const char *data, size_t length, plr_dicom_set *set);
void plr_dicom_set_free(plr_dicom_set *set);

/* ---- Slices ---- */

typedef enum plr_dicom_pixels {
    PLR_DICOM_INTEGERS, /* (7FE0,0010) */
    PLR_DICOM_FLOATS,   /* (7FE0,0008) */
    PLR_DICOM_DOUBLES   /* (7FE0,0009) */
} plr_dicom_pixels;

/* How the samples of a slice are stored (PS3.3, C.7.6.3). */
typedef struct plr_dicom_format {
    uint32_t columns, rows, samples;  /* 1 or 3 samples a pixel */
    uint32_t allocated, stored, high; /* bits */
    bool is_signed;
    bool inverted; /* MONOCHROME1 */
    bool is_ybr;
    bool planar; /* all of one colour, then all of the next */
    plr_dicom_pixels pixels;
} plr_dicom_format;

typedef struct plr_dicom_slice {
    uint32_t file, frame; /* where it comes from */
    plr_dicom_format format;
    bool has_place;
    double position[3];       /* of the first pixel's centre, mm, patient axes */
    double orientation[2][3]; /* unit vectors along a row, along a column */
    bool has_spacing;
    double spacing[2]; /* between pixels of a row, of a column, mm */
    double thickness;  /* to the next slice where positions do not tell; 0: not said */
    double slope, intercept;
    bool has_window, has_padding;
    double window[2];  /* physical values, from black to white */
    double padding[2]; /* stored values of what is no part of the picture */
    double instance;   /* number in the series */
    double along;      /* distance along the normal of the slices */
} plr_dicom_slice;

typedef struct plr_dicom_slices {
    plr_dicom_slice *items; /* owned */
    size_t count, capacity;
} plr_dicom_slices;

/* Reads what the header of a file says of its frames, and appends them. `series` gets its
 * SeriesInstanceUID. A file without pictures adds none. False with a fault. */
bool plr_dicom_read_slices(const plr_dicom_set *set, uint32_t file, plr_dicom_slices *slices,
                           char series[PLR_DICOM_UID], char fault[PLR_DICOM_FAULT]);

/* ---- Order ---- */

/* What the messages about a series need. */
typedef struct plr_dicom_report {
    plr_diags *diags;
    plr_place place;
    const char *name; /* of the folder or file */
    /* The name of file `index`, for messages. */
    const char *(*file_name)(const void *user, uint32_t index);
    const void *user;
    bool time_given; /* slices at one place are points in time, and the author knows */
} plr_dicom_report;

/* Evenly spaced slices, which are those of the file or lie between them. */
typedef struct plr_dicom_grid {
    size_t count;
    double first, step; /* along the normal */
    bool resampled;
} plr_dicom_grid;

/* Sorts slices by place, takes out those whose place is taken (`time_point` counts them) and gives
 * `volume` its geometry. False with an error where they are no volume. */
bool plr_dicom_order(plr_dicom_slices *slices, uint32_t time_point, const plr_dicom_report *report,
                     plr_dicom_grid *grid, plr_volume *volume);

/* ---- Frames ---- */

/* A file whose frames are read. */
typedef struct plr_dicom_frames {
    plr_dicom_set set;
    plr_dicom *library; /* that unpacks; NULL where nothing needs it */
    bool is_rle;
    size_t fragment, at; /* the last one that was looked for, and where it is */
} plr_dicom_frames;

/* `data` must stay as long as `frames`. To be closed also where it fails. */
bool plr_dicom_frames_open(plr_dicom_frames *frames, const char *data, size_t length,
                           char fault[PLR_DICOM_FAULT]);
/* The stored pixels of a slice in native byte order: `size` bytes, with room for one more. Colours
 * are in the order that the slice's format says. Quickest in the order of the file. */
bool plr_dicom_frames_read(plr_dicom_frames *frames, const plr_dicom_slice *slice, void *out,
                           size_t size, bool *is_ybr, char fault[PLR_DICOM_FAULT]);
void plr_dicom_frames_close(plr_dicom_frames *frames);

/* ---- Pixels ---- */

/* Gets the stored pixels of a slice: `size` bytes; there is room for one more. */
typedef bool (*plr_dicom_frame_reader)(void *user, const plr_dicom_slice *slice, void *out,
                                       size_t size, bool *is_ybr);
/* Makes the voxels of a volume whose geometry is known: frames are read in the order of files,
 * their values brought to one type, padding is filled, slices are resampled to the grid. Sets all
 * that is left of the volume. False with an error, or where `read` failed. */
bool plr_dicom_voxels(const plr_dicom_slices *slices, const plr_dicom_grid *grid,
                      plr_dicom_frame_reader read, void *user, const plr_dicom_report *report,
                      plr_volume *volume);

#endif
