/* The values that uniforms have when a program is fresh: its initialisers, else zero. Programs are
 * shared by what has equal text; a user that gives no value must not see that of another. */
#ifndef PLR_ENGINE_DEFAULTS_H
#define PLR_ENGINE_DEFAULTS_H

#include "engine/gl.h"

typedef struct plr_defaults plr_defaults;

/* Reads them from a program just linked or loaded. NULL without memory. Needs GL. */
plr_defaults *plr_defaults_capture(const plr_gl *gl, GLuint program);
/* Sets all uniforms of the program, which is in use, to these values; NULL: nothing. Needs GL. */
void plr_defaults_apply(const plr_gl *gl, const plr_defaults *defaults);
void plr_defaults_destroy(plr_defaults **defaults);

#endif
