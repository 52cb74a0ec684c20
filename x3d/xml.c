/* libxml2 parses, checks that the document is well formed, and tells when an element begins and
 * ends; names, values and places come from the raw bytes. */
#include "x3d/xml.h"

#include <limits.h>
#include <string.h>

#include <libxml/parserInternals.h>

/* Takes the scanner to the next tag of this kind; text on the way goes to the open element. */
static void advance(x3d_xml *x, x3d_xml_kind kind) {
    do {
        x->token = x3d_xml_next(&x->scan);
        if (x->token.kind == X3D_XML_TEXT || x->token.kind == X3D_XML_CDATA)
            x3d_xml_add_text(x, &x->token);
    } while (x->token.kind != kind && x->token.kind != X3D_XML_EOF);
}

static void begin_element(x3d_xml *x) {
    advance(x, X3D_XML_START);
    x->in_empty = x->token.empty;
    x3d_xml_attribute name = x3d_xml_name(&x->scan, &x->token);
    x3d_xml_read_attributes(x);
    if (x->skipping) {
        x3d_xml_note_skipped_def(x);
        x3d_xml_skip(x);
        return;
    }
    x3d_label label = {name.name, name.name_length, x3d_xml_place(x, x->token.at)};
    if (!x->top && !x3d_label_is(&label, "X3D") && !x3d_label_is(&label, "Scene")) {
        x3d_report(x->scene, PLR_CODE_SYNTAX, label.place,
                   "the root element is '%.*s', not 'X3D': this is no scene",
                   (int)(label.length < 100 ? label.length : 100), label.text);
        x->failed = true;
        x3d_xml_skip(x);
        return;
    }
    if (x->top && x->top->kind == X3D_IN_USED) {
        x3d_xml_skip(x); /* a USE has no content */
        return;
    }
    if (!x3d_xml_statement(x, label))
        x3d_xml_begin_node(x, label, false);
}

static void end_top(x3d_xml *x) {
    x3d_frame f = *x->top;
    switch (f.kind) {
    case X3D_IN_NODE:
        x3d_xml_end_node(x);
        break;
    case X3D_IN_USED:
        x3d_xml_pop(x);
        x3d_xml_deliver(x, f.node, f.has_container, f.container, f.place);
        break;
    case X3D_IN_PROTO:
        x3d_xml_end_proto(x);
        break;
    case X3D_IN_BODY:
        x3d_xml_end_body(x);
        break;
    case X3D_IN_VALUE:
        x3d_xml_end_value(x);
        break;
    default:
        x3d_xml_pop(x);
    }
}

static void end_element(x3d_xml *x) {
    if (!x->in_empty)
        advance(x, X3D_XML_END);
    x->in_empty = false;
    if (x->skipping)
        x->skipping--;
    else if (x->top)
        end_top(x);
}

/* No jump may cross libxml2, which would lose memory: each event catches its own. */
static void guarded(x3d_xml *x, void (*event)(x3d_xml *)) {
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
static plr_place before_entity(const x3d_xml *x, plr_place place) {
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

static void report_error(x3d_xml *x, const xmlError *error) {
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
    x3d_xml *x = user;
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

static void parse(x3d_xml *x) {
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
    x3d_xml *x = PLR_NEW(&scene->arena, x3d_xml);
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
