#include <plugray/base.h>

plr_place plr_origin_place(const plr_origin *origin, const char *text, size_t offset) {
    plr_place place = {origin->file, origin->line ? origin->line : 1,
                       origin->column ? origin->column : 1};
    size_t next = 0;
    for (size_t i = 0;; i++) {
        while (next < origin->break_count && origin->breaks[next].offset <= i) {
            place.line = origin->breaks[next].line;
            place.column = origin->breaks[next].column;
            next++;
        }
        if (i >= offset)
            return place;
        if (text[i] == '\n') {
            place.line++;
            place.column = 1;
        } else {
            place.column++;
        }
    }
}
