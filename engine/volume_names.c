/* Names and colours of segments, as lists and as text: one line a segment, "number name" with an
 * optional colour, as atlases and label editors write them. */
#include "engine/volume_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_LABELS 65536u
#define MAX_NAME 255u
#define MAX_TEXT ((size_t)4 << 20)

/* ---- Lists ---- */

/* The bytes of the character at `text`, 0 if it is none of UTF-8. */
static size_t character(const unsigned char *text, size_t length) {
    size_t size = *text < 0x80                     ? 1
                  : *text >= 0xc2 && *text <= 0xdf ? 2
                  : (*text & 0xf0) == 0xe0         ? 3
                  : *text >= 0xf0 && *text <= 0xf4 ? 4
                                                   : 0;
    if (size > length)
        return 0;
    for (size_t i = 1; i < size; i++)
        if ((text[i] & 0xc0) != 0x80)
            return 0;
    return size;
}

/* What is no character becomes '?', what moves the cursor a blank. */
static char *clean_name(const char *name, size_t length) {
    char *clean = malloc(MAX_NAME + 1);
    size_t used = 0, size;
    for (size_t at = 0; clean && at < length; at += size ? size : 1) {
        const unsigned char *c = (const unsigned char *)name + at;
        size = character(c, length - at);
        if (used + (size ? size : 1) > MAX_NAME)
            break;
        if (size > 1)
            memcpy(clean + used, c, size);
        else
            clean[used] = (char)(!size ? '?' : *c < 32 || *c == 127 ? ' ' : *c);
        used += size ? size : 1;
    }
    if (clean)
        clean[used] = '\0';
    return clean;
}

bool plr_labels_add(plr_labels *labels, uint32_t value, const char *name, size_t length,
                    const float *color) {
    if (labels->count == MAX_LABELS)
        return false;
    size_t count = labels->count;
    if ((count & (count - 1)) == 0) { /* a power of two: full */
        plr_label *more = realloc(labels->items, (count ? 2 * count : 1) * sizeof *more);
        if (!more)
            return false;
        labels->items = more;
    }
    plr_label label = {.value = value, .name = clean_name(name, length)};
    if (!label.name)
        return false;
    label.has_color = color != NULL;
    for (int i = 0; color && i < 4; i++)
        label.color[i] = color[i] > 0 ? color[i] < 1 ? color[i] : 1 : 0;
    labels->items[labels->count++] = label;
    return true;
}

static int compare_values(const void *a, const void *b) {
    const plr_label *first = a, *second = b;
    if (first->value != second->value)
        return first->value < second->value ? -1 : 1;
    return 0;
}

/* By value, and as they came. */
static int compare_labels(const void *a, const void *b) {
    const plr_label *first = a, *second = b;
    int order = compare_values(a, b);
    return order ? order : first->order < second->order ? -1 : 1;
}

void plr_labels_finish(plr_labels *labels) {
    size_t kept = 0;
    for (size_t i = 0; i < labels->count; i++)
        labels->items[i].order = (uint32_t)i;
    if (labels->count)
        qsort(labels->items, labels->count, sizeof *labels->items, compare_labels);
    for (size_t i = 0; i < labels->count; i++)
        if (kept && labels->items[i].value == labels->items[kept - 1].value)
            free(labels->items[i].name);
        else
            labels->items[kept++] = labels->items[i];
    labels->count = kept;
}

const plr_label *plr_labels_find(const plr_labels *labels, uint32_t value) {
    plr_label wanted = {.value = value};
    return labels->count
               ? bsearch(&wanted, labels->items, labels->count, sizeof wanted, compare_values)
               : NULL;
}

void plr_labels_free(plr_labels *labels) {
    for (size_t i = 0; i < labels->count; i++)
        free(labels->items[i].name);
    free(labels->items);
    *labels = (plr_labels){0};
}

/* ---- Lines of text ---- */

typedef struct piece {
    const char *at, *end;
} piece;

/* One line, read: where the name is, the numbers behind it (or, in ITK-SNAP's files, before). */
typedef struct row {
    uint32_t value;
    piece name, code; /* code: "name" and one more number; else empty */
    int numbers;      /* 3 or 4 of a colour, else 0 */
    double color[4];
} row;

typedef struct table {
    const char *file;
    row *rows;
    size_t count;
    plr_diags *diags;
} table;

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == ',' || c == ';';
}

static piece trim(piece p) {
    while (p.at < p.end && is_blank(*p.at))
        p.at++;
    while (p.end > p.at && is_blank(p.end[-1]))
        p.end--;
    return p;
}

/* The last word, taken off the end. */
static piece last_word(piece *rest) {
    *rest = trim(*rest);
    piece word = {rest->end, rest->end};
    while (word.at > rest->at && !is_blank(word.at[-1]))
        word.at--;
    rest->end = word.at;
    *rest = trim(*rest);
    return word;
}

static bool number(piece word, double *value) {
    char text[32], *end;
    size_t length = (size_t)(word.end - word.at);
    if (length == 0 || length >= sizeof text || !strchr("0123456789.-+", *word.at))
        return false;
    memcpy(text, word.at, length);
    text[length] = '\0';
    *value = strtod(text, &end);
    return !*end && isfinite(*value);
}

/* The whole number that a line begins with. */
static bool take_value(piece *rest, uint32_t *value) {
    uint64_t sum = 0;
    const char *start = rest->at;
    for (; rest->at < rest->end && *rest->at >= '0' && *rest->at <= '9' && sum < UINT32_MAX;
         rest->at++)
        sum = sum * 10 + (uint64_t)(*rest->at - '0');
    *value = (uint32_t)sum;
    return rest->at > start && sum <= UINT32_MAX && rest->at < rest->end &&
           (is_blank(*rest->at) || *rest->at == ':' || *rest->at == '=');
}

/* Up to `most` numbers at the end of the text, in their order; they are taken off it. */
static int take_numbers(piece *rest, double *numbers, int most) {
    double found[8];
    int count = 0;
    while (count < most) {
        piece before = *rest, word = last_word(rest);
        if (!number(word, &found[count])) {
            *rest = before;
            break;
        }
        count++;
    }
    for (int i = 0; i < count; i++)
        numbers[i] = found[count - 1 - i];
    return count;
}

/* "name" in quotes, with numbers before (ITK-SNAP: red green blue alpha visible mesh) or behind. */
static bool read_quoted(piece rest, row *r) {
    const char *open = memchr(rest.at, '"', (size_t)(rest.end - rest.at));
    const char *close = memchr(open + 1, '"', (size_t)(rest.end - open - 1));
    double numbers[8];
    if (!close)
        return false;
    piece before = trim((piece){rest.at, open}), behind = trim((piece){close + 1, rest.end});
    int count = take_numbers(before.at < before.end ? &before : &behind, numbers, 6);
    r->name = (piece){open + 1, close};
    r->numbers = count == 6 ? 4 : count == 3 || count == 4 ? count : 0;
    memcpy(r->color, numbers, (size_t)r->numbers * sizeof *numbers);
    return open + 1 < close;
}

/* "number name", "number TAB name", then nothing, a colour, or a number of the atlas's own. */
static bool read_row(piece line, row *r) {
    piece rest = trim(line);
    *r = (row){0};
    if (!take_value(&rest, &r->value))
        return false;
    rest = trim(rest);
    if (rest.at < rest.end && (*rest.at == ':' || *rest.at == '='))
        rest.at++;
    rest = trim(rest);
    if (rest.at == rest.end)
        return false;
    if (memchr(rest.at, '"', (size_t)(rest.end - rest.at)))
        return read_quoted(rest, r);
    const char *tab = memchr(rest.at, '\t', (size_t)(rest.end - rest.at));
    double numbers[8];
    piece name = tab ? (piece){tab, rest.end} : rest;
    int count = take_numbers(&name, numbers, 5);
    r->name = tab ? trim((piece){rest.at, tab}) : name;
    if (count == 3 || count == 4) {
        r->numbers = count;
        memcpy(r->color, numbers, (size_t)count * sizeof *numbers);
    } else if (!tab) {
        bool word = true;
        for (const char *c = name.at; c < name.end; c++)
            word = word && !is_blank(*c);
        r->name = rest;
        if (count == 1 && word && name.at < name.end)
            r->code = name;
    }
    return r->name.at < r->name.end;
}

/* ---- Tables ---- */

/* The colours of a file go to 1 or to 255, all alike. Where the fourth number is 0 everywhere, it
 * says how much shows through, not how little. */
static void scale_colors(table *t) {
    double most = 0, alpha = 0;
    for (size_t i = 0; i < t->count; i++)
        for (int c = 0; c < t->rows[i].numbers; c++) {
            most = fmax(most, t->rows[i].color[c]);
            alpha = c == 3 ? fmax(alpha, t->rows[i].color[c]) : alpha;
        }
    /* ITK-SNAP counts colours to 255 and opacities to 1 */
    double color_scale = most > 1 ? 255 : 1, alpha_scale = alpha > 1 ? 255 : 1;
    for (size_t i = 0; i < t->count; i++) {
        row *r = &t->rows[i];
        for (int c = 0; c < 3; c++)
            r->color[c] /= color_scale;
        r->color[3] = r->numbers < 4 || alpha == 0 ? 1 : r->color[3] / alpha_scale;
    }
}

static int compare_codes(const void *a, const void *b) {
    const row *const *first = a, *const *second = b;
    piece p = (*first)->code, q = (*second)->code;
    size_t lengths[2] = {(size_t)(p.end - p.at), (size_t)(q.end - q.at)};
    int order = memcmp(p.at, q.at, lengths[0] < lengths[1] ? lengths[0] : lengths[1]);
    return order ? order : (lengths[0] > lengths[1]) - (lengths[0] < lengths[1]);
}

/* "Precentral_L 2001": a number behind the name is the atlas's own code and no part of the name
 * where each line has one and the names differ without it. ("Area 17", "Area 18" do not.) */
static void drop_codes(table *t) {
    const row **sorted = malloc(t->count * sizeof *sorted);
    bool codes = sorted != NULL;
    for (size_t i = 0; codes && i < t->count; i++) {
        sorted[i] = &t->rows[i];
        codes = t->rows[i].code.at != NULL;
    }
    if (codes)
        qsort(sorted, t->count, sizeof *sorted, compare_codes);
    for (size_t i = 1; codes && i < t->count; i++)
        codes = compare_codes(&sorted[i - 1], &sorted[i]) != 0;
    for (size_t i = 0; codes && i < t->count; i++)
        t->rows[i].name = t->rows[i].code;
    free(sorted);
}

/* Reads the lines; stops at the first that is no label, which is reported if it is not the first
 * of all. */
static bool read_rows(table *t, const char *text, size_t length) {
    const char *end = text + length;
    uint32_t line_number = 0;
    while (text < end && t->count < MAX_LABELS) {
        const char *newline = memchr(text, '\n', (size_t)(end - text));
        piece line = trim((piece){text, newline ? newline : end});
        text = newline ? newline + 1 : end;
        line_number++;
        if (line.at == line.end || *line.at == '#' || *line.at == '/')
            continue;
        row *r = &t->rows[t->count];
        if (!read_row(line, r)) {
            if (t->count && t->file)
                plr_diags_add_as(t->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME,
                                 (plr_place){t->file, line_number, 1},
                                 "this is no label (number, name and perhaps a colour); labels are "
                                 "read up to here");
            return t->count > 0;
        }
        t->count++;
    }
    return t->count > 0;
}

static size_t count_lines(const char *text, size_t length) {
    size_t count = 1;
    for (size_t i = 0; i < length && count < MAX_LABELS; i++)
        count += text[i] == '\n';
    return count;
}

bool plr_labels_read(plr_labels *labels, const char *text, size_t length, const char *file,
                     plr_diags *diags) {
    static const char mark[] = "\xef\xbb\xbf";
    if (length >= 3 && memcmp(text, mark, 3) == 0) {
        text += 3;
        length -= 3;
    }
    if (length > MAX_TEXT || memchr(text, '\0', length))
        return false;
    table t = {.file = file, .diags = diags};
    t.rows = calloc(count_lines(text, length), sizeof *t.rows);
    plr_plain_numbers plain = plr_plain_numbers_begin();
    bool found = t.rows && read_rows(&t, text, length);
    plr_plain_numbers_end(&plain);
    if (found) {
        scale_colors(&t);
        drop_codes(&t);
    }
    for (size_t i = 0; found && i < t.count; i++) {
        const row *r = &t.rows[i];
        const float color[] = {(float)r->color[0], (float)r->color[1], (float)r->color[2],
                               (float)r->color[3]};
        plr_labels_add(labels, r->value, r->name.at, (size_t)(r->name.end - r->name.at),
                       r->numbers ? color : NULL);
    }
    free(t.rows);
    plr_labels_finish(labels);
    return found;
}
