/* Links short texts and looks at what comes out. */
#ifndef TESTS_PLUGS_HELPER_H
#define TESTS_PLUGS_HELPER_H

#include <plugray/plugs.h>

#include "tests/tap.h"

typedef struct linked {
    plr_diags *diags;
    plr_program *program;
    const char *fragment, *vertex, *geometry; /* "" where there is none */
} linked;

/* Starts a new description; what the last one made is freed. Fragment texts have the files
 * base.frag, library.frag, and for effects A, B, C, ... a.frag, b.frag, ...; vertex texts end in
 * .vert. */
void begin(void);
void base(const char *text);
void base_vertex(const char *text);
void base_geometry(const char *text);
void library(const char *text);
void library_vertex(const char *text);
/* A new effect of one fragment unit; more units and stages are added to it. */
plr_effect *effect(const char *text);
void unit(const char *text);
void vertex_unit(const char *text);
void geometry_unit(const char *text);
/* Units of the effect added last that another effect uses as well. */
plr_effect *same_effect_again(void);
plr_link_desc *description(void);
/* Links what was described; valid until begin(). */
const linked *link_all(void);
/* Links, and checks that glslang takes each stage and that they fit together. */
static inline const linked *link_valid(void);
bool link_compiles(void);
/* How often a text occurs in another. */
int occurrences(const char *text, const char *part);
/* Whether `first` occurs, and `second` after it. */
bool in_order(const char *text, const char *first, const char *second);
/* Whether a diagnostic "FILE:LINE:COLUMN: SEVERITY: ...[CODE]" of that beginning, code, was given.
 */
bool said(const char *place, const char *code);
/* Whether the message of some diagnostic has that text. */
bool said_text(const char *part);
/* Prints all diagnostics and the texts as comments of TAP. */
void explain(void);

#define CHECK_HAS(text, part)                                                                      \
    do {                                                                                           \
        int tap_has = strstr((text), (part)) != NULL;                                              \
        TAP_RESULT(tap_has, "%s has %s", #text, #part);                                            \
        if (!tap_has)                                                                              \
            explain();                                                                             \
    } while (0)

#define CHECK_LACKS(text, part)                                                                    \
    do {                                                                                           \
        int tap_lacks = strstr((text), (part)) == NULL;                                            \
        TAP_RESULT(tap_lacks, "%s lacks %s", #text, #part);                                        \
        if (!tap_lacks)                                                                            \
            explain();                                                                             \
    } while (0)

#define CHECK_ORDER(text, first, second)                                                           \
    do {                                                                                           \
        int tap_order = in_order((text), (first), (second));                                       \
        TAP_RESULT(tap_order, "%s stands before %s", #first, #second);                             \
        if (!tap_order)                                                                            \
            explain();                                                                             \
    } while (0)

#define CHECK_SAID(place, code)                                                                    \
    do {                                                                                           \
        int tap_said = said((place), (code));                                                      \
        TAP_RESULT(tap_said, "%s [%s] is said", (place), (code));                                  \
        if (!tap_said)                                                                             \
            explain();                                                                             \
    } while (0)

#define CHECK_SILENT()                                                                             \
    do {                                                                                           \
        int tap_silent = plr_diags_count(link_result()->diags) == 0;                               \
        TAP_RESULT(tap_silent, "nothing is said");                                                 \
        if (!tap_silent)                                                                           \
            explain();                                                                             \
    } while (0)

const linked *link_result(void);
void free_all(void);

static inline const linked *link_valid(void) {
    bool good = link_compiles();
    TAP_RESULT(good, "glslang takes the program");
    if (!good)
        explain();
    return link_result();
}

/* Frees everything and ends the tests: what main returns. */
static inline int finish(void) {
    free_all();
    return tap_done();
}

#endif
