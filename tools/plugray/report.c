#include "tools/plugray/report.h"

#include <string.h>

#include <plugray/engine.h>
#include "tools/plugray/json.h"
#include "tools/plugray/options.h"

enum {
    LINE_SHOWN = 160, /* bytes of a long line that are shown about the column */
    LINE_BEFORE = 60
};

const char *text_line(const char *text, size_t size, uint32_t line, size_t *length) {
    const char *end = text + size;
    for (uint32_t i = 1; text && i < line; i++) {
        text = memchr(text, '\n', (size_t)(end - text));
        if (text)
            text++;
    }
    if (!text || !line || text >= end)
        return NULL;
    const char *newline = memchr(text, '\n', (size_t)(end - text));
    *length = (size_t)((newline ? newline : end) - text);
    if (*length && text[*length - 1] == '\r')
        --*length;
    return text;
}

const char *own_line(const char *file, uint32_t line, size_t *length) {
    static const char prefix[] = "effects/";
    if (strncmp(file, prefix, sizeof prefix - 1) != 0)
        return NULL;
    const char *path, *text;
    size_t size;
    for (size_t i = 0; (path = plr_effects_file(i, &text, &size)); i++)
        if (strcmp(path, file + sizeof prefix - 1) == 0)
            return text_line(text, size, line, length);
    return NULL;
}

static const char *find_line(const tool_report *report, plr_place place, size_t *length) {
    if (!place.file || !place.line)
        return NULL;
    const char *line =
        report->line ? report->line(report->user, place.file, place.line, length) : NULL;
    return line ? line : own_line(place.file, place.line, length);
}

void report_plain(FILE *out, const char *text, size_t length) {
    for (size_t i = 0; i < length && text[i]; i++) {
        unsigned char byte = (unsigned char)text[i];
        bool wide = byte == 0xc2 && i + 1 < length && ((unsigned char)text[i + 1] & 0xe0) == 0x80;
        bool control = (byte < 0x20 && byte != '\t') || byte == 0x7f || wide;
        putc(control ? ' ' : text[i], out);
        i += wide;
    }
}

static bool is_continuation(char byte) {
    return ((unsigned char)byte & 0xc0) == 0x80;
}

static void put_caret(FILE *out, const char *line, size_t length, uint32_t column) {
    size_t at = column ? column - 1 : 0, first = 0, last = length;
    if (length >= 3 && memcmp(line, "\xef\xbb\xbf", 3) == 0) { /* a byte-order mark has no width */
        line += 3;
        last = length -= 3;
    }
    if (at > length)
        at = length;
    if (length > LINE_SHOWN && at > LINE_BEFORE)
        first = at - LINE_BEFORE;
    while (first < at && is_continuation(line[first]))
        first++;
    if (last - first > LINE_SHOWN)
        last = first + LINE_SHOWN;
    fputs("    ", out);
    report_plain(out, line + first, last - first);
    fputs("\n    ", out);
    for (size_t i = first; i < at; i++)
        if (line[i] == '\t' || !is_continuation(line[i]))
            putc(line[i] == '\t' ? '\t' : ' ', out);
    fputs("^\n", out);
}

/* What concerns a whole file stands at its first byte; what concerns none, nowhere. */
static plr_place whole_file_first(plr_place place) {
    if (!place.file)
        return (plr_place){NULL, 0, 0};
    if (!place.line)
        return (plr_place){place.file, 1, 1};
    return (plr_place){place.file, place.line, place.column ? place.column : 1};
}

void report_text(FILE *out, const tool_report *report) {
    for (size_t i = 0; i < plr_diags_count(report->diags); i++) {
        const plr_diag *diag = plr_diags_get(report->diags, i);
        plr_place place = diag->place;
        if (place.file) {
            plr_place shown = whole_file_first(place);
            report_plain(out, place.file, strlen(place.file));
            fprintf(out, ":%u:%u", shown.line, shown.column);
        } else {
            fputs("plugray", out);
        }
        fprintf(out, ": %s: ", plr_severity_text(diag->severity));
        report_plain(out, diag->message, strlen(diag->message));
        fprintf(out, " [%s]\n", plr_code_text(diag->code));
        size_t length;
        const char *line = find_line(report, place, &length);
        if (line)
            put_caret(out, line, length, place.column);
    }
}

int report_status(const plr_diags *diags, bool strict) {
    bool machine = false;
    for (size_t i = 0; i < plr_diags_count(diags); i++) {
        const plr_diag *diag = plr_diags_get(diags, i);
        if (diag->severity != PLR_ERROR)
            continue;
        machine |= diag->code == PLR_CODE_NO_GL || diag->code == PLR_CODE_NO_MEMORY ||
                   diag->code == PLR_CODE_OUTPUT || diag->code == PLR_CODE_MISSING_PROGRAM;
    }
    if (machine)
        return STATUS_MACHINE;
    bool faulty = plr_diags_count_of(diags, PLR_ERROR) > 0 ||
                  (strict && plr_diags_count_of(diags, PLR_WARNING) > 0);
    return faulty ? STATUS_INPUT : STATUS_FINE;
}

/* ---- JSON ---- */

static void json_diag(FILE *out, const plr_diag *diag) {
    fputs("{\"file\": ", out);
    plr_place place = whole_file_first(diag->place);
    json_string(out, place.file);
    fprintf(out,
            ", \"line\": %u, \"column\": %u, \"severity\": \"%s\", \"code\": \"%s\", \"message\": ",
            place.line, place.column, plr_severity_text(diag->severity), plr_code_text(diag->code));
    json_string(out, diag->message);
}

void report_json(FILE *out, const tool_report *reports, size_t count) {
    const char *before = "\n";
    putc('[', out);
    for (size_t r = 0; r < count; r++) {
        const plr_diags *diags = reports[r].diags;
        for (size_t i = 0; i < plr_diags_count(diags);) {
            fprintf(out, "%s  ", before);
            before = ",\n";
            json_diag(out, plr_diags_get(diags, i++));
            fputs(", \"notes\": [", out);
            for (const char *comma = ""; i < plr_diags_count(diags); comma = ", ") {
                const plr_diag *note = plr_diags_get(diags, i);
                if (note->severity != PLR_NOTE)
                    break;
                fputs(comma, out);
                json_diag(out, note);
                putc('}', out);
                i++;
            }
            fputs("]}", out);
        }
    }
    fputs("\n]\n", out);
}

/* ---- SARIF ---- */

static void sarif_uri(FILE *out, const char *file) {
    static const char plain[] = "-._~/!$&'()*+,;=@";
    putc('"', out);
    for (; *file; file++) {
        unsigned char byte = (unsigned char)*file;
        bool letter = (byte >= '0' && byte <= '9') || ((byte | 32) >= 'a' && (byte | 32) <= 'z');
        fprintf(out, letter || strchr(plain, byte) ? "%c" : "%%%02X", byte);
    }
    putc('"', out);
}

/* Columns of SARIF are counted in characters, ours in bytes. */
static uint32_t character_column(const tool_report *report, plr_place place) {
    size_t length;
    const char *line = find_line(report, place, &length);
    uint32_t column = 1;
    for (uint32_t i = 1; line && i < place.column; i++)
        if (i > length || !is_continuation(line[i - 1]))
            column++;
    return line ? column : place.column;
}

/* Members of a location object, without its braces. */
static void sarif_place(FILE *out, const tool_report *report, plr_place place) {
    fputs("\"physicalLocation\": {\"artifactLocation\": {\"uri\": ", out);
    sarif_uri(out, place.file);
    putc('}', out);
    if (place.line) {
        fprintf(out, ", \"region\": {\"startLine\": %u", place.line);
        if (place.column)
            fprintf(out, ", \"startColumn\": %u", character_column(report, place));
        putc('}', out);
    }
    putc('}', out);
}

static const char *sarif_level(plr_severity severity) {
    return severity == PLR_INFO ? "note" : plr_severity_text(severity);
}

/* The result at `index` with its notes; returns the index after them. */
static size_t sarif_result(FILE *out, const tool_report *report, size_t index) {
    const plr_diag *diag = plr_diags_get(report->diags, index);
    fprintf(
        out,
        "      {\"ruleId\": \"%s\", \"ruleIndex\": %d, \"level\": \"%s\", \"message\": {\"text\": ",
        plr_code_text(diag->code), (int)diag->code, sarif_level(diag->severity));
    json_string(out, diag->message);
    fputs("}, \"locations\": [", out);
    if (diag->place.file) {
        putc('{', out);
        sarif_place(out, report, diag->place);
        putc('}', out);
    }
    fputs("], \"relatedLocations\": [", out);
    const char *comma = "";
    while (++index < plr_diags_count(report->diags)) {
        const plr_diag *note = plr_diags_get(report->diags, index);
        if (note->severity != PLR_NOTE)
            break;
        fprintf(out, "%s{\"message\": {\"text\": ", comma);
        json_string(out, note->message);
        putc('}', out);
        if (note->place.file) {
            fputs(", ", out);
            sarif_place(out, report, note->place);
        }
        putc('}', out);
        comma = ", ";
    }
    fputs("]}", out);
    return index;
}

void report_sarif(FILE *out, const tool_report *reports, size_t count) {
    fputs("{\n  \"$schema\": \"https://json.schemastore.org/sarif-2.1.0.json\",\n"
          "  \"version\": \"2.1.0\",\n  \"runs\": [{\n"
          "    \"tool\": {\"driver\": {\"name\": \"plugray\", \"version\": \"" PLR_VERSION
          "\", \"rules\": [",
          out);
    for (int code = 0; code < PLR_CODE_COUNT; code++) {
        fprintf(out,
                "%s\n      {\"id\": \"%s\", \"shortDescription\": {\"text\": ", code ? "," : "",
                plr_code_text((plr_code)code));
        json_string(out, plr_code_help((plr_code)code));
        fputs("}}", out);
    }
    fputs("\n    ]}},\n    \"columnKind\": \"unicodeCodePoints\",\n    \"results\": [", out);
    const char *before = "\n";
    for (size_t r = 0; r < count; r++) {
        for (size_t i = 0; i < plr_diags_count(reports[r].diags); before = ",\n") {
            fputs(before, out);
            i = sarif_result(out, &reports[r], i);
        }
    }
    fputs("\n    ]\n  }]\n}\n", out);
}
