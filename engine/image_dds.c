/* DDS: pictures, volumes and cube maps with their mipmaps, in the layouts that "DDS File Layout"
 * and "DDS_PIXELFORMAT" (Direct3D) describe. */
#include "engine/image_dds.h"

#include <stdlib.h>
#include <string.h>

#include "engine/image_internal.h"

/* ---- Formats ---- */

typedef struct format {
    enum {
        MASKS,  /* one little-endian integer a texel; masks of R, G, B, A or L, -, -, A */
        WORDS,  /* unsigned 16-bit integers */
        HALVES, /* 16-bit floats */
        FLOATS, /* 32-bit floats */
        BLOCKS  /* four by four texels */
    } layout;
    uint32_t stored;     /* values a texel: WORDS, HALVES, FLOATS */
    uint32_t components; /* of the image */
    uint32_t bytes;      /* of a texel or block */
    uint32_t masks[4];
    void (*unpack)(const uint8_t *block, uint8_t *texels);
} format;

#define FOUR(a, b, c, d)                                                                           \
    ((uint32_t)(a) | (uint32_t)(b) << 8 | (uint32_t)(c) << 16 | (uint32_t)(d) << 24)
#define BLOCK(components, bytes, unpack)                                                           \
    { BLOCKS, 0, components, bytes, {0, 0, 0, 0}, unpack }
/* Two values are red and green, not luminance and alpha: blue is 0. */
#define PLAIN(layout, stored, size)                                                                \
    { layout, stored, (stored) == 2 ? 3 : (stored), (stored) * (size), {0, 0, 0, 0}, NULL }
#define MASKED(components, bytes, r, g, b, a)                                                      \
    { MASKS, 0, components, bytes, {r, g, b, a}, NULL }

typedef struct entry {
    uint32_t code;
    format format;
} entry;

static const entry four_cc[] = {
    {FOUR('D', 'X', 'T', '1'), BLOCK(4, 8, plr_unpack_bc1)},
    {FOUR('D', 'X', 'T', '2'), BLOCK(4, 16, plr_unpack_bc2)},
    {FOUR('D', 'X', 'T', '3'), BLOCK(4, 16, plr_unpack_bc2)},
    {FOUR('D', 'X', 'T', '4'), BLOCK(4, 16, plr_unpack_bc3)},
    {FOUR('D', 'X', 'T', '5'), BLOCK(4, 16, plr_unpack_bc3)},
    {FOUR('A', 'T', 'I', '1'), BLOCK(1, 8, plr_unpack_bc4)},
    {FOUR('B', 'C', '4', 'U'), BLOCK(1, 8, plr_unpack_bc4)},
    {FOUR('A', 'T', 'I', '2'), BLOCK(3, 16, plr_unpack_bc5)},
    {FOUR('B', 'C', '5', 'U'), BLOCK(3, 16, plr_unpack_bc5)},
    /* D3DFORMAT numbers */
    {36, PLAIN(WORDS, 4, 2)},
    {111, PLAIN(HALVES, 1, 2)},
    {112, PLAIN(HALVES, 2, 2)},
    {113, PLAIN(HALVES, 4, 2)},
    {114, PLAIN(FLOATS, 1, 4)},
    {115, PLAIN(FLOATS, 2, 4)},
    {116, PLAIN(FLOATS, 4, 4)},
};

/* DXGI_FORMAT numbers; sRGB ones are taken as the others: colours are numbers as they stand. */
static const entry dxgi[] = {
    {2, PLAIN(FLOATS, 4, 4)},
    {6, PLAIN(FLOATS, 3, 4)},
    {10, PLAIN(HALVES, 4, 2)},
    {11, PLAIN(WORDS, 4, 2)},
    {16, PLAIN(FLOATS, 2, 4)},
    {24, MASKED(4, 4, 0x3ff, 0xffc00, 0x3ff00000, 0xc0000000)},
    {28, MASKED(4, 4, 0xff, 0xff00, 0xff0000, 0xff000000)},
    {29, MASKED(4, 4, 0xff, 0xff00, 0xff0000, 0xff000000)},
    {34, PLAIN(HALVES, 2, 2)},
    {35, PLAIN(WORDS, 2, 2)},
    {41, PLAIN(FLOATS, 1, 4)},
    {49, MASKED(3, 2, 0xff, 0xff00, 0, 0)},
    {54, PLAIN(HALVES, 1, 2)},
    {56, PLAIN(WORDS, 1, 2)},
    {61, MASKED(1, 1, 0xff, 0, 0, 0)},
    {65, MASKED(2, 1, 0, 0, 0, 0xff)},
    {71, BLOCK(4, 8, plr_unpack_bc1)},
    {72, BLOCK(4, 8, plr_unpack_bc1)},
    {74, BLOCK(4, 16, plr_unpack_bc2)},
    {75, BLOCK(4, 16, plr_unpack_bc2)},
    {77, BLOCK(4, 16, plr_unpack_bc3)},
    {78, BLOCK(4, 16, plr_unpack_bc3)},
    {80, BLOCK(1, 8, plr_unpack_bc4)},
    {83, BLOCK(3, 16, plr_unpack_bc5)},
    {85, MASKED(3, 2, 0xf800, 0x7e0, 0x1f, 0)},
    {86, MASKED(4, 2, 0x7c00, 0x3e0, 0x1f, 0x8000)},
    {87, MASKED(4, 4, 0xff0000, 0xff00, 0xff, 0xff000000)},
    {88, MASKED(3, 4, 0xff0000, 0xff00, 0xff, 0)},
    {91, MASKED(4, 4, 0xff0000, 0xff00, 0xff, 0xff000000)},
    {93, MASKED(3, 4, 0xff0000, 0xff00, 0xff, 0)},
    {115, MASKED(4, 2, 0xf00, 0xf0, 0xf, 0xf000)},
};

static bool find_format(const entry *rows, size_t count, uint32_t code, format *found) {
    for (size_t i = 0; i < count; i++)
        if (rows[i].code == code) {
            *found = rows[i].format;
            return true;
        }
    return false;
}

/* ---- Header ---- */

typedef struct dds {
    const uint8_t *at, *end; /* what is not read yet */
    uint32_t width, height, depth, levels;
    bool cube;
    format format;
} dds;

enum { /* where the header has its numbers */
    HEIGHT = 12,
    WIDTH = 16,
    DEPTH = 24,
    LEVELS = 28,
    PIXEL_FLAGS = 80,
    FOUR_CC = 84,
    BITS = 88,
    MASK = 92,
    CAPS2 = 112,
    HEADER_SIZE = 128,
    DXGI_FORMAT = 128,
    DIMENSION = 132,
    MISC = 136,
    ARRAY_SIZE = 140,
    LONG_HEADER_SIZE = 148
};

enum { /* pixel formats have */
    HAS_ALPHA = 1,
    ONLY_ALPHA = 2,
    HAS_FOUR_CC = 4,
    IS_RGB = 0x40,
    IS_LUMINANCE = 0x20000
};

static uint32_t number(const uint8_t *bytes) {
    return FOUR(bytes[0], bytes[1], bytes[2], bytes[3]);
}

static const char *read_masks(const uint8_t *header, format *f) {
    uint32_t flags = number(header + PIXEL_FLAGS), bits = number(header + BITS);
    if (bits != 8 && bits != 16 && bits != 24 && bits != 32)
        return "its texels have neither 8, 16, 24 nor 32 bits";
    *f = (format){.layout = MASKS, .bytes = bits / 8};
    uint32_t whole = bits == 32 ? 0xffffffff : (1u << bits) - 1;
    for (int i = 0; i < 4; i++)
        f->masks[i] = number(header + MASK + 4 * i) & whole;
    if (!(flags & (HAS_ALPHA | ONLY_ALPHA)))
        f->masks[3] = 0;
    if (flags & IS_RGB)
        f->components = f->masks[3] ? 4 : 3;
    else if (flags & IS_LUMINANCE)
        f->components = f->masks[3] ? 2 : 1;
    else if (flags & ONLY_ALPHA)
        f->components = 2;
    else
        return "its texels are neither colours nor grey";
    if (f->components < 3)
        f->masks[1] = f->masks[2] = 0;
    if (flags & ONLY_ALPHA && !(flags & (IS_RGB | IS_LUMINANCE)))
        f->masks[0] = 0;
    return NULL;
}

static const char *read_format(dds *d, const uint8_t *header, uint32_t *misc) {
    static const char unknown[] = "its format of texels is not read (BC6H, BC7, signed, ...)";
    if (!(number(header + PIXEL_FLAGS) & HAS_FOUR_CC))
        return read_masks(header, &d->format);
    uint32_t code = number(header + FOUR_CC);
    if (code != FOUR('D', 'X', '1', '0'))
        return find_format(four_cc, sizeof four_cc / sizeof *four_cc, code, &d->format) ? NULL
                                                                                        : unknown;
    if (d->end - header < LONG_HEADER_SIZE)
        return "it is cut off";
    d->at = header + LONG_HEADER_SIZE;
    *misc = number(header + MISC);
    if (number(header + DIMENSION) != 4)
        d->depth = 1;
    return find_format(dxgi, sizeof dxgi / sizeof *dxgi, number(header + DXGI_FORMAT), &d->format)
               ? NULL
               : unknown;
}

static uint32_t halved(uint32_t side, uint32_t level) {
    uint32_t half = level < 32 ? side >> level : 0;
    return half ? half : 1;
}

static const char *read_header(dds *d) {
    const uint8_t *header = d->at;
    if (d->end - d->at < HEADER_SIZE)
        return "it is cut off";
    uint32_t caps = number(header + CAPS2), misc = 0;
    d->at += HEADER_SIZE;
    d->width = number(header + WIDTH);
    d->height = number(header + HEIGHT);
    d->depth = caps & 0x200000 ? number(header + DEPTH) : 1;
    d->levels = number(header + LEVELS);
    const char *fault = read_format(d, header, &misc);
    if (fault)
        return fault;
    bool is_long = d->at == header + LONG_HEADER_SIZE;
    if (is_long && number(header + DIMENSION) == 4)
        d->depth = number(header + DEPTH);
    d->cube = caps & 0x200 || misc & 4;
    if (d->cube && !(misc & 4) && (caps & 0xfc00) != 0xfc00)
        return "its cube map lacks faces";
    if (!d->width || !d->height || !d->depth || (d->cube && d->width != d->height) ||
        (d->cube && d->depth != 1))
        return "its sizes cannot be right";
    if (d->width > PLR_IMAGE_MAX_SIDE || d->height > PLR_IMAGE_MAX_SIDE ||
        d->depth > PLR_IMAGE_MAX_SIDE)
        return "it is too large";
    uint32_t most = 1;
    while (halved(d->width, most - 1) > 1 || halved(d->height, most - 1) > 1 ||
           halved(d->depth, most - 1) > 1)
        most++;
    d->levels = d->levels < 1 ? 1 : d->levels > most ? most : d->levels;
    return NULL;
}

/* ---- Texels ---- */

static bool is_deep(const format *f) {
    if (f->layout != MASKS)
        return f->layout == WORDS;
    for (int i = 0; i < 4; i++) { /* 1, 2, 4 and 8 bits fit into 8 without loss */
        uint32_t most = f->masks[i];
        while (most && !(most & 1))
            most >>= 1;
        if (most && 255 % most)
            return true;
    }
    return false;
}

/* One component of a texel: value * whole / greatest value, rounded. */
static uint32_t masked(uint32_t texel, uint32_t mask, uint32_t whole) {
    if (!mask)
        return whole; /* alpha 1, and white where there is nothing but alpha */
    uint32_t value = texel & mask;
    while (!(mask & 1)) {
        mask >>= 1;
        value >>= 1;
    }
    return (uint32_t)(((uint64_t)value * whole + mask / 2) / mask);
}

static void unpack_masks(const format *f, const uint8_t *texels, size_t count, void *out) {
    bool deep = is_deep(f);
    uint32_t n = f->components;
    for (size_t i = 0; i < count; i++, texels += f->bytes) {
        uint32_t texel = 0;
        for (uint32_t byte = 0; byte < f->bytes; byte++)
            texel |= (uint32_t)texels[byte] << (8 * byte);
        for (uint32_t c = 0; c < n; c++) {
            bool is_alpha = c == 3 || (n == 2 && c == 1);
            uint32_t mask = f->masks[is_alpha ? 3 : c], whole = deep ? 65535 : 255;
            bool lacks = !mask && n >= 3 && !is_alpha; /* red and green alone */
            uint32_t value = lacks ? 0 : masked(texel, mask, whole);
            if (deep)
                ((uint16_t *)out)[i * n + c] = (uint16_t)value;
            else
                ((uint8_t *)out)[i * n + c] = (uint8_t)value;
        }
    }
}

static float half_to_float(uint32_t half) {
    uint32_t sign = half >> 15 << 31, exponent = half >> 10 & 31, mantissa = half & 0x3ff, bits;
    float value;
    if (exponent == 0) { /* zero and denormal numbers */
        value = (float)mantissa * 0x1p-24f;
        return sign ? -value : value;
    }
    bits = sign | (exponent == 31 ? 0xffu : exponent + 112) << 23 | mantissa << 13;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void unpack_plain(const format *f, const uint8_t *texels, size_t count, void *out) {
    uint32_t n = f->components, size = f->bytes / f->stored;
    for (size_t i = 0; i < count; i++)
        for (uint32_t c = 0; c < n; c++) {
            const uint8_t *at = texels + i * f->bytes + (size_t)c * size;
            uint32_t bits = c < f->stored ? at[0] | (uint32_t)at[1] << 8 : 0;
            if (c < f->stored && size == 4)
                bits = number(at);
            if (f->layout == WORDS)
                ((uint16_t *)out)[i * n + c] = (uint16_t)bits;
            else if (f->layout == HALVES)
                ((float *)out)[i * n + c] = half_to_float(bits);
            else
                memcpy((float *)out + i * n + c, &bits, sizeof bits);
        }
}

/* Blocks at the right and lower edge reach beyond it. */
static void unpack_blocks(const format *f, const uint8_t *blocks, uint32_t width, uint32_t height,
                          uint8_t *out) {
    uint32_t n = f->components;
    uint8_t texels[16 * 4];
    for (uint32_t y = 0; y < height; y += 4)
        for (uint32_t x = 0; x < width; x += 4, blocks += f->bytes) {
            uint32_t columns = width - x < 4 ? width - x : 4,
                     rows = height - y < 4 ? height - y : 4;
            f->unpack(blocks, texels);
            for (uint32_t row = 0; row < rows; row++)
                memcpy(out + ((size_t)(y + row) * width + x) * n, texels + (size_t)row * 4 * n,
                       (size_t)columns * n);
        }
}

/* ---- Surfaces ---- */

static size_t surface_bytes(const format *f, uint32_t width, uint32_t height) {
    if (f->layout == BLOCKS)
        return ((size_t)width + 3) / 4 * (((size_t)height + 3) / 4) * f->bytes;
    return (size_t)width * height * f->bytes;
}

static void unpack_surface(const format *f, const uint8_t *data, uint32_t width, uint32_t height,
                           void *out) {
    if (f->layout == BLOCKS)
        unpack_blocks(f, data, width, height, out);
    else if (f->layout == MASKS)
        unpack_masks(f, data, (size_t)width * height, out);
    else
        unpack_plain(f, data, (size_t)width * height, out);
}

/* The order of faces is that of GL, but up is down: in the right-handed space of a scene, -y of the
 * file's left-handed space is up. */
static uint32_t face_of(uint32_t face) {
    return face == 2 ? 3 : face == 3 ? 2 : face;
}

/* All slices of one level of a volume, or of one face, follow each other. */
static void unpack_all(const dds *d, plr_image *image) {
    size_t sample = plr_image_sample_size(image->type), level_start = 0;
    const uint8_t *data = d->at;
    size_t face_bytes = 0;
    for (uint32_t level = 0; level < d->levels; level++)
        face_bytes += surface_bytes(&d->format, halved(d->width, level), halved(d->height, level));
    for (uint32_t level = 0; level < d->levels; level++) {
        uint32_t width = halved(d->width, level), height = halved(d->height, level);
        uint32_t slices = d->cube ? 6 : halved(d->depth, level);
        size_t bytes = surface_bytes(&d->format, width, height);
        size_t samples = (size_t)width * height * image->components;
        for (uint32_t slice = 0; slice < slices; slice++) {
            size_t to = level_start + samples * (d->cube ? face_of(slice) : slice);
            unpack_surface(&d->format, data + (d->cube ? face_bytes : bytes) * slice, width, height,
                           (char *)image->samples + to * sample);
        }
        data += d->cube ? bytes : bytes * slices;
        level_start += samples * slices;
    }
}

/* Bytes of the file and of the image with all its levels. Levels that are cut off are left out, if
 * they are the last in the file. */
static const char *check_sizes(dds *d, const plr_image *image, size_t *image_bytes) {
    uint64_t have = (uint64_t)(d->end - d->at), file = 0, samples = 0;
    uint32_t faces = d->cube ? 6 : 1;
    for (uint32_t level = 0; level < d->levels; level++) {
        uint32_t width = halved(d->width, level), height = halved(d->height, level);
        uint64_t slices = (uint64_t)faces * halved(d->depth, level);
        uint64_t bytes = surface_bytes(&d->format, width, height) * slices;
        if (bytes > have || file + bytes > have) {
            if (level == 0 || d->cube)
                return "it is cut off";
            d->levels = level;
            break;
        }
        file += bytes;
        samples += (uint64_t)width * height * slices * image->components;
        if (samples * plr_image_sample_size(image->type) > PLR_IMAGE_MAX_BYTES)
            return "it is too large";
    }
    *image_bytes = (size_t)(samples * plr_image_sample_size(image->type));
    return NULL;
}

bool plr_image_is_dds(const char *data, size_t length) {
    return length > 4 && memcmp(data, "DDS ", 4) == 0;
}

const char *plr_image_decode_dds(const char *data, size_t length, plr_image *image) {
    dds d = {.at = (const uint8_t *)data, .end = (const uint8_t *)data + length};
    const char *fault = read_header(&d);
    if (fault)
        return fault;
    plr_image made = {.width = d.width,
                      .height = d.height,
                      .depth = d.cube ? 6 : d.depth,
                      .components = d.format.components,
                      .cube = d.cube};
    bool is_float = d.format.layout == HALVES || d.format.layout == FLOATS;
    made.type = is_float ? PLR_FLOAT32 : is_deep(&d.format) ? PLR_UNORM16 : PLR_UNORM8;
    size_t bytes = 0;
    if ((fault = check_sizes(&d, &made, &bytes)))
        return fault;
    made.mipmaps = d.levels - 1;
    made.samples = malloc(bytes);
    if (!made.samples)
        return "there is not enough memory";
    unpack_all(&d, &made);
    *image = made;
    return NULL;
}
