/* plugray plugs: every plug of a scene, or of the shaders that plugray brings. */
#include <stdio.h>
#include <string.h>

#include "engine/catalog.h"
#include "tools/plugray/commands.h"
#include "tools/plugray/listing.h"
#include "tools/plugray/progress.h"
#include "tools/plugray/scene.h"

static void print_place(plr_place place) {
    if (place.file)
        printf("%s:%u:%u", place.file, place.line, place.column);
    else
        putchar('-');
}

/* A plug: its name, argument lists and stage; then who offers it and whose functions are called. */
static void print_plug(const plr_program *program, size_t index, const plr_effect *effects) {
    char buffer[32];
    const plr_plug_info *plug = plr_program_plug(program, index);
    printf("%s %s %s\n", plug->name, plug->parameters, plr_stage_text(plug->stage));
    printf("    offered by %s at ", plug->effect == PLR_NO_EFFECT
                                        ? "the base"
                                        : effect_label(effects, plug->effect, buffer));
    print_place(plug->place);
    putchar('\n');
    for (size_t call = 0; call < plug->call_count; call++) {
        plr_place function;
        size_t user = plr_program_plug_call(program, index, call, &function);
        printf("    used by %s at ", effect_label(effects, user, buffer));
        print_place(function);
        putchar('\n');
    }
}

static int list_scene(const tool_arguments *arguments) {
    tool_scene scene;
    plr_view *view;
    int status = tool_scene_view(&scene, arguments, &view);
    if (view) {
        progress(NULL);
        for (size_t i = 0; i < plr_view_program_count(view); i++) {
            const plr_program_info *info = plr_view_program(view, i);
            printf("%s%s:\n", i ? "\n" : "", info->name);
            for (size_t j = 0; j < plr_program_plug_count(info->program); j++)
                print_plug(info->program, j, info->effects);
        }
        status = tool_scene_finish(&scene);
        plr_view_destroy(&view);
    }
    tool_scene_close(&scene);
    return status;
}

/* The units of one base, alone or with one effect that plugray brings, and the plugs that the last
 * of them offers. */
static void list_offers(const plr_catalog *catalog, const plr_sources *base, const char *name) {
    const plr_sources *units = name ? plr_catalog_units(catalog, name) : NULL;
    plr_effect effect = {.name = name, .builtin = true};
    if (units) {
        effect.sources = units->items;
        effect.source_count = units->count;
    }
    plr_link_desc desc = {.base = base->items,
                          .base_count = base->count,
                          .library = plr_catalog_library(catalog)->items,
                          .library_count = plr_catalog_library(catalog)->count,
                          .effects = &effect,
                          .effect_count = units ? 1 : 0};
    plr_program *program = plr_link(&desc, NULL);
    for (size_t i = 0; program && i < plr_program_plug_count(program); i++)
        if (!units == (plr_program_plug(program, i)->effect == PLR_NO_EFFECT))
            print_plug(program, i, &effect);
    plr_program_destroy(&program);
}

/* "surface/Material.glsl", "surface/Material.vert.glsl" -> "surface/Material"; false for bases. */
static bool effect_of_file(const char *path, const char *base, char name[256]) {
    snprintf(name, 256, "%s", path);
    char *slash = strrchr(name, '/'), *dot = slash ? strchr(slash, '.') : NULL;
    if (!dot)
        return false;
    *dot = '\0';
    return strcmp(name, base) != 0;
}

static void list_folder(const plr_catalog *catalog, const char *base_name, const char *folder) {
    const plr_sources *base = plr_catalog_units(catalog, base_name);
    const char *path, *text;
    size_t length;
    char last[256] = "";
    for (size_t i = 0; (path = plr_effects_file(i, &text, &length)); i++) {
        char name[256];
        if (strncmp(path, folder, strlen(folder)) != 0 || !effect_of_file(path, base_name, name) ||
            strcmp(name, last) == 0)
            continue;
        list_offers(catalog, base, name);
        strcpy(last, name);
    }
}

static int list_own(void) {
    static const struct {
        const char *base, *folders[2];
    } kinds[] = {{"surface/surface", {"surface/", "lights/"}},
                 {"volume/raycaster", {"volume/", NULL}}};
    plr_catalog *catalog = plr_catalog_create(NULL);
    if (!catalog)
        return STATUS_MACHINE;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        printf("%s%s:\n", i ? "\n" : "", kinds[i].base);
        list_offers(catalog, plr_catalog_units(catalog, kinds[i].base), NULL);
        for (size_t j = 0; j < 2 && kinds[i].folders[j]; j++)
            list_folder(catalog, kinds[i].base, kinds[i].folders[j]);
    }
    plr_catalog_destroy(&catalog);
    return STATUS_FINE;
}

int command_plugs(const tool_arguments *arguments) {
    return arguments->operand_count ? list_scene(arguments) : list_own();
}
