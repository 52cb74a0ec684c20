/* NRRD files, attached and detached. */
#include "volume.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (plr_volume_sniff((const char *)data, size) == PLR_VOLUME_NRRD)
        fuzz_volume(data, size);
    return 0;
}
