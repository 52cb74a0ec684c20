/* Names of files by number. */
#include "engine/volume_node.h"

#include <stdio.h>
#include <string.h>

bool plr_pattern_expand(const char *pattern, size_t length, int64_t number, char *name,
                        size_t size) {
    const char *end = pattern + length;
    size_t used = 0, numbers = 0;
    while (pattern < end && used + 48 < size) {
        char c = *pattern++;
        if (c != '%') {
            name[used++] = c;
            continue;
        }
        if (pattern < end && *pattern == '%') {
            name[used++] = *pattern++;
            continue;
        }
        bool zero = pattern < end && *pattern == '0';
        int digits = 0;
        while (pattern < end && *pattern >= '0' && *pattern <= '9' && digits < 32)
            digits = digits * 10 + (*pattern++ - '0');
        if (pattern == end || !strchr("diu", *pattern++) || digits > 32 || numbers++)
            return false;
        used += (size_t)snprintf(name + used, size - used, zero ? "%0*lld" : "%*lld", digits,
                                 (long long)number);
    }
    name[used] = '\0';
    return numbers == 1 && pattern == end;
}

/* The integer at the end of the text and the blanks before it, taken off. */
static bool take_last(const char *text, size_t *length, int64_t *number) {
    size_t end = *length, start;
    while (end && text[end - 1] == ' ')
        end--;
    start = end;
    while (start && text[start - 1] >= '0' && text[start - 1] <= '9')
        start--;
    bool negative = start && text[start - 1] == '-';
    if (start == end || end - start > 10)
        return false;
    *number = 0;
    for (size_t i = start; i < end; i++)
        *number = *number * 10 + (text[i] - '0');
    *number = negative ? -*number : *number;
    start -= negative;
    if (!start || text[start - 1] != ' ')
        return false;
    while (start && text[start - 1] == ' ')
        start--;
    *length = start;
    return start > 0;
}

bool plr_file_pattern_parse(plr_file_pattern *pattern, const char *text, size_t length) {
    int64_t numbers[3] = {0, 0, 1};
    size_t rest = length;
    int count = 0;
    char name[4096];
    if (length >= sizeof name || !memchr(text, '%', length))
        return false;
    while (count < 3 && take_last(text, &rest, &numbers[2 - count]))
        count++;
    if (count == 2) { /* without a step */
        numbers[0] = numbers[1];
        numbers[1] = numbers[2];
        numbers[2] = numbers[1] < numbers[0] ? -1 : 1;
    }
    int64_t first = numbers[0], last = numbers[1], step = numbers[2];
    if (count < 2 || step == 0 || (last - first) / step < 0 ||
        !plr_pattern_expand(text, rest, first, name, sizeof name))
        return false;
    *pattern = (plr_file_pattern){text, rest, first, step, (size_t)((last - first) / step) + 1};
    return true;
}
