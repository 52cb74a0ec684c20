/* One line about work that takes over a second, where standard error is a terminal. */
#ifndef PLUGRAY_TOOL_PROGRESS_H
#define PLUGRAY_TOOL_PROGRESS_H

/* What goes on from now on; NULL: nothing, and the line is taken away (before anything is printed).
 */
void progress(const char *phase);
/* How much of the work is done, 0 to 1: shown as a bar until the phases are over. */
void progress_part(double done);
/* How far the phase is with the file `name`, 0 to 1; a plr_file_rules.progress. */
void progress_of_file(void *unused, const char *name, double done);

#endif
