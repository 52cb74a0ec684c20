#include "tools/plugray/pick.h"

#include "tools/plugray/json.h"

static void print_numbers(FILE *out, const char *name, const double *numbers, size_t count) {
    fprintf(out, "\"%s\": ", name);
    for (size_t i = 0; i < count; i++) {
        fputs(i ? ", " : "[", out);
        json_number(out, numbers[i]);
    }
    fputs(count ? "], " : "null, ", out);
}

/* The DEF name of a node, else its number. */
static void print_node(FILE *out, const plr_node *node, size_t index) {
    const char *def = node ? plr_node_def(node) : NULL;
    if (def)
        json_string(out, def);
    else if (node)
        fprintf(out, "%zu", index);
    else
        fputs("null", out);
}

void pick_print(FILE *out, const plr_pick *pick) {
    bool seen = pick->volume || pick->shape;
    fputs("{", out);
    print_numbers(out, "position", pick->position, seen ? 3 : 0);
    print_numbers(out, "value", pick->value, pick->components);
    print_numbers(out, "physical", pick->physical, pick->components);
    fputs("\"segment\": ", out);
    if (pick->has_segment)
        fprintf(out, "%u", (unsigned)pick->segment);
    else
        fputs("null", out);
    if (pick->label[0]) {
        fputs(", \"label\": ", out);
        json_string(out, pick->label);
    }
    if (pick->surface >= 0)
        fprintf(out, ", \"surface\": %d", pick->surface);
    fputs(", \"volume\": ", out);
    print_node(out, pick->volume, pick->volume_index);
    if (pick->shape) {
        fputs(", \"shape\": ", out);
        print_node(out, pick->shape, pick->shape_index);
    }
    fputs("}\n", out);
}
