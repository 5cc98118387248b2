/* The report's sections on the ice field and on what broke. */
#include "results/report_parts.h"

#include "io/plan_flows.h"
#include "results/replay_plan.h"

#include <stdio.h>

enum { MAP_PIXELS = 900, EVENTS_SHOWN = 25 };

/* Whether the record's first frame is its last: then there is nothing to set beside it. */
static bool has_one_frame(const report *r) { return !(r->d.after.time > r->d.before.time); }

static void field_row(report *r, const char *name, double before, double after)
{
    html_row_begin(&r->page);
    html_row_name(&r->page, name);
    html_number(&r->page, before);
    if (!has_one_frame(r))
        html_number(&r->page, after);
    html_row_end(&r->page);
}

static void field_table(report *r)
{
    const field_state *a = &r->d.before, *b = &r->d.after;
    const scenario_domain *s = &r->d.s.domain;
    double domain = (s->x_max - s->x_min) * (s->y_max - s->y_min);
    char first[48], last[48];
    snprintf(first, sizeof first, "at %g s", a->time);
    snprintf(last, sizeof last, "at %g s", b->time);
    const char *const heads[] = {"ice field", first, last};
    html_table_begin(&r->page, heads, has_one_frame(r) ? 2 : 3);
    field_row(r, "floes", a->areas.count, b->areas.count);
    field_row(r, "of these fixed", a->fixed, b->fixed);
    field_row(r, "ice area [m2]", a->area, b->area);
    field_row(r, "ice area in the domain over domain area", a->inside / domain, b->inside / domain);
    field_row(r, "ice mass [t]", a->mass * 1e-3, b->mass * 1e-3);
    field_row(r, "mean thickness [m]", a->thickness, b->thickness);
    field_row(r, "mean floe area [m2]", a->mean, b->mean);
    field_row(r, "median floe area [m2]", a->median, b->median);
    field_row(r, "largest floe [m2]", a->greatest, b->greatest);
    html_table_end(&r->page);
}

/* What of the domain was kept free of ice, in words. */
static void kept_free(const scenario *s, char out[96])
{
    int32_t vessels = scenario_vessel_count(s);
    bool water = s->ice.open_water.count > 0 || s->ice.open_water_file[0];
    char round[64] = "";
    if (vessels > 0)
        snprintf(round, sizeof round, "%s and %g m around %s", vessels > 1 ? "the vessels" : "the vessel",
                 s->ice.keep_out_margin, vessels > 1 ? "them" : "it");
    snprintf(out, 96, "%s%s%s%s", vessels > 0 || water ? " without " : "", round, vessels > 0 && water ? " and " : "",
             water ? "the open water" : "");
}

/* Why the cover of the window is not the concentration that was asked for. */
static void tell_cover(report *r)
{
    const scenario *s = &r->d.s;
    const scenario_domain *d = &s->domain;
    if (!scenario_ice_is_drawn(&s->ice))
        return;
    char kept[96];
    kept_free(s, kept);
    html_paragraph(
        &r->page,
        "%g %% was requested of the area free for ice: the domain%s. "
        "The table counts all ice of the run, including what extends beyond the edge; only what lies in the domain is "
        "divided by the area of the whole domain%s.",
        100 * s->ice.concentration, kept,
        d->boundary == DOMAIN_FEEDING
            ? "; it is a window on an unbounded field, whose content varies about that of the whole tile"
            : "");
}

/* Part of the floes that are larger, a step per floe. */
static fram_status sizes(report *r, fram_error *error)
{
    const field_state *state[2] = {&r->d.before, &r->d.after};
    static const char *const names[2] = {"before", "after"};
    chart_line lines[2];
    const int count = has_one_frame(r) ? 1 : 2;
    for (int k = 0; k < count; k++) {
        int32_t n = state[k]->areas.count;
        double *part = memory_array(r->ctx, (size_t)n + 1, sizeof *part);
        if (!part || !array_push(r->ctx, &r->kept, part)) {
            memory_free(r->ctx, part);
            return error_memory(error);
        }
        for (int32_t i = 0; i < n; i++)
            part[i] = (double)(n - i) / n;
        lines[k] = chart_line_make(names[k], state[k]->areas.data, part, n, true);
        lines[k].colour = k + 2;
    }
    chart c = chart_make("Floe sizes", "share of floes at least this large", "floe area [m2]", "share of floes", lines,
                         count);
    c.log_x = true;
    c.log_y = true;
    return html_chart(&r->page, &c, false, error);
}

/* ---- maps ---- */

static fram_status draw_map(report *r, const replay *from, const replay_moment *m, double mark_time, fram_error *error)
{
    bool ends = m->time > r->d.note.time - 0.5 * r->d.s.run.time_step;
    const char *title = !(mark_time > 0) ? "The field at the start"
                        : ends           ? "The field at the end"
                                         : "The field at the last frame";
    replay_plan plan = {0};
    text_buffer png = {0};
    char caption[96], shows[192];
    plan_flows flows = plan_flows_at(r->ctx, &r->d.s, m->time);
    fram_status status = replay_plan_make(from, m, PLAN_COLOUR_PLAIN, 0, 1, 0, mark_time, &plan, error);
    if (status == FRAM_OK)
        status = replay_plan_lines(from, &r->d.s, &plan, error);
    const box2 window = plan_window(domain_with_walls(&r->d.s.domain), plan.shapes.data, plan.shapes.count);
    snprintf(caption, sizeof caption, "t = %g s%s", m->time,
             replay_plan_marks_in(&plan, window) ? "; crosses: where floes broke" : "");
    plan_view view = {.window = window,
                      .title = title,
                      .caption = caption,
                      .shapes = plan.shapes.data,
                      .shape_count = plan.shapes.count,
                      .marks = plan.marks.data,
                      .mark_count = plan.marks.count,
                      .lines = plan.lines.data,
                      .line_count = plan.lines.count,
                      .flows = flows.flow,
                      .flow_count = flows.count};
    if (status == FRAM_OK)
        status = plan_view_png(r->ctx, &view, MAP_PIXELS, &png, error);
    snprintf(shows, sizeof shows, "%s, seen from above: vessels, floes and open water; %s", title, caption);
    if (status == FRAM_OK)
        html_picture(&r->page, png.data, (size_t)png.count, shows, caption);
    else if (status == FRAM_ERROR_UNSUPPORTED)
        status = FRAM_OK;
    text_free(r->ctx, &png);
    replay_plan_free(r->ctx, &plan);
    return status;
}

static fram_status maps(report *r, fram_error *error)
{
    replay from;
    replay_moment m = {0};
    bool found = true;
    fram_status status = replay_open(r->ctx, r->d.folder, &from, error);
    if (status != FRAM_OK)
        return status;
    status = replay_next(&from, &found, error);
    if (status == FRAM_OK)
        status = replay_moment_now(&from, &m, error);
    if (status == FRAM_OK)
        status = draw_map(r, &from, &m, 0, error);
    const bool goes_on = !has_one_frame(r);
    while (status == FRAM_OK && from.has_next)
        status = replay_next(&from, &found, error);
    if (status == FRAM_OK && goes_on)
        status = replay_moment_now(&from, &m, error);
    if (status == FRAM_OK && goes_on)
        status = draw_map(r, &from, &m, 1e30, error);
    replay_moment_free(r->ctx, &m);
    replay_close(&from);
    return status;
}

fram_status report_field(report *r, fram_error *error)
{
    if (r->d.frames == 0 || r->d.before.areas.count == 0)
        return FRAM_OK;
    const report_line floes[] = {{"floes", "floes"}};
    html_section(&r->page, "Ice field");
    field_table(r);
    tell_cover(r);
    html_grid_begin(&r->page);
    fram_status status = maps(r, error);
    if (status == FRAM_OK)
        status = sizes(r, error);
    if (status == FRAM_OK)
        status = report_series(r, "Floes in the field", "floes", 1, floes, 1, false, error);
    html_grid_end(&r->page);
    return status;
}

/* ---- fractures ---- */

static double cell(const report *r, const char *column, int32_t row)
{
    const csv_table_column *c = csv_table_find(&r->d.fractures, column);
    return c ? c->value.data[row] : (double)NAN;
}

/* By enum fracture_kind. */
enum { BROKEN_KINDS = FRACTURE_RELEASE + 1 };
static const char *const broken_names[BROKEN_KINDS] = {
    [0] = "", [FRACTURE_SPLIT] = "split", [FRACTURE_BENDING] = "bending", [FRACTURE_RELEASE] = "came loose"};

static int broken_kind(const report *r, int32_t row)
{
    double kind = cell(r, "kind", row);
    return kind > 0 && kind < BROKEN_KINDS ? (int)kind : 0;
}

static void event_table_of(report *r, load_unit unit)
{
    char load[32];
    snprintf(load, sizeof load, "load [%s]", unit.name);
    const char *const heads[] = {"event", "time [s]",  "floe",      "x [m]", "y [m]",
                                 load,    "crack [m]", "floe [m2]", "pieces"};
    int32_t rows = r->d.fractures.rows, shown = rows < EVENTS_SHOWN ? rows : EVENTS_SHOWN;
    html_table_begin(&r->page, heads, 9);
    for (int32_t i = 0; i < shown; i++) {
        html_row_begin(&r->page);
        html_cell(&r->page, broken_names[broken_kind(r, i)]);
        html_number(&r->page, cell(r, "time", i));
        html_number(&r->page, cell(r, "floe", i));
        html_place(&r->page, cell(r, "place_x", i));
        html_place(&r->page, cell(r, "place_y", i));
        html_number(&r->page, cell(r, "load", i) * unit.factor);
        html_number(&r->page, cell(r, "crack_length", i));
        html_number(&r->page, cell(r, "floe_area", i));
        html_number(&r->page, cell(r, "pieces", i));
        html_row_end(&r->page);
    }
    html_table_end(&r->page);
    html_paragraph(&r->page, "The load is along the floe's own vertical%s.",
                   r->d.s.ice.fracture.splitting == SPLITTING_TOUGHNESS
                       ? "; of floes that split by their toughness it is that in their plane"
                       : "");
    if (rows > shown)
        html_paragraph(&r->page, "The first %d of %d events%s", (int)shown, (int)rows,
                       run_fractures_untold(&r->d) > 0 ? " that are in fractures.csv." : "; all are in fractures.csv.");
}

/* The table of a run that goes on, or was killed, is written in larger lumps than its series. */
static void tell_untold(report *r)
{
    int32_t untold = run_fractures_untold(&r->d), rows = r->d.fractures.rows;
    if (untold == 0)
        return;
    if (rows > 0)
        html_paragraph(&r->page, "Events after %.6g s are not in fractures.csv: %d of those that the series counts.",
                       cell(r, "time", rows - 1), (int)untold);
    else
        html_paragraph(&r->page, "Of these events none is in fractures.csv yet: the series alone counts them.");
}

fram_status report_fractures(report *r, fram_error *error)
{
    int32_t rows = r->d.fractures.rows;
    int32_t bent = run_fractures(&r->d, FRACTURE_BENDING), split = run_fractures(&r->d, FRACTURE_SPLIT),
            broke = bent + split;
    int32_t loose = run_fractures(&r->d, FRACTURE_RELEASE);
    double most = 0;
    if (!r->d.s.ice.breakable && rows == 0 && broke == 0)
        return FRAM_OK;
    html_section(&r->page, "Fracture");
    if (rows == 0 && broke == 0) {
        html_paragraph(&r->page, "Floes may break, but none did.");
        return FRAM_OK;
    }
    for (int32_t i = 0; i < rows; i++)
        most = fmax(most, cell(r, "load", i));
    const report_line kinds[] = {{"bendings", "broken in bending"}, {"splits", "split"}};
    html_paragraph(&r->page, "%d floe%s broke: %d in bending, %d by splitting.", (int)broke, broke == 1 ? "" : "s",
                   (int)bent, (int)split);
    if (loose > 0)
        html_paragraph(&r->page, "%d part%s of the sheet came loose from its held sides, and drift%s as %s.",
                       (int)loose, loose == 1 ? "" : "s", loose == 1 ? "s" : "", loose == 1 ? "one floe" : "floes");
    html_grid_begin(&r->page);
    fram_status status = report_series(r, "Broken floes", "floes, cumulative", 1, kinds, 2, true, error);
    html_grid_end(&r->page);
    tell_untold(r);
    if (rows > 0)
        event_table_of(r, load_unit_for(most));
    return status;
}
