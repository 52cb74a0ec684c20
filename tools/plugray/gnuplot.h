/* gnuplot, if it is installed: called without a shell, with its files in a folder of its own. */
#ifndef PLUGRAY_TOOL_GNUPLOT_H
#define PLUGRAY_TOOL_GNUPLOT_H

#include <stdbool.h>
#include <stdio.h>

#include <plugray/base.h>

typedef struct gnuplot {
    char *program, *folder;
    char **files; /* names in the folder */
    size_t file_count;
} gnuplot;

/* False with an error if it is not installed. */
bool gnuplot_find(plr_diags *diags);

/* Makes the folder. False with an error. */
bool gnuplot_begin(gnuplot *g, plr_diags *diags);
/* A file in the folder, to be written and closed; NULL with an error. */
FILE *gnuplot_file(gnuplot *g, const char *name, plr_diags *diags);
/* Runs the script of that name, in the folder, and returns what it wrote to `output` there; free
 * it. NULL with an error. */
char *gnuplot_run(gnuplot *g, const char *script, const char *output, size_t *length,
                  plr_diags *diags);
/* Removes the folder. */
void gnuplot_end(gnuplot *g);

/* Writes text as a string of gnuplot, in single quotes; controls and what is no UTF-8 become
 * question marks. */
void gnuplot_string(FILE *out, const char *text);

#endif
