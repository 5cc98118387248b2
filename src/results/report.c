#include "results/report.h"

#include "io/atomic_file.h"
#include "io/scenario_file.h"
#include "model/scenario_words.h"
#include "results/report_parts.h"
#include "results/station_results.h"
#include "results/track_results.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void figure(report *r, const char *name, double value, const char *unit)
{
    char text[32];
    /* Counts and times are told whole. */
    if (isnan(value))
        html_number_text(value, text); /* nothing was measured */
    else if (!*unit || strcmp(unit, "s") == 0)
        snprintf(text, sizeof text, "%.10g", value);
    else
        report_number(value, text);
    html_figure(&r->page, name, text, unit);
}

/* Name of what is told of a vessel, with that of the vessel where there are names. */
typedef struct vessel_label {
    char text[96];
} vessel_label;

static vessel_label vessel_label_of(const report *r, const char *name)
{
    vessel_label full;
    const scenario *s = &r->d.s;
    bool named = scenario_names_vessels(s);
    snprintf(full.text, sizeof full.text, "%.*s%s%s", (int)VESSEL_NAME_MOST,
             named ? scenario_vessel_entry(s, r->vessel).keys->name : "", named ? ": " : "", name);
    return full;
}

/* A load as the verdict tells it, unit and digits. */
static void load_figure(report *r, const char *name, double newton)
{
    load_text text = load_text_of(newton, VALUE_DIGITS);
    char *unit = strchr(text.text, ' ');
    const vessel_label full = vessel_label_of(r, name);
    if (isnan(newton) || !unit) {
        figure(r, full.text, (double)NAN, "kN");
        return;
    }
    *unit = '\0';
    html_figure(&r->page, full.text, text.text, unit + 1);
}

static fram_status vessel_figures(report *r, int32_t vessel, const double *time, fram_error *error)
{
    fram_status status = report_choose_vessel(r, vessel, error);
    if (status != FRAM_OK)
        return status;
    char averaged[64];
    snprintf(averaged, sizeof averaged, "largest ice load, averaged over %.3g s", scenario_averaging_window(&r->d.s));
    channel_statistics s = channel_statistics_of(time, r->load.data, r->load.count, r->d.s.run.transient);
    load_figure(r, "mean ice load", s.mean);
    load_figure(r, "significant peak", s.significant);
    load_figure(r, averaged, s.greatest);
    return FRAM_OK;
}

static void station_figure(report *r, int32_t vessel)
{
    if (!station_has_results(&r->d.s, vessel))
        return;
    r->vessel = vessel;
    const double *x = run_vessel_channel(&r->d, vessel, "offset_x"), *y = run_vessel_channel(&r->d, vessel, "offset_y");
    double most = (double)NAN;
    for (int32_t i = run_first_row(&r->d); x && y && i < r->d.series.rows; i++)
        most = fmax(most, sqrt(x[i] * x[i] + y[i] * y[i]));
    figure(r, vessel_label_of(r, "largest offset").text, most, "m");
}

/* A program may have stepped the world before it was recorded. */
static void simulated_figure(report *r)
{
    char text[64];
    double from = run_recorded_from(&r->d);
    snprintf(text, sizeof text, "%.10g to %.10g", from, r->d.note.time);
    if (from > 0)
        html_figure(&r->page, "recorded", text, "s");
    else
        figure(r, "simulated", r->d.note.time, "s");
}

static fram_status key_figures(report *r, fram_error *error)
{
    const double *time = run_channel(&r->d, "time");
    int32_t vessels = time ? scenario_vessel_count(&r->d.s) : 0;
    fram_status status = FRAM_OK;
    html_figures_begin(&r->page);
    for (int32_t v = 0; v < vessels && status == FRAM_OK; v++)
        status = vessel_figures(r, v, time, error);
    simulated_figure(r);
    if (r->d.frames > 0)
        figure(r, "floes at the start", r->d.before.areas.count, "");
    figure(r, "floes that broke", run_fractures(&r->d, FRACTURE_BENDING) + run_fractures(&r->d, FRACTURE_SPLIT), "");
    for (int32_t v = 0; v < vessels; v++)
        station_figure(r, v);
    html_figures_end(&r->page);
    return status;
}

static const char *const modes[] = {
    [VESSEL_PRESCRIBED] = "prescribed motion", [VESSEL_TOWED] = "towed", [VESSEL_FREE] = "free"};
static const char *const forms[] = {[HULL_BOX] = "box",
                                    [HULL_ICEBREAKER] = "icebreaking hull",
                                    [HULL_MESH] = "hull from a file",
                                    [HULL_CONE] = "cone",
                                    [HULL_SHIP] = "ship of full form"};
static const char *const boundaries[] = {
    [DOMAIN_WALLS] = "walls", [DOMAIN_OPEN] = "open", [DOMAIN_FEEDING] = "unbounded field that drifts through"};

/* A file as the page may tell it: with its path only where that was asked for. */
static const char *file_told(const report *r, const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash && !r->with_paths ? slash + 1 : path;
}

/* What keeps a free vessel: lines counted one by one, thrusters, control. */
static void kept_facts(report *r, const scenario_vessel *v)
{
    char thrusters[48] = "no thrusters";
    const setting_text lines = mooring_lines_text(v);
    if (v->thrusters.count > 0)
        snprintf(thrusters, sizeof thrusters, "%d thruster%s", (int)v->thrusters.count,
                 v->thrusters.count > 1 ? "s" : "");
    html_fact(&r->page, "station keeping", "%s, %s%s%s", lines.text[0] ? lines.text : "no mooring", thrusters,
              v->positioning.active ? ", dynamic positioning" : "",
              vessel_drives_itself(v) ? ", its own propulsion" : "");
}

static void vessel_facts(report *r, const vessel_entry *entry)
{
    const scenario_vessel *v = entry->keys;
    const scenario_hull *h = &v->hull;
    char name[64];
    snprintf(name, sizeof name, "vessel%s%.*s", v->name[0] ? " " : "", (int)VESSEL_NAME_MOST, v->name);
    if (h->form == HULL_MESH)
        html_fact(&r->page, name, "%s (%s), %s", forms[h->form], file_told(r, h->file), modes[v->mode]);
    else
        html_fact(&r->page, name, "%s, %s; %g m long, %g m wide, %g m draught", forms[h->form], modes[v->mode],
                  h->length, h->beam, h->draught);
    if (v->path.count > 0)
        html_fact(&r->page, "motion", "along a path of %d points", (int)v->path.count);
    else if (v->mode == VESSEL_FREE)
        html_fact(&r->page, "motion", "free in six degrees of freedom, heading %g deg%s%s", v->heading_deg,
                  vessel_begins_at_equilibrium(v) ? vessel_equilibrium_text(v) : " at the start",
                  v->speed > 0 ? ", under way" : ", at rest");
    else
        html_fact(&r->page, "motion", "%g m/s towards %g deg, heading %g deg", v->speed,
                  automatic_or(v->course_deg, v->heading_deg), v->heading_deg);
    if (v->mode == VESSEL_FREE)
        kept_facts(r, v);
}

/* Ice that differs in kind: populations, each with what it has of its own. */
static void population_facts(report *r, const scenario_ice *i)
{
    for (int32_t k = 0; k < i->populations.count; k++)
        html_fact(&r->page, k == 0 ? "populations" : "", "%d: %s", (int)k + 1, ice_population_text(i, k).text);
}

static void take_thickness(double thickness, double range[2])
{
    range[0] = fmin(range[0], thickness);
    range[1] = fmax(range[1], thickness);
}

/* "0.25 to 0.3 m thick": of floes from a file that of the record, of all others what the scenario gives them. */
static const char *thickness_words(const report *r, const scenario_ice *i, char out[64])
{
    double range[2] = {HUGE_VAL, -HUGE_VAL};
    bool drawn = i->source == ICE_VORONOI || i->source == ICE_PACKED;
    for (int32_t k = 0; i->source == ICE_FLOES && k < i->floes.count; k++)
        take_thickness(automatic_or(i->floes.data[k].thickness, i->thickness), range);
    for (int32_t k = 0; drawn && k < i->populations.count; k++)
        take_thickness(automatic_or(i->populations.data[k].thickness, i->thickness), range);
    if (i->source == ICE_FILE && r->d.before.areas.count > 0) {
        take_thickness(r->d.before.thinnest, range);
        take_thickness(r->d.before.thickest, range);
    } else if (i->source == ICE_FILE) {
        return "as thick as their file says"; /* without a record */
    }
    if (!(range[1] > 0))
        take_thickness(i->thickness, range);
    int n = snprintf(out, 64, "%.4g", range[0]);
    if (range[1] > range[0] * (1 + 1e-6))
        n += snprintf(out + n, 64 - (size_t)n, " to %.4g", range[1]);
    snprintf(out + n, 64 - (size_t)n, " m thick");
    return out;
}

/* Strengths that vary from place to place. */
static void strength_fact(report *r, const scenario_strength *s)
{
    if (!(s->flexural_variation > 0 || s->crushing_variation > 0))
        return;
    html_fact(&r->page, "strength variation",
              "coefficient of variation %g of the flexural, %g of the crushing strength, over a correlation length of "
              "%g m; correlation of the two %g; drawn by seed %lld",
              s->flexural_variation, s->crushing_variation, s->correlation_length, s->common,
              (long long)r->d.s.run.seed);
}

static void ice_facts(report *r)
{
    static const char *const sources[] = {[ICE_VORONOI] = "managed ice (Voronoi cells)",
                                          [ICE_FLOES] = "listed floes",
                                          [ICE_NONE] = "none",
                                          [ICE_FILE] = "observed floes",
                                          [ICE_LEVEL] = "level ice",
                                          [ICE_PACKED] = "packed floes"};
    const scenario_ice *i = &r->d.s.ice;
    char thick[64], strength[192] = "";
    bool populated = (i->source == ICE_VORONOI || i->source == ICE_PACKED) && i->populations.count > 0;
    if (!populated) /* each has its own */
        snprintf(strength, sizeof strength, "; %s",
                 ice_strength_text(i->crushing_strength, i->flexural_strength, i->breakable).text);
    html_fact(&r->page, "ice", "%s, %s, %g kg/m3%s", sources[i->source], thickness_words(r, i, thick), i->density,
              strength);
    strength_fact(r, &i->strength);
    if (i->source == ICE_FILE)
        html_fact(&r->page, "field", "from %s", file_told(r, i->file));
    if (i->source == ICE_VORONOI && i->populations.count == 0)
        html_fact(&r->page, "field",
                  "%g %% of the area free for ice requested: floes are cut from cells of %g m2 on average",
                  100 * i->concentration, i->mean_floe_area);
    else if (scenario_ice_is_drawn(i))
        html_fact(&r->page, "field", "%g %% of the area free for ice requested", 100 * i->concentration);
    population_facts(r, i);
}

/* A uniform flow, or the file of its history. */
static void flow_fact(report *r, const char *name, const char *file, double speed, double direction)
{
    if (file[0])
        html_fact(&r->page, name, "time history %s", file_told(r, file));
    else if (speed > 0)
        html_fact(&r->page, name, "%g m/s towards %g deg", speed, direction);
    else
        html_fact(&r->page, name, "none");
}

static void told_fact(report *r)
{
    char text[RUN_TOLD_SIZE];
    run_told(&r->d, text);
    if (*text)
        html_fact(&r->page, "told by a program", "the rows above are the scenario's, in place of which were %s", text);
}

static void scenario_table(report *r)
{
    const scenario *s = &r->d.s;
    const scenario_ice *i = &s->ice;
    html_section(&r->page, "Scenario");
    html_table_begin(&r->page, NULL, 0);
    for (int32_t v = 0; v < scenario_vessel_count(s); v++) {
        vessel_entry entry = scenario_vessel_entry(s, v);
        vessel_facts(r, &entry);
    }
    if (i->source != ICE_NONE)
        ice_facts(r);
    html_fact(&r->page, "domain", "%g m x %g m, %s", s->domain.x_max - s->domain.x_min,
              s->domain.y_max - s->domain.y_min, boundaries[s->domain.boundary]);
    const scenario_environment *e = &s->environment;
    const ice_drift drift = scenario_drift(s);
    if (drift.own)
        flow_fact(r, "drift of the ice", drift.file, drift.speed, drift.towards_deg);
    else if (drift.fed)
        html_fact(&r->page, "drift of the ice", "that of the current");
    flow_fact(r, "current", e->current_file, e->current_speed, e->current_direction_deg);
    if (e->current_profile_file[0])
        html_fact(&r->page, "over depth", "plus the profile %s", file_told(r, e->current_profile_file));
    flow_fact(r, "wind", e->wind_file, e->wind_speed, e->wind_direction_deg);
    told_fact(r);
    html_fact(&r->page, "run", "%g s in steps of %g s, seed %lld", s->run.duration, s->run.time_step,
              (long long)s->run.seed);
    html_table_end(&r->page);
}

/* Whether one of the events is of a vessel of a list: a single one has no name to tell. */
static bool events_name_vessels(const run_note *n)
{
    for (int32_t i = 0; i < n->events.count; i++)
        if (n->events.data[i].vessel[0])
            return true;
    return false;
}

/* Whether the run has written results of a vessel on station: the scenario may have been changed since. */
static bool has_station_file(const report *r)
{
    char path[PATH_ROOM];
    bool found = false;
    for (int32_t v = 0; v < scenario_vessel_count(&r->d.s) && !run_is_open(&r->d); v++) {
        vessel_file name = vessel_file_name(&r->d.s, v, "station", ".json");
        found = found || (path_join(r->d.folder, name.text, path, NULL) == FRAM_OK && file_is_readable(path));
    }
    return found;
}

/* Where more of them stand than the page shows: run.json lists so many, the file of a vessel on station all of its. */
static void more_events(report *r, double shown)
{
    const run_note *n = &r->d.note;
    double listed = n->events.count, all = listed + n->events_left_out;
    bool kept = has_station_file(r);
    if (all > listed)
        html_paragraph(&r->page, "The first %.0f of %.0f events; run.json lists the first %.0f%s.", shown, all, listed,
                       !kept                             ? ""
                       : scenario_names_vessels(&r->d.s) ? ", station-NAME.json those of its vessel"
                                                         : ", station.json those of its vessel");
    else if (all > shown)
        html_paragraph(&r->page, "The first %.0f of %.0f events; run.json lists all.", shown, all);
}

/* What befell the vessels: lines, thrusters, position, besetting, approaches. */
static void events(report *r)
{
    enum { SHOWN = 40 };
    const run_note *n = &r->d.note;
    if (n->events.count == 0)
        return;
    bool named = events_name_vessels(n);
    const char *const heads[] = {"time [s]", named ? "vessel" : "event", "event"};
    html_section(&r->page, "Events");
    html_table_begin(&r->page, heads, named ? 3 : 2);
    for (int32_t i = 0; i < n->events.count && i < SHOWN; i++) {
        const run_event *e = &n->events.data[i];
        html_row_begin(&r->page);
        html_number(&r->page, e->time);
        if (named)
            html_cell(&r->page, e->vessel);
        html_cell(&r->page, e->text);
        html_row_end(&r->page);
    }
    html_table_end(&r->page);
    more_events(r, SHOWN);
}

static fram_status appendix(report *r, fram_error *error)
{
    text_buffer notes = {0}, text = {0};
    r->notes(r->ctx, &r->d.s, &notes);
    const scenario_print_options options = {.comments = true, .names_only = !r->with_paths};
    fram_status status = notes.failed ? error_memory(error) : scenario_print(r->ctx, &r->d.s, &options, &text, error);
    if (status == FRAM_OK) {
        html_section(&r->page, "Derived from the scenario");
        html_verbatim(&r->page, notes.data ? notes.data : "");
        html_section(&r->page, "Complete scenario");
        html_verbatim(&r->page, text.data);
    }
    text_free(r->ctx, &notes);
    text_free(r->ctx, &text);
    return status;
}

static fram_status compose_report(report *r, fram_error *error)
{
    char subtitle[1400], extent[96];
    double from = run_recorded_from(&r->d);
    const char *folder = r->d.folder, *slash = strrchr(folder, '/');
    if (folder[0] == '/' && slash[1] && !r->with_paths)
        folder = slash + 1;
    if (from > 0)
        snprintf(extent, sizeof extent, "recorded from %g to %g s of %g", from, r->d.note.time, r->d.s.run.duration);
    else
        snprintf(extent, sizeof extent, "%g s simulated", r->d.note.time);
    snprintf(subtitle, sizeof subtitle, "Run %s in %.1000s, %s; Fram %s",
             run_is_open(&r->d) ? "not finished" : r->d.note.status, folder, extent, r->d.note.version);
    html_begin(&r->page, r->d.s.title[0] ? r->d.s.title : "A run of Fram", subtitle);
    fram_status status = report_verdict(r, error);
    if (status == FRAM_OK)
        status = key_figures(r, error);
    if (scenario_vessel_count(&r->d.s) > 1)
        html_contents(&r->page);
    scenario_table(r);
    events(r);
    track_table(&r->page, &r->d.note);
    for (int32_t v = 0; v < scenario_vessel_count(&r->d.s) && status == FRAM_OK; v++) {
        status = report_choose_vessel(r, v, error);
        if (status == FRAM_OK)
            status = report_loads(r, error);
    }
    if (status == FRAM_OK)
        status = report_field(r, error);
    if (status == FRAM_OK)
        status = report_fractures(r, error);
    if (status == FRAM_OK)
        status = report_books(r, error);
    if (status == FRAM_OK)
        status = appendix(r, error);
    html_end(&r->page);
    return status == FRAM_OK && r->page.text.failed ? error_memory(error) : status;
}

fram_status report_write(context *ctx, const char *folder, const char *output, notes_function notes, bool with_paths,
                         fram_error *error)
{
    char path[PATH_ROOM];
    report r = {.ctx = ctx, .notes = notes, .with_paths = with_paths, .page = {.ctx = ctx}};
    fram_status status = path_given_or(output, folder, "report.html", path, error);
    if (status == FRAM_OK)
        status = run_data_read(ctx, folder, true, NULL, &r.d, error);
    if (status != FRAM_OK)
        return status;
    run_warn_change(ctx, &r.d);
    status = compose_report(&r, error);
    if (status == FRAM_OK)
        status = text_file_write(ctx, path, &r.page.text, error);
    for (int32_t i = 0; i < r.kept.count; i++)
        memory_free(ctx, r.kept.data[i]);
    array_free(ctx, &r.kept);
    array_free(ctx, &r.load);
    html_free(&r.page);
    run_data_free(ctx, &r.d);
    return status;
}
