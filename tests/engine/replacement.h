/* Programs written by hand in the place of composed ones. */
#ifndef PLUGRAY_TEST_REPLACEMENT_H
#define PLUGRAY_TEST_REPLACEMENT_H

#include "engine/view.h"

/* The view's program of this name (that of `plugray dump`), or NULL. */
plr_built *replacement_find(const plr_view *view, const char *name);

/* Compiles the files; "-" or NULL is the stage that was composed. Uniforms have the names that the
 * composed ones have. 0 where the compiler refuses it, and why. A file that cannot be read ends the
 * process. */
GLuint replacement_compile(plr_engine *engine, const plr_built *built,
                           const char *const paths[PLR_STAGE_COUNT], char *why, size_t size);

/* The view draws with it from now on. */
void replacement_use(plr_view *view, plr_built *built, GLuint name);

#endif
