/* The table of nodes, as the reader uses it. */
#ifndef PLR_X3D_NODES_H
#define PLR_X3D_NODES_H

#include <plugray/x3d.h>

/* Another name of a node (node NULL) or of a field of `node`. */
typedef struct x3d_alias {
    const char *node, *alias, *name;
    bool dialect_2005;
} x3d_alias;

/* What a field is in the dialect of 2005 where it is not given. */
typedef struct x3d_default_2005 {
    const char *node, *field;
    const char *initial; /* in Classic VRML notation, or NULL: */
    const char *from;    /* the field whose value it takes */
} x3d_default_2005;

/* Ends with a node of NULL. */
const x3d_default_2005 *x3d_defaults_2005(void);
/* Both end with an alias of NULL. */
const x3d_alias *x3d_node_aliases(void);
const x3d_alias *x3d_field_aliases(void);
/* Whether the field takes a node of this type. */
bool x3d_allows(const plr_field_info *field, const plr_node_info *info);
bool x3d_type_of_name(const char *name, size_t length, plr_type *type);

#endif
