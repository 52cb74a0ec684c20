/* A scene as the command line names it: read, changed by --set, told about. */
#ifndef PLUGRAY_TOOL_SCENE_H
#define PLUGRAY_TOOL_SCENE_H

#include <plugray/engine.h>
#include "tools/plugray/options.h"
#include "tools/plugray/report.h"

typedef struct tool_scene {
    plr_scene *scene; /* NULL: could not be read */
    plr_diags *diags;
    plr_view_desc view; /* what the options say of it */
    plr_phase load;     /* the time that reading took */
    const char **allowed;
    const char *set; /* the --set that is being carried out */
} tool_scene;

/* Reads the scene at `path` ("-": standard input) as the options say. Returns STATUS_FINE even if
 * the scene has errors or cannot be read at all; else the status to end with. */
int tool_scene_open(tool_scene *scene, const tool_arguments *arguments, const char *path);
/* Frees; the views must be gone. */
void tool_scene_close(tool_scene *scene);

/* What there is to say, for report_*; valid while the scene is. */
tool_report tool_scene_report(const tool_scene *scene);
/* Writes the diagnostics to standard error; returns the exit status that they call for. */
int tool_scene_finish(tool_scene *scene);

/* Opens the only operand and makes a view without GL; *view may be NULL: then end with the status.
 */
int tool_scene_view(tool_scene *scene, const tool_arguments *arguments, plr_view **view);

/* The status where a view cannot be had: no memory, or a viewpoint that is not there. */
int tool_view_failure(const tool_scene *scene);

#endif
