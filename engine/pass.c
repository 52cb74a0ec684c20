/* What volumes and surfaces have in common: lights, and the way from program to uniforms. */
#include "engine/general.h"

static void add_light(plr_view *view, plr_recipe *recipe, const plr_light *light, size_t attached,
                      size_t volume) {
    const char *type = light->node ? plr_node_type(light->node) : "DirectionalLight";
    bool ambient = light->node && plr_node_number(light->node, "ambientIntensity") != 0;
    const plr_define no_ambient = {"NO_AMBIENT", "1"};
    if (!plr_general_has(view, light->off, light->node))
        return;
    plr_recipe_builtin(&view->kitchen, recipe, plr_arena_format(&view->arena, "lights/%s", type),
                       type,
                       (plr_binding){.node = light->node,
                                     .to_world = light->to_world,
                                     .place = &light->to_world,
                                     .in_eye_space = light->in_eye_space,
                                     .volume = volume,
                                     .is_light = true,
                                     .gated = view->general,
                                     .closed = light->off},
                       attached, &no_ambient, ambient || view->general ? 0 : 1);
}

void plr_pass_lights(plr_view *view, plr_recipe *recipe, const plr_scope *scope, size_t attached,
                     size_t volume) {
    for (; scope; scope = scope->outer)
        for (size_t i = 0; i < scope->lights.count; i++)
            add_light(view, recipe, &scope->lights.items[i], attached, volume);
    for (size_t i = 0; i < view->flat.global_lights.count; i++)
        add_light(view, recipe, &view->flat.global_lights.items[i], attached, volume);
}

const plr_placed *plr_pass_fog(const plr_view *view, const plr_scope *scope) {
    static const plr_placed none = {0};
    const plr_placed *fog = &view->flat.fog;
    for (bool found = false; scope && !found; scope = scope->outer)
        if ((found = scope->fog.node != NULL))
            fog = &scope->fog;
    /* ISO/IEC 19775-1 V4 24.4.2: a range of 0 disables it */
    bool off = fog->node && !(plr_node_number(fog->node, "visibilityRange") > 0);
    return off ? &none : fog;
}

void plr_pass_find(plr_view *view, plr_pass *pass) {
    if (pass->built)
        plr_bind_find(&view->kitchen, &view->engine->gl, &pass->recipe, pass->program, pass->built,
                      &pass->slots);
}
