/* Numbers about the voxels of a volume, all of them exact: every voxel is looked at. No GL. */
#ifndef PLR_ENGINE_VOLUME_STATISTICS_H
#define PLR_ENGINE_VOLUME_STATISTICS_H

#include "engine/volume.h"

/* Of one component, in physical units. False without memory or such a component. */
bool plr_volume_get_statistics(const plr_volume *volume, uint32_t component,
                               plr_volume_statistics *statistics);

/* Percentiles by nearest rank: the least value that at least so many percent of the finite values
 * do not exceed; 0 gives the least of all. At most 16 at once. All 0 if no value is finite. */
bool plr_volume_get_percentiles(const plr_volume *volume, uint32_t component,
                                const double *percents, size_t count, double *values);

/* Counts of the finite values in `bins` bins of equal width from `first` on; what lies outside goes
 * to the nearest bin. */
void plr_volume_count_bins(const plr_volume *volume, uint32_t component, double first, double width,
                           uint64_t *counts, size_t bins);

/* The value that splits the values from `first` to `last` into two classes with the greatest
 * variance between them: N. Otsu, "A threshold selection method from gray-level histograms", IEEE
 * Transactions on Systems, Man, and Cybernetics 9 (1979), 62-66; in 256 bins. */
double plr_volume_threshold(const plr_volume *volume, uint32_t component, double first,
                            double last);

/* How many voxels have each number. */
typedef struct plr_label_count {
    uint32_t value;
    uint64_t voxels;
} plr_label_count;

enum {
    PLR_MAX_LABEL_COUNTS = 65536
};

/* The numbers of an image of labels (plr_volume_to_labels), ascending, in malloc'ed memory; NULL
 * without memory. `more`: there are others beyond the limit, which are not counted. */
plr_label_count *plr_image_count_labels(const plr_image *image, size_t *count, bool *more);

#endif
