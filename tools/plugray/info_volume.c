/* What a scene's 3D textures hold: found, read, counted. Printing is done elsewhere. */
#include <stdlib.h>
#include <string.h>

#include "tools/plugray/files.h"
#include "tools/plugray/info.h"

/* ---- Finding ---- */

static void add_use(volume_list *list, const plr_node *texture, const plr_node *user,
                    const char *field) {
    if (list->use_count == list->capacity) {
        list->capacity = list->capacity * 2 + 16;
        list->uses = memory_array(list->uses, list->capacity, sizeof *list->uses);
    }
    list->uses[list->use_count++] = (volume_use){texture, user, field};
}

static bool is_volume_texture(const plr_node *node) {
    const plr_node_info *info = plr_node_info_find(plr_node_type(node));
    return info && plr_node_info_is(info, "X3DTexture3DNode");
}

static int by_texture(const void *a, const void *b) {
    const volume_use *x = a, *y = b;
    uint32_t p = plr_node_id(x->texture), q = plr_node_id(y->texture);
    uint32_t r = plr_node_id(x->user), s = plr_node_id(y->user);
    return p != q ? (p < q ? -1 : 1) : r != s ? (r < s ? -1 : 1) : strcmp(x->field, y->field);
}

volume_list find_volumes(const node_list *nodes) {
    volume_list list = {0};
    for (size_t i = 0; i < nodes->count; i++)
        for (size_t f = 0; f < plr_node_field_count(nodes->items[i]); f++) {
            const plr_field *field = plr_node_field_at(nodes->items[i], f);
            if (plr_type_kind(field->type) != PLR_NODE)
                continue;
            for (size_t n = 0; n < field->count; n++)
                if (field->value.nodes[n] && is_volume_texture(field->value.nodes[n]))
                    add_use(&list, field->value.nodes[n], nodes->items[i], field->name);
        }
    if (list.use_count)
        qsort(list.uses, list.use_count, sizeof *list.uses, by_texture);
    return list;
}

void free_volumes(volume_list *list) {
    free(list->uses);
}

/* ---- Reading ---- */

/* Which component holds segment numbers; components: none does. In the field of the proposal of
 * 2005 it is the last one. */
static uint32_t label_component(const volume_report *r) {
    for (size_t i = 0; i < r->use_count; i++) {
        if (strcmp(r->uses[i].field, "segmentIdentifiers") == 0)
            return 0;
        if (strcmp(r->uses[i].field, "segmentedVoxels") == 0 && r->volume.components > 1)
            return r->volume.components - 1;
    }
    return r->volume.labels.count ? 0 : r->volume.components;
}

static void count_labels(volume_report *r) {
    uint32_t component = label_component(r);
    plr_image image = {0};
    if (component < r->volume.components &&
        plr_volume_to_labels(&r->volume, component, plr_node_place(r->texture), &image, NULL))
        r->labels = plr_image_count_labels(&image, &r->label_count, &r->more_labels);
    plr_image_free(&image);
}

/* The range that the first volume node gives which has these voxels, else that of the data. */
static void find_shown(volume_report *r) {
    r->shown[0] = r->volume.minimum;
    r->shown[1] = r->volume.maximum;
    for (size_t i = 0; i < r->use_count && !r->shown_by_node; i++) {
        double range[2];
        plr_volume_node_range(r->uses[i].user, range);
        if (range[0] == range[1])
            continue;
        memcpy(r->shown, range, sizeof range);
        r->shown_by_node = true;
    }
}

static bool read_report(volume_report *r, plr_scene *scene) {
    if (!plr_volume_from_node(scene, r->texture, &r->volume, NULL))
        return false;
    for (uint32_t c = 0; c < r->volume.components; c++)
        if (!plr_volume_get_statistics(&r->volume, c, &r->statistics[c]))
            return false;
    count_labels(r);
    find_shown(r);
    bool values = !r->labels || r->volume.components > 1;
    if (values && r->volume.components < 3)
        r->transfer = transfer_to_start_with(&r->volume, &r->statistics[0], r->shown);
    return true;
}

bool next_volume(const volume_list *list, plr_scene *scene, size_t *next, volume_report *report,
                 bool *readable) {
    if (*next >= list->use_count)
        return false;
    *report = (volume_report){.texture = list->uses[*next].texture, .uses = &list->uses[*next]};
    while (*next < list->use_count && list->uses[*next].texture == report->texture) {
        report->use_count++;
        ++*next;
    }
    *readable = read_report(report, scene);
    return true;
}

void free_volume_report(volume_report *report) {
    plr_volume_free(&report->volume);
    free(report->labels);
}
