/* The GLSL that plugray brings (effects/), read for the linker once. No GL. */
#ifndef PLR_ENGINE_CATALOG_H
#define PLR_ENGINE_CATALOG_H

#include <plugray/engine.h>

typedef struct plr_sources {
    const plr_source **items;
    size_t count, capacity;
} plr_sources;

typedef struct plr_catalog plr_catalog;

/* Reads everything; NULL without memory. */
plr_catalog *plr_catalog_create(plr_diags *diags);
void plr_catalog_destroy(plr_catalog **catalog);

/* The units whose path is `path` + ".glsl", ".vert.glsl", ".geom.glsl" or ".frag.glsl": a built-in
 * effect or a base shader ("volume/raycaster"). Count 0 if there is none. Owned by the catalog. */
const plr_sources *plr_catalog_units(const plr_catalog *catalog, const char *path);
/* The library, for every stage. */
const plr_sources *plr_catalog_library(const plr_catalog *catalog);
/* Every plug that any of the files offers. */
const plr_known_plug *plr_catalog_plugs(const plr_catalog *catalog, size_t *count);
/* The names of built-in effects, for the targets of others. */
const char *const *plr_catalog_targets(const plr_catalog *catalog, size_t *count);

#endif
