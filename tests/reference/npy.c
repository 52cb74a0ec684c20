/* Arrays in numpy's format, version 1.0. */
#include "reference.h"

#include <stdio.h>
#include <string.h>

bool ref_npy_write(const char *path, const double *values, const size_t *shape, int dimensions) {
    char header[256], text[160] = "";
    size_t count = 1;
    for (int i = 0; i < dimensions; i++) {
        size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, "%zu,", shape[i]);
        count *= shape[i];
    }
    int used = snprintf(header, sizeof header,
                        "{'descr': '<f8', 'fortran_order': False, 'shape': (%s), }", text);
    int padded = (10 + used + 1 + 63) / 64 * 64 - 10;
    memset(header + used, ' ', (size_t)(padded - used));
    header[padded - 1] = '\n';
    unsigned char start[10] = {0x93, 'N', 'U', 'M', 'P', 'Y', 1, 0};
    start[8] = (unsigned char)(padded & 255);
    start[9] = (unsigned char)(padded >> 8);
    FILE *file = fopen(path, "wb");
    if (!file)
        return false;
    bool fine = fwrite(start, 1, 10, file) == 10 &&
                fwrite(header, 1, (size_t)padded, file) == (size_t)padded &&
                fwrite(values, sizeof *values, count, file) == count;
    return fclose(file) == 0 && fine;
}
