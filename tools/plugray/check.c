/* plugray check: every problem that shows without drawing. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/plugray/commands.h"
#include "tools/plugray/files.h"
#include "tools/plugray/progress.h"
#include "tools/plugray/scene.h"
#include "tools/plugray/view_options.h"

enum {
    TEXT,
    JSON,
    SARIF
}; /* in the order of the option's words */

/* Has the promises of effects tried, where there is GL. What is wrong otherwise was told. */
static int check_promises(tool_scene *scene, const view_options *options) {
    tool_machine machine;
    progress("trying promises");
    int status = tool_machine_open(&machine, options, scene->diags);
    if (status == STATUS_FINE) {
        plr_view_desc desc = scene->view;
        desc.step = 1; /* nothing is drawn: no tables are needed */
        plr_view *view = plr_view_create(machine.engine, scene->scene, &desc, NULL);
        if (!view || !plr_view_check_promises(view, scene->diags))
            status = STATUS_MACHINE;
        plr_view_destroy(&view);
    }
    tool_machine_close(&machine);
    return status;
}

static int check_scene(tool_scene *scene, const tool_arguments *arguments, const char *path,
                       const view_options *trust) {
    int status = tool_scene_open(scene, arguments, path);
    if (status != STATUS_FINE || !scene->scene)
        return status;
    progress("linking");
    plr_view *view = plr_view_create(NULL, scene->scene, &scene->view, scene->diags);
    status = view ? STATUS_FINE : tool_view_failure(scene);
    plr_view_destroy(&view);
    if (status == STATUS_FINE && trust)
        status = check_promises(scene, trust);
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
    bool trusts = option_value(arguments, OPTION_TRUST) != NULL;
    view_options options = {.width = 640, .height = 480};
    if (!view_options_read(arguments, &options))
        return STATUS_USAGE;
    size_t count = arguments->operand_count, opened = 0;
    tool_scene *scenes = memory_array(NULL, count, sizeof *scenes);
    tool_report *reports = memory_array(NULL, count, sizeof *reports);
    int status = STATUS_FINE;
    while (opened < count && status != STATUS_USAGE) {
        int one = check_scene(&scenes[opened], arguments, arguments->operands[opened],
                              trusts ? &options : NULL);
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
