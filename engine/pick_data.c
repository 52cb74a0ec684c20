/* What the data of a volume have at a place: the numbers of the file, not those of textures. */
#include "engine/pick.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/volume.h"

typedef struct plr_picked_data {
    const plr_node *node; /* whose data they are */
    uint64_t revision;
    plr_volume voxels;
    uint32_t components; /* of the voxels: without that which is the segment */
    plr_image segments;
    plr_labels names; /* of segments; shared with `voxels` or owned by `segmented` */
    plr_volume segmented;
} plr_picked_data;

void plr_picked_data_free(plr_picked_data **data) {
    if (!*data)
        return;
    plr_volume_free(&(*data)->voxels);
    plr_volume_free(&(*data)->segmented);
    plr_image_free(&(*data)->segments);
    free(*data);
    *data = NULL;
}

/* ---- Reading ---- */

/* When the data were read that are drawn. */
static uint64_t revision_of(const plr_view *view, const plr_node *node) {
    for (size_t i = 0; i < view->kept_volumes.count; i++)
        if (view->kept_volumes.items[i]->node == node)
            return view->kept_volumes.items[i]->revision;
    return 0;
}

/* Faults were reported when the scene was made ready. */
static void read_data(plr_view *view, const plr_volume_state *volume, plr_picked_data *data) {
    const plr_node *voxels = plr_node_child(volume->node, "voxels");
    const plr_node *both = plr_node_child(volume->node, "segmentedVoxels");
    const plr_node *segments = plr_node_child(volume->node, "segmentIdentifiers");
    plr_place none = {0};
    if (!voxels && !both)
        return;
    if (!plr_volume_from_node(view->scene, voxels ? voxels : both, &data->voxels, NULL))
        return;
    data->components = data->voxels.components;
    if (!volume->labels)
        return;
    if (!voxels && data->components > 1) {
        plr_volume_to_labels(&data->voxels, --data->components, none, &data->segments, NULL);
        data->names = data->voxels.labels;
    } else if (segments && plr_volume_from_node(view->scene, segments, &data->segmented, NULL)) {
        plr_volume_to_labels(&data->segmented, 0, none, &data->segments, NULL);
        data->names = data->segmented.labels;
    }
}

static const plr_picked_data *data_of(plr_view *view, const plr_volume_state *volume) {
    uint64_t revision = revision_of(view, volume->node);
    const plr_picked_data *last = view->picked;
    if (last && last->node == volume->node && last->revision == revision)
        return last;
    plr_picked_data_free(&view->picked);
    view->picked = calloc(1, sizeof *view->picked);
    if (!view->picked)
        longjmp(*view->arena.out_of_memory, 1);
    view->picked->node = volume->node;
    view->picked->revision = revision;
    read_data(view, volume, view->picked);
    return view->picked;
}

/* ---- Places ---- */

/* The two voxels around a place along an axis, and how much of the second. */
typedef struct between {
    uint32_t voxels[2];
    double second;
} between;

static between find_between(double place, uint32_t size) {
    double at = fmin(fmax(place * size - 0.5, 0), size - 1.0);
    between b = {.voxels = {(uint32_t)at}};
    b.second = at - b.voxels[0];
    b.voxels[1] = b.voxels[0] + 1 < size ? b.voxels[0] + 1 : b.voxels[0];
    return b;
}

/* As textures hold it: linear in the range, clamped; what is no number is 0. */
static double to_value(double physical, const double range[2]) {
    double size = range[1] - range[0];
    double value = size != 0 ? (physical - range[0]) / size : 0;
    return value > 0 ? fmin(value, 1) : 0;
}

static void interpolate(const plr_picked_data *data, const double range[2], const between at[3],
                        uint32_t component, plr_pick *pick) {
    double value = 0, physical = 0;
    for (int corner = 0; corner < 8; corner++) {
        uint32_t v[3];
        double weight = 1;
        for (int axis = 0; axis < 3; axis++) {
            int second = corner >> axis & 1;
            v[axis] = at[axis].voxels[second];
            weight *= second ? at[axis].second : 1 - at[axis].second;
        }
        if (!(weight > 0))
            continue;
        double number = plr_volume_value(&data->voxels, v[0], v[1], v[2], component);
        physical += weight * number;
        value += weight * to_value(number, range);
    }
    pick->value[component] = value;
    pick->physical[component] = physical;
}

static uint32_t find_voxel(double place, uint32_t size) {
    return (uint32_t)fmin(fmax(floor(place * size), 0), size - 1.0);
}

static void find_segment(const plr_picked_data *data, const double place[3], plr_pick *pick) {
    const plr_image *s = &data->segments;
    pick->has_segment = true;
    pick->segment = (uint32_t)plr_image_sample(s, find_voxel(place[0], s->width),
                                               find_voxel(place[1], s->height),
                                               find_voxel(place[2], s->depth), 0);
    const plr_label *label = plr_labels_find(&data->names, pick->segment);
    if (label && label->name)
        strncpy(pick->label, label->name, sizeof pick->label - 1);
}

void plr_pick_read(plr_view *view, const plr_volume_state *volume, const double place[3],
                   plr_pick *pick) {
    const plr_picked_data *data = data_of(view, volume);
    between at[3];
    if (data->voxels.voxels) {
        for (int axis = 0; axis < 3; axis++)
            at[axis] = find_between(place[axis], data->voxels.size[axis]);
        pick->components = data->components < 4 ? data->components : 4;
        for (uint32_t c = 0; c < pick->components; c++)
            interpolate(data, volume->grid->range, at, c, pick);
    }
    if (data->segments.samples)
        find_segment(data, place, pick);
}
