/* The plugs that plugray's own shaders offer. */
#ifndef PLUGRAY_TOOL_PLUGS_OWN_H
#define PLUGRAY_TOOL_PLUGS_OWN_H

/* All on standard output. Who offers them, shader by shader; returns an exit status. */
int print_own_plugs(void);
/* What plugs.def tells of them: as a JSON array; as the tables of docs/plugs.md. */
void write_own_plugs(void);
void write_own_tables(void);

#endif
