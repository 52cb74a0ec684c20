#include "engine/view.h"

#include <stdio.h>
#include <stdlib.h>

plr_engine *plr_engine_create(const plr_engine_desc *desc, plr_diags *diags) {
    plr_engine *engine = calloc(1, sizeof *engine);
    if (!engine)
        return NULL;
    const char *missing = plr_gl_load(&engine->gl, desc->get_proc_address, desc->user);
    if (missing) {
        plr_diags_add(diags, PLR_CODE_NO_GL, (plr_place){0},
                      "the GL implementation lacks gl%s, which is in GL 3.3", missing);
        free(engine);
        return NULL;
    }
    engine->desc = *desc;
    engine->cache = plr_cache_create(&engine->gl, desc->cache_folder);
    engine->catalog = plr_catalog_create(diags);
    if (!engine->cache || !engine->catalog)
        plr_engine_destroy(&engine);
    return engine;
}

void plr_engine_destroy(plr_engine **engine) {
    if (!*engine)
        return;
    plr_builder_destroy(&(*engine)->builder); /* before the programs are */
    plr_cache_destroy(&(*engine)->cache);
    plr_catalog_destroy(&(*engine)->catalog);
    free(*engine);
    *engine = NULL;
}

bool plr_engine_default_cache(char *buffer, size_t size) {
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int length = -1;
    if (cache && cache[0] == '/') /* the XDG specification: other paths are to be ignored */
        length = snprintf(buffer, size, "%s/plugray", cache);
    else if (home && *home)
        length = snprintf(buffer, size, "%s/.cache/plugray", home);
    return length > 0 && (size_t)length < size;
}
