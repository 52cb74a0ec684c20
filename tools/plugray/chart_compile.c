/* What programs took to be made ready: a text is compiled once, whoever needs it again. */
#include <math.h>
#include <stdlib.h>

#include "tools/plugray/chart.h"
#include "tools/plugray/files.h"

/* FNV-1a (Fowler, Noll, Vo). */
static uint64_t hash_more(uint64_t hash, const char *text, size_t length) {
    for (size_t i = 0; i < length; i++)
        hash = (hash ^ (unsigned char)text[i]) * 1099511628211u;
    return hash;
}

/* Of all that the view draws. */
static uint64_t hash_view(const plr_view *view) {
    uint64_t hash = 14695981039346656037u;
    plr_drawable drawable;
    for (size_t i = 0; plr_view_drawable(view, i, &drawable); i++) {
        size_t length = 0;
        const char *text = drawable.program
                               ? plr_program_text(drawable.program->program, PLR_FRAGMENT, &length)
                               : NULL;
        if (text)
            hash = hash_more(hash, text, length);
    }
    return hash;
}

double chart_compile_time(chart_compiled *compiled, const plr_view *view, double first_draw_ms,
                          double draw_ms) {
    uint64_t hash = hash_view(view);
    for (size_t i = 0; i < compiled->count; i++)
        if (compiled->items[i].hash == hash)
            return compiled->items[i].cpu_ms;
    plr_view_stats stats;
    plr_view_get_stats(view, &stats);
    double cpu_ms = stats.link.cpu_ms + stats.compile.cpu_ms + fmax(first_draw_ms - draw_ms, 0);
    compiled->items = memory_array(compiled->items, compiled->count + 1, sizeof *compiled->items);
    compiled->items[compiled->count++] = (chart_compiled_view){hash, cpu_ms};
    return cpu_ms;
}
