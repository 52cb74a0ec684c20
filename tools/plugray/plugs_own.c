#include "tools/plugray/plugs_own.h"

#include <stdio.h>
#include <string.h>

#include "engine/catalog.h"
#include "tools/plugray/json.h"
#include "tools/plugray/listing.h"
#include "tools/plugray/options.h"

typedef enum section {
    SURFACE_VERTEX,
    SURFACE_GEOMETRY,
    SURFACE_FRAGMENT,
    VOLUME,
    INSIDE,
    SECTION_COUNT
} section;

static const char *const section_names[] = {"surface vertex", "surface geometry",
                                            "surface fragment", "volume", "inside"};

static const struct row {
    section section;
    const char *name;
    plr_stage stage;
    const char *parameters, *moment, *scope;
} rows[] = {
#define PLUG(section, name, stage, parameters, moment, scope)                                      \
    {section, name, PLR_##stage, parameters, moment, scope},
#include "tools/plugray/plugs.def"
#undef PLUG
};
#define ROWS (sizeof rows / sizeof *rows)

/* The next of the lists of parameters that | separates; NULL after the last. */
static const char *next_list(const char **at, int *length) {
    const char *list = *at;
    if (!list)
        return NULL;
    const char *bar = strchr(list, '|');
    *length = (int)(bar ? (size_t)(bar - list) : strlen(list));
    while (*length && list[*length - 1] == ' ')
        --*length;
    *at = bar ? bar + 1 + strspn(bar + 1, " ") : NULL;
    return list;
}

/* ---- Tables ---- */

static void write_parameters(const char *lists) {
    int length;
    const char *list;
    for (const char *at = *lists ? lists : NULL, *first = at; (list = next_list(&at, &length));)
        printf("%s`%.*s`", list == first ? "" : " or ", length, list);
}

static void write_row(const struct row *row) {
    printf("| `%s` |", row->name);
    if (row->section == INSIDE)
        printf(" %s |", plr_stage_text(row->stage));
    if (*row->parameters)
        putchar(' ');
    write_parameters(row->parameters);
    printf(" | %s |", row->moment);
    if (row->section != INSIDE)
        printf(" %s |", row->scope);
    putchar('\n');
}

void write_own_tables(void) {
    for (int s = 0; s < SECTION_COUNT; s++) {
        printf("<!-- plugs: %s -->\n%s\n%s\n", section_names[s],
               s == INSIDE ? "| plug | stage | parameters | moment |"
                           : "| plug | parameters | moment | scope |",
               "| --- | --- | --- | --- |");
        for (size_t i = 0; i < ROWS; i++)
            if (rows[i].section == (section)s)
                write_row(&rows[i]);
        puts("<!-- end -->");
    }
}

/* ---- JSON ---- */

static void write_lists(const char *lists) {
    int length;
    const char *list;
    for (const char *at = lists, *first = at; (list = next_list(&at, &length));)
        printf("%s\"%.*s\"", list == first ? "" : ", ", length, list);
}

void write_own_plugs(void) {
    putchar('[');
    for (size_t i = 0; i < ROWS; i++) {
        printf("%s\n  {\"name\": \"%s\", \"stage\": \"%s\", \"parameters\": [", i ? "," : "",
               rows[i].name, plr_stage_text(rows[i].stage));
        write_lists(rows[i].parameters);
        fputs("], \"moment\": ", stdout);
        json_string(stdout, rows[i].moment);
        fputs(", \"scope\": ", stdout);
        json_string(stdout, *rows[i].scope ? rows[i].scope : NULL);
        printf(", \"inside\": %s}", rows[i].section == INSIDE ? "true" : "false");
    }
    puts("]");
}

/* ---- Text ---- */

static void print_meaning(const char *plug, plr_stage stage) {
    for (size_t i = 0; i < ROWS; i++) {
        int length;
        const char *list;
        if (rows[i].stage != stage || strcmp(rows[i].name, plug) != 0)
            continue;
        printf("    %s%s%s%s\n", rows[i].moment, *rows[i].scope ? " [" : "", rows[i].scope,
               *rows[i].scope ? "]" : "");
        for (const char *at = rows[i].parameters; (list = next_list(&at, &length));)
            printf("    void PLUG_%s(%.*s)\n", plug, length, list);
    }
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
        if (!units == (plr_program_plug(program, i)->effect == PLR_NO_EFFECT)) {
            print_plug(program, i, &effect);
            print_meaning(plr_program_plug(program, i)->name, plr_program_plug(program, i)->stage);
        }
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

/* The plugs of the geometry stage, which no program has but one whose author writes its main(). */
static void list_geometry(void) {
    for (size_t i = 0; i < ROWS; i++)
        if (rows[i].stage == PLR_GEOMETRY) {
            printf("%s (%s) geometry\n", rows[i].name, rows[i].parameters);
            print_meaning(rows[i].name, PLR_GEOMETRY);
        }
}

int print_own_plugs(void) {
    static const struct {
        const char *base, *folders[4];
    } kinds[] = {{"surface/surface", {"surface/", "lights/", "fog/", "output/"}},
                 {"volume/raycaster", {"volume/"}}};
    plr_catalog *catalog = plr_catalog_create(NULL);
    if (!catalog)
        return STATUS_MACHINE;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const plr_sources *base = plr_catalog_units(catalog, kinds[i].base);
        printf("%s%s:\n", i ? "\n" : "", kinds[i].base);
        list_offers(catalog, base, NULL);
        if (i == 0)
            list_geometry();
        for (size_t j = 0; j < 4 && kinds[i].folders[j]; j++)
            list_folder(catalog, kinds[i].base, kinds[i].folders[j]);
    }
    plr_catalog_destroy(&catalog);
    return STATUS_FINE;
}
