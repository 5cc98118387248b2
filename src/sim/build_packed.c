#include "sim/build_packed.h"

#include "base/transcendental.h"
#include "ice/field_pack.h"
#include "io/csv_read.h"
#include "io/template_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Random streams of what floes are made of; the numbers are part of what a seed means and never change. */
enum { STREAM_THICKNESS = 0x1d1000, STREAM_FLEXURAL, STREAM_CRUSHING };

/* Columns of a histogram file. */
enum { HISTOGRAM_LO = 0, HISTOGRAM_HI, HISTOGRAM_FLOES, HISTOGRAM_COLUMNS };

/* Part of an edge by which the next bin may begin beside it: programs write k * 0.6 for one and (k - 1) * 0.6 + 0.6 for
   the other. */
static const double SAME_EDGE = 1e-9;

/* What the laws of the populations point to. */
typedef struct population_files {
    field_population *population;
    polygon_list *templates; /* of each population */
    double_array *edge, *weight;
    int32_t count;
} population_files;

static void files_free(context *ctx, population_files *f)
{
    for (int32_t i = 0; f->templates && i < f->count; i++)
        polygon_list_free(ctx, &f->templates[i]);
    for (int32_t i = 0; f->edge && i < f->count; i++)
        array_free(ctx, &f->edge[i]);
    for (int32_t i = 0; f->weight && i < f->count; i++)
        array_free(ctx, &f->weight[i]);
    memory_free(ctx, f->population);
    memory_free(ctx, f->templates);
    memory_free(ctx, f->edge);
    memory_free(ctx, f->weight);
}

size_law population_size_law(const scenario_population *p)
{
    return (size_law){.kind = p->size,
                      .mean = p->diameter,
                      .deviation = p->diameter_deviation,
                      .lo = p->diameter_min,
                      .hi = p->diameter_max,
                      .exponent = p->exponent};
}

static fram_status resolve(const scenario *s, const char *file, int32_t number, const char *member,
                           char out[SCENARIO_PATH_ROOM], fram_error *error)
{
    char key[64];
    snprintf(key, sizeof key, "ice.populations[%d].%s", (int)number, member);
    return scenario_file_path(s, key, file, out, error);
}

/* Binning begins at 0, where there is no floe. */
static int32_t bins_before_floes(const double *lo, const double *floes, int32_t bins)
{
    int32_t first = 0;
    while (first < bins && lo[first] <= 0 && floes[first] == 0)
        first++;
    return first < bins ? first : 0;
}

/* Bins in rising order without gaps, as edges and numbers. */
static fram_status read_histogram(context *ctx, const scenario *s, int32_t number, population_files *f,
                                  fram_error *error)
{
    static const char *const names[HISTOGRAM_COLUMNS] = {"diameter_min[m]", "diameter_max[m]", "floes"};
    char path[SCENARIO_PATH_ROOM];
    double_array column[HISTOGRAM_COLUMNS] = {0};
    fram_status status = resolve(s, s->ice.populations.data[number].histogram, number, "histogram", path, error);
    if (status == FRAM_OK)
        status = csv_read(ctx, path, names, HISTOGRAM_COLUMNS, column, error);
    const double *lo = column[HISTOGRAM_LO].data, *hi = column[HISTOGRAM_HI].data;
    const double *floes = column[HISTOGRAM_FLOES].data;
    int32_t bins = column[HISTOGRAM_LO].count, first = bins_before_floes(lo, floes, bins), bin;
    for (int32_t i = first; i < bins && status == FRAM_OK; i++) {
        if (i > 0 && !(fabs(lo[i] - hi[i - 1]) <= SAME_EDGE * fabs(hi[i - 1])))
            status =
                error_set(error, FRAM_ERROR_INPUT, path, csv_line_of(ctx, path, i), "diameter_min",
                          "each bin must begin where the one before ends, at %.12g m, found %.12g m", hi[i - 1], lo[i]);
        else if ((i == first && !array_push(ctx, &f->edge[number], lo[i])) ||
                 !array_push(ctx, &f->edge[number], hi[i]) || !array_push(ctx, &f->weight[number], floes[i]))
            status = error_memory(error);
    }
    const char *fault =
        status == FRAM_OK ? size_bins_fault(f->edge[number].data, f->weight[number].data, bins - first, &bin) : NULL;
    if (fault)
        status = error_set(error, FRAM_ERROR_INPUT, path, bin < 0 ? 0 : csv_line_of(ctx, path, first + bin), NULL, "%s",
                           fault);
    for (int i = 0; i < HISTOGRAM_COLUMNS; i++)
        array_free(ctx, &column[i]);
    return status;
}

static fram_status read_templates(context *ctx, const scenario *s, overlay *plane, int32_t number, polygon_list *out,
                                  fram_error *error)
{
    char path[SCENARIO_PATH_ROOM];
    fram_status status = resolve(s, s->ice.populations.data[number].templates, number, "templates", path, error);
    return status == FRAM_OK ? template_file_read(ctx, plane, path, out, error) : status;
}

static fram_status read_population(context *ctx, const scenario *s, overlay *plane, int32_t number, population_files *f,
                                   fram_error *error)
{
    const scenario_population *p = &s->ice.populations.data[number];
    field_population *out = &f->population[number];
    fram_status status = FRAM_OK;
    if (p->size == SIZE_HISTOGRAM && !s->sizes)
        status = read_histogram(ctx, s, number, f, error);
    if (status == FRAM_OK && p->shape == POPULATION_TEMPLATES && plane)
        status = read_templates(ctx, s, plane, number, &f->templates[number], error);
    *out = (field_population){.share = p->share,
                              .size = population_size_law(p),
                              .shape = {.least_vertices = (int32_t)p->vertices_min,
                                        .most_vertices = (int32_t)p->vertices_max,
                                        .elongation = p->elongation,
                                        .templates = p->shape == POPULATION_TEMPLATES ? &f->templates[number] : NULL}};
    out->size.edge = f->edge[number].data;
    out->size.weight = f->weight[number].data;
    out->size.bins = f->weight[number].count;
    if (p->size == SIZE_HISTOGRAM && s->sizes)
        out->size = *s->sizes;
    return status;
}

/* plane: for the templates, which are not read without it. */
static fram_status read_populations(context *ctx, const scenario *s, overlay *plane, population_files *f,
                                    fram_error *error)
{
    int32_t count = s->ice.populations.count;
    f->count = count;
    f->population = memory_array(ctx, (size_t)count, sizeof *f->population);
    f->templates = memory_array(ctx, (size_t)count, sizeof *f->templates);
    f->edge = memory_array(ctx, (size_t)count, sizeof *f->edge);
    f->weight = memory_array(ctx, (size_t)count, sizeof *f->weight);
    bool good = f->population && f->templates && f->edge && f->weight;
    fram_status status = good ? FRAM_OK : error_memory(error);
    for (int32_t i = 0; i < count && good; i++) {
        f->templates[i] = (polygon_list){0};
        f->edge[i] = (double_array){0};
        f->weight[i] = (double_array){0};
    }
    for (int32_t i = 0; i < count && status == FRAM_OK; i++)
        status = read_population(ctx, s, plane, i, f, error);
    return status;
}

fram_status population_mean_area(context *ctx, const scenario *s, double *area, fram_error *error)
{
    population_files files = {0};
    double shares = 0, sum = 0;
    fram_status status = read_populations(ctx, s, NULL, &files, error);
    for (int32_t i = 0; i < s->ice.populations.count && status == FRAM_OK; i++) {
        shares += files.population[i].share;
        sum += files.population[i].share * size_law_mean_area(&files.population[i].size, SIZE_SLICES);
    }
    if (status == FRAM_OK)
        *area = sum / shares;
    files_free(ctx, &files);
    return status;
}

/* ---- what floes are made of ---- */

static double scattered(const scenario *s, uint32_t stream, int32_t floe, double mean, double deviation)
{
    if (!(deviation > 0))
        return mean;
    random_stream r = random_begin((uint64_t)s->run.seed, stream, (uint32_t)floe);
    return random_lognormal(&r, mean, deviation);
}

/* Of the floe-th floe that was drawn. */
static floe_traits population_traits(const scenario *s, int32_t population, int32_t floe)
{
    const scenario_population *p = &s->ice.populations.data[population];
    floe_traits mean = scenario_traits(s, p->thickness);
    return (floe_traits){.thickness = scattered(s, STREAM_THICKNESS, floe, mean.thickness, p->thickness_deviation),
                         .flexural_strength = scattered(s, STREAM_FLEXURAL, floe,
                                                        automatic_or(p->flexural_strength, mean.flexural_strength),
                                                        p->flexural_deviation),
                         .crushing_strength = scattered(s, STREAM_CRUSHING, floe,
                                                        automatic_or(p->crushing_strength, mean.crushing_strength),
                                                        p->crushing_deviation),
                         .breakable = mean.breakable && p->breakable};
}

/* ---- the field ---- */

static void log_populations(context *ctx, const field_population_report *parts, int32_t count,
                            const field_packed_report *report)
{
    for (int32_t i = 0; i < count; i++)
        log_write(ctx, LOG_INFO,
                  "population %d: %d floe%s, %.6g m2; distance of Kolmogorov and Smirnov from its law %.2g", (int)i + 1,
                  (int)parts[i].floes, parts[i].floes == 1 ? "" : "s", parts[i].area, parts[i].size_distance);
    log_write(ctx, LOG_INFO, "packed to %.4f in %d rounds; largest overlap %.2g m", report->field.concentration,
              (int)report->rounds, report->field.largest_overlap);
}

/* Part of the concentration that is asked from which on it is told that whole floes miss it. */
static const double MISSED = 0.005;

/* populations: those of the scenario, as they were drawn. */
static void tell_missed(context *ctx, const scenario *s, const field_population *populations, const drawn_ice *out)
{
    double asked = s->ice.concentration, reached = out->packed.field.concentration, least = HUGE_VAL, size;
    int32_t floes = 0;
    bool one = true;
    if (fabs(reached - asked) <= MISSED * asked)
        return;
    for (int32_t i = 0; i < out->parts.count; i++) {
        one = size_law_is_one_size(&populations[i].size, &size) && one;
        floes = size < least ? out->parts.data[i].floes : floes;
        least = fmin(least, size);
    }
    if (one && fabs(reached - asked) * out->packed.field.free_area <= PI / 4 * least * least)
        log_write(ctx, LOG_WARNING,
                  "ice.concentration: %.4g lies between %d and %d floes of %.4g m; it is %.4g with %d. A larger domain "
                  "or smaller floes come nearer",
                  asked, (int)floes - (reached > asked), (int)floes + (reached < asked), least, reached, (int)floes);
    else
        log_write(ctx, LOG_WARNING,
                  "ice.concentration: %.4g was asked and %.4g reached: floes are whole, and each population has one at "
                  "least. A larger domain or smaller floes come nearer",
                  asked, reached);
}

/* The scenario's word for a part of what is asked of the room of the ice. */
static const char *ice_key_of(const scenario *s, const char *member)
{
    if (strcmp(member, "mean_area") == 0)
        return "mean_floe_area";
    if (strcmp(member, "keep_out") != 0)
        return member;
    return s->ice.open_water.count > 0 ? "open_water"
           : s->ice.open_water_file[0] ? "open_water_file"
                                       : "keep_out_margin";
}

void name_ice_request(const scenario *s, fram_error *error)
{
    char member[sizeof error->key];
    if (!error || !error->key[0] || error->file[0])
        return;
    snprintf(member, sizeof member, "%s", error->key);
    const char *key = ice_key_of(s, member);
    snprintf(error->key, sizeof error->key, "%s%.100s", strcmp(member, "domain") == 0 ? "" : "ice.", key);
    scenario_locate(s, error);
}

fram_status draw_populations(context *ctx, const scenario *s, world *w, const polygon_list *keep_out, drawn_ice *out,
                             fram_error *error)
{
    population_files files = {0};
    polygon_list drawn = {0};
    int32_t count = s->ice.populations.count, before = polygon_list_count(&out->outlines);
    bool endless = s->domain.boundary == DOMAIN_FEEDING;
    fram_status status = array_resize(ctx, &out->parts, count)
                             ? read_populations(ctx, s, w->scratch.plane, &files, error)
                             : error_memory(error);
    const field_packed_request request = {.domain = domain_box(&s->domain),
                                          .periodic_x = endless,
                                          .periodic_y = endless,
                                          .concentration = s->ice.concentration,
                                          .populations = files.population,
                                          .population_count = count,
                                          .seed = (uint64_t)s->run.seed,
                                          .keep_out = keep_out,
                                          .present = before > 0 ? &out->outlines : NULL};
    if (status == FRAM_OK) {
        status =
            field_packed(ctx, w->scratch.plane, &request, &drawn, &out->shapes, out->parts.data, &out->packed, error);
        if (status == FRAM_ERROR_INPUT)
            name_ice_request(s, error);
    }
    for (int32_t i = 0; status == FRAM_OK && i < out->shapes.count; i++)
        if (!polygon_list_push(ctx, &out->outlines, polygon_list_get(&drawn, i)) ||
            !array_push(ctx, &out->traits, population_traits(s, out->shapes.data[i].population, i)))
            status = error_memory(error);
    if (status == FRAM_OK) {
        log_populations(ctx, out->parts.data, count, &out->packed);
        tell_missed(ctx, s, files.population, out);
        out->report = out->packed.field;
        out->report.floes += before;
    }
    polygon_list_free(ctx, &drawn);
    files_free(ctx, &files);
    return status;
}

/* Of sizes that stand in a file, as of those that the scenario's keys tell. */
static void tell_left_out_of_file(context *ctx, const scenario *s, const size_law *law)
{
    double area = s->ice.smallest_floe_area, across = sqrt(4 / PI * area), part = size_law_part(law, across);
    if (s->ice.populations.data[0].size == SIZE_HISTOGRAM && !s->sizes && part > POPULATION_LEFT_OUT)
        log_write(ctx, LOG_WARNING, POPULATION_LAW_CUT, area, across, part, 0, s->run.scale);
}

fram_status draw_managed(context *ctx, const scenario *s, world *w, field_request request, drawn_ice *out,
                         fram_error *error)
{
    population_files files = {0};
    fram_status status = array_resize(ctx, &out->parts, 1) ? read_populations(ctx, s, w->scratch.plane, &files, error)
                                                           : error_memory(error);
    if (status == FRAM_OK) {
        request.size = &files.population[0].size;
        tell_left_out_of_file(ctx, s, request.size);
        status = field_voronoi(ctx, &request, &out->outlines, &out->report, error);
        if (status == FRAM_ERROR_INPUT)
            name_ice_request(s, error);
    }
    for (int32_t i = 0; status == FRAM_OK && i < polygon_list_count(&out->outlines); i++)
        if (!array_push(ctx, &out->traits, population_traits(s, 0, i)))
            status = error_memory(error);
    if (status == FRAM_OK && !field_population_measure(ctx, request.size, &out->outlines, NULL, 0, out->parts.data))
        status = error_memory(error);
    files_free(ctx, &files);
    return status;
}
