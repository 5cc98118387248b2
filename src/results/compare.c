/* Comparison of two runs: the same numbers of both, and their channels over each other. */
#include "base/load_unit.h"
#include "base/number_text.h"
#include "io/atomic_file.h"
#include "io/html_page.h"
#include "io/path.h"
#include "model/scenario_vessel.h"
#include "results/report.h"
#include "results/run_channels.h"
#include "results/run_data.h"
#include "results/station_results.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct pair {
    context *ctx;
    run_data d[2];
    html_page page;
    compare_result *result;
    load_unit load, tension, power, work, energy; /* those of both runs */
    char last_row[48];                            /* "7 s", "7 and 12 s": of both; "" where both ended with it */
    double from[2];                               /* statistics are of what is after that [s] */
} pair;

static void add_row(pair *p, const char *name, const char *unit, bool is_place, const double value[2])
{
    if (p->result->count == COMPARE_ROWS_MOST || (value[0] != value[0] && value[1] != value[1]))
        return;
    compare_row *row = &p->result->row[p->result->count++];
    *row = (compare_row){.a = value[0], .b = value[1], .is_place = is_place};
    snprintf(row->name, sizeof row->name, "%s", name);
    snprintf(row->unit, sizeof row->unit, "%s", unit);
}

typedef enum measure { MEAN, DEVIATION, GREATEST, LEAST, SIGNIFICANT, LAST } measure;

static double measure_of(const pair *p, int k, const char *channel, measure what)
{
    const run_data *d = &p->d[k];
    const double *time = run_channel(d, "time"), *value = run_channel(d, channel);
    if (!time || !value || d->series.rows == 0)
        return (double)NAN;
    channel_statistics s = channel_statistics_of(time, value, d->series.rows, p->from[k]);
    const double all[] = {[MEAN] = s.mean,   [DEVIATION] = s.deviation,     [GREATEST] = s.greatest,
                          [LEAST] = s.least, [SIGNIFICANT] = s.significant, [LAST] = value[d->series.rows - 1]};
    return all[what];
}

static const struct {
    const char *channel, *name;
    measure what;
    double factor;
    const char *unit;
} rows[] = {
    {"ice_force_averaged_x", "ice load along X, mean", MEAN, 1e-3, "kN"},
    {"ice_force_averaged_x", "ice load along X, standard deviation", DEVIATION, 1e-3, "kN"},
    {"ice_force_averaged_x", "ice load along X, minimum", LEAST, 1e-3, "kN"},
    {"ice_force_averaged_x", "ice load along X, maximum", GREATEST, 1e-3, "kN"},
    {"ice_force_averaged_y", "ice load along Y, mean", MEAN, 1e-3, "kN"},
    {"ice_force_averaged_y", "ice load along Y, standard deviation", DEVIATION, 1e-3, "kN"},
    {"ice_force_averaged_y", "ice load along Y, minimum", LEAST, 1e-3, "kN"},
    {"ice_force_averaged_y", "ice load along Y, maximum", GREATEST, 1e-3, "kN"},
    {"line_tension_max", "largest line tension", GREATEST, 1e-3, "kN"},
    {"offset_x", "offset along X, standard deviation", DEVIATION, 1, "m"},
    {"offset_y", "offset along Y, standard deviation", DEVIATION, 1, "m"},
    {"thruster_power", "thruster power, mean", MEAN, 1e-6, "MW"},
    {"position_x", "x at the end", LAST, 1, "m"},
    {"position_y", "y at the end", LAST, 1, "m"},
    {"yaw", "heading at the end", LAST, 1, "deg"},
    {"floes", "floes at the end", LAST, 1, ""},
    {"bendings", "floes broken in bending", LAST, 1, ""},
    {"splits", "floes split", LAST, 1, ""},
    {"ice_mass_left", "ice that left the domain", LAST, 1e-3, "t"},
    {"ice_mass_lost", "ice lost in fracture", LAST, 1e-3, "t"},
    {"crushing_work", "work of crushing", LAST, 1e-3, "kJ"},
    {"kinetic_energy", "kinetic energy at the end", LAST, 1e-3, "kJ"},
    {"contacts", "contact points, mean", MEAN, 1, ""},
    {"solver_residual", "residual, mean", MEAN, 1, "m/s"},
    {"overlap_max", "largest overlap", GREATEST, 1, "m"},
    {"step_wall_time", "computing time of a step, mean", MEAN, 1e3, "ms"},
};

/* Of a force, power or energy that of both runs. */
static load_unit row_unit(const pair *p, size_t i)
{
    const struct {
        const char *channel;
        load_unit unit;
    } of_both[] = {{"ice_force_averaged_x", p->load}, {"ice_force_averaged_y", p->load},
                   {"line_tension_max", p->tension},  {"thruster_power", p->power},
                   {"crushing_work", p->work},        {"kinetic_energy", p->energy}};
    for (size_t k = 0; k < sizeof of_both / sizeof *of_both; k++)
        if (strcmp(rows[i].channel, of_both[k].channel) == 0)
            return of_both[k].unit;
    return (load_unit){rows[i].unit, rows[i].factor};
}

/* Numbers of two spans are not those of two runs: where the recording of one began after its transient, both are told
   from the later of the two beginnings. */
static void find_spans(pair *p)
{
    bool late = false;
    for (int k = 0; k < 2; k++) {
        double recorded = run_recorded_from(&p->d[k]);
        late |= time_is_after(recorded, p->d[k].s.run.transient) && recorded > 0;
        p->from[k] = fmax(p->d[k].s.run.transient, recorded);
    }
    if (late)
        p->from[0] = p->from[1] = p->result->counted_from = fmax(p->from[0], p->from[1]);
    for (int k = 0; k < 2 && late; k++)
        p->result->no_time_shared |= !time_is_after(p->d[k].note.time, p->from[k]);
}

/* Where the last row is not of the end, what was then is not told as of the end. */
static void find_last_row(pair *p)
{
    double last[2];
    bool early = false;
    for (int k = 0; k < 2; k++) {
        last[k] = run_ends_after_row(&p->d[k]);
        early |= isfinite(last[k]);
        last[k] = fmin(last[k], p->d[k].note.time);
    }
    if (early && fabs(last[1] - last[0]) > 1e-6 * last[0])
        snprintf(p->last_row, sizeof p->last_row, "%.6g and %.6g s", last[0], last[1]);
    else if (early)
        snprintf(p->last_row, sizeof p->last_row, "%.6g s", last[0]);
}

/* "tug: x at the end", or "tug: x in the last row, at 7 s"; what counts up is told until then. */
static void name_row(const pair *p, size_t i, const char *vessel, char out[COMPARE_NAME_SIZE])
{
    const char *name = rows[i].name, *end = strstr(name, " at the end");
    int length = (int)(end ? (size_t)(end - name) : strlen(name));
    int n = snprintf(out, COMPARE_NAME_SIZE, "%.*s%s", (int)VESSEL_NAME_MOST, vessel, *vessel ? ": " : "");
    if (rows[i].what == LAST && p->last_row[0])
        snprintf(out + n, COMPARE_NAME_SIZE - (size_t)n, "%.*s %s the last row, at %s", length, name,
                 end ? "in" : "until", p->last_row);
    else
        snprintf(out + n, COMPARE_NAME_SIZE - (size_t)n, "%s", name);
}

/* Whether a vessel has what the channel is of: lines, thrusters, a place that it may keep, by its gear or a program's:
   no ship under way. */
static bool has_what_tells(const scenario *s, int32_t vessel, const char *channel)
{
    const scenario_vessel *v = scenario_vessel_entry(s, vessel).keys;
    if (strcmp(channel, "line_tension_max") == 0)
        return v->mooring.lines.count > 0;
    if (strcmp(channel, "thruster_power") == 0)
        return v->thrusters.count > 0;
    if (strncmp(channel, "offset_", 7) == 0)
        return v->mode == VESSEL_FREE && (station_has_results(s, vessel) || !vessel_drives_itself(v));
    return true;
}

/* Of none of the two runs' vessels. */
static bool is_of_neither(const pair *p, size_t i, const char *vessel)
{
    for (int k = 0; k < 2; k++) {
        const scenario *s = &p->d[k].s;
        int32_t v = *vessel ? scenario_find_vessel(s, vessel) : 0;
        if (v < 0 || v >= scenario_vessel_count(s))
            continue;
        if (has_what_tells(s, v, rows[i].channel))
            return false;
    }
    return true;
}

/* One measure of a channel in both runs; vessel: its name before a colon, or "". */
static void find_row(pair *p, size_t i, const char *channel, const char *vessel)
{
    double value[2];
    char name[COMPARE_NAME_SIZE];
    const load_unit unit = row_unit(p, i);
    if (is_of_neither(p, i, vessel))
        return;
    for (int k = 0; k < 2; k++)
        value[k] = measure_of(p, k, channel, rows[i].what) * unit.factor;
    const double largest = fmax(fabs(value[0]), fabs(value[1])), least = run_channel_least(rows[i].channel);
    for (int k = 0; k < 2; k++)
        value[k] = told_beside(value[k], largest, least * unit.factor);
    if (strcmp(rows[i].unit, "deg") == 0)
        value[1] = angle_next_to(value[0], value[1]);
    name_row(p, i, vessel, name);
    add_row(p, name, unit.name, strncmp(rows[i].channel, "position_", 9) == 0, value);
}

static int32_t named_vessels(const scenario *s) { return scenario_names_vessels(s) ? scenario_vessel_count(s) : 0; }

/* Vessels of lists are compared by name: those of the first run, and what the second has besides; NULL after them. */
static const scenario *next_vessel(const pair *p, int32_t at, int32_t *index)
{
    const scenario *first = &p->d[0].s, *second = &p->d[1].s;
    *index = at;
    if (at < named_vessels(first))
        return first;
    for (int32_t v = 0, besides = named_vessels(first); v < named_vessels(second); v++) {
        bool of_both = named_vessels(first) > 0 && scenario_find_vessel(first, scenario_vessel_name(second, v)) >= 0;
        *index = v;
        if (!of_both && besides++ == at)
            return second;
    }
    return NULL;
}

/* The largest size of a measure of a channel in both runs, of any vessel. */
static double largest_measure(const pair *p, const char *channel, measure what)
{
    double most = 0;
    const scenario *s;
    for (int k = 0; k < 2; k++) {
        most = fmax(most, fabs(measure_of(p, k, channel, what)));
        for (int32_t at = 0, v = 0; (s = next_vessel(p, at, &v)); at++)
            most = fmax(most, fabs(measure_of(p, k, vessel_channel_name(s, v, channel).text, what)));
    }
    return most;
}

static void choose_units(pair *p)
{
    static const char *const loads[] = {"ice_force_averaged_x", "ice_force_averaged_y"};
    double load = 0;
    for (int i = 0; i < 2; i++)
        load = fmax(load, fmax(largest_measure(p, loads[i], GREATEST), largest_measure(p, loads[i], LEAST)));
    p->load = kilonewtons_or_less(load);
    p->tension = kilonewtons_or_less(largest_measure(p, "line_tension_max", GREATEST));
    p->power = megawatts_or_less(largest_measure(p, "thruster_power", MEAN));
    p->work = kilojoules_or_less(largest_measure(p, "crushing_work", LAST));
    p->energy = kilojoules_or_less(largest_measure(p, "kinetic_energy", LAST));
}

static bool same_files(const run_note *a, const run_note *b)
{
    bool same = a->files.count == b->files.count;
    for (int32_t i = 0; same && i < a->files.count; i++)
        same = strcmp(a->files.data[i].digest, b->files.data[i].digest) == 0;
    return same;
}

/* What neither tells is not the same of both. */
static bool same_hash(const char *a, const char *b) { return a[0] && strcmp(a, b) == 0; }

/* Without an end there is no final state. */
static bool same_states(const run_data *d)
{
    return same_hash(d[0].note.state_hash, d[1].note.state_hash) && !run_is_open(&d[0]);
}

/* What a program told a run stands in place of the scenario, and with which numbers in no file: of two runs that were
   told the same things it shows in their ends. */
static bool told_the_same(const run_data *d)
{
    const text_buffer *a = &d[0].note.told, *b = &d[1].note.told;
    bool names = a->count == b->count && (a->count == 0 || memcmp(a->data, b->data, (size_t)a->count) == 0);
    return names && (a->count == 0 || same_states(d) || path_is_same(d[0].folder, d[1].folder));
}

/* The hash has files by their names alone; what is in them is told beside it.  A run of a Fram that lacked a key has
   another hash than one of the same scenario by this: there is what this one reads of both. */
static void compare_scenarios(const run_data *d, compare_result *out)
{
    const run_note *a = &d[0].note, *b = &d[1].note;
    bool noted = same_hash(a->scenario_hash, b->scenario_hash);
    bool names = noted || same_hash(d[0].scenario_hash, d[1].scenario_hash);
    bool files = same_files(a, b), told = told_the_same(d);
    for (int k = 0; k < 2; k++)
        run_told(&d[k], out->told[k]);
    out->same_scenario = noted && files && told;
    out->same_as_read = names && files && !noted && told;
    out->only_files_differ = names && !files && told;
    out->only_told_differs = names && files && !told;
    out->same_state = same_states(d);
    out->changed_a = d[0].is_changed;
    out->changed_b = d[1].is_changed;
}

static void find_rows(pair *p)
{
    const double time[2] = {p->d[0].note.time, p->d[1].note.time};
    const scenario *s;
    find_spans(p);
    choose_units(p);
    find_last_row(p);
    add_row(p, "simulated time", "s", false, time);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        find_row(p, i, rows[i].channel, "");
        for (int32_t at = 0, v = 0; (s = next_vessel(p, at, &v)); at++)
            find_row(p, i, vessel_channel_name(s, v, rows[i].channel).text, scenario_vessel_name(s, v));
    }
    compare_scenarios(p->d, p->result);
}

/* ---- page ---- */

typedef struct overlay {
    const char *channel, *title, *label;
    load_unit unit;
    bool free; /* its axis need not hold zero: far from the origin a way would not be seen */
} overlay;

/* vessel: "vessel tug"; "": of the world, or of the only one.  In the title a long name would be cut off. */
static fram_status overlay_chart(pair *p, const overlay *o, const char *vessel, fram_error *error)
{
    chart_line lines[2];
    double *scaled[2] = {NULL, NULL};
    static const char *const names[2] = {"A", "B"};
    char label[48], name[120];
    snprintf(name, sizeof name, "%s%s%s", o->title, *vessel ? ", " : "", vessel);
    snprintf(label, sizeof label, *o->unit.name ? "%s [%s]" : "%s%s", o->label, o->unit.name);
    int32_t n = 0;
    fram_status status = FRAM_OK;
    for (int k = 0; k < 2 && status == FRAM_OK; k++) {
        const double *value = run_channel(&p->d[k], o->channel);
        int32_t count = p->d[k].series.rows;
        if (!value || count == 0)
            continue;
        scaled[k] = memory_array(p->ctx, (size_t)count, sizeof *scaled[k]);
        if (!scaled[k])
            status = error_memory(error);
        for (int32_t i = 0; i < count && status == FRAM_OK; i++)
            scaled[k][i] = value[i] * o->unit.factor;
        lines[n] = chart_line_make(names[k], run_channel(&p->d[k], "time"), scaled[k], count, k == 1);
        lines[n++].colour = k + 2;
    }
    if (status == FRAM_OK && n > 0) {
        chart c = chart_make(o->title, vessel, "time [s]", label, lines, n);
        c.free_y = o->free;
        status = html_chart_named(&p->page, &c, name, false, error);
    }
    memory_free(p->ctx, scaled[0]);
    memory_free(p->ctx, scaled[1]);
    return status;
}

/* Of the world or the vessel, or one of each vessel of a list. */
static fram_status overlay_charts(pair *p, const overlay *o, fram_error *error)
{
    const scenario *s;
    fram_status status = overlay_chart(p, o, "", error);
    for (int32_t at = 0, v = 0; status == FRAM_OK && (s = next_vessel(p, at, &v)); at++) {
        const vessel_channel name = vessel_channel_name(s, v, o->channel);
        const vessel_entry entry = scenario_vessel_entry(s, v);
        const vessel_title title = vessel_title_of(&entry);
        overlay of_vessel = *o;
        of_vessel.channel = name.text;
        status = overlay_chart(p, &of_vessel, title.text, error);
    }
    return status;
}

static void number_table(pair *p)
{
    char span[64] = "after the transient";
    if (p->result->no_time_shared)
        html_paragraph(
            &p->page,
            "Nothing is of both after their transients and the beginnings of their recordings (from %.6g s on).",
            p->result->counted_from);
    if (p->result->counted_from > 0)
        snprintf(span, sizeof span, "after %.6g s, of what both recorded", p->result->counted_from);
    const char *const heads[] = {span, "A", "B", "B - A", "B / A"};
    html_table_begin(&p->page, heads, 5);
    for (int32_t i = 0; i < p->result->count; i++) {
        const compare_row *row = &p->result->row[i];
        char name[COMPARE_NAME_SIZE + UNIT_SIZE + 3];
        snprintf(name, sizeof name, row->unit[0] ? "%s [%s]" : "%s%s", row->name, row->unit);
        html_row_begin(&p->page);
        html_row_name(&p->page, name);
        (row->is_place ? html_place : html_number)(&p->page, row->a);
        (row->is_place ? html_place : html_number)(&p->page, row->b);
        html_number(&p->page, row->b - row->a);
        html_number(&p->page, row->a != 0 && !row->is_place ? row->b / row->a : (double)NAN);
        html_row_end(&p->page);
    }
    html_table_end(&p->page);
}

/* What was read of a changed scenario may be the same where what was run was not. */
static const char *unless_changed(const compare_result *r)
{
    bool read = r->same_as_read || r->only_files_differ || r->only_told_differs;
    return read && (r->changed_a || r->changed_b) ? ", or scenario.yaml was changed since" : "";
}

static fram_status compose_comparison(pair *p, fram_error *error)
{
    const overlay charts[] = {{"ice_force_averaged_x", "Ice load along X, averaged", "force", p->load, false},
                              {"ice_force_averaged_y", "Ice load along Y, averaged", "force", p->load, false},
                              {"position_x", "Position along X", "x", {"m", 1}, true},
                              {"position_y", "Position along Y", "y", {"m", 1}, true},
                              {"floes", "Floes", "floes", {"", 1}, false},
                              {"bendings", "Floes broken in bending", "floes so far", {"", 1}, false},
                              {"line_tension_max", "Largest line tension", "tension", p->tension, false},
                              {"crushing_work", "Work of crushing", "work", p->work, false}};
    html_begin(&p->page, "Comparison of two runs", "");
    html_table_begin(&p->page, NULL, 0);
    for (int k = 0; k < 2; k++)
        html_fact(&p->page, k ? "B" : "A", "%s: %s, %s, scenario %.12s, state %s", p->d[k].folder,
                  p->d[k].s.title[0] ? p->d[k].s.title : "no title", p->d[k].note.status, p->d[k].note.scenario_hash,
                  p->d[k].note.state_hash);
    for (int k = 0; k < 2; k++)
        if (p->d[k].is_changed)
            html_fact(&p->page, k ? "of B" : "of A", RUN_IS_CHANGED);
    for (int k = 0; k < 2; k++)
        if (p->result->told[k][0])
            html_fact(&p->page, k ? "told B by a program" : "told A by a program", "%s, in place of its scenario's",
                      p->result->told[k]);
    html_fact(&p->page, "scenarios", "%s%s",
              p->result->same_scenario       ? "the same"
              : p->result->same_as_read      ? "the same, as this Fram reads them"
              : p->result->only_files_differ ? "the same but for the files that they name"
              : p->result->only_told_differs ? "the same but for what a program told"
                                             : "different",
              unless_changed(p->result));
    html_fact(&p->page, "final states", "%s", p->result->same_state ? "identical to the bit" : "different");
    html_table_end(&p->page);
    html_section(&p->page, "Numbers");
    number_table(p);
    html_section(&p->page, "Time series");
    html_grid_begin(&p->page);
    fram_status status = FRAM_OK;
    for (size_t i = 0; i < sizeof charts / sizeof *charts && status == FRAM_OK; i++)
        status = overlay_charts(p, &charts[i], error);
    html_grid_end(&p->page);
    html_end(&p->page);
    return status == FRAM_OK && p->page.text.failed ? error_memory(error) : status;
}

fram_status compare_runs(context *ctx, const char *a, const char *b, const char *output, compare_result *result,
                         fram_error *error)
{
    pair p = {.ctx = ctx, .page = {.ctx = ctx}, .result = result};
    *result = (compare_result){0};
    fram_status status = run_data_read(ctx, a, false, NULL, &p.d[0], error);
    if (status != FRAM_OK)
        return status;
    status = run_data_read(ctx, b, false, NULL, &p.d[1], error);
    if (status != FRAM_OK) {
        run_data_free(ctx, &p.d[0]);
        return status;
    }
    for (int k = 0; k < 2; k++)
        run_warn_change(ctx, &p.d[k]);
    find_rows(&p);
    if (output) {
        status = compose_comparison(&p, error);
        if (status == FRAM_OK)
            status = work_continue(ctx, "comparing", 1, 1, error);
        if (status == FRAM_OK)
            status = text_file_write(ctx, output, &p.page.text, error);
    }
    html_free(&p.page);
    run_data_free(ctx, &p.d[0]);
    run_data_free(ctx, &p.d[1]);
    return status;
}
