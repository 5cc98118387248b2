/* The report's section on what makes the load: mechanisms over time, stacked, and the ten largest peaks in words. */
#include "results/report_parts.h"

#include "results/load_shares.h"
#include "results/mechanism_curve.h"

#include <stdio.h>
#include <string.h>

/* The chart has so many means over time at most. */
enum { BINS_MOST = 600, SIDES = 2 };

/* Means of the parts of each mechanism along the horizontal load: the load of the same stretch of time. */
typedef struct stacked {
    int32_t bins;
    double width, apart;                  /* of a bin, and from row to row [s] */
    double *time, *part[MECHANISM_COUNT]; /* parts [N] */
    /* Of the bands above zero and below it, in the chart's unit. */
    double *low[SIDES][MECHANISM_COUNT], *high[SIDES][MECHANISM_COUNT];
} stacked;

static double *kept_column(report *r, int32_t rows)
{
    double *column = memory_array(r->ctx, (size_t)rows, sizeof *column);
    if (column && array_push(r->ctx, &r->kept, column))
        return column;
    memory_free(r->ctx, column);
    return NULL;
}

static bool make_stacked_room(report *r, stacked *s)
{
    s->time = kept_column(r, s->bins);
    bool good = s->time != NULL;
    for (int m = 0; m < MECHANISM_COUNT && good; m++) {
        s->part[m] = kept_column(r, s->bins);
        good = s->part[m] != NULL;
        for (int side = 0; side < SIDES && good; side++) {
            s->low[side][m] = kept_column(r, s->bins);
            s->high[side][m] = kept_column(r, s->bins);
            good = s->low[side][m] && s->high[side][m];
        }
    }
    return good;
}

/* The bins begin at the first row; each has the same number of rows but the last. */
static bool find_parts(const report *r, int32_t every, stacked *s)
{
    const double *time = run_channel(&r->d, "time");
    mechanism_columns c;
    if (!mechanism_columns_find(&r->d, r->vessel, &c))
        return false;
    for (int32_t b = 0; b < s->bins; b++) {
        double fx[MECHANISM_COUNT] = {0}, fy[MECHANISM_COUNT] = {0}, all_x = 0, all_y = 0;
        int32_t first = b * every, end = first + every < r->d.series.rows ? first + every : r->d.series.rows;
        for (int m = 0; m < MECHANISM_COUNT; m++) {
            for (int32_t i = first; i < end; i++) {
                fx[m] += c.x[m][i] / (end - first);
                fy[m] += c.y[m][i] / (end - first);
            }
            all_x += fx[m];
            all_y += fy[m];
        }
        double load = sqrt(all_x * all_x + all_y * all_y);
        s->time[b] = (time[first] + time[end - 1]) / 2;
        for (int m = 0; m < MECHANISM_COUNT; m++)
            s->part[m][b] = load > 0 ? (fx[m] * all_x + fy[m] * all_y) / load : 0;
    }
    return true;
}

/* What pushes with the load goes up from zero, what pushes against it down: two bands a mechanism, of which one has no
   width at a time, so that a part that changes its side leaves no gap. */
static void stack(const stacked *s, double factor)
{
    for (int32_t b = 0; b < s->bins; b++) {
        double up = 0, down = 0;
        for (int m = 0; m < MECHANISM_COUNT; m++) {
            double part = s->part[m][b] * factor;
            s->low[0][m][b] = up;
            s->high[0][m][b] = up += fmax(0, part);
            s->high[1][m][b] = down;
            s->low[1][m][b] = down += fmin(0, part);
        }
    }
}

/* Parts of the load have no averaged columns: rows that leave out steps tell those of the steps that they have. */
static void tell_means(report *r, const stacked *s, char *out, size_t room)
{
    bool thinned = s->apart > 1.5 * r->d.s.run.time_step;
    snprintf(out, room, "means over %.3g s%s", s->width, thinned ? " of single steps" : "");
    if (!thinned)
        return;
    if (s->width < 1.5 * s->apart)
        snprintf(out, room, "single steps");
    html_paragraph(&r->page,
                   "The series has a row every %.3g s: parts are those of the steps that it has, whose load may be far "
                   "from its average.",
                   s->apart);
}

static fram_status draw_stack(report *r, const stacked *s, load_unit unit, fram_error *error)
{
    chart_line bands[SIDES * MECHANISM_COUNT];
    char label[48], means[64], subtitle[128];
    stack(s, unit.factor);
    for (int k = 0; k < SIDES * MECHANISM_COUNT; k++) {
        int side = k / MECHANISM_COUNT, m = k % MECHANISM_COUNT;
        const char *name = side == 0 ? mechanism_name((ice_mechanism)m) : "";
        bands[k] = chart_line_make(name, s->time, s->low[side][m], s->bins, false);
        bands[k].style = CHART_BAND;
        bands[k].y2 = s->high[side][m];
        bands[k].colour = m + 1;
        bands[k].solid = true;
    }
    snprintf(label, sizeof label, "along the load [%s]", unit.name);
    tell_means(r, s, means, sizeof means);
    snprintf(subtitle, sizeof subtitle, "%s; what pushes against the load is under zero", means);
    chart c = chart_make("Ice load by mechanism", subtitle, "time [s]", label, bands, SIDES * MECHANISM_COUNT);
    return html_chart(&r->page, &c, true, error);
}

/* Parts of the mean load, which are nothing where it is 0. */
static void share_table(report *r, const char *what, const char *const *name, const double *const *x,
                        const double *const *y, int32_t parts)
{
    const char *const heads[] = {what, "part of the mean load after the transient [%]"};
    double share[LOAD_PARTS_MOST];
    if (!load_shares(&r->d, x, y, parts, share))
        return;
    html_table_begin(&r->page, heads, 2);
    for (int32_t k = 0; k < parts; k++) {
        html_row_begin(&r->page);
        html_row_name(&r->page, name[k]);
        html_number(&r->page, 100 * share[k]);
        html_row_end(&r->page);
    }
    html_table_end(&r->page);
}

static void mechanism_table(report *r)
{
    const char *name[MECHANISM_COUNT];
    mechanism_columns c;
    for (int m = 0; m < MECHANISM_COUNT; m++)
        name[m] = mechanism_text((ice_mechanism)m);
    if (mechanism_columns_find(&r->d, r->vessel, &c))
        share_table(r, "mechanism", name, c.x, c.y, MECHANISM_COUNT);
}

static void zone_table(report *r)
{
    const char *zone[PEAK_ZONES];
    const double *x[PEAK_ZONES], *y[PEAK_ZONES];
    for (int32_t z = 0; z < PEAK_ZONES; z++) {
        char name[64];
        zone[z] = peak_zone_name(z);
        snprintf(name, sizeof name, "ice_force_%s_x", zone[z]);
        x[z] = run_vessel_channel(&r->d, r->vessel, name);
        name[strlen(name) - 1] = 'y';
        y[z] = run_vessel_channel(&r->d, r->vessel, name);
        if (!x[z] || !y[z])
            return;
    }
    share_table(r, "zone of the hull", zone, x, y, PEAK_ZONES);
}

static fram_status peak_table(report *r, fram_error *error)
{
    const char *const heads[] = {"peak", "time [s]", "what it was"};
    peak_list list;
    fram_status status = report_peaks(r, &list, error);
    if (r->peaks_unread)
        html_paragraph(&r->page, "The largest peaks are not told: peaks.fram cannot be read.");
    if (status != FRAM_OK || list.count == 0)
        return status;
    html_paragraph(&r->page,
                   "The largest peaks of the averaged horizontal load, four windows apart at least; fram why tells "
                   "more of each.");
    html_table_begin(&r->page, heads, 3);
    for (int32_t i = 0; i < list.count; i++) {
        text_buffer words = {0};
        char rank[16];
        snprintf(rank, sizeof rank, "%d", (int)i + 1);
        peak_sentence(r->ctx, &r->d, list.peak[i], &words);
        html_row_begin(&r->page);
        html_row_name(&r->page, rank);
        html_number(&r->page, list.peak[i]->time);
        html_cell(&r->page, words.data ? words.data : "");
        html_row_end(&r->page);
        r->page.text.failed = r->page.text.failed || words.failed;
        text_free(r->ctx, &words);
    }
    html_table_end(&r->page);
    peak_list_free(r->ctx, &list);
    return FRAM_OK;
}

fram_status report_mechanisms(report *r, load_unit unit, fram_error *error)
{
    int32_t rows = r->d.series.rows;
    const double *time = run_channel(&r->d, "time");
    char name[] = "mechanism_friction_x";
    bool loaded = false;
    for (int32_t i = 0; i < r->load.count; i++)
        loaded = loaded || r->load.data[i] > 0;
    if (rows < 2 || !time || !loaded || !run_vessel_channel(&r->d, r->vessel, name))
        return FRAM_OK;
    double step = (time[rows - 1] - time[0]) / (rows - 1), window = scenario_averaging_window(&r->d.s);
    double every = ceil(fmax(window / step, (double)rows / BINS_MOST) - 1e-9);
    int32_t size = every < 1 ? 1 : every > rows ? rows : (int32_t)every;
    stacked s = {.bins = (rows + size - 1) / size, .width = size * step, .apart = step};
    if (!make_stacked_room(r, &s))
        return error_memory(error);
    if (!find_parts(r, size, &s))
        return FRAM_OK;
    report_vessel_section(r, "What makes the load");
    fram_status status = draw_stack(r, &s, unit, error);
    if (status != FRAM_OK)
        return status;
    mechanism_table(r);
    zone_table(r);
    return peak_table(r, error);
}
