/* A scene as text, for comparing graphs: types, DEF names, given fields and values. */
#ifndef TESTS_X3D_DUMP_H
#define TESTS_X3D_DUMP_H

#include <plugray/x3d.h>

/* malloc'ed. Nodes that are used again are written as their number. */
char *dump_scene(const plr_scene *scene);
/* Reads a text; prints its diagnostics as TAP comments. */
plr_scene *parse_text(const char *text, const char *name, plr_diags **diags);
/* "1:2 error bad-value: message\n..." malloc'ed. */
char *dump_diags(const plr_diags *diags);

#endif
