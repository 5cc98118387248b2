/* Generation of fields of every kind: seeds that succeed, time on one thread, and what came of them, measured on the
   outlines.

       field_bench [--kind NAME] [--seeds N] [--first SEED] [--floes N] [--step MS] [--concentration C]
                   [--templates FILE] [--periodic 1]

   --kind: one row only; --seeds: so many, 1; --first: the first of them, 1; --floes: about so many, 10,000; --step:
   what a step of 10,000 floes takes, to tell the multiple; --concentration: instead of the kind's own; --templates: a
   file of outlines, without which the kinds that need them are passed over; --periodic: the field continues with itself
   beyond its edges, between which it lies otherwise. */
#include "base/transcendental.h"
#include "ice/field_pack.h"
#include "io/template_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST_POPULATIONS = 3 };

typedef struct field_kind {
    const char *name, *told;
    double concentration;
    double floes; /* over those asked for */
    bool cells;   /* managed ice instead of a packed field */
    bool templates;
    int32_t populations; /* 0 with templates: each of them is one, of a single floe as it is */
    field_population population[MOST_POPULATIONS];
} field_kind;

typedef struct field_words {
    const char *kind, *templates;
    int seeds, first, floes;
    double step_ms, concentration;
    bool periodic;
} field_words;

/* Floes to be drawn. */
typedef struct field_laws {
    field_population *population;
    polygon_list *one; /* with a population for every template: that template; else NULL */
    int32_t count;
    field_population_report *part; /* of each */
} field_laws;

/* Worst of all seeds. */
typedef struct field_worst {
    int good, floes;
    double least, most; /* concentrations */
    double first_seconds, seconds, overlap, distance, area_change;
    int vertex_changes;
    char message[600]; /* of the last seed that failed */
} field_worst;

#define CONVEX          \
    {                   \
        5, 9, 1.5, NULL \
    }
#define POWER                                                  \
    {                                                          \
        .kind = SIZE_POWER, .lo = 4, .hi = 40, .exponent = 1.7 \
    }
#define EQUAL                                   \
    {                                           \
        .kind = SIZE_UNIFORM, .lo = 9, .hi = 11 \
    }

static const field_kind kinds[] = {
    {"power", "convex, power law, b 1.7, 4 to 40 m, 90 %", 0.9, 1, false, false, 1, {{1, POWER, CONVEX}}},
    {"equal", "convex, 9 to 11 m, 80 %", 0.8, 1, false, false, 1, {{1, EQUAL, CONVEX}}},
    {"voronoi", "Voronoi, 98 %", 0.98, 1, true, false, 0, {{0, EQUAL, CONVEX}}},
    {"managed", "Voronoi, power law, b 1.7, 4 to 40 m, 98 %", 0.98, 1, true, false, 1, {{1, POWER, CONVEX}}},
    {"templates",
     "templates, power law, b 1.7, 4 to 40 m, 85 %",
     0.85,
     0.0462,
     false,
     true,
     1,
     {{1, {.kind = SIZE_POWER, .lo = 4, .hi = 40, .exponent = 1.7}, CONVEX}}},
    {"wide",
     "templates, power law, b 1.7, 2 to 40 m, 85 %",
     0.85,
     0.2772,
     false,
     true,
     1,
     {{1, {.kind = SIZE_POWER, .lo = 2, .hi = 40, .exponent = 1.7}, CONVEX}}},
    {"observed", "every template once, at its own size, 85 %", 0.85, 1, false, true, 0, {{0, EQUAL, CONVEX}}},
    {"mixed",
     "mixed: lognormal 20 m, power law 4 to 40 m, pieces of 3 m; 85 %",
     0.85,
     1,
     false,
     false,
     3,
     {{3, {.kind = SIZE_LOGNORMAL, .mean = 20, .deviation = 8, .lo = 5, .hi = 60}, CONVEX},
      {2, POWER, CONVEX},
      {1, {.kind = SIZE_CONSTANT, .mean = 3}, {4, 6, 1.3, NULL}}}},
    {"brash",
     "brash: lognormal 0.8 m, deviation 0.4, 0.3 to 2 m; 80 %",
     0.8,
     1,
     false,
     false,
     1,
     {{1, {.kind = SIZE_LOGNORMAL, .mean = 0.8, .deviation = 0.4, .lo = 0.3, .hi = 2}, {4, 7, 1.5, NULL}}}},
    {"many", "convex, 9 to 11 m, 80 %, ten times as many", 0.8, 10, false, false, 1, {{1, EQUAL, CONVEX}}},
};
/* Of a Voronoi cell without a law of size [m2]. */
static const double CELL_AREA = 100;

static double cpu_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Mean area of a law's floes [m2]. */
static double mean_area(const size_law *law)
{
    enum { SLICES = 10000 };
    double area = 0;
    for (int i = 0; i < SLICES; i++) {
        double d = size_law_quantile(law, (i + 0.5) / SLICES);
        area += PI / 4 * d * d / SLICES;
    }
    return area;
}

/* Side of a square that about `floes` floes of a kind fill to its concentration [m]. */
static double side_of(const field_kind *k, const field_laws *laws, double floes)
{
    double shares = 0, each = 0; /* floes to an area of 1 */
    for (int p = 0; p < laws->count; p++)
        shares += laws->population[p].share;
    if (laws->one) /* the share is the area */
        return sqrt(shares / k->concentration);
    for (int p = 0; p < laws->count; p++)
        each += laws->population[p].share / shares / mean_area(&laws->population[p].size);
    return laws->count ? sqrt(floes / each / k->concentration) : sqrt(floes * CELL_AREA);
}

static void laws_free(context *ctx, field_laws *laws)
{
    for (int32_t p = 0; laws->one && p < laws->count; p++)
        polygon_list_free(ctx, &laws->one[p]);
    memory_free(ctx, laws->population);
    memory_free(ctx, laws->one);
    memory_free(ctx, laws->part);
}

/* false: no memory */
static bool laws_make(context *ctx, const field_kind *k, const polygon_list *templates, field_laws *laws)
{
    bool own = k->templates && k->populations == 0;
    int32_t count = own ? polygon_list_count(templates) : k->populations;
    *laws = (field_laws){.count = count};
    laws->population = memory_array(ctx, (size_t)count + 1, sizeof *laws->population);
    laws->part = memory_array(ctx, (size_t)count + 1, sizeof *laws->part);
    laws->one = own ? memory_array(ctx, (size_t)count, sizeof *laws->one) : NULL;
    bool good = laws->population && laws->part && (!own || laws->one);
    for (int32_t p = 0; good && p < count; p++) {
        laws->part[p] = (field_population_report){0};
        if (!own) {
            laws->population[p] = k->population[p];
            laws->population[p].shape.templates = k->templates ? templates : NULL;
            continue;
        }
        polygon outline = polygon_list_get(templates, p);
        double area = polygon_area(outline);
        laws->one[p] = (polygon_list){0};
        good = polygon_list_push(ctx, &laws->one[p], outline);
        laws->population[p] = (field_population){
            area, {.kind = SIZE_CONSTANT, .mean = sqrt(4 / PI * area)}, {.templates = &laws->one[p]}};
    }
    return good;
}

static fram_status make_voronoi(context *ctx, const field_kind *k, const field_laws *laws, double side, uint64_t seed,
                                polygon_list *outlines, field_packed_report *report, fram_error *error)
{
    const size_law *law = laws->count ? &laws->population[0].size : NULL;
    const field_request request = {.domain = {{0, 0}, {side, side}},
                                   .concentration = k->concentration,
                                   .size = law,
                                   .mean_area = CELL_AREA,
                                   .size_deviation = 0.8,
                                   .roundness = 0.5,
                                   .seed = seed};
    *report = (field_packed_report){0};
    fram_status status = field_voronoi(ctx, &request, outlines, &report->field, error);
    if (status == FRAM_OK && law && !field_population_measure(ctx, law, outlines, NULL, 0, laws->part))
        status = error_memory(error);
    return status;
}

static fram_status make_packed(context *ctx, overlay *plane, const field_kind *k, const field_laws *laws, double side,
                               bool periodic, uint64_t seed, polygon_list *outlines, field_packed_report *report,
                               fram_error *error)
{
    field_floe_array of = {0};
    const field_packed_request request = {.domain = {{0, 0}, {side, side}},
                                          .periodic_x = periodic,
                                          .periodic_y = periodic,
                                          .concentration = k->concentration,
                                          .populations = laws->population,
                                          .population_count = laws->count,
                                          .seed = seed};
    fram_status status = field_packed(ctx, plane, &request, outlines, &of, laws->part, report, error);
    array_free(ctx, &of);
    return status;
}

static void take_worst(const field_laws *laws, const field_packed_report *report, field_worst *w)
{
    const field_report *f = &report->field;
    w->good++;
    w->floes = (int)f->floes;
    w->least = fmin(w->least, f->concentration);
    w->most = fmax(w->most, f->concentration);
    w->overlap = fmax(w->overlap, f->largest_overlap);
    for (int p = 0; p < laws->count; p++)
        w->distance = fmax(w->distance, laws->part[p].size_distance);
    w->area_change = fmax(w->area_change, report->area_change);
    w->vertex_changes += (int)report->vertex_changes;
}

static bool measure(context *ctx, overlay *plane, const field_kind *k, const polygon_list *templates,
                    const field_words *words)
{
    field_worst w = {.least = 1};
    field_laws laws;
    if (!laws_make(ctx, k, templates, &laws)) {
        laws_free(ctx, &laws);
        return false;
    }
    double side = side_of(k, &laws, k->floes * words->floes);
    for (int seed = words->first; seed < words->first + words->seeds; seed++) {
        polygon_list outlines = {0};
        field_packed_report report = {0};
        fram_error error = {0};
        double start = cpu_seconds();
        fram_status status = k->cells ? make_voronoi(ctx, k, &laws, side, (uint64_t)seed, &outlines, &report, &error)
                                      : make_packed(ctx, plane, k, &laws, side, words->periodic, (uint64_t)seed,
                                                    &outlines, &report, &error);
        double seconds = cpu_seconds() - start;
        w.first_seconds = seed == words->first ? seconds : w.first_seconds;
        w.seconds = fmax(w.seconds, seconds);
        if (status == FRAM_OK)
            take_worst(&laws, &report, &w);
        else
            snprintf(w.message, sizeof w.message, "seed %d: %s", seed, error.message);
        polygon_list_free(ctx, &outlines);
    }
    laws_free(ctx, &laws);
    printf("| %s%s | %d | %d of %d | %.4f to %.4f | %.1f | %.1f | %.0f | %.2g | %.2g | %.1g | %d |\n", k->told,
           words->periodic ? ", periodic" : "", w.floes, w.good, words->seeds, w.least, w.most, w.first_seconds,
           w.seconds, 1e3 * w.seconds / words->step_ms, w.overlap, w.distance, w.area_change, w.vertex_changes);
    if (w.message[0])
        printf("\n%s\n\n", w.message);
    fflush(stdout);
    return w.good == words->seeds;
}

static bool read_words(int argc, char **argv, field_words *w)
{
    for (int i = 1; i < argc; i += 2) {
        const char *value = i + 1 < argc ? argv[i + 1] : NULL;
        if (value && strcmp(argv[i], "--kind") == 0)
            w->kind = value;
        else if (value && strcmp(argv[i], "--templates") == 0)
            w->templates = value;
        else if (value && strcmp(argv[i], "--seeds") == 0)
            w->seeds = atoi(value);
        else if (value && strcmp(argv[i], "--first") == 0)
            w->first = atoi(value);
        else if (value && strcmp(argv[i], "--floes") == 0)
            w->floes = atoi(value);
        else if (value && strcmp(argv[i], "--concentration") == 0)
            w->concentration = atof(value);
        else if (value && strcmp(argv[i], "--periodic") == 0)
            w->periodic = atoi(value) != 0;
        else if (value && strcmp(argv[i], "--step") == 0)
            w->step_ms = atof(value);
        else
            return false;
    }
    return true;
}

int main(int argc, char **argv)
{
    field_words words = {.seeds = 1, .first = 1, .floes = 10000, .step_ms = 10};
    context ctx;
    context_init(&ctx);
    overlay *plane = overlay_create(&ctx);
    polygon_list templates = {0};
    fram_error error = {0};
    bool good = plane != NULL && read_words(argc, argv, &words);
    if (!good)
        fprintf(stderr,
                "field_bench [--kind NAME] [--seeds N] [--first SEED] [--floes N] [--step MS] [--concentration C] "
                "[--templates FILE] [--periodic 1]\n");
    if (good && words.templates && template_file_read(&ctx, plane, words.templates, &templates, &error) != FRAM_OK) {
        fprintf(stderr, "%s: %s\n", words.templates, error.message);
        good = false;
    }
    if (good)
        printf("| field | floes | seeds | concentration | CPU s, first seed | CPU s, slowest | steps of %.3g ms | "
               "overlap m | KS | area change | vertices changed |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
               words.step_ms);
    bool all = good;
    for (size_t i = 0; good && i < sizeof kinds / sizeof *kinds; i++) {
        bool wanted = !words.kind || strcmp(words.kind, kinds[i].name) == 0;
        field_kind kind = kinds[i];
        kind.concentration = words.concentration > 0 ? words.concentration : kind.concentration;
        if (wanted && (!kind.templates || polygon_list_count(&templates) > 0))
            all = measure(&ctx, plane, &kind, &templates, &words) && all;
    }
    polygon_list_free(&ctx, &templates);
    if (plane)
        overlay_free(plane);
    return all ? EXIT_SUCCESS : EXIT_FAILURE;
}
