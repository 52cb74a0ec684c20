#include "engine/report.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* "plr12_noise" in a message of linking, that has no line, tells which effect it is about. */
static size_t effect_in_words(const char *text, size_t effect_count) {
    for (const char *at = text; (at = strstr(at, "plr")); at++) {
        unsigned number;
        int used = 0;
        if ((at == text || !(isalnum((unsigned char)at[-1]) || at[-1] == '_')) &&
            sscanf(at, "plr%9u%n", &number, &used) == 1 && (at[used] == '_' || at[used] == 'u') &&
            number < effect_count)
            return number;
    }
    return PLR_NO_EFFECT;
}

/* The column of the word that the message is about: its own, or one that the text quotes. */
static uint32_t column_in_words(const plr_report *report, const plr_glsl_message *message) {
    uint32_t column = 0;
    if (message->word)
        column = plr_program_find_word(report->program, report->stage, message->line, message->word,
                                       strlen(message->word));
    const char *quote = strchr(message->text, '"');
    const char *end = quote ? strchr(quote + 1, '"') : NULL;
    if (!column && end)
        column = plr_program_find_word(report->program, report->stage, message->line, quote + 1,
                                       (size_t)(end - quote - 1));
    return column;
}

size_t plr_report_locate(const plr_report *report, const plr_glsl_message *message,
                         plr_mapped *mapped) {
    *mapped = (plr_mapped){.effect = PLR_NO_EFFECT};
    size_t effect_count = report->recipe->effects.count;
    if (report->stage == PLR_STAGE_COUNT || !message->line) {
        size_t effect = effect_in_words(message->text, effect_count);
        if (effect != PLR_NO_EFFECT)
            mapped->place = report->recipe->effects.items[effect].place;
        return mapped->effect = effect;
    }
    uint32_t column = message->column ? message->column : column_in_words(report, message);
    if (!plr_program_map(report->program, report->stage, message->line, column, mapped))
        return PLR_NO_EFFECT;
    if (mapped->effect == PLR_NO_EFFECT && !mapped->place.file)
        mapped->effect = effect_in_words(message->text, effect_count);
    return mapped->effect;
}

void plr_report_add(const plr_report *report, const plr_glsl_message *message, plr_diags *diags) {
    plr_mapped mapped;
    size_t effect = plr_report_locate(report, message, &mapped);
    char text[1024];
    plr_program_demangle(report->program, message->text, text, sizeof text);
    plr_diags_add_as(diags, message->severity, report->code, mapped.place, "%s", text);
    const char *name = effect == PLR_NO_EFFECT ? NULL : report->recipe->effects.items[effect].name;
    if (mapped.socket_call)
        plr_diags_note(diags, mapped.plug_place, "called at this plug%s%s", name ? " for " : "",
                       name ? name : "");
}

/* Old names of plugs, which the base still offers. */
static const struct {
    const char *old, *today;
} deprecated[] = {{"texture_apply", "main_texture_apply"}};

static void warn_callers(const plr_recipe *recipe, const plr_program *program, size_t plug,
                         const char *today, plr_diags *diags) {
    const plr_plug_info *info = plr_program_plug(program, plug);
    for (size_t call = 0; call < info->call_count; call++) {
        plr_place place;
        size_t effect = plr_program_plug_call(program, plug, call, &place);
        if (effect != PLR_NO_EFFECT && !recipe->effects.items[effect].builtin)
            plr_diags_add(diags, PLR_CODE_DEPRECATED_PLUG, place,
                          "the plug \"%s\" is called \"%s\" today", info->name, today);
    }
}

void plr_report_deprecated(const plr_recipe *recipe, const plr_program *program, plr_diags *diags) {
    if (recipe->base_node) /* the author's own plugs */
        return;
    for (size_t i = 0; i < plr_program_plug_count(program); i++) {
        const plr_plug_info *info = plr_program_plug(program, i);
        for (size_t d = 0; d < sizeof deprecated / sizeof *deprecated; d++)
            if (info->effect == PLR_NO_EFFECT && strcmp(info->name, deprecated[d].old) == 0)
                warn_callers(recipe, program, i, deprecated[d].today, diags);
    }
}
