#include "tools/plugray/listing.h"

const char *effect_label(const plr_effect *effects, size_t index, char buffer[32]) {
    if (index == PLR_NO_EFFECT)
        return "-";
    if (effects[index].name)
        return effects[index].name;
    snprintf(buffer, 32, "effect %zu", index + 1);
    return buffer;
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
