/* The XML encoding (ISO/IEC 19776-1). libxml2 parses, checks that the document is well formed, and
 * tells when an element begins and ends; names, values and places come from the raw bytes. */
#include "x3d/xml.h"

#include <limits.h>
#include <string.h>

#include <libxml/parser.h>
#include <libxml/parserInternals.h>

#include "x3d/xml_scan.h"

typedef enum frame_kind {
    ROOT,      /* X3D */
    HEAD,      /* head */
    SCENE,     /* Scene */
    NODE,      /* a node or an instance, being read */
    USED,      /* a node by USE */
    PROTO,     /* ProtoDeclare */
    INTERFACE, /* ProtoInterface, ExternProtoDeclare */
    BODY,      /* ProtoBody */
    VALUE,     /* field, fieldValue: nodes inside are its value */
    IS         /* IS */
} frame_kind;

typedef struct pending_is {
    x3d_label field, interface;
} pending_is;

/* An element that is open. */
typedef struct frame {
    frame_kind kind;
    plr_place place;
    x3d_open open;       /* NODE */
    plr_node *node;      /* USED: the node; VALUE, INTERFACE: whose field or fields these are */
    size_t field;        /* VALUE */
    x3d_proto *proto;    /* PROTO */
    x3d_node_list nodes; /* BODY */
    bool has_container;
    x3d_label container;
    struct {
        pending_is *items;
        size_t count, capacity;
    } is; /* NODE: fields may be declared after the IS element */
    struct frame *outer;
} frame;

enum {
    MOST_ATTRIBUTES = 256
};

typedef struct xml {
    x3d_build *build;
    plr_scene *scene;
    xmlParserCtxtPtr context;
    x3d_xml_scan scan;
    x3d_xml_token token; /* of the element that begins */
    bool in_empty;       /* the element that began last is empty: its end has no tag */
    size_t skipping;     /* depth inside what is left out */
    frame *top, *spare;
    x3d_xml_attribute attributes[MOST_ATTRIBUTES];
    size_t attribute_count;
    bool no_memory, failed;
} xml;

static plr_place place_at(const xml *x, size_t at) {
    return x3d_file_place(x->build->file, at);
}

static frame *push(xml *x, frame_kind kind) {
    frame *made = x->spare;
    if (made)
        x->spare = made->outer;
    else
        made = PLR_NEW(&x->scene->arena, frame);
    *made = (frame){.kind = kind, .place = place_at(x, x->token.at), .outer = x->top};
    return x->top = made;
}

static void pop(xml *x) {
    frame *top = x->top;
    x->top = top->outer;
    top->outer = x->spare;
    x->spare = top;
}

static void skip(xml *x) {
    x->skipping++;
}

/* ---- Attributes -------------------------------------------------------------------------------
 */

static void read_attributes(xml *x) {
    size_t at = 0;
    x->attribute_count = 0;
    x3d_xml_attribute attribute;
    while (x3d_xml_next_attribute(&x->scan, &x->token, &at, &attribute)) {
        if (x->attribute_count == MOST_ATTRIBUTES) {
            x3d_report(x->scene, PLR_CODE_LIMIT, place_at(x, attribute.name_at),
                       "more than %d attributes", MOST_ATTRIBUTES);
            return;
        }
        x->attributes[x->attribute_count++] = attribute;
    }
}

static bool is_named(const x3d_xml_attribute *attribute, const char *name) {
    return !attribute->prefixed && strlen(name) == attribute->name_length &&
           memcmp(attribute->name, name, attribute->name_length) == 0;
}

static const x3d_xml_attribute *find_attribute(const xml *x, const char *name) {
    for (size_t i = 0; i < x->attribute_count; i++)
        if (is_named(&x->attributes[i], name))
            return &x->attributes[i];
    return NULL;
}

static x3d_label name_label(const xml *x, const x3d_xml_attribute *attribute) {
    return (x3d_label){attribute->name, attribute->name_length, place_at(x, attribute->name_at)};
}

static x3d_view decode(xml *x, size_t start, size_t end, bool cdata) {
    size_t unknown;
    x3d_view view = x3d_xml_decode(&x->scene->arena, x->build->file, start, end, cdata, &unknown);
    if (unknown != SIZE_MAX)
        x3d_report(x->scene, PLR_CODE_XML, place_at(x, unknown),
                   "the entity is not known: plugray reads none but those of XML itself");
    return view;
}

/* The value of an attribute as a name: blanks around it go. */
static bool value_label(xml *x, const char *name, x3d_label *label) {
    const x3d_xml_attribute *attribute = find_attribute(x, name);
    if (!attribute)
        return false;
    x3d_view view = decode(x, attribute->start, attribute->end, false);
    size_t start = 0, end = view.length;
    while (start < end && (unsigned char)view.text[start] <= ' ')
        start++;
    while (end > start && (unsigned char)view.text[end - 1] <= ' ')
        end--;
    *label = (x3d_label){view.text + start, end - start, x3d_view_place(&view, start)};
    return end > start;
}

static bool need(xml *x, const char *element, const char *name, x3d_label *label) {
    if (value_label(x, name, label))
        return true;
    x3d_report(x->scene, PLR_CODE_SYNTAX, place_at(x, x->token.at), "%s lacks the attribute '%s'",
               element, name);
    return false;
}

static bool is_label(const x3d_label *label, const char *text) {
    return strlen(text) == label->length && memcmp(label->text, text, label->length) == 0;
}

/* ---- Nodes --------------------------------------------------------------------------------------
 */

/* Reads the value of a field from an attribute. */
static void read_value(xml *x, plr_node *node, size_t index, const x3d_xml_attribute *attribute) {
    plr_scene *scene = x->scene;
    const plr_field *field = &node->fields[index];
    x3d_view view = decode(x, attribute->start, attribute->end, false);
    if (plr_type_kind(field->type) == PLR_NODE) {
        if (view.length && !(view.length == 4 && memcmp(view.text, "NULL", 4) == 0))
            x3d_report(scene, PLR_CODE_BAD_VALUE, place_at(x, attribute->start),
                       "'%s' takes nodes, which are elements in XML", field->name);
        return;
    }
    x3d_lexer lexer;
    x3d_lexer_init(&lexer, &view, false);
    bool code = plr_type_kind(field->type) == PLR_STRING && strcmp(field->name, "url") == 0;
    const char *raw = x->scan.text + attribute->start;
    if (code && memchr(raw, '\n', attribute->end - attribute->start))
        x3d_report(scene, PLR_CODE_NEWLINES, place_at(x, attribute->start),
                   "text of several lines in an attribute: other browsers join the lines, put it "
                   "into a CDATA section");
    x3d_value(x->build, node, index, &lexer, true);
}

/* class, id and style of X3D 4 speak to web pages. */
static bool is_web(const x3d_xml_attribute *attribute) {
    return is_named(attribute, "class") || is_named(attribute, "id") ||
           is_named(attribute, "style");
}

static void read_field_attributes(xml *x, plr_node *node, bool instance) {
    static const char *const special[] = {"DEF", "USE", "containerField", "xmlns"};
    for (size_t i = 0; i < x->attribute_count && !x->scene->stopped; i++) {
        const x3d_xml_attribute *attribute = &x->attributes[i];
        bool skipped = attribute->prefixed || (instance && is_named(attribute, "name"));
        for (size_t k = 0; k < sizeof special / sizeof *special; k++)
            skipped = skipped || is_named(attribute, special[k]);
        x3d_label label = name_label(x, attribute);
        if (!skipped && is_web(attribute))
            skipped =
                x3d_field_index(x->scene, node, label.text, label.length, label.place) == SIZE_MAX;
        if (skipped)
            continue;
        size_t index = x3d_field(x->build, node, label);
        if (index != SIZE_MAX)
            read_value(x, node, index, attribute);
    }
}

static bool may_hold_nodes(const frame *f) {
    return f && (f->kind == SCENE || f->kind == ROOT || f->kind == NODE || f->kind == BODY ||
                 f->kind == VALUE);
}

static void note_skipped_def(xml *x) {
    x3d_label def;
    if (value_label(x, "DEF", &def))
        x3d_define_skipped(x->build, def);
}

static x3d_open *open_of(frame *f) {
    while (f && f->kind != NODE)
        f = f->outer;
    return f ? &f->open : NULL;
}

static void begin_use(xml *x, x3d_label type, x3d_label use) {
    x3d_open *outer = open_of(x->top);
    frame *f = push(x, USED);
    f->node = x3d_use(x->build, use, outer);
    if (f->node && f->node->type && !is_label(&type, plr_node_type(f->node)) &&
        !is_label(&type, f->node->written) && !is_label(&type, "ProtoInstance"))
        x3d_report(x->scene, PLR_CODE_BAD_NODE, f->place, "'%.*s' is a %s, not a %.*s",
                   (int)(use.length < 100 ? use.length : 100), use.text, plr_node_type(f->node),
                   (int)(type.length < 100 ? type.length : 100), type.text);
    f->has_container = value_label(x, "containerField", &f->container);
}

static void begin_node(xml *x, x3d_label type, bool instance) {
    x3d_label name;
    if (!may_hold_nodes(x->top)) {
        x3d_report(x->scene, PLR_CODE_SYNTAX, type.place, "a '%.*s' cannot stand here",
                   (int)(type.length < 100 ? type.length : 100), type.text);
        note_skipped_def(x);
        skip(x);
        return;
    }
    if (value_label(x, "USE", &name)) {
        begin_use(x, type, name);
        return;
    }
    if (instance && !need(x, "ProtoInstance", "name", &name)) {
        note_skipped_def(x);
        skip(x);
        return;
    }
    if (instance)
        type = (x3d_label){name.text, name.length, type.place};
    frame *f = push(x, NODE);
    x3d_begin(x->build, &f->open, type, open_of(f->outer));
    if (value_label(x, "DEF", &name))
        x3d_define(x->build, &f->open, name);
    if (!f->open.node || !x3d_enter(x->build, f->place)) {
        pop(x);
        skip(x);
        return;
    }
    f->has_container = value_label(x, "containerField", &f->container);
    read_field_attributes(x, f->open.node, instance);
}

/* A finished node goes to where its element stands. */
static void deliver(xml *x, plr_node *node, bool has_container, x3d_label container,
                    plr_place place) {
    frame *f = x->top;
    if (!node || !f)
        return;
    if (f->kind == SCENE || f->kind == ROOT) {
        *PLR_PUSH(&x->scene->arena, &x->build->nodes) = node;
    } else if (f->kind == BODY) {
        *PLR_PUSH(&x->scene->arena, &f->nodes) = node;
    } else if (f->kind == VALUE) {
        if (f->field != SIZE_MAX)
            x3d_add_child(x->build, f->node, f->field, node, place);
    } else if (f->kind == NODE) {
        size_t index =
            x3d_container(x->build, f->open.node, node, has_container ? &container : NULL, place);
        if (index != SIZE_MAX)
            x3d_add_child(x->build, f->open.node, index, node, place);
    }
}

static void end_node(xml *x) {
    frame f = *x->top;
    for (size_t i = 0; i < f.is.count; i++)
        x3d_add_is(x->build, f.open.node, f.is.items[i].field, f.is.items[i].interface);
    x3d_leave(x->build);
    plr_node *node = x3d_end(x->build, &f.open);
    pop(x);
    deliver(x, node, f.has_container, f.container, f.place);
}

/* Text in an element is one more string of its url. */
static void add_text(xml *x, const x3d_xml_token *token) {
    bool cdata = token->kind == X3D_XML_CDATA;
    const char *raw = x->scan.text;
    size_t start = token->start;
    while (start < token->end && (unsigned char)raw[start] <= ' ')
        start++;
    if (start == token->end || x->skipping || !x->top)
        return;
    plr_node *node = x->top->kind == NODE ? x->top->open.node : NULL;
    size_t index = node ? x3d_field_index(x->scene, node, "url", 3, x->top->place) : SIZE_MAX;
    if (index == SIZE_MAX || node->fields[index].type != PLR_MFSTRING) {
        x3d_warn(x->scene, PLR_CODE_SYNTAX, place_at(x, start), "text is not expected here");
        return;
    }
    x3d_view view = decode(x, token->start, token->end, cdata);
    plr_field *field = &node->fields[index];
    plr_string *strings = PLR_NEW_ARRAY(&x->scene->arena, field->count + 1, plr_string);
    if (field->count)
        memcpy(strings, field->value.strings, field->count * sizeof *strings);
    strings[field->count] = x3d_view_string(&x->scene->arena, &view, 0, view.length, 0);
    if (!field->given)
        field->place = place_at(x, token->at);
    field->given = true;
    field->value.strings = strings;
    field->count++;
}

/* ---- Statements
 * ----------------------------------------------------------------------------------- */

/* Whether this part of a document stands where it belongs; else it is skipped (reported). */
static bool stands_right(xml *x, bool right, const char *element) {
    if (right)
        return true;
    x3d_report(x->scene, PLR_CODE_SYNTAX, place_at(x, x->token.at), "'%s' cannot stand here",
               element);
    skip(x);
    return false;
}

static bool in_root(const xml *x) {
    return x->top && x->top->kind == ROOT;
}

static void begin_root(xml *x) {
    x3d_label version;
    if (!stands_right(x, !x->top, "X3D"))
        return;
    push(x, ROOT);
    if (value_label(x, "version", &version))
        x3d_set_version(x->build, version.text, version.length);
}

static void begin_head(xml *x) {
    if (stands_right(x, in_root(x), "head"))
        push(x, HEAD);
}

static void begin_scene(xml *x) {
    if (stands_right(x, !x->top || in_root(x), "Scene"))
        push(x, SCENE);
}

static void begin_instance(xml *x) {
    begin_node(x, (x3d_label){"ProtoInstance", 13, place_at(x, x->token.at)}, true);
}

static plr_string text_of(xml *x, const char *name) {
    const x3d_xml_attribute *attribute = find_attribute(x, name);
    if (!attribute)
        return (plr_string){.text = ""};
    x3d_view view = decode(x, attribute->start, attribute->end, false);
    return x3d_view_string(&x->scene->arena, &view, 0, view.length, X3D_BLANK_NEWLINES);
}

static void begin_meta(xml *x) {
    x3d_add_meta(x->build, text_of(x, "name").text, text_of(x, "content").text);
    skip(x);
}

static void begin_unit(xml *x) {
    x3d_label category, factor;
    double value = 0;
    if (need(x, "unit", "category", &category) && need(x, "unit", "conversionFactor", &factor)) {
        size_t used = x3d_parse_number(factor.text, factor.length, &value);
        if (used != factor.length || !x3d_add_unit(x->build, category, value))
            x3d_report(x->scene, PLR_CODE_BAD_VALUE, factor.place,
                       "the conversion factor cannot be right");
    }
    skip(x);
}

static void begin_proto(xml *x) {
    x3d_label name;
    x3d_proto *proto = NULL;
    if (need(x, "ProtoDeclare", "name", &name) && x3d_enter(x->build, name.place)) {
        proto = x3d_proto_begin(x->build, name);
        if (!proto)
            x3d_leave(x->build);
    }
    if (proto)
        push(x, PROTO)->proto = proto;
    else
        skip(x);
}

static void end_proto(xml *x) {
    frame f = *x->top;
    x3d_proto_end(x->build, f.proto, &f.nodes);
    x3d_leave(x->build);
    pop(x);
}

static void begin_externproto(xml *x) {
    x3d_label name;
    x3d_proto *proto = NULL;
    if (need(x, "ExternProtoDeclare", "name", &name))
        proto = x3d_externproto_begin(x->build, name);
    if (!proto) {
        skip(x);
        return;
    }
    push(x, INTERFACE)->node = proto->interface;
    proto->urls = (plr_field){.name = "url", .type = PLR_MFSTRING};
    plr_node holder = {.written = proto->name, .fields = &proto->urls, .field_count = 1};
    const x3d_xml_attribute *url = find_attribute(x, "url");
    if (url)
        read_value(x, &holder, 0, url);
}

static void begin_interface(xml *x) {
    if (x->top && x->top->kind == PROTO) {
        plr_node *interface = x->top->proto->interface;
        push(x, INTERFACE)->node = interface;
    } else {
        skip(x);
    }
}

static void begin_body(xml *x) {
    if (x->top && x->top->kind == PROTO)
        push(x, BODY);
    else
        skip(x);
}

static void end_body(xml *x) {
    x3d_node_list nodes = x->top->nodes;
    pop(x);
    x->top->nodes = nodes; /* of the PROTO: the only place where a BODY is */
}

static bool access_of(const x3d_label *label, plr_access *access) {
    static const char *const names[] = {"initializeOnly", "inputOnly", "outputOnly", "inputOutput"};
    for (int i = 0; i < 4; i++)
        if (is_label(label, names[i])) {
            *access = (plr_access)i;
            return true;
        }
    return false;
}

/* Whose fields the elements `field` of this place declare; NULL: none (reported). */
static plr_node *declaring(xml *x) {
    frame *f = x->top;
    if (f && f->kind == INTERFACE)
        return f->node;
    plr_node *node = f && f->kind == NODE ? f->open.node : NULL;
    if (node && node->type && node->type->info->author_fields)
        return node;
    x3d_report(x->scene, PLR_CODE_UNKNOWN_FIELD, place_at(x, x->token.at),
               "%s takes no fields declared by the author", node ? node->written : "this element");
    return NULL;
}

static void begin_field(xml *x) {
    x3d_label name, type_name, access_name;
    plr_type type;
    plr_access access;
    plr_node *node = declaring(x);
    size_t index = SIZE_MAX;
    if (node && need(x, "field", "name", &name) && need(x, "field", "type", &type_name) &&
        need(x, "field", "accessType", &access_name)) {
        if (!x3d_type_of_name(type_name.text, type_name.length, &type))
            x3d_report(x->scene, PLR_CODE_BAD_VALUE, type_name.place,
                       "'%.*s' is no type of a field",
                       (int)(type_name.length < 100 ? type_name.length : 100), type_name.text);
        else if (!access_of(&access_name, &access))
            x3d_report(x->scene, PLR_CODE_BAD_VALUE, access_name.place,
                       "inputOnly, outputOnly, inputOutput or initializeOnly is expected");
        else
            index = x3d_declare(x->build, node, type, access, name);
    }
    if (index == SIZE_MAX) {
        skip(x);
        return;
    }
    const x3d_xml_attribute *value = find_attribute(x, "value");
    frame *f = push(x, VALUE);
    f->node = node;
    f->field = index;
    if (value && (access == PLR_INITIALIZE_ONLY || access == PLR_INPUT_OUTPUT)) {
        node->fields[index].given = true;
        read_value(x, node, index, value);
    }
}

static void begin_field_value(xml *x) {
    x3d_label name;
    plr_node *node = x->top && x->top->kind == NODE ? x->top->open.node : NULL;
    size_t index = SIZE_MAX;
    if (node && need(x, "fieldValue", "name", &name))
        index = x3d_field(x->build, node, name);
    if (index == SIZE_MAX) {
        skip(x);
        return;
    }
    const x3d_xml_attribute *value = find_attribute(x, "value");
    frame *f = push(x, VALUE);
    f->node = node;
    f->field = index;
    if (value)
        read_value(x, node, index, value);
}

static void end_value(xml *x) {
    const frame *f = x->top;
    plr_field *field = &f->node->fields[f->field];
    if (field->count && plr_type_kind(field->type) == PLR_NODE)
        field->given = true;
    pop(x);
}

static void begin_is(xml *x) {
    if (x->top && x->top->kind == NODE)
        push(x, IS);
    else
        skip(x);
}

static void begin_connect(xml *x) {
    pending_is is;
    if (x->top && x->top->kind == IS && need(x, "connect", "nodeField", &is.field) &&
        need(x, "connect", "protoField", &is.interface))
        *PLR_PUSH(&x->scene->arena, &x->top->outer->is) = is;
    skip(x);
}

static void begin_route(xml *x) {
    x3d_pending_route route = {.place = place_at(x, x->token.at)};
    if (need(x, "ROUTE", "fromNode", &route.from) &&
        need(x, "ROUTE", "fromField", &route.from_field) && need(x, "ROUTE", "toNode", &route.to) &&
        need(x, "ROUTE", "toField", &route.to_field))
        x3d_add_route(x->build, &route);
    skip(x);
}

static void begin_import(xml *x) {
    x3d_pending_import import;
    if (need(x, "IMPORT", "inlineDEF", &import.inlined) &&
        (value_label(x, "importedDEF", &import.exported) ||
         need(x, "IMPORT", "exportedDEF", &import.exported))) {
        if (!value_label(x, "AS", &import.local))
            import.local = import.exported;
        x3d_add_import(x->build, &import);
    }
    skip(x);
}

static void begin_export(xml *x) {
    x3d_pending_import export = {0};
    if (need(x, "EXPORT", "localDEF", &export.exported)) {
        if (!value_label(x, "AS", &export.local))
            export.local = export.exported;
        x3d_add_export(x->build, &export);
    }
    skip(x);
}

static const struct {
    const char *name;
    void (*begin)(xml *x);
} statements[] = {{"X3D", begin_root},
                  {"head", begin_head},
                  {"Scene", begin_scene},
                  {"meta", begin_meta},
                  {"component", skip},
                  {"unit", begin_unit},
                  {"ProtoDeclare", begin_proto},
                  {"ExternProtoDeclare", begin_externproto},
                  {"ProtoInterface", begin_interface},
                  {"ProtoBody", begin_body},
                  {"ProtoInstance", begin_instance},
                  {"field", begin_field},
                  {"fieldValue", begin_field_value},
                  {"IS", begin_is},
                  {"connect", begin_connect},
                  {"ROUTE", begin_route},
                  {"IMPORT", begin_import},
                  {"EXPORT", begin_export}};

/* ---- Events
 * ------------------------------------------------------------------------------------------- */

/* Takes the scanner to the next tag of this kind; text on the way goes to the open element. */
static void advance(xml *x, x3d_xml_kind kind) {
    do {
        x->token = x3d_xml_next(&x->scan);
        if (x->token.kind == X3D_XML_TEXT || x->token.kind == X3D_XML_CDATA)
            add_text(x, &x->token);
    } while (x->token.kind != kind && x->token.kind != X3D_XML_EOF);
}

static void begin_element(xml *x) {
    advance(x, X3D_XML_START);
    x->in_empty = x->token.empty;
    x3d_xml_attribute name = x3d_xml_name(&x->scan, &x->token);
    read_attributes(x);
    if (x->skipping) {
        note_skipped_def(x);
        skip(x);
        return;
    }
    x3d_label label = {name.name, name.name_length, place_at(x, x->token.at)};
    if (!x->top && !is_label(&label, "X3D") && !is_label(&label, "Scene")) {
        x3d_report(x->scene, PLR_CODE_SYNTAX, label.place,
                   "the root element is '%.*s', not 'X3D': this is no scene",
                   (int)(label.length < 100 ? label.length : 100), label.text);
        x->failed = true;
        skip(x);
        return;
    }
    if (x->top && x->top->kind == USED) {
        skip(x); /* a USE has no content */
        return;
    }
    for (size_t i = 0; i < sizeof statements / sizeof *statements; i++)
        if (is_label(&label, statements[i].name)) {
            statements[i].begin(x);
            return;
        }
    begin_node(x, label, false);
}

static void end_top(xml *x) {
    frame f = *x->top;
    switch (f.kind) {
    case NODE:
        end_node(x);
        break;
    case USED:
        pop(x);
        deliver(x, f.node, f.has_container, f.container, f.place);
        break;
    case PROTO:
        end_proto(x);
        break;
    case BODY:
        end_body(x);
        break;
    case VALUE:
        end_value(x);
        break;
    default:
        pop(x);
    }
}

static void end_element(xml *x) {
    if (!x->in_empty)
        advance(x, X3D_XML_END);
    x->in_empty = false;
    if (x->skipping)
        x->skipping--;
    else if (x->top)
        end_top(x);
}

/* No jump may cross libxml2, which would lose memory: each event catches its own. */
static void guarded(xml *x, void (*event)(xml *)) {
    plr_arena *arena = &x->scene->arena;
    jmp_buf *outer = arena->out_of_memory, here;
    if (x->no_memory || x->scene->stopped)
        return;
    arena->out_of_memory = &here;
    if (setjmp(here) == 0)
        event(x);
    else
        x->no_memory = true;
    arena->out_of_memory = outer;
    if (x->no_memory || x->scene->stopped)
        xmlStopParser(x->context);
}

static void on_start(void *user, const xmlChar *name, const xmlChar *prefix, const xmlChar *uri,
                     int namespace_count, const xmlChar **namespaces, int attribute_count,
                     int defaulted_count, const xmlChar **attributes) {
    (void)name, (void)prefix, (void)uri, (void)namespace_count, (void)namespaces;
    (void)attribute_count, (void)defaulted_count, (void)attributes;
    guarded(user, begin_element);
}

static void on_end(void *user, const xmlChar *name, const xmlChar *prefix, const xmlChar *uri) {
    (void)name, (void)prefix, (void)uri;
    guarded(user, end_element);
}

/* libxml2 stands behind an entity when it complains about it. */
static plr_place before_entity(const xml *x, plr_place place) {
    const x3d_file *file = x->build->file;
    if (place.line > file->line_count)
        return place;
    size_t start = file->lines[place.line - 1], column = place.column;
    while (column > 1 && (start + column > file->length || file->text[start + column - 1] != '&'))
        column--;
    if (column > 1)
        place.column = (uint32_t)column;
    return place;
}

static void report_error(xml *x, const xmlError *error) {
    char message[200];
    size_t length = 0;
    for (const char *p = error->message; p && *p && length + 1 < sizeof message; p++)
        message[length++] = (unsigned char)*p < ' ' ? ' ' : *p;
    while (length && message[length - 1] == ' ')
        length--;
    message[length] = '\0';
    plr_place place = {x->build->file->name, error->line > 0 ? (uint32_t)error->line : 1,
                       error->int2 > 0 ? (uint32_t)error->int2 : 1};
    if (error->code == XML_ERR_UNDECLARED_ENTITY)
        place = before_entity(x, place);
    x3d_report(x->scene, error->code == XML_ERR_NO_MEMORY ? PLR_CODE_NO_MEMORY : PLR_CODE_XML,
               place, "%s", message);
}

/* The first fatal error ends the document; what libxml2 says after it is noise. */
static void on_error(void *user, xmlErrorPtr error) {
    xml *x = user;
    if (error->level != XML_ERR_FATAL || error->domain == XML_FROM_NAMESPACE || x->failed ||
        x->no_memory || x->scene->stopped)
        return;
    x->failed = true;
    report_error(x, error);
}

/* Entities could grow without bound, or read files: none is ever defined. */
static void on_entity(void *user, const xmlChar *name, int type, const xmlChar *public_id,
                      const xmlChar *system_id, xmlChar *content) {
    (void)user, (void)name, (void)type, (void)public_id, (void)system_id, (void)content;
}

static void parse(xml *x) {
    xmlParserCtxtPtr context = x->context;
    /* HUGE: arrays of many megabytes stand in attributes. Without entities nothing grows. */
    xmlCtxtUseOptions(context, XML_PARSE_NONET | XML_PARSE_HUGE | XML_PARSE_IGNORE_ENC);
    memset(context->sax, 0, sizeof *context->sax);
    context->sax->initialized = XML_SAX2_MAGIC;
    context->sax->startElementNs = on_start;
    context->sax->endElementNs = on_end;
    context->sax->serror = on_error;
    context->sax->entityDecl = on_entity;
    context->userData = x;
    xmlParseDocument(context);
}

void x3d_read_xml(x3d_build *build) {
    plr_scene *scene = build->scene;
    if (!x3d_xml_to_utf8(scene, build->file))
        return;
    const x3d_file *file = build->file;
    if (file->length > INT_MAX) {
        x3d_report(scene, PLR_CODE_LIMIT, (plr_place){file->name, 1, 1}, "the XML is too long");
        return;
    }
    xml *x = PLR_NEW(&scene->arena, xml);
    x->build = build;
    x->scene = scene;
    x->scan = (x3d_xml_scan){file->text, file->length, 0};
    if (file->length >= 3 && memcmp(file->text, "\xef\xbb\xbf", 3) == 0)
        x->scan.at = 3;
    if (!file->length)
        return;
    x->context = xmlCreateMemoryParserCtxt(file->text, (int)file->length);
    if (x->context) {
        parse(x);
        xmlFreeDoc(x->context->myDoc); /* libxml2 makes one for declarations of entities */
        xmlFreeParserCtxt(x->context);
    }
    if (!x->context || x->no_memory)
        longjmp(*scene->arena.out_of_memory, 1);
    x->skipping = 0;
    while (x->top) /* the document broke off: keep what is there */
        end_top(x);
}
