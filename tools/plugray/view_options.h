/* What the command line says of how a scene is looked at and where it is drawn: for each command
 * that draws. */
#ifndef PLUGRAY_TOOL_VIEW_OPTIONS_H
#define PLUGRAY_TOOL_VIEW_OPTIONS_H

#include <plugray/engine.h>

#include "tools/plugray/options.h"

enum {
    MAX_SIDE = 16384 /* of a picture, in pixels */
};

typedef struct view_options {
    int width, height; /* of the pictures; before reading: what they are if --size is not given */
    const char *viewpoint;
    double time;
    plr_backend backend;
    bool cached; /* compiled programs are kept on disk */
} view_options;

/* Reads --size, --viewpoint, --time, --backend and --no-cache. False after a usage error. */
bool view_options_read(const tool_arguments *arguments, view_options *options);
/* Writes to a view's description what they say. */
void view_options_apply(const view_options *options, plr_view_desc *desc);

/* A GL context and an engine in it. */
typedef struct tool_machine {
    plr_context *context;
    plr_engine *engine;
} tool_machine;

/* Returns STATUS_FINE, or STATUS_MACHINE with an error. */
int tool_machine_open(tool_machine *machine, const view_options *options, plr_diags *diags);
void tool_machine_close(tool_machine *machine);

#endif
