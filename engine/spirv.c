#include "engine/spirv.h"

#include <stdlib.h>
#include <string.h>

/* Opcodes of section 3.42. */
enum {
    HEADER_WORDS = 5,
    BOUND_WORD = 3,
    OP_NAME = 5,
    OP_LINE = 8,
    OP_FUNCTION = 54,
    OP_FUNCTION_END = 56,
    OP_LABEL = 248,
    OP_NO_LINE = 317
};

/* Ranges of opcodes. */
typedef struct opcodes {
    uint16_t first, last;
} opcodes;

/* Inside functions, but no work: structure, names of lines, storage. */
static const opcodes idle[] = {
    {0, 0},     /* OpNop */
    {8, 8},     /* OpLine */
    {54, 56},   /* OpFunction, OpFunctionParameter, OpFunctionEnd */
    {59, 59},   /* OpVariable */
    {246, 248}, /* OpLoopMerge, OpSelectionMerge, OpLabel */
    {317, 317}, /* OpNoLine */
};

/* OpImageSample* .. OpImageDrefGather, and the sparse forms. */
static const opcodes fetching[] = {{87, 97}, {305, 314}};

/* What is made of the id in word 3: OpLoad, OpAccessChain, OpInBoundsAccessChain, OpCopyObject,
 * OpSampledImage, OpImage. */
static const opcodes passing[] = {{61, 61}, {65, 66}, {83, 83}, {86, 86}, {100, 100}};

static bool among(const opcodes *list, size_t count, unsigned opcode) {
    for (size_t i = 0; i < count; i++)
        if (opcode >= list[i].first && opcode <= list[i].last)
            return true;
    return false;
}
#define AMONG(list, opcode) among(list, sizeof(list) / sizeof *(list), opcode)

/* One instruction after the other. */
typedef struct reader {
    const uint32_t *words;
    size_t size, at, length;
    unsigned opcode;
    bool inside; /* of a function */
} reader;

static bool next(reader *r) {
    r->at += r->length;
    if (r->at >= r->size)
        return false;
    r->opcode = r->words[r->at] & 0xffff;
    r->length = r->words[r->at] >> 16;
    if (r->length == 0 || r->length > r->size - r->at)
        return false;
    r->inside = (r->inside || r->opcode == OP_FUNCTION) && r->opcode != OP_FUNCTION_END;
    return true;
}

static reader start(const uint32_t *words, size_t size) {
    return (reader){.words = words, .size = size, .length = HEADER_WORDS};
}

void plr_spirv_count(const uint32_t *words, size_t size, uint32_t *instructions,
                     uint32_t *fetches) {
    *instructions = *fetches = 0;
    for (reader r = start(words, size); next(&r);) {
        *instructions += r.inside && !AMONG(idle, r.opcode);
        *fetches += r.inside && AMONG(fetching, r.opcode);
    }
}

/* What is known of an id. */
typedef struct id_info {
    uint32_t made_of; /* 0: nothing that matters */
    const char *name;
} id_info;

static const char *name_at(const reader *r) {
    const char *text = (const char *)(r->words + r->at + 2);
    return r->length > 2 && memchr(text, 0, (r->length - 2) * sizeof *r->words) ? text : NULL;
}

static void note_ids(const uint32_t *words, size_t size, id_info *ids, uint32_t bound) {
    for (reader r = start(words, size); next(&r);) {
        const uint32_t *word = words + r.at;
        if (r.opcode == OP_NAME && r.length > 2 && word[1] < bound)
            ids[word[1]].name = name_at(&r);
        else if (AMONG(passing, r.opcode) && r.length > 3 && word[2] < bound && word[3] < bound)
            ids[word[2]].made_of = word[3];
    }
}

static const char *name_of(const id_info *ids, uint32_t bound, uint32_t id) {
    for (int steps = 0; steps < 16 && id < bound; steps++) {
        if (!ids[id].made_of)
            return ids[id].name;
        id = ids[id].made_of;
    }
    return NULL;
}

plr_spirv_fetch *plr_spirv_fetches(const uint32_t *words, size_t size, size_t *count) {
    uint32_t instructions, fetches, line = 0;
    *count = 0;
    plr_spirv_count(words, size, &instructions, &fetches);
    /* every id is the result of an instruction of two words at least */
    uint32_t bound = size > HEADER_WORDS && words[BOUND_WORD] <= size ? words[BOUND_WORD] : 0;
    id_info *ids = calloc((size_t)bound + 1, sizeof *ids);
    plr_spirv_fetch *list = fetches ? malloc(fetches * sizeof *list) : NULL;
    if (!ids || !list) {
        free(ids);
        free(list);
        return NULL;
    }
    note_ids(words, size, ids, bound);
    for (reader r = start(words, size); next(&r);) {
        const uint32_t *word = words + r.at;
        if (r.opcode == OP_LINE && r.length > 2)
            line = word[2];
        else if (r.opcode == OP_NO_LINE || r.opcode == OP_LABEL)
            line = 0;
        if (r.inside && AMONG(fetching, r.opcode))
            list[(*count)++] =
                (plr_spirv_fetch){line, r.length > 3 ? name_of(ids, bound, word[3]) : NULL};
    }
    free(ids);
    return list;
}
