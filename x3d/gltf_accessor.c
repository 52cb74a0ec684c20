/* Accessors: typed numbers in buffers, ISO/IEC 12113 3.6.2. Nothing of what a file says about
 * offsets, strides and counts is believed before it is checked against the bytes that are there. */
#include "x3d/gltf_internal.h"

#include <math.h>
#include <string.h>

struct gltf_component {
    unsigned code; /* componentType */
    unsigned size;
    bool is_signed, is_float;
    double largest; /* of a normalized integer: what stands for 1 */
};

static const gltf_component components[] = {
    {5120, 1, true, false, 127},    {5121, 1, false, false, 255}, {5122, 2, true, false, 32767},
    {5123, 2, false, false, 65535}, {5125, 4, false, false, 0},   {5126, 4, true, true, 0},
};

static const struct {
    const char *type;
    unsigned components;
} types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};

static const gltf_component *component_of(gltf *g, const x3d_json *json) {
    size_t code;
    if (!gltf_size(g, json, "componentType", 0, &code))
        return NULL;
    for (size_t i = 0; i < sizeof components / sizeof *components; i++)
        if (components[i].code == code)
            return &components[i];
    const x3d_json *found = x3d_json_member(json, "componentType");
    x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, found ? found : json),
               "%zu is no type of components", code);
    return NULL;
}

static unsigned components_of(gltf *g, const x3d_json *json) {
    const x3d_json *type = gltf_text(g, json, "type");
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (x3d_json_is(type, types[i].type))
            return types[i].components;
    x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, type ? type : json),
               "the accessor's type is none of SCALAR, VEC2, VEC3, VEC4");
    return 0;
}

/* Where `count` elements of `size` bytes begin in a view; NULL: they do not all lie in it. */
static const char *find_elements(gltf *g, const x3d_json *json, size_t count, size_t size,
                                 bool packed, size_t *stride) {
    size_t offset;
    const gltf_view *view = gltf_view_of(g, json, "bufferView");
    if (!view || !gltf_size(g, json, "byteOffset", 0, &offset))
        return NULL;
    *stride = view->stride && !packed ? view->stride : size;
    bool fits = *stride >= size && offset <= view->length && view->length - offset >= size &&
                count - 1 <= (view->length - offset - size) / *stride;
    if (fits)
        return view->data + offset;
    x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, json),
               "%zu elements of %zu bytes do not lie in their view, which has %zu bytes", count,
               size, view->length);
    return NULL;
}

static bool read_sparse(gltf *g, const x3d_json *sparse, gltf_accessor *a) {
    const x3d_json *indices = gltf_object(g, sparse, "indices");
    const x3d_json *values = gltf_object(g, sparse, "values");
    size_t count, stride;
    if (!gltf_size(g, sparse, "count", 0, &count))
        return false;
    if (!indices || !values || !count || count > a->count) {
        x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, sparse),
                   "a sparse accessor takes indices, values and a count of 1 to %zu", a->count);
        return false;
    }
    a->sparse_index = component_of(g, indices);
    if (!a->sparse_index)
        return false;
    if (a->sparse_index->is_signed) {
        x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, indices),
                   "indices are unsigned integers");
        return false;
    }
    a->sparse_indices = find_elements(g, indices, count, a->sparse_index->size, true, &stride);
    a->sparse_values =
        find_elements(g, values, count, a->component->size * a->components, true, &stride);
    a->sparse_count = count;
    return a->sparse_indices && a->sparse_values;
}

static bool read_accessor(gltf *g, const x3d_json *json, gltf_accessor *a) {
    const x3d_json *sparse = gltf_object(g, json, "sparse");
    a->json = json;
    a->component = component_of(g, json);
    a->components = components_of(g, json);
    a->normalized = gltf_bool(g, json, "normalized", false);
    if (!a->component || !a->components || !gltf_size(g, json, "count", 0, &a->count))
        return false;
    if (a->count < 1 || a->count > INT32_MAX) {
        x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, json),
                   "the accessor has a count of %zu", a->count);
        return false;
    }
    if (a->normalized && a->component->largest <= 0)
        a->normalized = false; /* the standard has no such thing; others read it as this */
    if (x3d_json_member(json, "bufferView")) {
        a->data =
            find_elements(g, json, a->count, a->component->size * a->components, false, &a->stride);
        if (!a->data)
            return false;
    }
    return !sparse || read_sparse(g, sparse, a);
}

const gltf_accessor *gltf_accessor_of(gltf *g, const x3d_json *reference, size_t *index) {
    const x3d_json *json = gltf_item(g, reference, GLTF_ACCESSORS, index);
    if (!json)
        return NULL;
    gltf_accessor *accessor = &g->accessors[*index];
    if (!accessor->read) {
        accessor->read = true;
        accessor->ok = read_accessor(g, json, accessor);
    }
    return accessor->ok ? accessor : NULL;
}

bool gltf_afford(gltf *g, const x3d_json *from, size_t count, size_t each) {
    size_t left = g->scene->max_memory - g->scene->used_memory;
    if (count <= g->budget / each && count <= left / 16 / each) {
        g->budget -= count * each;
        return true;
    }
    x3d_report(g->scene, PLR_CODE_LIMIT, gltf_place(g, from),
               "%zu elements more would be too much for a file of this size", count);
    return false;
}

/* ---- Numbers ---- */

static uint32_t bits_at(const char *at, unsigned size) {
    const unsigned char *bytes = (const unsigned char *)at; /* little-endian */
    uint32_t bits = 0;
    for (unsigned i = 0; i < size; i++)
        bits |= (uint32_t)bytes[i] << 8 * i;
    return bits;
}

static float number_at(const char *at, const gltf_component *type, bool normalized) {
    uint32_t bits = bits_at(at, type->size);
    if (type->is_float) {
        float number;
        memcpy(&number, &bits, sizeof number);
        return number;
    }
    double number = bits;
    if (type->is_signed && bits >> (8 * type->size - 1))
        number -= (double)(UINT64_C(1) << 8 * type->size);
    if (normalized)
        number = fmax(number / type->largest, -1);
    return (float)number;
}

static void read_element(const gltf_accessor *a, const char *from, float *to) {
    for (unsigned i = 0; i < a->components; i++)
        to[i] = number_at(from + (size_t)i * a->component->size, a->component, a->normalized);
}

static bool place_sparse(gltf *g, const gltf_accessor *a, float *numbers) {
    size_t size = (size_t)a->component->size * a->components;
    for (size_t i = 0; i < a->sparse_count; i++) {
        uint32_t index =
            bits_at(a->sparse_indices + i * a->sparse_index->size, a->sparse_index->size);
        if (index >= a->count) {
            x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, a->json),
                       "there is no element %u, only 0 to %zu", index, a->count - 1);
            return false;
        }
        read_element(a, a->sparse_values + i * size, numbers + (size_t)index * a->components);
    }
    return true;
}

float *gltf_floats(gltf *g, const gltf_accessor *a) {
    if (!gltf_afford(g, a->json, a->count, a->components))
        return NULL;
    size_t count = a->count * a->components;
    float *numbers = PLR_NEW_ARRAY(&g->scene->arena, count, float);
    for (size_t i = 0; a->data && i < a->count; i++)
        read_element(a, a->data + i * a->stride, numbers + i * a->components);
    if (!place_sparse(g, a, numbers))
        return NULL;
    for (size_t i = 0; i < count; i++)
        if (!isfinite(numbers[i])) {
            x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, a->json),
                       "element %zu of the accessor is not finite", i / a->components);
            return NULL;
        }
    return numbers;
}

bool gltf_integers(gltf *g, const gltf_accessor *a, gltf_indices *indices) {
    if (a->components != 1 || a->component->is_signed) {
        x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, a->json),
                   "indices are single unsigned integers");
        return false;
    }
    if (!gltf_afford(g, a->json, a->count, 1))
        return false;
    int32_t *items = PLR_NEW_ARRAY(&g->scene->arena, a->count, int32_t);
    for (size_t i = 0; a->data && i < a->count; i++) {
        uint32_t bits = bits_at(a->data + i * a->stride, a->component->size);
        items[i] = bits <= INT32_MAX ? (int32_t)bits : INT32_MAX;
    }
    for (size_t i = 0; i < a->sparse_count; i++) {
        size_t size = a->sparse_index->size;
        uint32_t index = bits_at(a->sparse_indices + i * size, (unsigned)size);
        uint32_t bits = bits_at(a->sparse_values + i * a->component->size, a->component->size);
        if (index < a->count)
            items[index] = bits <= INT32_MAX ? (int32_t)bits : INT32_MAX;
    }
    *indices = (gltf_indices){items, a->count, 0};
    for (size_t i = 0; i < a->count; i++)
        if (items[i] > indices->largest)
            indices->largest = items[i];
    return true;
}
