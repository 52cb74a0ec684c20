/* Checks of scenes, on top of TAP. */
#ifndef TESTS_X3D_CHECKS_H
#define TESTS_X3D_CHECKS_H

#include "dump.h"
#include "tests/tap.h"

/* All diagnostics, notes and messages left out: "1:2 error bad-value\n..." malloc'ed. */
static inline char *faults_of(const plr_diags *diags) {
    size_t size = 1;
    char *faults = calloc(1, 64 * (plr_diags_count(diags) + 1));
    for (size_t i = 0; i < plr_diags_count(diags); i++) {
        const plr_diag *diag = plr_diags_get(diags, i);
        if (diag->severity != PLR_NOTE)
            size += (size_t)snprintf(faults + size - 1, 64, "%u:%u %s %s\n", diag->place.line,
                                     diag->place.column, plr_severity_text(diag->severity),
                                     plr_code_text(diag->code));
    }
    return faults;
}

static inline void check_these_faults(const char *what, const plr_diags *diags,
                                      const char *expected) {
    char *faults = faults_of(diags);
    int same = strcmp(faults, expected) == 0;
    TAP_RESULT(same, "%s", what);
    if (!same) {
        char *all = dump_diags(diags);
        printf("# expected:\n%s\n# actual:\n%s\n# in full:\n%s\n", expected, faults, all);
        free(all);
    }
    free(faults);
}

/* Reads a text and checks all its diagnostics. Returns the scene, to be destroyed. */
static inline plr_scene *check_faults(const char *what, const char *text, const char *expected) {
    plr_diags *diags;
    plr_scene *scene = parse_text(text, "scene", &diags);
    check_these_faults(what, diags, expected);
    plr_diags_destroy(&diags);
    return scene;
}

static inline void check_only_faults(const char *what, const char *text, const char *expected) {
    plr_scene *scene = check_faults(what, text, expected);
    plr_scene_destroy(&scene);
}

static inline void check_graph(const char *what, const plr_scene *scene, const char *expected) {
    char *dump = dump_scene(scene);
    int same = strcmp(dump, expected) == 0;
    TAP_RESULT(same, "%s: graph", what);
    if (!same)
        printf("# expected:\n%s\n# actual:\n%s\n", expected, dump);
    free(dump);
}

/* Reads a text without fault and checks its dump. */
static inline void check_dump(const char *what, const char *text, const char *expected) {
    plr_scene *scene = check_faults(what, text, "");
    check_graph(what, scene, expected);
    plr_scene_destroy(&scene);
}

/* Checks where in its file a word of a string stands. */
static inline void check_place(const char *what, const plr_string *string, const char *word,
                               const char *file, unsigned line, unsigned column) {
    const char *found = string->text ? strstr(string->text, word) : NULL;
    plr_place place = {0};
    if (found)
        place = plr_origin_place(&string->origin, string->text, (size_t)(found - string->text));
    int same = found && place.line == line && place.column == column && place.file &&
               strcmp(place.file, file) == 0;
    TAP_RESULT(same, "%s: '%s' at %s:%u:%u", what, word, file, line, column);
    if (!same)
        printf("#   it is at %s:%u:%u\n", place.file ? place.file : "(not found)", place.line,
               place.column);
}

#define XML(body) "<X3D version='3.3'><Scene>" body "</Scene></X3D>"
#define CLASSIC(body) "#X3D V3.3 utf8\nPROFILE Full\n" body

#endif
