#include "tools/plugray/units.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tools/plugray/files.h"
#include "tools/plugray/report.h"

enum {
    MAX_FILE = 64 << 20
};

plr_stage stage_of_path(const char *path) {
    static const struct {
        const char *ending;
        plr_stage stage;
    } endings[] = {{".vert", PLR_VERTEX}, {".vs", PLR_VERTEX},     {".geom", PLR_GEOMETRY},
                   {".gs", PLR_GEOMETRY}, {".frag", PLR_FRAGMENT}, {".fs", PLR_FRAGMENT}};
    size_t length = strlen(path);
    if (length > 5 && strcmp(path + length - 5, ".glsl") == 0)
        length -= 5;
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        size_t size = strlen(endings[i].ending);
        if (length > size && strncmp(path + length - size, endings[i].ending, size) == 0)
            return endings[i].stage;
    }
    return PLR_STAGE_COUNT;
}

static void add_source(unit_group *group, char *path, const plr_source *source) {
    group->sources = memory_array(group->sources, group->count + 1, sizeof *group->sources);
    group->paths = memory_array(group->paths, group->count + 1, sizeof *group->paths);
    group->sources[group->count] = source;
    group->paths[group->count++] = path;
}

static bool read_unit(unit_group *group, char *path, plr_stage otherwise, plr_diags *diags) {
    size_t length;
    char *text = file_read(path, MAX_FILE, &length, diags);
    plr_source *source = NULL;
    if (text) {
        plr_stage stage = stage_of_path(path);
        plr_origin origin = {.file = path};
        source = plr_source_read(stage == PLR_STAGE_COUNT ? otherwise : stage, text, length,
                                 &origin, NULL, diags);
        free(text);
    }
    if (!source) {
        free(path);
        return false;
    }
    add_source(group, path, source);
    return true;
}

bool unit_group_read(unit_group *group, const char *word, plr_stage otherwise, plr_diags *diags) {
    *group = (unit_group){.word = word};
    if (access(word, F_OK) == 0 || strcmp(word, "-") == 0)
        return read_unit(group, text_format("%s", word), otherwise, diags);
    bool all = true;
    for (const char *part = word;;) {
        size_t length = strcspn(part, "+");
        all = read_unit(group, text_format("%.*s", (int)length, part), otherwise, diags) && all;
        if (!part[length])
            return all;
        part += length + 1;
    }
}

void unit_group_free(unit_group *group) {
    for (size_t i = 0; i < group->count; i++) {
        plr_source *source = (plr_source *)group->sources[i];
        plr_source_destroy(&source);
        free(group->paths[i]);
    }
    free(group->sources);
    free(group->paths);
}

const char *unit_group_line(const unit_group *group, const char *file, uint32_t line,
                            size_t *length) {
    for (size_t i = 0; i < group->count; i++) {
        if (strcmp(group->paths[i], file) != 0)
            continue;
        size_t size;
        const char *text = plr_source_text(group->sources[i], &size);
        return text_line(text, size, line, length);
    }
    return NULL;
}
