/* Images in memory: fields of a scene, files, single samples. */
#include "engine/image_internal.h"

#include <stdlib.h>
#include <string.h>

#include "engine/volume_internal.h"

size_t plr_image_sample_size(plr_sample_type type) {
    static const unsigned char sizes[] = {[PLR_UNORM8] = 1, [PLR_UNORM16] = 2, [PLR_FLOAT32] = 4,
                                          [PLR_UINT8] = 1,  [PLR_UINT16] = 2,  [PLR_UINT32] = 4};
    return sizes[type];
}

static size_t halved(uint32_t side, uint32_t level) {
    uint32_t half = level < 32 ? side >> level : 0;
    return half ? half : 1;
}

size_t plr_image_level_samples(const plr_image *image, uint32_t level) {
    size_t depth = image->cube ? image->depth : halved(image->depth, level);
    return halved(image->width, level) * halved(image->height, level) * depth * image->components;
}

void plr_image_free(plr_image *image) {
    if (!image)
        return;
    free(image->samples);
    memset(image, 0, sizeof *image);
}

double plr_image_sample(const plr_image *image, uint32_t x, uint32_t y, uint32_t z, uint32_t c) {
    size_t index = (((size_t)z * image->height + y) * image->width + x) * image->components + c;
    const void *samples = image->samples;
    switch (image->type) {
    case PLR_UNORM8:
        return ((const uint8_t *)samples)[index] / 255.0;
    case PLR_UNORM16:
        return ((const uint16_t *)samples)[index] / 65535.0;
    case PLR_FLOAT32:
        return (double)((const float *)samples)[index];
    case PLR_UINT8:
        return ((const uint8_t *)samples)[index];
    case PLR_UINT16:
        return ((const uint16_t *)samples)[index];
    case PLR_UINT32:
        return ((const uint32_t *)samples)[index];
    }
    return 0;
}

/* ---- fields of a scene ---- */

/* Integers of a field that describe an image: its sizes, then one integer for each pixel, whose
 * lowest byte is the last component (ISO/IEC 19775-1, 5.3.6 SFImage). */
static bool from_integers(const plr_field *field, size_t header, const uint64_t size[3],
                          int64_t components, plr_code code, plr_image *image, plr_diags *diags) {
    uint64_t pixels = 1;
    if (components == 0 && field->count == header) {
        plr_diags_add(diags, code, field->place, "the image has no pixels");
        return false;
    }
    if (components < 1 || components > 4) {
        plr_diags_add(diags, code, field->place, "%lld components are outside 1..4",
                      (long long)components);
        return false;
    }
    for (int i = 0; i < 3; i++) {
        if (size[i] < 1 || size[i] > PLR_IMAGE_MAX_SIDE) {
            plr_diags_add(diags, code, field->place, "a side of %lld pixels is outside 1..%u",
                          (long long)size[i], PLR_IMAGE_MAX_SIDE);
            return false;
        }
        pixels *= size[i];
    }
    if (pixels != field->count - header) {
        plr_diags_add(
            diags, code, field->place, "%llu x %llu x %llu are %llu pixels, but the field has %zu",
            (unsigned long long)size[0], (unsigned long long)size[1], (unsigned long long)size[2],
            (unsigned long long)pixels, field->count - header);
        return false;
    }
    unsigned char *out = malloc((size_t)pixels * (size_t)components);
    if (!out) {
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, field->place, "there is not enough memory");
        return false;
    }
    *image = (plr_image){.width = (uint32_t)size[0],
                         .height = (uint32_t)size[1],
                         .depth = (uint32_t)size[2],
                         .components = (uint32_t)components,
                         .type = PLR_UNORM8,
                         .samples = out};
    for (const int32_t *pixel = field->value.ints + header, *end = pixel + pixels; pixel < end;
         pixel++)
        for (int64_t c = components - 1; c >= 0; c--)
            *out++ = (unsigned char)((uint32_t)*pixel >> (8 * c));
    return true;
}

/* The number of integers that `field` must have at least; false with an error where it has fewer.
 */
static bool has_header(const plr_field *field, plr_type type, plr_type other, size_t count,
                       plr_code code, plr_diags *diags) {
    if (field && (field->type == type || field->type == other) && field->count >= count)
        return true;
    plr_diags_add(diags, code, field ? field->place : (plr_place){0},
                  "an image needs at least %zu numbers: its sizes and components", count);
    return false;
}

bool plr_image_from_sfimage(const plr_field *field, plr_image *image, plr_diags *diags) {
    memset(image, 0, sizeof *image);
    if (!has_header(field, PLR_SFIMAGE, PLR_SFIMAGE, 3, PLR_CODE_BAD_IMAGE, diags))
        return false;
    const int32_t *ints = field->value.ints;
    const uint64_t size[3] = {(uint64_t)ints[0], (uint64_t)ints[1], 1};
    return from_integers(field, 3, size, ints[2], PLR_CODE_BAD_IMAGE, image, diags);
}

bool plr_image_from_image3d(const plr_field *field, plr_image *image, plr_diags *diags) {
    memset(image, 0, sizeof *image);
    if (!has_header(field, PLR_MFINT32, PLR_SFIMAGE, 4, PLR_CODE_BAD_VOLUME, diags))
        return false;
    const int32_t *ints = field->value.ints;
    const uint64_t size[3] = {(uint64_t)ints[1], (uint64_t)ints[2], (uint64_t)ints[3]};
    return from_integers(field, 4, size, ints[0], PLR_CODE_BAD_VOLUME, image, diags);
}

/* ---- files ---- */

static void flip_slice(char *low, size_t row, size_t height) {
    char *high = low + row * (height - 1), piece[4096];
    for (; low < high; low += row, high -= row)
        for (size_t done = 0; done < row;) {
            size_t part = row - done < sizeof piece ? row - done : sizeof piece;
            memcpy(piece, low + done, part);
            memcpy(low + done, high + done, part);
            memcpy(high + done, piece, part);
            done += part;
        }
}

/* Of all levels and slices. */
static void flip_rows(plr_image *image) {
    char *at = image->samples;
    for (uint32_t level = 0; level <= image->mipmaps; level++) {
        size_t pixel = image->components * plr_image_sample_size(image->type);
        size_t row = halved(image->width, level) * pixel, height = halved(image->height, level);
        size_t slices = image->cube ? image->depth : halved(image->depth, level);
        for (size_t i = 0; i < slices; i++, at += row * height)
            flip_slice(at, row, height);
    }
}

/* Float data as they are, integers as fractions of their type's greatest value or of the declared
 * range: what an image means by its samples. */
static bool image_from_volume(const plr_volume *volume, plr_image *image) {
    static const double greatest[] = {
        [PLR_VOXEL_U8] = 255,     [PLR_VOXEL_S8] = 127,          [PLR_VOXEL_U16] = 65535,
        [PLR_VOXEL_S16] = 32767,  [PLR_VOXEL_U32] = 4294967295., [PLR_VOXEL_S32] = 2147483647,
        [PLR_VOXEL_U64] = 0x1p64, [PLR_VOXEL_S64] = 0x1p63};
    bool is_float = volume->type == PLR_VOXEL_F32 || volume->type == PLR_VOXEL_F64;
    if (volume->range_declared || !is_float) {
        const double range[2] = {0, volume->range_declared ? 0 : greatest[volume->type]};
        return plr_volume_to_image(volume, range, image);
    }
    size_t count = plr_volume_count(volume);
    float *out = malloc(count * sizeof *out);
    if (!out)
        return false;
    *image = (plr_image){.width = volume->size[0],
                         .height = volume->size[1],
                         .depth = volume->size[2],
                         .components = volume->components,
                         .type = PLR_FLOAT32,
                         .samples = out};
    for (size_t i = 0; i < count; i++)
        out[i] = volume->type == PLR_VOXEL_F32 ? ((const float *)volume->voxels)[i]
                                               : (float)((const double *)volume->voxels)[i];
    return true;
}

static bool decode_nrrd(const char *data, size_t length, plr_place place, plr_image *image,
                        plr_diags *diags) {
    plr_volume_source source = {.data = data,
                                .length = length,
                                .name = place.file ? place.file : "the image",
                                .place = place,
                                .diags = diags};
    plr_volume volume;
    if (!plr_volume_parse(&source, &volume))
        return false;
    bool ok = volume.size[2] == 1 && image_from_volume(&volume, image);
    if (volume.size[2] != 1)
        plr_diags_add(diags, PLR_CODE_BAD_IMAGE, place,
                      "data of %u x %u x %u voxels are not an image", volume.size[0],
                      volume.size[1], volume.size[2]);
    else if (!ok)
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, place, "there is not enough memory");
    plr_volume_free(&volume);
    return ok;
}

static const struct {
    bool (*is)(const char *, size_t);
    const char *(*decode)(const char *, size_t, plr_image *);
} formats[] = {{plr_image_is_jpeg, plr_image_decode_jpeg},
               {plr_image_is_hdr, plr_image_decode_hdr},
               {plr_image_is_exr, plr_image_decode_exr},
               {plr_image_is_dds, plr_image_decode_dds}};

bool plr_image_decode(const char *data, size_t length, plr_place place, plr_image *image,
                      plr_diags *diags) {
    memset(image, 0, sizeof *image);
    if (plr_volume_sniff(data, length) == PLR_VOLUME_NRRD)
        return decode_nrrd(data, length, place, image, diags);
    const char *(*decode)(const char *, size_t, plr_image *) = plr_image_decode_stb;
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        if (formats[i].is(data, length))
            decode = formats[i].decode;
    const char *fault = decode(data, length, image);
    if (fault) {
        plr_diags_add(diags, PLR_CODE_BAD_IMAGE, place, "this image cannot be read: %s", fault);
        return false;
    }
    flip_rows(image);
    return true;
}
