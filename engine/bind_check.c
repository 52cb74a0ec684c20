/* Whether the uniforms of a program and the fields of its effects fit together. No GL. */
#include <string.h>

#include "engine/bind_internal.h"
#include "engine/light_values.h"

static bool is_word(char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static bool text_has_word(const char *text, const char *word) {
    size_t length = strlen(word);
    for (const char *at = text; (at = strstr(at, word)); at++)
        if ((at == text || !is_word(at[-1])) && !is_word(at[length]))
            return true;
    return false;
}

static void warn_unused_fields(const plr_effect *effect, const plr_node *node, plr_diags *diags) {
    if (strcmp(plr_node_string(node, "uniformMissing"), "IGNORE") == 0)
        return;
    for (size_t i = 0; i < plr_node_field_count(node); i++) {
        const plr_field *field = plr_node_field_at(node, i);
        bool found = !field->declared;
        for (size_t s = 0; !found && s < effect->source_count; s++)
            found = text_has_word(plr_source_text(effect->sources[s], NULL), field->name);
        if (!found)
            plr_diags_add(diags, PLR_CODE_UNUSED_FIELD, field->place,
                          "no part of the effect has a uniform '%s'", field->name);
    }
}

/* Whether the textures in the field are of the kind that the sampler reads; reports the first that
 * is not. */
static bool check_textures(plr_kitchen *k, const plr_symbol *symbol, const plr_field *field,
                           const plr_glsl_type *type) {
    for (size_t i = 0; i < field->count && i < (symbol->array ? symbol->array : 1); i++) {
        const plr_node *node = field->value.nodes[i];
        const plr_texture *texture = node ? plr_textures_get(k->textures, node) : NULL;
        if (!node || (texture && (int)texture->kind == type->components))
            continue;
        if (texture)
            plr_diags_add(k->diags, PLR_CODE_UNIFORM_TYPE, field->place,
                          "the field '%s' holds a texture for %s, its uniform is %s", field->name,
                          plr_glsl_sampler_name(texture->kind), symbol->type);
        else
            plr_diags_add(k->diags, PLR_CODE_UNIFORM_TYPE, field->place,
                          "the field '%s' holds %s, which no sampler can read", field->name,
                          plr_node_type(node));
        plr_diags_note(k->diags, symbol->place, "the uniform is declared here");
        return false;
    }
    return true;
}

/* Whether the uniform fits; reports if not. */
static bool check_symbol(plr_kitchen *k, const plr_symbol *symbol, const plr_node *node) {
    plr_diags *diags = k->diags;
    const plr_field *field = plr_node_field(node, symbol->name);
    if (!field || !field->declared) {
        if (!symbol->initialized)
            plr_diags_add(diags, PLR_CODE_UNSET_UNIFORM, symbol->place,
                          "the effect has no field '%s' to set this uniform", symbol->name);
        return true;
    }
    const plr_glsl_type *type = plr_glsl_type_find(symbol->type);
    if (plr_field_fits(field, type, symbol->array != 0))
        return type->shape != SHAPE_SAMPLER || check_textures(k, symbol, field, type);
    plr_diags_add(diags, PLR_CODE_UNIFORM_TYPE, field->place,
                  "the field '%s' is %s, its uniform is %s%s", field->name,
                  plr_type_name(field->type), symbol->type, symbol->array ? "[]" : "");
    plr_diags_note(diags, symbol->place, "the uniform is declared here");
    return false;
}

bool plr_bind_check(plr_kitchen *k, plr_recipe *recipe, const plr_program *program) {
    bool again = false;
    for (size_t i = 0; i < plr_program_symbol_count(program); i++) {
        const plr_symbol *symbol = plr_program_symbol(program, i);
        const plr_binding *light;
        if (symbol->kind != PLR_UNIFORM || plr_light_value_find(recipe, symbol->name, &light))
            continue;
        if (symbol->effect == PLR_NO_EFFECT) {
            if (recipe->base_node && !plr_known_find(symbol->name, NULL))
                check_symbol(k, symbol, recipe->base_node);
            continue;
        }
        if (recipe->effects.items[symbol->effect].builtin)
            continue;
        if (!check_symbol(k, symbol, recipe->bindings.items[symbol->effect].node)) {
            recipe->effects.items[symbol->effect].disabled = true;
            again = true;
        }
    }
    for (size_t i = 0; !again && i < recipe->effects.count; i++) {
        const plr_effect *effect = &recipe->effects.items[i];
        if (!effect->builtin && !effect->disabled)
            warn_unused_fields(effect, recipe->bindings.items[i].node, k->diags);
    }
    return again;
}
