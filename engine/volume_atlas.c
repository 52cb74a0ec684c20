/* ImageTextureAtlas: the slices of a volume as tiles of one picture. */
#include "engine/volume_node.h"

#include <stdlib.h>
#include <string.h>

#include "engine/node_file.h"

/* The tiles of a picture: `across` in a row, `down` rows, the first at the top left. A tile has
 * width / across pixels, which may be no whole number. */
typedef struct atlas {
    const plr_node *node;
    uint32_t across, down, count;
    uint32_t *columns, *rows; /* of the picture, by tile and voxel; rows from the top */
    plr_volume *volume;
} atlas;

/* The pixels of one axis: voxel i of a tile is the pixel at its centre, (i + 1/2) / size of the way
 * through the tile. Each is a pixel of the picture as it stands, never a mixture, and has its
 * centre within the tile; whole tiles come out exactly. */
static uint32_t *pick(uint32_t pixels, uint32_t tiles, uint32_t size) {
    uint32_t *picked = malloc(sizeof *picked * tiles * size);
    for (uint32_t tile = 0; picked && tile < tiles; tile++)
        for (uint32_t i = 0; i < size; i++) {
            /* pixels * (tile + (2 i + 1) / (2 size)) / tiles: at most 2^15 * 2^32 */
            uint64_t above = (uint64_t)pixels * (2 * (uint64_t)tile * size + 2 * i + 1);
            picked[tile * size + i] = (uint32_t)(above / (2 * (uint64_t)tiles * size));
        }
    return picked;
}

/* Row 0 of each slice is the top row of its tile: so do the browsers that know this node. */
static void cut(const atlas *a, const plr_image *picture, plr_image *stack) {
    size_t pixel = picture->components * plr_image_sample_size(picture->type);
    size_t line = picture->width * pixel;
    char *out = stack->samples;
    for (uint32_t z = 0; z < stack->depth; z++)
        for (uint32_t y = 0; y < stack->height; y++) {
            uint32_t from_top = a->rows[z / a->across * stack->height + y];
            const char *row =
                (const char *)picture->samples + (picture->height - 1 - (size_t)from_top) * line;
            const uint32_t *columns = a->columns + z % a->across * stack->width;
            for (uint32_t x = 0; x < stack->width; x++, out += pixel)
                memcpy(out, row + columns[x] * pixel, pixel);
        }
}

static bool read_tiles(atlas *a, const plr_image *picture, plr_place place, plr_diags *diags) {
    plr_image stack = *picture;
    stack.mipmaps = 0;
    stack.width = picture->width / a->across;
    stack.height = picture->height / a->down;
    stack.depth = a->count;
    stack.samples = NULL;
    if (!stack.width || !stack.height) {
        plr_diags_add(diags, PLR_CODE_BAD_VOLUME, place,
                      "a picture of %u x %u pixels has no room for %u x %u tiles", picture->width,
                      picture->height, a->across, a->down);
        return false;
    }
    if (!plr_volume_check_image(&stack, place, diags))
        return false;
    a->columns = pick(picture->width, a->across, stack.width);
    a->rows = pick(picture->height, a->down, stack.height);
    stack.samples = malloc(plr_image_level_samples(&stack, 0) * plr_image_sample_size(stack.type));
    bool fine = a->columns && a->rows && stack.samples;
    if (fine) {
        cut(a, picture, &stack);
        plr_volume_from_image(&stack, a->volume);
    } else {
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, place, "there is not enough memory");
    }
    free(a->columns);
    free(a->rows);
    plr_image_free(&stack);
    return fine;
}

static bool from_bytes(void *user, plr_scene *scene, const plr_bytes *bytes, plr_place place,
                       plr_diags *diags) {
    (void)scene;
    plr_image picture;
    if (!plr_image_decode(bytes->data, bytes->length, place, &picture, diags))
        return false;
    plr_image_flatten(&picture);
    bool fine = read_tiles(user, &picture, place, diags);
    plr_image_free(&picture);
    return fine;
}

static bool read_counts(atlas *a, plr_diags *diags) {
    int64_t across = plr_node_int(a->node, "slicesOverX");
    int64_t down = plr_node_int(a->node, "slicesOverY");
    int64_t count = plr_node_int(a->node, "numberOfSlices");
    if (across < 1 || down < 1 || across > PLR_IMAGE_MAX_SIDE || down > PLR_IMAGE_MAX_SIDE) {
        plr_diags_add(diags, PLR_CODE_BAD_VOLUME, plr_node_place(a->node),
                      "slicesOverX and slicesOverY must say how the picture is divided: %lld x "
                      "%lld tiles are outside 1..%u",
                      (long long)across, (long long)down, PLR_IMAGE_MAX_SIDE);
        return false;
    }
    if (count > across * down)
        plr_diags_add_as(diags, PLR_WARNING, PLR_CODE_BAD_VALUE,
                         plr_node_field(a->node, "numberOfSlices")->place,
                         "%lld slices are more than %lld x %lld tiles", (long long)count,
                         (long long)across, (long long)down);
    if (count < 1 || count > across * down)
        count = across * down;
    a->across = (uint32_t)across;
    a->down = (uint32_t)down;
    a->count = (uint32_t)count;
    return true;
}

bool plr_volume_from_atlas(plr_scene *scene, const plr_node *texture, plr_volume *volume,
                           plr_diags *diags) {
    atlas a = {.node = texture, .volume = volume};
    return plr_node_bool(texture, "load") && read_counts(&a, diags) &&
           plr_node_file(scene, texture, from_bytes, &a, diags);
}
