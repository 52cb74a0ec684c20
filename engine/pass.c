/* What volumes and surfaces have in common: lights, and the way from program to uniforms. */
#include "engine/general.h"

#include <string.h>

static const char *type_of(const plr_light *light) {
    return light->node ? plr_node_type(light->node) : "DirectionalLight";
}

/* `number`: of those that are on. */
static void add_light(plr_view *view, plr_recipe *recipe, const char *type, const plr_light *light,
                      int number, size_t attached, size_t volume) {
    bool ambient = light->node && plr_node_number(light->node, "ambientIntensity") != 0;
    const plr_define no_ambient = {"NO_AMBIENT", "1"};
    if (!plr_general_has(view, light->off, light->node))
        return;
    if (!view->general && plr_light_is_weak(view, recipe, light, attached, volume))
        return;
    plr_recipe_builtin(&view->kitchen, recipe, plr_arena_format(&view->arena, "lights/%s", type),
                       type,
                       (plr_binding){.node = light->node,
                                     .to_world = light->to_world,
                                     .place = &light->to_world,
                                     .in_eye_space = light->in_eye_space,
                                     .volume = volume,
                                     .is_light = true,
                                     .number = number,
                                     .gated = view->general,
                                     .closed = light->off},
                       attached, &no_ambient, ambient || view->general ? 0 : 1);
}

/* The types that general programs have room for, in the order in which these have their lights. */
static const char *const slot_types[] = {"DirectionalLight", "PointLight", "SpotLight"};

enum {
    SLOT_TYPES = sizeof slot_types / sizeof *slot_types
};

/* Of a type; SLOT_TYPES: of none of these. */
static bool is_of_type(const plr_light *light, size_t type) {
    for (size_t i = 0; i < SLOT_TYPES; i++)
        if (strcmp(type_of(light), slot_types[i]) == 0)
            return i == type;
    return type == SLOT_TYPES;
}

/* All lights that reach the scope; or those of one type. */
static void add_lights(plr_view *view, plr_recipe *recipe, const plr_scope *scope, size_t attached,
                       size_t volume, const size_t *type) {
    int number = 0;
    for (bool global = false; !global; scope = scope ? scope->outer : NULL) {
        global = !scope;
        const plr_lights *lights = global ? &view->flat.global_lights : &scope->lights;
        for (size_t i = 0; i < lights->count; i++) {
            const plr_light *light = &lights->items[i];
            if (!type || is_of_type(light, *type))
                add_light(view, recipe, type_of(light), light, light->off ? -1 : number, attached,
                          volume);
            number += !light->off;
        }
    }
}

void plr_pass_lights(plr_view *view, plr_recipe *recipe, const plr_scope *scope, size_t attached,
                     size_t volume) {
    static const plr_light spare = {.off = true};
    if (!view->general) {
        add_lights(view, recipe, scope, attached, volume, NULL);
        return;
    }
    for (size_t type = 0; type <= SLOT_TYPES; type++) {
        size_t before = recipe->effects.count;
        add_lights(view, recipe, scope, attached, volume, &type);
        if (type == SLOT_TYPES)
            break;
        size_t count = recipe->effects.count - before;
        for (size_t i = plr_general_spares(view, (plr_slot_kind)type, count); i > 0; i--)
            add_light(view, recipe, slot_types[type], &spare, -1, attached, volume);
    }
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
