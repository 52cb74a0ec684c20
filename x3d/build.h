/* What both encodings share: nodes, fields, names, prototypes, routes and inlined files come into
 * being here. A reader of an encoding calls x3d_begin, then x3d_field / x3d_value / x3d_add_child /
 * x3d_add_is for what it finds, then x3d_end. */
#ifndef PLR_X3D_BUILD_H
#define PLR_X3D_BUILD_H

#include "x3d/scene.h"

/* What a DEF name stands for. */
typedef struct x3d_def {
    plr_node *node;  /* the latest node of that name */
    plr_node *first; /* the first one */
    bool open;       /* it is still being read */
    bool skipped;    /* it is inside what was left out: its use is no further fault */
} x3d_def;

/* A name in a file, and where it stands. */
typedef struct x3d_label {
    const char *text;
    size_t length;
    plr_place place;
} x3d_label;

typedef struct x3d_pending_route {
    x3d_label from, from_field, to, to_field;
    plr_place place;
} x3d_pending_route;

typedef struct x3d_pending_import {
    x3d_label inlined, exported, local;
} x3d_pending_import;

/* The names of one file or of one prototype's body. */
typedef struct x3d_scope {
    x3d_names defs;          /* x3d_def */
    x3d_names protos;        /* x3d_proto */
    x3d_names exports;       /* plr_node, filled when the scope ends */
    struct x3d_scope *outer; /* prototypes are looked up there too */
    struct x3d_proto *proto; /* whose body this is, or NULL */
    struct {
        x3d_pending_route *items;
        size_t count, capacity;
    } routes;
    struct {
        x3d_pending_import *items;
        size_t count, capacity;
    } imports, export_names; /* exports: `exported` is the DEF name, `local` the name outside */
} x3d_scope;

typedef struct x3d_proto {
    const char *name;
    plr_place place;
    plr_node *interface; /* its fields are those of the interface, with their defaults */
    x3d_node_list nodes; /* all nodes of body and defaults: the mould of the instances */
    x3d_is_list is;
    x3d_route_list routes;
    plr_node *first; /* what an instance is */
    bool open;       /* its body is still being read */
    bool external, resolved;
    plr_field urls;           /* of an EXTERNPROTO */
    struct x3d_proto *actual; /* what it turned out to be */
    x3d_type *known;          /* or the node of the table */
} x3d_proto;

/* The reading of one file. */
typedef struct x3d_build {
    plr_scene *scene;
    x3d_file *file;
    x3d_scope *scope;
    size_t depth;
    struct x3d_build *outer;        /* the file that asked for this one */
    x3d_node_list nodes;            /* top level */
    double length_unit, angle_unit; /* in metres and radians */
    bool is_main;
} x3d_build;

/* A node that is being read. */
typedef struct x3d_open {
    plr_node *node;   /* NULL: unknown (reported); its content is to be skipped */
    x3d_proto *proto; /* an instance: `node` stands for it */
    x3d_def *def;
    size_t first_is; /* in the list of the surrounding prototype */
    struct x3d_open *outer;
} x3d_open;

x3d_scope *x3d_scope_new(plr_scene *scene, x3d_scope *outer, x3d_proto *proto);
/* Resolves what had to wait: IMPORT, EXPORT, ROUTE. */
void x3d_scope_end(x3d_build *build);

/* Begins a node of a type of the table or of a prototype. `written`: the type's place. */
void x3d_begin(x3d_build *build, x3d_open *open, x3d_label type, x3d_open *outer);
void x3d_define(x3d_build *build, x3d_open *open, x3d_label name);
/* Notes a name inside content that is skipped. */
void x3d_define_skipped(x3d_build *build, x3d_label name);
/* The finished node, or NULL. */
plr_node *x3d_end(x3d_build *build, x3d_open *open);
/* The node of a name; NULL: unknown or not to be used here (reported). */
plr_node *x3d_use(x3d_build *build, x3d_label name, const x3d_open *outer);

/* A field that may be given a value; SIZE_MAX: there is none (reported). Marks it as given. */
size_t x3d_field(x3d_build *build, plr_node *node, x3d_label name);
/* Reads a value of any type but nodes. `xml`: see x3d_value_desc. */
bool x3d_value(x3d_build *build, plr_node *node, size_t field, x3d_lexer *lexer, bool xml);
/* Puts a node into a field of nodes. */
void x3d_add_child(x3d_build *build, plr_node *node, size_t field, plr_node *child,
                   plr_place place);
/* The field of `parent` that an XML child element goes to; SIZE_MAX: none (reported). */
size_t x3d_container(x3d_build *build, plr_node *parent, const plr_node *child,
                     const x3d_label *container, plr_place place);
/* "field IS interface" inside a prototype. */
void x3d_add_is(x3d_build *build, plr_node *node, x3d_label field, x3d_label interface);
/* A field that the author declares; SIZE_MAX: refused (reported). */
size_t x3d_declare(x3d_build *build, plr_node *node, plr_type type, plr_access access,
                   x3d_label name);

/* Begins the declaration of a prototype: the scope of `build` is then that of its body, and
 * proto->interface takes declared fields. NULL without memory for nodes. */
x3d_proto *x3d_proto_begin(x3d_build *build, x3d_label name);
/* The top-level nodes of the body are in `nodes`. */
void x3d_proto_end(x3d_build *build, x3d_proto *proto, const x3d_node_list *nodes);
x3d_proto *x3d_externproto_begin(x3d_build *build, x3d_label name);
/* Finds what an EXTERNPROTO means; false: nothing (reported). */
bool x3d_externproto_resolve(x3d_build *build, x3d_proto *proto);
x3d_proto *x3d_proto_find(const x3d_build *build, x3d_label name);
/* Enters a node into the mould of the prototype whose body is being read, if any. */
void x3d_own(x3d_build *build, plr_node *node);
/* A copy of the body with the fields of `open->node` in place. */
plr_node *x3d_instantiate(x3d_build *build, x3d_open *open);

void x3d_add_route(x3d_build *build, const x3d_pending_route *route);
void x3d_add_import(x3d_build *build, const x3d_pending_import *import);
void x3d_add_export(x3d_build *build, const x3d_pending_import *export);
bool x3d_add_unit(x3d_build *build, x3d_label category, double factor);
void x3d_add_meta(x3d_build *build, const char *name, const char *content);
/* "3.3" and the like, from the header or the root element. */
void x3d_set_version(x3d_build *build, const char *text, size_t length);

bool x3d_is_inline(const plr_node *node);
/* Reads what an Inline names into its field `children`. */
void x3d_load_inline(x3d_build *build, plr_node *node);
/* Reads one text with the reader of its encoding; roots go to build->nodes. */
void x3d_read_text(x3d_build *build);
void x3d_read_classic(x3d_build *build);
void x3d_read_xml(x3d_build *build);

/* Goes one level down; false at the limit (reported; everything then stops). */
bool x3d_enter(x3d_build *build, plr_place place);
void x3d_leave(x3d_build *build);

/* Offers a name, as long as the budget of the scene lasts. */
void x3d_offer(plr_scene *scene, x3d_nearest *nearest, const char *candidate);
/* Offers all names of a map. */
void x3d_offer_all(plr_scene *scene, x3d_nearest *nearest, const x3d_names *names);

#endif
