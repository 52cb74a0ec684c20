#include "tools/plugray/stats.h"

#include "tools/plugray/json.h"

enum {
    PHASE_COUNT = 5
};
static const char *const phase_names[PHASE_COUNT] = {"load", "link", "compile", "upload", "draw"};

static plr_view_stats get_phases(const render_stats *stats, plr_phase phases[PHASE_COUNT]) {
    plr_view_stats view;
    plr_view_get_stats(stats->view, &view);
    /* the scene's own files, then what it refers to */
    phases[0] =
        (plr_phase){stats->load.cpu_ms + view.load.cpu_ms, stats->load.wall_ms + view.load.wall_ms};
    phases[1] = view.link;
    phases[2] = view.compile;
    phases[3] = view.upload;
    phases[4] = stats->draw;
    return view;
}

void stats_text(FILE *out, const render_stats *stats) {
    plr_phase phases[PHASE_COUNT];
    plr_view_stats view = get_phases(stats, phases);
    for (int i = 0; i < PHASE_COUNT; i++)
        fprintf(out, "%-8s %10.3f ms, %10.3f ms of processors\n", phase_names[i], phases[i].wall_ms,
                phases[i].cpu_ms);
    fprintf(out, "%-8s %10.0f\n", "samples", view.samples);
    for (size_t i = 0; i < plr_view_program_count(stats->view); i++) {
        const plr_program_info *info = plr_view_program(stats->view, i);
        fprintf(out, "%s: %u instructions, %u fetches\n", info->name, info->instructions,
                info->fetches);
    }
}

static void print_or_null(FILE *out, bool known, double value) {
    if (known)
        json_number(out, value);
    else
        fputs("null", out);
}

const char *method_name(plr_method method) {
    static const char *const names[] = {"auto", "midpoint", "preintegrated", "cells"};
    return names[method];
}

void stats_json(FILE *out, const render_stats *stats) {
    plr_phase phases[PHASE_COUNT];
    plr_view_stats view = get_phases(stats, phases);
    fputs("{\n  \"phases\": {", out);
    for (int i = 0; i < PHASE_COUNT; i++) {
        fprintf(out, "%s\n    \"%s\": {\"cpu_ms\": ", i ? "," : "", phase_names[i]);
        json_number(out, phases[i].cpu_ms);
        fputs(", \"wall_ms\": ", out);
        json_number(out, phases[i].wall_ms);
        putc('}', out);
    }
    fputs("\n  },\n  \"samples\": ", out);
    fprintf(out, "%.0f,\n  \"programs\": [", view.samples);
    for (size_t i = 0; i < plr_view_program_count(stats->view); i++) {
        const plr_program_info *info = plr_view_program(stats->view, i);
        fprintf(out, "%s\n    {\"name\": ", i ? "," : "");
        json_string(out, info->name);
        fprintf(out, ", \"instructions\": %u, \"fetches\": %u}", info->instructions, info->fetches);
    }
    plr_plan plan;
    plr_view_get_plan(stats->view, &plan);
    fputs("\n  ],\n  \"error\": {\"asked\": ", out);
    print_or_null(out, plan.asked > 0, plan.asked);
    fprintf(out, ", \"kind\": \"%s\", \"value\": ", plan.bounded ? "bounded" : "estimated");
    print_or_null(out, plan.value >= 0, plan.value);
    fprintf(out, "},\n  \"plan\": {\"method\": \"%s\", \"step\": ", method_name(plan.method));
    json_number(out, plan.step);
    fprintf(out, ", \"leaps\": %s, \"why\": ", plan.leaps ? "true" : "false");
    json_string(out, plan.why);
    if (view.pilots.wall_ms > 0) {
        fputs(", \"pilots\": {\"cpu_ms\": ", out);
        json_number(out, view.pilots.cpu_ms);
        fputs(", \"wall_ms\": ", out);
        json_number(out, view.pilots.wall_ms);
        putc('}', out);
    }
    fputs("}\n}\n", out);
}
