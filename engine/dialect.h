/* Two readings of the volume nodes: the final standard's, and that of the proposal of 2005. */
#ifndef PLR_ENGINE_DIALECT_H
#define PLR_ENGINE_DIALECT_H

#include "engine/traverse.h"

enum {
    PLR_DIALECT_FINAL = 1,
    PLR_DIALECT_2005 = 2005
};

/* The reading of the scene's volumes: `asked` if not 0, else that of 2005 where a volume or one of
 * its styles has a node or field that only the proposal has. One line of information says which,
 * where it is not the final standard's without being asked for. */
int plr_dialect(plr_scene *scene, const plr_flat *flat, int asked, plr_diags *diags);

#endif
