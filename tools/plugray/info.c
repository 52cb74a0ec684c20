/* plugray info: what a scene needs and costs. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/plugray/commands.h"
#include "tools/plugray/files.h"
#include "tools/plugray/info.h"
#include "tools/plugray/progress.h"
#include "tools/plugray/scene.h"

static void add_node(node_list *list, bool *seen, plr_node *node) {
    if (!node || seen[plr_node_id(node)])
        return;
    seen[plr_node_id(node)] = true;
    list->items[list->count++] = node;
}

static node_list list_nodes(const plr_scene *scene) {
    size_t count = plr_scene_node_count(scene);
    node_list list = {.items = memory_array(NULL, count, sizeof *list.items)};
    bool *seen = memory_array(NULL, count, sizeof *seen);
    memset(seen, 0, count * sizeof *seen);
    for (size_t i = 0; i < plr_scene_root_count(scene); i++)
        add_node(&list, seen, plr_scene_root(scene, i));
    for (size_t i = 0; i < list.count; i++) {
        for (size_t f = 0; f < plr_node_field_count(list.items[i]); f++) {
            const plr_field *field = plr_node_field_at(list.items[i], f);
            if (plr_type_kind(field->type) != PLR_NODE)
                continue;
            for (size_t n = 0; n < field->count; n++)
                add_node(&list, seen, field->value.nodes[n]);
        }
    }
    free(seen);
    return list;
}

static int compare_types(const void *a, const void *b) {
    return strcmp(plr_node_type(*(plr_node *const *)a), plr_node_type(*(plr_node *const *)b));
}

static void print_nodes(node_list *list) {
    qsort(list->items, list->count, sizeof *list->items, compare_types);
    printf("nodes: %zu\n", list->count);
    for (size_t i = 0, end; i < list->count; i = end) {
        const char *type = plr_node_type(list->items[i]);
        for (end = i; end < list->count && plr_node_is(list->items[end], type);)
            end++;
        printf("    %s %zu\n", type, end - i);
    }
}

static void print_volumes(plr_scene *scene, const volume_list *list, bool xml) {
    volume_report report;
    bool readable;
    puts("volumes:");
    for (size_t next = 0; next_volume(list, scene, &next, &report, &readable);) {
        if (readable)
            print_volume(&report, xml);
        free_volume_report(&report);
    }
}

static void print_all(const tool_scene *scene, plr_view *view, node_list *nodes, bool xml) {
    volume_list volumes = find_volumes(nodes);
    print_nodes(nodes);
    print_volumes(scene->scene, &volumes, xml);
    print_plan(view);
    print_programs(view);
    free_volumes(&volumes);
}

/* ---- JSON ---- */

static void write_nodes(node_list *list) {
    qsort(list->items, list->count, sizeof *list->items, compare_types);
    fputs("  \"nodes\": {", stdout);
    for (size_t i = 0, end; i < list->count; i = end) {
        const char *type = plr_node_type(list->items[i]);
        for (end = i; end < list->count && plr_node_is(list->items[end], type);)
            end++;
        printf("%s\"%s\": %zu", i ? ", " : "", type, end - i);
    }
    putchar('}');
}

static void write_volumes(plr_scene *scene, const volume_list *list, bool xml) {
    volume_report report;
    bool readable;
    const char *between = "";
    fputs("  \"volumes\": [", stdout);
    for (size_t next = 0; next_volume(list, scene, &next, &report, &readable);) {
        if (readable) {
            printf("%s\n", between);
            write_volume(&report, xml);
            between = ",";
        }
        free_volume_report(&report);
    }
    putchar(']');
}

static void write_all(const tool_scene *scene, plr_view *view, node_list *nodes, bool xml) {
    volume_list volumes = find_volumes(nodes);
    puts("{");
    write_nodes(nodes);
    puts(",");
    write_volumes(scene->scene, &volumes, xml);
    puts(",");
    write_plan(view);
    puts(",");
    write_programs(view);
    puts("\n}");
    free_volumes(&volumes);
}

/* ---- The command ---- */

/* Whether the scene is written in XML: then so is what may be pasted into it. */
static bool is_xml(const tool_arguments *arguments, const plr_scene *scene) {
    size_t length;
    const char *line = plr_scene_line(scene, arguments->operands[0], 1, &length);
    while (line && length && strchr(" \t\xef\xbb\xbf", *line)) {
        line++;
        length--;
    }
    return line && length && *line == '<';
}

int command_info(const tool_arguments *arguments) {
    enum {
        TEXT,
        JSON
    }; /* in the order of the option's words */
    const char *text = option_value(arguments, OPTION_INFO_FORMAT);
    int format = text ? word_index(option_words(OPTION_INFO_FORMAT), text) : TEXT;
    if (format < 0)
        return usage_error(arguments, "--format takes %s, not '%s'",
                           option_words(OPTION_INFO_FORMAT), text);
    tool_scene scene;
    plr_view *view;
    int status = tool_scene_view(&scene, arguments, &view);
    if (view) {
        progress(NULL);
        node_list nodes = list_nodes(scene.scene);
        bool xml = is_xml(arguments, scene.scene);
        (format == JSON ? write_all : print_all)(&scene, view, &nodes, xml);
        free(nodes.items);
        status = tool_scene_finish(&scene);
        plr_view_destroy(&view);
    }
    tool_scene_close(&scene);
    return status;
}
