/* Fields of volume nodes that are read and change nothing. No GL. */
#ifndef PLR_ENGINE_IGNORED_H
#define PLR_ENGINE_IGNORED_H

#include "engine/traverse.h"

/* Warns once of each such field that the volumes of a scene or their styles give another value than
 * its default. */
void plr_ignored_report(plr_arena *arena, const plr_scene *scene, const plr_flat *flat,
                        plr_diags *diags);

#endif
