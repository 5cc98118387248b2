#include "study/extremes_chart.h"

#include "base/transcendental.h"
#include "io/chart.h"

#include <math.h>
#include <stdio.h>

/* How far the law's line goes beyond the duration that is asked. */
#define BEYOND 3.0
enum { CHART_WIDTH = 900, CHART_HEIGHT = 420 };
#define YEAR 31557600.0 /* 365.25 days */

chart extremes_chart_make(const extreme_result *r, const char *quantity, double factor, double duration,
                          extremes_plot *room)
{
    double from = HUGE_VAL, to = BEYOND * duration, unit = duration < YEAR ? EXTREME_HOUR : YEAR;
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

enum { STABILITY_CHARTS = 2, STABILITY_LINES = 3 };
typedef struct stability_plot {
    double threshold[STABILITY_MOST], value[STABILITY_CHARTS][STABILITY_MOST];
    double bar_x[3 * STABILITY_MOST], bar_y[3 * STABILITY_MOST];
    double taken[2], taken_y[STABILITY_CHARTS][2];
    chart_line lines[STABILITY_CHARTS][STABILITY_LINES];
    char across[200], scale[200];
} stability_plot;

/* Where the answer's own threshold lies, from the least to the greatest of what is shown. */
static chart_line taken_line(const extreme_result *r, const double *low, const double *high, int32_t count,
                             stability_plot *room, int c)
{
    double *of = room->taken_y[c];
    room->taken[0] = room->taken[1] = r->threshold;
    of[0] = HUGE_VAL;
    of[1] = -HUGE_VAL;
    for (int32_t i = 0; i < count; i++) {
        of[0] = fmin(of[0], low[i]);
        of[1] = fmax(of[1], high[i]);
    }
    return chart_line_make("threshold of the answer", room->taken, of, 2, false);
}

/* Threshold stability of an answer by peaks over a threshold (Coles 2001, section 4.3.1): the shape with 95 %
   intervals, and the scale less shape x threshold, over the threshold.  From the threshold on from which the law holds,
   both stay the same within their scatter.  Points into `room` and the result.  false: fewer than two thresholds. */
static bool stability_chart_make(const extreme_result *r, const char *quantity, stability_plot *room,
                                 chart out[STABILITY_CHARTS])
{
    double low[STABILITY_MOST], high[STABILITY_MOST];
    int32_t n = r->stability_rows;
    for (int32_t i = 0; i < n; i++) {
        const threshold_row *row = &r->stability[i];
        room->threshold[i] = row->threshold;
        room->value[0][i] = row->shape;
        room->value[1][i] = row->scale_star;
        low[i] = row->shape - row->shape_half;
        high[i] = row->shape + row->shape_half;
        for (int k = 0; k < 3; k++)
            room->bar_x[3 * i + k] = row->threshold;
        room->bar_y[3 * i] = low[i];
        room->bar_y[3 * i + 1] = high[i];
        room->bar_y[3 * i + 2] = (double)NAN;
    }
    snprintf(room->across, sizeof room->across, "threshold of %s", quantity);
    snprintf(room->scale, sizeof room->scale, "scale - shape x threshold, of %s", quantity);
    for (int c = 0; c < STABILITY_CHARTS; c++) {
        chart_line *lines = room->lines[c];
        const double *value = room->value[c];
        bool bars = c == 0;
        lines[0] = taken_line(r, bars ? low : value, bars ? high : value, n, room, c);
        lines[1] = chart_line_make(bars ? "95 % interval" : "", room->bar_x, room->bar_y, bars ? 3 * n : 0, true);
        lines[2] = chart_line_make("fit", room->threshold, value, n, false);
        lines[2].style = CHART_POINTS;
        lines[2].colour = 2;
        out[c] = chart_make("pot, threshold stability", "stays the same above thresholds where the law holds",
                            room->across, bars ? "shape [1]" : room->scale, lines, STABILITY_LINES);
        out[c].free_y = true;
    }
    return n > 1;
}

fram_status extremes_chart_write(context *ctx, const extreme_result *results, int32_t count, const char *quantity,
                                 double duration, const char *path, fram_error *error)
{
    chart charts[EXTREME_METHODS + STABILITY_CHARTS];
    stability_plot stability;
    int32_t drawn = 0;
    extremes_plot *p = memory_array(ctx, EXTREME_METHODS + STABILITY_CHARTS, sizeof *p);
    if (!p)
        return error_memory(error);
    for (int32_t i = 0; i < count; i++) {
        if (results[i].answered && results[i].points > 0) {
            charts[drawn] = extremes_chart_make(&results[i], quantity, 1, duration, &p[drawn]);
            drawn++;
            if (results[i].method == EXTREME_POT &&
                stability_chart_make(&results[i], quantity, &stability, &charts[drawn]))
                drawn += STABILITY_CHARTS;
        }
    }
    fram_status status = drawn == 0
                             ? error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                                         "no method has an answer to draw; without the drawing the reasons are told")
                             : chart_stack_write(ctx, charts, drawn, path, CHART_WIDTH, CHART_HEIGHT, error);
    memory_free(ctx, p);
    return status;
}
