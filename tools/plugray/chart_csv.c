/* The chart as a table: docs/charts.md says what the columns are. */
#include "tools/plugray/chart.h"

/* A number without regard to a locale; nothing if it is not known. */
static void put_number(FILE *out, bool known, double value) {
    putc(',', out);
    if (known)
        fprintf(out, "%.9g", value);
}

static const char *kind_of(const chart_point *point) {
    if (point->method->knob == KNOB_STEP)
        return "fixed";
    return point->plan.bounded ? "bounded" : "estimated";
}

static void put_point(FILE *out, const chart_point *point) {
    fputs(point->method->name, out);
    put_number(out, true, point->knob);
    put_number(out, true, point->cpu_ms);
    put_number(out, true, point->wall_ms);
    put_number(out, point->gpu_ms > 0, point->gpu_ms);
    put_number(out, true, point->error.rmse);
    put_number(out, true, point->error.max);
    fprintf(out, ",%s", kind_of(point));
    put_number(out, point->plan.value >= 0, point->plan.value);
    fprintf(out, ",%d,%d", point->pareto, point->chosen);
    put_number(out, true, point->compile_ms);
    putc('\n', out);
}

void chart_csv(FILE *out, const chart_job *job) {
    const chart_reference *reference = &job->reference;
    fputs("method,knob,cpu_ms,wall_ms,gpu_ms,rmse,max,kind,bound,pareto,chosen,compile_ms\n", out);
    for (size_t i = 0; i < job->points.count; i++)
        put_point(out, &job->points.items[i]);
    fputs("reference", out);
    put_number(out, true, reference->step);
    put_number(out, true, reference->draw.cpu_ms);
    put_number(out, true, reference->draw.wall_ms);
    put_number(out, false, 0);
    put_number(out, true, reference->bar.rmse);
    put_number(out, true, reference->bar.max);
    fputs(",extrapolated,,0,0,\n", out);
}
