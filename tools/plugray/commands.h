/* The commands: each returns the exit status. */
#ifndef PLUGRAY_TOOL_COMMANDS_H
#define PLUGRAY_TOOL_COMMANDS_H

#include "tools/plugray/options.h"

int command_render(const tool_arguments *arguments);
int command_link(const tool_arguments *arguments);
int command_dump(const tool_arguments *arguments);
int command_check(const tool_arguments *arguments);
int command_plugs(const tool_arguments *arguments);
int command_info(const tool_arguments *arguments);
int command_chart(const tool_arguments *arguments);

#endif
