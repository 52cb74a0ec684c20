/* The block formats BC1 to BC5, as "Texture Block Compression in Direct3D" describes them. */
#include "engine/image_dds.h"

#include <stdbool.h>

static unsigned word(const uint8_t *bytes) {
    return bytes[0] | (unsigned)bytes[1] << 8;
}

static void expand_565(unsigned packed, unsigned rgb[3]) {
    rgb[0] = ((packed >> 11 & 31) * 255 + 15) / 31;
    rgb[1] = ((packed >> 5 & 63) * 255 + 31) / 63;
    rgb[2] = ((packed & 31) * 255 + 15) / 31;
}

/* Colours of 8 bytes: two ends, two bits a texel. Where the first end is the smaller one, the
 * third colour lies in the middle and the fourth is transparent black - in BC1 alone. */
static void unpack_colours(const uint8_t *block, bool has_transparent, uint8_t *rgba) {
    unsigned palette[4][4] = {{0, 0, 0, 255}, {0, 0, 0, 255}, {0, 0, 0, 255}, {0, 0, 0, 255}};
    unsigned first = word(block), second = word(block + 2);
    expand_565(first, palette[0]);
    expand_565(second, palette[1]);
    bool three = has_transparent && first <= second;
    for (int c = 0; c < 3; c++) {
        unsigned a = palette[0][c], b = palette[1][c];
        palette[2][c] = three ? (a + b + 1) / 2 : (2 * a + b + 1) / 3;
        palette[3][c] = three ? 0 : (a + 2 * b + 1) / 3;
    }
    if (three)
        palette[3][3] = 0;
    for (int i = 0; i < 16; i++) {
        const unsigned *colour = palette[block[4 + i / 4] >> (i % 4 * 2) & 3];
        for (int c = 0; c < 4; c++)
            rgba[4 * i + c] = (uint8_t)colour[c];
    }
}

/* Single values of 8 bytes: two ends, three bits a texel. Where the first end is the greater one,
 * six values lie between, else four, and 0 and 255. */
static void unpack_values(const uint8_t *block, uint8_t *out, int stride) {
    unsigned a = block[0], b = block[1], values[8] = {a, b};
    unsigned steps = a > b ? 7 : 5;
    for (unsigned i = 1; i < steps; i++)
        values[1 + i] = ((steps - i) * a + i * b + steps / 2) / steps;
    if (steps == 5) {
        values[6] = 0;
        values[7] = 255;
    }
    uint64_t bits = 0;
    for (int i = 0; i < 6; i++)
        bits |= (uint64_t)block[2 + i] << (8 * i);
    for (int i = 0; i < 16; i++)
        out[i * stride] = (uint8_t)values[bits >> (3 * i) & 7];
}

void plr_unpack_bc1(const uint8_t *block, uint8_t *rgba) {
    unpack_colours(block, true, rgba);
}

void plr_unpack_bc2(const uint8_t *block, uint8_t *rgba) {
    unpack_colours(block + 8, false, rgba);
    for (int i = 0; i < 16; i++)
        rgba[4 * i + 3] = (uint8_t)((block[i / 2] >> (i % 2 * 4) & 15) * 17);
}

void plr_unpack_bc3(const uint8_t *block, uint8_t *rgba) {
    unpack_colours(block + 8, false, rgba);
    unpack_values(block, rgba + 3, 4);
}

void plr_unpack_bc4(const uint8_t *block, uint8_t *l) {
    unpack_values(block, l, 1);
}

void plr_unpack_bc5(const uint8_t *block, uint8_t *rgb) {
    unpack_values(block, rgb, 3);
    unpack_values(block + 8, rgb + 1, 3);
    for (int i = 0; i < 16; i++)
        rgb[3 * i + 2] = 0;
}
