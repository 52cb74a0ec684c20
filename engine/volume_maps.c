#include "engine/volume_maps.h"

#include <string.h>

enum {
    MOST_LOOKS = 256, /* at styles within styles */
    MOST_ABSENT = 3
};

/* Styles that multiply opacity with one of their fields while another is 0: what that one weighs,
 * in the style's formula (effects/volume/), is then not there. */
static const struct factor_style {
    const char *type;
    const char *factor, *weight;
    bool only_one;                   /* not everywhere: nothing is known of other factors than 1 */
    const char *absent[MOST_ABSENT]; /* fields that bring more */
} factor_styles[] = {
    {"BoundaryEnhancementVolumeStyle",
     "retainedOpacity",
     "boundaryOpacity",
     false,
     {"transferFunction", "gradientColor", "contribution"}},
    {"SilhouetteEnhancementVolumeStyle",
     "silhouetteRetainedOpacity",
     "silhouetteBoundaryOpacity",
     true, /* not where there is no normal */
     {NULL}},
};

static double number(const plr_node *node, const char *name) {
    const plr_field *field = plr_node_field(node, name);
    return field && field->type == PLR_SFFLOAT ? (double)field->value.floats[0] : -1;
}

/* Whether a style does nothing but that. */
static bool find_factor(const plr_node *style, double *factor) {
    for (size_t i = 0; i < sizeof factor_styles / sizeof *factor_styles; i++) {
        const struct factor_style *known = &factor_styles[i];
        if (!plr_node_is(style, known->type))
            continue;
        *factor = number(style, known->factor);
        bool fits = number(style, known->weight) == 0 && *factor >= 0 && *factor <= 1 &&
                    (*factor == 1 || !known->only_one);
        for (size_t k = 0; k < MOST_ABSENT && known->absent[k]; k++) {
            const plr_field *field = plr_node_field(style, known->absent[k]);
            fits = fits && !(field && (field->given || plr_node_child(style, known->absent[k])));
        }
        return fits;
    }
    return false;
}

typedef struct search {
    plr_style_map found;
    bool general;
    bool any; /* map, on or off */
    size_t left;
} search;

static bool look(const plr_node *style, bool on, search *s) {
    double factor;
    if (!s->left)
        return false;
    --s->left;
    if (!style)
        return true;
    on = on && plr_node_bool(style, "enabled");
    if (!on && !s->general)
        return true;
    if (plr_node_is(style, "OpacityMapVolumeStyle")) {
        s->any = true;
        if (on)
            s->found = (plr_style_map){.map = style, .factor = 1};
        return true;
    }
    if (find_factor(style, &factor)) {
        s->found.factor *= on ? factor : 1;
        return true;
    }
    if (!plr_node_is(style, "ComposedVolumeStyle"))
        return false;
    const plr_field *styles = plr_node_field(style, "renderStyle");
    for (size_t i = 0; i < styles->count; i++)
        if (!look(styles->value.nodes[i], on, s))
            return false;
    return true;
}

bool plr_style_find_map(const plr_node *style, bool general, plr_style_map *found) {
    search s = {.found = {.factor = 1}, .general = general, .left = MOST_LOOKS};
    bool known = look(style, true, &s);
    *found = s.found;
    found->bare = style && !s.any;
    return known;
}
