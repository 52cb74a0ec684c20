#include "engine/dialect.h"

static int choose(const plr_scene *scene, int asked) {
    bool old = plr_scene_uses_2005(scene, NULL);
    return asked ? asked : old ? PLR_DIALECT_2005 : PLR_DIALECT_FINAL;
}

int plr_dialect_set(plr_scene *scene, int asked) {
    int dialect = choose(scene, asked);
    plr_scene_set_2005(scene, dialect == PLR_DIALECT_2005);
    return dialect;
}

void plr_dialect_report(const plr_scene *scene, const plr_flat *flat, int asked, plr_diags *diags) {
    int dialect = choose(scene, asked);
    if (!flat->volumes.count || (dialect == PLR_DIALECT_FINAL && !asked))
        return; /* what everybody expects needs no line */
    plr_place place = plr_node_place(flat->volumes.items[0].node);
    plr_scene_uses_2005(scene, &place);
    plr_diags_add(diags, PLR_CODE_DIALECT, place, "volume nodes are read as %s%s",
                  dialect == PLR_DIALECT_2005 ? "the proposal of 2005 has them"
                                              : "the final standard has them",
                  asked ? ", as asked" : "");
}
