/* Images of every format that is read. */
#include <stdlib.h>
#include <string.h>

#include "engine/image.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_image image;
    if (plr_image_decode((const char *)data, size, (plr_place){"input", 1, 1}, &image, diags))
        (void)plr_image_sample(&image, image.width - 1, image.height - 1, image.depth - 1,
                               image.components - 1);
    plr_image_free(&image);
    plr_diags_destroy(&diags);
    return 0;
}
