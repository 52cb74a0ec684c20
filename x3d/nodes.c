#include "x3d/nodes.h"

#include <math.h>
#include <string.h>

enum {
    STANDARD = 0,
    EXTENSION = 1,
    DIALECT_2005 = 2,
    AUTHOR_FIELDS = 4
};
enum {
    ACCESS_I = PLR_INITIALIZE_ONLY,
    ACCESS_IN = PLR_INPUT_ONLY,
    ACCESS_OUT = PLR_OUTPUT_ONLY,
    ACCESS_IO = PLR_INPUT_OUTPUT
};

/* minimum, maximum, exclusive_minimum, exclusive_maximum */
#define ANY -INFINITY, INFINITY, false, false
#define GE(a) a, INFINITY, false, false
#define GT(a) a, INFINITY, true, false
#define LE(a) -INFINITY, a, false, false
#define LT(a) -INFINITY, a, false, true
#define BETWEEN(a, b) a, b, false, false
#define GE_LT(a, b) a, b, false, true
#define GT_LE(a, b) a, b, true, false
#define GT_LT(a, b) a, b, true, true
#define NODES(types) types

/* All fields of all nodes, one after the other. */
#define NODE(name, component, bases, container, flags)
#define FIELD(name, type, access, initial, range, nodes, flags)                                    \
    {#name, PLR_##type, (plr_access)ACCESS_##access, initial,                                      \
     range, nodes,      ((flags)&EXTENSION) != 0,    ((flags)&DIALECT_2005) != 0},
#define END_NODE
#define ALIAS(alias, name, flags)
#define FIELD_ALIAS(node, alias, field, flags)
#define DEFAULT_2005(node, field, initial)
#define DEFAULT_2005_FROM(node, field, other)
static const plr_field_info fields[] = {
#include "x3d/nodes.def"
};
#undef NODE
#undef FIELD
#undef END_NODE

/* How many fields each node has, then which is its first: enumerators count by themselves. */
#define NODE(name, component, bases, container, flags) COUNT_##name = 0
#define FIELD(name, type, access, initial, range, nodes, flags) +1
#define END_NODE ,
enum {
#include "x3d/nodes.def"
};
#undef NODE
#undef FIELD
#undef END_NODE
#define NODE(name, component, bases, container, flags)                                             \
    FIRST_##name, LAST_##name = FIRST_##name + COUNT_##name - 1,
#define FIELD(name, type, access, initial, range, nodes, flags)
#define END_NODE
enum {
#include "x3d/nodes.def"
};
#undef NODE

#define NODE(name, component, bases, container, flags)                                             \
    {#name,                                                                                        \
     component,                                                                                    \
     bases,                                                                                        \
     container,                                                                                    \
     fields + FIRST_##name,                                                                        \
     COUNT_##name,                                                                                 \
     ((flags)&AUTHOR_FIELDS) != 0,                                                                 \
     ((flags)&EXTENSION) != 0,                                                                     \
     ((flags)&DIALECT_2005) != 0},
static const plr_node_info nodes[] = {
#include "x3d/nodes.def"
};
#undef NODE
#undef ALIAS
#undef FIELD_ALIAS

#define NODE(name, component, bases, container, flags)
#define ALIAS(alias, name, flags) {NULL, #alias, #name, ((flags)&DIALECT_2005) != 0},
#define FIELD_ALIAS(node, alias, field, flags)
static const x3d_alias node_aliases[] = {
#include "x3d/nodes.def"
    {NULL, NULL, NULL, false}};
#undef ALIAS
#undef FIELD_ALIAS

#define ALIAS(alias, name, flags)
#define FIELD_ALIAS(node, alias, field, flags) {#node, #alias, #field, ((flags)&DIALECT_2005) != 0},
static const x3d_alias field_aliases[] = {
#include "x3d/nodes.def"
    {NULL, NULL, NULL, false}};
#undef FIELD_ALIAS
#undef DEFAULT_2005
#undef DEFAULT_2005_FROM

#define FIELD_ALIAS(node, alias, field, flags)
#define DEFAULT_2005(node, field, initial) {#node, #field, initial, NULL},
#define DEFAULT_2005_FROM(node, field, other) {#node, #field, NULL, #other},
static const x3d_default_2005 defaults_2005[] = {
#include "x3d/nodes.def"
    {NULL, NULL, NULL, NULL}};

const x3d_alias *x3d_node_aliases(void) {
    return node_aliases;
}
const x3d_alias *x3d_field_aliases(void) {
    return field_aliases;
}

const x3d_default_2005 *x3d_defaults_2005(void) {
    return defaults_2005;
}

size_t plr_node_info_count(void) {
    return sizeof nodes / sizeof *nodes;
}

const plr_node_info *plr_node_info_at(size_t index) {
    return index < plr_node_info_count() ? &nodes[index] : NULL;
}

const plr_node_info *plr_node_info_find(const char *name) {
    for (size_t i = 0; i < plr_node_info_count(); i++)
        if (strcmp(nodes[i].name, name) == 0)
            return &nodes[i];
    for (const x3d_alias *alias = node_aliases; alias->alias; alias++)
        if (strcmp(alias->alias, name) == 0)
            return plr_node_info_find(alias->name);
    return NULL;
}

static bool lists(const char *list, const char *type, size_t length) {
    for (const char *p = list; *p;) {
        size_t n = strcspn(p, " ");
        if (n == length && memcmp(p, type, length) == 0)
            return true;
        p += n;
        p += strspn(p, " ");
    }
    return false;
}

static bool is_type(const plr_node_info *info, const char *type, size_t length) {
    return (strlen(info->name) == length && memcmp(info->name, type, length) == 0) ||
           lists(info->bases, type, length);
}

bool plr_node_info_is(const plr_node_info *info, const char *type) {
    return is_type(info, type, strlen(type));
}

bool x3d_allows(const plr_field_info *field, const plr_node_info *info) {
    if (!*field->nodes)
        return true;
    for (const char *p = field->nodes; *p;) {
        size_t n = strcspn(p, " ");
        if (is_type(info, p, n))
            return true;
        p += n;
        p += strspn(p, " ");
    }
    return false;
}

static const struct {
    const char *name;
    plr_kind kind;
    int components;
} types[] = {
#define PLR_TYPE(id, name, kind, components) {name, PLR_##kind, components},
    PLR_TYPES(PLR_TYPE)
#undef PLR_TYPE
};

const char *plr_type_name(plr_type type) {
    return (unsigned)type < PLR_TYPE_COUNT ? types[type].name : "";
}

plr_kind plr_type_kind(plr_type type) {
    return (unsigned)type < PLR_TYPE_COUNT ? types[type].kind : PLR_INT;
}

int plr_type_components(plr_type type) {
    return (unsigned)type < PLR_TYPE_COUNT ? types[type].components : 0;
}

bool plr_type_is_multiple(plr_type type) {
    return type >= PLR_MFBOOL && type < PLR_TYPE_COUNT;
}

bool x3d_type_of_name(const char *name, size_t length, plr_type *type) {
    for (int i = 0; i < PLR_TYPE_COUNT; i++)
        if (strlen(types[i].name) == length && memcmp(types[i].name, name, length) == 0) {
            *type = (plr_type)i;
            return true;
        }
    return false;
}
