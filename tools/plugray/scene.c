#include "tools/plugray/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/compose.h"
#include "tools/plugray/files.h"
#include "tools/plugray/progress.h"

enum {
    MAX_SCENE = 1 << 30
};

static void read_scene(tool_scene *s, const tool_arguments *arguments, const char *path) {
    size_t count = 0, next = 0;
    for (const char *folder; (folder = option_next(arguments, OPTION_ALLOW, &next)); count++) {
        s->allowed = memory_array(s->allowed, count + 1, sizeof *s->allowed);
        s->allowed[count] = folder;
    }
    plr_read_desc desc = {
        .rules = {.allowed = s->allowed,
                  .allowed_count = count,
                  .allow_network = option_value(arguments, OPTION_ALLOW_NETWORK) != NULL,
                  .progress = progress_of_file}};
    if (desc.rules.allow_network)
        plr_diags_add_as(s->diags, PLR_WARNING, PLR_CODE_NOT_ALLOWED, (plr_place){NULL, 0, 0},
                         "--allow-network: this version has no way to read over the network");
    plr_phase start = plr_clock();
    progress("reading");
    if (strcmp(path, "-") == 0) {
        size_t length;
        char *text = file_read(path, MAX_SCENE, &length, s->diags);
        if (text)
            s->scene = plr_scene_parse(text, length, path, &desc, s->diags);
        free(text);
    } else {
        s->scene = plr_scene_read(path, &desc, s->diags);
    }
    plr_phase end = plr_clock();
    s->load = (plr_phase){end.cpu_ms - start.cpu_ms, end.wall_ms - start.wall_ms};
}

/* DEF.field=VALUE */
static int set_field(tool_scene *s, const tool_arguments *arguments, const char *text) {
    const char *dot = strchr(text, '.'), *equals = dot ? strchr(dot, '=') : NULL;
    if (!equals || dot == text || equals == dot + 1)
        return usage_error(arguments, "--set takes DEF.field=VALUE, not '%s'", text);
    char *def = text_format("%.*s", (int)(dot - text), text);
    char *field = text_format("%.*s", (int)(equals - dot - 1), dot + 1);
    plr_node *node = plr_scene_find(s->scene, def);
    int status = STATUS_FINE;
    if (!node) {
        status = usage_error(arguments, "--set: no node has the DEF name %s", def);
    } else if (!plr_node_field(node, field)) {
        status = usage_error(arguments, "--set: %s (%s) has no field %s", def, plr_node_type(node),
                             field);
    } else {
        s->set = text;
        plr_place place = {"--set", 1, (uint32_t)(equals - text) + 2};
        if (!plr_node_set_text(s->scene, node, field, equals + 1, place, s->diags))
            status = STATUS_USAGE;
    }
    free(def);
    free(field);
    return status;
}

static int read_dialect(tool_scene *s, const tool_arguments *arguments) {
    static const int dialects[] = {2005, 1}; /* in the order of the option's words */
    const char *text = option_value(arguments, OPTION_SCENE_DIALECT);
    int index = text ? word_index(option_words(OPTION_SCENE_DIALECT), text) : -1;
    if (text && index < 0)
        return usage_error(arguments, "--dialect takes %s, not '%s'",
                           option_words(OPTION_SCENE_DIALECT), text);
    s->view.dialect = text ? dialects[index] : 0;
    return STATUS_FINE;
}

int tool_scene_open(tool_scene *s, const tool_arguments *arguments, const char *path) {
    memset(s, 0, sizeof *s);
    int status = read_dialect(s, arguments);
    if (status != STATUS_FINE)
        return status;
    s->diags = plr_diags_create(NULL);
    if (!s->diags)
        return STATUS_MACHINE;
    read_scene(s, arguments, path);
    const char *text;
    for (size_t next = 0;
         s->scene && status == STATUS_FINE && (text = option_next(arguments, OPTION_SET, &next));)
        status = set_field(s, arguments, text);
    if (status != STATUS_FINE)
        tool_scene_finish(s);
    return status;
}

void tool_scene_close(tool_scene *s) {
    plr_scene_destroy(&s->scene);
    plr_diags_destroy(&s->diags);
    free(s->allowed);
}

static const char *scene_line(const void *user, const char *file, uint32_t line, size_t *length) {
    const tool_scene *s = user;
    if (s->set && strcmp(file, "--set") == 0)
        return text_line(s->set, strlen(s->set), line, length);
    return s->scene ? plr_scene_line(s->scene, file, line, length) : NULL;
}

tool_report tool_scene_report(const tool_scene *s) {
    return (tool_report){s->diags, scene_line, s};
}

int tool_scene_finish(tool_scene *s) {
    progress(NULL);
    fflush(stdout);
    tool_report report = tool_scene_report(s);
    report_text(stderr, &report);
    return report_status(s->diags, false);
}

int tool_view_failure(const tool_scene *s) {
    for (size_t i = 0; i < plr_diags_count(s->diags); i++)
        if (plr_diags_get(s->diags, i)->code == PLR_CODE_NO_MEMORY)
            return STATUS_MACHINE;
    return STATUS_USAGE;
}

int tool_scene_view(tool_scene *s, const tool_arguments *arguments, plr_view **view) {
    *view = NULL;
    int status = tool_scene_open(s, arguments, arguments->operands[0]);
    if (status != STATUS_FINE)
        return status;
    if (!s->scene)
        return tool_scene_finish(s);
    progress("linking");
    *view = plr_view_create(NULL, s->scene, &s->view, s->diags);
    if (*view)
        return STATUS_FINE;
    tool_scene_finish(s);
    return tool_view_failure(s);
}
