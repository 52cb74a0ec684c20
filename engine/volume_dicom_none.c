/* What stands for the library where this plugray was built without one. */
#include "engine/volume_dicom_file.h"

#include <stdio.h>

bool plr_dicom_is_built(void) {
    return false;
}

plr_dicom *plr_dicom_open(const char *set, size_t length, const char *syntax,
                          char fault[PLR_DICOM_FAULT]) {
    (void)set;
    (void)length;
    (void)syntax;
    snprintf(fault, PLR_DICOM_FAULT, "this plugray was built without DICOM");
    return NULL;
}

void plr_dicom_close(plr_dicom *file) {
    (void)file;
}

size_t plr_dicom_numbers(const plr_dicom *file, size_t frame, uint32_t group, uint32_t tag,
                         double *numbers, size_t count) {
    (void)file;
    (void)frame;
    (void)group;
    (void)tag;
    (void)numbers;
    (void)count;
    return 0;
}

void plr_dicom_text(const plr_dicom *file, uint32_t tag, char *text, size_t size) {
    (void)file;
    (void)tag;
    if (size)
        *text = '\0';
}

bool plr_dicom_has(const plr_dicom *file, uint32_t tag) {
    (void)file;
    (void)tag;
    return false;
}

bool plr_dicom_frame(plr_dicom *file, size_t frame, void *out, size_t size, char photometric[32],
                     char fault[PLR_DICOM_FAULT]) {
    (void)file;
    (void)frame;
    (void)out;
    (void)size;
    (void)photometric;
    (void)fault;
    return false;
}
