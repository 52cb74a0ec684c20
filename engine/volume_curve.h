/* How much a function of the value changes over any range of values, found in a few looks. */
#ifndef PLR_ENGINE_VOLUME_CURVE_H
#define PLR_ENGINE_VOLUME_CURVE_H

#include <stddef.h>
#include <stdint.h>

enum {
    PLR_CURVE_SCALES = 8 /* so many parts of values are looked at beside one another */
};

/* Extinction, or a channel of colour, as a transfer function gives it. */
typedef struct plr_curve plr_curve;

typedef struct plr_curve_desc {
    const float *texels; /* straight RGBA, interpolated linearly over the values 0 to 1 */
    uint32_t count;
    int channel;      /* 3: extinction */
    double reference; /* opacities, which are below 1, are those of this length */
    double low, high; /* values that matter, from 0 to 1 */
    double reach;     /* what matters is a little more or less than a value: so much */
} plr_curve_desc;

/* The same everywhere between two values. */
typedef struct plr_curve_part {
    double low, high; /* of the function */
    double steepest;  /* its slope, whatever the sign */
    double turns;     /* the greatest less the least slope */
} plr_curve_part;

/* NULL without memory. */
plr_curve *plr_curve_make(const plr_curve_desc *desc);
void plr_curve_free(plr_curve *curve);

plr_curve_part plr_curve_between(const plr_curve *curve, double low, double high);

/* The integral over u, from 0 to `reach`, of (reach - u) times how far slopes of values are apart
 * at most that are within u of each other and between low and high. */
double plr_curve_bend(const plr_curve *curve, double low, double high, double reach);

#endif
