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

static bool is_among(const char *plug, const char *const *plugs, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (strcmp(plug, plugs[i]) == 0)
            return true;
    return false;
}

void plr_volume_note_call(plr_volume_pass *pass, const char *plug, size_t volume,
                          plr_promises promises) {
    static const char *const apart[] = {"light_scale", "volume_ray", "volume_ray_end"};
    static const char *const colours[] = {"volume_classify", "volume_shade"};
    if (is_among(plug, apart, sizeof apart / sizeof *apart))
        return;
    if (!is_among(plug, colours, sizeof colours / sizeof *colours))
        promises = (plr_promises){0}; /* they are about what is done to a sample's colour */
    for (size_t i = 0; i < pass->count; i++) {
        plr_volume_state *state = &pass->volumes[i];
        if (volume != PLR_NO_EFFECT && volume != i)
            continue;
        state->authors_colour_only =
            promises.colour_only && (!state->authors_act || state->authors_colour_only);
        state->authors_see_all |= !promises.keeps_transparent;
        state->authors_act = true;
    }
}

bool plr_cast_skips(const plr_view *view, const plr_cast *cast, bool early_end) {
    bool any = false;
    for (size_t i = 0; i < cast->count; i++) {
        const plr_volume_state *state = &view->volumes.volumes[cast->members[i]];
        if (state->kind != PLR_VOLUME_FILLED)
            return false;
        any = any || plr_volume_keeps_clear(state);
    }
    return any && early_end && !cast->picks && !cast->dense;
}
