/* What plugray adds to an author's complete shader. */
#include <string.h>

#include "engine/surface.h"

static bool contains(const plr_source *source, const char *word) {
    size_t length, word_length = strlen(word);
    const char *text = plr_source_text(source, &length);
    for (size_t at = 0; at + word_length <= length; at++) {
        const char *next = memchr(text + at, *word, length - word_length - at + 1);
        if (!next)
            return false;
        at = (size_t)(next - text);
        if (memcmp(next, word, word_length) == 0)
            return true;
    }
    return false;
}

/* A complete shader takes textures if both of its stages say where declarations go. */
static bool says_declarations(const plr_recipe *recipe, plr_stage stage) {
    for (size_t i = 0; i < recipe->base.count; i++)
        if (plr_source_stage(recipe->base.items[i]) == stage &&
            contains(recipe->base.items[i], "PLUG-DECLARATIONS"))
            return true;
    return false;
}

static bool offers(const plr_recipe *recipe, plr_stage stage, const char *plug) {
    for (size_t i = 0; i < recipe->base.count; i++) {
        const plr_source *source = recipe->base.items[i];
        for (size_t j = 0; j < plr_source_plug_count(source); j++) {
            size_t length;
            const char *name = plr_source_plug(source, j, &length);
            if (plr_source_stage(source) == stage && strlen(plug) == length &&
                memcmp(name, plug, length) == 0)
                return true;
        }
    }
    return false;
}

void plr_shape_complete_surroundings(plr_shape *shape) {
    if (offers(shape->recipe, PLR_VERTEX, "vertex_eye_space") &&
        offers(shape->recipe, PLR_FRAGMENT, "fog_apply"))
        plr_shape_complete_fog(shape);
}

/* Coordinates also where the shader offers no place for colours: it may read castle_TexCoord0. */
void plr_shape_complete_textures(plr_shape *shape) {
    const plr_recipe *recipe = shape->recipe;
    if (!says_declarations(recipe, PLR_VERTEX) || !says_declarations(recipe, PLR_FRAGMENT) ||
        !offers(recipe, PLR_VERTEX, "vertex_eye_space"))
        return;
    bool named = offers(recipe, PLR_FRAGMENT, "main_texture_apply");
    plr_define old_name = plr_shape_define(shape, "OLD_NAME", !named);
    plr_shape_effect(shape, "surface/ComposedShader", "ComposedShader", NULL, 0, &old_name, 1);
    plr_shape_textures(shape);
}
