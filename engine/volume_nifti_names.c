/* The NIfTI reader: names of segments in what stands between header and voxels. */
#include "engine/volume_internal.h"

#include <string.h>

/* Up to the first 0. */
static bool read_text(const char *text, size_t length, plr_labels *labels) {
    const char *end = memchr(text, '\0', length);
    return plr_labels_read(labels, text, end ? (size_t)(end - text) : length, NULL, NULL);
}

static int32_t read_integer(const char *data, bool swapped) {
    int32_t value;
    memcpy(&value, data, sizeof value);
    if (swapped)
        plr_swap_bytes(&value, 1, sizeof value);
    return value;
}

/* The comments of nifti1.h: four bytes, the first of which says whether extensions follow; each has
 * its size (a multiple of 16, with these 8 bytes) and a code. Some atlases write plain text there
 * and no size. The first that is a list of labels counts. */
void plr_nifti_read_labels(const char *data, size_t start, size_t end, bool swapped,
                           plr_labels *labels) {
    if (end < 4 || start > end - 4)
        return;
    bool extended = data[start] != 0;
    start += 4;
    if (!extended) {
        read_text(data + start, end - start, labels);
        return;
    }
    while (end - start > 8) {
        int32_t size = read_integer(data + start, swapped);
        if (size < 9 || (size_t)size > end - start ||
            read_text(data + start + 8, (size_t)size - 8, labels))
            return;
        start += (size_t)size;
    }
}
