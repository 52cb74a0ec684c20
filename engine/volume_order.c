/* An order of volumes that does not depend on how the scene lists them: by a number made of all
 * that they are. Sums over volumes are then the same to the last bit. */
#include "engine/volume_pass.h"

#include <stdlib.h>
#include <string.h>

enum {
    MOST_NODES = 4096 /* looked at for one volume; a few lines can make very many */
};

/* FNV-1a, finished so that all bits count. */
static uint64_t mix(uint64_t hash, const void *data, size_t length) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < length; i++)
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    return hash ^ hash >> 29;
}

static uint64_t mix_node(uint64_t hash, const plr_node *node, size_t *left);

static uint64_t mix_field(uint64_t hash, const plr_field *field, size_t *left) {
    size_t numbers = field->count * (size_t)plr_type_components(field->type);
    hash = mix(hash, field->name, strlen(field->name));
    switch (plr_type_kind(field->type)) {
    case PLR_BOOL:
        return mix(hash, field->value.bools, numbers * sizeof *field->value.bools);
    case PLR_INT:
        return mix(hash, field->value.ints, numbers * sizeof *field->value.ints);
    case PLR_FLOAT:
        return mix(hash, field->value.floats, numbers * sizeof *field->value.floats);
    case PLR_DOUBLE:
        return mix(hash, field->value.doubles, numbers * sizeof *field->value.doubles);
    case PLR_STRING:
        for (size_t i = 0; i < field->count; i++)
            hash = mix(hash, field->value.strings[i].text, field->value.strings[i].length + 1);
        return hash;
    case PLR_NODE:
        for (size_t i = 0; i<field->count && * left> 0; i++)
            hash = mix_node(hash, field->value.nodes[i], left);
        return hash;
    }
    return hash;
}

static uint64_t mix_node(uint64_t hash, const plr_node *node, size_t *left) {
    if (!node || *left == 0)
        return mix(hash, "", 1);
    --*left;
    hash = mix(hash, plr_node_type(node), strlen(plr_node_type(node)));
    for (size_t i = 0; i < plr_node_field_count(node); i++) {
        const plr_field *field = plr_node_field_at(node, i);
        bool data = strcmp(field->name, "image") == 0; /* the hash of the voxels has it */
        if (field->given && !data && strcmp(field->name, "metadata") != 0)
            hash = mix_field(hash, field, left);
    }
    return hash;
}

typedef struct ordered {
    uint64_t hash;
    size_t volume;
} ordered;

static int by_hash(const void *a, const void *b) {
    const ordered *x = a, *y = b;
    return x->hash != y->hash ? (x->hash < y->hash ? -1 : 1)
                              : (x->volume > y->volume) - (x->volume < y->volume);
}

void plr_volume_order(plr_view *view, size_t *members, size_t count) {
    if (view->general) /* their text must not depend on values */
        return;
    ordered *list = PLR_NEW_ARRAY(&view->arena, count, ordered);
    for (size_t i = 0; i < count; i++) {
        const plr_volume_state *state = &view->volumes.volumes[members[i]];
        size_t left = MOST_NODES;
        list[i].volume = members[i];
        list[i].hash = mix(state->hash, state->to_world.m, sizeof state->to_world.m);
        list[i].hash = mix_node(list[i].hash, state->node, &left);
    }
    qsort(list, count, sizeof *list, by_hash);
    for (size_t i = 0; i < count; i++)
        members[i] = list[i].volume;
}
