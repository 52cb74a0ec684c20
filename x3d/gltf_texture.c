/* Textures, images and samplers: ISO/IEC 12113 3.8. */
#include "x3d/gltf_internal.h"

#include <string.h>

/* ---- Images ---- */

static const char base64[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/* Writes 4 characters for each 3 bytes begun. */
static size_t encode(const char *data, size_t length, char *out) {
    const unsigned char *bytes = (const unsigned char *)data;
    size_t used = 0;
    for (size_t i = 0; i < length; i += 3) {
        size_t here = length - i < 3 ? length - i : 3;
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; k++)
            bits = bits << 8 | (k < here ? bytes[i + k] : 0U);
        for (size_t k = 0; k < 4; k++)
            out[used++] = k <= here ? base64[bits >> (18 - 6 * k) & 63] : '=';
    }
    return used;
}

/* An image among the data of the file becomes what X3D has for that: a data: url. */
static plr_string *url_of_view(gltf *g, const x3d_json *image) {
    const gltf_view *view = gltf_view_of(g, image, "bufferView");
    const x3d_json *type = gltf_text(g, image, "mimeType");
    size_t type_length = type && type->count < 64 ? type->count : 0;
    if (!view || !gltf_afford(g, image, view->length / 3 + 1, 1))
        return NULL;
    char *text = plr_arena_alloc(&g->scene->arena, type_length + (view->length + 2) / 3 * 4 + 32);
    size_t length = 5;
    memcpy(text, "data:", 5);
    if (type_length)
        memcpy(text + length, type->value.text, type_length);
    length += type_length;
    memcpy(text + length, ";base64,", 8);
    length += 8;
    length += encode(view->data, view->length, text + length);
    plr_place place = gltf_place(g, image);
    plr_string *url = PLR_NEW(g->scratch, plr_string);
    *url = (plr_string){text, length, {place.file, place.line, place.column, NULL, 0}};
    return url;
}

static plr_string *url_of_image(gltf *g, const x3d_json *image) {
    const x3d_json *uri = gltf_text(g, image, "uri");
    if (uri) {
        plr_string *url = PLR_NEW(g->scratch, plr_string);
        *url = gltf_url(g, uri);
        return url;
    }
    if (x3d_json_member(image, "bufferView"))
        return url_of_view(g, image);
    x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, image),
               "the image has neither a uri nor a bufferView");
    return NULL;
}

/* ---- Samplers ---- */

typedef struct word {
    size_t code;
    const char *text;
    bool special; /* differs from what X3D does by itself */
} word;

static const word wraps[] = {{10497, "REPEAT", false},
                             {33071, "CLAMP_TO_EDGE", false}, /* as repeatS FALSE */
                             {33648, "MIRRORED_REPEAT", true},
                             {0, NULL, false}};
static const word enlarging[] = {
    {9728, "NEAREST_PIXEL", true}, {9729, "AVG_PIXEL", true}, {0, NULL, false}};
static const word reducing[] = {{9728, "NEAREST_PIXEL", true},
                                {9729, "AVG_PIXEL", true},
                                {9984, "NEAREST_PIXEL_NEAREST_MIPMAP", true},
                                {9985, "AVG_PIXEL_NEAREST_MIPMAP", true},
                                {9986, "NEAREST_PIXEL_AVG_MIPMAP", true},
                                {9987, "AVG_PIXEL_AVG_MIPMAP", true},
                                {0, NULL, false}};

static const word *word_of(gltf *g, const x3d_json *sampler, const char *key, const word *words,
                           const word *missing) {
    size_t code;
    if (!x3d_json_member(sampler, key) || !gltf_size(g, sampler, key, 0, &code))
        return missing;
    for (const word *w = words; w->text; w++)
        if (w->code == code)
            return w;
    x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, x3d_json_member(sampler, key)),
               "%zu is no value of '%s'", code, key);
    return missing;
}

static void set_word(gltf *g, plr_node *node, const char *field, const word *w,
                     const x3d_json *from) {
    gltf_set_string(g, node, field, w->text, strlen(w->text), from);
}

static void set_sampler(gltf *g, plr_node *texture, const x3d_json *sampler) {
    static const word unsaid = {0, "DEFAULT", false};
    const word *s = word_of(g, sampler, "wrapS", wraps, &wraps[0]);
    const word *t = word_of(g, sampler, "wrapT", wraps, &wraps[0]);
    const word *larger = word_of(g, sampler, "magFilter", enlarging, &unsaid);
    const word *smaller = word_of(g, sampler, "minFilter", reducing, &unsaid);
    if (s->code == 33071)
        gltf_set_bool(g, texture, "repeatS", false);
    if (t->code == 33071)
        gltf_set_bool(g, texture, "repeatT", false);
    if (!s->special && !t->special && !larger->special && !smaller->special)
        return;
    plr_node *properties = gltf_node(g, "TextureProperties", sampler);
    set_word(g, properties, "boundaryModeS", s, sampler);
    set_word(g, properties, "boundaryModeT", t, sampler);
    set_word(g, properties, "magnificationFilter", larger, sampler);
    set_word(g, properties, "minificationFilter", smaller, sampler);
    gltf_set_bool(g, properties, "generateMipMaps", smaller->code == 0 || smaller->code >= 9984);
    gltf_add_node(g, texture, "textureProperties", properties);
}

/* ---- Textures ---- */

static plr_node *read_texture(gltf *g, const x3d_json *json) {
    size_t image_index, sampler_index;
    const x3d_json *image = gltf_refer(g, json, "source", GLTF_IMAGES, &image_index);
    const x3d_json *sampler = gltf_refer(g, json, "sampler", GLTF_SAMPLERS, &sampler_index);
    if (!image) {
        if (!x3d_json_member(json, "source") && !gltf_needs_unknown(g, json))
            x3d_report(g->scene, PLR_CODE_NOT_DRAWN, gltf_place(g, json),
                       "the texture has no image of a kind that plugray reads");
        return NULL;
    }
    void **made = gltf_made(g, "image %zu", image_index);
    plr_string *url = *made ? *made : url_of_image(g, image);
    *made = url;
    if (!url)
        return NULL;
    plr_node *node = gltf_node(g, "ImageTexture", json);
    gltf_set_string(g, node, "url", url->text, url->length, json);
    if (node) /* relative to this file, reported where it stands */
        ((plr_string *)(uintptr_t)plr_node_field(node, "url")->value.strings)->origin = url->origin;
    if (sampler)
        set_sampler(g, node, sampler);
    gltf_define_later(g, node, x3d_json_member(json, "name") ? json : image);
    return node;
}

plr_node *gltf_texture(gltf *g, const x3d_json *reference) {
    size_t index;
    const x3d_json *json = gltf_refer(g, reference, "index", GLTF_TEXTURES, &index);
    if (!json) {
        if (!x3d_json_member(reference, "index"))
            x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, reference),
                       "the index of a texture is missing");
        return NULL;
    }
    void **made = gltf_made(g, "texture %zu", index);
    if (!*made)
        *made = read_texture(g, json);
    return *made;
}
