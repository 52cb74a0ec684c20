#include "tools/plugray/listing.h"

#include <string.h>

#include "tools/plugray/json.h"
#include "tools/plugray/report.h"

const char *effect_label(const plr_effect *effects, size_t index, char buffer[32]) {
    if (index == PLR_NO_EFFECT)
        return "-";
    if (effects[index].name)
        return effects[index].name;
    snprintf(buffer, 32, "effect %zu", index + 1);
    return buffer;
}

void print_plain(const char *text) {
    report_plain(stdout, text, strlen(text));
}

void print_place(plr_place place) {
    if (!place.file) {
        putchar('-');
        return;
    }
    print_plain(place.file);
    printf(":%u:%u", place.line, place.column);
}

void write_place(plr_place place) {
    fputs("{\"file\": ", stdout);
    json_string(stdout, place.file);
    printf(", \"line\": %u, \"column\": %u}", place.line, place.column);
}

void print_plug(const plr_program *program, size_t index, const plr_effect *effects) {
    char buffer[32];
    const plr_plug_info *plug = plr_program_plug(program, index);
    printf("%s ", plug->name);
    print_plain(plug->parameters);
    printf(" %s\n    offered by ", plr_stage_text(plug->stage));
    print_plain(plug->effect == PLR_NO_EFFECT ? "the base"
                                              : effect_label(effects, plug->effect, buffer));
    fputs(" at ", stdout);
    print_place(plug->place);
    putchar('\n');
    for (size_t call = 0; call < plug->call_count; call++) {
        plr_place function;
        size_t user = plr_program_plug_call(program, index, call, &function);
        fputs("    used by ", stdout);
        print_plain(effect_label(effects, user, buffer));
        fputs(" at ", stdout);
        print_place(function);
        putchar('\n');
    }
}

void write_map(FILE *out, const plr_program *program, plr_stage stage, const plr_effect *effects) {
    char buffer[32];
    for (uint32_t line = 1; line <= plr_program_lines(program, stage); line++) {
        plr_mapped mapped;
        if (plr_program_map(program, stage, line, 0, &mapped) && mapped.place.file)
            fprintf(out, "%u\t%s:%u:%u\t%s\n", line, mapped.place.file, mapped.place.line,
                    mapped.place.column, effect_label(effects, mapped.effect, buffer));
        else
            fprintf(out, "%u\t-:0:0\t-\n", line);
    }
}
