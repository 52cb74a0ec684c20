/* GLSL files of `plugray link`: read, given a stage by their endings, grouped as effects. */
#ifndef PLUGRAY_TOOL_UNITS_H
#define PLUGRAY_TOOL_UNITS_H

#include <plugray/plugs.h>

/* One word of the command line: a unit, or several joined by "+". */
typedef struct unit_group {
    const char *word;
    const plr_source **sources;
    char **paths; /* one a source */
    size_t count;
} unit_group;

/* The stage that a file's ending tells (.vert .vs .geom .gs .frag .fs, before .glsl too), or
 * PLR_STAGE_COUNT. */
plr_stage stage_of_path(const char *path);

/* Reads the units of a word; `otherwise`: their stage where the ending tells none. False if a file
 * cannot be read (reported); what could be read is there. */
bool unit_group_read(unit_group *group, const char *word, plr_stage otherwise, plr_diags *diags);
void unit_group_free(unit_group *group);

/* A line of a unit's file, for messages. */
const char *unit_group_line(const unit_group *group, const char *file, uint32_t line,
                            size_t *length);

#endif
