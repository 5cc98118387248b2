#include "results/why.h"

#include "base/load_unit.h"
#include "base/number_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Differences under this part of the load matter to nobody: within what chance does from one second to the next. */
static const double MATTERS = 0.05;

/* A load that is larger by this part is another one: what is recorded is rounded. */
static const double SAME_LOAD = 1e-5;

/* Those of another Fram are no reason not to look at a moment, which is computed again. */
static fram_status read_peaks(why *y, fram_error *error)
{
    fram_status status = peak_list_read(y->ctx, y->run.folder, y->vessel, &y->peaks, &y->unread);
    if (status == FRAM_ERROR_INPUT)
        return FRAM_OK;
    if (status != FRAM_OK && error)
        *error = y->unread;
    return status;
}

fram_status why_open(context *ctx, const char *folder, const char *vessel, why *y, fram_error *error)
{
    *y = (why){.ctx = ctx};
    fram_status status = run_data_read(ctx, folder, false, NULL, &y->run, error);
    if (status != FRAM_OK)
        return status;
    status = scenario_choose_vessel(&y->run.s, folder, vessel, &y->vessel, error);
    if (status == FRAM_OK)
        status = read_peaks(y, error);
    if (status != FRAM_OK)
        run_data_free(ctx, &y->run);
    return status;
}

void why_close(why *y)
{
    peak_list_free(y->ctx, &y->peaks);
    run_data_free(y->ctx, &y->run);
}

/* Peaks are told of whole windows.  From the first row of a recording that began late on. */
static bool is_shorter_than_a_window(const run_data *d)
{
    double from = run_recorded_from(d);
    return from > 0 && d->note.time - from < scenario_averaging_window(&d->s) - 0.5 * d->s.run.time_step;
}

fram_status why_peak(const why *y, int64_t number, const peak_detail **d, fram_error *error)
{
    const run_data *run = &y->run;
    if (y->unread.status != FRAM_OK) {
        if (error)
            *error = y->unread;
        return y->unread.status;
    }
    if (y->peaks.count == 0 && is_shorter_than_a_window(run))
        return error_set(error, FRAM_ERROR_INPUT, run->folder, 0, "peak",
                         "the run keeps no peaks: it was recorded from %g s to %g s, and a peak is told of a whole "
                         "averaging window of %g s; name a moment by its time, which is computed again",
                         run_recorded_from(run), run->note.time, scenario_averaging_window(&run->s));
    if (y->peaks.count == 0)
        return error_set(
            error, FRAM_ERROR_INPUT, y->run.folder, 0, "peak",
            "the run keeps no peaks of this vessel: it met no ice after its transient of %g s, or its load "
            "only fell from then on, it was stopped before its first checkpoint, a study kept its series alone, or an "
            "earlier Fram made it; name a moment by its time, which is computed again",
            y->run.s.run.transient);
    if (number < 1 || number > y->peaks.count)
        return error_set(error, FRAM_ERROR_INPUT, y->run.folder, 0, "peak",
                         "expected 1, the largest, to %d, found %lld; name another moment by its time",
                         (int)y->peaks.count, (long long)number);
    *d = y->peaks.peak[number - 1];
    return FRAM_OK;
}

const peak_detail *why_recorded_at(const why *y, double time)
{
    for (int32_t i = 0; i < y->peaks.count; i++) {
        const peak_detail *d = y->peaks.peak[i];
        if (fabs(d->time - time) <= d->window / 4)
            return d;
    }
    return NULL;
}

/* Where the run stands; that of one that failed is mostly of the step that went wrong, which has no row, and earlier
   versions told no other. */
static double last_time(const run_data *d)
{
    const double *time = run_channel(d, "time");
    if (strcmp(d->note.status, "failed") != 0)
        return d->note.time;
    if (d->note.good_until > 0)
        return d->note.good_until;
    return fmax(d->note.time - d->s.run.time_step, time && d->series.rows > 0 ? time[d->series.rows - 1] : 0);
}

fram_status why_check_time(const why *y, double time, fram_error *error)
{
    double end = last_time(&y->run);
    if (time > 0 && time <= end * (1 + 1e-12))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, y->run.folder, 0, "time",
                     "expected a time in the run, above 0 and up to %g s, found %g", end, time);
}

/* In whole per cent, so that a small part against the load is no "-0". */
static double percent(double part, const peak_detail *d)
{
    double whole = d->load > 0 ? floor(100 * part / d->load + 0.5) : 0;
    return fabs(whole) > 0 ? whole : 0;
}

static double sum_of(const double part[MECHANISM_COUNT])
{
    double sum = 0;
    for (int i = 0; i < MECHANISM_COUNT; i++)
        sum += part[i];
    return sum;
}

/* ---- text ---- */

static void tell_parts(context *ctx, const peak_detail *d, text_buffer *out)
{
    text_add(ctx, out, "\nContributions along the load, by mechanism:\n");
    double told[MECHANISM_COUNT];
    memcpy(told, d->mechanism, sizeof told);
    for (int k = 0; k < MECHANISM_COUNT; k++) {
        ice_mechanism m = peak_main_mechanism(told);
        if (fabs(percent(told[m], d)) >= 0.5 && told[m] > -HUGE_VAL)
            text_format(ctx, out, "  %5.0f %%  %s\n", percent(told[m], d), mechanism_text(m));
        told[m] = -HUGE_VAL;
    }
    text_add(ctx, out, "Where on the hull:");
    for (int32_t z = 0; z < PEAK_ZONES; z++)
        if (fabs(percent(sum_of(d->zone[z]), d)) >= 0.5)
            text_format(ctx, out, "  %s %.0f %%", peak_zone_name(z), percent(sum_of(d->zone[z]), d));
    text_add(ctx, out, "\n");
}

static void name_floe(int32_t number, char out[24])
{
    if (number >= 0)
        snprintf(out, 24, "floe %d", (int)number);
    else
        snprintf(out, 24, "no floe");
}

static void tell_floes(context *ctx, const peak_detail *d, load_unit unit, text_buffer *out)
{
    text_format(ctx, out, "\n%d %s touched the vessel in the window; the largest contributions:\n", (int)d->bodies,
                d->bodies == 1 ? "body" : "bodies");
    for (int32_t i = 0; i < d->floe_count && i < 10; i++) {
        const peak_floe *f = &d->floe[i];
        char name[24];
        name_floe(f->number, name);
        text_format(ctx, out, "  %5.0f %%  %-12s %9s %s at (%s) m, %s, mostly %s\n", percent(sum_of(f->part), d), name,
                    plain_text_of(vec3_length(f->force) * unit.factor, 4).text, unit.name,
                    place_text_of(f->point.x, f->point.y, f->point.z).text, peak_zone_name(f->zone),
                    mechanism_text((ice_mechanism)f->mechanism));
    }
}

/* What is no floe is known where it ends a chain. */
static const char *name_end(const why *y, const peak_floe *f)
{
    const char *vessel = peak_end_vessel(&y->run, f);
    return vessel ? vessel : chain_end_noun(peak_end(&y->run, f));
}

static void tell_chain(const why *y, const peak_floe *f, const peak_link *link, text_buffer *out)
{
    context *ctx = y->ctx;
    text_add(ctx, out, "  hull");
    for (int i = 0; i < f->links; i++) {
        char name[24];
        name_floe(link[i].number, name);
        if (peak_chain_jumps_to(f, i))
            text_format(ctx, out, " -> ... %d more ...", f->left_out);
        text_format(ctx, out, " -> %s (%s)",
                    link[i].number >= 0 ? name
                    : i == f->links - 1 ? name_end(y, f)
                                        : "body",
                    load_text_of(vec3_length(link[i].push), 4).text);
    }
    text_format(ctx, out, "; the end: %s\n", chain_end_text(peak_end(&y->run, f)));
}

static void tell_chains(const why *y, const peak_detail *d, text_buffer *out)
{
    context *ctx = y->ctx;
    int32_t at = 0;
    text_add(ctx, out, "\nForce chains behind them in the step of the peak (impulses over the step):\n");
    for (int32_t i = 0; i < d->floe_count; i++) {
        if (d->floe[i].links > 0)
            tell_chain(y, &d->floe[i], &d->link[at], out);
        at += d->floe[i].links;
    }
    if (at == 0)
        text_add(ctx, out, "  no chain to follow: those floes broke in that step or no longer touched\n");
}

/* Of rows in a span up to a time. */
static void tell_residual(const why *y, double until, double span, text_buffer *out)
{
    const double *time = run_channel(&y->run, "time"), *residual = run_channel(&y->run, "solver_residual");
    double most = -1;
    int32_t rows = 0;
    for (int32_t i = 0; time && residual && i < y->run.series.rows; i++) {
        if (!(time[i] > until - span && time[i] <= until))
            continue;
        most = fmax(most, residual[i]);
        rows++;
    }
    if (most < 0)
        text_add(y->ctx, out, "; series.csv holds no rows of that time, so the solver's residual is unknown\n");
    else if (run_leaves_out_steps(&y->run))
        text_format(y->ctx, out, "; the solver's largest residual %.3g m/s in the %d row%s that series.csv has of it\n",
                    most, (int)rows, rows == 1 ? "" : "s");
    else
        text_format(y->ctx, out, "; the solver's largest residual %.3g m/s\n", most);
}

static void tell_breaks(const why *y, const peak_detail *d, text_buffer *out)
{
    peak_breaks b = peak_breaks_before(&y->run, d->time);
    double span = peak_span_before(&y->run.s), recorded = peak_span_recorded(&y->run, d->time);
    text_format(y->ctx, out,
                recorded < span ? "\nSince the recording began, %.3g s before, in all of the ice: "
                                : "\nIn the %.3g s before, in all of the ice: ",
                recorded);
    peak_tell_breaks(y->ctx, &b, out);
    if (b.last < d->time)
        text_format(y->ctx, out, ", the last one %.3g s before", d->time - b.last);
    else if (isfinite(b.last))
        text_add(y->ctx, out, ", the last one in that step");
    tell_residual(y, d->time, span, out);
}

static void tell_difference(context *ctx, const char *how, why_method by, double same, load_unit unit, text_buffer *out)
{
    double part = same > 0 ? by.load / same - 1 : 0;
    if (by.wrong > 0)
        text_format(ctx, out, "  %-24s went wrong at t = %g s\n", how, by.wrong);
    else
        text_format(ctx, out, "  %-24s %9s %s  %+.1f %%%s\n", how, plain_text_of(by.load * unit.factor, 4).text,
                    unit.name, 100 * part, fabs(part) > MATTERS ? "  significant" : "");
}

static void tell_check(context *ctx, const peak_detail *d, const why_check *c, load_unit unit, text_buffer *out)
{
    if (!c->done) {
        if (c->hindrance[0])
            text_format(ctx, out, "\n%s: %s.", c->told ? "A program steered the run" : "Not computed again",
                        c->hindrance);
        text_add(ctx, out, "\nNot recomputed: the influence of time step and solver is unknown.\n");
        return;
    }
    text_format(ctx, out,
                "\nRecomputed from %g s on, with other methods from %g s; largest averaged load from %g s to %g s:\n",
                c->start, c->fork, c->first, c->last);
    tell_difference(ctx, "as in the run", (why_method){c->same, 0}, c->same, unit, out);
    tell_difference(ctx, "half the time step", c->half_step, c->same, unit, out);
    tell_difference(ctx, "the accurate solver", c->accurate, c->same, unit, out);
    if (c->same > d->load * (1 + SAME_LOAD))
        text_format(ctx, out, "  (as in the run, that is more than the %s at %g s, which are explained above)\n",
                    load_text_of(d->load, 4).text, d->time);
    text_format(ctx, out, "  (more than %g %% counts as significant; jams are chaotic, so compare means too)\n",
                100 * MATTERS);
}

/* 0, and not what rounding and solver leave of a part of a force beside the whole. */
static double part_told(double part, vec3 whole) { return fabs(part) <= 1e-8 * vec3_length(whole) ? 0 : part; }

static void tell_force_vector(context *ctx, vec3 force, load_unit unit, text_buffer *out)
{
    text_format(ctx, out, "(%s, %s, %s) %s in x, y, z\n",
                plain_text_of(part_told(force.x, force) * unit.factor, 4).text,
                plain_text_of(part_told(force.y, force) * unit.factor, 4).text,
                plain_text_of(part_told(force.z, force) * unit.factor, 4).text, unit.name);
}

fram_status why_text(const why *y, const peak_detail *d, int32_t rank, const why_check *check, text_buffer *out,
                     fram_error *error)
{
    context *ctx = y->ctx;
    load_unit unit = load_unit_for(d->load);
    const char *vessel = scenario_vessel_name(&y->run.s, y->vessel);
    if (vessel)
        text_format(ctx, out, "Vessel %s. ", vessel);
    if (rank > 0)
        text_format(ctx, out, "Peak %d of %d: ", (int)rank, (int)y->peaks.count);
    text_format(ctx, out, "t = %.6g s, horizontal ice load %s, averaged over %.3g s\n", d->time,
                load_text_of(d->load, 4).text, d->window);
    tell_force_vector(ctx, d->force, unit, out);
    if (d->floe_count == 0) {
        text_format(ctx, out, "No ice touched the vessel in the %.3g s up to then.\n", d->window);
        return out->failed ? error_memory(error) : FRAM_OK;
    }
    peak_sentence(ctx, &y->run, d, out);
    text_add(ctx, out, "\n");
    tell_parts(ctx, d, out);
    tell_floes(ctx, d, unit, out);
    tell_chains(y, d, out);
    tell_breaks(y, d, out);
    tell_check(ctx, d, check, unit, out);
    return out->failed ? error_memory(error) : FRAM_OK;
}

/* ---- JSON: one line, SI units ---- */

static void number(context *ctx, text_buffer *out, const char *key, double value)
{
    text_format(ctx, out, "\"%s\": ", key);
    text_real_or_null(ctx, out, value);
}

static void vector(context *ctx, text_buffer *out, const char *key, vec3 v)
{
    const double part[3] = {v.x, v.y, v.z};
    text_format(ctx, out, "\"%s\": [", key);
    for (int i = 0; i < 3; i++) {
        text_add(ctx, out, i > 0 ? ", " : "");
        text_real_or_null(ctx, out, part[i]);
    }
    text_add(ctx, out, "]");
}

static void parts(context *ctx, text_buffer *out, const char *key, const double part[MECHANISM_COUNT])
{
    text_format(ctx, out, "\"%s\": {", key);
    for (int i = 0; i < MECHANISM_COUNT; i++) {
        text_add(ctx, out, i > 0 ? ", " : "");
        number(ctx, out, mechanism_name((ice_mechanism)i), part[i]);
    }
    text_add(ctx, out, "}");
}

static void json_end(const why *y, text_buffer *out, const peak_floe *f)
{
    const char *vessel = peak_end_vessel(&y->run, f);
    text_add(y->ctx, out, ", \"left_out\": ");
    if (f->left_out > 0)
        text_format(y->ctx, out, "{\"links\": %d, \"after\": %d}", f->left_out, PEAK_CHAIN_FIRST);
    else
        text_add(y->ctx, out, "null");
    text_format(y->ctx, out, ", \"end\": %s%s%s", f->links ? "\"" : "",
                f->links ? chain_end_name(peak_end(&y->run, f)) : "null", f->links ? "\"" : "");
    text_format(y->ctx, out, ", \"end_vessel\": %s%s%s", vessel ? "\"" : "", vessel ? vessel : "null",
                vessel ? "\"" : "");
}

static void json_chain(const why *y, text_buffer *out, const peak_floe *f, const peak_link *link)
{
    context *ctx = y->ctx;
    text_add(ctx, out, ", \"chain\": [");
    for (int i = 0; i < f->links; i++) {
        text_format(ctx, out, "%s{\"floe\": %d, ", i > 0 ? ", " : "", (int)link[i].number);
        vector(ctx, out, "place", link[i].place);
        text_add(ctx, out, ", ");
        vector(ctx, out, "push", link[i].push);
        text_add(ctx, out, ", ");
        number(ctx, out, "held_by_contacts", link[i].others);
        text_add(ctx, out, ", ");
        number(ctx, out, "held_by_water", link[i].water);
        text_add(ctx, out, ", ");
        number(ctx, out, "inertia", link[i].inertia);
        text_add(ctx, out, "}");
    }
    text_add(ctx, out, "]");
    json_end(y, out, f);
}

static void json_floes(const why *y, text_buffer *out, const peak_detail *d)
{
    context *ctx = y->ctx;
    int32_t at = 0;
    text_add(ctx, out, ", \"floes\": [");
    for (int32_t i = 0; i < d->floe_count; i++) {
        const peak_floe *f = &d->floe[i];
        text_format(ctx, out, "%s{\"floe\": %d, \"mechanism\": \"%s\", \"zone\": \"%s\", ", i > 0 ? ", " : "",
                    (int)f->number, mechanism_name((ice_mechanism)f->mechanism), peak_zone_name(f->zone));
        vector(ctx, out, "force", f->force);
        text_add(ctx, out, ", ");
        vector(ctx, out, "point", f->point);
        text_add(ctx, out, ", ");
        parts(ctx, out, "parts", f->part);
        json_chain(y, out, f, &d->link[at]);
        text_add(ctx, out, "}");
        at += f->links;
    }
    text_add(ctx, out, "]");
}

/* A method that went wrong has no load, and tells when that was. */
static void json_method(context *ctx, text_buffer *out, const char *key, why_method by)
{
    char when[40];
    text_add(ctx, out, ", ");
    number(ctx, out, key, by.wrong > 0 ? (double)NAN : by.load);
    if (!(by.wrong > 0))
        return;
    snprintf(when, sizeof when, "%s_went_wrong_at", key);
    text_add(ctx, out, ", ");
    number(ctx, out, when, by.wrong);
}

static void json_check(context *ctx, text_buffer *out, const why_check *c)
{
    text_add(ctx, out, ", \"computed_again\": ");
    if (!c->done) {
        text_add(ctx, out, "null");
        if (c->hindrance[0]) {
            text_add(ctx, out, ", \"hindrance\": ");
            text_quoted(ctx, out, c->hindrance);
        }
        return;
    }
    text_add(ctx, out, "{");
    number(ctx, out, "from", c->start);
    text_add(ctx, out, ", ");
    number(ctx, out, "other_methods_from", c->fork);
    text_add(ctx, out, ", ");
    number(ctx, out, "largest_from", c->first);
    text_add(ctx, out, ", ");
    number(ctx, out, "largest_to", c->last);
    text_add(ctx, out, ", ");
    number(ctx, out, "same", c->same);
    json_method(ctx, out, "half_step", c->half_step);
    json_method(ctx, out, "accurate", c->accurate);
    text_add(ctx, out, "}");
}

static const json_unit why_units[] = {{"time", "s"},
                                      {"load", "N"},
                                      {"window", "s"},
                                      {"force", "N"},
                                      {"mechanisms", "N"},
                                      {"zones", "N"},
                                      {"parts", "N"},
                                      {"point", "m"},
                                      {"place", "m"},
                                      {"push", "N"},
                                      {"held_by_contacts", "N"},
                                      {"held_by_water", "N"},
                                      {"inertia", "N"},
                                      {"span_before", "s"},
                                      {"from", "s"},
                                      {"other_methods_from", "s"},
                                      {"largest_from", "s"},
                                      {"largest_to", "s"},
                                      {"same", "N"},
                                      {"half_step", "N"},
                                      {"half_step_went_wrong_at", "s"},
                                      {"accurate", "N"},
                                      {"accurate_went_wrong_at", "s"}};

fram_status why_json(const why *y, const peak_detail *d, int32_t rank, const why_check *check, text_buffer *out,
                     fram_error *error)
{
    context *ctx = y->ctx;
    peak_breaks b = peak_breaks_before(&y->run, d->time);
    const char *vessel = scenario_vessel_name(&y->run.s, y->vessel);
    text_format(ctx, out, "{\"vessel\": %s%s%s, ", vessel ? "\"" : "", vessel ? vessel : "null", vessel ? "\"" : "");
    text_format(ctx, out, "\"peak\": %d, \"peaks\": %d, ", (int)rank, (int)y->peaks.count);
    number(ctx, out, "time", d->time);
    text_add(ctx, out, ", ");
    number(ctx, out, "load", d->load);
    text_add(ctx, out, ", ");
    number(ctx, out, "window", d->window);
    text_add(ctx, out, ", ");
    vector(ctx, out, "force", d->force);
    text_add(ctx, out, ", ");
    parts(ctx, out, "mechanisms", d->mechanism);
    text_add(ctx, out, ", \"zones\": {");
    for (int32_t z = 0; z < PEAK_ZONES; z++) {
        text_add(ctx, out, z > 0 ? ", " : "");
        parts(ctx, out, peak_zone_name(z), d->zone[z]);
    }
    text_format(ctx, out, "}, \"bodies\": %d", (int)d->bodies);
    json_floes(y, out, d);
    text_format(ctx, out, ", \"bendings_before\": %d, \"splits_before\": %d, ", (int)b.bendings, (int)b.splits);
    number(ctx, out, "span_before", peak_span_recorded(&y->run, d->time));
    json_check(ctx, out, check);
    text_units(ctx, out, why_units, (int32_t)(sizeof why_units / sizeof *why_units));
    text_add(ctx, out, "}\n");
    return out->failed ? error_memory(error) : FRAM_OK;
}
