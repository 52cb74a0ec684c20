/* From a recipe to a program that compiles: links, asks the compilers, leaves faulty effects out.
 */
#ifndef PLR_ENGINE_COMPOSE_H
#define PLR_ENGINE_COMPOSE_H

#include "engine/builder.h"
#include "engine/cache.h"
#include "engine/recipe.h"

/* A distinct program: drawables whose texts are equal share it. */
typedef struct plr_built {
    plr_program_info info;
    GLuint name; /* 0 without GL */
    const plr_defaults *defaults;
    uint64_t hash;
} plr_built;

/* A compiler's complaint about text that a program does not reach. */
typedef struct plr_unreached {
    const plr_source *source;
    plr_place place;
    const char *text;
} plr_unreached;

typedef struct plr_memo plr_memo;

typedef struct plr_composer {
    plr_kitchen *kitchen;
    plr_cache *cache; /* NULL: no GL, glslang only */
    bool check_unreached;
    /* Programs that would have to be compiled are asked of the builder instead: they lack, and are
     * asked for again later. */
    bool defers;
    plr_builder *builder;    /* of views that are interactive; or NULL */
    size_t waiting, refused; /* of those: at work, or not to be had so */
    plr_diags *diags;
    struct {
        plr_built **items;
        size_t count, capacity;
    } built;
    struct {
        plr_unreached *items;
        size_t count, capacity;
    } unreached;
    plr_memo **memos; /* see memo.h */
    double link_cpu_ms, link_wall_ms, compile_cpu_ms, compile_wall_ms;
} plr_composer;

/* Composes; `kind` ("volume", "surface") begins the program's name. Faulty effects of the recipe
 * are marked disabled. The program of `built` is `*program` or one of equal text; both are owned by
 * the composer. NULL if base and built-in effects alone do not compile (reported). */
plr_built *plr_compose_program(plr_composer *composer, plr_recipe *recipe, const char *kind,
                               const plr_program **program);
/* Links and nothing else; the caller destroys the program. */
plr_program *plr_link_recipe(plr_composer *composer, const plr_recipe *recipe, bool keep_all,
                             plr_diags *diags);
void plr_composer_finish(plr_composer *composer);

/* CPU time of all threads and wall time since some start, in milliseconds. */
plr_phase plr_clock(void);

#endif
