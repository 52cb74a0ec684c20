/* A scene at a time: what its fields are then. */
#ifndef TESTS_X3D_EVENTS_TEST_H
#define TESTS_X3D_EVENTS_TEST_H

#include "checks.h"

static inline double event_number(const plr_field *field, size_t i) {
    switch (plr_type_kind(field->type)) {
    case PLR_BOOL:
        return field->value.bools[i];
    case PLR_INT:
        return field->value.ints[i];
    case PLR_FLOAT:
        return (double)field->value.floats[i];
    case PLR_DOUBLE:
        return field->value.doubles[i];
    default:
        return 0;
    }
}

/* The numbers of DEF.field, at most 64, as "1 0.5 0"; malloc'ed. Four digits behind the point. */
static inline char *event_value(const plr_scene *scene, const char *path) {
    const char *dot = strchr(path, '.');
    char def[64], *text = calloc(64, 24), *at = text;
    snprintf(def, sizeof def, "%.*s", (int)(dot - path), path);
    plr_node *node = plr_scene_find(scene, def);
    const plr_field *field = node ? plr_node_field(node, dot + 1) : NULL;
    if (!field) {
        strcpy(text, "no such field");
        return text;
    }
    if (plr_type_kind(field->type) == PLR_STRING && field->count)
        snprintf(text, 64, "%s", field->value.strings[0].text);
    size_t count = field->count * (size_t)plr_type_components(field->type);
    for (size_t i = 0; i < count && i < 64 && plr_type_kind(field->type) <= PLR_DOUBLE; i++) {
        double value = round(event_number(field, i) * 1e4) / 1e4;
        at += sprintf(at, "%s%.8g", i ? " " : "", value == 0 ? 0 : value);
    }
    return text;
}

static inline void check_field(const plr_scene *scene, const char *what, const char *path,
                               const char *expected) {
    char *value = event_value(scene, path);
    int same = strcmp(value, expected) == 0;
    TAP_RESULT(same, "%s: %s", what, path);
    if (!same)
        printf("#   expected: %s\n#   actual:   %s\n", expected, value);
    free(value);
}

/* What DEF.field is at a time; the scenes of a file are read once for each check. */
static inline void check_at(const char *what, const char *text, double time, const char *path,
                            const char *expected) {
    plr_diags *diags;
    plr_scene *scene = parse_text(text, "scene", &diags);
    char title[128];
    snprintf(title, sizeof title, "%s at %g", what, time);
    if (!scene || !plr_scene_set_time(scene, time, NULL, diags))
        TAP_RESULT(0, "%s: no scene", title);
    else
        check_field(scene, title, path, expected);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

#endif
