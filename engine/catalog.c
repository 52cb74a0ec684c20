#include "engine/catalog.h"

#include <string.h>

#include "base/arena.h"

typedef struct entry {
    const char *path; /* without endings */
    plr_sources units;
} entry;

struct plr_catalog {
    plr_arena arena;
    struct {
        entry *items;
        size_t count, capacity;
    } entries;
    struct {
        plr_source **items;
        size_t count, capacity;
    } owned;
    plr_sources library;
    struct {
        plr_known_plug *items;
        size_t count, capacity;
    } plugs;
    struct {
        const char **items;
        size_t count, capacity;
    } targets;
};

static const struct {
    const char *ending;
    plr_stage stage;
} endings[] = {{".vert.glsl", PLR_VERTEX},
               {".geom.glsl", PLR_GEOMETRY},
               {".frag.glsl", PLR_FRAGMENT},
               {".glsl", PLR_FRAGMENT}};

/* The stage of a file and the length of its path without endings. */
static plr_stage split_path(const char *path, size_t *stem, bool *any_stage) {
    size_t length = strlen(path);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        size_t tail = strlen(endings[i].ending);
        if (length > tail && strcmp(path + length - tail, endings[i].ending) == 0) {
            *stem = length - tail;
            *any_stage = i + 1 == sizeof endings / sizeof *endings;
            return endings[i].stage;
        }
    }
    *stem = length;
    *any_stage = true;
    return PLR_FRAGMENT;
}

static const plr_source *read_unit(plr_catalog *catalog, plr_stage stage, const char *path,
                                   const char *text, size_t length, plr_diags *diags) {
    plr_origin origin = {plr_arena_format(&catalog->arena, "effects/%s", path), 1, 1, NULL, 0};
    plr_source **slot = PLR_PUSH(&catalog->arena, &catalog->owned);
    *slot = plr_source_read(stage, text, length, &origin, NULL, diags);
    if (!*slot)
        longjmp(*catalog->arena.out_of_memory, 1);
    return *slot;
}

static entry *entry_of(plr_catalog *catalog, const char *path, size_t stem) {
    for (size_t i = 0; i < catalog->entries.count; i++) {
        entry *found = &catalog->entries.items[i];
        if (strlen(found->path) == stem && strncmp(found->path, path, stem) == 0)
            return found;
    }
    entry *added = PLR_PUSH(&catalog->arena, &catalog->entries);
    *added = (entry){.path = plr_arena_copy(&catalog->arena, path, stem)};
    return added;
}

static bool is_listed(const plr_catalog *catalog, const char *name, plr_stage stage) {
    for (size_t i = 0; i < catalog->plugs.count; i++)
        if (catalog->plugs.items[i].stage == stage &&
            strcmp(catalog->plugs.items[i].name, name) == 0)
            return true;
    return false;
}

static void list_plugs(plr_catalog *catalog, const plr_source *source) {
    plr_stage stage = plr_source_stage(source);
    for (size_t i = 0; i < plr_source_plug_count(source); i++) {
        size_t length;
        const char *text = plr_source_plug(source, i, &length);
        char *name = plr_arena_copy(&catalog->arena, text, length);
        if (!is_listed(catalog, name, stage))
            *PLR_PUSH(&catalog->arena, &catalog->plugs) = (plr_known_plug){name, stage};
    }
}

static void read_all(plr_catalog *catalog, plr_diags *diags) {
    const char *path, *text;
    size_t length, stem;
    for (size_t i = 0; (path = plr_effects_file(i, &text, &length)); i++) {
        bool any_stage;
        plr_stage stage = split_path(path, &stem, &any_stage);
        bool library = strncmp(path, "library/", 8) == 0;
        for (int s = 0; s < PLR_STAGE_COUNT; s++) {
            if (s != (int)stage && !(library && any_stage))
                continue;
            const plr_source *source = read_unit(catalog, (plr_stage)s, path, text, length, diags);
            plr_sources *list = library ? &catalog->library : &entry_of(catalog, path, stem)->units;
            *PLR_PUSH(&catalog->arena, list) = source;
            list_plugs(catalog, source);
        }
    }
}

/* An effect is called as its file or as the node that brings it: of one of these types. */
static void list_targets(plr_catalog *catalog) {
    static const char *const types[] = {
        "X3DVolumeRenderStyleNode", "X3DLightNode", "X3DTextureNode",   "X3DTextureTransformNode",
        "X3DMaterialNode",          "X3DFogObject", "X3DVolumeDataNode"};
    for (size_t i = 0; i < catalog->entries.count; i++) {
        const char *slash = strrchr(catalog->entries.items[i].path, '/');
        *PLR_PUSH(&catalog->arena, &catalog->targets) =
            slash ? slash + 1 : catalog->entries.items[i].path;
    }
    for (size_t i = 0; i < plr_node_info_count(); i++) {
        const plr_node_info *info = plr_node_info_at(i);
        for (size_t t = 0; t < sizeof types / sizeof *types; t++)
            if (plr_node_info_is(info, types[t]))
                *PLR_PUSH(&catalog->arena, &catalog->targets) = info->name;
    }
}

plr_catalog *plr_catalog_create(plr_diags *diags) {
    plr_allocator allocator = plr_allocator_resolve(NULL);
    plr_catalog *volatile catalog = allocator.reallocate(allocator.user, NULL, sizeof *catalog);
    if (!catalog)
        return NULL;
    memset(catalog, 0, sizeof *catalog);
    jmp_buf out_of_memory;
    plr_arena_init(&catalog->arena, NULL, &out_of_memory);
    if (setjmp(out_of_memory)) {
        plr_catalog *failed = catalog;
        plr_catalog_destroy(&failed);
        return NULL;
    }
    read_all(catalog, diags);
    list_targets(catalog);
    return catalog;
}

void plr_catalog_destroy(plr_catalog **catalog) {
    if (!*catalog)
        return;
    for (size_t i = 0; i < (*catalog)->owned.count; i++)
        plr_source_destroy(&(*catalog)->owned.items[i]);
    plr_allocator allocator = (*catalog)->arena.allocator;
    plr_arena_finish(&(*catalog)->arena);
    allocator.release(allocator.user, *catalog);
    *catalog = NULL;
}

const plr_sources *plr_catalog_units(const plr_catalog *catalog, const char *path) {
    static const plr_sources none = {0};
    for (size_t i = 0; i < catalog->entries.count; i++)
        if (strcmp(catalog->entries.items[i].path, path) == 0)
            return &catalog->entries.items[i].units;
    return &none;
}

const plr_sources *plr_catalog_library(const plr_catalog *catalog) {
    return &catalog->library;
}

const plr_known_plug *plr_catalog_plugs(const plr_catalog *catalog, size_t *count) {
    *count = catalog->plugs.count;
    return catalog->plugs.items;
}

const char *const *plr_catalog_targets(const plr_catalog *catalog, size_t *count) {
    *count = catalog->targets.count;
    return catalog->targets.items;
}
