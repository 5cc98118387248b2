#include "study/extremes_chart.h"

#include "base/transcendental.h"
#include "io/chart.h"

#include <math.h>
#include <stdio.h>

/* How far the law's line goes beyond the duration that is asked. */
#define BEYOND 3.0
enum { CHART_WIDTH = 900, CHART_HEIGHT = 420 };
#define HOUR 3600.0
#define YEAR 31557600.0 /* 365.25 days */

chart extremes_chart_make(const extreme_result *r, const char *quantity, double factor, double duration,
                          extremes_plot *room)
{
    double from = HUGE_VAL, to = BEYOND * duration, unit = duration < YEAR ? HOUR : YEAR;
    for (int32_t i = 0; i < r->points; i++) {
        room->period[i] = r->point[i].period / unit;
        room->level[i] = factor * r->point[i].level;
        from = fmin(from, r->point[i].period);
        to = fmax(to, r->point[i].period);
    }
    for (int i = 0; i < EXTREMES_LAW_POINTS; i++) {
        double period = from * real_pow(to / from, i / (EXTREMES_LAW_POINTS - 1.0));
        room->law_period[i] = period / unit;
        room->law_level[i] = factor * extreme_level_of_period(r, period);
    }
    room->at[0] = room->at[1] = duration / unit;
    room->interval[0] = factor * r->most_probable.low;
    room->interval[1] = factor * r->most_probable.high;
    room->most_probable[0] = factor * r->most_probable.level;
    room->lines[0] = chart_line_make("law", room->law_period, room->law_level, EXTREMES_LAW_POINTS, true);
    room->lines[1] = chart_line_make("data", room->period, room->level, r->points, false);
    room->lines[1].style = CHART_POINTS;
    room->lines[2] = chart_line_make("most probable, with its interval", room->at, room->interval, 2, true);
    room->lines[3] = chart_line_make("", room->at, room->most_probable, 1, false);
    room->lines[3].style = CHART_POINTS;
    room->lines[3].colour = 3; /* that of its interval */
    snprintf(room->title, sizeof room->title, "%s, %d %s", extreme_method_name(r->method), (int)r->sample,
             r->block > 0       ? "maxima"
             : r->law.scale > 0 ? "peaks"
                                : "exceedances");
    chart c = chart_make(room->title, "",
                         unit < YEAR ? "mean time between exceedances [h]" : "mean time between exceedances [a]",
                         quantity, room->lines, EXTREMES_PLOT_LINES);
    c.log_x = true;
    c.free_y = true;
    return c;
}

fram_status extremes_chart_write(context *ctx, const extreme_result *results, int32_t count, const char *quantity,
                                 double duration, const char *path, fram_error *error)
{
    chart charts[EXTREME_METHODS];
    int32_t drawn = 0;
    extremes_plot *p = memory_array(ctx, EXTREME_METHODS, sizeof *p);
    if (!p)
        return error_memory(error);
    for (int32_t i = 0; i < count && drawn < EXTREME_METHODS; i++) {
        if (results[i].answered && results[i].points > 0) {
            charts[drawn] = extremes_chart_make(&results[i], quantity, 1, duration, &p[drawn]);
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
