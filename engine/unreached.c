#include "engine/unreached.h"

#include <string.h>

#include "engine/report.h"

/* The length of the plug's name behind the last "PLUG_" before the end of a place's line; 0: none.
 */
static size_t plug_before(const char *text, size_t offset, const char **name) {
    static const char prefix[] = "PLUG_";
    size_t length = strlen(prefix);
    for (size_t at = offset + strcspn(text + offset, "\n") + 1; at-- > 0;)
        if (strncmp(text + at, prefix, length) == 0) {
            *name = text + at + length;
            return strspn(*name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_");
        }
    return 0;
}

/* Whether the place belongs to a function for a plug that plugray knows and this program does not
 * have: it is written for another kind of program, whose names are not known here. */
static bool is_foreign(const plr_composer *c, const plr_program *program,
                       const plr_mapped *mapped) {
    const char *name;
    size_t length = mapped->source
                        ? plug_before(plr_source_text(mapped->source, NULL), mapped->offset, &name)
                        : 0;
    size_t count;
    const plr_known_plug *known = plr_catalog_plugs(c->kitchen->catalog, &count);
    bool is_known = false;
    for (size_t i = 0; length && i < count; i++)
        is_known = is_known ||
                   (strlen(known[i].name) == length && strncmp(known[i].name, name, length) == 0);
    for (size_t i = 0; is_known && i < plr_program_plug_count(program); i++) {
        const char *offered = plr_program_plug(program, i)->name;
        if (strlen(offered) == length && strncmp(offered, name, length) == 0)
            return false;
    }
    return is_known;
}

static void keep(plr_composer *c, const plr_report *report, const plr_glsl_message *message) {
    plr_mapped mapped;
    size_t effect = plr_report_locate(report, message, &mapped);
    if (effect == PLR_NO_EFFECT || report->recipe->effects.items[effect].builtin ||
        is_foreign(c, report->program, &mapped))
        return;
    char text[1024];
    plr_program_demangle(report->program, message->text, text, sizeof text);
    plr_arena *arena = c->kitchen->lasting;
    if (mapped.place.file)
        mapped.place.file = plr_arena_copy(arena, mapped.place.file, strlen(mapped.place.file));
    *PLR_PUSH(arena, &c->unreached) =
        (plr_unreached){mapped.source, mapped.place, plr_arena_copy(arena, text, strlen(text))};
}

void plr_unreached_collect(plr_composer *c, const plr_recipe *recipe) {
    plr_program *program = plr_link_recipe(c, recipe, true, NULL);
    if (!program)
        return;
    const char *texts[PLR_STAGE_COUNT];
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
        texts[stage] = plr_program_text(program, (plr_stage)stage, NULL);
    plr_glsl_messages messages[PLR_STAGE_COUNT] = {0}, link = {0};
    plr_glsl_check(texts, messages, &link);
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++) {
        plr_report report = {program, recipe, (plr_stage)stage, PLR_CODE_UNREACHED};
        for (size_t i = 0; i < messages[stage].count; i++)
            keep(c, &report, &messages[stage].items[i]);
        plr_glsl_messages_free(&messages[stage]);
    }
    plr_glsl_messages_free(&link);
    plr_program_destroy(&program);
}

static bool stands_in(const plr_program *program, const plr_unreached *unreached) {
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++) {
        uint32_t lines = plr_program_lines(program, (plr_stage)stage);
        for (uint32_t line = 1; line <= lines; line++) {
            plr_mapped mapped;
            if (plr_program_map(program, (plr_stage)stage, line, 0, &mapped) &&
                mapped.source == unreached->source && !mapped.socket_call &&
                mapped.place.line == unreached->place.line)
                return true;
        }
    }
    return false;
}

void plr_unreached_report(plr_composer *c) {
    for (size_t i = 0; i < c->unreached.count; i++) {
        const plr_unreached *unreached = &c->unreached.items[i];
        bool compiled = false;
        for (size_t b = 0; b < c->built.count && !compiled; b++)
            compiled = stands_in(c->built.items[b]->info.program, unreached);
        if (!compiled)
            plr_diags_add(c->diags, PLR_CODE_UNREACHED, unreached->place, "%s", unreached->text);
    }
}
