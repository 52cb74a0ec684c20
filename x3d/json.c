/* yajl reads; here its events become a tree. Its own memory lies in the arena too, so that a jump
 * out of a failed allocation leaves nothing behind. */
#include "x3d/json.h"

#include <stdalign.h>
#include <string.h>
#include <yajl/yajl_parse.h>

#include "x3d/text.h"

/* An array or object that is not closed yet. */
typedef struct level {
    x3d_json container;
    size_t first; /* of its items, in the list of pending values */
} level;

typedef struct parser {
    plr_arena *arena;
    yajl_handle yajl;
    const char *text;
    size_t length;
    size_t last_end; /* of the token before */
    x3d_json_limits limits;
    x3d_json_fault *fault;
    const char *key; /* of the next value */
    size_t key_length;
    struct {
        x3d_json *items;
        size_t count, capacity;
    } pending; /* finished values whose container is open */
    struct {
        level *items;
        size_t count, capacity;
    } levels;
    size_t value_count;
} parser;

/* ---- Memory for yajl ---- */

typedef struct chunk {
    size_t size;
    alignas(max_align_t) char data[];
} chunk;

static void *yajl_new(void *user, size_t size) {
    parser *p = user;
    chunk *made = plr_arena_alloc(p->arena, sizeof *made + size);
    made->size = size;
    return made->data;
}

static void *yajl_resize(void *user, void *data, size_t size) {
    if (!data)
        return yajl_new(user, size);
    const chunk *old = (const chunk *)(void *)((char *)data - offsetof(chunk, data));
    if (size <= old->size)
        return data;
    return memcpy(yajl_new(user, size), data, old->size);
}

static void yajl_forget(void *user, void *data) {
    (void)user;
    (void)data;
}

/* ---- Events ---- */

/* Where the next token begins: behind the one before and what may stand between them. */
static size_t next_start(const parser *p) {
    size_t at = p->last_end;
    while (at < p->length && p->text[at] && strchr(" \t\r\n,:", p->text[at]))
        at++;
    return at;
}

/* Where the token begins that yajl has just read. */
static size_t token_start(parser *p) {
    size_t at = next_start(p);
    p->last_end = yajl_get_bytes_consumed(p->yajl);
    return at;
}

static int too_much(parser *p, size_t offset, const char *message) {
    *p->fault = (x3d_json_fault){message, offset, true};
    return 0;
}

static x3d_json *add(parser *p, x3d_json_kind kind) {
    x3d_json *value = PLR_PUSH(p->arena, &p->pending);
    *value = (x3d_json){
        .kind = kind, .key = p->key, .key_length = p->key_length, .offset = token_start(p)};
    p->key = NULL;
    p->key_length = 0;
    return ++p->value_count > p->limits.values ? NULL : value;
}

static int too_many(parser *p) {
    return too_much(p, p->last_end, "the JSON has more values than plugray reads");
}

/* Text that yajl has decoded lies in memory that it uses again; the rest is in the file. */
static const char *keep(parser *p, const char *text, size_t length) {
    uintptr_t start = (uintptr_t)p->text, at = (uintptr_t)text;
    return at >= start && at - start <= p->length ? text : plr_arena_copy(p->arena, text, length);
}

static int on_null(void *user) {
    return add(user, X3D_JSON_NULL) ? 1 : too_many(user);
}

static int on_bool(void *user, int truth) {
    x3d_json *value = add(user, X3D_JSON_BOOL);
    if (!value)
        return too_many(user);
    value->value.truth = truth != 0;
    return 1;
}

static int on_number(void *user, const char *text, size_t length) {
    x3d_json *value = add(user, X3D_JSON_NUMBER);
    if (!value)
        return too_many(user);
    x3d_parse_number(text, length, &value->value.number);
    return 1;
}

static int on_string(void *user, const unsigned char *text, size_t length) {
    x3d_json *value = add(user, X3D_JSON_STRING);
    if (!value)
        return too_many(user);
    value->value.text = keep(user, (const char *)text, length);
    value->count = length;
    return 1;
}

static int on_key(void *user, const unsigned char *text, size_t length) {
    parser *p = user;
    p->last_end = yajl_get_bytes_consumed(p->yajl);
    p->key = keep(p, (const char *)text, length);
    p->key_length = length;
    return 1;
}

static int open_level(parser *p, x3d_json_kind kind) {
    x3d_json *value = add(p, kind);
    if (!value)
        return too_many(p);
    if (p->levels.count >= p->limits.depth)
        return too_much(p, value->offset, "the JSON is nested deeper than plugray reads");
    p->pending.count--; /* it comes back when it is closed */
    *PLR_PUSH(p->arena, &p->levels) = (level){*value, p->pending.count};
    return 1;
}

static int close_level(parser *p) {
    p->last_end = yajl_get_bytes_consumed(p->yajl);
    const level *closed = &p->levels.items[--p->levels.count];
    x3d_json container = closed->container;
    container.count = p->pending.count - closed->first;
    x3d_json *items = PLR_NEW_ARRAY(p->arena, container.count, x3d_json);
    if (container.count)
        memcpy(items, p->pending.items + closed->first, container.count * sizeof *items);
    container.value.items = items;
    p->pending.count = closed->first;
    *PLR_PUSH(p->arena, &p->pending) = container;
    return 1;
}

static int on_object(void *user) {
    return open_level(user, X3D_JSON_OBJECT);
}
static int on_array(void *user) {
    return open_level(user, X3D_JSON_ARRAY);
}
static int on_end(void *user) {
    return close_level(user);
}

static const yajl_callbacks events = {.yajl_null = on_null,
                                      .yajl_boolean = on_bool,
                                      .yajl_number = on_number,
                                      .yajl_string = on_string,
                                      .yajl_start_map = on_object,
                                      .yajl_map_key = on_key,
                                      .yajl_end_map = on_end,
                                      .yajl_start_array = on_array,
                                      .yajl_end_array = on_end};

/* yajl's own words, which end with a newline. It has passed the token at fault, or in a string the
 * byte. */
static void report_fault(parser *p) {
    if (p->fault->message)
        return;
    const char *text = (const char *)yajl_get_error(p->yajl, 0, NULL, 0);
    size_t passed = yajl_get_bytes_consumed(p->yajl);
    bool in_string = strstr(text, "inside") || strstr(text, "UTF8");
    p->fault->message = plr_arena_copy(p->arena, text, strcspn(text, "\n"));
    p->fault->offset = strstr(text, "premature")                    ? p->length
                       : in_string && passed && passed <= p->length ? passed - 1
                                                                    : next_start(p);
}

const x3d_json *x3d_json_parse(plr_arena *arena, const char *text, size_t length,
                               x3d_json_limits limits, x3d_json_fault *fault) {
    parser p = {.arena = arena, .text = text, .length = length, .limits = limits, .fault = fault};
    yajl_alloc_funcs memory = {yajl_new, yajl_resize, yajl_forget, &p};
    *fault = (x3d_json_fault){0};
    p.yajl = yajl_alloc(&events, &memory, &p);
    if (yajl_parse(p.yajl, (const unsigned char *)text, length) != yajl_status_ok ||
        yajl_complete_parse(p.yajl) != yajl_status_ok) {
        report_fault(&p);
        return NULL;
    }
    return &p.pending.items[0];
}

const x3d_json *x3d_json_member(const x3d_json *object, const char *key) {
    size_t length = strlen(key);
    if (!object || object->kind != X3D_JSON_OBJECT)
        return NULL;
    for (size_t i = 0; i < object->count; i++) {
        const x3d_json *member = &object->value.items[i];
        if (member->key_length == length && memcmp(member->key, key, length) == 0)
            return member;
    }
    return NULL;
}

bool x3d_json_is(const x3d_json *string, const char *text) {
    return string && string->kind == X3D_JSON_STRING && string->count == strlen(text) &&
           memcmp(string->value.text, text, string->count) == 0;
}
