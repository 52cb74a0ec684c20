#include "engine/compose.h"

#include <string.h>
#include <time.h>

#include "engine/bind.h"
#include "engine/memo.h"
#include "engine/report.h"
#include "engine/unreached.h"

/* After this many rounds of leaving out the first faulty effect of each stage, all effects with a
 * message are left out at once: hostile input must not cost a round an effect. */
enum {
    CAREFUL_ROUNDS = 64
};

static double milliseconds(clockid_t clock) {
    struct timespec now;
    if (clock_gettime(clock, &now))
        return 0;
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

plr_phase plr_clock(void) {
    return (plr_phase){milliseconds(CLOCK_PROCESS_CPUTIME_ID), milliseconds(CLOCK_MONOTONIC)};
}

plr_program *plr_link_recipe(plr_composer *c, const plr_recipe *recipe, bool keep_all,
                             plr_diags *diags) {
    size_t known_count;
    const plr_known_plug *known = plr_catalog_plugs(c->kitchen->catalog, &known_count);
    const plr_sources *library = plr_catalog_library(c->kitchen->catalog);
    size_t target_count;
    const char *const *targets = plr_catalog_targets(c->kitchen->catalog, &target_count);
    plr_link_desc desc = {.base = recipe->base.items,
                          .base_count = recipe->base.count,
                          .library = library->items,
                          .library_count = library->count,
                          .effects = recipe->effects.items,
                          .effect_count = recipe->effects.count,
                          .defines = recipe->defines.items,
                          .define_count = recipe->defines.count,
                          .known_plugs = known,
                          .known_plug_count = known_count,
                          .known_targets = targets,
                          .known_target_count = target_count,
                          .primitive = recipe->primitive,
                          .own_base = recipe->base_node != NULL,
                          .keep_all = keep_all};
    plr_phase start = plr_clock();
    plr_program *program = plr_link(&desc, diags);
    plr_phase end = plr_clock();
    c->link_cpu_ms += end.cpu_ms - start.cpu_ms;
    c->link_wall_ms += end.wall_ms - start.wall_ms;
    return program;
}

static void program_texts(const plr_program *program, const char *texts[PLR_STAGE_COUNT]) {
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
        texts[stage] = plr_program_text(program, (plr_stage)stage, NULL);
}

typedef struct verdict {
    plr_glsl_messages stages[PLR_STAGE_COUNT], link;
} verdict;

static void free_verdict(verdict *v) {
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
        plr_glsl_messages_free(&v->stages[stage]);
    plr_glsl_messages_free(&v->link);
}

/* Leaves out the author's effects that one list of messages is about: the first one with all that
 * is said of it, or all of them if `all`. Says whether any was. */
static bool blame(plr_composer *c, plr_recipe *recipe, const plr_report *report,
                  const plr_glsl_messages *messages, bool all) {
    size_t first = PLR_NO_EFFECT;
    for (size_t i = 0; i < messages->count; i++) {
        plr_mapped mapped;
        size_t effect = plr_report_locate(report, &messages->items[i], &mapped);
        if (messages->items[i].severity != PLR_ERROR || effect == PLR_NO_EFFECT ||
            recipe->effects.items[effect].builtin)
            continue;
        if (first == PLR_NO_EFFECT)
            first = effect;
        if (effect != first && !all)
            continue;
        plr_report_add(report, &messages->items[i], c->diags);
        recipe->effects.items[effect].disabled = true;
    }
    return first != PLR_NO_EFFECT;
}

static bool has_error(const plr_glsl_messages *messages) {
    for (size_t i = 0; i < messages->count; i++)
        if (messages->items[i].severity == PLR_ERROR)
            return true;
    return false;
}

static void report_all(plr_composer *c, const plr_report *report,
                       const plr_glsl_messages *messages) {
    for (size_t i = 0; i < messages->count; i++)
        if (messages->items[i].severity == PLR_ERROR)
            plr_report_add(report, &messages->items[i], c->diags);
}

/* Errors that no author's effect explains: the base's own, or of effects that only fail together.
 */
static void report_unexplained(plr_composer *c, const plr_program *program,
                               const plr_recipe *recipe, const verdict *v) {
    bool any = false;
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++) {
        plr_report report = {program, recipe, (plr_stage)stage, PLR_CODE_GLSL};
        report_all(c, &report, &v->stages[stage]);
        any = any || has_error(&v->stages[stage]);
    }
    plr_report report = {program, recipe, PLR_STAGE_COUNT, PLR_CODE_GLSL_LINK};
    if (!any)
        report_all(c, &report, &v->link);
}

static bool blame_all(plr_composer *c, const plr_program *program, plr_recipe *recipe,
                      const verdict *v, bool all) {
    bool found = false;
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++) {
        plr_report report = {program, recipe, (plr_stage)stage, PLR_CODE_GLSL};
        found = blame(c, recipe, &report, &v->stages[stage], all) || found;
    }
    plr_report report = {program, recipe, PLR_STAGE_COUNT, PLR_CODE_GLSL_LINK};
    if (!found)
        found = blame(c, recipe, &report, &v->link, all);
    return found;
}

static uint64_t hash_texts(const char *const texts[PLR_STAGE_COUNT]) {
    uint64_t hash = 14695981039346656037u; /* FNV-1a */
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++) {
        for (const char *c = texts[stage] ? texts[stage] : ""; *c; c++)
            hash = (hash ^ (unsigned char)*c) * 1099511628211u;
        hash = (hash ^ 0xff) * 1099511628211u;
    }
    return hash;
}

static plr_built *find_built(const plr_composer *c, const char *const texts[PLR_STAGE_COUNT],
                             uint64_t hash) {
    for (size_t i = 0; i < c->built.count; i++) {
        plr_built *built = c->built.items[i];
        const char *others[PLR_STAGE_COUNT];
        bool same = built->hash == hash;
        if (same)
            program_texts(built->info.program, others);
        for (int stage = 0; same && stage < PLR_STAGE_COUNT; stage++)
            same = !texts[stage] == !others[stage] &&
                   (!texts[stage] || strcmp(texts[stage], others[stage]) == 0);
        if (same)
            return built;
    }
    return NULL;
}

static plr_built *keep(plr_composer *c, const plr_recipe *recipe, const char *kind,
                       plr_program *program, uint64_t hash) {
    plr_built *built = PLR_NEW(c->kitchen->lasting, plr_built);
    built->hash = hash;
    built->info = (plr_program_info){
        .name = plr_arena_format(c->kitchen->lasting, "%s-%zu", kind, c->built.count + 1),
        .program = program,
        .effects = recipe->effects.items,
        .effect_count = recipe->effects.count};
    *PLR_PUSH(c->kitchen->lasting, &c->built) = built;
    return built;
}

/* The program that is there without compiling; 0: it is being built, or will not be. */
static GLuint look_up(plr_composer *c, const char *const texts[PLR_STAGE_COUNT]) {
    GLuint built = 0, name = c->cache && c->builder ? plr_cache_find(c->cache, texts) : 0;
    if (name || !c->defers)
        return name;
    plr_building state = plr_builder_ask(c->builder, texts, &built);
    if (state == PLR_BUILDING_DONE)
        name = plr_cache_adopt(c->cache, texts, built);
    c->waiting += state == PLR_BUILDING_WAITS;
    c->refused += state != PLR_BUILDING_WAITS && !name;
    return name;
}

/* Asks glslang, and then the driver where there is one. */
static bool compile(plr_composer *c, const char *const texts[PLR_STAGE_COUNT], verdict *v,
                    GLuint *name) {
    plr_phase start = plr_clock();
    bool fine = plr_glsl_check(texts, v->stages, &v->link);
    if (fine && c->cache) {
        free_verdict(v);
        *v = (verdict){0};
        *name = plr_cache_program(c->cache, texts, v->stages, &v->link);
        fine = *name != 0;
    }
    plr_phase end = plr_clock();
    c->compile_cpu_ms += end.cpu_ms - start.cpu_ms;
    c->compile_wall_ms += end.wall_ms - start.wall_ms;
    return fine;
}

/* One round: NULL with *again set if an effect was left out and it is worth another. */
static plr_built *try_once(plr_composer *c, plr_recipe *recipe, const char *kind, int round,
                           bool *again) {
    *again = false;
    plr_program *program = plr_link_recipe(c, recipe, false, c->diags);
    if (!program)
        return NULL;
    for (size_t i = 0; i < recipe->effects.count; i++)
        if (plr_program_is_faulty(program, i))
            recipe->effects.items[i].disabled = true;
    bool bound = recipe->bindings.count > 0; /* else nothing but text is composed */
    if (bound && (plr_bind_check_samplers(c->kitchen, recipe, program) ||
                  plr_bind_check(c->kitchen, recipe, program))) {
        plr_program_destroy(&program);
        *again = true;
        return NULL;
    }
    plr_report_deprecated(recipe, program, c->diags);
    const char *texts[PLR_STAGE_COUNT];
    program_texts(program, texts);
    uint64_t hash = hash_texts(texts);
    plr_built *built = find_built(c, texts, hash);
    if (built) {
        plr_program_destroy(&program);
        return built;
    }
    verdict v = {0};
    GLuint name = look_up(c, texts);
    if (!name && c->defers) {
        plr_program_destroy(&program);
        return NULL;
    }
    if (name || compile(c, texts, &v, &name)) {
        built = keep(c, recipe, kind, program, hash);
        built->name = name;
        built->defaults = name ? plr_cache_defaults(c->cache, name) : NULL;
    } else {
        *again = blame_all(c, program, recipe, &v, round >= CAREFUL_ROUNDS);
        if (!*again)
            report_unexplained(c, program, recipe, &v);
        plr_program_destroy(&program);
    }
    free_verdict(&v);
    return built;
}

plr_built *plr_compose_program(plr_composer *c, plr_recipe *recipe, const char *kind,
                               const plr_program **program) {
    plr_built *built = NULL;
    plr_memo_key key;
    if (!plr_memo_find(c, recipe, kind, &key, &built)) {
        bool again = true;
        plr_memo_settle(c, recipe);
        for (int round = 0; again && !built; round++)
            built = try_once(c, recipe, kind, round, &again);
        if (built && c->check_unreached)
            plr_unreached_collect(c, recipe);
        if (built || !c->defers) /* what lacks may come */
            plr_memo_add(c, &key, recipe, built);
    }
    *program = built ? built->info.program : NULL;
    return built;
}

void plr_composer_finish(plr_composer *c) {
    for (size_t i = 0; i < c->built.count; i++) {
        plr_program *program = (plr_program *)c->built.items[i]->info.program;
        plr_program_destroy(&program);
    }
    c->built.count = 0;
}
