#include "study/extremes_chart.h"

#include "base/transcendental.h"
#include "io/chart.h"

#include <math.h>
#include <stdio.h>

/* Points of the law's line, and how far it goes beyond the duration that is asked. */
enum { LAW_POINTS = 64 };
#define BEYOND 3.0
enum { CHART_WIDTH = 900, CHART_HEIGHT = 420 };
#define HOUR 3600.0
#define YEAR 31557600.0 /* 365.25 days */

typedef struct plotted {
    double period[EXTREME_POINTS_MOST], level[EXTREME_POINTS_MOST];
    double law_period[LAW_POINTS], law_level[LAW_POINTS];
    double at[2], interval[2], most_probable[1];
    chart_line lines[4];
    char title[200];
} plotted;

static chart chart_of(const extreme_result *r, const char *quantity, double duration, plotted *p)
{
    double from = HUGE_VAL, to = BEYOND * duration, unit = duration < YEAR ? HOUR : YEAR;
    for (int32_t i = 0; i < r->points; i++) {
        p->period[i] = r->point[i].period / unit;
        p->level[i] = r->point[i].level;
        from = fmin(from, r->point[i].period);
        to = fmax(to, r->point[i].period);
    }
    for (int i = 0; i < LAW_POINTS; i++) {
        double period = from * real_pow(to / from, i / (LAW_POINTS - 1.0));
        p->law_period[i] = period / unit;
        p->law_level[i] = extreme_level_of_period(r, period);
    }
    p->at[0] = p->at[1] = duration / unit;
    p->interval[0] = r->most_probable.low;
    p->interval[1] = r->most_probable.high;
    p->most_probable[0] = r->most_probable.level;
    p->lines[0] = chart_line_make("law", p->law_period, p->law_level, LAW_POINTS, true);
    p->lines[1] = chart_line_make("data", p->period, p->level, r->points, false);
    p->lines[1].style = CHART_POINTS;
    p->lines[2] = chart_line_make("most probable, with its interval", p->at, p->interval, 2, true);
    p->lines[3] = chart_line_make("", p->at, p->most_probable, 1, false);
    p->lines[3].style = CHART_POINTS;
    p->lines[3].colour = 3; /* that of its interval */
    snprintf(p->title, sizeof p->title, "%s, %d %s", extreme_method_name(r->method), (int)r->sample,
             r->block > 0       ? "maxima"
             : r->law.scale > 0 ? "peaks"
                                : "exceedances");
    chart c = chart_make(p->title, "",
                         unit < YEAR ? "mean time between exceedances [h]" : "mean time between exceedances [a]",
                         quantity, p->lines, 4);
    c.log_x = true;
    c.free_y = true;
    return c;
}

fram_status extremes_chart_write(context *ctx, const extreme_result *results, int32_t count, const char *quantity,
                                 double duration, const char *path, fram_error *error)
{
    chart charts[EXTREME_METHODS];
    int32_t drawn = 0;
    plotted *p = memory_array(ctx, EXTREME_METHODS, sizeof *p);
    if (!p)
        return error_memory(error);
    for (int32_t i = 0; i < count && drawn < EXTREME_METHODS; i++) {
        if (results[i].answered && results[i].points > 0) {
            charts[drawn] = chart_of(&results[i], quantity, duration, &p[drawn]);
            drawn++;
        }
    }
    fram_status status = drawn == 0
                             ? error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                                         "no method has an answer to draw; without the drawing the reasons are told")
                             : chart_stack_write(ctx, charts, drawn, path, CHART_WIDTH, CHART_HEIGHT, error);
    memory_free(ctx, p);
    return status;
}
