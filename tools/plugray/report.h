/* Diagnostics for people (text with the author's line and a caret) and for programs (JSON, SARIF).
 */
#ifndef PLUGRAY_TOOL_REPORT_H
#define PLUGRAY_TOOL_REPORT_H

#include <stdio.h>

#include <plugray/base.h>

/* What there is to say about one input, and how to get at the lines of its files. */
typedef struct tool_report {
    const plr_diags *diags;
    /* One line of a file, without its newline, or NULL; may be NULL itself. */
    const char *(*line)(const void *user, const char *file, uint32_t line, size_t *length);
    const void *user;
} tool_report;

void report_text(FILE *out, const tool_report *report);
/* An array of objects {file, line, column, severity, code, message, notes}. */
void report_json(FILE *out, const tool_report *reports, size_t count);
/* SARIF 2.1.0. */
void report_sarif(FILE *out, const tool_report *reports, size_t count);

/* The exit status that diagnostics call for; `strict`: warnings count as errors. */
int report_status(const plr_diags *diags, bool strict);

/* Line `line` (from 1) of a text. */
const char *text_line(const char *text, size_t size, uint32_t line, size_t *length);
/* A line of a file of plugray's own GLSL ("effects/..."). */
const char *own_line(const char *file, uint32_t line, size_t *length);

/* Text from files must not steer a terminal: controls, U+0080 to U+009F too, become blanks. */
void report_plain(FILE *out, const char *text, size_t length);

#endif
