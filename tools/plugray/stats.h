/* What drawing took, for people and as JSON. */
#ifndef PLUGRAY_TOOL_STATS_H
#define PLUGRAY_TOOL_STATS_H

#include <stdio.h>

#include <plugray/engine.h>

typedef struct render_stats {
    const plr_view *view;
    plr_phase load, draw; /* draw: the median of the repeats */
} render_stats;

void stats_text(FILE *out, const render_stats *stats);
/* One object: phases {load, link, compile, upload, draw} each {cpu_ms, wall_ms}, samples, programs
 * [{name, instructions, fetches}], error {asked, kind, value}, plan {method, step, leaps, why}. */
void stats_json(FILE *out, const render_stats *stats);

/* As --method has it. */
const char *method_name(plr_method method);

#endif
