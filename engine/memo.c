#include "engine/memo.h"

#include <string.h>

struct plr_memo {
    plr_memo_key key;
    plr_built *built;
    const bool *disabled; /* for each effect */
    struct plr_memo *next;
};

enum {
    BUCKETS = 1024
};

/* ---- Keys: all that linking and checking look at ---- */

typedef struct writer {
    plr_arena *arena;
    struct {
        char *items;
        size_t count, capacity;
    } bytes;
} writer;

static void put(writer *w, const void *bytes, size_t size) {
    w->bytes.items =
        plr_arena_grow(w->arena, w->bytes.items, &w->bytes.capacity, w->bytes.count + size, 1);
    if (size)
        memcpy(w->bytes.items + w->bytes.count, bytes, size);
    w->bytes.count += size;
}

static void put_text(writer *w, const char *text) {
    put(w, text ? text : "", text ? strlen(text) + 1 : 1);
}

static void put_number(writer *w, size_t number) {
    put(w, &number, sizeof number);
}

static void put_sources(writer *w, const plr_source *const *sources, size_t count) {
    put_number(w, count);
    put(w, sources, count * sizeof(const plr_source *));
}

static void put_defines(writer *w, const plr_define *defines, size_t count) {
    put_number(w, count);
    for (size_t i = 0; i < count; i++) {
        put_text(w, defines[i].name);
        put_text(w, defines[i].value);
    }
}

static void put_effect(writer *w, const plr_effect *effect, const plr_node *node) {
    put_text(w, effect->name);
    put_text(w, effect->target);
    put_text(w, effect->gate);
    put_sources(w, effect->sources, effect->source_count);
    put_defines(w, effect->defines, effect->define_count);
    put_number(w, effect->attached);
    put_number(w, (size_t)effect->placement << 5 | (size_t)effect->private_plugs << 4 |
                      (size_t)effect->only_attached << 3 | (size_t)effect->builtin << 2 |
                      (size_t)effect->disabled << 1 | (size_t)effect->only_if_active);
    if (!effect->builtin) /* its fields are compared with its uniforms */
        put(w, &node, sizeof node);
}

static plr_memo_key make_key(plr_composer *c, const plr_recipe *recipe, const char *kind) {
    writer w = {.arena = c->kitchen->arena};
    put_text(&w, kind);
    put_text(&w, recipe->primitive);
    put(&w, &recipe->base_node, sizeof recipe->base_node);
    put_sources(&w, recipe->base.items, recipe->base.count);
    put_defines(&w, recipe->defines.items, recipe->defines.count);
    put_number(&w, recipe->bindings.count > 0);
    for (size_t i = 0; i < recipe->effects.count; i++)
        put_effect(&w, &recipe->effects.items[i],
                   i < recipe->bindings.count ? recipe->bindings.items[i].node : NULL);
    plr_memo_key key = {w.bytes.items, w.bytes.count, 14695981039346656037u}; /* FNV-1a */
    for (size_t i = 0; i < key.size; i++)
        key.hash = (key.hash ^ (unsigned char)key.bytes[i]) * 1099511628211u;
    return key;
}

/* ---- The table ---- */

static plr_memo **bucket(plr_composer *c, const plr_memo_key *key) {
    if (!c->memos)
        c->memos = PLR_NEW_ARRAY(c->kitchen->lasting, BUCKETS, plr_memo *);
    return &c->memos[key->hash % BUCKETS];
}

bool plr_memo_find(plr_composer *c, plr_recipe *recipe, const char *kind, plr_memo_key *key,
                   plr_built **built) {
    *key = make_key(c, recipe, kind);
    const plr_memo *memo = *bucket(c, key);
    while (memo && (memo->key.hash != key->hash || memo->key.size != key->size ||
                    memcmp(memo->key.bytes, key->bytes, key->size) != 0))
        memo = memo->next;
    if (!memo)
        return false;
    for (size_t i = 0; i < recipe->effects.count; i++)
        recipe->effects.items[i].disabled = memo->disabled[i];
    *built = memo->built;
    return true;
}

void plr_memo_add(plr_composer *c, const plr_memo_key *key, const plr_recipe *recipe,
                  plr_built *built) {
    plr_arena *arena = c->kitchen->lasting;
    plr_memo *memo = PLR_NEW(arena, plr_memo), **first = bucket(c, key);
    bool *disabled = PLR_NEW_ARRAY(arena, recipe->effects.count + 1, bool);
    for (size_t i = 0; i < recipe->effects.count; i++)
        disabled[i] = recipe->effects.items[i].disabled;
    char *bytes = plr_arena_alloc(arena, key->size + 1);
    memcpy(bytes, key->bytes, key->size);
    *memo = (plr_memo){{bytes, key->size, key->hash}, built, disabled, *first};
    *first = memo;
}

/* ---- Copies that last ---- */

static const char *copy_text(plr_arena *arena, const char *text) {
    return text ? plr_arena_copy(arena, text, strlen(text)) : NULL;
}

static const plr_define *copy_defines(plr_arena *arena, const plr_define *defines, size_t count) {
    plr_define *copy = PLR_NEW_ARRAY(arena, count + 1, plr_define);
    for (size_t i = 0; i < count; i++)
        copy[i] =
            (plr_define){copy_text(arena, defines[i].name), copy_text(arena, defines[i].value)};
    return copy;
}

static const plr_source **copy_sources(plr_arena *arena, const plr_source *const *sources,
                                       size_t count) {
    const plr_source **copy = PLR_NEW_ARRAY(arena, count + 1, const plr_source *);
    for (size_t i = 0; i < count; i++)
        copy[i] = sources[i];
    return copy;
}

void plr_memo_settle(plr_composer *c, plr_recipe *recipe) {
    plr_arena *arena = c->kitchen->lasting;
    size_t count = recipe->effects.count;
    plr_effect *effects = PLR_NEW_ARRAY(arena, count + 1, plr_effect);
    for (size_t i = 0; i < count; i++) {
        const plr_effect *from = &recipe->effects.items[i];
        effects[i] = *from;
        effects[i].name = copy_text(arena, from->name);
        effects[i].target = copy_text(arena, from->target);
        effects[i].sources = copy_sources(arena, from->sources, from->source_count);
        effects[i].defines = copy_defines(arena, from->defines, from->define_count);
    }
    recipe->effects.items = effects;
    recipe->effects.capacity = count;
}
