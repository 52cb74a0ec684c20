/* The table of nodes, as the reader uses it. */
#ifndef PLR_X3D_NODES_H
#define PLR_X3D_NODES_H

#include <plugray/x3d.h>

/* Another name of a node (node NULL) or of a field of `node`. */
typedef struct x3d_alias {
    const char *node, *alias, *name;
    bool dialect_2005;
} x3d_alias;

/* Both end with an alias of NULL. */
const x3d_alias *x3d_node_aliases(void);
const x3d_alias *x3d_field_aliases(void);
/* Whether the field takes a node of this type. */
bool x3d_allows(const plr_field_info *field, const plr_node_info *info);
bool x3d_type_of_name(const char *name, size_t length, plr_type *type);

#endif
