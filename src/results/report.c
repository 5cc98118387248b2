#include "results/report.h"

#include "io/atomic_file.h"
#include "io/scenario_file.h"
#include "results/report_parts.h"
#include "results/station_results.h"

#include <stdio.h>
#include <string.h>

static bool find_load(report *r)
{
    const double *x = run_channel(&r->d, "ice_force_averaged_x"), *y = run_channel(&r->d, "ice_force_averaged_y");
    for (int32_t i = 0; x && y && i < r->d.series.rows; i++) {
        if (!array_push(r->ctx, &r->load, sqrt(x[i] * x[i] + y[i] * y[i])))
            return false;
    }
    return true;
}

static void figure(report *r, const char *name, double value, const char *unit)
{
    char text[32];
    html_number_text(value, text);
    html_figure(&r->page, name, text, unit);
}

static void key_figures(report *r)
{
    const double *time = run_channel(&r->d, "time");
    html_figures_begin(&r->page);
    if (r->d.s.vessel.present && time) {
        load_unit unit = report_load_unit(r);
        channel_statistics s = channel_statistics_of(time, r->load.data, r->load.count, r->d.s.run.transient);
        figure(r, "mean ice load", s.mean * unit.factor, unit.name);
        figure(r, "significant peak", s.significant * unit.factor, unit.name);
        figure(r, "largest ice load, averaged", s.greatest * unit.factor, unit.name);
    }
    figure(r, "simulated", r->d.note.time, "s");
    if (r->d.frames > 0)
        figure(r, "floes at the start", r->d.before.areas.count, "");
    figure(r, "floes that broke", r->d.fractures.rows, "");
    if (station_has_results(&r->d.s) && time) {
        const double *x = run_channel(&r->d, "offset_x"), *y = run_channel(&r->d, "offset_y");
        double most = 0;
        for (int32_t i = run_first_row(&r->d); x && y && i < r->d.series.rows; i++)
            most = fmax(most, sqrt(x[i] * x[i] + y[i] * y[i]));
        figure(r, "largest offset", most, "m");
    }
    html_figures_end(&r->page);
}

static const char *const modes[] = {"prescribed motion", "towed", "free"};
static const char *const forms[] = {"box", "icebreaking hull", "hull from a file", "cone"};

static const char *const boundaries[] = {"walls", "open", "in an endless field that drifts through"};

static void scenario_table(report *r)
{
    const scenario *s = &r->d.s;
    const scenario_vessel *v = &s->vessel;
    const scenario_hull *h = &v->hull;
    const scenario_ice *i = &s->ice;
    html_section(&r->page, "Scenario");
    html_table_begin(&r->page, NULL, 0);
    if (v->present) {
        html_fact(&r->page, "vessel", "%s, %s; %g m long, %g m wide, %g m draught", forms[h->form], modes[v->mode],
                  h->length, h->beam, h->draught);
        html_fact(&r->page, "speed and heading", "%g m/s, %g deg", v->speed, v->heading_deg);
    }
    if (v->present && v->mode == VESSEL_FREE && (v->mooring.lines.count > 0 || v->thrusters.count > 0))
        html_fact(&r->page, "kept by", "mooring lines in groups: %d, thrusters: %d%s", (int)v->mooring.lines.count,
                  (int)v->thrusters.count, v->positioning.active ? ", dynamic positioning" : "");
    if (i->source != ICE_NONE) {
        html_fact(&r->page, "ice", "%g m thick, %g kg/m3; crushing %g kPa, flexural strength %g kPa; %s", i->thickness,
                  i->density, i->crushing_strength * 1e-3, i->flexural_strength * 1e-3,
                  i->breakable ? "breaks" : "does not break");
        if (i->source == ICE_VORONOI)
            html_fact(&r->page, "field", "managed ice, %g %% asked for, floes of %g m2 on average",
                      100 * i->concentration, i->mean_floe_area);
    }
    html_fact(&r->page, "domain", "%g m x %g m, %s", s->domain.x_max - s->domain.x_min,
              s->domain.y_max - s->domain.y_min, boundaries[s->domain.boundary]);
    html_fact(&r->page, "current and wind", "%g m/s towards %g deg; %g m/s towards %g deg",
              s->environment.current_speed, s->environment.current_direction_deg, s->environment.wind_speed,
              s->environment.wind_direction_deg);
    html_fact(&r->page, "run", "%g s in steps of %g s, seed %lld", s->run.duration, s->run.time_step,
              (long long)s->run.seed);
    html_table_end(&r->page);
}

static fram_status appendix(report *r, fram_error *error)
{
    text_buffer notes = {0}, text = {0};
    r->notes(r->ctx, &r->d.s, &notes);
    const scenario_print_options options = {.comments = true, .names_only = !r->with_paths};
    fram_status status = notes.failed ? error_memory(error) : scenario_print(r->ctx, &r->d.s, &options, &text, error);
    if (status == FRAM_OK) {
        html_section(&r->page, "What follows from the scenario");
        html_verbatim(&r->page, notes.data ? notes.data : "");
        html_section(&r->page, "The whole scenario");
        html_verbatim(&r->page, text.data);
    }
    text_free(r->ctx, &notes);
    text_free(r->ctx, &text);
    return status;
}

static fram_status compose(report *r, fram_error *error)
{
    char subtitle[1400];
    const char *folder = r->d.folder, *slash = strrchr(folder, '/');
    if (folder[0] == '/' && slash[1] && !r->with_paths)
        folder = slash + 1;
    snprintf(subtitle, sizeof subtitle, "Run %s in %.1000s, %g s simulated; Fram %s", r->d.note.status, folder,
             r->d.note.time, r->d.note.version);
    html_begin(&r->page, r->d.s.title[0] ? r->d.s.title : "A run of Fram", subtitle);
    key_figures(r);
    scenario_table(r);
    fram_status status = report_loads(r, error);
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
        status = run_data_read(ctx, folder, true, &r.d, error);
    if (status != FRAM_OK)
        return status;
    status = find_load(&r) ? compose(&r, error) : error_memory(error);
    if (status == FRAM_OK)
        status = atomic_file_write(ctx, path, r.page.text.data, (size_t)r.page.text.count, error);
    for (int32_t i = 0; i < r.kept.count; i++)
        memory_free(ctx, r.kept.data[i]);
    array_free(ctx, &r.kept);
    array_free(ctx, &r.load);
    html_free(&r.page);
    run_data_free(ctx, &r.d);
    return status;
}
