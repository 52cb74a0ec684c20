/* Images from the texture nodes of scenes. */
#include "engine/image_internal.h"

#include <stdlib.h>
#include <string.h>

#include "engine/image_movie.h"
#include "engine/node_file.h"
#include "engine/transfer_function.h"
#include "engine/volume_internal.h"

bool plr_image_is_refused(const plr_node *texture, const plr_field *image) {
    plr_place own = plr_node_place(texture);
    return image && !image->given &&
           (image->place.line != own.line || image->place.column != own.column);
}

/* A text header tells its own lines, a picture has none: its faults are reported at the url. */
static bool decode_bytes(void *user, plr_scene *scene, const plr_bytes *bytes, plr_place place,
                         plr_diags *diags) {
    (void)scene;
    if (plr_volume_sniff(bytes->data, bytes->length) == PLR_VOLUME_NRRD)
        place = (plr_place){bytes->name, 0, 0};
    return plr_image_decode(bytes->data, bytes->length, place, user, diags);
}

static bool decode_flat(void *user, plr_scene *scene, const plr_bytes *bytes, plr_place place,
                        plr_diags *diags) {
    if (!decode_bytes(user, scene, bytes, place, diags))
        return false;
    bool cube = ((const plr_image *)user)->cube;
    if (plr_image_flatten(user))
        plr_diags_add_as(diags, PLR_WARNING, PLR_CODE_BAD_IMAGE, place,
                         "%s is a %s; the first %s is taken", bytes->name,
                         cube ? "cube map" : "volume", cube ? "face" : "slice");
    return true;
}

static bool decode_movie(void *user, plr_scene *scene, const plr_bytes *bytes, plr_place place,
                         plr_diags *diags) {
    if (!plr_movie_is(bytes->data, bytes->length)) /* a GIF, or the first of a row of pictures */
        return decode_flat(user, scene, bytes, place, diags);
    const char *fault = plr_movie_decode(bytes->data, bytes->length, user);
    if (fault)
        plr_diags_add(diags, PLR_CODE_BAD_IMAGE, place, "%s cannot be read: %s", bytes->name,
                      fault);
    return !fault;
}

static bool from_pixels(plr_scene *scene, const plr_node *texture, plr_image *image,
                        plr_diags *diags) {
    (void)scene;
    const plr_field *pixels = plr_node_field(texture, "image");
    return !plr_image_is_refused(texture, pixels) && plr_image_from_sfimage(pixels, image, diags);
}

/* Physical keys without a volume count from 0 to 1. */
static bool from_knots(plr_scene *scene, const plr_node *texture, plr_image *image,
                       plr_diags *diags) {
    (void)scene;
    return plr_transfer_function_bake(texture, (const double[]){0, 1}, image, diags);
}

static bool from_urls(plr_scene *scene, const plr_node *texture, plr_image *image,
                      plr_diags *diags) {
    return plr_node_bool(texture, "load") &&
           plr_node_file(scene, texture,
                         plr_node_is(texture, "MovieTexture") ? decode_movie : decode_flat, image,
                         diags);
}

/* ---- Cube maps ---- */

static bool decode_cube(void *user, plr_scene *scene, const plr_bytes *bytes, plr_place place,
                        plr_diags *diags) {
    plr_image *image = user;
    if (!decode_bytes(user, scene, bytes, place, diags))
        return false;
    const char *fault = image->cube        ? NULL
                        : image->depth > 1 ? "it is a volume, not a cube map"
                                           : plr_image_cube_from_picture(image);
    if (!fault)
        return true;
    plr_image_free(image);
    plr_diags_add(diags, PLR_CODE_BAD_IMAGE, place, "%s cannot be a cube map: %s", bytes->name,
                  fault);
    return false;
}

/* Faces may be of different types and components, not of different sizes. */
static bool from_faces(plr_scene *scene, const plr_node *texture, plr_image *image,
                       plr_diags *diags) {
    static const char *const fields[6] = {"rightTexture",  "leftTexture", "topTexture",
                                          "bottomTexture", "backTexture", "frontTexture"};
    plr_image faces[6] = {{0}};
    const plr_image *list[6];
    bool fine = true;
    for (int i = 0; fine && i < 6; i++) {
        const plr_node *child = plr_node_child(texture, fields[i]);
        list[i] = &faces[i];
        fine = child && plr_image_from_texture(scene, child, &faces[i], diags);
        if (!child)
            plr_diags_add(diags, PLR_CODE_BAD_IMAGE, plr_node_place(texture),
                          "the cube map has no %s", fields[i]);
    }
    const char *fault = fine ? plr_image_cube(list, image) : NULL;
    if (fault)
        plr_diags_add(diags, PLR_CODE_BAD_IMAGE, plr_node_place(texture), "%s", fault);
    for (int i = 0; i < 6; i++)
        plr_image_free(&faces[i]);
    return fine && !fault;
}

bool plr_image_from_cube_node(plr_scene *scene, const plr_node *texture, plr_image *image,
                              plr_diags *diags) {
    memset(image, 0, sizeof *image);
    if (plr_node_is(texture, "ComposedCubeMapTexture"))
        return from_faces(scene, texture, image, diags);
    return plr_node_bool(texture, "load") &&
           plr_node_file(scene, texture, decode_cube, image, diags);
}

/* ---- Two dimensions ---- */

static const struct {
    const char *type;
    bool (*read)(plr_scene *, const plr_node *, plr_image *, plr_diags *);
} readers[] = {
    {"ImageTexture", from_urls},
    {"PixelTexture", from_pixels},
    {"MovieTexture", from_urls},
    {"TransferFunction", from_knots},
};

bool plr_image_from_texture(plr_scene *scene, const plr_node *texture, plr_image *image,
                            plr_diags *diags) {
    memset(image, 0, sizeof *image);
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++)
        if (plr_node_is(texture, readers[i].type))
            return readers[i].read(scene, texture, image, diags);
    plr_diags_add(diags, PLR_CODE_NOT_DRAWN, plr_node_place(texture), "%s is not read as an image",
                  plr_node_type(texture));
    return false;
}
