/* The boundary to the library that knows the elements of DICOM: plain C on this side, C++ on the
 * other. Built without a library, nothing can be opened. */
#ifndef PLR_ENGINE_VOLUME_DICOM_FILE_H
#define PLR_ENGINE_VOLUME_DICOM_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct plr_dicom plr_dicom;

enum {
    PLR_DICOM_FAULT = 160 /* characters of a message, its NUL included */
};

/* Whether this build has a library. */
bool plr_dicom_is_built(void);

/* Reads a data set of a transfer syntax (a UID) that plr_dicom_scan found sound: all of it, or what
 * comes before the pixel data. The bytes are copied. NULL with a fault. */
plr_dicom *plr_dicom_open(const char *set, size_t length, const char *syntax,
                          char fault[PLR_DICOM_FAULT]);
void plr_dicom_close(plr_dicom *file);

/* Tags are 0xGGGGEEEE. A tag of one frame is looked for in the functional group `group` (the tag of
 * its sequence) of that frame, then in that of all frames, then in the data set (PS3.3, C.7.6.16);
 * `group` 0: in the data set alone. */

/* Reads up to `count` numbers; returns how many there are. */
size_t plr_dicom_numbers(const plr_dicom *file, size_t frame, uint32_t group, uint32_t tag,
                         double *numbers, size_t count);
/* The first value as text without blanks around it, cut to `size`; "" without. */
void plr_dicom_text(const plr_dicom *file, uint32_t tag, char *text, size_t size);
bool plr_dicom_has(const plr_dicom *file, uint32_t tag);

/* Unpacks a frame of JPEG or the like in native byte order, colours as PlanarConfiguration says:
 * `size` bytes; there must be room for one more where that is odd. Quickest in order of frames.
 * `photometric` becomes that of what was unpacked. */
bool plr_dicom_frame(plr_dicom *file, size_t frame, void *out, size_t size, char photometric[32],
                     char fault[PLR_DICOM_FAULT]);

#ifdef __cplusplus
}
#endif

#endif
