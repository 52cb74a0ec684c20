/* plugray check: every problem that shows without drawing. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/plugray/commands.h"
#include "tools/plugray/files.h"
#include "tools/plugray/progress.h"
#include "tools/plugray/scene.h"

enum {
    TEXT,
    JSON,
    SARIF
}; /* in the order of the option's words */

static int check_scene(tool_scene *scene, const tool_arguments *arguments, const char *path) {
    int status = tool_scene_open(scene, arguments, path);
    if (status != STATUS_FINE || !scene->scene)
        return status;
    progress("linking");
    plr_view *view = plr_view_create(NULL, scene->scene, &scene->view, scene->diags);
    status = view ? STATUS_FINE : tool_view_failure(scene);
    plr_view_destroy(&view);
    return status;
}

static void write_reports(int format, const tool_report *reports, size_t count) {
    if (format == JSON)
        report_json(stdout, reports, count);
    else if (format == SARIF)
        report_sarif(stdout, reports, count);
    else
        for (size_t i = 0; i < count; i++)
            report_text(stderr, &reports[i]);
}

int command_check(const tool_arguments *arguments) {
    const char *text = option_value(arguments, OPTION_FORMAT);
    int format = text ? word_index(option_words(OPTION_FORMAT), text) : TEXT;
    if (format < 0)
        return usage_error(arguments, "--format takes %s, not '%s'", option_words(OPTION_FORMAT),
                           text);
    bool strict = option_value(arguments, OPTION_STRICT) != NULL;
    size_t count = arguments->operand_count, opened = 0;
    tool_scene *scenes = memory_array(NULL, count, sizeof *scenes);
    tool_report *reports = memory_array(NULL, count, sizeof *reports);
    int status = STATUS_FINE;
    while (opened < count && status != STATUS_USAGE) {
        int one = check_scene(&scenes[opened], arguments, arguments->operands[opened]);
        reports[opened] = tool_scene_report(&scenes[opened]);
        if (one == STATUS_FINE)
            one = report_status(scenes[opened].diags, strict);
        status = one > status ? one : status;
        opened++;
    }
    progress(NULL);
    if (status != STATUS_USAGE)
        write_reports(format, reports, opened);
    for (size_t i = 0; i < opened; i++)
        tool_scene_close(&scenes[i]);
    free(scenes);
    free(reports);
    return status;
}
