/* An order of volumes that does not depend on how the scene lists them: by numbers made of all that
 * they are. Sums over volumes are then the same to the last bit. What the text of a program may
 * depend on counts first, where they are last: things that move do not change the text. */
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

typedef struct walk {
    size_t left; /* nodes */
    bool values; /* numbers, too, that are not whole */
} walk;

static uint64_t mix_node(uint64_t hash, const plr_node *node, walk *w);

static uint64_t mix_field(uint64_t hash, const plr_field *field, walk *w) {
    size_t numbers = field->count * (size_t)plr_type_components(field->type);
    hash = mix(hash, field->name, strlen(field->name));
    switch (plr_type_kind(field->type)) {
    case PLR_BOOL:
        return mix(hash, field->value.bools, numbers * sizeof *field->value.bools);
    case PLR_INT:
        return mix(hash, field->value.ints, numbers * sizeof *field->value.ints);
    case PLR_FLOAT:
        return mix(hash, field->value.floats, w->values ? numbers * sizeof(float) : 0);
    case PLR_DOUBLE:
        return mix(hash, field->value.doubles, w->values ? numbers * sizeof(double) : 0);
    case PLR_STRING:
        for (size_t i = 0; i < field->count; i++)
            hash = mix(hash, field->value.strings[i].text, field->value.strings[i].length + 1);
        return hash;
    case PLR_NODE:
        for (size_t i = 0; i < field->count && w->left > 0; i++)
            hash = mix_node(hash, field->value.nodes[i], w);
        return hash;
    }
    return hash;
}

static uint64_t mix_node(uint64_t hash, const plr_node *node, walk *w) {
    if (!node || w->left == 0)
        return mix(hash, "", 1);
    w->left--;
    hash = mix(hash, plr_node_type(node), strlen(plr_node_type(node)));
    for (size_t i = 0; i < plr_node_field_count(node); i++) {
        const plr_field *field = plr_node_field_at(node, i);
        bool data = strcmp(field->name, "image") == 0; /* the hash of the voxels has it */
        if (field->given && !data && strcmp(field->name, "metadata") != 0)
            hash = mix_field(hash, field, w);
    }
    return hash;
}

typedef struct ordered {
    uint64_t hashes[3]; /* of its structure, of its values, of its place */
    size_t volume;
} ordered;

static int by_hashes(const void *a, const void *b) {
    const ordered *x = a, *y = b;
    for (size_t i = 0; i < sizeof x->hashes / sizeof *x->hashes; i++)
        if (x->hashes[i] != y->hashes[i])
            return x->hashes[i] < y->hashes[i] ? -1 : 1;
    return (x->volume > y->volume) - (x->volume < y->volume);
}

void plr_volume_order(plr_view *view, size_t *members, size_t count) {
    if (view->general) /* their text must not depend on values */
        return;
    ordered *list = PLR_NEW_ARRAY(&view->arena, count, ordered);
    for (size_t i = 0; i < count; i++) {
        const plr_volume_state *state = &view->volumes.volumes[members[i]];
        walk structure = {MOST_NODES, false}, values = {MOST_NODES, true};
        uint64_t basis = UINT64_C(0xcbf29ce484222325);
        list[i] = (ordered){{mix_node(basis, state->node, &structure),
                             mix_node(state->hash, state->node, &values),
                             mix(basis, state->to_world.m, sizeof state->to_world.m)},
                            members[i]};
    }
    qsort(list, count, sizeof *list, by_hashes);
    for (size_t i = 0; i < count; i++)
        members[i] = list[i].volume;
}
