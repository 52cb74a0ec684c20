#ifndef PLUGRAY_TOOL_MEDIAN_H
#define PLUGRAY_TOOL_MEDIAN_H

#include <stddef.h>

/* Sorts; 0 of none. */
double median(double *values, size_t count);

#endif
