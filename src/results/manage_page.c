/* The page of ice management: what a client asks first, then figures, tables, charts and the plan. */
#include "results/manage_parts.h"

#include "base/load_unit.h"
#include "base/number_text.h"
#include "base/transcendental.h"
#include "io/atomic_file.h"
#include "io/html_page.h"
#include "model/scenario_vessel.h"
#include "results/rainflow.h"
#include "results/replay_plan.h"
#include "results/run_channels.h"
#include "results/track_results.h"

#include <stdio.h>
#include <string.h>

enum { PLAN_PIXELS = 900 };

static const char *const place_name[MANAGE_PLACES] = {"upstream", "behind the icebreakers", "at the vessel"};

typedef struct management_page {
    const manage_run *m, *other;
    const manage_summary *s, *os;
    html_page html;
    double_array column[8]; /* of charts */
} management_page;

enum { ARRIVAL_TEXT = 64 };

/* How long ice takes to come. */
static void arrival_text(double seconds, char out[ARRIVAL_TEXT])
{
    snprintf(out, ARRIVAL_TEXT, "%s",
             isnan(seconds)   ? "-"
             : isinf(seconds) ? "none in sight"
                              : duration_text_of(seconds).text);
}

/* ---- the first words ---- */

static void tell_tracks(management_page *p)
{
    const run_note *n = &p->m->d.note;
    for (int32_t i = 0; i < n->tracks.count; i++) {
        char text[240];
        track_text(&n->tracks.data[i], text, sizeof text);
        html_verdict_line(&p->html, track_was_kept(&n->tracks.data[i]) ? VERDICT_NOTE : VERDICT_CAUTION, text,
                          track_remedy(&n->tracks.data[i]));
    }
}

/* How near unmanaged ice came, if any did. */
static void tell_nearest(management_page *p)
{
    char text[240], time[ARRIVAL_TEXT];
    arrival_text(p->s->alarm_least, time);
    snprintf(text, sizeof text, "At its nearest, unmanaged ice was %s of drift away.", time);
    html_verdict_line(&p->html, VERDICT_NOTE, text, "");
}

static void tell_ice_that_came(management_page *p)
{
    const manage_summary *s = p->s;
    char text[240];
    snprintf(
        text, sizeof text,
        "%.0f %% of the ice that came was managed, that is in floes of at most %.3g m; %.0f %% was unbroken sheet.",
        100 * s->place[MANAGE_AT].managed, s->limit, 100 * s->place[MANAGE_AT].sheet);
    html_verdict_line(&p->html, VERDICT_NOTE, text, "");
    if (s->empty > 0) {
        char advice[64];
        snprintf(text, sizeof text, "No ice was before the vessel until %.4g s; means and loads below count that time.",
                 s->first_time);
        snprintf(advice, sizeof advice, "Give run.transient %.4g or more.", s->first_time);
        html_verdict_line(&p->html, VERDICT_CAUTION, text, advice);
    }
    if (isfinite(s->largest_time))
        snprintf(text, sizeof text,
                 s->largest_time < 100 ? "The largest floe that reached it was %.3g m across, at %.3g s."
                                       : "The largest floe that reached it was %.3g m across, at %.0f s.",
                 s->place[MANAGE_AT].largest, s->largest_time);
    else
        snprintf(text, sizeof text, "No loose floe reached it.");
    html_verdict_line(&p->html, VERDICT_NOTE, text, "");
    if (isinf(s->alarm_least))
        html_verdict_line(&p->html, VERDICT_NOTE, "No unmanaged ice was on its way to the vessel.", "");
    else if (!isnan(s->alarm_least))
        tell_nearest(p);
}

static void tell_other_loads(management_page *p)
{
    const manage_summary *s = p->s;
    char text[240];
    if (!p->os || !(p->os->load_most > 0))
        return;
    snprintf(text, sizeof text,
             "Largest ice load %.0f %% of that of the comparison run, mean %.0f %%: one run each; a study over seeds "
             "gives the confidence interval.",
             100 * s->load_most / p->os->load_most, 100 * s->load_mean / p->os->load_mean);
    html_verdict_line(&p->html, VERDICT_NOTE, text, "");
}

static void management_verdict(management_page *p)
{
    double managed = p->s->place[MANAGE_AT].managed;
    html_verdict_begin(&p->html,
                       managed >= 0.95  ? VERDICT_GOOD
                       : managed >= 0.5 ? VERDICT_NOTE
                                        : VERDICT_CAUTION,
                       "Ice that reached the vessel");
    if (isnan(managed)) {
        html_verdict_line(&p->html, VERDICT_CAUTION, "No ice came to the vessel after the transient.",
                          "Run longer, or shorten run.transient.");
        if (isfinite(p->s->alarm_least))
            tell_nearest(p);
    } else {
        tell_ice_that_came(p);
        tell_other_loads(p);
    }
    tell_tracks(p);
    html_verdict_end(&p->html);
}

/* ---- tables ---- */

static void place_table(management_page *p, const manage_summary *s, const char *title)
{
    const char *const heads[] = {title,          "windows",       "concentration", "managed [%]",
                                 "unbroken [%]", "mean size [m]", "largest [m]"};
    html_table_begin(&p->html, heads, 7);
    for (int k = 0; k < MANAGE_PLACES; k++) {
        html_row_begin(&p->html);
        html_row_name(&p->html, place_name[k]);
        html_number(&p->html, s->place[k].windows);
        html_number(&p->html, s->place[k].concentration);
        html_number(&p->html, 100 * s->place[k].managed);
        html_number(&p->html, 100 * s->place[k].sheet);
        html_number(&p->html, s->place[k].mean);
        html_number(&p->html, s->place[k].largest > 0 ? s->place[k].largest : (double)NAN);
        html_row_end(&p->html);
    }
    html_table_end(&p->html);
}

static void load_row(management_page *p, const char *name, load_unit unit, double own, double beside)
{
    char head[64];
    snprintf(head, sizeof head, "%s [%s]", name, unit.name);
    html_row_begin(&p->html);
    html_row_name(&p->html, head);
    html_number(&p->html, unit.factor * own);
    if (p->os) {
        html_number(&p->html, unit.factor * beside);
        html_number(&p->html, beside > 0 ? own / beside : (double)NAN);
    }
    html_row_end(&p->html);
}

/* What the row of fatigue in the table means, and the ratio of damages. */
static void fatigue(management_page *p)
{
    const manage_summary *a = p->s, *b = p->os;
    if (isnan(a->tension_range))
        return;
    html_paragraph(&p->html,
                   "Fatigue of line %d, the most damaged: rainflow cycles (ASTM E1049-85) and Miner's rule with slope "
                   "%g, that of chains; the range that does the same damage at one cycle per second.",
                   (int)a->tension_line, FATIGUE_CHAIN_SLOPE);
    if (b && b->tension_range > 0)
        html_paragraph(&p->html,
                       "In the same time the most damaged line here takes %.3g times the damage of that of the "
                       "comparison run (line %d).",
                       real_pow(a->tension_range / b->tension_range, FATIGUE_CHAIN_SLOPE), (int)b->tension_line);
}

static void load_comparison(management_page *p)
{
    const char *const heads[] = {"after the transient", "this run", "comparison run", "this / comparison"};
    const manage_summary none = {.limit = 0}, *a = p->s, *b = p->os ? p->os : &none;
    html_table_begin(&p->html, heads, p->os ? 4 : 2);
    const load_unit load = load_unit_for(fmax(a->load_most, b->load_most)), metres = {"m", 1};
    const load_unit tension = load_unit_for(fmax(a->tension_most, b->tension_most));
    load_row(p, "mean horizontal ice load", load, a->load_mean, b->load_mean);
    load_row(p, "largest horizontal ice load, averaged", load, a->load_most, b->load_most);
    load_row(p, "largest offset", metres, a->offset_most, b->offset_most);
    load_row(p, "largest line tension", tension, a->tension_most, b->tension_most);
    load_row(p, "damage-equivalent range of line tension", tension, a->tension_range, b->tension_range);
    html_table_end(&p->html);
    fatigue(p);
}

static void alarm_table(management_page *p)
{
    const double value[] = {p->s->alarm_least, p->s->alarm_median, p->s->warning_least, p->s->warning_median};
    static const char *const name[] = {"nearest unmanaged ice, least", "nearest unmanaged ice, median",
                                       "largest unmanaged ice, least", "largest unmanaged ice, median"};
    static const char *const heads[] = {"time until it arrives", "this run"};
    html_table_begin(&p->html, heads, 2);
    for (int i = 0; i < 4; i++) {
        char text[ARRIVAL_TEXT];
        arrival_text(value[i], text);
        html_row_begin(&p->html);
        html_row_name(&p->html, name[i]);
        html_cell(&p->html, text);
        html_row_end(&p->html);
    }
    html_table_end(&p->html);
}

/* ---- charts ---- */

static bool fill_series(const manage_run *m, bool alarm, double_array *time, double_array *value)
{
    bool good = true;
    for (int32_t i = 0; i < m->moments.count && good; i++) {
        const manage_moment *at = &m->moments.data[i];
        const manage_cover *c = &at->cover[MANAGE_AT];
        double v = alarm ? manage_alarm(at, true) / 60 : c->ice > 0 ? 100 * c->managed / c->ice : (double)NAN;
        bool known = at->looked[MANAGE_AT] >= 0 && isfinite(v);
        good = array_push(m->ctx, time, at->time) && array_push(m->ctx, value, known ? v : (double)NAN);
    }
    return good;
}

static bool any_known(const double_array *value)
{
    for (int32_t i = 0; i < value->count; i++)
        if (isfinite(value->data[i]))
            return true;
    return false;
}

/* No chart where no run has a value: no ice came, or none was unmanaged. */
static fram_status series_chart(management_page *p, bool alarm, const char *title, const char *label, fram_error *error)
{
    chart_line lines[2];
    int32_t n = 0;
    for (int k = 0; k < (p->other ? 2 : 1); k++) {
        double_array *time = &p->column[4 * alarm + 2 * k], *value = &p->column[4 * alarm + 2 * k + 1];
        const manage_run *m = k ? p->other : p->m;
        if (!fill_series(m, alarm, time, value))
            return error_memory(error);
        if (!any_known(value))
            continue;
        lines[n] = chart_line_make(k ? "comparison run" : "this run", time->data, value->data, time->count, k == 0);
        lines[n++].colour = k + 2;
    }
    if (n == 0)
        return FRAM_OK;
    chart c = chart_make(title, "", "time [s]", label, lines, n);
    return html_chart(&p->html, &c, false, error);
}

/* Part of the ice in floes no larger than a size; what is missing at the end is larger, or unbroken. */
static fram_status size_chart(management_page *p, fram_error *error)
{
    double sum[MANAGE_PLACES][MANAGE_CLASSES], size[MANAGE_CLASSES];
    chart_line lines[MANAGE_PLACES];
    int32_t n = 0;
    for (int i = 0; i < MANAGE_CLASSES; i++)
        size[i] = p->m->unit * manage_class_size[i];
    for (int k = 0; k < MANAGE_PLACES; k++) {
        double so_far = 0;
        for (int i = 0; i < MANAGE_CLASSES; i++)
            sum[k][i] = so_far += 100 * p->s->place[k].share[i];
        if (!(p->s->place[k].windows > 0 && isfinite(sum[k][0])))
            continue;
        lines[n] = chart_line_make(place_name[k], size, sum[k], MANAGE_CLASSES, k == MANAGE_AT);
        lines[n++].colour = k + 1;
    }
    if (n == 0)
        return FRAM_OK;
    chart c = chart_make("Floe sizes", "part of the ice in floes up to this size", "floe size [m]",
                         "part of the ice [%]", lines, n);
    c.log_x = true;
    return html_chart(&p->html, &c, false, error);
}

/* The moment after the transient at which the averaged ice load was largest, so that the plan shows what caused it; the
   end where there was none.  In words too. */
static fram_status telling_time(const manage_run *m, char title[64], double *time, fram_error *error)
{
    const double *t = run_channel(&m->d, "time");
    double most = 0;
    double_array load = {0};
    bool good = run_size_channel(m->ctx, &m->d, m->vessel, "ice_force_averaged_x", "ice_force_averaged_y", &load);
    *time = m->moments.data[m->moments.count - 1].time;
    snprintf(title, 64, "The field at the end");
    for (int32_t i = run_first_row(&m->d); t && i < load.count; i++) {
        if (!(load.data[i] > most))
            continue;
        most = load.data[i];
        *time = t[i];
        snprintf(title, 64, "The field when the ice load was largest");
    }
    array_free(m->ctx, &load);
    return good ? FRAM_OK : error_memory(error);
}

/* The field from above then. */
static fram_status plan(management_page *p, fram_error *error)
{
    const manage_run *m = p->m;
    replay r;
    replay_moment now = {0};
    replay_plan shapes = {0};
    text_buffer png = {0};
    char caption[64], title[64];
    double time;
    fram_status status = telling_time(m, title, &time, error);
    if (status == FRAM_OK)
        status = replay_open(m->ctx, m->d.folder, &r, error);
    if (status != FRAM_OK)
        return status;
    status = replay_moment_until(&r, time, &now, error);
    if (status == FRAM_OK)
        status = replay_plan_make(&r, &now, PLAN_COLOUR_PLAIN, 0, 1, 0, 0, &shapes, error);
    bool before = now.time < time - 0.5 * m->d.s.run.time_step;
    snprintf(caption, sizeof caption, "t = %.4g s%s", now.time, before ? ", the last frame before" : "");
    plan_view view = {.window = plan_window(domain_with_walls(&m->d.s.domain), shapes.shapes.data, shapes.shapes.count),
                      .title = title,
                      .caption = caption,
                      .shapes = shapes.shapes.data,
                      .shape_count = shapes.shapes.count};
    if (status == FRAM_OK)
        status = plan_view_png(m->ctx, &view, PLAN_PIXELS, &png, error);
    char shows[160];
    snprintf(shows, sizeof shows, "%s, seen from above: vessels, floes and open water; %s", title, caption);
    if (status == FRAM_OK)
        html_picture(&p->html, png.data, (size_t)png.count, shows, title);
    text_free(m->ctx, &png);
    replay_plan_free(m->ctx, &shapes);
    replay_moment_free(m->ctx, &now);
    replay_close(&r);
    return status == FRAM_ERROR_UNSUPPORTED ? FRAM_OK : status;
}

/* ---- all ---- */

static fram_status compose_management(management_page *p, fram_error *error)
{
    const manage_run *m = p->m;
    const char *name = scenario_vessel_name(&m->d.s, m->vessel);
    char title[120];
    snprintf(title, sizeof title, "Ice management for %s", name ? name : "the vessel");
    html_begin(&p->html, title, m->d.s.title);
    management_verdict(p);
    html_section(&p->html, "The field from above, and its floes");
    html_grid_begin(&p->html);
    fram_status status = plan(p, error);
    if (status == FRAM_OK)
        status = size_chart(p, error);
    html_grid_end(&p->html);
    html_section(&p->html, "Ice that reached the vessel");
    html_paragraph(
        &p->html,
        "A window as wide as the hull across the drift is followed back with the ice from where it meets the "
        "hull: upstream is the same ice before an icebreaker came near it, behind the same ice after the last "
        "has left. Sizes are diameters of discs of the floe's area, means are by area; managed: at most %.3g m.",
        m->limit);
    place_table(p, p->s, "this run");
    if (p->os)
        place_table(p, p->os, "comparison run");
    html_section(&p->html, "Loads");
    load_comparison(p);
    track_table(&p->html, &m->d.note);
    html_section(&p->html, "Warning");
    html_paragraph(&p->html, "Along the drift at each moment, assuming that it persists; within the recorded domain.");
    alarm_table(p);
    html_grid_begin(&p->html);
    if (status == FRAM_OK)
        status = series_chart(p, false, "Managed ice at the vessel", "part of the ice [%]", error);
    if (status == FRAM_OK)
        status = series_chart(p, true, "Time until the largest unmanaged ice arrives", "time [min]", error);
    html_grid_end(&p->html);
    html_end(&p->html);
    return status == FRAM_OK && p->html.text.failed ? error_memory(error) : status;
}

fram_status manage_page(const manage_run *m, const manage_summary *s, const manage_run *other,
                        const manage_summary *other_summary, fram_error *error)
{
    management_page p = {.m = m, .other = other, .s = s, .os = other_summary, .html = {.ctx = m->ctx}};
    fram_status status = compose_management(&p, error);
    if (status == FRAM_OK)
        status = text_file_write(m->ctx, s->page, &p.html.text, error);
    for (size_t i = 0; i < sizeof p.column / sizeof *p.column; i++)
        array_free(m->ctx, &p.column[i]);
    html_free(&p.html);
    return status;
}
