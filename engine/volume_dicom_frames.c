/* The stored pixels of single frames. What is not packed, and run lengths, are read here: the
 * library would believe what they say of themselves. JPEG and its kin it unpacks. */
#include "engine/volume_dicom.h"

#include <stdio.h>
#include <string.h>

enum {
    RLE_HEADER = 64,
    RLE_SEGMENTS = 15
};

static const char rle_syntax[] = "1.2.840.10008.1.2.5";

static bool fail(char *fault, const char *text) {
    snprintf(fault, PLR_DICOM_FAULT, "%s", text);
    return false;
}

static uint32_t little(const unsigned char *bytes) {
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
           (uint32_t)bytes[3] << 24;
}

/* ---- Not packed ---- */

/* Big endian data are words of 16 bits where integers are stored, whatever they hold (PS3.5, 8.1.1
 * and annex D), or numbers as they are. */
static void order_bytes(const plr_dicom_set *set, const plr_dicom_format *format, char *out,
                        size_t size) {
    size_t sample = format->allocated / 8;
    bool words = format->pixels == PLR_DICOM_INTEGERS;
    if (set->big && !set->is_bytes)
        plr_swap_bytes(out, size / (words ? 2 : sample), words ? 2 : sample);
    if (plr_host_is_big_endian() && sample > 1)
        plr_swap_bytes(out, size / sample, sample);
}

static bool copy_frame(const plr_dicom_frames *frames, const plr_dicom_slice *slice, char *out,
                       size_t size) {
    const plr_dicom_set *set = &frames->set;
    size_t start = slice->frame * size, even = size + size % 2;
    if (start > set->pixels || size > set->pixels - start)
        return false;
    const char *from = set->data + set->value;
    bool shifted = start % 2 && set->big && !set->is_bytes; /* its bytes lie in words of others */
    if (shifted)
        for (size_t i = 0; i < size; i++)
            out[i] = from[((start + i) ^ 1) < set->pixels ? (start + i) ^ 1 : start + i];
    else {
        memcpy(out, from + start, even <= set->pixels - start ? even : size);
        order_bytes(set, &slice->format, out, even);
    }
    return true;
}

/* ---- Run lengths ---- */

/* The value of fragment `index`; NULL where there is none. */
static const unsigned char *find_fragment(plr_dicom_frames *frames, size_t index, size_t *length) {
    const plr_dicom_set *set = &frames->set;
    const unsigned char *data = (const unsigned char *)set->data;
    if (index < frames->fragment || frames->at < set->value) {
        frames->fragment = 0;
        frames->at = set->value;
    }
    /* the scan has been through all of them */
    while (index < set->fragments && frames->fragment < index) {
        frames->at += 8 + (size_t)little(data + frames->at + 4);
        frames->fragment++;
    }
    if (index >= set->fragments)
        return NULL;
    *length = little(data + frames->at + 4);
    return data + frames->at + 8;
}

/* PackBits: one byte of each sample, `step` bytes apart. */
static bool unpack_segment(const unsigned char *from, const unsigned char *end, unsigned char *to,
                           size_t count, size_t step) {
    size_t done = 0;
    while (done < count && from < end) {
        unsigned control = *from++;
        size_t run = control < 128 ? control + 1 : control > 128 ? 257 - control : 0;
        size_t needed = control < 128 ? run : run > 0;
        if ((size_t)(end - from) < needed)
            return false;
        for (size_t i = 0; i < run && done < count; i++, done++)
            to[done * step] = from[control < 128 ? i : 0];
        from += needed;
    }
    return done == count;
}

/* PS3.5, annex G: a segment for each byte of a sample, the most significant first; colours one
 * after the other. */
static bool unpack_runs(plr_dicom_frames *frames, const plr_dicom_slice *slice,
                        unsigned char *out) {
    const plr_dicom_format *format = &slice->format;
    size_t length = 0, bytes = format->allocated / 8, segments = bytes * format->samples;
    size_t count = (size_t)format->columns * format->rows;
    const unsigned char *from = find_fragment(frames, slice->frame + 1, &length);
    if (!from || length < RLE_HEADER || little(from) != segments || segments > RLE_SEGMENTS)
        return false;
    for (size_t s = 0; s < segments; s++) {
        size_t start = little(from + 4 + 4 * s);
        size_t end = s + 1 < segments ? little(from + 8 + 4 * s) : length;
        size_t colour = s / bytes, byte = s % bytes;
        size_t place = plr_host_is_big_endian() ? byte : bytes - 1 - byte;
        size_t first = format->planar ? colour * count * bytes : colour * bytes;
        size_t step = format->planar ? bytes : bytes * format->samples;
        if (start < RLE_HEADER || end > length || start > end ||
            !unpack_segment(from + start, from + end, out + first + place, count, step))
            return false;
    }
    return true;
}

/* ---- Files ---- */

bool plr_dicom_frames_open(plr_dicom_frames *frames, const char *data, size_t length,
                           char fault[PLR_DICOM_FAULT]) {
    memset(frames, 0, sizeof *frames);
    const char *wrong = plr_dicom_scan(data, length, &frames->set);
    if (wrong)
        return fail(fault, wrong);
    const plr_dicom_set *set = &frames->set;
    frames->is_rle = strcmp(set->syntax, rle_syntax) == 0;
    if (set->fragments && !frames->is_rle)
        frames->library = plr_dicom_open(set->data, set->length, set->syntax, fault);
    return frames->library || !set->fragments || frames->is_rle;
}

bool plr_dicom_frames_read(plr_dicom_frames *frames, const plr_dicom_slice *slice, void *out,
                           size_t size, bool *is_ybr, char fault[PLR_DICOM_FAULT]) {
    char photometric[32];
    *is_ybr = slice->format.is_ybr;
    if (frames->library) {
        if (!plr_dicom_frame(frames->library, slice->frame, out, size, photometric, fault))
            return false;
        *is_ybr = strncmp(photometric, "YBR", 3) == 0;
        return true;
    }
    bool ok = frames->set.fragments ? frames->is_rle && unpack_runs(frames, slice, out)
                                    : copy_frame(frames, slice, out, size);
    return ok || fail(fault, "its pixel data are damaged");
}

void plr_dicom_frames_close(plr_dicom_frames *frames) {
    plr_dicom_close(frames->library);
    plr_dicom_set_free(&frames->set);
    memset(frames, 0, sizeof *frames);
}
