/* Two readings of the volume nodes: the final standard's, and that of the proposal of 2005. */
#ifndef PLR_ENGINE_DIALECT_H
#define PLR_ENGINE_DIALECT_H

#include "engine/traverse.h"

enum {
    PLR_DIALECT_FINAL = 1,
    PLR_DIALECT_2005 = 2005
};

/* Gives the volume nodes the defaults of a dialect: of `asked` if not 0, else of the proposal of
 * 2005 where a volume or one of its styles has a node or field that only the proposal has, else of
 * the final standard. Returns which. */
int plr_dialect_set(plr_scene *scene, int asked);
/* One line of information says which dialect the volumes of a scene are read in, where it is not
 * the final standard's without being asked for. */
void plr_dialect_report(const plr_scene *scene, const plr_flat *flat, int asked, plr_diags *diags);

#endif
