/* plugray plugs: what a scene's programs call, plug by plug; or the plugs that plugray brings. */
#include "tools/plugray/commands.h"
#include "tools/plugray/listing.h"
#include "tools/plugray/plugs_chain.h"
#include "tools/plugray/plugs_own.h"
#include "tools/plugray/progress.h"
#include "tools/plugray/scene.h"

enum {
    TEXT,
    JSON,
    MARKDOWN
}; /* in the order of the option's words */

/* The plugs of each program, called or not: who offers them, who uses them. */
static void print_programs(const plr_view *view) {
    for (size_t i = 0; i < plr_view_program_count(view); i++) {
        const plr_program_info *info = plr_view_program(view, i);
        printf("\n%s:\n", info->name);
        for (size_t j = 0; j < plr_program_plug_count(info->program); j++)
            print_plug(info->program, j, info->effects);
    }
}

static int list_scene(const tool_arguments *arguments, int format) {
    tool_scene scene;
    plr_view *view;
    int status = tool_scene_view(&scene, arguments, &view);
    if (view) {
        progress(NULL);
        if (format == JSON) {
            write_chains(view);
        } else {
            print_chains(view);
            print_programs(view);
        }
        status = tool_scene_finish(&scene);
        plr_view_destroy(&view);
    }
    tool_scene_close(&scene);
    return status;
}

int command_plugs(const tool_arguments *arguments) {
    const char *text = option_value(arguments, OPTION_PLUGS_FORMAT);
    int format = text ? word_index(option_words(OPTION_PLUGS_FORMAT), text) : TEXT;
    if (format < 0)
        return usage_error(arguments, "--format takes %s, not '%s'",
                           option_words(OPTION_PLUGS_FORMAT), text);
    if (arguments->operand_count && format == MARKDOWN)
        return usage_error(arguments,
                           "--format markdown is for plugray's own plugs, not a scene's");
    if (arguments->operand_count)
        return list_scene(arguments, format);
    if (format == TEXT)
        return print_own_plugs();
    (format == JSON ? write_own_plugs : write_own_tables)();
    return STATUS_FINE;
}
