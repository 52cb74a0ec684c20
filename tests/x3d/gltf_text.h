/* glTF documents for tests: a body, and bytes that become its only buffer. */
#ifndef TESTS_X3D_GLTF_TEXT_H
#define TESTS_X3D_GLTF_TEXT_H

#include <stdint.h>

#include "checks.h"

/* Bytes that grow: values are written as the machine has them, which is little-endian. */
typedef struct bytes {
    unsigned char data[4096];
    size_t length;
} bytes;

static inline void put(bytes *b, const void *data, size_t length) {
    if (length <= sizeof b->data - b->length) {
        memcpy(b->data + b->length, data, length);
        b->length += length;
    }
}
#define PUT_FLOATS(b, ...) put((b), (float[]){__VA_ARGS__}, sizeof((float[]){__VA_ARGS__}))
#define PUT_BYTES(b, ...) put((b), (uint8_t[]){__VA_ARGS__}, sizeof((uint8_t[]){__VA_ARGS__}))
#define PUT_SHORTS(b, ...) put((b), (uint16_t[]){__VA_ARGS__}, sizeof((uint16_t[]){__VA_ARGS__}))
#define PUT_INTS(b, ...) put((b), (uint32_t[]){__VA_ARGS__}, sizeof((uint32_t[]){__VA_ARGS__}))

/* malloc'ed: line 1 holds the buffer, the body begins at line 2, column 1. */
static inline char *gltf_text(const bytes *b, const char *body) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char code[sizeof b->data * 2] = "";
    size_t length = b ? b->length : 0, used = 0;
    for (size_t i = 0; i < length; i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; k++)
            bits = bits << 8 | (i + k < length ? b->data[i + k] : 0U);
        for (size_t k = 0; k < 4; k++)
            code[used++] = i + k <= length ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    code[used] = '\0';
    size_t size = used + strlen(body) + 200;
    char *text = malloc(size);
    snprintf(text, size,
             "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":%zu,"
             "\"uri\":\"data:application/octet-stream;base64,%s\"}],\n%s}",
             length, code, body);
    return text;
}

/* JSON in C is easier to read with ' for ". */
static inline char *quoted(const char *text) {
    char *copy = malloc(strlen(text) + 1), *out = copy;
    for (const char *p = text; *p; p++)
        *out++ = *p == '\'' ? '"' : *p;
    *out = '\0';
    return copy;
}

/* Reads a body over some bytes; checks the faults, and the graph if `graph` is not NULL. */
static inline plr_scene *check_body(const char *what, const bytes *b, const char *body,
                                    const char *faults, const char *graph) {
    char *json = quoted(body), *text = gltf_text(b, json);
    plr_scene *scene = check_faults(what, text, faults);
    if (graph)
        check_graph(what, scene, graph);
    free(json);
    free(text);
    return scene;
}

static inline void check_gltf(const char *what, const bytes *b, const char *body,
                              const char *faults, const char *graph) {
    plr_scene *scene = check_body(what, b, body, faults, graph);
    plr_scene_destroy(&scene);
}

/* The first node of a type, the outermost first, or NULL. */
static inline const plr_node *first_below(const plr_node *node, const char *type) {
    if (plr_node_is(node, type))
        return node;
    for (size_t i = 0; i < plr_node_field_count(node); i++) {
        const plr_field *field = plr_node_field_at(node, i);
        for (size_t k = 0; plr_type_kind(field->type) == PLR_NODE && k < field->count; k++) {
            const plr_node *found = first_below(field->value.nodes[k], type);
            if (found)
                return found;
        }
    }
    return NULL;
}

static inline const plr_node *first_of(const plr_scene *scene, const char *type) {
    const plr_node *found = NULL;
    for (size_t i = 0; !found && i < plr_scene_root_count(scene); i++)
        found = first_below(plr_scene_root(scene, i), type);
    TAP_RESULT(found != NULL, "there is a %s", type);
    return found;
}

/* Whether a field holds just these numbers. */
static inline void check_numbers(const plr_node *node, const char *name, const double *expected,
                                 size_t count) {
    const plr_field *field = node ? plr_node_field(node, name) : NULL;
    size_t there = field ? field->count * (size_t)plr_type_components(field->type) : 0;
    int same = there == count;
    for (size_t i = 0; same && i < count; i++) {
        double value = plr_type_kind(field->type) == PLR_INT ? field->value.ints[i]
                                                             : (double)field->value.floats[i];
        double difference = value - expected[i];
        same = difference > -1e-6 && difference < 1e-6;
    }
    TAP_RESULT(same, "%s.%s has %zu numbers as expected", node ? plr_node_type(node) : "-", name,
               count);
    for (size_t i = 0; !same && i < there; i++)
        printf("#   %g\n", plr_type_kind(field->type) == PLR_INT ? field->value.ints[i]
                                                                 : (double)field->value.floats[i]);
}
#define CHECK_NUMBERS(node, name, ...)                                                             \
    check_numbers((node), (name), (double[]){__VA_ARGS__},                                         \
                  sizeof((double[]){__VA_ARGS__}) / sizeof(double))

#endif
