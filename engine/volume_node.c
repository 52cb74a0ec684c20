/* Texture nodes of a scene as volumes and images: the one file of the readers that knows scenes. */
#include "engine/volume_internal.h"

#include "engine/image_internal.h"
#include "engine/node_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- files of a scene ---- */

static bool load_beside(void *user, const char *referrer, const char *name, bool gunzip,
                        plr_place place, plr_bytes *bytes, plr_diags *diags) {
    return plr_scene_load_beside(user, referrer, name, gunzip, place, bytes, diags);
}

static void release(void *user, plr_bytes *bytes) {
    (void)user;
    plr_bytes_free(bytes);
}

bool plr_volume_read(plr_scene *scene, const plr_bytes *bytes, plr_place place, plr_volume *volume,
                     plr_diags *diags) {
    plr_volume_source source = {.data = bytes->data,
                                .length = bytes->length,
                                .name = bytes->name ? bytes->name : "the data",
                                .place = place,
                                .diags = diags,
                                .load = load_beside,
                                .release = release,
                                .user = scene};
    return plr_volume_parse(&source, volume);
}

/* Takes the samples of the image. Integers keep their type's whole range, floats that of the data.
 */
static void volume_from_image(plr_image *image, plr_volume *volume) {
    static const plr_voxel_type types[] = {
        [PLR_UNORM8] = PLR_VOXEL_U8, [PLR_UNORM16] = PLR_VOXEL_U16, [PLR_FLOAT32] = PLR_VOXEL_F32};
    *volume = (plr_volume){.size = {image->width, image->height, image->depth},
                           .components = image->components,
                           .type = types[image->type],
                           .voxels = image->samples,
                           .slope = 1};
    bool deep = image->type == PLR_UNORM16;
    plr_volume_set_range(volume, deep ? 0 : (double)NAN, deep ? 65535 : (double)NAN);
    memset(image, 0, sizeof *image);
}

static bool check_image_size(const plr_image *image, plr_place place, plr_diags *diags) {
    const uint64_t size[3] = {image->width, image->height, image->depth};
    return plr_volume_check_size(size, image->components, PLR_VOXEL_F32, place, diags);
}

/* ---- ComposedTexture3D ---- */

/* The type that holds both without loss. */
static plr_sample_type wider(plr_sample_type a, plr_sample_type b) {
    return a > b ? a : b;
}

static bool stack_slices(const plr_image *slices, size_t count, plr_place place, plr_image *image,
                         plr_diags *diags) {
    *image = slices[0];
    image->samples = NULL;
    image->depth = (uint32_t)count;
    for (size_t i = 0; i < count; i++)
        image->type = wider(image->type, slices[i].type);
    if (!check_image_size(image, place, diags))
        return false;
    size_t step = (size_t)image->width * image->height * image->components *
                  plr_image_sample_size(image->type);
    image->samples = malloc(step * count);
    if (!image->samples) {
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, place, "there is not enough memory");
        return false;
    }
    for (size_t i = 0; i < count; i++)
        plr_image_convert(&slices[i], image->components, image->type,
                          (char *)image->samples + i * step);
    return true;
}

/* All slices, equal in size and components; false with an error at the one that differs. */
static bool load_slices(plr_scene *scene, const plr_field *children, plr_image *slices,
                        plr_diags *diags) {
    for (size_t i = 0; i < children->count; i++) {
        const plr_node *child = children->value.nodes[i];
        if (!plr_image_from_texture(scene, child, &slices[i], diags))
            return false;
        const plr_image *first = &slices[0], *slice = &slices[i];
        if (slice->width != first->width || slice->height != first->height ||
            slice->components != first->components) {
            plr_diags_add(diags, PLR_CODE_BAD_VOLUME, plr_node_place(child),
                          "slice %zu is %u x %u with %u components, but the first is %u x %u with "
                          "%u",
                          i, slice->width, slice->height, slice->components, first->width,
                          first->height, first->components);
            return false;
        }
    }
    return true;
}

static bool from_slices(plr_scene *scene, const plr_node *texture, plr_volume *volume,
                        plr_diags *diags) {
    const plr_field *children = plr_node_field(texture, "texture");
    plr_place place = plr_node_place(texture);
    size_t count = children ? children->count : 0;
    if (count == 0 || count > PLR_VOLUME_MAX_SIDE) {
        plr_diags_add(diags, PLR_CODE_BAD_VOLUME, place, "%zu slices are outside 1..%u", count,
                      PLR_VOLUME_MAX_SIDE);
        return false;
    }
    plr_image image = {0}, *slices = calloc(count, sizeof *slices);
    bool ok = slices && load_slices(scene, children, slices, diags) &&
              stack_slices(slices, count, place, &image, diags);
    if (!slices)
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, place, "there is not enough memory");
    for (size_t i = 0; slices && i < count; i++)
        plr_image_free(&slices[i]);
    free(slices);
    if (ok)
        volume_from_image(&image, volume);
    return ok;
}

/* ---- ImageTexture3D, PixelTexture3D ---- */

static bool from_pixels(plr_scene *scene, const plr_node *texture, plr_volume *volume,
                        plr_diags *diags) {
    (void)scene;
    plr_image image;
    const plr_field *field = plr_node_field(texture, "image");
    if (plr_image_is_refused(texture, field) || !plr_image_from_image3d(field, &image, diags))
        return false;
    bool ok = check_image_size(&image, plr_node_place(texture), diags);
    if (ok)
        volume_from_image(&image, volume);
    plr_image_free(&image);
    return ok;
}

/* Files of other volume formats, so that the message can name what they are. */
static const struct {
    const char *magic, *name;
    size_t offset, length;
} other_formats[] = {
    {"\xabKTX ", "KTX", 0, 5},
    {"DICM", "DICOM", 128, 4},
    {"\x89HDF", "HDF5", 0, 4},
    {"# vtk", "VTK", 0, 5},
};

static const char *name_other_format(const plr_bytes *bytes) {
    for (size_t i = 0; i < sizeof other_formats / sizeof *other_formats; i++)
        if (bytes->length >= other_formats[i].offset + other_formats[i].length &&
            memcmp(bytes->data + other_formats[i].offset, other_formats[i].magic,
                   other_formats[i].length) == 0)
            return other_formats[i].name;
    return NULL;
}

/* By content: NRRD, NIfTI, else a picture: DDS volumes, others as a volume of one slice. */
static bool from_bytes(void *user, plr_scene *scene, const plr_bytes *bytes, plr_place place,
                       plr_diags *diags) {
    plr_volume *volume = user;
    const char *other = name_other_format(bytes);
    if (other) {
        plr_diags_add(diags, PLR_CODE_BAD_VOLUME, place,
                      "%s is a file of format %s, which is not read; convert it to NRRD or NIfTI",
                      bytes->name, other);
        return false;
    }
    if (plr_is_gzip(bytes->data, bytes->length) ||
        plr_volume_sniff(bytes->data, bytes->length) != PLR_VOLUME_UNKNOWN)
        return plr_volume_read(scene, bytes, place, volume, diags);
    plr_image image;
    if (!plr_image_decode(bytes->data, bytes->length, place, &image, diags))
        return false;
    bool ok = !image.cube && check_image_size(&image, place, diags);
    if (image.cube)
        plr_diags_add(diags, PLR_CODE_BAD_VOLUME, place, "%s is a cube map, not a volume",
                      bytes->name);
    if (ok)
        volume_from_image(&image, volume);
    plr_image_free(&image);
    return ok;
}

static bool from_urls(plr_scene *scene, const plr_node *texture, plr_volume *volume,
                      plr_diags *diags) {
    return plr_node_bool(texture, "load") &&
           plr_node_file(scene, texture, from_bytes, volume, diags);
}

static const struct {
    const char *type;
    bool (*read)(plr_scene *, const plr_node *, plr_volume *, plr_diags *);
} readers[] = {
    {"ImageTexture3D", from_urls},
    {"PixelTexture3D", from_pixels},
    {"ComposedTexture3D", from_slices},
};

bool plr_volume_from_node(plr_scene *scene, const plr_node *texture, plr_volume *volume,
                          plr_diags *diags) {
    memset(volume, 0, sizeof *volume);
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++)
        if (plr_node_is(texture, readers[i].type))
            return readers[i].read(scene, texture, volume, diags);
    plr_diags_add(diags, PLR_CODE_NOT_DRAWN, plr_node_place(texture), "%s is not read as a volume",
                  plr_node_type(texture));
    return false;
}
