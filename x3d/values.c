#include "x3d/values.h"

#include <float.h>
#include <math.h>
#include <string.h>

typedef struct reader {
    plr_scene *scene;
    x3d_lexer *lexer;
    const x3d_value_desc *desc;
    plr_kind kind;
    size_t size; /* of one number, bool or string in memory */
    char *items;
    size_t count, capacity;
    size_t start; /* of the value in the text */
    bool out_of_range;
    size_t range_at;
    double range_value;
} reader;

static bool fail(reader *r, size_t at, const char *what) {
    x3d_report(r->scene, PLR_CODE_BAD_VALUE, x3d_view_place(r->lexer->view, at), "%s.%s: %s",
               r->desc->node, r->desc->field, what);
    return false;
}

static void *new_item(reader *r) {
    if (r->count == r->capacity)
        r->items = plr_arena_grow(&r->scene->arena, r->items, &r->capacity, r->count + 1, r->size);
    return r->items + r->size * r->count++;
}

/* Fields of the table that are angles; an OrthoViewpoint's fieldOfView are four lengths. */
static bool is_angle(const reader *r) {
    static const struct {
        const char *name;
        plr_type type;
    } angles[] = {{"beamWidth", PLR_SFFLOAT},   {"cutOffAngle", PLR_SFFLOAT},
                  {"creaseAngle", PLR_SFFLOAT}, {"fieldOfView", PLR_SFFLOAT},
                  {"startAngle", PLR_SFFLOAT},  {"endAngle", PLR_SFFLOAT},
                  {"minAngle", PLR_SFFLOAT},    {"maxAngle", PLR_SFFLOAT},
                  {"skyAngle", PLR_MFFLOAT},    {"groundAngle", PLR_MFFLOAT}};
    for (size_t i = 0; r->desc->info && i < sizeof angles / sizeof *angles; i++)
        if (r->desc->type == angles[i].type && strcmp(r->desc->field, angles[i].name) == 0)
            return true;
    return false;
}

/* Radians for one of the angles in the text. */
static double angle_factor(const reader *r) {
    return r->desc->angle_factor > 0 ? r->desc->angle_factor : 1;
}

static void check_range(reader *r, double value, size_t at) {
    const plr_field_info *info = r->desc->info;
    if (!info || r->out_of_range)
        return;
    if (angle_factor(r) != 1 && is_angle(r))
        value *= angle_factor(r);
    bool low = info->exclusive_minimum ? value <= info->minimum : value < info->minimum;
    bool high = info->exclusive_maximum ? value >= info->maximum : value > info->maximum;
    if (low || high) {
        r->out_of_range = true;
        r->range_at = at;
        r->range_value = value;
    }
}

/* Pixels use all 32 bits, so they may be written as unsigned numbers. */
static bool is_pixels(const reader *r) {
    plr_type type = r->desc->type;
    return type == PLR_SFIMAGE || type == PLR_MFIMAGE || strcmp(r->desc->field, "image") == 0;
}

static bool read_integer(reader *r, const char *text, size_t left, size_t at, size_t *used) {
    int64_t value;
    *used = x3d_parse_integer(text, left, &value);
    if (!*used)
        return fail(r, at, "a whole number is expected");
    bool hexadecimal = *used > 2 && memchr(text, 'x', *used < 3 ? *used : 3) != NULL;
    hexadecimal = hexadecimal || (*used > 2 && memchr(text, 'X', *used < 3 ? *used : 3) != NULL);
    int64_t most = hexadecimal || is_pixels(r) ? (int64_t)UINT32_MAX : INT32_MAX;
    if (value > most || value < INT32_MIN)
        return fail(r, at, "the number does not fit into 32 bits");
    check_range(r, (double)value, at);
    uint32_t bits = (uint32_t)value;
    memcpy(new_item(r), &bits, sizeof bits);
    return true;
}

static bool read_real(reader *r, const char *text, size_t left, size_t at, size_t *used) {
    double value;
    *used = x3d_parse_number(text, left, &value);
    if (!*used)
        return fail(r, at, "a number is expected");
    check_range(r, value, at);
    if (r->kind == PLR_DOUBLE) {
        if (!isfinite(value))
            return fail(r, at, "the number is too large");
        memcpy(new_item(r), &value, sizeof value);
        return true;
    }
    if (fabs(value) > FLT_MAX)
        return fail(r, at, "the number is too large");
    float number = (float)value;
    memcpy(new_item(r), &number, sizeof number);
    return true;
}

/* Reads all numbers that follow, up to `limit` of them. */
static bool read_numbers(reader *r, size_t limit) {
    x3d_lexer *lexer = r->lexer;
    while (r->count < limit && x3d_starts_number(x3d_lexer_next(lexer))) {
        size_t at = lexer->at, used = 0;
        const char *text = lexer->text + at;
        bool ok = r->kind == PLR_INT ? read_integer(r, text, lexer->length - at, at, &used)
                                     : read_real(r, text, lexer->length - at, at, &used);
        if (!ok)
            return false;
        lexer->at += used;
        if (lexer->at >= lexer->length || x3d_is_delimiter((unsigned char)lexer->text[lexer->at]))
            continue;
        while (lexer->at < lexer->length &&
               !x3d_is_delimiter((unsigned char)lexer->text[lexer->at]))
            lexer->at++;
        return fail(r, at,
                    r->kind == PLR_INT ? "this is not a whole number" : "this is not a number");
    }
    return true;
}

static bool read_bools(reader *r, size_t limit) {
    x3d_word word;
    while (r->count < limit && x3d_lexer_peek_word(r->lexer, &word)) {
        bool yes = x3d_word_is(&word, "TRUE") || x3d_word_is(&word, "true");
        if (!yes && !x3d_word_is(&word, "FALSE") && !x3d_word_is(&word, "false"))
            break;
        r->lexer->at += word.length;
        memcpy(new_item(r), &yes, sizeof yes);
    }
    return true;
}

static bool read_strings(reader *r, size_t limit) {
    x3d_lexer *lexer = r->lexer;
    unsigned flags = X3D_ESCAPES;
    if (r->desc->xml && !r->desc->keep_newlines)
        flags |= X3D_BLANK_NEWLINES;
    while (r->count < limit && x3d_lexer_next(lexer) == '"') {
        size_t at = lexer->at, start, end;
        if (!x3d_lexer_string(lexer, &start, &end)) {
            x3d_report(r->scene, PLR_CODE_SYNTAX, x3d_view_place(lexer->view, at),
                       "%s.%s: the string is never closed", r->desc->node, r->desc->field);
            return false;
        }
        plr_string string = x3d_view_string(&r->scene->arena, lexer->view, start, end, flags);
        memcpy(new_item(r), &string, sizeof string);
    }
    return true;
}

static bool read_items(reader *r, size_t limit) {
    switch (r->kind) {
    case PLR_BOOL:
        return read_bools(r, limit);
    case PLR_STRING:
        return read_strings(r, limit);
    default:
        return read_numbers(r, limit);
    }
}

static size_t size_of_kind(plr_kind kind) {
    static const size_t sizes[] = {sizeof(bool),   sizeof(int32_t),    sizeof(float),
                                   sizeof(double), sizeof(plr_string), sizeof(plr_node *)};
    return sizes[kind];
}

/* XML: a string without quotes is the whole text. */
static void read_whole_text(reader *r) {
    unsigned flags = r->desc->keep_newlines ? 0 : X3D_BLANK_NEWLINES;
    plr_string string =
        x3d_view_string(&r->scene->arena, r->lexer->view, 0, r->lexer->length, flags);
    memcpy(new_item(r), &string, sizeof string);
    r->lexer->at = r->lexer->length;
}

static const char *expectation(plr_type type) {
    switch (plr_type_kind(type)) {
    case PLR_BOOL:
        return "TRUE or FALSE is expected";
    case PLR_STRING:
        return "a string in quotes is expected";
    case PLR_INT:
        return "a whole number is expected";
    default:
        return "a number is expected";
    }
}

/* A colour with alpha may be given as the three numbers of the dialect of 2005. */
static void complete_colours(reader *r) {
    if (r->count % 4 == 0 || r->count % 3 != 0)
        return;
    float *rgb = (float *)(void *)r->items;
    size_t colours = r->count / 3;
    float *rgba = PLR_NEW_ARRAY(&r->scene->arena, colours * 4, float);
    for (size_t i = 0; i < colours; i++) {
        memcpy(rgba + 4 * i, rgb + 3 * i, 3 * sizeof(float));
        rgba[4 * i + 3] = 1;
    }
    r->items = (char *)rgba;
    r->count = r->capacity = colours * 4;
}

static bool is_field_next(reader *r) {
    x3d_word word;
    return r->desc->owner && x3d_lexer_peek_word(r->lexer, &word) &&
           x3d_field_index(r->scene, r->desc->owner, word.text, word.length,
                           x3d_lexer_place(r->lexer)) != SIZE_MAX;
}

/* Whether a word is next that stands where a number should: in Classic VRML it may be the
 * misspelled name of the next field, too, but that has a value behind it. Then reports and passes
 * it. */
static bool word_for_number(reader *r) {
    x3d_word word;
    x3d_lexer *lexer = r->lexer;
    if (!x3d_lexer_peek_word(lexer, &word) || (!r->desc->xml && is_field_next(r)))
        return false;
    lexer->at += word.length;
    int next = x3d_lexer_next(lexer);
    bool passed = r->desc->xml || next < 0 || next == '}' || next == ']' ||
                  x3d_starts_number(next) || is_field_next(r);
    if (passed)
        fail(r, word.at, expectation(r->desc->type));
    else
        lexer->at = word.at;
    return passed;
}

static bool too_few(reader *r, size_t expected) {
    if (word_for_number(r))
        return false;
    x3d_report(r->scene, PLR_CODE_BAD_VALUE, x3d_view_place(r->lexer->view, r->start),
               "%s.%s: %s takes %zu numbers, here are %zu", r->desc->node, r->desc->field,
               plr_type_name(r->desc->type), expected, r->count);
    return false;
}

static bool too_many(reader *r, size_t expected, size_t at) {
    read_items(r, SIZE_MAX);
    x3d_report(r->scene, PLR_CODE_BAD_VALUE, x3d_view_place(r->lexer->view, at),
               "%s.%s: %s takes %zu number%s, here are %zu", r->desc->node, r->desc->field,
               plr_type_name(r->desc->type), expected, expected == 1 ? "" : "s", r->count);
    return false;
}

/* The number of integers that images beginning at `ints` declare: 3 + w*h each; 0: malformed. */
static bool check_image(reader *r) {
    const int32_t *ints = (const int32_t *)(const void *)r->items;
    size_t at = 0;
    while (at < r->count || (at == 0 && r->desc->type == PLR_SFIMAGE)) {
        if (r->count - at < 3)
            return fail(r, r->start, "an image begins with width, height and components");
        int64_t width = ints[at], height = ints[at + 1], components = ints[at + 2];
        if (width < 0 || height < 0 || components < 0 || components > 4)
            return fail(r, r->start, "width, height or components of the image cannot be right");
        uint64_t pixels = components ? (uint64_t)width * (uint64_t)height : 0;
        if (r->count - at - 3 < pixels)
            return fail(r, r->start, "the image has fewer pixels than it declares");
        at += 3 + (size_t)pixels;
        if (r->desc->type == PLR_SFIMAGE && at != r->count)
            return fail(r, r->start, "the image has more pixels than it declares");
    }
    return true;
}

static bool single_extra(reader *r, size_t expected) {
    int next = x3d_lexer_next(r->lexer);
    size_t at = r->lexer->at;
    bool more = r->kind == PLR_STRING ? next == '"' : x3d_starts_number(next);
    if (r->kind == PLR_BOOL || !more)
        return true;
    return too_many(r, expected, at);
}

static bool read_single(reader *r) {
    plr_type type = r->desc->type;
    if (type == PLR_SFIMAGE)
        return read_numbers(r, SIZE_MAX) && check_image(r);
    size_t expected = (size_t)plr_type_components(type);
    if (type == PLR_SFSTRING && r->desc->xml) {
        read_whole_text(r);
        return true;
    }
    if (!read_items(r, expected))
        return false;
    if (r->count == 0)
        return fail(r, r->lexer->at, expectation(type));
    if (type == PLR_SFCOLORRGBA)
        complete_colours(r);
    if (r->count < expected)
        return too_few(r, expected);
    return single_extra(r, expected);
}

static bool read_multiple(reader *r) {
    plr_type type = r->desc->type;
    x3d_lexer *lexer = r->lexer;
    if (type == PLR_MFSTRING && r->desc->xml && lexer->at < lexer->length &&
        x3d_lexer_next(lexer) != '"' && x3d_lexer_next(lexer) >= 0) {
        if (x3d_lexer_next(lexer) == '\'')
            x3d_warn(r->scene, PLR_CODE_BAD_VALUE, x3d_lexer_place(lexer),
                     "%s.%s: the strings of a list stand in double quotes", r->desc->node,
                     r->desc->field);
        read_whole_text(r);
        return true;
    }
    bool bracket = !r->desc->xml && x3d_lexer_accept(lexer, '[');
    if (!read_items(r, SIZE_MAX))
        return false;
    int next = x3d_lexer_next(lexer);
    if (bracket && next != ']')
        return fail(r, lexer->at, next < 0 ? "the list is never closed" : expectation(type));
    if (bracket)
        lexer->at++;
    else if (r->count == 0 && !r->desc->xml)
        return fail(r, lexer->at, expectation(type));
    if (type == PLR_MFIMAGE)
        return check_image(r);
    if (type == PLR_MFCOLORRGBA)
        complete_colours(r);
    size_t components = (size_t)plr_type_components(type);
    if (r->count % components) {
        x3d_report(r->scene, PLR_CODE_BAD_VALUE, x3d_view_place(lexer->view, r->start),
                   "%s.%s: %zu numbers do not make a list of %s, which takes %zu each",
                   r->desc->node, r->desc->field, r->count, plr_type_name(type), components);
        return false;
    }
    return true;
}

/* A value that the table itself gives as default ("-1 -1 -1": none) is no fault of range. */
static bool is_default(const reader *r, const plr_field *field) {
    size_t components = (size_t)plr_type_components(r->desc->type);
    return field->count * components == r->count && r->count &&
           memcmp(field->value.any, r->items, r->count * r->size) == 0;
}

/* A file may count angles in another unit than radians. */
static void turn_angles(reader *r) {
    double factor = angle_factor(r);
    bool rotation = r->desc->type == PLR_SFROTATION || r->desc->type == PLR_MFROTATION;
    if (factor == 1 || (!rotation && !is_angle(r)))
        return;
    float *numbers = (float *)(void *)r->items;
    for (size_t i = rotation ? 3 : 0; i < r->count; i += rotation ? 4 : 1)
        numbers[i] = (float)((double)numbers[i] * factor);
}

bool x3d_value_read(plr_scene *scene, x3d_lexer *lexer, const x3d_value_desc *desc,
                    plr_field *field) {
    x3d_lexer_next(lexer);
    plr_kind kind = plr_type_kind(desc->type);
    reader r = {.scene = scene,
                .lexer = lexer,
                .desc = desc,
                .kind = kind,
                .size = size_of_kind(kind),
                .start = lexer->at};
    bool ok = plr_type_is_multiple(desc->type) ? read_multiple(&r) : read_single(&r);
    if (ok && desc->xml && x3d_lexer_next(lexer) >= 0)
        ok = fail(&r, lexer->at, expectation(desc->type));
    if (!ok)
        return false;
    if (r.out_of_range && !is_default(&r, field))
        x3d_report(scene, PLR_CODE_BAD_RANGE, x3d_view_place(lexer->view, r.range_at),
                   "%s.%s: %g is outside the range of the field", desc->node, desc->field,
                   r.range_value);
    turn_angles(&r);
    bool image = desc->type == PLR_SFIMAGE || desc->type == PLR_MFIMAGE;
    size_t components = image ? 1 : (size_t)plr_type_components(desc->type);
    field->count = r.count / components;
    field->value.any = r.items;
    return true;
}
