/* The report's verdict: what a reader must know before the numbers, and what to do about it. */
#include "results/report_verdict_parts.h"

#include "base/channel_statistics.h"
#include "base/student.h"
#include "io/velocity_file.h"
#include "results/ice_contact.h"
#include "results/load_shares.h"
#include "results/mechanism_curve.h"
#include "results/run_record.h"
#include "results/track_results.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void verdict_find(verdict *v, verdict_grade grade, const char *remedy, const char *format, ...)
{
    finding f = {.grade = grade};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(f.text, sizeof f.text, format, arguments);
    va_end(arguments);
    if (f.text[0] >= 'a' && f.text[0] <= 'z')
        f.text[0] = (char)(f.text[0] - 'a' + 'A');
    snprintf(f.remedy, sizeof f.remedy, "%s", remedy);
    v->failed = !array_push(v->r->ctx, &v->findings, f) || v->failed;
}

const char *verdict_whose(const report *r, char out[48])
{
    const scenario *s = &r->d.s;
    bool named = scenario_names_vessels(s);
    snprintf(out, 48, "%s%.*s%s", named ? "vessel " : "", (int)VESSEL_NAME_MOST,
             named ? scenario_vessel_entry(s, r->vessel).keys->name : "", named ? ": " : "");
    return out;
}

/* ---- the run's folder ---- */

static void judge_folder(verdict *v)
{
    if (v->r->d.is_changed)
        verdict_find(v, VERDICT_CAUTION, "Restore it, or make the run again.", "The run's " RUN_IS_CHANGED ".");
    if (v->r->d.lacks_record)
        verdict_find(v, VERDICT_NOTE, "fram run with its scenario.yaml makes it again, with one.",
                     RUN_WITHOUT_RECORD ": nothing is told of its ice field.");
    if (run_is_cut_off(&v->r->d))
        verdict_find(v, VERDICT_BAD, "Run the scenario again.", "The run's " RUN_IS_CUT_OFF ".", v->r->d.note.steps);
}

/* ---- the end of the run ---- */

static void judge_end(verdict *v)
{
    const run_note *n = &v->r->d.note;
    if (strcmp(n->status, "finished") == 0)
        return;
    bool failed = strcmp(n->status, "failed") == 0, open = run_is_open(&v->r->d);
    const char *how = failed ? "failed at" : open ? "goes on, or was killed: it came to" : "stopped at";
    verdict_find(v, failed ? VERDICT_BAD : VERDICT_CAUTION,
                 failed ? "Results up to the failure are valid; the message says what went wrong."
                 : open ? "fram resume continues one that was killed from its newest checkpoint."
                        : "fram resume continues from the newest checkpoint.",
                 "The run %s %.4g s of %.4g s%s%s.", how, n->time, v->r->d.s.run.duration, n->message[0] ? ": " : "",
                 n->message);
}

/* A hull at a wall measures the wall, and one at the band of a field ice that nothing pushes aside: the run's own
   events, found by their kinds in run.json. */
static void judge_walls(verdict *v)
{
    const run_note *n = &v->r->d.note;
    for (int32_t i = 0; i < n->events.count; i++) {
        const run_event *e = &n->events.data[i];
        if (strcmp(e->kind, "wall") == 0)
            verdict_find(v, VERDICT_BAD,
                         "Loads and motion after that are those of a wall, not of ice: enlarge the domain, shorten "
                         "run.duration or give another course.",
                         "%s%s ran into a wall of the domain at %.4g s.", e->vessel[0] ? "Vessel " : "The vessel",
                         e->vessel, e->time);
        else if (strcmp(e->kind, "band") == 0)
            verdict_find(
                v, VERDICT_BAD,
                "Loads and motion after that are not those of ice that gives way: enlarge the domain or shorten "
                "run.duration.",
                "%s%s reached the band of the ice field, whose floes nothing pushes aside, at %.4g s.",
                e->vessel[0] ? "Vessel " : "The vessel", e->vessel, e->time);
    }
}

static void judge_tracks(verdict *v)
{
    const run_note *n = &v->r->d.note;
    for (int32_t i = 0; i < n->tracks.count; i++) {
        const run_track *t = &n->tracks.data[i];
        char text[VERDICT_TEXT_SIZE];
        track_text(t, text, sizeof text);
        verdict_find(v, track_was_kept(t) ? VERDICT_GOOD : VERDICT_CAUTION, track_remedy(t), "%s", text);
    }
}

/* No part of the ice load: another hull, or a wall, met the vessel, the transient included. */
static void judge_hulls(verdict *v)
{
    const report *r = v->r;
    const double *time = run_channel(&r->d, "time"), *x = run_vessel_channel(&r->d, r->vessel, "hull_contact_force_x"),
                 *y = run_vessel_channel(&r->d, r->vessel, "hull_contact_force_y");
    double largest = 0, first = HUGE_VAL, at = 0;
    for (int32_t i = 0; time && x && y && i < r->d.series.rows; i++) {
        double size = sqrt(x[i] * x[i] + y[i] * y[i]);
        first = size > 0 ? fmin(first, time[i]) : first;
        at = size > largest ? time[i] : at;
        largest = fmax(largest, size);
    }
    char name[48];
    if (largest > 0)
        verdict_find(v, VERDICT_NOTE, "It is no part of the ice load: hull_contact_force_* of the series.",
                     "%sanother hull or a wall touched it, first at %.6g s: largest horizontal force %s, at %.6g s.",
                     verdict_whose(r, name), first, load_text_of(largest, VERDICT_DIGITS).text, at);
}

/* ---- loads, and how sure they are ---- */

static void judge_transient(verdict *v)
{
    const run_data *d = &v->r->d;
    int rows = (int)(d->series.rows - run_first_row(d));
    if (rows < 2 && !run_is_cut_off(d))
        verdict_find(v, VERDICT_CAUTION,
                     d->series.rows > 1 ? "Make run.transient shorter or the run longer."
                                        : "Make output.csv_interval or run.transient shorter, or the run longer.",
                     "%d of %d rows of the run are after the transient of %.4g s: its statistics are of these alone.",
                     rows, (int)d->series.rows, d->s.run.transient);
}

/* A mean within this part of itself, at 95 %, by so many independent values, is enough for most uses. */
#define ENOUGH 0.2
#define VALUES_ENOUGH 10.0

/* The part of itself within which a mean is known, by the deviation as a part of it: Student's t of as many values as
   are told; one alone does not tell. */
static double mean_within(double spread, double values)
{
    int freedom = (int)(values + 0.5) - 1;
    return freedom < 1 ? HUGE_VAL : student_quantile(0.95, freedom) * spread / sqrt(values);
}

/* Values that would be enough, on the safe side: the t is that of as few as the normal law asks for. */
static double values_needed(double spread)
{
    double normal = NORMAL_95 * spread / ENOUGH, few = fmin(fmax(normal * normal, VALUES_ENOUGH), INT32_MAX / 2);
    double within = mean_within(spread, few);
    return fmax(few * within * within / (ENOUGH * ENOUGH), VALUES_ENOUGH);
}

/* No load in any row after the transient: rows that leave out steps may have missed one, the peaks have not. */
static fram_status judge_no_load(verdict *v, const char *name, fram_error *error)
{
    const report *r = v->r;
    peak_list list;
    fram_status status = report_peaks(v->r, &list, error);
    if (status != FRAM_OK)
        return status;
    if (list.count > 0) {
        const peak_detail *most = list.peak[0];
        verdict_find(v, VERDICT_CAUTION, "Make output.csv_interval shorter: figures here are those of the series.",
                     "%sno row of the series has an ice load, but one of %s came between them, at %.10g s.", name,
                     load_text_of(most->load, VERDICT_DIGITS).text, most->time);
    } else if (r->peaks_unread && run_leaves_out_steps(&r->d))
        verdict_find(v, VERDICT_CAUTION, "Run the scenario again, or read the run with the Fram that made it.",
                     "%sno row of the series has an ice load; whether one came between them is not known, since "
                     "peaks.fram cannot be read.",
                     name);
    else
        verdict_find(v, VERDICT_CAUTION, "Does the ice reach the vessel, and does either move?",
                     "%sno ice load occurred.", name);
    peak_list_free(r->ctx, &list);
    return FRAM_OK;
}

/* Rows count from the first one on, for a span [s]. */
static void judge_window(verdict *v, const char *name, double first, double span)
{
    const scenario *s = &v->r->d.s;
    if (scenario_averages_begin_early(s, first, span))
        verdict_find(v, VERDICT_CAUTION, "Make output.averaging_window shorter, or run.transient longer.",
                     "%sthe averaging window of %.4g s is longer than the transient of %.4g s: the mean contains what "
                     "was before it, and before the start no load.",
                     name, scenario_averaging_window(s), s->run.transient);
}

/* What is about so much: three digits of four before the point, and an exponent from a million on. */
static void rough_number(double value, char out[32])
{
    if (value < 1e6)
        report_number(value < 1000 ? value : floor(value / 10 + 0.5) * 10, out);
    else
        snprintf(out, 32, "%.3g", value);
}

static fram_status judge_load(verdict *v, fram_error *error)
{
    const report *r = v->r;
    const double *time = run_channel(&r->d, "time");
    int32_t first = run_first_row(&r->d), rows = r->d.series.rows - first;
    if (!time || rows < 2 || first >= r->load.count)
        return FRAM_OK;
    channel_statistics s = channel_statistics_of(time, r->load.data, r->load.count, r->d.s.run.transient);
    /* Each value stands for a step. */
    double step = (time[first + rows - 1] - time[first]) / (rows - 1), span = step * rows;
    char name[48], remedy[VERDICT_TEXT_SIZE], needed[32];
    verdict_whose(r, name);
    const load_text mean = load_text_of(s.mean, VERDICT_DIGITS), most = load_text_of(s.greatest, VERDICT_DIGITS);
    if (!scenario_names_vessels(&r->d.s))
        snprintf(v->load, sizeof v->load, " Ice load: mean %s, largest %s.", mean.text, most.text);
    if (!(s.greatest > 0))
        return judge_no_load(v, name, error);
    load_distribution d;
    if (!load_distribution_of(r->ctx, r->load.data + first, rows, step, scenario_averaging_window(&r->d.s), &d)) {
        load_distribution_free(r->ctx, &d);
        return error_memory(error);
    }
    double spread = s.mean > 0 ? s.deviation / s.mean : HUGE_VAL, part = mean_within(spread, d.independent);
    bool enough = part <= ENOUGH && d.independent >= VALUES_ENOUGH;
    rough_number(span * values_needed(spread) / d.independent, needed);
    char aim[48], worth[LOAD_WORTH_SIZE];
    load_distribution_tell(&d, false, worth);
    snprintf(aim, sizeof aim, part > ENOUGH ? "a mean within %.0f %%" : "%.0f independent values",
             part > ENOUGH ? 100 * ENOUGH : VALUES_ENOUGH);
    snprintf(remedy, sizeof remedy,
             "About %s s after the transient, or as much over several seeds (fram study), would give %s.", needed, aim);
    verdict_find(v, enough ? VERDICT_GOOD : VERDICT_CAUTION, enough ? "" : remedy,
                 "%smean ice load %s, known within %.0f %% (95 %% confidence, %s in %.4g s): %s.", name, mean.text,
                 fmin(100 * part, 999), worth, span,
                 enough           ? "enough for a mean"
                 : part <= ENOUGH ? "too few values to trust that"
                                  : "too short for a mean");
    judge_window(v, name, time[first], span);
    verdict_find(
        v, VERDICT_NOTE,
        "The largest value of one run is a single sample: see several seeds, or fram extremes, for its scatter.",
        "%slargest ice load %s, averaged over %.3g s, after %.4g s.", name, most.text,
        scenario_averaging_window(&r->d.s), r->d.s.run.transient);
    load_distribution_free(r->ctx, &d);
    return FRAM_OK;
}

/* ---- the numbers behind ---- */

/* Mean size of a vector of two after the transient; 0 where it is not known. */
static double mean_size(const report *r, const double *x, const double *y)
{
    int32_t first = run_first_row(&r->d), rows = r->d.series.rows - first;
    double sum = 0;
    for (int32_t i = first; x && y && i < first + rows; i++)
        sum += sqrt(x[i] * x[i] + y[i] * y[i]);
    return rows > 0 ? sum / rows : 0;
}

/* Mean speed of a current at the surface after the transient that files have a part in; 0 where they cannot be read. */
static double mean_current_of_files(const report *r, const ice_drift *current)
{
    const double *time = run_channel(&r->d, "time");
    int32_t first = run_first_row(&r->d), rows = r->d.series.rows - first;
    const media still = {.current = scenario_velocity(current->speed, current->towards_deg)};
    media_history files = {0};
    double sum = 0;
    if (velocity_file_read(r->ctx, &r->d.s, current->file, &files.current, NULL) == FRAM_OK &&
        velocity_profile_read(r->ctx, &r->d.s, current->profile, &files.profile, NULL) == FRAM_OK)
        for (int32_t i = first; time && i < first + rows; i++) {
            const media now = media_at(&still, &files, time[i]);
            sum += vec3_length(media_current(&now, 0));
        }
    media_history_free(r->ctx, &files);
    return rows > 0 ? sum / rows : 0;
}

/* Of the current, and of the drift of ice. */
static double flow_speed(const report *r)
{
    const ice_drift current = scenario_current(&r->d.s), drift = scenario_drift(&r->d.s);
    double water = ice_drift_is_of_keys(&current) ? current.speed : mean_current_of_files(r, &current),
           ice = ice_drift_is_of_keys(&drift)
                     ? drift.speed
                     : mean_size(r, run_channel(&r->d, "drift_x"), run_channel(&r->d, "drift_y"));
    return fmax(water, ice);
}

/* Of a ship on a path or under its own power the series knows the speed. */
static double approach_speed(const report *r)
{
    const scenario *s = &r->d.s;
    double most = flow_speed(r);
    for (int32_t i = 0; i < scenario_vessel_count(s); i++) {
        const scenario_vessel *v = scenario_vessel_entry(s, i).keys;
        most = fmax(most, v->speed);
        if (v->path.count > 0 || vessel_drives_itself(v))
            most = fmax(most, mean_size(r, run_vessel_channel(&r->d, i, "velocity_x"),
                                        run_vessel_channel(&r->d, i, "velocity_y")));
    }
    return most;
}

/* docs/limits.md: a residual that stays at the size of the speeds at which bodies meet is no solution; this part of
   them is small. */
#define RESIDUAL_SMALL 0.05

static void judge_solver(verdict *v)
{
    const report *r = v->r;
    const double *time = run_channel(&r->d, "time"), *residual = run_channel(&r->d, "solver_residual");
    double speed = approach_speed(r);
    if (!time || !residual || run_first_row(&r->d) == r->d.series.rows)
        return;
    double mean = channel_statistics_of(time, residual, r->d.series.rows, r->d.s.run.transient).mean;
    if (!(speed > 0)) {
        verdict_find(v, VERDICT_NOTE, "It is small if it is a few hundredths of the approach speed of the bodies.",
                     "The mean residual of the contact solver is %.2g m/s.", mean);
        return;
    }
    bool good = mean <= RESIDUAL_SMALL * speed;
    verdict_find(v, good ? VERDICT_GOOD : VERDICT_CAUTION,
                 good ? ""
                      : "Compare with half of run.time_step and twice run.solver.iterations before trusting peaks.",
                 "The contact solver %s: mean residual %.2g m/s, %s%.2g %% of the approach speed of %.3g m/s.",
                 good ? "converged" : "did not converge well", mean, mean < 1e-4 * speed ? "less than " : "",
                 fmax(100 * mean / speed, 0.01), speed);
}

/* ---- the edge of the field ---- */

/* Part of the mean load from which on the edge of the domain takes part in it. */
#define EDGE_PART 0.1

/* Part of the mean load that comes through chains to bodies that do not give way; 0 where the run does not say. */
static double chain_part(const report *r)
{
    mechanism_columns c;
    double share[MECHANISM_COUNT] = {0};
    if (mechanism_columns_find(&r->d, r->vessel, &c))
        load_shares(&r->d, c.x, c.y, MECHANISM_COUNT, share);
    return share[MECHANISM_CHAIN];
}

/* Floes in an endless field are driven at its edge, whatever pushes: a chain from the hull to there is a load of the
   domain's size.  In level ice the sheet itself stands there. */
static void judge_edge(verdict *v)
{
    const report *r = v->r;
    const scenario *s = &r->d.s;
    if (s->domain.boundary != DOMAIN_FEEDING || s->ice.source == ICE_NONE || s->ice.source == ICE_LEVEL)
        return;
    double part = chain_part(r);
    if (part > EDGE_PART)
        verdict_find(
            v, VERDICT_CAUTION, "Enlarge the domain until the load no longer depends on it; fram why shows chains.",
            "%.0f %% of the mean ice load on %s comes through chains of floes that end at the driven edge of the "
            "domain%s.",
            100 * part, report_vessel(r).text, scenario_vessel_count(s) > 1 ? " or at another vessel" : "");
}

/* ---- ice that left ---- */

/* Of what counts of a run, and longer than ever before between two contacts: ice has gone, and is not only scarce. */
#define QUIET_PART 0.1
/* Of the floes of the start; where ice breaks they grow in number, which hides that it leaves and never tells so. */
#define MOST_FLOES_LEFT 0.5

/* Nothing comes into an open domain: past a vessel on station the ice drifts away, and what is averaged after that is
   open water.  One that goes, or is led out of the domain, leaves its ice on purpose. */
static void judge_ice_left(verdict *v)
{
    const report *r = v->r;
    const scenario *s = &r->d.s;
    const scenario_vessel *keys = scenario_vessel_entry(s, r->vessel).keys;
    const double *time = run_channel(&r->d, "time"), *floes = run_channel(&r->d, "floes");
    int32_t first = run_first_row(&r->d), rows = r->d.series.rows;
    bool required = !is_automatic(keys->station.offset_limit) && !vessel_drives_itself(keys);
    if (s->domain.boundary != DOMAIN_OPEN || !scenario_ice_is_field(&s->ice) || !time || !floes || rows - first < 2 ||
        r->load.count < rows || !(vessel_is_held(keys) || required) || scenario_vessel_leaves(s, keys))
        return;
    const ice_contact c = ice_contact_of(time, r->load.data, rows);
    bool is_quiet = c.quiet > QUIET_PART * (time[rows - 1] - time[first]) && c.quiet > c.longest;
    bool has_left = floes[rows - 1] < MOST_FLOES_LEFT * floes[0], met = c.last < HUGE_VAL;
    char name[48], last[64] = "no ice touched it";
    if (met)
        snprintf(last, sizeof last, "ice last touched it at %.6g s of %.6g s", c.last, time[rows - 1]);
    /* A ship in ice to the end has its mean of ice, however much of the field lies behind it. */
    if ((is_quiet && floes[rows - 1] < floes[0]) || (!met && has_left))
        verdict_find(v, VERDICT_CAUTION,
                     "For ice that drifts past it take domain.boundary: feeding, else enlarge the domain or shorten "
                     "run.duration.",
                     "%s%s, and the open domain has %.0f of %.0f floes left: means, and how it kept its station, are "
                     "of open water too.",
                     verdict_whose(r, name), last, floes[rows - 1], floes[0]);
}

/* ---- the box ---- */

static verdict_grade headline(const verdict *v, char out[VERDICT_TEXT_SIZE])
{
    const report *r = v->r;
    bool finished = strcmp(r->d.note.status, "finished") == 0;
    char lines[80] = "";
    if (v->parted > 0)
        snprintf(lines, sizeof lines, " %d of %d lines parted or were released.", (int)v->parted, (int)v->lines);
    else if (v->lines > 1)
        snprintf(lines, sizeof lines, " No line of %d parted.", (int)v->lines);
    else if (v->lines == 1)
        snprintf(lines, sizeof lines, " The line did not part.");
    bool several = scenario_vessel_count(&r->d.s) > 1;
    const char *who = !several ? "The vessel" : v->lost || v->unsure ? "A vessel" : "Every vessel with a limit";
    char held[96], since[40] = "";
    double from = run_recorded_from(&r->d);
    if (from > 0)
        snprintf(since, sizeof since, " from %.6g s on", from);
    snprintf(held, sizeof held, " held its station%s%s.", since, finished ? "" : " as far as the run went");
    const char *did = v->lost ? " did not hold its station." : v->unsure ? " may not have held its station." : held;
    const char *end = finished ? "The run finished." : "The run has not finished.";
    snprintf(out, VERDICT_TEXT_SIZE, "%s%s%s%s", v->kept ? who : end, v->kept ? did : "", lines,
             v->kept ? "" : v->load);
    verdict_grade worst = VERDICT_GOOD;
    for (int32_t i = 0; i < v->findings.count; i++)
        worst = v->findings.data[i].grade > worst ? v->findings.data[i].grade : worst;
    return worst;
}

fram_status report_verdict(report *r, fram_error *error)
{
    char title[VERDICT_TEXT_SIZE];
    verdict v = {.r = r};
    fram_status status = FRAM_OK;
    judge_folder(&v);
    judge_end(&v);
    judge_walls(&v);
    judge_tracks(&v);
    judge_transient(&v);
    for (int32_t i = 0; i < scenario_vessel_count(&r->d.s) && status == FRAM_OK; i++) {
        status = report_choose_vessel(r, i, error);
        if (status == FRAM_OK)
            verdict_station(&v);
        if (status == FRAM_OK)
            judge_hulls(&v);
        if (status == FRAM_OK && r->d.s.ice.source != ICE_NONE)
            status = judge_load(&v, error);
        if (status == FRAM_OK)
            judge_edge(&v);
        if (status == FRAM_OK)
            judge_ice_left(&v);
    }
    judge_solver(&v);
    if (status == FRAM_OK && v.failed)
        status = error_memory(error);
    verdict_grade grade = headline(&v, title);
    html_verdict_begin(&r->page, grade, title);
    for (int32_t i = 0; i < v.findings.count; i++) {
        const finding *f = &v.findings.data[i];
        html_verdict_line(&r->page, f->grade, f->text, f->remedy);
    }
    html_verdict_end(&r->page);
    array_free(r->ctx, &v.findings);
    return status;
}
