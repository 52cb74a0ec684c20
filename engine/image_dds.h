/* Blocks of four by four texels, as DDS files pack them. */
#ifndef PLR_ENGINE_IMAGE_DDS_H
#define PLR_ENGINE_IMAGE_DDS_H

#include <stdint.h>

/* Each unpacks one block to 16 texels, row by row, of as many components as the name says. */
void plr_unpack_bc1(const uint8_t *block, uint8_t *rgba); /* DXT1: 8 bytes */
void plr_unpack_bc2(const uint8_t *block, uint8_t *rgba); /* DXT2, DXT3: 16 bytes */
void plr_unpack_bc3(const uint8_t *block, uint8_t *rgba); /* DXT4, DXT5: 16 bytes */
void plr_unpack_bc4(const uint8_t *block, uint8_t *l);    /* ATI1: 8 bytes */
void plr_unpack_bc5(const uint8_t *block, uint8_t *rgb);  /* ATI2: 16 bytes; blue is 0 */

#endif
