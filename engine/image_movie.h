/* The first picture of a movie. */
#ifndef PLR_ENGINE_IMAGE_MOVIE_H
#define PLR_ENGINE_IMAGE_MOVIE_H

#include "engine/image.h"

/* Whether a file looks like a movie: MP4, QuickTime, Matroska, WebM, AVI, Ogg, MPEG, FLV, ASF. */
bool plr_movie_is(const char *data, size_t length);
/* Fills the image, the bottom row first, and returns NULL, or says why it cannot. */
const char *plr_movie_decode(const char *data, size_t length, plr_image *image);

#endif
