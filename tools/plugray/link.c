/* plugray link: effects of files into a base shader of files. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/compose.h"
#include "engine/unreached.h"
#include "engine/report.h"
#include "tools/plugray/commands.h"
#include "tools/plugray/files.h"
#include "tools/plugray/listing.h"
#include "tools/plugray/report.h"
#include "tools/plugray/units.h"

typedef struct link_job {
    const tool_arguments *arguments;
    plr_stage stage;
    unit_group base, *groups; /* groups: of the effects */
    plr_effect *effects;
    char **names;
    size_t effect_count;
    plr_catalog *catalog;
    plr_diags *diags;
} link_job;

/* Macros that the engine, too, defines for the conditionals of all units. */
static const plr_define host_defines[] = {{"CASTLE_GLSL_VERSION_UPGRADE", "1"}};

static bool read_stage(link_job *job) {
    const char *text = option_value(job->arguments, OPTION_STAGE);
    job->stage = stage_of_path(job->arguments->operands[0]);
    if (!text && job->stage == PLR_STAGE_COUNT)
        job->stage = PLR_FRAGMENT;
    if (!text)
        return true;
    int index = word_index(option_words(OPTION_STAGE), text);
    if (index < 0) {
        usage_error(job->arguments, "--stage takes %s, not '%s'", option_words(OPTION_STAGE), text);
        return false;
    }
    job->stage = (plr_stage)index;
    return true;
}

/* The effect's word; the second and later uses of a word are told apart: "tint.frag#2". */
static char *effect_name(const link_job *job, size_t index) {
    size_t uses = 1;
    for (size_t i = 0; i < index; i++)
        uses += strcmp(job->groups[i].word, job->groups[index].word) == 0;
    return uses == 1 ? text_format("%s", job->groups[index].word)
                     : text_format("%s#%zu", job->groups[index].word, uses);
}

/* False if there is no base to link to. */
static bool read_units(link_job *job) {
    const tool_arguments *a = job->arguments;
    bool base = unit_group_read(&job->base, a->operands[0], job->stage, job->diags);
    job->effect_count = a->operand_count - 1;
    job->groups = memory_array(NULL, job->effect_count, sizeof *job->groups);
    job->effects = memory_array(NULL, job->effect_count, sizeof *job->effects);
    job->names = memory_array(NULL, job->effect_count, sizeof *job->names);
    for (size_t i = 0; i < job->effect_count; i++) {
        unit_group *group = &job->groups[i];
        bool whole = unit_group_read(group, a->operands[i + 1], job->stage, job->diags);
        job->names[i] = effect_name(job, i);
        job->effects[i] = (plr_effect){.name = job->names[i],
                                       .sources = group->sources,
                                       .source_count = group->count,
                                       .disabled = !whole,
                                       .place = {group->count ? group->paths[0] : NULL, 1, 1}};
    }
    return base;
}

static void close_job(link_job *job) {
    for (size_t i = 0; i < job->effect_count; i++) {
        unit_group_free(&job->groups[i]);
        free(job->names[i]);
    }
    unit_group_free(&job->base);
    free(job->groups);
    free(job->effects);
    free(job->names);
    plr_catalog_destroy(&job->catalog);
    plr_diags_destroy(&job->diags);
}

static const char *job_line(const void *user, const char *file, uint32_t line, size_t *length) {
    const link_job *job = user;
    const char *text = unit_group_line(&job->base, file, line, length);
    for (size_t i = 0; !text && i < job->effect_count; i++)
        text = unit_group_line(&job->groups[i], file, line, length);
    return text;
}

/* ---- Linking ---- */

static plr_program *link_units(const link_job *job, plr_target_glsl glsl, plr_diags *diags) {
    const plr_sources *library = plr_catalog_library(job->catalog);
    plr_link_desc desc = {.base = job->base.sources,
                          .base_count = job->base.count,
                          .library = library->items,
                          .library_count = library->count,
                          .effects = job->effects,
                          .effect_count = job->effect_count,
                          .defines = host_defines,
                          .define_count = sizeof host_defines / sizeof *host_defines,
                          .glsl = glsl,
                          .keep_all = option_value(job->arguments, OPTION_KEEP_ALL) != NULL};
    desc.known_plugs = plr_catalog_plugs(job->catalog, &desc.known_plug_count);
    return plr_link(&desc, diags);
}

static plr_recipe recipe_of(const link_job *job) {
    plr_recipe recipe = {0};
    recipe.base.items = (const plr_source **)job->base.sources;
    recipe.base.count = job->base.count;
    recipe.effects.items = job->effects;
    recipe.effects.count = job->effect_count;
    recipe.defines.items = (plr_define *)host_defines;
    recipe.defines.count = sizeof host_defines / sizeof *host_defines;
    return recipe;
}

/* Has the compiler find the faulty effects, as drawing would: they are reported, and disabled. */
static void validate_effects(link_job *job) {
    plr_arena arena;
    jmp_buf out_of_memory;
    plr_arena_init(&arena, NULL, &out_of_memory);
    plr_kitchen kitchen = {
        .arena = &arena, .lasting = &arena, .catalog = job->catalog, .diags = job->diags};
    plr_composer composer = {.kitchen = &kitchen, .check_unreached = true, .diags = job->diags};
    plr_recipe recipe = recipe_of(job);
    if (setjmp(out_of_memory) == 0) {
        const plr_program *program;
        plr_compose_program(&composer, &recipe, "link", &program);
        for (size_t i = 0; i < job->effect_count; i++) /* the recipe has copies by now */
            job->effects[i].disabled = recipe.effects.items[i].disabled;
        plr_unreached_report(&composer);
    } else {
        plr_diags_add(job->diags, PLR_CODE_NO_MEMORY, (plr_place){NULL, 0, 0}, "out of memory");
    }
    plr_composer_finish(&composer);
    plr_arena_finish(&arena);
}

/* The program as it is written, where that is not the one that validate_effects has seen. */
static void validate_program(const link_job *job, const plr_program *program) {
    const char *texts[PLR_STAGE_COUNT];
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
        texts[stage] = plr_program_text(program, (plr_stage)stage, NULL);
    plr_glsl_messages messages[PLR_STAGE_COUNT] = {0}, linking = {0};
    plr_recipe recipe = recipe_of(job);
    plr_glsl_check(texts, messages, &linking);
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++) {
        plr_report report = {program, &recipe, (plr_stage)stage, PLR_CODE_GLSL};
        for (size_t i = 0; i < messages[stage].count; i++)
            plr_report_add(&report, &messages[stage].items[i], job->diags);
        plr_glsl_messages_free(&messages[stage]);
    }
    plr_glsl_messages_free(&linking);
}

static plr_program *make_program(link_job *job, plr_target_glsl glsl) {
    bool validate = option_value(job->arguments, OPTION_VALIDATE) != NULL;
    if (validate)
        validate_effects(job);
    plr_program *program = link_units(job, glsl, validate ? NULL : job->diags);
    bool other = glsl != PLR_GLSL_330 || option_value(job->arguments, OPTION_KEEP_ALL);
    if (program && validate && other)
        validate_program(job, program);
    return program;
}

/* ---- Writing ---- */

static void write_link_map(const link_job *job, const plr_program *program, FILE *out) {
    write_map(out, program, job->stage, job->effects);
}

static void write_symbols(const link_job *job, const plr_program *program, FILE *out) {
    char buffer[32];
    for (size_t i = 0; i < plr_program_symbol_count(program); i++) {
        const plr_symbol *symbol = plr_program_symbol(program, i);
        if (symbol->kind != PLR_UNIFORM || !(symbol->stages & (1u << job->stage)))
            continue;
        fprintf(out, "%s\t%s\t%s\t%s\t", effect_label(job->effects, symbol->effect, buffer),
                symbol->name, symbol->program, symbol->type);
        if (symbol->array == UINT32_MAX)
            fputs("?\n", out);
        else
            fprintf(out, "%u\n", symbol->array);
    }
}

static void write_program(const link_job *job, const plr_program *program, FILE *out) {
    size_t length;
    const char *text = plr_program_text(program, job->stage, &length);
    fwrite(text, 1, length, out);
}

static void write_all(const link_job *job, const plr_program *program) {
    static const struct {
        tool_option option;
        void (*write)(const link_job *, const plr_program *, FILE *);
    } outputs[] = {{OPTION_PROGRAM, write_program},
                   {OPTION_MAP, write_link_map},
                   {OPTION_SYMBOLS, write_symbols}};
    for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i++) {
        const char *path = option_value(job->arguments, outputs[i].option);
        output_file file;
        if ((!path && outputs[i].option == OPTION_PROGRAM) || (path && strcmp(path, "-") == 0)) {
            outputs[i].write(job, program, stdout);
        } else if (path && output_open(&file, path, job->diags)) {
            outputs[i].write(job, program, file.stream);
            output_close(&file, job->diags);
        }
    }
}

/* False after a usage error. */
static bool link_and_write(link_job *job, plr_target_glsl glsl) {
    plr_program *program = make_program(job, glsl);
    bool usable = true;
    if (program && !plr_program_text(program, job->stage, NULL)) {
        usage_error(job->arguments, "%s has no %s stage", job->base.word,
                    plr_stage_text(job->stage));
        usable = false;
    } else if (program) {
        write_all(job, program);
    }
    plr_program_destroy(&program);
    return usable;
}

int command_link(const tool_arguments *arguments) {
    link_job job = {.arguments = arguments};
    const char *glsl = option_value(arguments, OPTION_GLSL);
    int target = glsl ? word_index(option_words(OPTION_GLSL), glsl) : PLR_GLSL_330;
    if (target < 0)
        return usage_error(arguments, "--glsl takes %s, not '%s'", option_words(OPTION_GLSL), glsl);
    if (!read_stage(&job))
        return STATUS_USAGE;
    job.diags = plr_diags_create(NULL);
    job.catalog = plr_catalog_create(job.diags);
    int status = STATUS_FINE;
    if (!job.diags || !job.catalog) {
        fputs("plugray: there is not enough memory\n", stderr);
        status = STATUS_MACHINE;
    } else if (read_units(&job) && !link_and_write(&job, (plr_target_glsl)target)) {
        status = STATUS_USAGE;
    }
    tool_report report = {job.diags, job_line, &job};
    fflush(stdout);
    report_text(stderr, &report);
    if (status == STATUS_FINE)
        status = report_status(job.diags, false);
    close_job(&job);
    return status;
}
