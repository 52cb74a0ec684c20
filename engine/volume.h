/* Volume data in memory: NRRD and NIfTI-1 files, PixelTexture3D, ComposedTexture3D, as numbers with
 * their physical meaning, and made ready for a texture. No GL. */
#ifndef PLR_ENGINE_VOLUME_H
#define PLR_ENGINE_VOLUME_H

#include <plugray/engine.h>
#include "engine/image.h"

typedef enum plr_voxel_type {
    PLR_VOXEL_U8,
    PLR_VOXEL_S8,
    PLR_VOXEL_U16,
    PLR_VOXEL_S16,
    PLR_VOXEL_U32,
    PLR_VOXEL_S32,
    PLR_VOXEL_U64,
    PLR_VOXEL_S64,
    PLR_VOXEL_F32,
    PLR_VOXEL_F64
} plr_voxel_type;

/* Which way the axes of the file's space run, where it says: x to the patient's right or left, y to
 * the front or back, z up. */
typedef enum plr_volume_space {
    PLR_SPACE_UNKNOWN,
    PLR_SPACE_RAS,        /* right, anterior, superior: NIfTI */
    PLR_SPACE_LAS,        /* left, anterior, superior */
    PLR_SPACE_LPS,        /* left, posterior, superior: DICOM */
    PLR_SPACE_LEFT_HANDED /* nothing else is known of it */
} plr_volume_space;

/* What a segment number means. */
typedef struct plr_label {
    uint32_t value;
    uint32_t order; /* in the file */
    char *name;     /* UTF-8, at most 255 bytes */
    bool has_color;
    float color[4]; /* straight RGBA, 0..1 */
} plr_label;

/* Ascending by value, each value once: the first of a file counts. At most 65536. */
typedef struct plr_labels {
    plr_label *items; /* owned */
    size_t count;
} plr_labels;

/* Voxels as the file stores them (native byte order), first axis fastest, components innermost.
 * physical value = stored * slope + intercept. */
typedef struct plr_volume {
    uint32_t size[3];    /* voxels along x, y, z */
    uint32_t components; /* 1..4 */
    plr_voxel_type type;
    void *voxels; /* owned */
    double slope, intercept;
    /* The range that maps to 0..1 in physical units: what the file declares (NRRD min/max, NIfTI
     * cal_min/cal_max), else the least and greatest finite value of the data (all components).
     * 8-bit data without slope from textures: 0..255. */
    double minimum, maximum;
    bool range_declared;
    bool has_geometry; /* directions and origin come from the file, millimetres or as units says */
    double directions[3][3]; /* the step from voxel to voxel along axis i, in file space units */
    double origin[3];        /* centre of voxel (0,0,0) */
    double metres;           /* per unit of directions and origin; 0 if the file does not say */
    plr_volume_space space;
    bool unplaced;     /* the file does not say where: the origin means nothing */
    plr_labels labels; /* what the file says of its values as segment numbers; owned */
} plr_volume;

/* From a texture node: ImageTexture3D (url), PixelTexture3D, ComposedTexture3D, ImageTextureAtlas.
 * Files, and those that they refer to, are loaded through the scene's rules. Faults are reported at
 * the url, in a text header at the header's own line. */
bool plr_volume_from_node(plr_scene *scene, const plr_node *texture, plr_volume *volume,
                          plr_diags *diags);
void plr_volume_free(plr_volume *volume);

/* NULL if nothing is known of the number. */
const plr_label *plr_labels_find(const plr_labels *labels, uint32_t value);
void plr_labels_free(plr_labels *labels);

/* Stored value of a voxel as a physical number. */
double plr_volume_value(const plr_volume *volume, uint32_t x, uint32_t y, uint32_t z, uint32_t c);

/* Takes the last component away (of two at least); a range that was not declared is found anew. */
void plr_volume_drop_last_component(plr_volume *volume);

/* The voxels as texture samples in 0..1: linear from range[0]..range[1] (physical; equal: the
 * volume's minimum..maximum), clamped, NaN as 0. UNORM16 for 8-bit data whose range is 0..255
 * (value * 257, exact), FLOAT32 otherwise. NULL-safe, false without memory. */
bool plr_volume_to_image(const plr_volume *volume, const double range[2], plr_image *image);

/* One component of the voxels as segment numbers, in the narrowest of PLR_UINT8, PLR_UINT16 and
 * PLR_UINT32 that holds them: the stored values, without slope and intercept. Negative numbers,
 * NaN and what exceeds 32 bits become 0, fractions are rounded, both with a warning at `place`.
 * NULL-safe; false without memory or such a component. */
bool plr_volume_to_labels(const plr_volume *volume, uint32_t component, plr_place place,
                          plr_image *image, plr_diags *diags);

/* The range that a volume node asks for, in physical units: `valueRange`, else `windowCenter` and
 * `windowWidth`; 0, 0: as the data say. */
void plr_volume_node_range(const plr_node *node, double range[2]);

/* By how much (1, 2, 4, ...) an image's sides must come down so that none has more than `max_side`
 * texels, and a texture of it not more than `max_bytes` bytes; 0: no limit. The latter along all
 * axes alike. */
void plr_image_reduction(const plr_image *image, uint32_t max_side, size_t max_bytes,
                         uint32_t factors[3]);
/* Makes sides smaller by these factors, rounded up, over the same box: by averaging what each new
 * voxel covers; of labels (PLR_UINT types) by the one that most voxels have. False without memory.
 */
bool plr_image_reduce(plr_image *image, const uint32_t factors[3]);

/* Reads the levels of VolumeData.voxelLevels (mipmaps that the scene gives: the further nodes of
 * `voxels` in the dialect of 2005) and warns of those that are not half as large as the one before.
 */
void plr_volume_check_levels(plr_scene *scene, const plr_node *node, const plr_volume *finest,
                             plr_diags *diags);
/* Which of `count` levels has voxels as wide as the distance between samples, but not wider;
 * `voxels` is that distance in voxels of level 0, the finest. */
size_t plr_volume_fitting_level(size_t count, double voxels);

/* The 99th percentile of the non-zero magnitudes of the gradient at voxel centres of component mean
 * (L, or the mean of RGB), in value per unit length, central differences clamped at the border;
 * `dimensions` is the size of the volume in its own coordinates. 1 if all are zero. */
double plr_image_gradient_percentile(const plr_image *image, const double dimensions[3]);

#endif
