/* Info logs of compilers, and the limits of texts. */
#include <stdlib.h>
#include <string.h>

#include "engine/glsl_log.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = malloc(size + 1);
    plr_glsl_messages messages;
    if (!text)
        return 0;
    if (size)
        memcpy(text, data, size);
    text[size] = 0;
    plr_glsl_parse_log(text, &messages);
    plr_glsl_messages_sort(&messages);
    for (size_t i = 0; i < messages.count; i++)
        if (!messages.items[i].text[0] || strchr(messages.items[i].text, '\n'))
            abort();
    plr_glsl_check_limits(text, &messages);
    plr_glsl_messages_free(&messages);
    free(text);
    return 0;
}
