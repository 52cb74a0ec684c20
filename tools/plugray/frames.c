#include "tools/plugray/frames.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/plugray/files.h"

enum {
    MAX_FRAMES = 1000000,
    MAX_DIGITS = 9
};

bool frames_read(const tool_arguments *arguments, frame_plan *plan) {
    *plan = (frame_plan){.start = plan->start, .rate = 25};
    if (option_value(arguments, OPTION_FPS) && !option_value(arguments, OPTION_FRAMES)) {
        usage_error(arguments, "--fps goes with --frames");
        return false;
    }
    return option_integer(arguments, OPTION_FRAMES, 1, MAX_FRAMES, &plan->count) &&
           option_number(arguments, OPTION_FPS, 0, 1e6, &plan->rate);
}

double frames_time(const frame_plan *plan, long index) {
    return plan->start + (double)index / plan->rate;
}

/* "%d" or "%04d"; how many characters it has, 0: it is none. */
static size_t number_length(const char *text, int *digits) {
    size_t length = 1 + strspn(text + 1, "0123456789");
    if (text[length] != 'd' || length > 3)
        return 0;
    *digits = atoi(text + 1);
    return *digits > MAX_DIGITS ? 0 : length + 1;
}

char *frames_path(const frame_plan *plan, const char *path, long index) {
    if (!plan->count)
        return text_format("%s", path);
    int digits = 0;
    for (const char *at = path; (at = strchr(at, '%')); at++) {
        size_t length = number_length(at, &digits);
        if (length)
            return text_format("%.*s%0*ld%s", (int)(at - path), path, digits, index + 1,
                               at + length);
    }
    const char *ending = strrchr(path, '.');
    return text_format("%.*s-%04ld%s", (int)(ending - path), path, index + 1, ending);
}
