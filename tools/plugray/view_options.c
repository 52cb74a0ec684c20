#include "tools/plugray/view_options.h"

#include <stdlib.h>

static bool read_size(const tool_arguments *arguments, view_options *options) {
    const char *size = option_value(arguments, OPTION_SIZE);
    long pair[2];
    if (!size)
        return true;
    if (!read_pair(size, 'x', 1, MAX_SIDE, pair)) {
        usage_error(arguments, "--size takes WxH in pixels from 1 to %d, not '%s'", MAX_SIDE, size);
        return false;
    }
    options->width = (int)pair[0];
    options->height = (int)pair[1];
    return true;
}

static bool read_backend(const tool_arguments *arguments, view_options *options) {
    const char *text = option_value(arguments, OPTION_BACKEND);
    int index = text ? word_index(option_words(OPTION_BACKEND), text) : PLR_BACKEND_AUTO;
    if (index < 0) {
        usage_error(arguments, "--backend takes %s, not '%s'", option_words(OPTION_BACKEND), text);
        return false;
    }
    options->backend = (plr_backend)index;
    return true;
}

static bool read_time(const tool_arguments *arguments, view_options *options) {
    const char *text = option_value(arguments, OPTION_TIME);
    if (!text)
        return true;
    char *after;
    options->time = strtod(text, &after);
    if (after > text && !*after && options->time >= 0 && options->time <= 1e9)
        return true;
    usage_error(arguments, "--time takes seconds from 0 to 1e9, not '%s'", text);
    return false;
}

bool view_options_read(const tool_arguments *arguments, view_options *options) {
    options->viewpoint = option_value(arguments, OPTION_VIEWPOINT);
    options->cached = !option_value(arguments, OPTION_NO_CACHE);
    return read_size(arguments, options) && read_backend(arguments, options) &&
           read_time(arguments, options);
}

void view_options_apply(const view_options *options, plr_view_desc *desc) {
    desc->viewpoint = options->viewpoint;
    desc->time = options->time;
    desc->aspect = (double)options->width / options->height;
}

int tool_machine_open(tool_machine *machine, const view_options *options, plr_diags *diags) {
    char folder[4096];
    bool cached = options->cached && plr_engine_default_cache(folder, sizeof folder);
    *machine = (tool_machine){.context = plr_context_create(options->backend, diags)};
    if (!machine->context)
        return STATUS_MACHINE;
    plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address,
                            .user = machine->context,
                            .cache_folder = cached ? folder : NULL};
    machine->engine = plr_engine_create(&desc, diags);
    return machine->engine ? STATUS_FINE : STATUS_MACHINE;
}

void tool_machine_close(tool_machine *machine) {
    if (machine->engine)
        plr_engine_destroy(&machine->engine);
    if (machine->context)
        plr_context_destroy(&machine->context);
}
