/* The XML encoding (ISO/IEC 19776-1), in parts: xml.c drives libxml2 and takes its events,
 * xml_nodes.c reads nodes and their fields, xml_statements.c all other elements. */
#ifndef PLR_X3D_XML_H
#define PLR_X3D_XML_H

#include <libxml/parser.h>

#include "x3d/build.h"
#include "x3d/xml_scan.h"

typedef enum x3d_frame_kind {
    X3D_IN_ROOT,      /* X3D */
    X3D_IN_HEAD,      /* head */
    X3D_IN_SCENE,     /* Scene */
    X3D_IN_NODE,      /* a node or an instance, being read */
    X3D_IN_USED,      /* a node by USE */
    X3D_IN_PROTO,     /* ProtoDeclare */
    X3D_IN_INTERFACE, /* ProtoInterface, ExternProtoDeclare */
    X3D_IN_BODY,      /* ProtoBody */
    X3D_IN_VALUE,     /* field, fieldValue: nodes inside are its value */
    X3D_IN_IS         /* IS */
} x3d_frame_kind;

typedef struct x3d_pending_is {
    x3d_label field, interface;
} x3d_pending_is;

/* An element that is open. */
typedef struct x3d_frame {
    x3d_frame_kind kind;
    plr_place place;
    x3d_open open;    /* X3D_IN_NODE */
    plr_node *node;   /* USED: the node; X3D_IN_VALUE, INTERFACE: whose field or fields these are */
    size_t field;     /* X3D_IN_VALUE */
    x3d_proto *proto; /* X3D_IN_PROTO */
    x3d_node_list nodes; /* X3D_IN_BODY */
    bool has_container;
    x3d_label container;
    struct {
        x3d_pending_is *items;
        size_t count, capacity;
    } is;             /* X3D_IN_NODE: fields may be declared after the IS element */
    size_t text_room; /* X3D_IN_NODE: strings that the array of its url has room for */
    struct x3d_frame *outer;
} x3d_frame;

enum {
    X3D_MOST_ATTRIBUTES = 256
};

typedef struct x3d_xml {
    x3d_build *build;
    plr_scene *scene;
    xmlParserCtxtPtr context;
    x3d_xml_scan scan;
    x3d_xml_token token; /* of the element that begins */
    bool in_empty;       /* the element that began last is empty: its end has no tag */
    size_t skipping;     /* depth inside what is left out */
    x3d_frame *top, *spare;
    x3d_xml_attribute attributes[X3D_MOST_ATTRIBUTES];
    size_t attribute_count;
    bool no_memory, failed;
} x3d_xml;

plr_place x3d_xml_place(const x3d_xml *x, size_t offset);
/* Opens an element; closes the one opened last. */
x3d_frame *x3d_xml_push(x3d_xml *x, x3d_frame_kind kind);
void x3d_xml_pop(x3d_xml *x);
/* Leaves out the element that begins, with all inside. */
void x3d_xml_skip(x3d_xml *x);

/* The attributes of the element that begins, into x->attributes. */
void x3d_xml_read_attributes(x3d_xml *x);
const x3d_xml_attribute *x3d_xml_find(const x3d_xml *x, const char *name);
/* Raw bytes of the file, decoded. */
x3d_view x3d_xml_view(x3d_xml *x, size_t start, size_t end, bool cdata);
/* The value of an attribute as a name, without blanks around it; false: absent or empty. */
bool x3d_xml_label(x3d_xml *x, const char *name, x3d_label *label);
/* The same; absence is reported. */
bool x3d_xml_need(x3d_xml *x, const char *element, const char *name, x3d_label *label);
bool x3d_label_is(const x3d_label *label, const char *text);
/* Reads the value of a field from an attribute. */
void x3d_xml_read_value(x3d_xml *x, plr_node *node, size_t index,
                        const x3d_xml_attribute *attribute);

void x3d_xml_begin_node(x3d_xml *x, x3d_label type, bool instance);
void x3d_xml_end_node(x3d_xml *x);
/* A DEF inside of what is skipped. */
void x3d_xml_note_skipped_def(x3d_xml *x);
/* Puts a finished node where its element stands. */
void x3d_xml_deliver(x3d_xml *x, plr_node *node, bool has_container, x3d_label container,
                     plr_place place);
/* Text or CDATA inside the open element: one more string of its url. */
void x3d_xml_add_text(x3d_xml *x, const x3d_xml_token *token);

/* Begins an element that is no node; false: it is one. */
bool x3d_xml_statement(x3d_xml *x, x3d_label name);
void x3d_xml_end_proto(x3d_xml *x);
void x3d_xml_end_body(x3d_xml *x);
void x3d_xml_end_value(x3d_xml *x);

/* Brings the text of a file to UTF-8, as its first bytes or its declaration tell; places are then
 * those in the converted text. False: not possible (reported). */
bool x3d_xml_to_utf8(plr_scene *scene, x3d_file *file);

#endif
