/* plugray: the command line program. */
#include <stdio.h>
#include <string.h>

#include "tools/plugray/commands.h"

static int (*const runners[COMMAND_COUNT])(const tool_arguments *) = {
    [COMMAND_RENDER] = command_render, [COMMAND_LINK] = command_link,
    [COMMAND_DUMP] = command_dump,     [COMMAND_CHECK] = command_check,
    [COMMAND_PLUGS] = command_plugs,   [COMMAND_INFO] = command_info,
    [COMMAND_CHART] = command_chart,
};

int main(int argc, char **argv) {
    if (argc == 2 && strcmp(argv[1], "--list-options") == 0) { /* for completions and tests */
        options_list();
        return STATUS_FINE;
    }
    tool_arguments arguments;
    int status;
    if (arguments_read(&arguments, argc, argv, &status))
        status = runners[arguments.command](&arguments);
    arguments_free(&arguments);
    if (fflush(stdout) != 0 || ferror(stdout)) {
        fputs("plugray: standard output cannot be written\n", stderr);
        status = STATUS_MACHINE;
    }
    return status;
}
