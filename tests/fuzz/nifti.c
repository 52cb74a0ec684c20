/* NIfTI files, single and in pairs, gzipped ones too. */
#include "volume.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_volume(data, size);
    return 0;
}
