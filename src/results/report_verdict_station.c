/* What the report's verdict says of keeping station: limits, lines, thrusters. */
#include "results/report_verdict_parts.h"

#include "base/channel_statistics.h"
#include "results/limit_use.h"
#include "results/station_results.h"

#include <math.h>
#include <stdio.h>

/* What would hold the vessel better, of what it has and what somebody orders. */
static const char *station_remedy(const verdict *v)
{
    const scenario_vessel *keys = scenario_vessel_entry(&v->r->d.s, v->r->vessel).keys;
    bool lines = keys->mooring.lines.count > 0, thrusters = keys->thrusters.count > 0 && keys->positioning.active;
    if (v->r->d.note.told.count > 0)
        return "Examine the loads at that time (fram why), and what the program that steered the run did.";
    if (thrusters && lines)
        return "Examine the loads at that time (fram why); consider more thrust, stiffer lines or ice management.";
    if (thrusters)
        return "Examine the loads at that time (fram why); consider more thrust or ice management.";
    if (lines)
        return "Examine the loads at that time (fram why); consider stiffer lines or ice management.";
    if (keys->thrusters.count > 0)
        return "Examine the loads at that time (fram why): nobody gives its thrusters orders (vessel.positioning).";
    return "Examine the loads at that time (fram why): nothing holds the vessel there, neither lines nor thrusters.";
}

/* Rows after the transient are beyond it. */
static void judge_beyond(verdict *v, const char *what, const char *unit, limit_use u, double limit)
{
    char most[32], name[48], when[128];
    report_number(u.most, most);
    if (isfinite(u.since))
        snprintf(when, sizeof when,
                 "was beyond its limit of %.4g %s already at the end of the transient (since %.6g s)", limit, unit,
                 u.since);
    else
        snprintf(when, sizeof when, "passed its limit of %.4g %s, first at %.6g s", limit, unit, u.first);
    verdict_find(v, VERDICT_BAD, station_remedy(v), "%sthe %s %s: largest %s %s, exceeded for %.3g %% of the time.",
                 verdict_whose(v->r, name), what, when, most, unit, 100 * u.part);
}

static void judge_limit(verdict *v, const char *what, const char *unit, limit_use u, double limit, const char *key)
{
    char most[32], name[48];
    report_number(u.most, most);
    verdict_whose(v->r, name);
    if (is_automatic(limit)) {
        verdict_find(v, VERDICT_NOTE, "", "%slargest %s %s %s; %s is not set, so it is not judged.", name, what, most,
                     unit, key);
        return;
    }
    v->kept = true;
    v->lost |= isfinite(u.first);
    v->unsure |= u.unsure;
    if (u.unsure)
        verdict_find(v, VERDICT_CAUTION,
                     run_leaves_out_steps(&v->r->d) ? "Make output.csv_interval shorter to see."
                                                    : "Record it from its start.",
                     "%sthe %s may have been beyond its limit of %.4g %s from %.6g s on, %s; the rows reach %s %s.",
                     name, what, limit, unit, v->r->d.s.run.transient,
                     limit_use_between_rows(&v->r->d, v->r->d.s.run.transient), most, unit);
    else if (isfinite(u.first) && !(u.most > limit))
        verdict_find(v, VERDICT_BAD,
                     u.first < run_recorded_from(&v->r->d) ? ""
                                                           : "Make output.csv_interval shorter to see by how much.",
                     "%sthe %s passed its limit of %.4g %s at %.6g s, %s; the rows reach %s %s.", name, what, limit,
                     unit, u.first, limit_use_between_rows(&v->r->d, u.first), most, unit);
    else if (u.most > limit)
        judge_beyond(v, what, unit, u, limit);
    else
        verdict_find(v, VERDICT_GOOD, "", "%slargest %s %s %s, within its limit of %.4g %s (%.0f %%).", name, what,
                     most, unit, limit, unit, limit > 0 ? 100 * u.most / limit : 0);
}

/* Of the breaking load of a line: 1 / 1.67, the factor of safety of an intact mooring (API RP 2SK). */
#define LINE_USE 0.6
/* Of the time, at their limit. */
#define THRUSTERS_FULL 0.05

typedef struct lines_use {
    int32_t number, unjudged; /* of the lines; of those without a breaking load */
    int32_t used, tightest;   /* the line with the largest part of its breaking load, and with the largest tension */
    double use, tension;      /* that part, and its tension [N] */
    double largest;           /* [N] after the transient */
} lines_use;

static double tension_from(const double *tension, int32_t first, int32_t rows)
{
    double most = 0;
    for (int32_t row = first; tension && row < rows; row++)
        most = fmax(most, tension[row]);
    return most;
}

/* The next line; gone: lines parted or were let go. */
static void use_line(const report *r, double breaking_load, bool gone, lines_use *u)
{
    char channel[40];
    snprintf(channel, sizeof channel, "line_%d_tension", ++u->number);
    const double *t = run_vessel_channel(&r->d, r->vessel, channel);
    int32_t rows = r->d.series.rows, first = run_first_row(&r->d);
    bool whole = gone && t && !(t[rows - 1] > 0); /* what parted is judged with its transient */
    double largest = tension_from(t, first, rows), most = whole ? tension_from(t, 0, rows) : largest;
    if (largest > u->largest || u->number == 1) {
        u->largest = largest;
        u->tightest = u->number;
    }
    if (is_automatic(breaking_load))
        u->unjudged++;
    else if (most / breaking_load > u->use || u->used == 0) {
        u->use = most / breaking_load;
        u->tension = most;
        u->used = u->number;
    }
}

static void judge_use(verdict *v, const lines_use *u, bool beyond)
{
    bool near = u->use > LINE_USE;
    char name[48], largest[96] = "", unjudged[96] = "";
    verdict_whose(v->r, name);
    if (u->unjudged == u->number) {
        verdict_find(v, VERDICT_NOTE, "",
                     "%slargest tension %s in line %d of %d; breaking_load is not set, so it is not judged.", name,
                     load_text_of(u->largest, VERDICT_DIGITS).text, (int)u->tightest, (int)u->number);
        return;
    }
    if (u->largest > u->tension)
        snprintf(largest, sizeof largest, "; largest tension %s in line %d",
                 load_text_of(u->largest, VERDICT_DIGITS).text, (int)u->tightest);
    if (u->unjudged > 0)
        snprintf(unjudged, sizeof unjudged, "; %d line%s without a breaking load %s not judged", (int)u->unjudged,
                 u->unjudged == 1 ? "" : "s", u->unjudged == 1 ? "is" : "are");
    verdict_find(v, near ? VERDICT_CAUTION : VERDICT_GOOD,
                 near ? "Codes require a safety factor, commonly 1.67 for an intact mooring (API RP 2SK): 60 %." : "",
                 "%smost used line %d: %s, %.0f %% of its breaking load; %d line%s%s%s%s.", name, (int)u->used,
                 load_text_of(u->tension, VERDICT_DIGITS).text, 100 * u->use, (int)u->number, u->number == 1 ? "" : "s",
                 beyond ? ", of which those that parted went beyond" : "", unjudged, largest);
}

/* Lines are judged by their use, the largest tension over the breaking load. */
static void judge_lines(verdict *v)
{
    const report *r = v->r;
    const scenario_mooring *m = &scenario_vessel_entry(&r->d.s, r->vessel).keys->mooring;
    const double *time = run_channel(&r->d, "time");
    const double *parted = run_vessel_channel(&r->d, r->vessel, "lines_parted");
    int32_t rows = r->d.series.rows, at = 0;
    int32_t gone = parted && rows > 0 ? (int32_t)parted[rows - 1] : 0;
    lines_use u = {0};
    for (int32_t i = 0; i < m->lines.count; i++)
        for (int64_t k = 0; k < m->lines.data[i].count; k++)
            use_line(r, m->lines.data[i].breaking_load, gone > 0, &u);
    while (gone > 0 && at < rows && parted[at] < 1)
        at++;
    char name[48];
    v->lines += u.number;
    v->parted += gone;
    double broke = run_event_from(&r->d, r->vessel, EVENT_LINE_BREAK, 0);
    double when = fmin(broke, run_event_from(&r->d, r->vessel, EVENT_LINE_RELEASE, 0));
    /* Lines that were let go did not. */
    bool beyond = gone > 0 && (isfinite(broke) || !isfinite(when));
    if (gone > 0)
        verdict_find(v, VERDICT_BAD,
                     "Later results are those of a damaged mooring; check pretension, breaking load and drift.",
                     "%s%d of %d lines parted or were released, the first at %.6g s.", verdict_whose(r, name),
                     (int)gone, (int)u.number, fmin(when, time ? time[at] : 0));
    if (u.number > 0)
        judge_use(v, &u, beyond);
}

static void judge_thrusters(verdict *v)
{
    const report *r = v->r;
    const double *time = run_channel(&r->d, "time"),
                 *full = run_vessel_channel(&r->d, r->vessel, "thrusters_saturated");
    const scenario_vessel *keys = scenario_vessel_entry(&r->d.s, r->vessel).keys;
    if (!time || !full || keys->thrusters.count == 0 || !keys->positioning.active)
        return;
    char name[48];
    double part = channel_statistics_of(time, full, r->d.series.rows, r->d.s.run.transient).mean;
    verdict_find(v, part > THRUSTERS_FULL ? VERDICT_CAUTION : VERDICT_GOOD,
                 part > THRUSTERS_FULL ? "The demand exceeded the thrust available: see fram capability." : "",
                 "%sthrusters saturated for %.3g %% of the time.", verdict_whose(r, name), 100 * part);
}

void verdict_station(verdict *v)
{
    const report *r = v->r;
    const scenario_vessel *keys = scenario_vessel_entry(&r->d.s, r->vessel).keys;
    if (!station_has_results(&r->d.s, r->vessel))
        return;
    if (run_first_row(&r->d) == r->d.series.rows) {
        char name[48];
        verdict_find(v, VERDICT_CAUTION, "", "%swhether it kept its station was not measured.", verdict_whose(r, name));
        return;
    }
    limit_use offset =
        limit_use_of(&r->d, r->vessel, "offset_x", "offset_y", automatic_or(keys->station.offset_limit, HUGE_VAL));
    limit_use heading = limit_use_of(&r->d, r->vessel, "heading_deviation", NULL,
                                     automatic_or(keys->station.heading_limit_deg, HUGE_VAL));
    judge_limit(v, "offset", "m", offset, keys->station.offset_limit, "station.offset_limit");
    if (!is_automatic(keys->station.heading_limit_deg))
        judge_limit(v, "heading deviation", "deg", heading, keys->station.heading_limit_deg,
                    "station.heading_limit_deg");
    judge_lines(v);
    judge_thrusters(v);
}
