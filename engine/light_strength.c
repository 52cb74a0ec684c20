#include "engine/light_strength.h"

#include <math.h>
#include <string.h>

#include "engine/view.h"

/* ---- How strong it is ---- */

/* Effects that know more of light than Phong's reflection of colours from 0 to 1 does, which is at
 * most diffuse plus specular colour (library/lighting.glsl). */
static const struct {
    const char *effect;
    plr_light_use use;
} uses[] = {
    {"ToneMappedVolumeStyle", PLR_LIGHT_COUNTS}, {"StippleVolumeStyle", PLR_LIGHT_COUNTS},
    {"ShadedVolumeStyle", PLR_LIGHT_STEEP}, /* with lights of its own: physical, or scattering */
    {"PhysicalMaterial", PLR_LIGHT_STEEP},       {"CommonSurfaceShader", PLR_LIGHT_STEEP},
};

enum {
    PLAIN_FACTOR = 2
};

static double magnitude(const plr_node *node, const char *field) {
    return plr_node_field(node, field) ? fabs(plr_node_number(node, field)) : 0;
}

static double brightest(const plr_node *node) {
    float color[3] = {1, 1, 1};
    plr_node_numbers(node, "color", color, 3);
    return fmax(fabs((double)color[0]), fmax(fabs((double)color[1]), fabs((double)color[2])));
}

/* The least distance, in the light's own lengths, from a light to the ball around a box; 0 where
 * that is not to be known. */
static double distance_to(const plr_light *light, const plr_volume_state *volume) {
    double middle[3] = {0}, place[3], radius = 0, squared = 0;
    float location[3] = {0};
    plr_matrix from_world;
    if (!volume || !plr_matrix_invert(&light->to_world, &from_world))
        return 0;
    plr_node_numbers(light->node, "location", location, 3);
    for (int i = 0; i < 3; i++)
        place[i] = (double)location[i];
    plr_matrix_point(&light->to_world, place, place);
    plr_matrix_point(&volume->to_world, middle, middle);
    for (int corner = 0; corner < 8; corner++) {
        double point[3], length = 0;
        for (int i = 0; i < 3; i++)
            point[i] = ((corner >> i & 1) - 0.5) * volume->dimensions[i];
        plr_matrix_point(&volume->to_world, point, point);
        for (int i = 0; i < 3; i++)
            length += (point[i] - middle[i]) * (point[i] - middle[i]);
        radius = fmax(radius, sqrt(length));
    }
    for (int i = 0; i < 3; i++)
        squared += (place[i] - middle[i]) * (place[i] - middle[i]);
    return fmax(sqrt(squared) - radius, 0) * cbrt(fabs(plr_matrix_determinant3(&from_world)));
}

/* The most that is left of a light that weakens with the distance: 1 / max(c1 + c2 d + c3 d^2, 1),
 * and nothing beyond its radius (lights/PointLight.glsl). */
static double attenuation(const plr_light *light, const plr_volume_state *volume) {
    float c[3] = {1, 0, 0};
    if (!plr_node_field(light->node, "attenuation") || light->in_eye_space)
        return 1;
    plr_node_numbers(light->node, "attenuation", c, 3);
    double d = distance_to(light, volume), slack = 1 - 1e-6;
    if (d * slack > plr_node_number(light->node, "radius"))
        return 0;
    if (!(c[0] >= 0 && c[1] >= 0 && c[2] >= 0))
        return 1;
    double weakening = (double)c[0] + ((double)c[1] + (double)c[2] * d) * d;
    return 1 / fmax(weakening * slack, 1);
}

static double strength(const plr_light *light, const plr_volume_state *volume) {
    return brightest(light->node) * attenuation(light, volume) *
           (PLAIN_FACTOR * magnitude(light->node, "intensity") +
            magnitude(light->node, "ambientIntensity"));
}

/* ---- Who sees it ---- */

static bool is_known(const plr_node *node) {
    static const char *const types[] = {"DirectionalLight", "PointLight", "SpotLight",
                                        "EnvironmentLight"};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcmp(plr_node_type(node), types[i]) == 0)
            return true;
    return false;
}

static bool has_effects(const plr_node *node) {
    const plr_field *effects = plr_node_field(node, "effects");
    return effects && effects->count;
}

bool plr_authors_reach(const plr_node *node, const plr_scope *scope) {
    for (; scope; scope = scope->outer)
        if (scope->effects.count)
            return true;
    return node && has_effects(node);
}

/* An effect of an author may do more with light than any formula here, or ask for a light by its
 * number; volumes are cast together. */
static bool authors_on_volumes(plr_view *view) {
    plr_light_answers *answers = &view->lights;
    const plr_leaf *const *leaves = (const plr_leaf *const *)view->volumes.leaves;
    if (!answers->authors || answers->around != leaves) {
        answers->authors = PLR_NEW(&view->arena, bool);
        answers->around = leaves;
        for (size_t i = 0; i < view->volumes.count && !*answers->authors; i++)
            *answers->authors = plr_authors_reach(leaves[i]->node, leaves[i]->scope);
    }
    return *answers->authors;
}

static plr_light_use use_by_name(const char *name) {
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++)
        if (strcmp(uses[i].effect, name) == 0)
            return uses[i].use;
    return PLR_LIGHT_PLAIN;
}

static plr_light_use use_of(plr_view *view, const plr_recipe *recipe, size_t attached,
                            bool in_volume) {
    if (in_volume && authors_on_volumes(view))
        return PLR_LIGHT_COUNTS;
    if (attached)
        return use_by_name(recipe->effects.items[attached - 1].name);
    if (recipe->sees_lights)
        return PLR_LIGHT_COUNTS;
    plr_light_use most = view->flat.tone_mapping ? PLR_LIGHT_STEEP : PLR_LIGHT_PLAIN;
    for (size_t i = 0; i < recipe->effects.count; i++) {
        const plr_node *node = recipe->bindings.items[i].node;
        plr_light_use use = use_by_name(recipe->effects.items[i].name);
        if (node && plr_node_is(node, "X3DTextureNode")) /* may hold more than 1 */
            use = PLR_LIGHT_STEEP;
        most = use > most ? use : most;
    }
    return most;
}

/* ---- Answers ---- */

static double wanted_error(const plr_view *view) {
    return view->desc.error > 0 ? view->desc.error : 1.0 / 255;
}

static bool is_weak(const plr_light_answer *answer) {
    const plr_node *node = answer->light->node;
    if (!is_known(node) || has_effects(node))
        return false;
    double most = strength(answer->light, answer->volume);
    bool steep = answer->use == PLR_LIGHT_STEEP || plr_node_child(node, "diffuseTexture");
    return steep ? most <= 0 : most < answer->share;
}

static void note(plr_view *view, plr_light_answer answer) {
    plr_light_answers *answers = &view->lights;
    if (!answer.volume) {
        if (!answers->asked)
            answers->asked =
                PLR_NEW_ARRAY(&view->arena, plr_scene_node_count(view->scene) + 1, uint8_t);
        uint8_t *asked = &answers->asked[plr_node_id(answer.light->node)];
        if (*asked >> answer.use & 1)
            return;
        *asked = (uint8_t)(*asked | 1u << answer.use);
    }
    *PLR_PUSH(&view->arena, answers) = answer;
}

bool plr_light_is_weak(plr_view *view, const plr_recipe *recipe, const plr_light *light,
                       size_t attached, size_t volume) {
    const plr_volume_state *state = volume == PLR_NO_EFFECT ? NULL : &view->volumes.volumes[volume];
    plr_light_use use = use_of(view, recipe, attached, state != NULL);
    if (!light->node || use == PLR_LIGHT_COUNTS)
        return false;
    double lights = (double)(view->flat.all_lights.count + 1);
    plr_light_answer answer = {light, state, use, wanted_error(view) / 4 / lights, false};
    answer.weak = is_weak(&answer);
    note(view, answer);
    return answer.weak;
}

bool plr_lights_stay(const plr_view *view) {
    for (size_t i = 0; i < view->lights.count; i++)
        if (is_weak(&view->lights.items[i]) != view->lights.items[i].weak)
            return false;
    return true;
}
