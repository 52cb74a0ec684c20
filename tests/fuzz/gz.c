/* Scenes packed with gzip: the packed bytes, always behind a header that is right. */
#include "scene.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const unsigned char header[] = {0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 3};
    size_t skipped = size >= 2 && data[0] == header[0] && data[1] == header[1] ? 0 : sizeof header;
    char *packed = malloc(skipped + size + 1);
    memcpy(packed, header, skipped);
    if (size)
        memcpy(packed + skipped, data, size);
    fuzz_scene(packed, skipped + size);
    free(packed);
    return 0;
}
