/* The structure of DICOM files (PS3.5, 7 and annex A; PS3.10, 7): walks all elements without taking
 * memory, so that the library, which believes lengths and recurses, gets sound data sets alone. */
#include "engine/volume_dicom.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum {
    PREAMBLE = 128,
    MAX_DEPTH = 16,         /* of sequences in sequences */
    MAX_ELEMENTS = 2000000, /* in all: some hundred bytes each in the library */
    MAX_DISORDER = 200, /* elements behind one of a greater tag: each is searched for its place */
    MAX_INFLATED = 1 << 30
};

#define UNDEFINED 0xffffffffu
#define ITEM 0xfffee000u
#define ITEM_END 0xfffee00du
#define SEQUENCE_END 0xfffee0ddu
#define TRANSFER_SYNTAX 0x00020010u

static const char implicit_syntax[] = "1.2.840.10008.1.2";
static const char explicit_syntax[] = "1.2.840.10008.1.2.1";
static const char big_syntax[] = "1.2.840.10008.1.2.2";
static const char deflated_syntax[] = "1.2.840.10008.1.2.1.99";

typedef struct walker {
    const unsigned char *data;
    size_t length, at;
    bool implicit, big;
    size_t elements, disorder;
    const char *fault;
} walker;

typedef struct element {
    uint32_t tag, length;
    char vr[2]; /* 0 where the syntax has none */
} element;

static bool fail(walker *w, const char *fault) {
    if (!w->fault)
        w->fault = fault;
    return false;
}

static uint32_t number(const walker *w, size_t at, size_t size) {
    uint32_t value = 0;
    for (size_t i = 0; i < size; i++)
        value |= (uint32_t)w->data[at + i] << 8 * (w->big ? size - 1 - i : i);
    return value;
}

/* ---- Elements ---- */

/* VRs whose explicit length has 2 bytes and those where it has 4 (PS3.5, 7.1.2). What the library
 * would make of others is its secret. */
static const char short_vrs[] = "AEASATCSDADSDTFDFLISLOLTPNSHSLSSSTTMUIULUS";
static const char long_vrs[] = "OBODOFOLOVOWSQSVUCUNURUTUV";

static bool is_among(const char *names, const char vr[2]) {
    for (; *names; names += 2)
        if (memcmp(names, vr, 2) == 0)
            return true;
    return false;
}

static bool is_vr(const unsigned char *text) {
    return text[0] >= 'A' && text[0] <= 'Z' && text[1] >= 'A' && text[1] <= 'Z';
}

/* The head of the element at w->at, which moves to its value. */
static bool read_head(walker *w, element *e) {
    if (w->length - w->at < 8)
        return fail(w, "it ends within an element");
    if (++w->elements > MAX_ELEMENTS)
        return fail(w, "it has too many elements");
    e->tag = number(w, w->at, 2) << 16 | number(w, w->at + 2, 2);
    bool bare = e->tag >> 16 == 0xfffe;
    memset(e->vr, 0, 2);
    if (w->implicit || bare) {
        e->length = number(w, w->at + 4, 4);
        w->at += 8;
    } else {
        memcpy(e->vr, w->data + w->at + 4, 2);
        bool is_long = is_among(long_vrs, e->vr);
        if (!is_long && !is_among(short_vrs, e->vr))
            return fail(w, "an element has an unknown value representation");
        if (!is_long) {
            e->length = number(w, w->at + 6, 2);
            w->at += 8;
        } else {
            if (w->length - w->at < 12)
                return fail(w, "it ends within an element");
            e->length = number(w, w->at + 8, 4);
            w->at += 12;
        }
    }
    if (e->length != UNDEFINED && e->length > w->length - w->at)
        return fail(w, "an element is longer than what is left of the file");
    return true;
}

/* What has not come to its end yet: the data set, a sequence, an item. */
typedef struct level {
    size_t end; /* SIZE_MAX: a delimiter ends it */
    uint32_t last;
    bool is_items; /* a sequence: only items are in it */
    bool implicit; /* how the elements in it are written */
} level;

typedef struct stack {
    level levels[2 * MAX_DEPTH + 1];
    size_t depth;
} stack;

static bool push(walker *w, stack *s, uint32_t length, bool is_items) {
    size_t outer = s->levels[s->depth].end;
    if (s->depth == 2 * MAX_DEPTH)
        return fail(w, "sequences are nested too deep");
    size_t end = length == UNDEFINED ? SIZE_MAX : w->at + length;
    if (end != SIZE_MAX && outer != SIZE_MAX && end > outer)
        return fail(w, "an element is longer than the item that it is in");
    s->depth++;
    s->levels[s->depth] = (level){end, 0, is_items, w->implicit};
    return true;
}

/* Without VR, what begins with an item is a sequence: the library asks its dictionary. */
static bool is_sequence(const walker *w, const element *e) {
    if (e->length == UNDEFINED || memcmp(e->vr, "SQ", 2) == 0)
        return true;
    return w->implicit && e->length >= 8 &&
           (number(w, w->at, 2) << 16 | number(w, w->at + 2, 2)) == ITEM;
}

static bool walk_fragments(walker *w, size_t *fragments) {
    element e;
    while (read_head(w, &e)) {
        if (e.tag == SEQUENCE_END && e.length == 0)
            return *fragments > 0 || fail(w, "its pixel data have no fragments");
        if (e.tag != ITEM || e.length == UNDEFINED)
            return fail(w, "the fragments of its pixel data are damaged");
        ++*fragments;
        w->at += e.length;
    }
    return false;
}

static bool walk_item(walker *w, stack *s, const element *e) {
    level *top = &s->levels[s->depth];
    if (e->tag == ITEM && top->is_items)
        return push(w, s, e->length, false);
    bool ends = e->tag == (top->is_items ? SEQUENCE_END : ITEM_END);
    if (!ends || top->end != SIZE_MAX || s->depth == 0 || e->length != 0)
        return fail(w, "an item is where none can be");
    s->depth--;
    return true;
}

static bool walk_element(walker *w, stack *s) {
    element e;
    if (!read_head(w, &e))
        return false;
    level *top = &s->levels[s->depth];
    if (e.tag >> 16 == 0xfffe || top->is_items)
        return walk_item(w, s, &e);
    if (top->end != SIZE_MAX && e.length != UNDEFINED && e.length > top->end - w->at)
        return fail(w, "an element is longer than the item that it is in");
    if (e.tag <= top->last && ++w->disorder > MAX_DISORDER)
        return fail(w, "its elements are in disorder");
    top->last = e.tag;
    size_t fragments = 0;
    bool is_bytes = memcmp(e.vr, "OB", 2) == 0 || memcmp(e.vr, "OW", 2) == 0;
    if (e.length == UNDEFINED && is_bytes) /* an icon, say */
        return walk_fragments(w, &fragments);
    if (e.length == UNDEFINED && memcmp(e.vr, "UN", 2) == 0)
        w->implicit = true; /* PS3.5, 6.2.2 */
    if (is_sequence(w, &e))
        return push(w, s, e.length, true);
    w->at += e.length;
    return true;
}

/* Levels whose length says that they end here. */
static void leave_levels(const walker *w, stack *s) {
    while (s->depth && s->levels[s->depth].end != SIZE_MAX && w->at >= s->levels[s->depth].end)
        s->depth--;
}

/* Float, double and other pixel data; tables of offsets come before. */
static bool is_pixel_tag(const walker *w) {
    if (w->length - w->at < 8 || number(w, w->at, 2) != 0x7fe0)
        return false;
    uint32_t low = number(w, w->at + 2, 2);
    return low == 0x08 || low == 0x09 || low == 0x10;
}

/* ---- Pixel data ---- */

static bool walk_pixels(walker *w, plr_dicom_set *set) {
    element e;
    if (!read_head(w, &e))
        return false;
    set->has_pixels = true;
    set->pixel_tag = e.tag;
    set->value = w->at;
    set->is_bytes = memcmp(e.vr, "OB", 2) == 0;
    if (e.length != UNDEFINED)
        w->at += e.length;
    else if (!walk_fragments(w, &set->fragments))
        return false;
    set->pixels = w->at - set->value;
    return true;
}

static const char *walk_set(walker *w, plr_dicom_set *set) {
    stack s = {.levels = {{SIZE_MAX, 0, false, w->implicit}}};
    while (!w->fault && w->at < w->length && !(s.depth == 0 && is_pixel_tag(w))) {
        walk_element(w, &s);
        leave_levels(w, &s);
        w->implicit = s.levels[s.depth].implicit;
    }
    set->header = w->at;
    if (!w->fault && s.depth)
        fail(w, "it ends within a sequence");
    if (!w->fault && w->at < w->length)
        walk_pixels(w, set);
    set->length = w->at;
    return w->fault;
}

/* ---- Files ---- */

/* A data set begins with identifying elements (group 8), often after group 2. */
static bool looks_like_elements(const unsigned char *data, size_t length) {
    static const unsigned char first[] = {0x00, 0x01, 0x05, 0x06, 0x08,
                                          0x12, 0x13, 0x14, 0x16, 0x18};
    if (length < 16 || data[0] != 8 || data[1] != 0 || data[3] != 0)
        return false;
    bool known = memchr(first, data[2], sizeof first) != NULL;
    return known && (is_vr(data + 4) || (data[5] == 0 && data[6] == 0 && data[7] == 0));
}

bool plr_dicom_sniff(const char *data, size_t length) {
    return (length >= PREAMBLE + 4 && memcmp(data + PREAMBLE, "DICM", 4) == 0) ||
           looks_like_elements((const unsigned char *)data, length);
}

static void copy_uid(char uid[PLR_DICOM_UID], const unsigned char *text, size_t length) {
    size_t used = 0;
    for (; used < length && used < PLR_DICOM_UID - 1 &&
           (text[used] == '.' || (text[used] >= '0' && text[used] <= '9'));
         used++)
        uid[used] = (char)text[used];
    uid[used] = '\0';
}

/* Group 2, always in explicit VR little endian. */
static void read_meta(walker *w, char syntax[PLR_DICOM_UID]) {
    while (!w->fault && w->length - w->at >= 8 && number(w, w->at, 2) == 2) {
        element e;
        if (!read_head(w, &e))
            return;
        if (e.length == UNDEFINED) {
            fail(w, "its file meta information is damaged");
            return;
        }
        if (e.tag == TRANSFER_SYNTAX)
            copy_uid(syntax, w->data + w->at, e.length);
        w->at += e.length;
    }
}

static char *inflate_set(const unsigned char *data, size_t length, size_t *out_length) {
    z_stream stream = {.next_in = (Bytef *)(uintptr_t)data,
                       .avail_in = (uInt)(length < UINT32_MAX ? length : UINT32_MAX)};
    char *out = NULL;
    size_t capacity = 0, used = 0;
    int status = inflateInit2(&stream, -15); /* RFC 1951, no header */
    bool ready = status == Z_OK;
    while (status == Z_OK) {
        size_t wanted = capacity ? capacity * 2 : 1u << 16;
        char *grown = wanted <= MAX_INFLATED ? realloc(out, wanted) : NULL;
        if (!grown)
            break;
        out = grown;
        capacity = wanted;
        stream.next_out = (Bytef *)out + used;
        stream.avail_out = (uInt)(capacity - used);
        status = inflate(&stream, Z_NO_FLUSH);
        used = capacity - stream.avail_out;
        if (stream.avail_out && status == Z_OK)
            status = Z_DATA_ERROR; /* the packed data ended early */
    }
    if (ready)
        inflateEnd(&stream);
    if (status != Z_STREAM_END) {
        free(out);
        return NULL;
    }
    *out_length = used;
    return out;
}

const char *plr_dicom_scan(const char *data, size_t length, plr_dicom_set *set) {
    memset(set, 0, sizeof *set);
    walker w = {.data = (const unsigned char *)data, .length = length};
    if (length >= PREAMBLE + 4 && memcmp(data + PREAMBLE, "DICM", 4) == 0) {
        w.at = PREAMBLE + 4;
        read_meta(&w, set->syntax);
    }
    if (w.fault)
        return w.fault;
    w.data += w.at;
    w.length -= w.at;
    w.at = 0;
    if (strcmp(set->syntax, deflated_syntax) == 0) {
        set->unpacked = inflate_set(w.data, w.length, &w.length);
        if (!set->unpacked)
            return "its deflated data cannot be unpacked";
        w.data = (const unsigned char *)set->unpacked;
        strcpy(set->syntax, explicit_syntax);
    }
    if (!*set->syntax) /* as the elements look */
        strcpy(set->syntax, w.length >= 8 && is_vr(w.data + 4) ? explicit_syntax : implicit_syntax);
    w.implicit = strcmp(set->syntax, implicit_syntax) == 0;
    w.big = strcmp(set->syntax, big_syntax) == 0;
    set->data = (const char *)w.data;
    set->big = w.big;
    return walk_set(&w, set);
}

void plr_dicom_set_free(plr_dicom_set *set) {
    free(set->unpacked);
    memset(set, 0, sizeof *set);
}
