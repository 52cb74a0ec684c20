/* A transfer function to start with, from the values of a volume. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tools/plugray/info.h"

/* How the knots follow from the data. What lies below the threshold (Otsu's, of the values between
 * the percentiles 0.1 and 99.9) is background and transparent. What lies above is the object: from
 * nothing at the threshold, the opacity grows to its median, then to its 99th percentile, and
 * stays. The opacities follow from how long a path through the object is, taken as a cube of as
 * many voxels: along it, material at the median lets THROUGH_MEDIAN of the light through, material
 * at the 99th percentile THROUGH_HIGH. So a large volume is not a wall, and a small one not a veil.
 */
#define THROUGH_MEDIAN 0.35
#define THROUGH_HIGH 1e-5
#define LEAST_OPACITY (2 / 255.0) /* what 8 bits still tell apart */
#define MOST_OPACITY 0.8

static double opacity_per_voxel(double through, double voxels) {
    double opacity = 1 - pow(through, 1 / fmax(voxels, 1));
    return fmin(fmax(opacity, LEAST_OPACITY), MOST_OPACITY);
}

static void add_knot(transfer *t, double value, const double color[3], double opacity) {
    if (t->count && !(value > t->knots[t->count - 1].value))
        return;
    transfer_knot *knot = &t->knots[t->count++];
    knot->value = value;
    memcpy(knot->color, color, sizeof knot->color);
    knot->opacity = opacity;
}

/* Values above the threshold, and which percentile of all values it is. */
static double share_above(const plr_volume *volume, double threshold, uint64_t finite,
                          uint64_t *above) {
    uint64_t counts[2];
    /* two bins that meet at the threshold; what lies beyond them belongs to them */
    double width = fmax(fabs(threshold), 1);
    plr_volume_count_bins(volume, 0, threshold - width, width, counts, 2);
    *above = counts[1];
    return 100 * (double)counts[0] / (double)finite;
}

/* Values that are counted as object: their threshold, median and 99th percentile, and the opacities
 * of the latter two. False where there are none. */
typedef struct object {
    double threshold, median, high, soft, hard;
} object;

static bool find_object(const plr_volume *volume, uint64_t finite, double low, double high,
                        object *o) {
    uint64_t above;
    double values[2];
    o->threshold = plr_volume_threshold(volume, 0, low, high);
    double below = share_above(volume, o->threshold, finite, &above);
    const double percents[2] = {below + (100 - below) * 0.5, below + (100 - below) * 0.99};
    if (!above || !plr_volume_get_percentiles(volume, 0, percents, 2, values))
        return false;
    double path = cbrt((double)above);
    o->median = values[0];
    o->high = values[1];
    o->soft = opacity_per_voxel(THROUGH_MEDIAN, path);
    o->hard = opacity_per_voxel(THROUGH_HIGH, path);
    return true;
}

/* In warm colours, from its threshold to the end of the range. */
static void add_object(transfer *t, const object *o) {
    static const double dark[3] = {0.35, 0.1, 0.05}, middle[3] = {0.85, 0.5, 0.35},
                        bright[3] = {1, 0.95, 0.85};
    add_knot(t, o->threshold, dark, 0);
    add_knot(t, o->median, middle, o->soft);
    add_knot(t, o->high, bright, o->hard);
    add_knot(t, fmax(t->range[1], o->high), bright, t->knots[t->count - 1].opacity);
}

/* The same for negative values, in cold colours. */
static void add_negative(transfer *t, const object *o) {
    static const double dark[3] = {0.05, 0.1, 0.35}, middle[3] = {0.35, 0.5, 0.85},
                        bright[3] = {0.85, 0.95, 1};
    add_knot(t, fmin(t->range[0], -o->high), bright, o->high > o->median ? o->hard : o->soft);
    add_knot(t, -o->high, bright, o->hard);
    add_knot(t, -o->median, middle, o->soft);
    add_knot(t, -o->threshold, dark, 0);
}

/* Values that gather around zero and go as far below it as above it: an orbital, a difference. */
static bool is_signed(const double percentiles[PLR_PERCENTILE_COUNT]) {
    enum {
        LEAST = 0,
        FIVE = 2,
        NINETY_FIVE = 6,
        MOST = 8
    };
    double low = -percentiles[LEAST], high = percentiles[MOST];
    double near = fmax(fabs(percentiles[FIVE]), fabs(percentiles[NINETY_FIVE]));
    return low > 0.4 * high && high > 0.4 * low && near < 0.25 * fmin(low, high);
}

transfer transfer_to_start_with(const plr_volume *volume, const plr_volume_statistics *statistics,
                                const double range[2]) {
    transfer t = {.range = {range[0], range[1]}};
    const double *percentiles = statistics->percentiles;
    double low = percentiles[0], high = percentiles[PLR_PERCENTILE_COUNT - 1];
    bool both = is_signed(percentiles);
    object o;
    if (!(low < high)) {
        low = statistics->minimum;
        high = statistics->maximum;
    }
    if (!(low < high) || !(range[0] < range[1]) || !isfinite(high - low) ||
        !find_object(volume, statistics->finite, both ? 0 : low, high, &o))
        return t;
    if (both)
        add_negative(&t, &o);
    else
        add_knot(&t, fmin(range[0], o.threshold), (const double[3]){0.35, 0.1, 0.05}, 0);
    add_object(&t, &o);
    return t;
}

/* ---- X3D ---- */

static uint32_t byte_of(double value) {
    return (uint32_t)lround(fmin(fmax(value, 0), 1) * 255);
}

/* RGBA of the function at a value, as a number of SFImage. */
static uint32_t texel_at(const transfer *t, double value) {
    size_t k = 0;
    while (k + 2 < t->count && value > t->knots[k + 1].value)
        k++;
    const transfer_knot *a = &t->knots[k], *b = &t->knots[k + 1 < t->count ? k + 1 : k];
    double share = b->value > a->value ? (value - a->value) / (b->value - a->value) : 0;
    share = fmin(fmax(share, 0), 1);
    uint32_t texel = 0;
    for (int i = 0; i < 3; i++)
        texel = texel << 8 | byte_of(a->color[i] + share * (b->color[i] - a->color[i]));
    double opacity = a->opacity + share * (b->opacity - a->opacity);
    /* a little is not nothing */
    return texel << 8 | (opacity > 0 ? (uint32_t)fmax(byte_of(opacity), 1) : 0);
}

static void print_texels(FILE *out, const transfer *t, const char *indent) {
    for (int i = 0; i < TRANSFER_TEXELS; i++) {
        double share = (double)i / (TRANSFER_TEXELS - 1);
        double value = t->range[0] * (1 - share) + t->range[1] * share;
        if (i % 8 == 0)
            fprintf(out, "\n%s   ", indent);
        fprintf(out, " 0x%08X", (unsigned)texel_at(t, value));
    }
}

void print_transfer(FILE *out, const transfer *t, bool xml, const char *indent) {
    fprintf(out, "%s%s", indent,
            xml ? "<OpacityMapVolumeStyle containerField='renderStyle'>\n"
                : "OpacityMapVolumeStyle {\n");
    fprintf(out, "%s  %s%d 1 4", indent,
            xml ? "<PixelTexture containerField='transferFunction' image='"
                : "transferFunction PixelTexture { image ",
            TRANSFER_TEXELS);
    print_texels(out, t, indent);
    fprintf(out, "%s\n%s%s\n", xml ? "'/>" : " }", indent, xml ? "</OpacityMapVolumeStyle>" : "}");
}
