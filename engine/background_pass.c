#include "engine/view.h"

#include <string.h>

/* ---- Pictures ---- */

static const char *const faces[] = {"front", "back", "left", "right", "top", "bottom"};

/* The picture behind the urls of a Background's field; NULL if there is none (then reported, if the
 * field is given). */
static plr_texture *load_urls(plr_view *view, const plr_field *urls) {
    plr_bytes bytes = {0};
    plr_image image = {0};
    size_t index;
    plr_diags *diags = view->textures.diags;
    if (!urls || !urls->count ||
        !plr_scene_load_first(view->scene, urls, true, &bytes, &index, diags))
        return NULL;
    bool fine = plr_image_decode(bytes.data, bytes.length, urls->place, &image, diags);
    plr_bytes_free(&bytes);
    if (fine && (image.depth > 1 || image.cube)) {
        plr_diags_add(diags, PLR_CODE_BAD_IMAGE, urls->place, "a background's side is one picture");
        plr_image_free(&image);
        fine = false;
    }
    return fine ? plr_textures_make(&view->textures, &image, PLR_TEXTURE_2D, false) : NULL;
}

/* The texture that the node has for itself; reports what cannot be drawn. */
static plr_texture *texture_of(plr_view *view, const plr_node *node) {
    plr_texture *texture = plr_textures_get(&view->textures, node);
    if (texture && texture->kind == PLR_TEXTURE_2D)
        return texture->failed ? NULL : texture;
    plr_diags_add(view->textures.diags, PLR_CODE_NOT_DRAWN, plr_node_place(node),
                  "%s is not drawn in backgrounds", plr_node_type(node));
    return NULL;
}

static void add_image(plr_view *view, plr_background *background, const char *path, plr_node *node,
                      plr_texture *texture, int face) {
    const plr_define extra[] = {
        {"FACE", plr_arena_format(&view->arena, "%d", face)},
        {"HAS_IMAGE", texture ? "1" : "0"},
    };
    plr_binding binding = {.node = node,
                           .to_world = background->to_world,
                           .place = &background->to_world,
                           .volume = PLR_NO_EFFECT,
                           .texture = texture};
    plr_recipe_builtin(&view->kitchen, &background->pass.recipe, path, plr_node_type(node), binding,
                       0, extra, sizeof extra / sizeof *extra);
}

/* Urls of a Background, or texture nodes of a TextureBackground. */
static void add_face(plr_view *view, plr_background *background, int face) {
    plr_node *node = background->node;
    const char *name = plr_arena_format(&view->arena, "%sTexture", faces[face]);
    plr_node *child = plr_node_child(node, name);
    const char *urls = plr_arena_format(&view->arena, "%sUrl", faces[face]);
    plr_texture *texture = child && !plr_node_is(child, "ShaderTexture") ? texture_of(view, child)
                           : child                                       ? NULL
                                   : load_urls(view, plr_node_field(node, urls));
    if (texture || (child && plr_node_is(child, "ShaderTexture")))
        add_image(view, background, "background/BackgroundFace", child ? child : node, texture,
                  face);
}

/* ---- The program ---- */

/* A background of one colour is a clear colour; all else needs a program. */
static bool is_plain(const plr_view *view, const plr_node *node) {
    const plr_field *sky = plr_node_field(node, "skyColor");
    const plr_field *ground = plr_node_field(node, "groundColor");
    const plr_field *effects = plr_node_field(node, "effects");
    bool plain = (!sky || sky->count < 2) && (!ground || !ground->count) &&
                 (!effects || !effects->count) && !plr_node_is(node, "ImageBackground");
    for (int face = 0; plain && face < 6; face++) {
        const plr_field *urls =
            plr_node_field(node, plr_arena_format(view->kitchen.arena, "%sUrl", faces[face]));
        const char *name = plr_arena_format(view->kitchen.arena, "%sTexture", faces[face]);
        plain = (!urls || !urls->count) && !plr_node_child(node, name);
    }
    return plain;
}

static void add_sky(plr_view *view, plr_background *background) {
    plr_kitchen *k = &view->kitchen;
    plr_binding binding = {.node = background->node,
                           .to_world = background->to_world,
                           .place = &background->to_world,
                           .volume = PLR_NO_EFFECT};
    plr_recipe_builtin(k, &background->pass.recipe, "background/Background",
                       plr_node_type(background->node), binding, 0, NULL, 0);
    for (int face = 0; face < 6; face++)
        add_face(view, background, face);
}

void plr_background_prepare(plr_view *view, plr_background *background) {
    plr_node *node = background->node;
    plr_pass *pass = &background->pass;
    if (!node || is_plain(view, node))
        return;
    plr_kitchen *k = &view->kitchen;
    const plr_field *ground = plr_node_field(node, "groundColor");
    pass->recipe = (plr_recipe){.base = *plr_catalog_units(k->catalog, "background/background")};
    plr_recipe_define(k, &pass->recipe, "HAS_GROUND", ground && ground->count > 0);
    if (plr_node_is(node, "ImageBackground")) {
        plr_node *texture = plr_node_child(node, "texture");
        add_image(view, background, "background/ImageBackground", node,
                  texture ? texture_of(view, texture) : NULL, 0);
    } else {
        add_sky(view, background);
    }
    plr_recipe_attached_authors(k, &pass->recipe, "X3DTextureNode");
    plr_recipe_author_list(k, &pass->recipe, node, 0, PLR_NO_EFFECT);
    pass->built = plr_compose_program(&view->composer, &pass->recipe, "background", &pass->program);
}

/* ---- Drawing ---- */

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
