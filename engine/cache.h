/* Compiled GL programs by the hash of their text: in memory, and on disk as binaries. Needs GL. */
#ifndef PLR_ENGINE_CACHE_H
#define PLR_ENGINE_CACHE_H

#include <plugray/plugs.h>
#include "engine/defaults.h"
#include "engine/gl.h"
#include "engine/glsl.h"

typedef struct plr_cache plr_cache;

/* `folder` NULL: nothing on disk. Keys hold the texts of all stages, the driver's vendor, renderer
 * and version and the cache's format; a file that is damaged in any way is deleted and compiled
 * anew. Files are written beside and renamed; the folder is kept below 64 MiB, least recently used
 * first. */
plr_cache *plr_cache_create(const plr_gl *gl, const char *folder);
void plr_cache_destroy(plr_cache **cache);

/* The program of these texts (texts[stage] may be NULL), from memory, disk or the compiler; 0 if it
 * does not compile or link, with messages of the driver by stage and of linking. The cache owns it.
 */
GLuint plr_cache_program(plr_cache *cache, const char *const texts[PLR_STAGE_COUNT],
                         plr_glsl_messages messages[PLR_STAGE_COUNT], plr_glsl_messages *link);

/* The same from memory or disk alone; 0: it is in neither. */
GLuint plr_cache_find(plr_cache *cache, const char *const texts[PLR_STAGE_COUNT]);
/* What the compilers make of the texts, outside of any cache: on any thread with a context. */
GLuint plr_cache_build(const plr_gl *gl, const char *const texts[PLR_STAGE_COUNT],
                       plr_glsl_messages messages[PLR_STAGE_COUNT], plr_glsl_messages *link);
/* Takes over a program that was built elsewhere, in a context that shares with the cache's. The one
 * to use, which may be another; 0 without memory: then it is deleted. */
GLuint plr_cache_adopt(plr_cache *cache, const char *const texts[PLR_STAGE_COUNT], GLuint program);

/* What the uniforms of a program of the cache are when nobody has set them; owned by the cache. */
const plr_defaults *plr_cache_defaults(const plr_cache *cache, GLuint program);

typedef struct plr_cache_stats {
    size_t compiled, from_memory, from_disk;
} plr_cache_stats;
plr_cache_stats plr_cache_get_stats(const plr_cache *cache);

#endif
