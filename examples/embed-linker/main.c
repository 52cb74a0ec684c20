/* Links two effects into a base shader and prints the program:  embed-linker BASE EFFECT EFFECT */
#include <plugray/plugs.h>
#include <stdio.h>

static plr_source *read_source(const char *path, plr_diags *diags) {
    static char text[1 << 20];
    FILE *file = fopen(path, "rb");
    size_t length = file ? fread(text, 1, sizeof text, file) : 0;
    plr_origin origin = {.file = path};
    if (file)
        fclose(file);
    return plr_source_read(PLR_FRAGMENT, text, length, &origin, NULL, diags);
}

int main(int argc, char **argv) {
    if (argc != 4)
        return 2;
    plr_diags *diags = plr_diags_create(NULL);
    plr_source *sources[3];
    for (int i = 0; i < 3; i++)
        sources[i] = read_source(argv[i + 1], diags);
    const plr_source *units[] = {sources[0], sources[1], sources[2]};
    plr_effect effects[] = {{.name = argv[2], .sources = &units[1], .source_count = 1},
                            {.name = argv[3], .sources = &units[2], .source_count = 1}};
    plr_link_desc desc = {.base = units, .base_count = 1, .effects = effects, .effect_count = 2};
    plr_program *program = plr_link(&desc, diags);
    if (program)
        fputs(plr_program_text(program, PLR_FRAGMENT, NULL), stdout);
    for (size_t i = 0; i < plr_diags_count(diags); i++) {
        const plr_diag *diag = plr_diags_get(diags, i);
        fprintf(stderr, "%s:%u: %s\n", diag->place.file, diag->place.line, diag->message);
    }
    int status = plr_diags_count_of(diags, PLR_ERROR) > 0;
    plr_program_destroy(&program);
    for (int i = 0; i < 3; i++)
        plr_source_destroy(&sources[i]);
    plr_diags_destroy(&diags);
    return status;
}
