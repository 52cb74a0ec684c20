/* How volumes are sampled, in words. */
#include <stdio.h>

#include "tools/plugray/info.h"
#include "tools/plugray/json.h"

void print_plan(const plr_view *view) {
    plr_plan plan;
    plr_view_get_plan(view, &plan);
    if (!plan.choice_count)
        return;
    puts("plan of volumes:");
    for (size_t i = 0; i < plan.choice_count; i++)
        printf("    %s: %s; %s\n", plan.choices[i].about, plan.choices[i].chosen,
               plan.choices[i].why);
}

void write_plan(const plr_view *view) {
    plr_plan plan;
    plr_view_get_plan(view, &plan);
    fputs("  \"plan\": [", stdout);
    for (size_t i = 0; i < plan.choice_count; i++) {
        printf("%s\n    {\"about\": ", i ? "," : "");
        json_string(stdout, plan.choices[i].about);
        fputs(", \"chosen\": ", stdout);
        json_string(stdout, plan.choices[i].chosen);
        fputs(", \"why\": ", stdout);
        json_string(stdout, plan.choices[i].why);
        putchar('}');
    }
    putchar(']');
}
