/* First frames of videos. */
#include "engine/image_movie.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    plr_image image = {0};
    if (plr_movie_is((const char *)data, size) &&
        !plr_movie_decode((const char *)data, size, &image))
        (void)plr_image_sample(&image, image.width - 1, image.height - 1, 0, image.components - 1);
    plr_image_free(&image);
    return 0;
}
