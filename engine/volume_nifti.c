/* The NIfTI reader: versions 1 and 2, one file (.nii) or a pair (.hdr, .img), as the comments of
 * nifti1.h and nifti2.h of the NIfTI Data Format Working Group describe them. */
#include "engine/volume_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Where the fields of the two headers are, and how wide. */
typedef struct layout {
    size_t header_size, magic, dim, dim_width, datatype, pixdim, float_width, vox_offset, slope,
        intercept, cal_max, cal_min, qform, code_width, quatern, qoffset, srow, units, units_width;
} layout;

static const layout layouts[] = {
    {.header_size = 348,
     .magic = 344,
     .dim = 40,
     .dim_width = 2,
     .datatype = 70,
     .pixdim = 76,
     .float_width = 4,
     .vox_offset = 108,
     .slope = 112,
     .intercept = 116,
     .cal_max = 124,
     .cal_min = 128,
     .qform = 252,
     .code_width = 2,
     .quatern = 256,
     .qoffset = 268,
     .srow = 280,
     .units = 123,
     .units_width = 1},
    {.header_size = 540,
     .magic = 4,
     .dim = 16,
     .dim_width = 8,
     .datatype = 12,
     .pixdim = 104,
     .float_width = 8,
     .vox_offset = 168,
     .slope = 176,
     .intercept = 184,
     .cal_max = 192,
     .cal_min = 200,
     .qform = 344,
     .code_width = 4,
     .quatern = 352,
     .qoffset = 376,
     .srow = 400,
     .units = 500,
     .units_width = 4},
};

static const struct {
    int code;
    plr_voxel_type type;
    unsigned char components;
    bool colour; /* slope and intercept do not apply */
} datatypes[] = {
    {2, PLR_VOXEL_U8, 1, false},     {4, PLR_VOXEL_S16, 1, false},
    {8, PLR_VOXEL_S32, 1, false},    {16, PLR_VOXEL_F32, 1, false},
    {32, PLR_VOXEL_F32, 2, false},   {64, PLR_VOXEL_F64, 1, false},
    {128, PLR_VOXEL_U8, 3, true},    {256, PLR_VOXEL_S8, 1, false},
    {512, PLR_VOXEL_U16, 1, false},  {768, PLR_VOXEL_U32, 1, false},
    {1024, PLR_VOXEL_S64, 1, false}, {1280, PLR_VOXEL_U64, 1, false},
    {1792, PLR_VOXEL_F64, 2, false}, {2304, PLR_VOXEL_U8, 4, true},
};

typedef struct nifti {
    const plr_volume_source *source;
    const layout *at;
    bool swapped, pair;
    uint64_t size[3], time, vectors;
    uint64_t point;      /* in time: which of the volumes */
    uint64_t count;      /* elements to read, components and vectors included */
    unsigned components; /* interleaved in the file */
    bool colour;
    plr_voxel_type type;
    uint64_t offset;   /* of the voxels */
    uint64_t text_end; /* of what may stand between header and voxels */
} nifti;

#define FAIL(header, ...)                                                                          \
    (plr_diags_add((header)->source->diags, PLR_CODE_BAD_VOLUME, (header)->source->place,          \
                   __VA_ARGS__),                                                                   \
     false)

/* ---- numbers of the header ---- */

static void copy_field(const nifti *header, size_t offset, void *out, size_t width) {
    memcpy(out, header->source->data + offset, width);
    if (header->swapped)
        plr_swap_bytes(out, 1, width);
}

static int64_t read_integer(const nifti *header, size_t offset, size_t width) {
    int16_t two;
    int32_t four;
    int64_t eight;
    switch (width) {
    case 1:
        return (unsigned char)header->source->data[offset];
    case 2:
        copy_field(header, offset, &two, 2);
        return two;
    case 4:
        copy_field(header, offset, &four, 4);
        return four;
    default:
        copy_field(header, offset, &eight, 8);
        return eight;
    }
}

static double read_number(const nifti *header, size_t offset) {
    float four;
    double eight;
    if (header->at->float_width == 8) {
        copy_field(header, offset, &eight, 8);
        return eight;
    }
    copy_field(header, offset, &four, 4);
    return (double)four;
}

/* The index-th number of an array of floats. */
static double read_element(const nifti *header, size_t offset, size_t index) {
    return read_number(header, offset + index * header->at->float_width);
}

/* ---- sizes, types, place of the voxels ---- */

static bool read_sizes(nifti *header) {
    const layout *at = header->at;
    int64_t dim[8];
    for (size_t i = 0; i < 8; i++)
        dim[i] = read_integer(header, at->dim + i * at->dim_width, at->dim_width);
    if (dim[0] < 1 || dim[0] > 7)
        return FAIL(header, "%s says %lld dimensions; 1..7 are possible", header->source->name,
                    (long long)dim[0]);
    for (int64_t i = 1; i < 8; i++) {
        if (i > dim[0] || (dim[i] == 0 && i > 3))
            dim[i] = 1;
        if (dim[i] < 1 || dim[i] > INT32_MAX)
            return FAIL(header, "%s says %lld samples along axis %lld", header->source->name,
                        (long long)dim[i], (long long)i);
    }
    for (int i = 0; i < 3; i++)
        header->size[i] = (uint64_t)dim[i + 1];
    header->time = (uint64_t)dim[4];
    header->vectors = (uint64_t)dim[5];
    bool chosen = header->source->time_given;
    if ((header->time > 1 && !chosen) || dim[6] > 1 || dim[7] > 1)
        plr_diags_add_as(
            header->source->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME, header->source->place,
            "%s holds more than one volume; only the first is used", header->source->name);
    return true;
}

static bool read_datatype(nifti *header) {
    int64_t code = read_integer(header, header->at->datatype, 2);
    for (size_t i = 0; i < sizeof datatypes / sizeof *datatypes; i++)
        if (datatypes[i].code == code) {
            header->type = datatypes[i].type;
            header->components = datatypes[i].components;
            header->colour = datatypes[i].colour;
            return true;
        }
    return FAIL(header, "%s has voxels of NIfTI type %lld, which are not read",
                header->source->name, (long long)code);
}

/* Vectors (axis 5) become components, as long as they fit a texture; their planes follow each
 * other. */
static bool count_voxels(nifti *header) {
    bool planes =
        header->vectors > 1 && header->time == 1 && header->vectors * header->components <= 4;
    bool chosen = header->source->time_given && header->time == 1;
    if (header->vectors > 1 && !planes && !chosen)
        plr_diags_add_as(header->source->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME,
                         header->source->place,
                         "%s holds %llu values a voxel; only the first is used",
                         header->source->name, (unsigned long long)header->vectors);
    uint64_t vectors = header->vectors;
    if (!planes)
        header->vectors = 1;
    uint64_t components = header->vectors * header->components;
    if (!plr_volume_check_size(header->size, components, header->type, header->source->place,
                               header->source->diags))
        return false;
    header->count = header->size[0] * header->size[1] * header->size[2] * components;
    header->point =
        plr_volume_time_point(header->source, header->time > 1 || planes ? header->time : vectors);
    return true;
}

static bool read_offset(nifti *header) {
    const layout *at = header->at;
    header->pair = header->source->data[at->magic + 1] == 'i';
    double offset = at->float_width == 8 ? (double)read_integer(header, at->vox_offset, 8)
                                         : read_number(header, at->vox_offset);
    /* 4 bytes behind the header say whether extensions follow */
    double least = header->pair ? 0 : (double)at->header_size + 4;
    if (offset == 0)
        offset = least;
    if (!(offset >= least && offset < 9e15))
        return FAIL(header, "%s says that voxels begin at byte %g", header->source->name, offset);
    header->text_end = header->pair ? header->source->length : (uint64_t)offset;
    /* below 2^53, and 2^31 volumes of at most 2^32 bytes */
    header->offset =
        (uint64_t)offset + header->point * header->count * plr_voxel_size(header->type);
    return true;
}

/* ---- voxels ---- */

static bool copy_voxels(const nifti *header, const char *data, size_t length, const char *name,
                        plr_volume *volume) {
    size_t size = (size_t)header->count * plr_voxel_size(header->type);
    uint64_t have = length > header->offset ? length - header->offset : 0;
    if (have < size)
        return FAIL(header, "%s holds %llu bytes of voxels, but the header says %zu", name,
                    (unsigned long long)have, size);
    volume->voxels = malloc(size);
    if (!volume->voxels) {
        plr_diags_add(header->source->diags, PLR_CODE_NO_MEMORY, header->source->place,
                      "there is not enough memory for %zu bytes of voxels", size);
        return false;
    }
    memcpy(volume->voxels, data + header->offset, size);
    if (header->swapped)
        plr_swap_bytes(volume->voxels, (size_t)header->count, plr_voxel_size(header->type));
    return true;
}

/* The name of the other half of a pair, in the same folder: .hdr becomes .img, .HDR .IMG. */
static bool image_name(const char *header_name, bool packed, char *name, size_t size) {
    const char *slash = strrchr(header_name, '/');
    const char *base = slash ? slash + 1 : header_name, *dot = strrchr(base, '.');
    if (dot && strcmp(dot, ".gz") == 0)
        while (dot > base && *--dot != '.') {
        }
    size_t stem = dot && dot > base ? (size_t)(dot - base) : strlen(base);
    bool capitals = dot && strncmp(dot, ".HDR", 4) == 0;
    if (stem + 8 > size)
        return false;
    snprintf(name, size, "%.*s%s%s", (int)stem, base, capitals ? ".IMG" : ".img",
             packed ? ".gz" : "");
    return true;
}

static bool read_pair(const nifti *header, plr_volume *volume) {
    const plr_volume_source *source = header->source;
    char name[4096];
    plr_bytes bytes;
    bool loaded = false;
    if (!source->load)
        return FAIL(header,
                    "the voxels of %s are in a file of their own, which cannot be read here",
                    source->name);
    /* packed or not: only the last try reports */
    for (int try = 0; try < 3 && !loaded; try++)
        loaded = image_name(source->name, try == 1, name, sizeof name) &&
                 source->load(source->user, source->name, name, true, source->place, &bytes,
                              try == 2 ? source->diags : NULL);
    if (!loaded)
        return false;
    bool ok = copy_voxels(header, bytes.data, bytes.length, bytes.name ? bytes.name : name, volume);
    source->release(source->user, &bytes);
    return ok;
}

/* Planes of vectors, one behind the other, become components of each voxel. */
static bool interleave(const nifti *header, plr_volume *volume) {
    uint64_t voxels = header->size[0] * header->size[1] * header->size[2];
    size_t size = plr_voxel_size(header->type) * header->components;
    const uint64_t count[4] = {header->vectors, voxels, 1, 1}, stride[4] = {voxels, 1, 1, 1};
    if (header->vectors == 1)
        return true;
    void *out = malloc((size_t)voxels * (size_t)header->vectors * size);
    if (!out) {
        plr_diags_add(header->source->diags, PLR_CODE_NO_MEMORY, header->source->place,
                      "there is not enough memory");
        return false;
    }
    plr_gather(out, volume->voxels, size, count, stride);
    free(volume->voxels);
    volume->voxels = out;
    return true;
}

/* ---- geometry ---- */

/* Method 3 of nifti1.h: the rows of the affine matrix, as they are. */
static void set_affine(const nifti *header, plr_volume *volume) {
    for (size_t row = 0; row < 3; row++) {
        for (size_t column = 0; column < 3; column++)
            volume->directions[column][row] =
                read_element(header, header->at->srow, row * 4 + column);
        volume->origin[row] = read_element(header, header->at->srow, row * 4 + 3);
    }
}

/* Method 2 of nifti1.h: the rotation of a unit quaternion (a,b,c,d) with a = sqrt(1-bb-cc-dd),
 * times the sides of a voxel; the third column turns round if pixdim[0] is -1. */
static void set_quaternion(const nifti *header, const double sides[3], plr_volume *volume) {
    double b = read_element(header, header->at->quatern, 0);
    double c = read_element(header, header->at->quatern, 1);
    double d = read_element(header, header->at->quatern, 2);
    double a = 1 - (b * b + c * c + d * d);
    if (a < 1e-7) { /* a half turn, up to rounding: b, c and d are made unit length */
        double length = sqrt(b * b + c * c + d * d);
        a = 0;
        b /= length;
        c /= length;
        d /= length;
    } else {
        a = sqrt(a);
    }
    double flip = read_element(header, header->at->pixdim, 0) < 0 ? -1 : 1;
    const double rotation[3][3] = {
        {a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)},
        {2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b)},
        {2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c}};
    for (size_t row = 0; row < 3; row++) {
        for (size_t column = 0; column < 3; column++)
            volume->directions[column][row] =
                rotation[row][column] * sides[column] * (column == 2 ? flip : 1);
        volume->origin[row] = read_element(header, header->at->qoffset, row);
    }
}

static void set_geometry(const nifti *header, plr_volume *volume) {
    const layout *at = header->at;
    static const double metres[] = {0, 1, 1e-3, 1e-6};
    double sides[3];
    for (size_t i = 0; i < 3; i++) {
        sides[i] = fabs(read_element(header, at->pixdim, i + 1));
        sides[i] = isfinite(sides[i]) && sides[i] > 0 ? sides[i] : 1;
        volume->directions[i][i] = sides[i];
    }
    if (read_integer(header, at->qform + at->code_width, at->code_width) > 0)
        set_affine(header, volume);
    else if (read_integer(header, at->qform, at->code_width) > 0)
        set_quaternion(header, sides, volume);
    else /* method 1: the sides of a voxel, and no relation to any space */
        volume->unplaced = true;
    volume->has_geometry = true;
    for (int i = 0; i < 9; i++)
        if (!isfinite(volume->directions[i / 3][i % 3]) || !isfinite(volume->origin[i % 3]))
            volume->has_geometry = false;
    int64_t unit = read_integer(header, at->units, at->units_width) & 7;
    volume->metres = unit < 4 ? metres[unit] : 0;
    volume->space = volume->unplaced ? PLR_SPACE_UNKNOWN : PLR_SPACE_RAS;
}

/* ---- values ---- */

static void set_values(const nifti *header, plr_volume *volume) {
    double slope = read_number(header, header->at->slope);
    double intercept = read_number(header, header->at->intercept);
    bool scaled = isfinite(slope) && slope != 0 && isfinite(intercept) && !header->colour;
    volume->slope = scaled ? slope : 1;
    volume->intercept = scaled ? intercept : 0;
    double minimum = read_number(header, header->at->cal_min);
    double maximum = read_number(header, header->at->cal_max);
    bool declared = minimum < maximum && isfinite(minimum) && isfinite(maximum);
    plr_volume_set_range(volume, declared ? minimum : (double)NAN,
                         declared ? maximum : (double)NAN);
}

bool plr_volume_parse_nifti(const plr_volume_source *source, plr_volume *volume) {
    nifti header = {.source = source};
    bool big_endian = source->data[0] == 0;
    /* 348 is 0x15c, 540 is 0x21c */
    header.at = &layouts[source->data[big_endian ? 3 : 0] == 0x1c];
    header.swapped = big_endian != plr_host_is_big_endian();
    if (!read_sizes(&header) || !read_datatype(&header) || !count_voxels(&header) ||
        !read_offset(&header))
        return false;
    volume->type = header.type;
    volume->components = (uint32_t)(header.components * header.vectors);
    for (int i = 0; i < 3; i++)
        volume->size[i] = (uint32_t)header.size[i];
    bool ok = header.pair
                  ? read_pair(&header, volume)
                  : copy_voxels(&header, source->data, source->length, source->name, volume);
    if (!ok || !interleave(&header, volume)) {
        free(volume->voxels);
        volume->voxels = NULL;
        return false;
    }
    set_geometry(&header, volume);
    set_values(&header, volume);
    size_t end = header.text_end < source->length ? (size_t)header.text_end : source->length;
    plr_nifti_read_labels(source->data, header.at->header_size, end, header.swapped,
                          &volume->labels);
    return true;
}
