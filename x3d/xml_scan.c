#include "x3d/xml_scan.h"

#include <string.h>

static bool begins(const x3d_xml_scan *scan, size_t at, const char *text) {
    size_t length = strlen(text);
    return scan->length - at >= length && memcmp(scan->text + at, text, length) == 0;
}

/* Offset of the first `text` from `at` on, or the end. */
static size_t find(const x3d_xml_scan *scan, size_t at, const char *text) {
    while (at < scan->length) {
        const char *p = memchr(scan->text + at, text[0], scan->length - at);
        if (!p)
            break;
        at = (size_t)(p - scan->text);
        if (begins(scan, at, text))
            return at;
        at++;
    }
    return scan->length;
}

static size_t behind(const x3d_xml_scan *scan, size_t at, const char *text) {
    size_t found = find(scan, at, text);
    return found < scan->length ? found + strlen(text) : scan->length;
}

/* <!DOCTYPE ... [ ... ]>: quotes, comments and nested declarations may hold any of ] and >. */
static size_t behind_doctype(const x3d_xml_scan *scan, size_t at) {
    size_t depth = 0;
    while (at < scan->length) {
        char c = scan->text[at];
        if (begins(scan, at, "<!--")) {
            at = behind(scan, at + 4, "-->");
            continue;
        }
        if (begins(scan, at, "<?")) {
            at = behind(scan, at + 2, "?>");
            continue;
        }
        if (c == '"' || c == '\'') {
            const char *p = memchr(scan->text + at + 1, c, scan->length - at - 1);
            at = p ? (size_t)(p - scan->text) + 1 : scan->length;
            continue;
        }
        depth += c == '<';
        if (c == '>' && --depth == 0)
            return at + 1;
        at++;
    }
    return at;
}

/* From behind '<' to the '>' of a tag, over quoted values. */
static size_t end_of_tag(const x3d_xml_scan *scan, size_t at) {
    while (at < scan->length && scan->text[at] != '>') {
        char c = scan->text[at++];
        if (c != '"' && c != '\'')
            continue;
        const char *p = at < scan->length ? memchr(scan->text + at, c, scan->length - at) : NULL;
        at = p ? (size_t)(p - scan->text) + 1 : scan->length;
    }
    return at;
}

static x3d_xml_token read_tag(x3d_xml_scan *scan) {
    x3d_xml_token token = {X3D_XML_START, scan->at, scan->at + 1, 0, false};
    size_t end = end_of_tag(scan, token.start);
    scan->at = end < scan->length ? end + 1 : end;
    if (token.start < end && scan->text[token.start] == '/') {
        token.kind = X3D_XML_END;
        token.start++;
    } else if (end > token.start && scan->text[end - 1] == '/') {
        token.empty = true;
        end--;
    }
    token.end = end;
    return token;
}

x3d_xml_token x3d_xml_next(x3d_xml_scan *scan) {
    while (scan->at < scan->length) {
        size_t at = scan->at;
        if (scan->text[at] != '<') {
            scan->at = find(scan, at, "<");
            return (x3d_xml_token){X3D_XML_TEXT, at, at, scan->at, false};
        }
        if (begins(scan, at, "<!--")) {
            scan->at = behind(scan, at + 4, "-->");
        } else if (begins(scan, at, "<![CDATA[")) {
            size_t end = find(scan, at + 9, "]]>");
            scan->at = end < scan->length ? end + 3 : end;
            return (x3d_xml_token){X3D_XML_CDATA, at, at + 9 < end ? at + 9 : end, end, false};
        } else if (begins(scan, at, "<?")) {
            scan->at = behind(scan, at + 2, "?>");
        } else if (begins(scan, at, "<!")) {
            scan->at = behind_doctype(scan, at);
        } else {
            return read_tag(scan);
        }
    }
    return (x3d_xml_token){X3D_XML_EOF, scan->length, scan->length, scan->length, false};
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* Reads a name at `at`, before `end`; takes a prefix off. */
static size_t read_name(const x3d_xml_scan *scan, size_t at, size_t end,
                        x3d_xml_attribute *attribute) {
    size_t start = at;
    attribute->prefixed = false;
    while (at < end && !is_blank(scan->text[at]) && scan->text[at] != '=') {
        if (scan->text[at] == ':') {
            attribute->prefixed = true;
            start = at + 1;
        }
        at++;
    }
    attribute->name = scan->text + start;
    attribute->name_length = at - start;
    attribute->name_at = start;
    return at;
}

x3d_xml_attribute x3d_xml_name(const x3d_xml_scan *scan, const x3d_xml_token *token) {
    x3d_xml_attribute name = {0};
    read_name(scan, token->start, token->end, &name);
    return name;
}

bool x3d_xml_next_attribute(const x3d_xml_scan *scan, const x3d_xml_token *token, size_t *at,
                            x3d_xml_attribute *attribute) {
    size_t i = *at, end = token->end;
    if (!i) {
        x3d_xml_attribute name;
        i = read_name(scan, token->start, end, &name);
    }
    while (i < end && is_blank(scan->text[i]))
        i++;
    if (i >= end)
        return false;
    size_t name = i;
    i = read_name(scan, i, end, attribute);
    while (i < end && (is_blank(scan->text[i]) || scan->text[i] == '='))
        i++;
    if (i >= end || i == name || (scan->text[i] != '"' && scan->text[i] != '\''))
        return false;
    const char *close = memchr(scan->text + i + 1, scan->text[i], end - i - 1);
    if (!close)
        return false;
    attribute->start = i + 1;
    attribute->end = (size_t)(close - scan->text);
    *at = attribute->end + 1;
    return true;
}

/* ---- Decoding ---- */

typedef struct span_list {
    x3d_span *items;
    size_t count, capacity;
} span_list;

static size_t put_utf8(char *out, uint32_t c) {
    if (c < 0x80) {
        out[0] = (char)c;
        return 1;
    }
    if (c < 0x800) {
        out[0] = (char)(0xc0 | c >> 6);
        out[1] = (char)(0x80 | (c & 0x3f));
        return 2;
    }
    if (c < 0x10000) {
        out[0] = (char)(0xe0 | c >> 12);
        out[1] = (char)(0x80 | (c >> 6 & 0x3f));
        out[2] = (char)(0x80 | (c & 0x3f));
        return 3;
    }
    out[0] = (char)(0xf0 | c >> 18);
    out[1] = (char)(0x80 | (c >> 12 & 0x3f));
    out[2] = (char)(0x80 | (c >> 6 & 0x3f));
    out[3] = (char)(0x80 | (c & 0x3f));
    return 4;
}

static bool character_of(const char *digits, size_t length, uint32_t *c) {
    uint32_t base = 10;
    size_t i = 0;
    if (length && digits[0] == 'x') {
        base = 16;
        i = 1;
    }
    *c = 0;
    if (i >= length)
        return false;
    for (; i < length; i++) {
        uint32_t digit;
        if (digits[i] >= '0' && digits[i] <= '9')
            digit = (uint32_t)(digits[i] - '0');
        else if (base == 16 && ((digits[i] | 32) >= 'a' && (digits[i] | 32) <= 'f'))
            digit = (uint32_t)((digits[i] | 32) - 'a') + 10;
        else
            return false;
        *c = *c * base + digit;
        if (*c > 0x10ffff)
            return false;
    }
    return *c != 0;
}

/* An entity is never shorter than what it stands for: `out` has room for both. Returns the bytes
 * written; 0: unknown. */
static size_t decode_entity(const char *name, size_t length, char *out) {
    static const struct {
        const char *name;
        char character;
    } known[] = {{"quot", '"'}, {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"apos", '\''}};
    uint32_t c;
    if (length > 1 && name[0] == '#')
        return character_of(name + 1, length - 1, &c) ? put_utf8(out, c) : 0;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strlen(known[i].name) == length && memcmp(known[i].name, name, length) == 0) {
            out[0] = known[i].character;
            return 1;
        }
    return 0;
}

x3d_view x3d_xml_decode(plr_arena *arena, x3d_file *file, size_t start, size_t end, bool cdata,
                        size_t *unknown) {
    const char *raw = file->text;
    size_t length = end - start;
    x3d_view view = {.file = file, .text = raw + start, .length = length, .base = start};
    *unknown = SIZE_MAX;
    if (!length ||
        (!memchr(raw + start, '\r', length) && (cdata || !memchr(raw + start, '&', length))))
        return view; /* the bytes of the file are the text */
    char *text = plr_arena_alloc(arena, length + 1);
    span_list spans = {0};
    *PLR_PUSH(arena, &spans) = (x3d_span){0, start};
    size_t out = 0;
    for (size_t i = start; i < end;) {
        if (raw[i] == '\r') {
            text[out++] = '\n';
            i += i + 1 < end && raw[i + 1] == '\n' ? 2 : 1;
        } else if (raw[i] == '&' && !cdata) {
            const char *semicolon = memchr(raw + i, ';', end - i);
            size_t stop = semicolon ? (size_t)(semicolon - raw) : i;
            size_t written = stop > i ? decode_entity(raw + i + 1, stop - i - 1, text + out) : 0;
            if (!written && *unknown == SIZE_MAX)
                *unknown = i;
            out += written;
            i = stop + 1;
        } else {
            text[out++] = raw[i++];
            continue;
        }
        if (spans.items[spans.count - 1].at == out)
            spans.count--;
        *PLR_PUSH(arena, &spans) = (x3d_span){out, i};
    }
    text[out] = '\0';
    view.text = text;
    view.length = out;
    view.spans = spans.items;
    view.span_count = spans.count;
    return view;
}
