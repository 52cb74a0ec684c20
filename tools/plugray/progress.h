/* One line about work that takes over a second, where standard error is a terminal. */
#ifndef PLUGRAY_TOOL_PROGRESS_H
#define PLUGRAY_TOOL_PROGRESS_H

/* What goes on from now on; NULL: nothing, and the line is taken away (before anything is printed).
 */
void progress(const char *phase);

#endif
