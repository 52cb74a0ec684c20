#include "engine/brightness.h"

#include <math.h>
#include <string.h>

/* ---- What effects add ---- */

typedef enum addition {
    ADD_NOTHING, /* colours stay between 0 and 1, if they were */
    ADD_COLOR,   /* one of the field's range: 0 to 1 */
    ADD_LIGHT    /* what Phong's reflection makes of a light (library/lighting.glsl) */
} addition;

/* Of all others nothing is known: physical materials have highlights of any height. */
static const struct {
    const char *effect;
    addition adds;
} additions[] = {
    {"Shape", ADD_NOTHING},
    {"Material", ADD_COLOR},
    {"UnlitMaterial", ADD_COLOR},
    {"DirectionalLight", ADD_LIGHT},
    {"PointLight", ADD_LIGHT},
    {"SpotLight", ADD_LIGHT},
    {"GeneratedShadowMap", ADD_NOTHING},
    {"ClipPlane", ADD_NOTHING},
    {"Fog", ADD_NOTHING},
    {"LocalFog", ADD_NOTHING},
    {"Color", ADD_NOTHING},
    {"FillProperties", ADD_NOTHING},
    {"LineProperties", ADD_NOTHING},
    {"PointProperties", ADD_NOTHING},
    {"ImageTexture", ADD_NOTHING},
    {"PixelTexture", ADD_NOTHING},
    {"TextureCoordinate", ADD_NOTHING},
    {"TextureCoordinateGenerator", ADD_NOTHING},
    {"TextureTransform", ADD_NOTHING},
    {"Background", ADD_NOTHING},
    {"TextureBackground", ADD_NOTHING},
};

/* Diffuse and specular light, and the ambient part. */
static double of_light(const plr_node *light) {
    float color[3] = {1, 1, 1};
    if (!light)
        return INFINITY;
    plr_node_numbers(light, "color", color, 3);
    double most =
        fmax(fabs((double)color[0]), fmax(fabs((double)color[1]), fabs((double)color[2])));
    return most * (2 * fabs(plr_node_number(light, "intensity")) +
                   fabs(plr_node_number(light, "ambientIntensity")));
}

static double of_effect(const plr_effect *effect, const plr_binding *binding) {
    if (effect->disabled || binding->closed)
        return 0;
    for (size_t i = 0; effect->builtin && effect->name && i < sizeof additions / sizeof *additions;
         i++)
        if (strcmp(additions[i].effect, effect->name) == 0)
            return additions[i].adds == ADD_LIGHT   ? of_light(binding->node)
                   : additions[i].adds == ADD_COLOR ? 1
                                                    : 0;
    return INFINITY;
}

static double of_recipe(const plr_recipe *recipe) {
    double sum = recipe->base_node ? INFINITY : 0;
    for (size_t i = 0; i < recipe->effects.count && isfinite(sum); i++)
        sum += of_effect(&recipe->effects.items[i], &recipe->bindings.items[i]);
    return sum;
}

/* ---- Pictures ---- */

/* Textures of surfaces whose texels may be brighter than white. */
static bool has_bright_texels(const plr_view *view) {
    for (size_t i = 0; i < view->textures.list.count; i++) {
        const plr_texture *texture = view->textures.list.items[i];
        if (texture->voxels || texture->depth)
            continue;
        if (texture->generated || (texture->node && texture->image.type == PLR_FLOAT32))
            return true;
    }
    return false;
}

double plr_view_brightest(const plr_view *view) {
    double most = fmax(of_recipe(&view->background.pass.recipe), 1);
    if (view->surface_count && has_bright_texels(view))
        return INFINITY;
    for (size_t i = 0; i < view->surface_count && isfinite(most); i++)
        most = fmax(most, of_recipe(&view->surfaces[i].model->pass.recipe));
    return most;
}
