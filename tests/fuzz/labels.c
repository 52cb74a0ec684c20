/* Text beside volumes: names and colours of segments. */
#include <stdlib.h>
#include <string.h>

#include "engine/volume_internal.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_labels labels = {0};
    char *exact = malloc(size ? size : 1);
    if (size)
        memcpy(exact, data, size);
    plr_labels_read(&labels, exact, size, "labels.txt", diags);
    for (size_t i = 0; i < labels.count; i++)
        if (plr_labels_find(&labels, labels.items[i].value) != &labels.items[i] ||
            strlen(labels.items[i].name) > 255)
            abort();
    plr_labels_free(&labels);
    free(exact);
    plr_diags_destroy(&diags);
    return 0;
}
