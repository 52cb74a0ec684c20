/* The document, value by value. */
#include "x3d/gltf_internal.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const char *const kinds[] = {"null",     "a truth value", "a number",
                                    "a string", "an array",      "an object"};

static const char *const table_names[GLTF_TABLES] = {
    [GLTF_ACCESSORS] = "accessors", [GLTF_BUFFERS] = "buffers", [GLTF_VIEWS] = "bufferViews",
    [GLTF_CAMERAS] = "cameras",     [GLTF_IMAGES] = "images",   [GLTF_LIGHTS] = "lights",
    [GLTF_MATERIALS] = "materials", [GLTF_MESHES] = "meshes",   [GLTF_NODES] = "nodes",
    [GLTF_SAMPLERS] = "samplers",   [GLTF_SCENES] = "scenes",   [GLTF_TEXTURES] = "textures"};

plr_place gltf_place(gltf *g, const x3d_json *value) {
    return x3d_file_place(g->build->file, value->offset);
}

size_t gltf_table_count(const gltf *g, gltf_table table) {
    return g->tables[table] ? g->tables[table]->count : 0;
}

const char *gltf_table_name(gltf_table table) {
    return table_names[table];
}

void gltf_find_tables(gltf *g) {
    for (int i = 0; i < GLTF_TABLES; i++) {
        const x3d_json *owner =
            i == GLTF_LIGHTS ? gltf_extension(g, g->root, "KHR_lights_punctual") : g->root;
        g->tables[i] = gltf_list(g, owner, table_names[i]);
    }
}

/* ---- Members ---- */

static const x3d_json *member(gltf *g, const x3d_json *object, const char *key,
                              x3d_json_kind kind) {
    const x3d_json *found = x3d_json_member(object, key);
    if (!found || found->kind == kind)
        return found;
    x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, found), "'%s' is %s, not %s", key,
               kinds[kind], kinds[found->kind]);
    return NULL;
}

const x3d_json *gltf_object(gltf *g, const x3d_json *object, const char *key) {
    return member(g, object, key, X3D_JSON_OBJECT);
}

const x3d_json *gltf_list(gltf *g, const x3d_json *object, const char *key) {
    return member(g, object, key, X3D_JSON_ARRAY);
}

const x3d_json *gltf_text(gltf *g, const x3d_json *object, const char *key) {
    return member(g, object, key, X3D_JSON_STRING);
}

const x3d_json *gltf_extension(gltf *g, const x3d_json *object, const char *name) {
    const x3d_json *extensions = x3d_json_member(object, "extensions");
    return extensions ? gltf_object(g, gltf_object(g, object, "extensions"), name) : NULL;
}

bool gltf_bool(gltf *g, const x3d_json *object, const char *key, bool missing) {
    const x3d_json *found = member(g, object, key, X3D_JSON_BOOL);
    return found ? found->value.truth : missing;
}

/* Fields hold floats. */
static bool fits(const x3d_json *number) {
    return fabs(number->value.number) <= (double)FLT_MAX;
}

double gltf_number(gltf *g, const x3d_json *object, const char *key, double missing) {
    const x3d_json *found = member(g, object, key, X3D_JSON_NUMBER);
    if (!found || fits(found))
        return found ? found->value.number : missing;
    x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, found), "'%s' is too large", key);
    return missing;
}

double gltf_between(gltf *g, const x3d_json *object, const char *key, double missing, double least,
                    double most) {
    double number = gltf_number(g, object, key, missing);
    if (number >= least && number <= most)
        return number;
    x3d_report(g->scene, PLR_CODE_BAD_RANGE, gltf_place(g, x3d_json_member(object, key)),
               "'%s' is %g, outside %g to %g", key, number, least, most);
    return number < least ? least : most;
}

bool gltf_numbers(gltf *g, const x3d_json *object, const char *key, double *numbers, size_t count) {
    const x3d_json *list = gltf_list(g, object, key);
    if (!list)
        return false;
    bool fine = list->count == count;
    for (size_t i = 0; fine && i < count; i++)
        fine = list->value.items[i].kind == X3D_JSON_NUMBER && fits(&list->value.items[i]);
    if (!fine) {
        x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, list), "'%s' takes %zu numbers", key,
                   count);
        return false;
    }
    for (size_t i = 0; i < count; i++)
        numbers[i] = list->value.items[i].value.number;
    return true;
}

/* Integers are exact up to here. */
static bool is_size(const x3d_json *value) {
    double number = value->kind == X3D_JSON_NUMBER ? value->value.number : -1;
    return number >= 0 && number <= 9007199254740992.0 && floor(number) == number;
}

bool gltf_size(gltf *g, const x3d_json *object, const char *key, size_t missing, size_t *size) {
    const x3d_json *found = x3d_json_member(object, key);
    *size = missing;
    if (!found)
        return true;
    if (is_size(found)) {
        *size = (size_t)found->value.number;
        return true;
    }
    x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, found),
               "'%s' is an integer that is not negative", key);
    return false;
}

/* ---- References ---- */

const x3d_json *gltf_item(gltf *g, const x3d_json *reference, gltf_table table, size_t *index) {
    size_t count = gltf_table_count(g, table);
    if (!is_size(reference) || reference->value.number >= (double)count) {
        x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, reference),
                   "this refers to one of %zu %s", count, table_names[table]);
        return NULL;
    }
    *index = (size_t)reference->value.number;
    const x3d_json *item = &g->tables[table]->value.items[*index];
    if (item->kind == X3D_JSON_OBJECT)
        return item;
    x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, item), "%s[%zu] is an object, not %s",
               table_names[table], *index, kinds[item->kind]);
    return NULL;
}

const x3d_json *gltf_refer(gltf *g, const x3d_json *object, const char *key, gltf_table table,
                           size_t *index) {
    const x3d_json *reference = x3d_json_member(object, key);
    return reference ? gltf_item(g, reference, table, index) : NULL;
}

bool gltf_needs_unknown(gltf *g, const x3d_json *object) {
    const x3d_json *extensions = g->unknown ? gltf_object(g, object, "extensions") : NULL;
    for (size_t i = 0; extensions && i < g->unknown->count; i++) {
        const x3d_json *name = &g->unknown->value.items[i];
        for (size_t k = 0; k < extensions->count; k++) {
            const x3d_json *used = &extensions->value.items[k];
            if (used->key_length == name->count &&
                memcmp(used->key, name->value.text, name->count) == 0)
                return true;
        }
    }
    return false;
}
