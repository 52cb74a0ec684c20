/* How fast errors of the midpoint rule can grow along rays through each block of a volume. */
#ifndef PLR_ENGINE_VOLUME_RATES_H
#define PLR_ENGINE_VOLUME_RATES_H

#include "engine/volume_certain.h"
#include "engine/volume_curve.h"

enum {
    PLR_CHANNELS = 3 /* of colour */
};

/* What all volumes together have. */
typedef struct plr_rates_all {
    double most;                                  /* extinction */
    double strays;                                /* extinction in a step from that of its sample */
    double low[PLR_CHANNELS], high[PLR_CHANNELS]; /* colours */
    bool many;
} plr_rates_all;

/* What is known in a step that has to do with a block. */
typedef struct plr_rates_block {
    double low, high; /* values */
    double near[2];   /* those within half a step of a place in the block */
    double slope;     /* of values */
    double even;      /* mean of values less the sample's, at most, but for jumps of the slope */
    double jumps;     /* what these add, but at the outermost voxels */
    double ends;      /* and there, too */
} plr_rates_block;

/* Along rays, of a function of the value. Rates are per unit of length, for each block. */
typedef struct plr_rate {
    float *even;  /* without jumps of the slope of values from cell to cell */
    float *whole; /* with them, but for those at the outermost voxels */
    float *full;  /* with these, too */
    float *steep; /* the greatest slope of the function, to which jumps are in proportion */
} plr_rate;

/* A volume and steps of some length. */
typedef struct plr_rates {
    const plr_certain *v;
    double step;
    uint32_t around[3]; /* blocks, as far as a step reaches */
    uint32_t blocks[3]; /* 1 each where steps reach from end to end */
    size_t count;
    plr_rates_block *known;
    float *found[PLR_BENDS];
    plr_curve *curves[PLR_CHANNELS + 1];
    plr_rate optical;              /* of extinction */
    float *least, *most;           /* extinction */
    plr_rate colors[PLR_CHANNELS]; /* as they are seen */
    float *odd[PLR_CHANNELS];      /* what is of the second order */
    double strays;                 /* extinction in a step from that of its sample */
    float *numbers;                /* of all these */
} plr_rates;

/* Of what is added up along the three axes at right angles. */
double plr_rates_length(const double v[3]);
/* False without memory. Finish it all the same. */
bool plr_rates_begin(plr_rates *r, const plr_certain *v, double step);
void plr_rates_fill(plr_rates *r, const plr_rates_all *all);
void plr_rates_finish(plr_rates *r);

#endif
