/* SHA-256 (FIPS 180-4), for keys of the program cache. */
#ifndef PLR_ENGINE_SHA256_H
#define PLR_ENGINE_SHA256_H

#include <stddef.h>
#include <stdint.h>

enum {
    PLR_SHA256_SIZE = 32
};

typedef struct plr_sha256 {
    uint32_t state[8];
    uint64_t length; /* bytes so far */
    uint8_t block[64];
} plr_sha256;

void plr_sha256_start(plr_sha256 *hash);
void plr_sha256_add(plr_sha256 *hash, const void *data, size_t length);
void plr_sha256_finish(plr_sha256 *hash, uint8_t digest[PLR_SHA256_SIZE]);

#endif
