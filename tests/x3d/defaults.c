/* Every node of the table, with each field given its default, is read without a complaint, in both
 * encodings, and keeps that value. */
#include "tests/tap.h"

#include <ctype.h>

#include <plugray/x3d.h>

typedef struct text {
    char bytes[20000];
    size_t length;
} text;

static void add(text *to, const char *piece) {
    size_t length = strlen(piece);
    if (to->length + length < sizeof to->bytes) {
        memcpy(to->bytes + to->length, piece, length + 1);
        to->length += length;
    }
}

static bool can_be_given(const plr_field_info *field) {
    return field->access == PLR_INITIALIZE_ONLY || field->access == PLR_INPUT_OUTPUT;
}

static void add_classic(text *to, const plr_node_info *info) {
    add(to, "#X3D V4.0 utf8\nPROFILE Full\n");
    add(to, info->name);
    add(to, " {\n");
    for (size_t i = 0; i < info->field_count; i++) {
        const plr_field_info *field = &info->fields[i];
        if (!can_be_given(field))
            continue;
        add(to, field->name);
        add(to, *field->initial ? " " : plr_type_is_multiple(field->type) ? " []" : " NULL");
        add(to, field->initial);
        add(to, "\n");
    }
    add(to, "}\n");
}

/* A default as an XML attribute: without brackets, the quotes of one string left out. */
static void add_attribute(text *to, const plr_field_info *field) {
    const char *from = field->initial;
    size_t length = strlen(from);
    bool trim = length >= 2 && (*from == '[' || (field->type == PLR_SFSTRING && *from == '"'));
    add(to, " ");
    add(to, field->name);
    add(to, "='");
    bool lower = plr_type_kind(field->type) == PLR_BOOL;
    for (size_t i = trim; i < length - trim; i++)
        add(to, (const char[]){lower ? (char)tolower((unsigned char)from[i]) : from[i], 0});
    add(to, "'");
}

static void add_xml(text *to, const plr_node_info *info) {
    add(to, "<X3D profile='Full' version='4.0'><Scene><");
    add(to, info->name);
    for (size_t i = 0; i < info->field_count; i++)
        if (can_be_given(&info->fields[i]) && plr_type_kind(info->fields[i].type) != PLR_NODE)
            add_attribute(to, &info->fields[i]);
    add(to, "/></Scene></X3D>\n");
}

static int complaints(const plr_diags *diags) {
    int count = 0;
    for (size_t i = 0; i < plr_diags_count(diags); i++) {
        const plr_diag *diag = plr_diags_get(diags, i);
        printf("# %s:%u:%u: %s [%s]\n", diag->place.file ? diag->place.file : "", diag->place.line,
               diag->place.column, diag->message, plr_code_text(diag->code));
        count++;
    }
    return count;
}

/* Fields whose value differs from that of the same node with nothing given. */
static int differences(const plr_node *given, const plr_node *bare) {
    int count = 0;
    for (size_t i = 0; i < plr_node_field_count(bare); i++) {
        const plr_field *a = plr_node_field_at(given, i), *b = plr_node_field_at(bare, i);
        bool same = a->count == b->count && a->type == b->type;
        if (same && plr_type_kind(a->type) == PLR_STRING)
            for (size_t k = 0; k < a->count; k++)
                same = same && strcmp(a->value.strings[k].text, b->value.strings[k].text) == 0;
        if (same && plr_type_kind(a->type) == PLR_FLOAT)
            for (size_t k = 0; k < a->count * (size_t)plr_type_components(a->type); k++)
                same = same && fabsf(a->value.floats[k] - b->value.floats[k]) < 1e-9F;
        if (same && plr_type_kind(a->type) == PLR_DOUBLE)
            for (size_t k = 0; k < a->count * (size_t)plr_type_components(a->type); k++)
                same = same && fabs(a->value.doubles[k] - b->value.doubles[k]) < 1e-12;
        if (same && plr_type_kind(a->type) == PLR_INT)
            for (size_t k = 0; k < a->count; k++)
                same = same && a->value.ints[k] == b->value.ints[k];
        if (same && plr_type_kind(a->type) == PLR_BOOL)
            for (size_t k = 0; k < a->count; k++)
                same = same && a->value.bools[k] == b->value.bools[k];
        if (!same) {
            printf("# %s.%s differs from its default\n", plr_node_type(bare), b->name);
            count++;
        }
    }
    return count;
}

static plr_scene *parse(const text *from, const char *name, plr_diags *diags) {
    return plr_scene_parse(from->bytes, from->length, name, NULL, diags);
}

static int faults(const plr_node_info *info, bool xml) {
    static text given, bare;
    given.length = bare.length = 0;
    if (xml)
        add_xml(&given, info);
    else
        add_classic(&given, info);
    add(&bare, "#X3D V4.0 utf8\nPROFILE Full\n");
    add(&bare, info->name);
    add(&bare, " {}\n");
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = parse(&given, xml ? "given.x3d" : "given.x3dv", diags);
    plr_scene *other = parse(&bare, "bare.x3dv", diags);
    int count = complaints(diags);
    const plr_node *node = scene ? plr_scene_root(scene, 0) : NULL;
    const plr_node *plain = other ? plr_scene_root(other, 0) : NULL;
    if (!node || !plain || strcmp(plr_node_type(node), info->name) != 0)
        count++;
    else
        count += differences(node, plain);
    plr_scene_destroy(&scene);
    plr_scene_destroy(&other);
    plr_diags_destroy(&diags);
    return count;
}

int main(void) {
    for (size_t i = 0; i < plr_node_info_count(); i++) {
        const plr_node_info *info = plr_node_info_at(i);
        TAP_RESULT(faults(info, false) == 0, "%s: the defaults can be read, Classic", info->name);
        TAP_RESULT(faults(info, true) == 0, "%s: the defaults can be read, XML", info->name);
    }
    return tap_done();
}
