/* Which samples of volumes need not be drawn, because nothing of them can be seen. */
#include "engine/volume_pass.h"

#include <string.h>

enum {
    MOST_LOOKS = 4096 /* at styles: DEF and USE can make a few lines into very many */
};

/* Styles that leave what is clear as it is. */
static const char *const keeping[] = {
    "CartoonVolumeStyle", "EdgeEnhancementVolumeStyle",       "ISOSurfaceVolumeStyle",
    "ShadedVolumeStyle",  "SilhouetteEnhancementVolumeStyle", "ToneMappedVolumeStyle"};

static bool is_keeping(const plr_node *style) {
    for (size_t i = 0; i < sizeof keeping / sizeof *keeping; i++)
        if (plr_node_is(style, keeping[i]))
            return true;
    /* the draft of the component gives it a transfer function */
    return plr_node_is(style, "BoundaryEnhancementVolumeStyle") &&
           !plr_node_child(style, "transferFunction");
}

/* Whether the styles of the tree that are not leading opacity maps keep what is clear. `leading`:
 * only opacity maps so far; `general`: whatever is switched off; `left` bounds the search. */
static bool keeps_clear(const plr_node *style, bool general, bool *leading, size_t *left) {
    if (!*left)
        return false;
    --*left;
    bool on = !style || general || plr_node_bool(style, "enabled");
    if (!style || plr_node_is(style, "OpacityMapVolumeStyle"))
        return *leading || !on;
    if (!on)
        return true;
    if (!plr_node_is(style, "ComposedVolumeStyle")) {
        *leading = false;
        return is_keeping(style);
    }
    const plr_field *styles = plr_node_field(style, "renderStyle");
    for (size_t i = 0; i < styles->count; i++)
        if (styles->value.nodes[i] && !keeps_clear(styles->value.nodes[i], general, leading, left))
            return false;
    return true;
}

bool plr_volume_keeps_clear(const plr_volume_state *state) {
    const plr_field *styles = plr_node_field(state->node, "renderStyle");
    bool leading = true;
    size_t left = MOST_LOOKS;
    return state->kind == PLR_VOLUME_FILLED && styles->type == PLR_SFNODE &&
           !state->authors_see_all &&
           keeps_clear(styles->count ? styles->value.nodes[0] : NULL, state->general, &leading,
                       &left);
}

void plr_volume_note_call(plr_volume_pass *pass, const char *plug, size_t volume) {
    static const char *const apart[] = {"light_scale", "volume_ray", "volume_ray_end"};
    for (size_t i = 0; i < sizeof apart / sizeof *apart; i++)
        if (strcmp(plug, apart[i]) == 0)
            return;
    for (size_t i = 0; i < pass->count; i++)
        if (volume == PLR_NO_EFFECT || volume == i)
            pass->volumes[i].authors_see_all = true;
}

bool plr_cast_skips(const plr_view *view, const plr_cast *cast, bool early_end) {
    bool any = false;
    for (size_t i = 0; i < cast->count; i++) {
        const plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        if (state->kind != PLR_VOLUME_FILLED)
            return false;
        any = any || plr_volume_keeps_clear(state);
    }
    return any && early_end && !cast->picks;
}
