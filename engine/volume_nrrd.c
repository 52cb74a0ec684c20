/* The NRRD reader: the header, as the "Definition of NRRD File Format" of the Teem project
 * describes it (http://teem.sourceforge.net/nrrd/format.html). */
#include "engine/volume_nrrd.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_HEADER ((size_t)1 << 20)

plr_place plr_nrrd_place(const nrrd *header, const char *at) {
    return (plr_place){header->source->name, header->line, (uint32_t)(at - header->line_start) + 1};
}

#define FAIL(header, at, ...) NRRD_FAIL(header, plr_nrrd_place(header, at), __VA_ARGS__)

/* ---- pieces of a line ---- */

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

static void skip_blanks(nrrd_text *text) {
    while (text->at < text->end && is_blank(*text->at))
        text->at++;
}

static nrrd_text trim(nrrd_text text) {
    skip_blanks(&text);
    while (text.end > text.at && is_blank(text.end[-1]))
        text.end--;
    return text;
}

/* The next word, empty at the end; `text` goes on behind it. */
static nrrd_text next_word(nrrd_text *text) {
    skip_blanks(text);
    nrrd_text word = {text->at, text->at};
    while (word.end < text->end && !is_blank(*word.end))
        word.end++;
    text->at = word.end;
    return word;
}

static int width(nrrd_text text) {
    return text.end - text.at > 80 ? 80 : (int)(text.end - text.at);
}

static char lower(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c + 32) : c;
}

/* Lower case, runs of blanks as one blank (or none), cut to the size of the buffer. */
static void normalise(nrrd_text text, bool keep_blanks, char *buffer, size_t size) {
    size_t used = 0;
    text = trim(text);
    for (; text.at < text.end && used < size - 1; text.at++) {
        bool blank = is_blank(*text.at);
        if (!blank)
            buffer[used++] = lower(*text.at);
        else if (keep_blanks && !is_blank(text.at[1]))
            buffer[used++] = ' ';
    }
    buffer[used] = '\0';
}

/* The row of a table {name, value} that the text names, or -1. */
typedef struct name_row {
    const char *name;
    int value;
} name_row;

static const name_row *find_name(const name_row *rows, size_t count, nrrd_text text,
                                 bool keep_blanks) {
    char name[64];
    normalise(text, keep_blanks, name, sizeof name);
    for (size_t i = 0; i < count; i++)
        if (strcmp(rows[i].name, name) == 0)
            return &rows[i];
    return NULL;
}

#define FIND_NAME(rows, text, keep_blanks)                                                         \
    find_name(rows, sizeof(rows) / sizeof *(rows), text, keep_blanks)

static bool copy_token(nrrd_text text, char *buffer, size_t size) {
    size_t length = (size_t)(text.end - text.at);
    if (length == 0 || length >= size)
        return false;
    memcpy(buffer, text.at, length);
    buffer[length] = '\0';
    return true;
}

static bool read_number(const nrrd *header, nrrd_text word, double *number) {
    char token[64], *end = token;
    if (copy_token(word, token, sizeof token))
        *number = strtod(token, &end);
    if (end == token || *end)
        return FAIL(header, word.at, "'%.*s' is not a number", width(word), word.at);
    return true;
}

static bool read_integer(const nrrd *header, nrrd_text word, int64_t least, int64_t *number) {
    char token[24], *end = token;
    long long value = 0;
    if (copy_token(word, token, sizeof token))
        value = strtoll(token, &end, 10);
    if (end == token || *end)
        return FAIL(header, word.at, "'%.*s' is not an integer", width(word), word.at);
    if (value < least || value > INT64_C(1) << 53)
        return FAIL(header, word.at, "%lld is out of range", value);
    *number = value;
    return true;
}

static bool read_count(const nrrd *header, nrrd_text text, uint64_t *number) {
    int64_t value;
    if (!read_integer(header, trim(text), 0, &value))
        return false;
    *number = (uint64_t)value;
    return true;
}

/* A word for one more axis; false at the end of the line. */
static bool next_axis(const nrrd *header, nrrd_per_axis *given, nrrd_text *text, nrrd_text *word,
                      bool *too_many) {
    *word = next_word(text);
    *too_many = word->at < word->end && given->count == NRRD_MAX_AXES;
    if (*too_many)
        return FAIL(header, word->at, "there are more than %d axes", NRRD_MAX_AXES);
    return word->at < word->end;
}

static void start_axes(const nrrd *header, nrrd_per_axis *given, nrrd_text text) {
    given->count = 0;
    given->place = plr_nrrd_place(header, text.at);
}

/* ---- tables ---- */

enum {
    BLOCK = -1
};
static const name_row types[] = {
    {"signed char", PLR_VOXEL_S8},
    {"int8", PLR_VOXEL_S8},
    {"int8_t", PLR_VOXEL_S8},
    {"uchar", PLR_VOXEL_U8},
    {"unsigned char", PLR_VOXEL_U8},
    {"uint8", PLR_VOXEL_U8},
    {"uint8_t", PLR_VOXEL_U8},
    {"short", PLR_VOXEL_S16},
    {"short int", PLR_VOXEL_S16},
    {"signed short", PLR_VOXEL_S16},
    {"signed short int", PLR_VOXEL_S16},
    {"int16", PLR_VOXEL_S16},
    {"int16_t", PLR_VOXEL_S16},
    {"ushort", PLR_VOXEL_U16},
    {"unsigned short", PLR_VOXEL_U16},
    {"unsigned short int", PLR_VOXEL_U16},
    {"uint16", PLR_VOXEL_U16},
    {"uint16_t", PLR_VOXEL_U16},
    {"int", PLR_VOXEL_S32},
    {"signed int", PLR_VOXEL_S32},
    {"int32", PLR_VOXEL_S32},
    {"int32_t", PLR_VOXEL_S32},
    {"uint", PLR_VOXEL_U32},
    {"unsigned int", PLR_VOXEL_U32},
    {"uint32", PLR_VOXEL_U32},
    {"uint32_t", PLR_VOXEL_U32},
    {"longlong", PLR_VOXEL_S64},
    {"long long", PLR_VOXEL_S64},
    {"long long int", PLR_VOXEL_S64},
    {"signed long long", PLR_VOXEL_S64},
    {"signed long long int", PLR_VOXEL_S64},
    {"int64", PLR_VOXEL_S64},
    {"int64_t", PLR_VOXEL_S64},
    {"ulonglong", PLR_VOXEL_U64},
    {"unsigned long long", PLR_VOXEL_U64},
    {"unsigned long long int", PLR_VOXEL_U64},
    {"uint64", PLR_VOXEL_U64},
    {"uint64_t", PLR_VOXEL_U64},
    {"float", PLR_VOXEL_F32},
    {"double", PLR_VOXEL_F64},
    {"block", BLOCK},
};

static const name_row encodings[] = {
    {"raw", NRRD_RAW},   {"gz", NRRD_GZIP},    {"gzip", NRRD_GZIP},
    {"txt", NRRD_ASCII}, {"text", NRRD_ASCII}, {"ascii", NRRD_ASCII},
    {"hex", NRRD_HEX},   {"bz2", NRRD_BZIP2},  {"bzip2", NRRD_BZIP2},
};

static const name_row kinds[] = {
    {"domain", NRRD_SPATIAL},
    {"space", NRRD_SPATIAL},
    {"time", NRRD_TIME},
    {"scalar", NRRD_FIRST_ONLY},
    {"stub", NRRD_FIRST_ONLY},
    {"none", NRRD_NO_ROLE},
    {"???", NRRD_NO_ROLE},
    {"list", NRRD_COMPONENTS},
    {"point", NRRD_COMPONENTS},
    {"vector", NRRD_COMPONENTS},
    {"covariant-vector", NRRD_COMPONENTS},
    {"normal", NRRD_COMPONENTS},
    {"complex", NRRD_COMPONENTS},
    {"2-vector", NRRD_COMPONENTS},
    {"3-color", NRRD_COMPONENTS},
    {"rgb-color", NRRD_COMPONENTS},
    {"hsv-color", NRRD_COMPONENTS},
    {"xyz-color", NRRD_COMPONENTS},
    {"4-color", NRRD_COMPONENTS},
    {"rgba-color", NRRD_COMPONENTS},
    {"3-vector", NRRD_COMPONENTS},
    {"3-gradient", NRRD_COMPONENTS},
    {"3-normal", NRRD_COMPONENTS},
    {"4-vector", NRRD_COMPONENTS},
    {"quaternion", NRRD_COMPONENTS},
    {"2d-symmetric-tensor", NRRD_COMPONENTS},
    {"2d-sym-tensor", NRRD_COMPONENTS},
    {"2d-masked-symmetric-tensor", NRRD_COMPONENTS},
    {"2d-masked-sym-tensor", NRRD_COMPONENTS},
    {"2d-tensor", NRRD_COMPONENTS},
    {"2d-masked-tensor", NRRD_COMPONENTS},
    {"3d-symmetric-tensor", NRRD_COMPONENTS},
    {"3d-sym-tensor", NRRD_COMPONENTS},
    {"3d-masked-symmetric-tensor", NRRD_COMPONENTS},
    {"3d-masked-sym-tensor", NRRD_COMPONENTS},
    {"3d-matrix", NRRD_COMPONENTS},
    {"2d-matrix", NRRD_COMPONENTS},
    {"3d-tensor", NRRD_COMPONENTS},
    {"3d-masked-tensor", NRRD_COMPONENTS},
};

/* Names of spaces: their dimension * 8 + which way the axes run. */
static const name_row spaces[] = {
    {"right-anterior-superior", 24 + PLR_SPACE_RAS},
    {"ras", 24 + PLR_SPACE_RAS},
    {"left-anterior-superior", 24 + PLR_SPACE_LAS},
    {"las", 24 + PLR_SPACE_LAS},
    {"left-posterior-superior", 24 + PLR_SPACE_LPS},
    {"lps", 24 + PLR_SPACE_LPS},
    {"scanner-xyz", 24},
    {"3d-right-handed", 24},
    {"3d-left-handed", 24 + PLR_SPACE_LEFT_HANDED},
    {"right-anterior-superior-time", 32},
    {"rast", 32},
    {"left-anterior-superior-time", 32},
    {"last", 32},
    {"left-posterior-superior-time", 32},
    {"lpst", 32},
    {"scanner-xyz-time", 32},
    {"3d-right-handed-time", 32},
    {"3d-left-handed-time", 32},
};

/* Powers of ten of a metre. */
static const name_row units[] = {
    {"m", 0},
    {"meter", 0},
    {"meters", 0},
    {"metre", 0},
    {"metres", 0},
    {"cm", -2},
    {"centimeter", -2},
    {"centimeters", -2},
    {"mm", -3},
    {"millimeter", -3},
    {"millimeters", -3},
    {"millimetre", -3},
    {"millimetres", -3},
    {"um", -6},
    {"micron", -6},
    {"microns", -6},
    {"micrometer", -6},
    {"micrometers", -6},
    {"\xc2\xb5m", -6},
    {"\xce\xbcm", -6},
    {"nm", -9},
    {"nanometer", -9},
    {"nanometers", -9},
    {"angstrom", -10},
    {"angstroms", -10},
    {"a", -10},
};

/* ---- fields ---- */

static bool read_type(nrrd *header, nrrd_text text) {
    const name_row *row = FIND_NAME(types, text, true);
    if (!row)
        return FAIL(header, text.at, "'%.*s' is not a type of NRRD", width(text), text.at);
    if (row->value == BLOCK)
        return FAIL(header, text.at, "data of type block have no values to draw");
    header->type = (plr_voxel_type)row->value;
    header->type_place = plr_nrrd_place(header, text.at);
    header->has_type = true;
    return true;
}

static bool read_encoding(nrrd *header, nrrd_text text) {
    const name_row *row = FIND_NAME(encodings, text, false);
    if (!row)
        return FAIL(header, text.at, "'%.*s' is not an encoding of NRRD", width(text), text.at);
    if (row->value == NRRD_BZIP2)
        return FAIL(header, text.at, "data packed by bzip2 are not read; save them as raw or gzip");
    header->encoding = (nrrd_encoding)row->value;
    header->encoding_place = plr_nrrd_place(header, text.at);
    return true;
}

static bool read_endian(nrrd *header, nrrd_text text) {
    char word[16];
    normalise(text, false, word, sizeof word);
    header->big_endian = strcmp(word, "big") == 0;
    header->has_endian = header->big_endian || strcmp(word, "little") == 0;
    if (!header->has_endian)
        return FAIL(header, text.at, "'%.*s' is neither little nor big", width(text), text.at);
    return true;
}

static bool read_dimension(nrrd *header, nrrd_text text) {
    if (!read_count(header, text, &header->dimension))
        return false;
    if (header->dimension < 1 || header->dimension > NRRD_MAX_AXES)
        return FAIL(header, text.at, "%llu axes are outside 1..%d",
                    (unsigned long long)header->dimension, NRRD_MAX_AXES);
    return true;
}

static bool read_sizes(nrrd *header, nrrd_text text) {
    nrrd_per_axis *given = &header->sizes_given;
    nrrd_text word;
    bool bad;
    start_axes(header, given, text);
    while (next_axis(header, given, &text, &word, &bad)) {
        uint64_t *size = &header->sizes[given->count++];
        if (!read_count(header, word, size))
            return false;
        if (*size == 0)
            return FAIL(header, word.at, "an axis has no samples");
    }
    return !bad;
}

static bool read_spacings(nrrd *header, nrrd_text text) {
    nrrd_per_axis *given = &header->spacings_given;
    nrrd_text word;
    bool bad;
    start_axes(header, given, text);
    while (next_axis(header, given, &text, &word, &bad))
        if (!read_number(header, word, &header->spacings[given->count++]))
            return false;
    return !bad;
}

static bool read_kinds(nrrd *header, nrrd_text text) {
    nrrd_per_axis *given = &header->kinds_given;
    nrrd_text word;
    bool bad;
    start_axes(header, given, text);
    while (next_axis(header, given, &text, &word, &bad)) {
        const name_row *row = FIND_NAME(kinds, word, false);
        if (!row)
            return FAIL(header, word.at, "'%.*s' is not a kind of axis", width(word), word.at);
        header->kinds[given->count++] = (nrrd_role)row->value;
    }
    return !bad;
}

/* A quoted string; what it means as a unit of length in metres, 0 if it is none. */
static bool read_unit(const nrrd *header, nrrd_text *text, double *metres, bool *found) {
    skip_blanks(text);
    *found = text->at < text->end;
    if (!*found)
        return true;
    if (*text->at != '"')
        return FAIL(header, text->at, "a string in quotes is expected");
    nrrd_text word = {text->at + 1, text->at + 1};
    while (word.end < text->end && *word.end != '"')
        word.end += *word.end == '\\' && word.end + 1 < text->end ? 2 : 1;
    if (word.end == text->end)
        return FAIL(header, text->at, "this string is never closed");
    const name_row *row = FIND_NAME(units, word, false);
    *metres = row ? pow(10, row->value) : 0;
    text->at = word.end + 1;
    return true;
}

static bool read_units(nrrd *header, nrrd_text text) {
    nrrd_per_axis *given = &header->units_given;
    bool found = true;
    start_axes(header, given, text);
    while (found) {
        double metres = 0;
        if (!read_unit(header, &text, &metres, &found))
            return false;
        if (found && given->count == NRRD_MAX_AXES)
            return FAIL(header, text.at, "there are more than %d axes", NRRD_MAX_AXES);
        if (found)
            header->units[given->count++] = metres;
    }
    return true;
}

static bool read_space_units(nrrd *header, nrrd_text text) {
    bool found = true;
    header->space_unit_count = 0;
    while (found) {
        double metres = 0;
        if (!read_unit(header, &text, &metres, &found))
            return false;
        if (found && header->space_unit_count < 3)
            header->space_units[header->space_unit_count++] = metres;
    }
    return true;
}

static bool read_space(nrrd *header, nrrd_text text) {
    const name_row *row = FIND_NAME(spaces, text, false);
    if (!row)
        return FAIL(header, text.at, "'%.*s' is not a space of NRRD", width(text), text.at);
    header->space = (plr_volume_space)(row->value % 8);
    header->space_dimension = (uint64_t)(row->value / 8);
    return true;
}

static bool read_space_dimension(nrrd *header, nrrd_text text) {
    return read_count(header, text, &header->space_dimension);
}

/* "(1,0,0)": up to three numbers are kept, `count` says how many there were. */
static bool read_vector(const nrrd *header, nrrd_text *text, double vector[3], size_t *count) {
    skip_blanks(text);
    *count = 0;
    if (text->at == text->end || *text->at != '(')
        return FAIL(header, text->at, "a vector in parentheses is expected");
    while (*text->at != ')') {
        nrrd_text number = {text->at + 1, text->at + 1};
        while (number.end < text->end && *number.end != ',' && *number.end != ')')
            number.end++;
        if (number.end == text->end)
            return FAIL(header, text->at, "this vector is never closed");
        double value;
        text->at = number.end;
        if (!read_number(header, trim(number), &value))
            return false;
        if (*count < 3)
            vector[*count] = value;
        ++*count;
    }
    text->at++;
    return true;
}

static bool read_directions(nrrd *header, nrrd_text text) {
    nrrd_per_axis *given = &header->directions_given;
    start_axes(header, given, text);
    header->direction_components = 0;
    for (skip_blanks(&text); text.at < text.end; skip_blanks(&text)) {
        if (given->count == NRRD_MAX_AXES)
            return FAIL(header, text.at, "there are more than %d axes", NRRD_MAX_AXES);
        size_t axis = given->count++, components = 0;
        header->no_direction[axis] = *text.at != '(';
        if (*text.at != '(') {
            char word[8];
            nrrd_text none = next_word(&text);
            normalise(none, false, word, sizeof word);
            if (strcmp(word, "none") != 0)
                return FAIL(header, none.at, "a vector or none is expected");
            continue;
        }
        const char *start = text.at;
        if (!read_vector(header, &text, header->directions[axis], &components))
            return false;
        if (header->direction_components && header->direction_components != components)
            return FAIL(header, start, "this vector has %zu numbers, the one before %zu",
                        components, header->direction_components);
        header->direction_components = components;
    }
    return true;
}

static bool read_origin(nrrd *header, nrrd_text text) {
    return read_vector(header, &text, header->origin, &header->origin_count);
}

static bool read_minimum(nrrd *header, nrrd_text text) {
    return read_number(header, text, &header->minimum);
}

static bool read_maximum(nrrd *header, nrrd_text text) {
    return read_number(header, text, &header->maximum);
}

static bool read_line_skip(nrrd *header, nrrd_text text) {
    return read_count(header, text, &header->line_skip);
}

static bool read_byte_skip(nrrd *header, nrrd_text text) {
    return read_integer(header, text, -1, &header->byte_skip);
}

/* `first last step [dimension]` behind a pattern. */
static bool read_pattern(nrrd *header, nrrd_text text) {
    int64_t *const numbers[] = {&header->first, &header->last, &header->step};
    for (int i = 0; i < 3; i++)
        if (!read_integer(header, next_word(&text), -(INT64_C(1) << 32), numbers[i]))
            return false;
    if (header->step == 0 || (header->last - header->first) / header->step < 0)
        return FAIL(header, text.at, "no numbers lead from %lld to %lld in steps of %lld",
                    (long long)header->first, (long long)header->last, (long long)header->step);
    header->file_count = (uint64_t)((header->last - header->first) / header->step) + 1;
    nrrd_text word = next_word(&text);
    return word.at == word.end || read_count(header, word, &header->file_dimension);
}

static bool read_data_file(nrrd *header, nrrd_text text) {
    nrrd_text rest = text, word = next_word(&rest);
    header->files_place = plr_nrrd_place(header, text.at);
    header->file_name = text;
    header->files = NRRD_ONE_FILE;
    header->file_count = 1;
    if (text.at == text.end)
        return FAIL(header, text.at, "the name of the data file is missing");
    if (word.end - word.at == 4 && memcmp(word.at, "LIST", 4) == 0) {
        header->files = NRRD_LIST;
        header->file_count = 0;
        header->file_name.at = NULL;
        word = next_word(&rest);
        return word.at == word.end || read_count(header, word, &header->file_dimension);
    }
    if (memchr(word.at, '%', (size_t)(word.end - word.at)) && trim(rest).at < rest.end) {
        header->files = NRRD_PATTERN;
        header->file_name = word;
        return read_pattern(header, rest);
    }
    return true;
}

static bool read_nothing(nrrd *header, nrrd_text text) {
    (void)header;
    (void)text;
    return true;
}

/* Fields by their names in lower case without blanks. Those that say nothing of the picture are
 * read over: "old min" and "old max" among them, which speak of values before quantisation. */
static const struct {
    const char *name;
    bool (*read)(nrrd *header, nrrd_text text);
} fields[] = {
    {"type", read_type},
    {"dimension", read_dimension},
    {"sizes", read_sizes},
    {"encoding", read_encoding},
    {"endian", read_endian},
    {"spacings", read_spacings},
    {"kinds", read_kinds},
    {"units", read_units},
    {"space", read_space},
    {"spacedimension", read_space_dimension},
    {"spaceunits", read_space_units},
    {"spacedirections", read_directions},
    {"spaceorigin", read_origin},
    {"min", read_minimum},
    {"max", read_maximum},
    {"lineskip", read_line_skip},
    {"byteskip", read_byte_skip},
    {"datafile", read_data_file},
    {"content", read_nothing},
    {"number", read_nothing},
    {"blocksize", read_nothing},
    {"thicknesses", read_nothing},
    {"axismins", read_nothing},
    {"axismaxs", read_nothing},
    {"centers", read_nothing},
    {"centerings", read_nothing},
    {"labels", read_nothing},
    {"oldmin", read_nothing},
    {"oldmax", read_nothing},
    {"sampleunits", read_nothing},
    {"measurementframe", read_nothing},
};

/* ---- lines ---- */

static bool read_field(nrrd *header, nrrd_text line) {
    const char *colon = memchr(line.at, ':', (size_t)(line.end - line.at));
    if (!colon)
        return FAIL(header, line.at, "this is no field of a header; an empty line ends the header");
    if (colon + 1 < line.end && colon[1] == '=') {
        plr_nrrd_read_key(header, (nrrd_text){line.at, colon}, (nrrd_text){colon + 2, line.end});
        return true;
    }
    char name[32];
    normalise((nrrd_text){line.at, colon}, false, name, sizeof name);
    nrrd_text value = trim((nrrd_text){colon + 1, line.end});
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        if (strcmp(fields[i].name, name) == 0)
            return fields[i].read(header, value);
    plr_diags_add_as(header->source->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME,
                     plr_nrrd_place(header, line.at), "'%.*s' is not a field of NRRD",
                     width((nrrd_text){line.at, colon}), line.at);
    return true;
}

static bool read_line(nrrd *header, nrrd_text line) {
    if (header->line == 1) {
        const char *version = line.at + 4;
        if (line.end - line.at < 8 || memcmp(version, "000", 3) != 0 || version[3] < '1' ||
            version[3] > '5')
            return FAIL(header, line.at, "'%.*s' is not a version of NRRD that is known",
                        width(line), line.at);
        return true;
    }
    if (*line.at == '#')
        return true;
    if (header->files != NRRD_LIST)
        return read_field(header, line);
    if (!header->file_name.at)
        header->file_name.at = line.at;
    if (++header->file_count > NRRD_MAX_FILES)
        return FAIL(header, line.at, "there are more than %d data files", NRRD_MAX_FILES);
    return true;
}

static bool check_axes(const nrrd *header, const nrrd_per_axis *given, const char *name) {
    if (given->place.line == 0 || given->count == header->dimension)
        return true;
    return NRRD_FAIL(header, given->place, "%s has %zu values for %llu axes", name, given->count,
                     (unsigned long long)header->dimension);
}

/* What can only be known at the end of the header. */
static bool check_header(nrrd *header) {
    plr_place whole = {header->source->name, header->line, 1};
    if (!header->has_type)
        return NRRD_FAIL(header, whole, "the header has no type");
    if (!header->sizes_given.place.line)
        return NRRD_FAIL(header, whole, "the header has no sizes");
    if (!header->encoding)
        return NRRD_FAIL(header, whole, "the header has no encoding");
    if (!header->dimension)
        return NRRD_FAIL(header, whole, "the header has no dimension");
    if (header->files == NRRD_ATTACHED && !header->data)
        return NRRD_FAIL(header, whole, "the header names no data file, and no empty line ends it");
    if (header->files != NRRD_ATTACHED && !header->file_count)
        return NRRD_FAIL(header, header->files_place, "the list of data files is empty");
    if (header->file_count > NRRD_MAX_FILES)
        return NRRD_FAIL(header, header->files_place, "there are more than %d data files",
                         NRRD_MAX_FILES);
    if (!check_axes(header, &header->sizes_given, "sizes") ||
        !check_axes(header, &header->kinds_given, "kinds") ||
        !check_axes(header, &header->spacings_given, "spacings") ||
        !check_axes(header, &header->units_given, "units") ||
        !check_axes(header, &header->directions_given, "space directions"))
        return false;
    if (header->byte_skip == -1 && header->encoding != NRRD_RAW)
        return NRRD_FAIL(header, header->encoding_place, "byte skip -1 needs the encoding raw");
    bool in_bytes = header->encoding != NRRD_ASCII && plr_voxel_size(header->type) > 1;
    if (in_bytes && !header->has_endian)
        plr_diags_add_as(header->source->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME,
                         header->type_place, "the header does not say endian; little is assumed");
    header->sizes_place = header->sizes_given.place;
    return true;
}

bool plr_nrrd_read_header(nrrd *header, const plr_volume_source *source) {
    memset(header, 0, sizeof *header);
    header->source = source;
    header->minimum = header->maximum = NAN;
    const char *at = source->data, *end = source->data + source->length;
    while (at < end) {
        const char *newline = memchr(at, '\n', (size_t)(end - at));
        nrrd_text line = {at, newline ? newline : end};
        header->line_start = at;
        header->line++;
        if (line.end > line.at && line.end[-1] == '\r')
            line.end--;
        at = newline ? newline + 1 : end;
        if ((size_t)(at - source->data) > MAX_HEADER)
            return FAIL(header, line.at, "the header is longer than %zu bytes", MAX_HEADER);
        if (line.at == line.end) {
            header->data = at;
            break;
        }
        if (!read_line(header, line))
            return false;
        if (header->files == NRRD_LIST)
            header->file_name.end = line.end;
    }
    return check_header(header);
}
