/* glTF, as JSON and as GLB. */
#include "scene.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_scene((const char *)data, size);
    return 0;
}
