/* The NRRD reader: names and colours of segments in key/value pairs, as 3D Slicer writes them
 * ("Segment0_Name:=liver", "Segment0_LabelValue:=3", "Segment0_Color:=0.8 0.4 0.3") and plain
 * ("label 3:=liver"). */
#include "engine/volume_nrrd.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_SEGMENTS 65536u

/* One segment of 3D Slicer's; its keys come in any order. */
struct nrrd_segment {
    bool known, has_value;
    uint32_t value, layer, line;
    nrrd_text name, color;
};

/* ---- Pieces ---- */

/* Digits at the start, taken off; false if there are none or too many. */
static bool take_number(nrrd_text *text, uint32_t *number) {
    uint64_t sum = 0;
    const char *start = text->at;
    while (text->at < text->end && *text->at >= '0' && *text->at <= '9' && text->at - start < 10)
        sum = sum * 10 + (uint64_t)(*text->at++ - '0');
    *number = (uint32_t)sum;
    return text->at > start && sum <= UINT32_MAX;
}

static bool take_word(nrrd_text *text, const char *word) {
    size_t length = strlen(word);
    if ((size_t)(text->end - text->at) < length || memcmp(text->at, word, length) != 0)
        return false;
    text->at += length;
    return true;
}

static bool read_whole(nrrd_text text, uint32_t *number) {
    while (text.at < text.end && *text.at == ' ')
        text.at++;
    return take_number(&text, number);
}

/* Red, green, blue from 0 to 1. */
static bool read_color(nrrd_text text, float color[4]) {
    char copy[128];
    size_t length = (size_t)(text.end - text.at);
    if (length == 0 || length >= sizeof copy)
        return false;
    memcpy(copy, text.at, length);
    copy[length] = '\0';
    char *at = copy;
    for (int i = 0; i < 3; i++) {
        char *start = at;
        color[i] = strtof(start, &at);
        if (at == start || !isfinite(color[i]))
            return false;
    }
    color[3] = 1;
    return true;
}

/* A value as it was before it was written: "\n" is a new line, "\\" a backslash. */
static void add_label(plr_labels *labels, uint32_t value, nrrd_text text, const float *color) {
    char name[512];
    size_t used = 0;
    for (; text.at < text.end && used < sizeof name; text.at++) {
        bool escaped = *text.at == '\\' && text.at + 1 < text.end;
        text.at += escaped;
        name[used++] = escaped && *text.at == 'n' ? ' ' : *text.at;
    }
    plr_labels_add(labels, value, name, used, color);
}

/* ---- Keys ---- */

static nrrd_segment *find_segment(nrrd *header, uint32_t index) {
    if (index >= MAX_SEGMENTS)
        return NULL;
    if (index >= header->segment_count) {
        size_t count = 64;
        while (count <= index)
            count *= 2;
        nrrd_segment *more = realloc(header->segments, count * sizeof *more);
        if (!more)
            return NULL;
        memset(more + header->segment_count, 0, (count - header->segment_count) * sizeof *more);
        header->segments = more;
        header->segment_count = count;
    }
    nrrd_segment *segment = &header->segments[index];
    segment->known = true;
    return segment;
}

static void read_segment(nrrd *header, nrrd_text key, nrrd_text value) {
    uint32_t index;
    if (!take_number(&key, &index) || !take_word(&key, "_"))
        return;
    nrrd_segment *segment = find_segment(header, index);
    if (!segment)
        return;
    if (take_word(&key, "Name") && key.at == key.end) {
        segment->name = value;
        segment->line = header->line;
    } else if (take_word(&key, "Color") && key.at == key.end) {
        segment->color = value;
    } else if (take_word(&key, "LabelValue")) {
        segment->has_value = read_whole(value, &segment->value);
    } else if (take_word(&key, "Layer")) {
        read_whole(value, &segment->layer);
    }
}

void plr_nrrd_read_key(nrrd *header, nrrd_text key, nrrd_text value) {
    uint32_t number;
    if (take_word(&key, "Segment"))
        read_segment(header, key, value);
    else if (take_word(&key, "label ") && take_number(&key, &number) && key.at == key.end)
        add_label(&header->labels, number, value, NULL);
}

void plr_nrrd_take_labels(nrrd *header, plr_labels *labels) {
    uint32_t other = 0;
    *labels = header->labels;
    header->labels = (plr_labels){0};
    for (size_t i = 0; i < header->segment_count; i++) {
        const nrrd_segment *s = &header->segments[i];
        float color[4];
        bool has_color = s->known && read_color(s->color, color);
        if (s->known && s->layer && !other)
            other = s->line;
        else if (s->known && !s->layer && s->name.at)
            add_label(labels, s->has_value ? s->value : (uint32_t)i + 1, s->name,
                      has_color ? color : NULL);
    }
    if (other)
        plr_diags_add_as(header->source->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME,
                         (plr_place){header->source->name, other, 1},
                         "segments of layers above 0 overlap others and have no name here");
    plr_labels_finish(labels);
}

void plr_nrrd_free(nrrd *header) {
    free(header->segments);
    plr_labels_free(&header->labels);
}
