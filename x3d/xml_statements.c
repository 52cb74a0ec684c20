/* The elements of XML that are no nodes. */
#include "x3d/xml.h"

/* Whether this part of a document stands where it belongs; else it is skipped (reported). */
static bool stands_right(x3d_xml *x, bool right, const char *element) {
    if (right)
        return true;
    x3d_report(x->scene, PLR_CODE_SYNTAX, x3d_xml_place(x, x->token.at), "'%s' cannot stand here",
               element);
    x3d_xml_skip(x);
    return false;
}

static bool in_root(const x3d_xml *x) {
    return x->top && x->top->kind == X3D_IN_ROOT;
}

static void begin_root(x3d_xml *x) {
    x3d_label version;
    if (!stands_right(x, !x->top, "X3D"))
        return;
    x3d_xml_push(x, X3D_IN_ROOT);
    if (x3d_xml_label(x, "version", &version))
        x3d_set_version(x->build, version.text, version.length);
}

static void begin_head(x3d_xml *x) {
    if (stands_right(x, in_root(x), "head"))
        x3d_xml_push(x, X3D_IN_HEAD);
}

static void begin_scene(x3d_xml *x) {
    if (stands_right(x, !x->top || in_root(x), "Scene"))
        x3d_xml_push(x, X3D_IN_SCENE);
}

static void begin_instance(x3d_xml *x) {
    x3d_xml_begin_node(x, (x3d_label){"ProtoInstance", 13, x3d_xml_place(x, x->token.at)}, true);
}

static plr_string text_of(x3d_xml *x, const char *name) {
    const x3d_xml_attribute *attribute = x3d_xml_find(x, name);
    if (!attribute)
        return (plr_string){.text = ""};
    x3d_view view = x3d_xml_view(x, attribute->start, attribute->end, false);
    return x3d_view_string(&x->scene->arena, &view, 0, view.length, X3D_BLANK_NEWLINES);
}

static void begin_meta(x3d_xml *x) {
    x3d_add_meta(x->build, text_of(x, "name").text, text_of(x, "content").text);
    x3d_xml_skip(x);
}

static void begin_unit(x3d_xml *x) {
    x3d_label category, factor;
    double value = 0;
    if (x3d_xml_need(x, "unit", "category", &category) &&
        x3d_xml_need(x, "unit", "conversionFactor", &factor)) {
        size_t used = x3d_parse_number(factor.text, factor.length, &value);
        if (used != factor.length || !x3d_add_unit(x->build, category, value))
            x3d_report(x->scene, PLR_CODE_BAD_VALUE, factor.place,
                       "the conversion factor cannot be right");
    }
    x3d_xml_skip(x);
}

static void begin_proto(x3d_xml *x) {
    x3d_label name;
    x3d_proto *proto = NULL;
    if (x3d_xml_need(x, "ProtoDeclare", "name", &name) && x3d_enter(x->build, name.place)) {
        proto = x3d_proto_begin(x->build, name);
        if (!proto)
            x3d_leave(x->build);
    }
    if (proto)
        x3d_xml_push(x, X3D_IN_PROTO)->proto = proto;
    else
        x3d_xml_skip(x);
}

void x3d_xml_end_proto(x3d_xml *x) {
    x3d_frame f = *x->top;
    x3d_proto_end(x->build, f.proto, &f.nodes);
    x3d_leave(x->build);
    x3d_xml_pop(x);
}

static void begin_externproto(x3d_xml *x) {
    x3d_label name;
    x3d_proto *proto = NULL;
    if (x3d_xml_need(x, "ExternProtoDeclare", "name", &name))
        proto = x3d_externproto_begin(x->build, name);
    if (!proto) {
        x3d_xml_skip(x);
        return;
    }
    x3d_xml_push(x, X3D_IN_INTERFACE)->node = proto->interface;
    proto->urls = (plr_field){.name = "url", .type = PLR_MFSTRING};
    plr_node holder = {.written = proto->name, .fields = &proto->urls, .field_count = 1};
    const x3d_xml_attribute *url = x3d_xml_find(x, "url");
    if (url)
        x3d_xml_read_value(x, &holder, 0, url);
}

static void begin_interface(x3d_xml *x) {
    if (x->top && x->top->kind == X3D_IN_PROTO) {
        plr_node *interface = x->top->proto->interface;
        x3d_xml_push(x, X3D_IN_INTERFACE)->node = interface;
    } else {
        x3d_xml_skip(x);
    }
}

static void begin_body(x3d_xml *x) {
    if (x->top && x->top->kind == X3D_IN_PROTO)
        x3d_xml_push(x, X3D_IN_BODY);
    else
        x3d_xml_skip(x);
}

void x3d_xml_end_body(x3d_xml *x) {
    x3d_node_list nodes = x->top->nodes;
    x3d_xml_pop(x);
    x->top->nodes = nodes; /* of the ProtoDeclare: the only place where a ProtoBody is */
}

static bool access_of(const x3d_label *label, plr_access *access) {
    static const char *const names[] = {"initializeOnly", "inputOnly", "outputOnly", "inputOutput"};
    for (int i = 0; i < 4; i++)
        if (x3d_label_is(label, names[i])) {
            *access = (plr_access)i;
            return true;
        }
    return false;
}

/* Whose fields the elements `field` of this place declare; NULL: none (reported). */
static plr_node *declaring(x3d_xml *x) {
    x3d_frame *f = x->top;
    if (f && f->kind == X3D_IN_INTERFACE)
        return f->node;
    plr_node *node = f && f->kind == X3D_IN_NODE ? f->open.node : NULL;
    if (node && node->type && node->type->info->author_fields)
        return node;
    x3d_report(x->scene, PLR_CODE_UNKNOWN_FIELD, x3d_xml_place(x, x->token.at),
               "%s takes no fields declared by the author", node ? node->written : "this element");
    return NULL;
}

static void begin_field(x3d_xml *x) {
    x3d_label name, type_name, access_name;
    plr_type type;
    plr_access access;
    plr_node *node = declaring(x);
    size_t index = SIZE_MAX;
    if (node && x3d_xml_need(x, "field", "name", &name) &&
        x3d_xml_need(x, "field", "type", &type_name) &&
        x3d_xml_need(x, "field", "accessType", &access_name)) {
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
        x3d_xml_skip(x);
        return;
    }
    const x3d_xml_attribute *value = x3d_xml_find(x, "value");
    x3d_frame *f = x3d_xml_push(x, X3D_IN_VALUE);
    f->node = node;
    f->field = index;
    if (value && (access == PLR_INITIALIZE_ONLY || access == PLR_INPUT_OUTPUT)) {
        node->fields[index].given = true;
        x3d_xml_read_value(x, node, index, value);
    }
}

static void begin_field_value(x3d_xml *x) {
    x3d_label name;
    plr_node *node = x->top && x->top->kind == X3D_IN_NODE ? x->top->open.node : NULL;
    size_t index = SIZE_MAX;
    if (node && x3d_xml_need(x, "fieldValue", "name", &name))
        index = x3d_field(x->build, node, name);
    if (index == SIZE_MAX) {
        x3d_xml_skip(x);
        return;
    }
    const x3d_xml_attribute *value = x3d_xml_find(x, "value");
    x3d_frame *f = x3d_xml_push(x, X3D_IN_VALUE);
    f->node = node;
    f->field = index;
    if (value)
        x3d_xml_read_value(x, node, index, value);
}

void x3d_xml_end_value(x3d_xml *x) {
    const x3d_frame *f = x->top;
    plr_field *field = &f->node->fields[f->field];
    if (field->count && plr_type_kind(field->type) == PLR_NODE)
        field->given = true;
    x3d_xml_pop(x);
}

static void begin_is(x3d_xml *x) {
    if (x->top && x->top->kind == X3D_IN_NODE)
        x3d_xml_push(x, X3D_IN_IS);
    else
        x3d_xml_skip(x);
}

static void begin_connect(x3d_xml *x) {
    x3d_pending_is is;
    if (x->top && x->top->kind == X3D_IN_IS && x3d_xml_need(x, "connect", "nodeField", &is.field) &&
        x3d_xml_need(x, "connect", "protoField", &is.interface))
        *PLR_PUSH(&x->scene->arena, &x->top->outer->is) = is;
    x3d_xml_skip(x);
}

static void begin_route(x3d_xml *x) {
    x3d_pending_route route = {.place = x3d_xml_place(x, x->token.at)};
    if (x3d_xml_need(x, "ROUTE", "fromNode", &route.from) &&
        x3d_xml_need(x, "ROUTE", "fromField", &route.from_field) &&
        x3d_xml_need(x, "ROUTE", "toNode", &route.to) &&
        x3d_xml_need(x, "ROUTE", "toField", &route.to_field))
        x3d_add_route(x->build, &route);
    x3d_xml_skip(x);
}

static void begin_import(x3d_xml *x) {
    x3d_pending_import import;
    if (x3d_xml_need(x, "IMPORT", "inlineDEF", &import.inlined) &&
        (x3d_xml_label(x, "importedDEF", &import.exported) ||
         x3d_xml_need(x, "IMPORT", "exportedDEF", &import.exported))) {
        if (!x3d_xml_label(x, "AS", &import.local))
            import.local = import.exported;
        x3d_add_import(x->build, &import);
    }
    x3d_xml_skip(x);
}

static void begin_export(x3d_xml *x) {
    x3d_pending_import export = {0};
    if (x3d_xml_need(x, "EXPORT", "localDEF", &export.exported)) {
        if (!x3d_xml_label(x, "AS", &export.local))
            export.local = export.exported;
        x3d_add_export(x->build, &export);
    }
    x3d_xml_skip(x);
}

static const struct {
    const char *name;
    void (*begin)(x3d_xml *x);
} statements[] = {{"X3D", begin_root},
                  {"head", begin_head},
                  {"Scene", begin_scene},
                  {"meta", begin_meta},
                  {"component", x3d_xml_skip},
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

bool x3d_xml_statement(x3d_xml *x, x3d_label name) {
    for (size_t i = 0; i < sizeof statements / sizeof *statements; i++)
        if (x3d_label_is(&name, statements[i].name)) {
            statements[i].begin(x);
            return true;
        }
    return false;
}
