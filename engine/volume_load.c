/* The data of volume nodes in a scene: read once, kept while their nodes stay as they are. */
#include "engine/volume_pass.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/update.h"
#include "engine/volume.h"
#include "engine/volume_bends.h"
#include "engine/volume_blocks.h"
#include "engine/volume_label_cells.h"
#include "engine/volume_geometry.h"

enum {
    DATA_DEPTH = 2,     /* of nodes that voxels are made of */
    MOST_BENT = 1 << 22 /* voxels: of more it is seldom that all are even enough */
};

/* Of one volume in a texture: what exceeds it is brought down. */
#define PLR_VOLUME_MOST_BYTES ((size_t)4 << 30)

/* Fields whose nodes hold data; of voxels the first that is given counts. */
static const char *const data_fields[] = {"voxels", "segmentedVoxels", "segmentIdentifiers"};

static uint64_t data_revision(const plr_node *owner) {
    uint64_t revision = plr_node_revision(owner);
    for (size_t i = 0; i < sizeof data_fields / sizeof *data_fields; i++) {
        const plr_node *node = plr_node_child(owner, data_fields[i]);
        revision += node ? plr_deep_revision(node, DATA_DEPTH) : 0;
    }
    return revision;
}

/* What was read before the scene changed, where that is still so. */
static plr_kept_volume *find_kept(plr_view *view, const plr_node *owner, uint64_t revision) {
    for (size_t i = 0; i < view->kept_volumes.count; i++) {
        plr_kept_volume *kept = view->kept_volumes.items[i];
        if (kept->node != owner)
            continue;
        if (kept->revision == revision)
            return kept;
        kept->grid.voxels->kept = false;
        if (kept->labels)
            kept->labels->kept = false;
        if (kept->cell_labels)
            kept->cell_labels->kept = false;
        if (kept->gradients)
            kept->gradients->kept = false;
        if (kept->quads)
            kept->quads->kept = false;
        view->kept_volumes.items[i] = view->kept_volumes.items[--view->kept_volumes.count];
        return NULL;
    }
    return NULL;
}

/* ---- Reading ---- */

/* What is read of one node. */
typedef struct reading {
    plr_view *view;
    const plr_node *owner;
    plr_kept_volume *kept;
    plr_image voxels, labels;
    plr_diags *diags;
} reading;

static void take_geometry(reading *r, const plr_volume *volume) {
    r->kept->placed = plr_volume_file_geometry(volume, plr_scene_length_unit(r->view->scene),
                                               &r->kept->place, r->kept->dimensions);
    if (!r->kept->placed)
        plr_diags_add_as(
            r->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME,
            plr_node_field(r->owner, "fileGeometry")->place,
            "the data tell no size and directions that could be used: fileGeometry has "
            "no effect, `dimensions` counts");
}

static bool read_volume(reading *r, const plr_volume *volume) {
    double range[2];
    plr_volume_node_range(r->owner, range);
    bool given = range[0] != range[1];
    r->kept->grid.range[0] = given ? range[0] : volume->minimum;
    r->kept->grid.range[1] = given ? range[1] : volume->maximum;
    if (plr_node_field(r->owner, "fileGeometry") && plr_node_bool(r->owner, "fileGeometry"))
        take_geometry(r, volume);
    return plr_volume_to_image(volume, range, &r->voxels);
}

/* Voxels whose last component is the segment, which has no part in the range of the values. One
 * component alone draws nothing. */
static bool read_segmented(reading *r, const plr_node *node) {
    plr_volume volume = {0};
    bool fine = plr_volume_from_node(r->view->scene, node, &volume, r->diags);
    if (fine && volume.components < 2) {
        plr_diags_add_as(r->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME, plr_node_place(node),
                         "segmentedVoxels of one component draw nothing: they lack the segment");
        fine = false;
    }
    fine = fine && plr_volume_to_labels(&volume, volume.components - 1, plr_node_place(node),
                                        &r->labels, r->diags);
    if (fine) {
        plr_volume_drop_last_component(&volume);
        fine = read_volume(r, &volume);
    }
    plr_volume_free(&volume);
    return fine;
}

static bool read_voxels(reading *r) {
    const plr_node *node = plr_node_child(r->owner, "voxels");
    const plr_node *segmented = plr_node_child(r->owner, "segmentedVoxels");
    if (!node && segmented)
        return read_segmented(r, segmented);
    plr_volume volume = {0}; /* a volume without voxels is empty space */
    bool fine = node && plr_volume_from_node(r->view->scene, node, &volume, r->diags) &&
                read_volume(r, &volume);
    if (fine && r->diags)
        plr_volume_check_levels(r->view->scene, r->owner, &volume, r->diags);
    plr_volume_free(&volume);
    return fine;
}

/* ISO/IEC 19775-1 V4 41.4.11: segment identifiers of another size than the voxels are ignored. */
static void read_labels(reading *r) {
    const plr_node *node = plr_node_child(r->owner, "segmentIdentifiers");
    plr_volume volume = {0};
    if (!node || r->labels.samples ||
        !plr_volume_from_node(r->view->scene, node, &volume, r->diags))
        return;
    const plr_image *voxels = &r->voxels;
    if (volume.size[0] != voxels->width || volume.size[1] != voxels->height ||
        volume.size[2] != voxels->depth)
        plr_diags_add_as(r->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME, plr_node_place(node),
                         "segment identifiers of %u x %u x %u voxels for %u x %u x %u voxels are "
                         "ignored",
                         volume.size[0], volume.size[1], volume.size[2], voxels->width,
                         voxels->height, voxels->depth);
    else
        plr_volume_to_labels(&volume, 0, plr_node_place(node), &r->labels, r->diags);
    plr_volume_free(&volume);
}

/* Bricks have no labels, no other volume beside them, and no end of the ray. */
static bool can_be_bricked(const reading *r) {
    const plr_node *style = plr_node_child(r->owner, "renderStyle");
    return r->view->engine && !r->labels.samples && plr_node_field(r->owner, "dimensions") &&
           !(style && plr_node_is(style, "ProjectionVolumeStyle"));
}

/* Brings down what the machine cannot hold and what cannot be cast in bricks. */
static bool fit(reading *r) {
    const plr_gl *gl = r->view->textures.gl;
    GLint side = 0;
    uint32_t by[3];
    if (gl)
        gl->GetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &side);
    const uint32_t full[3] = {r->voxels.width, r->voxels.height, r->voxels.depth};
    memcpy(r->kept->full_size, full, sizeof full);
    size_t most =
        r->view->desc.max_voxel_bytes ? r->view->desc.max_voxel_bytes : PLR_VOLUME_MOST_BYTES;
    plr_image_reduction(&r->voxels, side > 0 ? (uint32_t)side : 0, most, by);
    if (by[0] == 1 && by[1] == 1 && by[2] == 1)
        return true;
    if (can_be_bricked(r)) {
        plr_bricks_plan(&r->voxels, side > 0 ? (uint32_t)side : 0, most, r->kept->grid.brick_sides);
        return true;
    }
    plr_diags_add_as(r->diags, PLR_WARNING, PLR_CODE_LIMIT, plr_node_place(r->owner),
                     "%u x %u x %u voxels are more than can be held here; they are brought down by "
                     "%u x %u x %u",
                     full[0], full[1], full[2], by[0], by[1], by[2]);
    return plr_image_reduce(&r->voxels, by) &&
           (!r->labels.samples || plr_image_reduce(&r->labels, by));
}

/* One voxel in place of data that cannot be had, so that the effects on it are checked all the
 * same. */
static void make_placeholder(reading *r) {
    r->voxels = (plr_image){.width = 1, .height = 1, .depth = 1, .components = 1};
    r->voxels.samples = calloc(1, 1);
    if (!r->voxels.samples)
        longjmp(*r->view->arena.out_of_memory, 1);
}

static plr_texture *keep_texture(plr_view *view, plr_image *image, plr_texture_kind kind) {
    if (!image->samples)
        return NULL;
    plr_texture *texture = plr_textures_make(&view->textures, image, kind, true);
    texture->kept = true;
    return texture;
}

/* The same voxels have the same number, wherever they stand: FNV-1a, of words. */
static uint64_t hash_image(const plr_image *image, uint64_t hash) {
    size_t bytes = (size_t)image->width * image->height * image->depth * image->components *
                   (image->samples ? plr_image_sample_size(image->type) : 0);
    const char *at = image->samples;
    for (size_t i = 0; i < bytes; i += 8) {
        uint64_t word = 0;
        memcpy(&word, at + i, bytes - i < 8 ? bytes - i : 8);
        hash = (hash ^ word) * UINT64_C(0x100000001b3);
        hash ^= hash >> 29;
    }
    return hash;
}

static plr_blocks *make_blocks(plr_view *view, const plr_image *voxels, const plr_image *labels) {
    plr_blocks *blocks = plr_blocks_make(&view->lasting, voxels);
    if (labels->samples)
        plr_blocks_add_labels(&view->lasting, blocks, labels);
    return blocks;
}

static void measure_grid(plr_kept_volume *kept, const plr_image *image) {
    float dimensions[3] = {1, 1, 1};
    plr_node_numbers(kept->node, "dimensions", dimensions, 3);
    kept->grid.node = kept->node;
    kept->grid.size[0] = image->width;
    kept->grid.size[1] = image->height;
    kept->grid.size[2] = image->depth;
    for (int i = 0; i < 3; i++) {
        kept->grid.dimensions[i] = kept->placed ? kept->dimensions[i] : (double)dimensions[i];
        kept->dimensions[i] = kept->grid.dimensions[i];
    }
    const plr_field *unit = plr_node_field(kept->node, "gradientUnit");
    kept->grid.gradient_unit = unit ? plr_node_number(kept->node, "gradientUnit") : 0;
}

plr_kept_volume *plr_volume_kept(plr_view *view, const plr_node *owner) {
    for (size_t i = 0; i < view->kept_volumes.count; i++)
        if (view->kept_volumes.items[i]->node == owner)
            return view->kept_volumes.items[i];
    return NULL;
}

const plr_kept_volume *plr_volume_keep(plr_view *view, const plr_node *owner, plr_diags *diags) {
    uint64_t revision = data_revision(owner);
    plr_kept_volume *kept = find_kept(view, owner, revision);
    if (kept)
        return kept;
    kept = PLR_NEW(&view->lasting, plr_kept_volume);
    *kept = (plr_kept_volume){.node = owner, .revision = revision, .place = plr_matrix_identity()};
    reading r = {.view = view, .owner = owner, .kept = kept, .diags = diags};
    if (!read_voxels(&r)) {
        plr_image_free(&r.voxels);
        plr_image_free(&r.labels);
        if (view->engine)
            return NULL;
        make_placeholder(&r);
    }
    read_labels(&r);
    if (!fit(&r)) {
        plr_image_free(&r.voxels);
        plr_image_free(&r.labels);
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, plr_node_place(owner),
                      "there is not enough memory");
        return NULL;
    }
    measure_grid(kept, &r.voxels);
    kept->hash = hash_image(&r.labels, hash_image(&r.voxels, UINT64_C(0xcbf29ce484222325)));
    if (r.voxels.components == 1 && !kept->grid.brick_sides[0]) {
        kept->grid.bytes = plr_volume_has_bytes(&r.voxels);
        kept->blocks = make_blocks(view, &r.voxels, &r.labels);
        if (plr_image_level_samples(&r.voxels, 0) <= MOST_BENT)
            kept->bends = plr_bends_make(&view->lasting, &r.voxels);
    }
    kept->grid.voxels = keep_texture(view, &r.voxels, PLR_TEXTURE_3D);
    kept->grid.voxels->in_bricks = kept->grid.brick_sides[0] > 0;
    if (kept->blocks && r.labels.samples) {
        plr_image cells = plr_label_cells(&view->lasting, &r.labels);
        kept->cell_labels = keep_texture(view, &cells, PLR_TEXTURE_3D_LABELS);
    }
    kept->labels = keep_texture(view, &r.labels, PLR_TEXTURE_3D_LABELS);
    *PLR_PUSH(&view->lasting, &view->kept_volumes) = kept;
    return kept;
}

/* ---- States ---- */

void plr_volume_move(plr_volume_state *state, const plr_leaf *leaf) {
    state->to_world = plr_matrix_multiply(&leaf->to_world, &state->file_place);
}

/* Sizes, reference length and step; ISO/IEC 19775-1 V4 41.2 and the project's numbers for voxels.
 */
static void measure(const plr_view *view, plr_volume_state *state, const uint32_t full_size[3]) {
    double cell = 1, full = 1; /* brought down, the voxels keep their opacity */
    for (int i = 0; i < 3; i++) {
        state->dimensions[i] = state->grid->dimensions[i];
        cell *= state->dimensions[i] / state->grid->size[i];
        full *= state->dimensions[i] / full_size[i];
    }
    state->voxel = cbrt(cell);
    double unit = plr_node_number(state->node, "opacityUnitDistance");
    state->reference = unit > 0 ? unit : cbrt(full);
    state->step = (view->desc.step > 0 ? view->desc.step : 0.5) * state->voxel;
}

bool plr_volume_load(plr_view *view, const plr_leaf *leaf, plr_volume_state *state,
                     plr_diags *diags) {
    *state = (plr_volume_state){.node = leaf->node};
    const plr_kept_volume *kept = plr_volume_keep(view, leaf->node, diags);
    if (!kept)
        return false;
    if (!plr_volume_has_extent(&leaf->to_world, kept->grid.dimensions)) {
        plr_diags_add(
            diags, PLR_CODE_BAD_VOLUME, plr_node_place(leaf->node),
            "the volume has no extent: its transformation is singular, or its size is out "
            "of the range of numbers");
        return false;
    }
    state->grid = PLR_NEW(&view->arena, plr_grid);
    *state->grid = kept->grid;
    *PLR_PUSH(&view->arena, &view->volumes.grids) = state->grid;
    state->labels = kept->labels;
    state->cell_labels = kept->cell_labels;
    state->file_place = kept->place;
    state->hash = kept->hash;
    state->blocks = kept->blocks;
    state->bends = kept->bends;
    plr_volume_move(state, leaf);
    measure(view, state, kept->full_size);
    return state->voxel > 0;
}

const plr_image *plr_volume_voxels(plr_view *view, const plr_grid *grid, plr_image *again) {
    *again = (plr_image){0};
    if (grid->voxels->image.samples)
        return &grid->voxels->image;
    plr_kept_volume unused = {.node = grid->node};
    reading r = {.view = view, .owner = grid->node, .kept = &unused};
    bool fine = read_voxels(&r) && fit(&r);
    plr_image_free(&r.labels);
    *again = r.voxels;
    return fine ? again : NULL;
}

double plr_volume_steepness(plr_view *view, const plr_grid *grid) {
    plr_image again;
    const plr_image *image = plr_volume_voxels(view, grid, &again);
    double strong = image ? plr_image_gradient_percentile(image, grid->dimensions) : 0;
    plr_image_free(&again);
    return strong > 0 ? strong : 1;
}
