/* plugray dump: the programs of a scene as files. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/plugray/commands.h"
#include "tools/plugray/files.h"
#include "tools/plugray/listing.h"
#include "tools/plugray/scene.h"

static void dump_stage(const plr_program_info *info, plr_stage stage, const char *folder,
                       plr_diags *diags) {
    static const char *const endings[PLR_STAGE_COUNT] = {"vert", "geom", "frag"};
    size_t length;
    const char *text = plr_program_text(info->program, stage, &length);
    if (!text)
        return;
    char *path = text_format("%s/%s.%s", folder, info->name, endings[stage]);
    char *map = text_format("%s.map", path);
    output_file file;
    if (output_open(&file, path, diags)) {
        fwrite(text, 1, length, file.stream);
        output_close(&file, diags);
    }
    if (output_open(&file, map, diags)) {
        write_map(file.stream, info->program, stage, info->effects);
        output_close(&file, diags);
    }
    free(map);
    free(path);
}

int command_dump(const tool_arguments *arguments) {
    const char *folder = option_value(arguments, OPTION_FOLDER);
    if (!folder)
        return usage_error(arguments, "-d DIR is missing");
    tool_scene scene;
    plr_view *view;
    int status = tool_scene_view(&scene, arguments, &view);
    if (view) {
        if (folder_make(folder, scene.diags))
            for (size_t i = 0; i < plr_view_program_count(view); i++)
                for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
                    dump_stage(plr_view_program(view, i), (plr_stage)stage, folder, scene.diags);
        status = tool_scene_finish(&scene);
        plr_view_destroy(&view);
    }
    tool_scene_close(&scene);
    return status;
}
