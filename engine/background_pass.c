#include "engine/view.h"

/* A background of one colour is a clear colour; only a gradient needs a program. */
static bool is_plain(const plr_node *node) {
    const plr_field *sky = plr_node_field(node, "skyColor");
    const plr_field *ground = plr_node_field(node, "groundColor");
    return (!sky || sky->count < 2) && (!ground || !ground->count);
}

void plr_background_prepare(plr_view *view, plr_background *background) {
    plr_node *node = background->node;
    plr_pass *pass = &background->pass;
    if (!node || is_plain(node))
        return;
    plr_kitchen *k = &view->kitchen;
    const plr_field *ground = plr_node_field(node, "groundColor");
    pass->recipe = (plr_recipe){.base = *plr_catalog_units(k->catalog, "background/background")};
    plr_recipe_define(k, &pass->recipe, "HAS_GROUND", ground && ground->count > 0);
    plr_binding binding = {.node = node, .to_world = background->to_world, .volume = PLR_NO_EFFECT};
    plr_recipe_builtin(k, &pass->recipe, "background/Background", plr_node_type(node), binding, 0,
                       NULL, 0);
    pass->built = plr_compose_program(&view->composer, &pass->recipe, "background", &pass->program);
}

/* Clears depth and colour: to the background's first colour, or to what is behind all. */
static void clear(const plr_view *view, const plr_node *node, const plr_frame *frame,
                  const float behind[4]) {
    const plr_gl *gl = &view->engine->gl;
    float color[4] = {behind[0], behind[1], behind[2], behind[3]};
    if (node) {
        plr_node_numbers(node, "skyColor", color, 3);
        color[3] = 1 - (float)plr_node_number(node, "transparency");
        for (int i = 0; i < 3; i++)
            color[i] *= color[3];
    }
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->DepthMask(GL_TRUE);
    gl->Disable(GL_SCISSOR_TEST);
    gl->ClearColor(color[0], color[1], color[2], color[3]);
    gl->ClearDepth(frame->reversed_depth ? 0 : 1);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void plr_background_draw(plr_view *view, const plr_background *background, const plr_frame *frame,
                         const float behind[4]) {
    const plr_gl *gl = &view->engine->gl;
    clear(view, background->node, frame, behind);
    if (!background->pass.built)
        return;
    gl->Disable(GL_DEPTH_TEST);
    gl->DepthMask(GL_FALSE);
    gl->Disable(GL_CULL_FACE);
    gl->Disable(GL_BLEND);
    gl->UseProgram(background->pass.built->name);
    plr_values values = {.frame = frame, .to_world = background->to_world};
    plr_bind_set(gl, &view->textures, &background->pass.slots, &values);
    gl->BindVertexArray(view->empty_vertex_array);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}
