/* Classic VRML: X3D (ISO/IEC 19776-2) and VRML97. A recursive descent over the text of the file;
 * after a fault it skips to where the grammar can be picked up again and goes on. */
#include "x3d/build.h"

#include <string.h>

typedef struct classic {
    x3d_build *build;
    plr_scene *scene;
    x3d_view view;
    x3d_lexer lexer;
} classic;

static void read_statements(classic *c, x3d_node_list *nodes, bool in_body);
static plr_node *read_node_or_use(classic *c, x3d_open *outer);

static plr_place place_at(const classic *c, size_t at) {
    return x3d_view_place(&c->view, at);
}

static x3d_label label_of(const classic *c, const x3d_word *word) {
    return (x3d_label){word->text, word->length, place_at(c, word->at)};
}

static void syntax(classic *c, const char *what) {
    x3d_lexer_next(&c->lexer);
    x3d_report(c->scene, PLR_CODE_SYNTAX, x3d_lexer_place(&c->lexer), "%s", what);
}

static bool peek_is(classic *c, const char *word) {
    x3d_word next;
    return x3d_lexer_peek_word(&c->lexer, &next) && x3d_word_is(&next, word);
}

static bool accept_word(classic *c, const char *word) {
    if (!peek_is(c, word))
        return false;
    c->lexer.at += strlen(word);
    return true;
}

static bool expect_label(classic *c, x3d_label *label, const char *what) {
    x3d_word word;
    if (!x3d_lexer_word(&c->lexer, &word)) {
        syntax(c, what);
        return false;
    }
    *label = label_of(c, &word);
    return true;
}

/* ---- Skipping ---- */

static void skip_token(classic *c) {
    int next = x3d_lexer_next(&c->lexer);
    size_t start, end;
    x3d_word word;
    if (next < 0)
        return;
    if (next == '"') {
        x3d_lexer_string(&c->lexer, &start, &end);
    } else if (x3d_lexer_word(&c->lexer, &word)) {
        if (x3d_word_is(&word, "DEF") && x3d_lexer_word(&c->lexer, &word))
            x3d_define_skipped(c->build, label_of(c, &word));
    } else {
        c->lexer.at++;
        while (c->lexer.at < c->lexer.length &&
               !x3d_is_delimiter((unsigned char)c->lexer.text[c->lexer.at]))
            c->lexer.at++;
    }
}

/* From an opening bracket or brace to behind its partner. */
static void skip_balanced(classic *c) {
    size_t depth = 0;
    size_t opened = c->lexer.at;
    do {
        int next = x3d_lexer_next(&c->lexer);
        if (next < 0) {
            x3d_report(c->scene, PLR_CODE_SYNTAX, place_at(c, opened), "'%c' is never closed",
                       c->lexer.text[opened]);
            return;
        }
        if (strchr("[]{}", next)) {
            depth += next == '[' || next == '{' ? 1 : (size_t)-1;
            c->lexer.at++;
        } else {
            skip_token(c);
        }
    } while (depth);
}

static bool next_is_one_of(classic *c, const char *characters) {
    int next = x3d_lexer_next(&c->lexer);
    return next > 0 && strchr(characters, next);
}

static void skip_node(classic *c) {
    x3d_word word;
    if (accept_word(c, "DEF") && x3d_lexer_word(&c->lexer, &word))
        x3d_define_skipped(c->build, label_of(c, &word));
    if (accept_word(c, "USE") || accept_word(c, "IS")) {
        x3d_lexer_word(&c->lexer, &word);
        return;
    }
    x3d_lexer_word(&c->lexer, &word);
    if (next_is_one_of(c, "{"))
        skip_balanced(c);
}

/* The value of a field that is not known, whatever it may be. */
static void skip_value(classic *c) {
    static const char *const constants[] = {"TRUE", "FALSE", "true", "false", "NULL"};
    if (next_is_one_of(c, "[")) {
        skip_balanced(c);
        return;
    }
    if (peek_is(c, "DEF") || peek_is(c, "USE") || peek_is(c, "IS")) {
        skip_node(c);
        return;
    }
    for (size_t i = 0; i < sizeof constants / sizeof *constants; i++)
        if (accept_word(c, constants[i]))
            return;
    int next = x3d_lexer_next(&c->lexer);
    if (next == '"' || x3d_starts_number(next)) {
        while ((next = x3d_lexer_next(&c->lexer)) == '"' || x3d_starts_number(next))
            skip_token(c);
        return;
    }
    x3d_lexer before = c->lexer;
    x3d_word word;
    if (x3d_lexer_word(&c->lexer, &word) && next_is_one_of(c, "{"))
        skip_balanced(c);
    else
        c->lexer = before;
}

/* After a value that could not be read: over what is left of it. Words stay where they name a field
 * of the node, for then the next field begins there. */
static void skip_rest_of_value(classic *c, const plr_node *node, size_t start) {
    int next = x3d_lexer_next(&c->lexer);
    bool in_list = false;
    for (size_t i = start; i < c->lexer.at && !in_list; i++)
        in_list = c->lexer.text[i] == '[';
    x3d_word word;
    for (;;) {
        next = x3d_lexer_next(&c->lexer);
        if (next < 0 || next == '}' || next == '{')
            return;
        if (next == ']') {
            if (in_list)
                c->lexer.at++;
            return;
        }
        if (next == '[') {
            skip_balanced(c);
            return;
        }
        if (x3d_lexer_peek_word(&c->lexer, &word)) {
            bool known = x3d_field_index(c->scene, node, word.text, word.length,
                                         place_at(c, word.at)) != SIZE_MAX;
            if (known || x3d_word_is(&word, "ROUTE") || x3d_word_is(&word, "PROTO") ||
                (c->lexer.at != start && !in_list))
                return;
        }
        skip_token(c);
    }
}

/* ---- Fields ---- */

static void read_node_list(classic *c, plr_node *node, size_t index, x3d_open *open) {
    size_t bracket = c->lexer.at;
    c->lexer.at++;
    while (!c->scene->stopped && !x3d_lexer_accept(&c->lexer, ']')) {
        int next = x3d_lexer_next(&c->lexer);
        plr_place place = x3d_lexer_place(&c->lexer);
        if (next < 0 || next == '}') {
            x3d_report(c->scene, PLR_CODE_SYNTAX, place_at(c, bracket), "'[' is never closed");
            return;
        }
        x3d_word word;
        if (!x3d_lexer_peek_word(&c->lexer, &word)) {
            syntax(c, "a node is expected");
            if (next == '[' || next == '{')
                skip_balanced(c);
            else
                skip_token(c);
            continue;
        }
        plr_place nothing = x3d_lexer_place(&c->lexer);
        if (accept_word(c, "NULL")) {
            x3d_report(c->scene, PLR_CODE_BAD_NODE, nothing,
                       "a list of nodes holds no NULL; it is skipped, what follows moves up");
            continue;
        }
        plr_node *child = read_node_or_use(c, open);
        if (child)
            x3d_add_child(c->build, node, index, child, place);
    }
}

static void read_nodes(classic *c, plr_node *node, size_t index, x3d_open *open) {
    x3d_word word;
    node->fields[index].count = 0;
    if (next_is_one_of(c, "[")) {
        read_node_list(c, node, index, open);
        return;
    }
    if (accept_word(c, "NULL"))
        return;
    plr_place place = x3d_lexer_place(&c->lexer);
    if (!x3d_lexer_peek_word(&c->lexer, &word)) {
        x3d_report(c->scene, PLR_CODE_BAD_VALUE, place, "%s: a node is expected",
                   node->fields[index].name);
        skip_value(c);
        return;
    }
    plr_node *child = read_node_or_use(c, open);
    if (child)
        x3d_add_child(c->build, node, index, child, place);
}

static void read_value(classic *c, plr_node *node, size_t index, x3d_open *open) {
    if (plr_type_kind(node->fields[index].type) == PLR_NODE) {
        read_nodes(c, node, index, open);
        return;
    }
    x3d_lexer_next(&c->lexer);
    size_t start = c->lexer.at;
    if (!x3d_value(c->build, node, index, &c->lexer, false))
        skip_rest_of_value(c, node, start);
}

static bool read_is(classic *c, plr_node *node, x3d_label field) {
    x3d_label interface;
    if (!accept_word(c, "IS"))
        return false;
    if (expect_label(c, &interface, "the name of a field of the prototype is expected"))
        x3d_add_is(c->build, node, field, interface);
    return true;
}

static bool access_of(const x3d_word *word, plr_access *access) {
    static const struct {
        const char *name;
        plr_access access;
    } words[] = {{"initializeOnly", PLR_INITIALIZE_ONLY}, {"inputOnly", PLR_INPUT_ONLY},
                 {"outputOnly", PLR_OUTPUT_ONLY},         {"inputOutput", PLR_INPUT_OUTPUT},
                 {"field", PLR_INITIALIZE_ONLY},          {"eventIn", PLR_INPUT_ONLY},
                 {"eventOut", PLR_OUTPUT_ONLY},           {"exposedField", PLR_INPUT_OUTPUT}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (x3d_word_is(word, words[i].name)) {
            *access = words[i].access;
            return true;
        }
    return false;
}

enum {
    WITH_VALUE = 1,
    MAY_BE_IS = 2
};

/* "access type name value": the access word has been read. The field goes to `node`, which is NULL
 * where it takes none: then all is skipped. */
static void read_declaration(classic *c, plr_node *node, plr_access access, unsigned flags,
                             x3d_open *open) {
    x3d_label type_name, name;
    plr_type type;
    if (!expect_label(c, &type_name, "the type of the field is expected"))
        return;
    if (!x3d_type_of_name(type_name.text, type_name.length, &type)) {
        x3d_report(c->scene, PLR_CODE_SYNTAX, type_name.place, "'%.*s' is no type of a field",
                   (int)(type_name.length < 100 ? type_name.length : 100), type_name.text);
        node = NULL;
    }
    if (!expect_label(c, &name, "the name of the field is expected"))
        return;
    bool value =
        (flags & WITH_VALUE) && (access == PLR_INITIALIZE_ONLY || access == PLR_INPUT_OUTPUT);
    size_t index = node ? x3d_declare(c->build, node, type, access, name) : SIZE_MAX;
    if (index == SIZE_MAX) {
        if (value || peek_is(c, "IS"))
            skip_value(c);
        return;
    }
    if ((flags & MAY_BE_IS) && read_is(c, node, name))
        return;
    if (value) {
        node->fields[index].given = true;
        read_value(c, node, index, open);
    }
}

static bool takes_fields(const plr_node *node) {
    return node->type && node->type->info->author_fields;
}

static void read_field(classic *c, x3d_open *open, const x3d_word *word) {
    plr_node *node = open->node;
    x3d_label name = label_of(c, word);
    plr_access access;
    if (access_of(word, &access) &&
        x3d_field_index(c->scene, node, word->text, word->length, name.place) == SIZE_MAX) {
        if (!takes_fields(node))
            x3d_report(c->scene, PLR_CODE_UNKNOWN_FIELD, name.place,
                       "%s takes no fields declared by the author", node->written);
        read_declaration(c, takes_fields(node) ? node : NULL, access, WITH_VALUE | MAY_BE_IS, open);
        return;
    }
    if (read_is(c, node, name))
        return;
    size_t index = x3d_field(c->build, node, name);
    if (index == SIZE_MAX)
        skip_value(c);
    else
        read_value(c, node, index, open);
}

/* ---- Nodes ---- */

static bool read_statement(classic *c, const x3d_word *word);

static void read_body(classic *c, x3d_open *open) {
    size_t brace = c->lexer.at;
    c->lexer.at++;
    while (!c->scene->stopped && !x3d_lexer_accept(&c->lexer, '}')) {
        int next = x3d_lexer_next(&c->lexer);
        x3d_word word;
        if (next < 0) {
            x3d_report(c->scene, PLR_CODE_SYNTAX, place_at(c, brace),
                       "the '{' of this %s is never closed", open->node->written);
            return;
        }
        if (!x3d_lexer_word(&c->lexer, &word)) {
            syntax(c, "the name of a field is expected");
            if (next == '[' || next == '{')
                skip_balanced(c);
            else
                skip_token(c);
            continue;
        }
        x3d_lexer before = c->lexer;
        if ((x3d_word_is(&word, "ROUTE") || x3d_word_is(&word, "PROTO") ||
             x3d_word_is(&word, "EXTERNPROTO")) &&
            read_statement(c, &word))
            continue;
        c->lexer = before;
        read_field(c, open, &word);
    }
}

static plr_node *read_node(classic *c, const x3d_label *def, x3d_open *outer) {
    x3d_label type;
    if (!expect_label(c, &type, "the type of a node is expected"))
        return NULL;
    if (!next_is_one_of(c, "{")) {
        x3d_report(c->scene, PLR_CODE_SYNTAX, x3d_lexer_place(&c->lexer),
                   "'{' is expected after '%.*s'", (int)(type.length < 100 ? type.length : 100),
                   type.text);
        return NULL;
    }
    x3d_open open;
    x3d_begin(c->build, &open, type, outer);
    if (def)
        x3d_define(c->build, &open, *def);
    if (!open.node) {
        if (!c->scene->stopped)
            skip_balanced(c);
        return NULL;
    }
    if (x3d_enter(c->build, type.place)) {
        read_body(c, &open);
        x3d_leave(c->build);
    }
    return x3d_end(c->build, &open);
}

static plr_node *read_node_or_use(classic *c, x3d_open *outer) {
    x3d_label name;
    if (accept_word(c, "USE"))
        return expect_label(c, &name, "the name of a node is expected after USE")
                   ? x3d_use(c->build, name, outer)
                   : NULL;
    bool def = accept_word(c, "DEF");
    if (def && !expect_label(c, &name, "a name is expected after DEF"))
        return NULL;
    return read_node(c, def ? &name : NULL, outer);
}

/* ---- Prototypes ---- */

static void read_interface(classic *c, x3d_proto *proto, unsigned flags) {
    if (!next_is_one_of(c, "[")) {
        syntax(c, "'[' and the fields of the prototype are expected");
        return;
    }
    size_t bracket = c->lexer.at++;
    while (!c->scene->stopped && !x3d_lexer_accept(&c->lexer, ']')) {
        x3d_word word;
        plr_access access;
        int next = x3d_lexer_next(&c->lexer);
        if (next < 0 || next == '{') {
            x3d_report(c->scene, PLR_CODE_SYNTAX, place_at(c, bracket), "'[' is never closed");
            return;
        }
        if (x3d_lexer_peek_word(&c->lexer, &word) && access_of(&word, &access)) {
            c->lexer.at += word.length;
            read_declaration(c, proto->interface, access, flags, NULL);
            continue;
        }
        syntax(c, "inputOnly, outputOnly, inputOutput or initializeOnly is expected");
        skip_token(c);
    }
}

static void read_proto(classic *c) {
    x3d_label name;
    if (!expect_label(c, &name, "the name of the prototype is expected"))
        return;
    x3d_proto *proto = x3d_proto_begin(c->build, name);
    if (!proto)
        return;
    x3d_node_list nodes = {0};
    if (x3d_enter(c->build, name.place)) {
        read_interface(c, proto, WITH_VALUE);
        size_t brace = c->lexer.at;
        if (x3d_lexer_accept(&c->lexer, '{')) {
            read_statements(c, &nodes, true);
            if (!c->scene->stopped && !x3d_lexer_accept(&c->lexer, '}'))
                x3d_report(c->scene, PLR_CODE_SYNTAX, place_at(c, brace),
                           "the '{' of prototype '%s' is never closed", proto->name);
        } else {
            syntax(c, "'{' and the body of the prototype are expected");
        }
        x3d_leave(c->build);
    }
    x3d_proto_end(c->build, proto, &nodes);
}

static void read_externproto(classic *c) {
    x3d_label name;
    if (!expect_label(c, &name, "the name of the prototype is expected"))
        return;
    x3d_proto *proto = x3d_externproto_begin(c->build, name);
    if (!proto)
        return;
    read_interface(c, proto, 0);
    proto->urls = (plr_field){.name = "url", .type = PLR_MFSTRING};
    plr_node holder = {.written = proto->name, .fields = &proto->urls, .field_count = 1};
    if (!x3d_value(c->build, &holder, 0, &c->lexer, false))
        skip_value(c);
}

/* ---- Statements ---- */

/* Node names and field names of statements end before a dot. */
static bool read_route_end(classic *c, x3d_label *node, x3d_label *field) {
    if (!expect_label(c, node, "the name of a node is expected in ROUTE"))
        return false;
    if (!x3d_lexer_accept(&c->lexer, '.')) {
        syntax(c, "'.' and the name of a field are expected in ROUTE");
        return false;
    }
    return expect_label(c, field, "the name of a field is expected in ROUTE");
}

static void read_route(classic *c, const x3d_word *word) {
    x3d_pending_route route = {.place = place_at(c, word->at)};
    if (!read_route_end(c, &route.from, &route.from_field))
        return;
    if (!accept_word(c, "TO") && !accept_word(c, "to")) {
        syntax(c, "TO is expected in ROUTE");
        x3d_lexer before = c->lexer;
        x3d_word skipped;
        if (x3d_lexer_word(&c->lexer, &skipped) && x3d_lexer_accept(&c->lexer, '.'))
            x3d_lexer_word(&c->lexer, &skipped);
        else
            c->lexer = before;
        return;
    }
    if (read_route_end(c, &route.to, &route.to_field))
        x3d_add_route(c->build, &route);
}

static bool read_string(classic *c, plr_string *string) {
    size_t start, end;
    if (x3d_lexer_next(&c->lexer) != '"') {
        syntax(c, "a string in quotes is expected");
        return false;
    }
    if (!x3d_lexer_string(&c->lexer, &start, &end))
        x3d_report(c->scene, PLR_CODE_SYNTAX, place_at(c, start - 1), "the string is never closed");
    *string = x3d_view_string(&c->scene->arena, &c->view, start, end, X3D_ESCAPES);
    return true;
}

static void read_meta(classic *c) {
    plr_string name, content;
    if (read_string(c, &name) && read_string(c, &content))
        x3d_add_meta(c->build, name.text, content.text);
}

static void read_unit(classic *c) {
    x3d_label category, name;
    if (!expect_label(c, &category, "the category of the unit is expected") ||
        !expect_label(c, &name, "the name of the unit is expected"))
        return;
    double factor = 0;
    x3d_lexer_next(&c->lexer);
    plr_place place = x3d_lexer_place(&c->lexer);
    size_t used =
        x3d_parse_number(c->lexer.text + c->lexer.at, c->lexer.length - c->lexer.at, &factor);
    c->lexer.at += used;
    if (!used)
        syntax(c, "the conversion factor of the unit is expected");
    else if (!x3d_add_unit(c->build, category, factor))
        x3d_report(c->scene, PLR_CODE_BAD_VALUE, place, "the conversion factor cannot be right");
}

static void read_import(classic *c) {
    x3d_pending_import import;
    if (!read_route_end(c, &import.inlined, &import.exported))
        return;
    import.local = import.exported;
    if (accept_word(c, "AS") && !expect_label(c, &import.local, "a name is expected after AS"))
        return;
    x3d_add_import(c->build, &import);
}

static void read_export(classic *c) {
    x3d_pending_import export = {0};
    if (!expect_label(c, &export.exported, "the name of a node is expected"))
        return;
    export.local = export.exported;
    if (accept_word(c, "AS") && !expect_label(c, &export.local, "a name is expected after AS"))
        return;
    x3d_add_export(c->build, &export);
}

/* PROFILE and COMPONENT restrict nothing. */
static void read_component(classic *c) {
    x3d_label name;
    if (!expect_label(c, &name, "the name of a component is expected"))
        return;
    x3d_lexer_accept(&c->lexer, ':');
    if (x3d_starts_number(x3d_lexer_next(&c->lexer)))
        skip_token(c);
}

/* A statement that begins with this word, already read; false: it is none. */
static bool read_statement(classic *c, const x3d_word *word) {
    x3d_label ignored;
    if (x3d_word_is(word, "ROUTE"))
        read_route(c, word);
    else if (x3d_word_is(word, "PROTO"))
        read_proto(c);
    else if (x3d_word_is(word, "EXTERNPROTO"))
        read_externproto(c);
    else if (x3d_word_is(word, "PROFILE"))
        expect_label(c, &ignored, "the name of a profile is expected");
    else if (x3d_word_is(word, "COMPONENT"))
        read_component(c);
    else if (x3d_word_is(word, "META"))
        read_meta(c);
    else if (x3d_word_is(word, "UNIT"))
        read_unit(c);
    else if (x3d_word_is(word, "IMPORT"))
        read_import(c);
    else if (x3d_word_is(word, "EXPORT"))
        read_export(c);
    else
        return false;
    return true;
}

/* Statements and nodes up to the end of the text or, in a body, to its '}'. */
static void read_statements(classic *c, x3d_node_list *nodes, bool in_body) {
    while (!c->scene->stopped) {
        int next = x3d_lexer_next(&c->lexer);
        x3d_word word;
        if (next < 0 || (in_body && next == '}'))
            return;
        if (!x3d_lexer_peek_word(&c->lexer, &word)) {
            syntax(c, "a node or a statement is expected");
            if (next == '[' || next == '{')
                skip_balanced(c);
            else
                skip_token(c);
            continue;
        }
        c->lexer.at += word.length;
        if (read_statement(c, &word))
            continue;
        c->lexer.at = word.at;
        plr_node *node = read_node_or_use(c, NULL);
        if (node)
            *PLR_PUSH(&c->scene->arena, nodes) = node;
    }
}

/* "#X3D V3.3 utf8" or "#VRML V2.0 utf8" */
static void read_header(classic *c) {
    const char *text = c->view.text;
    size_t length = c->view.length;
    const char *end = length ? memchr(text, '\n', length) : NULL;
    size_t line = end ? (size_t)(end - text) : length;
    size_t at = 0;
    if (line > 6 && memcmp(text, "#X3D V", 6) == 0)
        at = 6;
    else if (line > 7 && memcmp(text, "#VRML V", 7) == 0)
        at = 7;
    plr_place place = place_at(c, 0);
    if (!at) {
        x3d_report(c->scene, PLR_CODE_ENCODING, place,
                   "the file does not begin with '#X3D V3.3 utf8' or the like");
        return;
    }
    size_t digits = 0;
    while (at + digits < line && text[at + digits] > ' ')
        digits++;
    if (text[at] == '1' && at == 7)
        x3d_report(c->scene, PLR_CODE_ENCODING, place, "VRML 1.0 is another language");
    x3d_set_version(c->build, text + at, digits);
    size_t word = at + digits;
    while (word < line && text[word] == ' ')
        word++;
    if (line - word < 4 || memcmp(text + word, "utf8", 4) != 0)
        x3d_report(c->scene, PLR_CODE_ENCODING, place_at(c, word), "'utf8' is expected here");
}

void x3d_read_classic(x3d_build *build) {
    classic c = {.build = build, .scene = build->scene};
    c.view =
        (x3d_view){.file = build->file, .text = build->file->text, .length = build->file->length};
    size_t bom = c.view.length >= 3 && memcmp(c.view.text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    c.view.text += bom;
    c.view.length -= bom;
    c.view.base = bom;
    x3d_lexer_init(&c.lexer, &c.view, true);
    read_header(&c);
    read_statements(&c, &build->nodes, false);
}
