/* Nodes and their fields in XML. */
#include "x3d/xml.h"

#include <string.h>

plr_place x3d_xml_place(const x3d_xml *x, size_t at) {
    return x3d_file_place(x->build->file, at);
}

x3d_frame *x3d_xml_push(x3d_xml *x, x3d_frame_kind kind) {
    x3d_frame *made = x->spare;
    if (made)
        x->spare = made->outer;
    else
        made = PLR_NEW(&x->scene->arena, x3d_frame);
    *made = (x3d_frame){.kind = kind, .place = x3d_xml_place(x, x->token.at), .outer = x->top};
    return x->top = made;
}

void x3d_xml_pop(x3d_xml *x) {
    x3d_frame *top = x->top;
    x->top = top->outer;
    top->outer = x->spare;
    x->spare = top;
}

void x3d_xml_skip(x3d_xml *x) {
    x->skipping++;
}

/* ---- Attributes ---- */

void x3d_xml_read_attributes(x3d_xml *x) {
    size_t at = 0;
    x->attribute_count = 0;
    x3d_xml_attribute attribute;
    while (x3d_xml_next_attribute(&x->scan, &x->token, &at, &attribute)) {
        if (x->attribute_count == X3D_MOST_ATTRIBUTES) {
            x3d_report(x->scene, PLR_CODE_LIMIT, x3d_xml_place(x, attribute.name_at),
                       "more than %d attributes", X3D_MOST_ATTRIBUTES);
            return;
        }
        x->attributes[x->attribute_count++] = attribute;
    }
}

static bool is_named(const x3d_xml_attribute *attribute, const char *name) {
    return !attribute->prefixed && strlen(name) == attribute->name_length &&
           memcmp(attribute->name, name, attribute->name_length) == 0;
}

const x3d_xml_attribute *x3d_xml_find(const x3d_xml *x, const char *name) {
    for (size_t i = 0; i < x->attribute_count; i++)
        if (is_named(&x->attributes[i], name))
            return &x->attributes[i];
    return NULL;
}

static x3d_label name_label(const x3d_xml *x, const x3d_xml_attribute *attribute) {
    return (x3d_label){attribute->name, attribute->name_length,
                       x3d_xml_place(x, attribute->name_at)};
}

x3d_view x3d_xml_view(x3d_xml *x, size_t start, size_t end, bool cdata) {
    size_t unknown;
    x3d_view view = x3d_xml_decode(&x->scene->arena, x->build->file, start, end, cdata, &unknown);
    if (unknown != SIZE_MAX)
        x3d_report(x->scene, PLR_CODE_XML, x3d_xml_place(x, unknown),
                   "the entity is not known: plugray reads none but those of XML itself");
    return view;
}

/* The value of an attribute as a name: blanks around it go. */
bool x3d_xml_label(x3d_xml *x, const char *name, x3d_label *label) {
    const x3d_xml_attribute *attribute = x3d_xml_find(x, name);
    if (!attribute)
        return false;
    x3d_view view = x3d_xml_view(x, attribute->start, attribute->end, false);
    size_t start = 0, end = view.length;
    while (start < end && (unsigned char)view.text[start] <= ' ')
        start++;
    while (end > start && (unsigned char)view.text[end - 1] <= ' ')
        end--;
    *label = (x3d_label){view.text + start, end - start, x3d_view_place(&view, start)};
    return end > start;
}

bool x3d_xml_need(x3d_xml *x, const char *element, const char *name, x3d_label *label) {
    if (x3d_xml_label(x, name, label))
        return true;
    x3d_report(x->scene, PLR_CODE_SYNTAX, x3d_xml_place(x, x->token.at),
               "%s lacks the attribute '%s'", element, name);
    return false;
}

bool x3d_label_is(const x3d_label *label, const char *text) {
    return strlen(text) == label->length && memcmp(label->text, text, label->length) == 0;
}

/* ---- Nodes ---- */

static bool has_newline(const plr_field *field) {
    for (size_t i = 0; plr_type_kind(field->type) == PLR_STRING && i < field->count; i++)
        if (memchr(field->value.strings[i].text, '\n', field->value.strings[i].length))
            return true;
    return false;
}

/* Reads the value of a field from an attribute. */
void x3d_xml_read_value(x3d_xml *x, plr_node *node, size_t index,
                        const x3d_xml_attribute *attribute) {
    plr_scene *scene = x->scene;
    const plr_field *field = &node->fields[index];
    x3d_view view = x3d_xml_view(x, attribute->start, attribute->end, false);
    if (plr_type_kind(field->type) == PLR_NODE) {
        if (view.length && !(view.length == 4 && memcmp(view.text, "NULL", 4) == 0))
            x3d_report(scene, PLR_CODE_BAD_VALUE, x3d_xml_place(x, attribute->start),
                       "'%s' takes nodes, which are elements in XML", field->name);
        return;
    }
    x3d_lexer lexer;
    x3d_lexer_init(&lexer, &view, false);
    x3d_value(x->build, node, index, &lexer, true);
    if (strcmp(field->name, "url") == 0 && has_newline(field) &&
        memchr(x->scan.text + attribute->start, '\n', attribute->end - attribute->start))
        x3d_report(scene, PLR_CODE_NEWLINES, x3d_xml_place(x, attribute->start),
                   "text of several lines in an attribute: other browsers join the lines, put it "
                   "into a CDATA section");
}

/* class, id and style of X3D 4 speak to web pages. */
static bool is_web(const x3d_xml_attribute *attribute) {
    return is_named(attribute, "class") || is_named(attribute, "id") ||
           is_named(attribute, "style");
}

static void read_field_attributes(x3d_xml *x, plr_node *node, bool instance) {
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
            x3d_xml_read_value(x, node, index, attribute);
    }
}

static bool may_hold_nodes(const x3d_frame *f) {
    return f && (f->kind == X3D_IN_SCENE || f->kind == X3D_IN_ROOT || f->kind == X3D_IN_NODE ||
                 f->kind == X3D_IN_BODY || f->kind == X3D_IN_VALUE);
}

void x3d_xml_note_skipped_def(x3d_xml *x) {
    x3d_label def;
    if (x3d_xml_label(x, "DEF", &def))
        x3d_define_skipped(x->build, def);
}

static x3d_open *open_of(x3d_frame *f) {
    while (f && f->kind != X3D_IN_NODE)
        f = f->outer;
    return f ? &f->open : NULL;
}

static void begin_use(x3d_xml *x, x3d_label type, x3d_label use) {
    x3d_open *outer = open_of(x->top);
    x3d_frame *f = x3d_xml_push(x, X3D_IN_USED);
    f->node = x3d_use(x->build, use, outer);
    if (f->node && f->node->type && !x3d_label_is(&type, plr_node_type(f->node)) &&
        !x3d_label_is(&type, f->node->written) && !x3d_label_is(&type, "ProtoInstance"))
        x3d_report(x->scene, PLR_CODE_BAD_NODE, f->place, "'%.*s' is a %s, not a %.*s",
                   (int)(use.length < 100 ? use.length : 100), use.text, plr_node_type(f->node),
                   (int)(type.length < 100 ? type.length : 100), type.text);
    f->has_container = x3d_xml_label(x, "containerField", &f->container);
}

void x3d_xml_begin_node(x3d_xml *x, x3d_label type, bool instance) {
    x3d_label name;
    if (!may_hold_nodes(x->top)) {
        x3d_report(x->scene, PLR_CODE_SYNTAX, type.place, "a '%.*s' cannot stand here",
                   (int)(type.length < 100 ? type.length : 100), type.text);
        x3d_xml_note_skipped_def(x);
        x3d_xml_skip(x);
        return;
    }
    if (x3d_xml_label(x, "USE", &name)) {
        begin_use(x, type, name);
        return;
    }
    if (instance && !x3d_xml_need(x, "ProtoInstance", "name", &name)) {
        x3d_xml_note_skipped_def(x);
        x3d_xml_skip(x);
        return;
    }
    if (instance)
        type = (x3d_label){name.text, name.length, type.place};
    x3d_frame *f = x3d_xml_push(x, X3D_IN_NODE);
    x3d_begin(x->build, &f->open, type, open_of(f->outer));
    if (x3d_xml_label(x, "DEF", &name))
        x3d_define(x->build, &f->open, name);
    if (!f->open.node || !x3d_enter(x->build, f->place)) {
        x3d_xml_pop(x);
        x3d_xml_skip(x);
        return;
    }
    f->has_container = x3d_xml_label(x, "containerField", &f->container);
    read_field_attributes(x, f->open.node, instance);
}

/* A finished node goes to where its element stands. */
void x3d_xml_deliver(x3d_xml *x, plr_node *node, bool has_container, x3d_label container,
                     plr_place place) {
    x3d_frame *f = x->top;
    if (!node || !f)
        return;
    if (f->kind == X3D_IN_SCENE || f->kind == X3D_IN_ROOT) {
        *PLR_PUSH(&x->scene->arena, &x->build->nodes) = node;
    } else if (f->kind == X3D_IN_BODY) {
        *PLR_PUSH(&x->scene->arena, &f->nodes) = node;
    } else if (f->kind == X3D_IN_VALUE) {
        if (f->field != SIZE_MAX)
            x3d_add_child(x->build, f->node, f->field, node, place);
    } else if (f->kind == X3D_IN_NODE) {
        size_t index =
            x3d_container(x->build, f->open.node, node, has_container ? &container : NULL, place);
        if (index != SIZE_MAX)
            x3d_add_child(x->build, f->open.node, index, node, place);
    }
}

void x3d_xml_end_node(x3d_xml *x) {
    x3d_frame f = *x->top;
    for (size_t i = 0; i < f.is.count; i++)
        x3d_add_is(x->build, f.open.node, f.is.items[i].field, f.is.items[i].interface);
    x3d_leave(x->build);
    plr_node *node = x3d_end(x->build, &f.open);
    x3d_xml_pop(x);
    x3d_xml_deliver(x, node, f.has_container, f.container, f.place);
}

/* Text in an element is one more string of its url. */
void x3d_xml_add_text(x3d_xml *x, const x3d_xml_token *token) {
    bool cdata = token->kind == X3D_XML_CDATA;
    const char *raw = x->scan.text;
    size_t start = token->start;
    while (start < token->end && (unsigned char)raw[start] <= ' ')
        start++;
    if (start == token->end || x->skipping || !x->top)
        return;
    plr_node *node = x->top->kind == X3D_IN_NODE ? x->top->open.node : NULL;
    size_t index = node ? x3d_field_index(x->scene, node, "url", 3, x->top->place) : SIZE_MAX;
    if (index == SIZE_MAX || node->fields[index].type != PLR_MFSTRING) {
        x3d_warn(x->scene, PLR_CODE_SYNTAX, x3d_xml_place(x, start), "text is not expected here");
        return;
    }
    x3d_view view = x3d_xml_view(x, token->start, token->end, cdata);
    plr_field *field = &node->fields[index];
    plr_string *strings = (plr_string *)(uintptr_t)field->value.strings;
    if (field->count >= x->top->text_room) {
        x->top->text_room = 2 * field->count + 1;
        strings = PLR_NEW_ARRAY(&x->scene->arena, x->top->text_room, plr_string);
        if (field->count)
            memcpy(strings, field->value.strings, field->count * sizeof *strings);
    }
    strings[field->count] = x3d_view_string(&x->scene->arena, &view, 0, view.length, 0);
    if (!field->given)
        field->place = x3d_xml_place(x, token->at);
    field->given = true;
    field->value.strings = strings;
    field->count++;
}
