/* What a compiled shader does, read from its SPIR-V (the SPIR-V specification, section 3). Knows no
 * compiler. Whatever the words hold, nothing beyond them is read. */
#ifndef PLR_ENGINE_SPIRV_H
#define PLR_ENGINE_SPIRV_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Instructions and texture fetches in functions; what does no work is not counted. */
void plr_spirv_count(const uint32_t *words, size_t size, uint32_t *instructions, uint32_t *fetches);

typedef struct plr_spirv_fetch {
    uint32_t line;    /* of the text that was compiled, 0: not known */
    const char *name; /* of the variable that holds the sampler, in `words`; NULL: not known */
} plr_spirv_fetch;

/* The fetches, in order, in malloc'ed memory; NULL without any, or without memory. */
plr_spirv_fetch *plr_spirv_fetches(const uint32_t *words, size_t size, size_t *count);

#endif
