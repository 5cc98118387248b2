/* station.csv and "Station" on the page: in how many runs a vessel kept the station that was required of it. */
#include "model/scenario_vessel.h"
#include "study/cells.h"
#include "study/key_names.h"
#include "study/proportion.h"
#include "study/study_file.h"
#include "study/study_page_parts.h"

#include <math.h>
#include <stdio.h>

/* What is required of the vessel under a condition, and in how many runs what happened.  runs is 0 where it is not on a
   station, or nothing is required. */
typedef struct station_count {
    double offset_limit, heading_limit; /* [m], [deg]; HUGE_VAL: none */
    bool lines;                         /* that may part */
    int32_t runs, kept, beyond_offset, beyond_heading, parted;
} station_count;

static bool lines_may_part(const scenario_vessel *v)
{
    bool may = false;
    for (int32_t i = 0; i < v->mooring.lines.count; i++)
        may |= !is_automatic(v->mooring.lines.data[i].breaking_load);
    return may;
}

static fram_status read_limits(const study_folder *f, int32_t condition, station_count *out, fram_error *error)
{
    scenario one = {0};
    int32_t vessel = 0;
    fram_status status = study_scenario(f->ctx, f->s, condition, f->s->seeds.first, &one, error);
    if (status != FRAM_OK)
        return status;
    status = scenario_choose_vessel(&one, f->s->file, f->s->vessel, &vessel, error);
    if (status == FRAM_OK) {
        const scenario_vessel *v = scenario_vessel_entry(&one, vessel).keys;
        *out = (station_count){.offset_limit = automatic_or(v->station.offset_limit, HUGE_VAL),
                               .heading_limit = automatic_or(v->station.heading_limit_deg, HUGE_VAL),
                               .lines = lines_may_part(v)};
    }
    scenario_free(f->ctx, &one);
    return status;
}

static bool is_judged(const station_count *c)
{
    return isfinite(c->offset_limit) || isfinite(c->heading_limit) || c->lines;
}

static bool is_on_station(const run_row *row) { return isfinite(row->figure[ROW_offset_largest]); }

static void count_runs(const condition_rows *of, station_count *out)
{
    for (int32_t i = 0; i < of->rows.count; i++) {
        const run_row *row = &of->rows.data[i];
        if (!is_on_station(row))
            continue;
        bool offset = row->figure[ROW_offset_largest] > out->offset_limit;
        bool heading = row->figure[ROW_heading_deviation_largest] > out->heading_limit;
        bool parted = row->figure[ROW_lines_broken] > 0;
        out->runs++;
        out->kept += !offset && !heading && !parted;
        out->beyond_offset += offset;
        out->beyond_heading += heading;
        out->parted += parted;
    }
}

parted_lines study_parted_lines(const condition_rows *of)
{
    parted_lines out = {0, HUGE_VAL};
    for (int32_t i = 0; i < of->rows.count; i++) {
        const double *figure = of->rows.data[i].figure;
        if (!(figure[ROW_lines_broken] > 0))
            continue;
        out.runs++;
        out.least = fmin(out.least, figure[ROW_line_tension_largest]);
    }
    return out;
}

typedef struct station_counts {
    station_count *of; /* each condition; memory_free */
    bool on_station, judged;
} station_counts;

static fram_status count_all(const study_folder *f, const condition_rows *conditions, station_counts *out,
                             fram_error *error)
{
    *out = (station_counts){.of = memory_array(f->ctx, (size_t)f->s->conditions, sizeof *out->of)};
    fram_status status = out->of ? FRAM_OK : error_memory(error);
    for (int32_t c = 0; c < f->s->conditions && status == FRAM_OK; c++) {
        bool on_station = false;
        out->of[c] = (station_count){.runs = 0};
        for (int32_t i = 0; i < conditions[c].rows.count && !on_station; i++)
            on_station = is_on_station(&conditions[c].rows.data[i]);
        if (!on_station)
            continue;
        out->on_station = true;
        status = read_limits(f, c, &out->of[c], error);
        if (status == FRAM_OK && is_judged(&out->of[c])) {
            out->judged = true;
            count_runs(&conditions[c], &out->of[c]);
        }
    }
    return status;
}

static proportion kept_of(const study_folder *f, const station_count *c)
{
    return proportion_of(c->kept, c->runs, f->s->seeds.confidence);
}

/* ---- the table ---- */

static void add_station_line(const study_folder *f, int32_t condition, const station_count *c, text_buffer *b)
{
    proportion kept = kept_of(f, c);
    text_format(f->ctx, b, "%d", (int)condition + 1);
    cell_number(f->ctx, b, c->offset_limit);
    cell_number(f->ctx, b, c->heading_limit);
    text_format(f->ctx, b, ",%d,%d", (int)c->runs, (int)c->kept);
    cell_number(f->ctx, b, kept.share);
    cell_number(f->ctx, b, kept.low);
    cell_number(f->ctx, b, kept.high);
    text_format(f->ctx, b, ",%d,%d,%d\n", (int)c->beyond_offset, (int)c->beyond_heading, (int)c->parted);
}

static fram_status write_station_lines(const study_folder *f, const station_counts *counts, fram_error *error)
{
    text_buffer b = {0};
    text_add(f->ctx, &b,
             "condition,offset_limit[m],heading_limit[deg],runs,kept,share[1],low[1],high[1],beyond_offset,"
             "beyond_heading,lines_parted\n");
    for (int32_t c = 0; c < f->s->conditions; c++)
        if (counts->of[c].runs > 0)
            add_station_line(f, c, &counts->of[c], &b);
    fram_status status = study_table_write(f, "station.csv", &b, error);
    text_free(f->ctx, &b);
    return status;
}

fram_status study_station_write(const study_folder *f, const condition_rows *conditions, fram_error *error)
{
    station_counts counts;
    fram_status status = count_all(f, conditions, &counts, error);
    if (status == FRAM_OK && counts.judged)
        status = write_station_lines(f, &counts, error);
    else if (status == FRAM_OK)
        study_table_remove(f, "station.csv");
    memory_free(f->ctx, counts.of);
    return status;
}

/* ---- on the page ---- */

static void add_station_row(study_page *p, int32_t condition, const station_count *c)
{
    char text[64];
    const int32_t number[] = {c->kept, c->beyond_offset, c->beyond_heading, c->parted};
    const bool asked[] = {true, isfinite(c->offset_limit), isfinite(c->heading_limit), c->lines};
    proportion kept = kept_of(p->f, c);
    page_row_begin(p, condition);
    html_number(&p->page, isfinite(c->offset_limit) ? c->offset_limit : (double)NAN);
    html_number(&p->page, isfinite(c->heading_limit) ? c->heading_limit : (double)NAN);
    snprintf(text, sizeof text, "%.0f (%.0f to %.0f)", 100 * kept.share, 100 * kept.low, 100 * kept.high);
    html_cell(&p->page, text);
    for (size_t i = 0; i < sizeof number / sizeof *number; i++) {
        snprintf(text, sizeof text, "%d of %d", (int)number[i], (int)c->runs);
        html_cell(&p->page, asked[i] ? text : "–");
    }
    html_row_end(&p->page);
}

static void add_station_table(study_page *p, const station_counts *counts)
{
    static const char *const heads[] = {"offset limit [m]",  "heading limit [deg]", "kept [%]",     "kept",
                                        "beyond the offset", "beyond the heading",  "a line parted"};
    page_table_begin(p, heads, sizeof heads / sizeof *heads);
    for (int32_t c = 0; c < p->f->s->conditions && c < CONDITIONS_OF_TABLE; c++)
        if (counts->of[c].runs > 0)
            add_station_row(p, c, &counts->of[c]);
    page_table_end(p);
    html_paragraph(
        &p->page,
        "A run keeps station where, after the transient, offset and heading stay within station.offset_limit "
        "and station.heading_limit_deg, as far as the scenario gives them, and no line has parted. In brackets "
        "the interval of %g %% of the chance to keep it (exact: Clopper and Pearson 1934). Runs that failed "
        "are not counted. station.csv has all of it.",
        100 * p->f->s->seeds.confidence);
}

static void add_map(study_page *p, const station_counts *counts)
{
    page_heat of;
    double value[PAGE_HEAT_MOST] = {0};
    if (!page_heat_find(p->f->s, &of))
        return;
    for (int32_t c = 0; c < p->f->s->conditions; c++)
        value[c] = 100 * kept_of(p->f, &counts->of[c]).share;
    page_add_heat(p, &of, "Runs that kept station [%]", (page_heat_scale){"#2e7d4f", 100}, value);
}

/* Conditions of a group, from its first on or from its last back, all of whose runs kept station. */
static int32_t kept_length(const study_series *s, int32_t group, bool back, const station_counts *counts)
{
    int32_t n = 0;
    for (; n < s->length; n++) {
        const station_count *c = &counts->of[group * s->length + (back ? s->length - 1 - n : n)];
        if (c->runs == 0 || c->kept < c->runs)
            break;
    }
    return n;
}

/* Up to which value of the key of a series all runs kept station; or from which on, as of limits and lines. */
static void add_ends(study_page *p, const station_counts *counts)
{
    study_series series;
    const study *s = p->f->s;
    if (!study_series_find(s, &series))
        return;
    for (int32_t g = 0; g < series.groups; g++) {
        char group[PAGE_GROUP_SIZE], value[PAGE_KEY_SIZE];
        int32_t kept = kept_length(&series, g, false, counts), last = kept > 0 ? kept - 1 : 0;
        int32_t above = kept > 0 ? 0 : kept_length(&series, g, true, counts);
        last = above > 0 ? series.length - above : last;
        page_group_name(p, &series, g, false, group);
        page_key_text(p, g * series.length + last, series.key, value);
        const char *unit = key_unit(s->keys.data[series.key]);
        html_paragraph(&p->page, "%s%s %s %s %s%s%s%s.", group, *group ? ": station" : "Station",
                       kept > 0    ? "was kept in all runs up to"
                       : above > 0 ? "was kept in all runs from"
                                   : "was not kept in all runs at",
                       s->keys.data[series.key], value, *unit ? " " : "", unit,
                       kept == series.length ? ", the largest"
                       : above > 0           ? " on"
                       : kept == 0           ? ", the smallest"
                                             : "");
    }
}

fram_status page_add_station(study_page *p, fram_error *error)
{
    station_counts counts;
    fram_status status = count_all(p->f, p->conditions, &counts, error);
    if (status == FRAM_OK && counts.on_station) {
        html_section(&p->page, "Station");
        if (counts.judged) {
            add_station_table(p, &counts);
            add_map(p, &counts);
            add_ends(p, &counts);
        } else {
            html_paragraph(&p->page, "Nothing is required of the station: give station.offset_limit, "
                                     "station.heading_limit_deg or a breaking_load of the lines, and this page tells "
                                     "in how many runs the vessel keeps it.");
        }
    }
    memory_free(p->f->ctx, counts.of);
    return status;
}
