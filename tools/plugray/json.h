/* JSON output: strings escaped, numbers without regard to a locale, bytes that are no UTF-8
 * replaced. */
#ifndef PLUGRAY_TOOL_JSON_H
#define PLUGRAY_TOOL_JSON_H

#include <stdio.h>

#include <plugray/base.h>

/* A quoted string; NULL gives null. */
void json_string(FILE *out, const char *text);
/* A number; null if it is not finite. */
void json_number(FILE *out, double number);

/* Length of the UTF-8 sequence at `text`, 0 if it is none. */
size_t utf8_length(const char *text);

#endif
