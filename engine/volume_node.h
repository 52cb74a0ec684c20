/* What the files share that make volumes of texture nodes. */
#ifndef PLR_ENGINE_VOLUME_NODE_H
#define PLR_ENGINE_VOLUME_NODE_H

#include "engine/image_internal.h"
#include "engine/volume_internal.h"

/* Takes the samples of the image. Integers keep their type's whole range, floats that of the data.
 */
void plr_volume_from_image(plr_image *image, plr_volume *volume);
bool plr_volume_check_image(const plr_image *image, plr_place place, plr_diags *diags);

/* Gets slice `index`, and the place of what is wrong with it. */
typedef bool (*plr_slice_loader)(void *user, size_t index, plr_image *slice, plr_place *place,
                                 plr_diags *diags);
/* Slices of one size and number of components, the first is slice 0; the widest type wins. `place`
 * is that of the whole. */
bool plr_volume_from_slices(plr_slice_loader load, void *user, size_t count, plr_place place,
                            plr_volume *volume, plr_diags *diags);

/* "slice%03d.png 1 90 1": files by number. */
typedef struct plr_file_pattern {
    const char *name;
    size_t length;
    int64_t first, step;
    size_t count;
} plr_file_pattern;
/* Whether the text has this form: a name with one %d (%03d, %i, %u), then first, last and perhaps
 * step. Not more than 2^32 files. */
bool plr_file_pattern_parse(plr_file_pattern *pattern, const char *text, size_t length);

/* ImageTexture3D and ImageTextureAtlas. */
bool plr_volume_from_urls(plr_scene *scene, const plr_node *texture, plr_volume *volume,
                          plr_diags *diags);
bool plr_volume_from_atlas(plr_scene *scene, const plr_node *texture, plr_volume *volume,
                           plr_diags *diags);

#endif
