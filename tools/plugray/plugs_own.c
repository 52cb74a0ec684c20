#include "tools/plugray/plugs_own.h"

#include <stdio.h>
#include <string.h>

#include <plugray/engine.h>
#include "tools/plugray/json.h"
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

/* The plug is offered in the text before. */
static bool is_again(const plr_source *source, size_t index) {
    size_t length, other_length;
    const char *name = plr_source_plug(source, index, &length);
    for (size_t i = 0; i < index; i++) {
        const char *other = plr_source_plug(source, i, &other_length);
        if (other_length == length && memcmp(other, name, length) == 0)
            return true;
    }
    return false;
}

static void print_file(const char *path, const plr_source *source) {
    plr_stage stage = plr_source_stage(source);
    for (size_t i = 0; i < plr_source_plug_count(source); i++) {
        char name[64];
        size_t length, lists_length;
        const char *text = plr_source_plug(source, i, &length);
        const char *lists = plr_source_plug_lists(source, i, &lists_length);
        plr_place place = plr_source_plug_place(source, i);
        if (i == 0)
            printf("effects/%s:\n", path);
        if (is_again(source, i))
            continue;
        snprintf(name, sizeof name, "%.*s", (int)length, text);
        printf("%s %.*s %s\n    offered at %u:%u\n", name, (int)lists_length, lists,
               plr_stage_text(stage), place.line, place.column);
        print_meaning(name, stage);
    }
}

static plr_stage stage_of(const char *path) {
    return strstr(path, ".vert.")   ? PLR_VERTEX
           : strstr(path, ".geom.") ? PLR_GEOMETRY
                                    : PLR_FRAGMENT;
}

int print_own_plugs(void) {
    const char *path, *text;
    size_t length;
    for (size_t i = 0; (path = plr_effects_file(i, &text, &length)); i++) {
        plr_source *source = plr_source_read(stage_of(path), text, length, NULL, NULL, NULL);
        if (!source)
            return STATUS_MACHINE;
        print_file(path, source);
        plr_source_destroy(&source);
    }
    return STATUS_FINE;
}
