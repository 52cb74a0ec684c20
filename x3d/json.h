/* JSON as a tree in which every value knows where it stands. */
#ifndef PLR_X3D_JSON_H
#define PLR_X3D_JSON_H

#include "base/arena.h"

typedef enum x3d_json_kind {
    X3D_JSON_NULL,
    X3D_JSON_BOOL,
    X3D_JSON_NUMBER,
    X3D_JSON_STRING,
    X3D_JSON_ARRAY,
    X3D_JSON_OBJECT
} x3d_json_kind;

typedef struct x3d_json {
    x3d_json_kind kind;
    const char *key; /* of a member of an object: not NUL-terminated */
    size_t key_length;
    size_t offset; /* of the value in the text */
    size_t count;  /* of items, members or bytes of a string */
    union {
        bool truth;
        double number;                /* infinite where a double is too small for it */
        const char *text;             /* of a string: decoded UTF-8, not NUL-terminated */
        const struct x3d_json *items; /* of an array; the members of an object, in order */
    } value;
} x3d_json;

/* Where and why a text is no JSON. */
typedef struct x3d_json_fault {
    const char *message; /* in the arena */
    size_t offset;
    bool limit; /* it may be JSON, but is too deep or has too many values */
} x3d_json_fault;

typedef struct x3d_json_limits {
    size_t depth, values;
} x3d_json_limits;

/* Reads RFC 8259 JSON. The tree lies in the arena; strings may point into the text. NULL: it is
 * none. */
const x3d_json *x3d_json_parse(plr_arena *arena, const char *text, size_t length,
                               x3d_json_limits limits, x3d_json_fault *fault);
/* A member of an object by name, the first one; NULL: there is none, or `object` is no object. */
const x3d_json *x3d_json_member(const x3d_json *object, const char *key);
bool x3d_json_is(const x3d_json *string, const char *text);

#endif
