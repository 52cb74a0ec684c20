#include "engine/dialect.h"

int plr_dialect(plr_scene *scene, const plr_flat *flat, int asked, plr_diags *diags) {
    if (!flat->volumes.count)
        return asked ? asked : PLR_DIALECT_FINAL;
    plr_place place = plr_node_place(flat->volumes.items[0].node);
    bool old = plr_scene_uses_2005(scene, &place);
    int dialect = asked ? asked : old ? PLR_DIALECT_2005 : PLR_DIALECT_FINAL;
    if (dialect == PLR_DIALECT_FINAL && !asked)
        return dialect; /* what everybody expects needs no line */
    plr_diags_add(diags, PLR_CODE_DIALECT, place, "volume nodes are read as %s%s",
                  dialect == PLR_DIALECT_2005 ? "the proposal of 2005 has them"
                                              : "the final standard has them",
                  asked ? ", as asked" : "");
    return dialect;
}
