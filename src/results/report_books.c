/* The report's sections on books, solver quality and origin. */
#include "base/load_unit.h"
#include "results/report_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static double last_of(const report *r, const char *channel)
{
    const double *value = run_channel(&r->d, channel);
    return value && r->d.series.rows > 0 ? value[r->d.series.rows - 1] : (double)NAN;
}

/* Row of the series at a time, within half a step; -1: there is none. */
static int32_t row_at(const report *r, double time)
{
    const double *at = run_channel(&r->d, "time");
    for (int32_t i = 0; at && i < r->d.series.rows; i++) {
        if (fabs(at[i] - time) <= 0.5 * r->d.s.run.time_step)
            return i;
    }
    return -1;
}

/* What a book grew by between two rows, from -1: since the start; 0 for one that the run does not have. */
static double growth(const report *r, const char *channel, int32_t from, int32_t to)
{
    const double *value = run_channel(&r->d, channel);
    double by = value ? value[to] - (from < 0 ? 0 : value[from]) : 0;
    return isfinite(by) ? by : 0;
}

static void book_row(report *r, const char *name, double value, const char *unit)
{
    char text[HTML_NUMBER_SIZE], all[64];
    html_number_text(value, text);
    snprintf(all, sizeof all, "%s %s", text, unit);
    html_row_begin(&r->page);
    html_row_name(&r->page, name);
    html_cell(&r->page, all);
    html_row_end(&r->page);
}

/* "ice_mass_left" as "ice mass left". */
static void spoken(const char *name, char out[COLUMN_NAME_SIZE])
{
    snprintf(out, COLUMN_NAME_SIZE, "%s", name);
    for (char *c = out; *c; c++)
        *c = *c == '_' ? ' ' : *c;
}

/* Every channel of a book: those that begin or end with a word. */
static void book_channels(report *r, const char *begins, const char *ends, double factor, const char *unit)
{
    for (int32_t i = 0; i < r->d.series.columns.count; i++) {
        const char *name = r->d.series.columns.data[i].name;
        size_t length = strlen(name), tail = strlen(ends);
        bool fits = (*begins && strncmp(name, begins, strlen(begins)) == 0) ||
                    (*ends && length >= tail && strcmp(name + length - tail, ends) == 0);
        char text[COLUMN_NAME_SIZE];
        spoken(name, text);
        if (fits)
            book_row(r, text, last_of(r, name) * factor, unit);
    }
}

/* What is left between the masses of two frames when the books of the same two moments are closed.  Frames and rows of
   the series come at times of their own: where no row is at a frame's time, nothing is said of it. */
static void mass_balance(report *r)
{
    const field_state *a = &r->d.before, *b = &r->d.after;
    /* The series begins after the first step, and its books with 0 before it. */
    bool from_start = a->time == 0;
    int32_t from = from_start ? -1 : row_at(r, a->time), to = row_at(r, b->time);
    static const struct {
        const char *channel;
        double sign;
    } books[] = {{"ice_mass_entered", 1}, {"ice_mass_gained", 1},   {"ice_mass_left", -1},
                 {"ice_mass_lost", -1},   {"ice_mass_crushed", -1}, {"brash_mass", -1}};
    if ((from < 0 && !from_start) || to < 0) {
        html_row_begin(&r->page);
        html_row_name(&r->page, "not accounted for");
        html_cell(&r->page, "unknown: no row of the series is at the time of the last frame");
        html_row_end(&r->page);
        return;
    }
    double open = a->mass - b->mass;
    for (size_t i = 0; i < sizeof books / sizeof *books; i++)
        open += books[i].sign * growth(r, books[i].channel, from, to);
    book_row(r, "not accounted for at the last frame", open * 1e-3, "t");
    book_row(r, "of the mass at the start", 100 * open / a->mass, "%");
}

/* "at the end", or when the last row was, where the run went on after it. */
static const char *last_row_words(const report *r, char out[48])
{
    double row = run_ends_after_row(&r->d);
    snprintf(out, 48, isfinite(row) ? "in the last row, at %.6g s" : "at the end", row);
    return out;
}

static void mass_books(report *r)
{
    const field_state *a = &r->d.before, *b = &r->d.after;
    bool know = r->d.frames > 0 && r->d.series.rows > 0;
    char when[48];
    const char *const heads[] = {"mass of ice", last_row_words(r, when)};
    html_table_begin(&r->page, heads, 2);
    if (know) {
        book_row(r, "in the field at the first frame", a->mass * 1e-3, "t");
        book_row(r, "in the field at the last frame", b->mass * 1e-3, "t");
    }
    book_channels(r, "ice_mass_", "brash_mass", 1e-3, "t");
    if (know && a->mass > 0)
        mass_balance(r);
    html_table_end(&r->page);
}

static fram_status solver_quality(report *r, fram_error *error)
{
    const report_line residual[] = {{"solver_residual", "residual"}};
    const report_line overlap[] = {{"overlap_max", "largest"}, {"overlap_mean", "mean"}};
    html_section(&r->page, "Quality of the solution");
    report_statistics_heads(r, "each step");
    report_statistics(r, "solver_residual", "residual of the contact problem [m/s]", 1);
    report_statistics(r, "solver_iterations", "sweeps of the contact solver", 1);
    report_statistics(r, "overlap_mean", "mean overlap of touching bodies [m]", 1);
    report_statistics(r, "overlap_max", "largest overlap [m]", 1);
    report_statistics(r, "contacts", "contact points", 1);
    report_statistics(r, "step_wall_time", "computing time of a step [ms]", 1e3);
    html_table_end(&r->page);
    html_grid_begin(&r->page);
    fram_status status = report_series(r, "Residual", "residual [m/s]", 1, residual, 1, false, error);
    if (status == FRAM_OK)
        status = report_series(r, "Overlap", "overlap [m]", 1, overlap, 2, false, error);
    html_grid_end(&r->page);
    return status;
}

static void origin(report *r)
{
    const run_note *n = &r->d.note;
    html_section(&r->page, "Origin");
    html_table_begin(&r->page, NULL, 0);
    html_fact(&r->page, "Fram", "%s, %s", n->version, n->compiler);
    html_fact(&r->page, "libraries", "%s", n->libraries);
    html_fact(&r->page, "computed with", "%.0f thread%s, %s; results depend on neither", n->threads,
              n->threads == 1 ? "" : "s", n->isa);
    html_fact(&r->page, "scenario", "SHA-256 %s", n->scenario_hash);
    if (!run_is_open(&r->d))
        html_fact(&r->page, "state at the end", "hash %s", n->state_hash);
    html_fact(&r->page, "status", "%s%s%s", n->status, n->message[0] ? ": " : "", n->message);
    html_fact(&r->page, "steps", "%.0f of %g s", n->steps, r->d.s.run.time_step);
    if (!run_is_open(&r->d))
        html_fact(&r->page, "computing time", "%.1f s in the last call, %.2g %% of it for what the run wrote", n->wall,
                  n->wall > 0 ? 100 * n->recording / n->wall : 0);
    if (n->step_longest > 0)
        html_fact(
            &r->page, "computing time of a step",
            "median %.3g ms, 99 %% under %.3g ms, 99.9 %% under %.3g ms, the longest %.3g ms; by the clock, in the "
            "last call, recording apart",
            n->step_median, n->step_p99, n->step_p999, n->step_longest);
    html_table_end(&r->page);
}

/* The unit of energies goes by the largest one of the run, so that those of a model are seen. */
static load_unit energy_unit(const report *r, const report_line *lines, int32_t count)
{
    double most = 0;
    for (int32_t k = 0; k < count; k++) {
        const double *value = run_channel(&r->d, lines[k].channel);
        for (int32_t i = 0; value && i < r->d.series.rows; i++)
            most = fmax(most, fabs(value[i]));
    }
    return kilojoules_or_less(most);
}

fram_status report_books(report *r, fram_error *error)
{
    const report_line energy[] = {{"crushing_work", "dissipated by crushing"}, {"kinetic_energy", "kinetic"}};
    html_section(&r->page, "Mass and energy");
    mass_books(r);
    char when[48];
    const char *const heads[] = {"energy", last_row_words(r, when)};
    html_table_begin(&r->page, heads, 2);
    const load_unit unit = energy_unit(r, energy, sizeof energy / sizeof *energy);
    book_channels(r, "energy_", "_energy", unit.factor, unit.name);
    book_channels(r, "work_", "_work", unit.factor, unit.name);
    html_table_end(&r->page);
    html_grid_begin(&r->page);
    char label[24];
    snprintf(label, sizeof label, "energy [%s]", unit.name);
    fram_status status = report_series(r, "Energy", label, unit.factor, energy, 2, true, error);
    html_grid_end(&r->page);
    if (status == FRAM_OK)
        status = solver_quality(r, error);
    origin(r);
    return status;
}
