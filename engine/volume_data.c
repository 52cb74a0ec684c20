/* Encodings of voxel data: byte order, gzip, hexadecimal, text. */
#include "engine/volume_internal.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

static const struct {
    unsigned char size;
    const char *text;
} types[] = {
    [PLR_VOXEL_U8] = {1, "unsigned 8-bit integers"},
    [PLR_VOXEL_S8] = {1, "signed 8-bit integers"},
    [PLR_VOXEL_U16] = {2, "unsigned 16-bit integers"},
    [PLR_VOXEL_S16] = {2, "signed 16-bit integers"},
    [PLR_VOXEL_U32] = {4, "unsigned 32-bit integers"},
    [PLR_VOXEL_S32] = {4, "signed 32-bit integers"},
    [PLR_VOXEL_U64] = {8, "unsigned 64-bit integers"},
    [PLR_VOXEL_S64] = {8, "signed 64-bit integers"},
    [PLR_VOXEL_F32] = {4, "32-bit floats"},
    [PLR_VOXEL_F64] = {8, "64-bit floats"},
};

size_t plr_voxel_size(plr_voxel_type type) {
    return types[type].size;
}

const char *plr_voxel_type_text(plr_voxel_type type) {
    return types[type].text;
}

bool plr_host_is_big_endian(void) {
    const uint16_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    return first == 0;
}

/* Shifts that compilers turn into byte swaps of whole vectors. */
#define SWAP(bits, type, expression)                                                               \
    static void swap##bits(unsigned char *at, size_t count) {                                      \
        for (size_t i = 0; i < count; i++, at += sizeof(type)) {                                   \
            type v;                                                                                \
            memcpy(&v, at, sizeof v);                                                              \
            v = (type)(expression);                                                                \
            memcpy(at, &v, sizeof v);                                                              \
        }                                                                                          \
    }
SWAP(16, uint16_t, v >> 8 | v << 8)
SWAP(32, uint32_t, v >> 24 | (v >> 8 & 0xff00) | (v << 8 & 0xff0000) | v << 24)
SWAP(64, uint64_t,
     v >> 56 | (v >> 40 & 0xff00) | (v >> 24 & 0xff0000) | (v >> 8 & 0xff000000) |
         (v << 8 & UINT64_C(0xff00000000)) | (v << 24 & UINT64_C(0xff0000000000)) |
         (v << 40 & UINT64_C(0xff000000000000)) | v << 56)

void plr_swap_bytes(void *data, size_t count, size_t size) {
    if (size == 2)
        swap16(data, count);
    else if (size == 4)
        swap32(data, count);
    else if (size == 8)
        swap64(data, count);
}

/* ---- gzip ---- */

bool plr_is_gzip(const char *data, size_t length) {
    return length >= 18 && memcmp(data, "\x1f\x8b\x08", 3) == 0;
}

static const char damaged[] = "they are damaged";

/* A gzip file as a stream: reading goes on over the ends of its members. */
typedef struct unpacker {
    z_stream stream;
    const char *at;
    size_t left;
    const char *fault;
    bool ended;
} unpacker;

static bool unpacker_start(unpacker *u, const char *data, size_t length) {
    memset(u, 0, sizeof *u);
    u->at = data;
    u->left = length;
    if (!plr_is_gzip(data, length))
        u->fault = "they are not in gzip format";
    else if (inflateInit2(&u->stream, 15 + 16) != Z_OK)
        u->fault = "there is not enough memory";
    return !u->fault;
}

/* Hands the next piece of the input to zlib, whose counts are 32 bits wide. */
static void unpacker_feed(unpacker *u) {
    uInt piece = u->left > (1u << 30) ? 1u << 30 : (uInt)u->left;
    union {
        const char *given;
        Bytef *wanted; /* zlib does not write there */
    } input = {.given = u->at};
    u->stream.next_in = input.wanted;
    u->stream.avail_in = piece;
    u->at += piece;
    u->left -= piece;
}

/* At the end of a member: another one may follow; anything else is padding. */
static void unpacker_next_member(unpacker *u) {
    u->at -= u->stream.avail_in;
    u->left += u->stream.avail_in;
    u->stream.avail_in = 0;
    if (!plr_is_gzip(u->at, u->left) || inflateReset(&u->stream) != Z_OK)
        u->ended = true;
}

/* Fills `out`; less only at the end or at a fault. */
static size_t unpacker_read(unpacker *u, char *out, size_t size) {
    size_t done = 0;
    while (done < size && !u->ended && !u->fault) {
        if (u->stream.avail_in == 0)
            unpacker_feed(u);
        uInt room = size - done > (1u << 30) ? 1u << 30 : (uInt)(size - done);
        u->stream.next_out = (Bytef *)out + done;
        u->stream.avail_out = room;
        int result = inflate(&u->stream, Z_NO_FLUSH);
        done += room - u->stream.avail_out;
        if (result == Z_STREAM_END)
            unpacker_next_member(u);
        else if (result == Z_BUF_ERROR ||
                 (result == Z_OK && !u->stream.avail_in && !u->left && u->stream.avail_out))
            u->fault = "they are cut off";
        else if (result != Z_OK)
            u->fault = damaged;
    }
    return done;
}

size_t plr_inflate(const plr_volume_source *source, const char *data, size_t length, uint64_t skip,
                   void *out, size_t size, const char **fault) {
    static const size_t piece = (size_t)16 << 20;
    unpacker u;
    size_t done = 0;
    if (unpacker_start(&u, data, length)) {
        char waste[4096];
        while (skip > 0 && !u.ended && !u.fault)
            skip -= unpacker_read(&u, waste, skip < sizeof waste ? (size_t)skip : sizeof waste);
        for (size_t got = 1; got && done < size; done += got) {
            got = unpacker_read(&u, (char *)out + done, size - done < piece ? size - done : piece);
            if (source->progress && size > piece)
                source->progress(source->user, source->name, (double)done / (double)size);
        }
        /* one byte more makes zlib compare the check sum, if this is the end */
        if (done == size)
            unpacker_read(&u, waste, 1);
        inflateEnd(&u.stream);
    }
    *fault = done < size || u.fault == damaged ? u.fault : NULL;
    return done;
}

char *plr_gunzip(const char *data, size_t length, size_t limit, size_t *out_length,
                 const char **fault) {
    unpacker u;
    *out_length = 0;
    if (!unpacker_start(&u, data, length)) {
        *fault = u.fault;
        return NULL;
    }
    size_t capacity = 0;
    char *out = NULL;
    while (!u.ended && !u.fault) {
        size_t wanted = capacity ? capacity * 2 : 1u << 16;
        if (wanted > limit)
            wanted = limit;
        char *grown = wanted > capacity ? realloc(out, wanted + 1) : NULL;
        if (!grown) {
            u.fault = wanted > capacity ? "there is not enough memory" : "they are too large";
            break;
        }
        out = grown;
        capacity = wanted;
        *out_length += unpacker_read(&u, out + *out_length, capacity - *out_length);
    }
    inflateEnd(&u.stream);
    *fault = u.fault;
    if (u.fault) {
        free(out);
        return NULL;
    }
    if (out)
        out[*out_length] = '\0';
    return out;
}

/* ---- text ---- */

static bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

static int hex_digit(char c) {
    if (c >= '0' && c <= '9')
        return c - '0';
    c = (char)(c | 0x20);
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

size_t plr_read_hex(const char *text, size_t length, void *out, size_t size) {
    unsigned char *bytes = out;
    size_t digits = 0;
    for (size_t i = 0; i < length && digits < 2 * size; i++) {
        if (is_blank(text[i]))
            continue;
        int digit = hex_digit(text[i]);
        if (digit < 0)
            break;
        if (digits % 2 == 0)
            bytes[digits / 2] = (unsigned char)(digit << 4);
        else
            bytes[digits / 2] = (unsigned char)(bytes[digits / 2] | digit);
        digits++;
    }
    return digits / 2;
}

/* A decimal integer as sign and magnitude; false if it is none or has more than 64 bits. */
static bool parse_integer(const char *token, bool *negative, uint64_t *magnitude) {
    *negative = *token == '-';
    if (*token == '-' || *token == '+')
        token++;
    *magnitude = 0;
    if (!*token)
        return false;
    for (; *token; token++) {
        unsigned digit = (unsigned)(*token - '0');
        if (digit > 9 || *magnitude > (UINT64_MAX - digit) / 10)
            return false;
        *magnitude = *magnitude * 10 + digit;
    }
    return true;
}

static const char *store_integer(const char *token, plr_voxel_type type, void *out) {
    bool negative;
    uint64_t magnitude;
    if (!parse_integer(token, &negative, &magnitude))
        return "this is not an integer";
    size_t size = plr_voxel_size(type);
    bool is_signed = type == PLR_VOXEL_S8 || type == PLR_VOXEL_S16 || type == PLR_VOXEL_S32 ||
                     type == PLR_VOXEL_S64;
    uint64_t greatest = UINT64_MAX >> (64 - 8 * size + (is_signed ? 1 : 0));
    uint64_t limit = negative ? (is_signed ? greatest + 1 : 0) : greatest;
    if (magnitude > limit)
        return "this does not fit the type";
    uint64_t bits = negative ? ~magnitude + 1 : magnitude;
    if (plr_host_is_big_endian())
        bits <<= 64 - 8 * size;
    memcpy(out, &bits, size);
    return NULL;
}

static const char *store_float(const char *token, plr_voxel_type type, void *out) {
    char *end;
    double number = strtod(token, &end);
    if (end == token || *end)
        return "this is not a number";
    float narrow = (float)number;
    if (type == PLR_VOXEL_F32)
        memcpy(out, &narrow, sizeof narrow);
    else
        memcpy(out, &number, sizeof number);
    return NULL;
}

size_t plr_read_numbers(const char *text, size_t length, plr_voxel_type type, void *out,
                        size_t count, size_t *offset, const char **fault) {
    char *at = out;
    size_t size = plr_voxel_size(type), position = 0, done = 0;
    bool is_float = type == PLR_VOXEL_F32 || type == PLR_VOXEL_F64;
    *fault = NULL;
    for (; done < count; done++, at += size) {
        while (position < length && (is_blank(text[position]) || text[position] == ','))
            position++;
        *offset = position;
        char token[64];
        size_t used = 0;
        while (position < length && !is_blank(text[position]) && text[position] != ',' &&
               used < sizeof token - 1)
            token[used++] = text[position++];
        token[used] = '\0';
        if (used == 0)
            break;
        *fault = is_float ? store_float(token, type, at) : store_integer(token, type, at);
        if (*fault)
            break;
    }
    return done;
}

/* ---- order of axes ---- */

/* One row along the fastest axis; a size that is known makes a copy one instruction. */
static inline void gather_row(char *to, const char *from, size_t size, size_t step,
                              uint64_t count) {
    for (uint64_t i = 0; i < count; i++, to += size, from += step)
        memcpy(to, from, size);
}

static void gather_any(char *to, const char *from, size_t size, size_t step, uint64_t count) {
    switch (size) {
    case 1:
        gather_row(to, from, 1, step, count);
        break;
    case 2:
        gather_row(to, from, 2, step, count);
        break;
    case 4:
        gather_row(to, from, 4, step, count);
        break;
    case 8:
        gather_row(to, from, 8, step, count);
        break;
    default:
        gather_row(to, from, size, step, count);
        break;
    }
}

void plr_gather(void *out, const void *in, size_t size, const uint64_t count[4],
                const uint64_t stride[4]) {
    char *to = out;
    size_t row = (size_t)count[0] * size, step = (size_t)stride[0] * size;
    for (uint64_t l = 0; l < count[3]; l++)
        for (uint64_t k = 0; k < count[2]; k++)
            for (uint64_t j = 0; j < count[1]; j++, to += row) {
                uint64_t first = l * stride[3] + k * stride[2] + j * stride[1];
                gather_any(to, (const char *)in + (size_t)first * size, size, step, count[0]);
            }
}
