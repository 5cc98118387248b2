/* Generation of packed fields: time on one thread, and what came of each, measured on the outlines.

       field_bench [STEP_MS [TEMPLATES]]      STEP_MS: what a step of 10,000 floes takes, to tell the multiple;
                                              TEMPLATES: a file of outlines that are packed too, as shapes */
#include "base/pool.h"
#include "base/transcendental.h"
#include "ice/field_pack.h"
#include "io/outline_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef struct field_case {
    const char *name;
    size_law size;
    double concentration;
    int32_t floes; /* about */
    bool templates;
} field_case;

static const size_law power = {.kind = SIZE_POWER, .lo = 4, .hi = 40, .exponent = 1.7};
static const size_law equal = {.kind = SIZE_UNIFORM, .lo = 9, .hi = 11};
static const shape_law convex = {.least_vertices = 5, .most_vertices = 9, .elongation = 1.5};

static double cpu_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Side of a square that about `floes` floes of a law fill to a concentration [m]. */
static double side_of(const size_law *law, int32_t floes, double concentration)
{
    enum { SLICES = 10000 };
    double area = 0;
    for (int i = 0; i < SLICES; i++) {
        double d = size_law_quantile(law, (i + 0.5) / SLICES);
        area += PI / 4 * d * d / SLICES;
    }
    return sqrt(floes * area / concentration);
}

static bool measure(context *ctx, overlay *plane, const field_case *c, const polygon_list *templates, double step_ms)
{
    shape_law shape = convex;
    shape.templates = c->templates ? templates : NULL;
    const field_population population = {.share = 1, .size = c->size, .shape = shape};
    double side = side_of(&c->size, c->floes, c->concentration);
    const field_packed_request request = {.domain = {{0, 0}, {side, side}},
                                          .concentration = c->concentration,
                                          .populations = &population,
                                          .population_count = 1,
                                          .seed = 1};
    polygon_list outlines = {0};
    int32_array of = {0};
    field_population_report part;
    field_packed_report report;
    fram_error error = {0};
    double start = cpu_seconds();
    fram_status status = field_packed(ctx, plane, &request, &outlines, &of, &part, &report, &error);
    double seconds = cpu_seconds() - start;
    if (status == FRAM_OK)
        printf("| %s | %d | %.4f | %.1f | %.0f | %.2g | %.2g | %.1g | %d |\n", c->name, (int)part.floes,
               report.field.concentration, seconds, 1e3 * seconds / step_ms, report.field.largest_overlap,
               part.size_distance, report.area_change, (int)report.vertex_changes);
    else
        printf("| %s | %s (%.1f s) |\n", c->name, error.message, seconds);
    fflush(stdout);
    polygon_list_free(ctx, &outlines);
    array_free(ctx, &of);
    return status == FRAM_OK;
}

static fram_status read_templates(context *ctx, overlay *plane, const char *path, polygon_list *out, fram_error *error)
{
    import_rings rings = {0};
    import_field field = {0};
    const import_options options = {.name = path, .scale = 1, .bad = IMPORT_DROP};
    fram_status status = outline_file_read(ctx, path, &rings, error);
    for (int32_t i = 0; i < rings.place.count; i++)
        rings.place.data[i].open = false;
    if (status == FRAM_OK)
        status = import_field_make(ctx, plane, &rings, &options, &field, error);
    for (int32_t i = 0; status == FRAM_OK && i < polygon_list_count(&field.outlines); i++)
        if (!polygon_list_push(ctx, out, polygon_list_get(&field.outlines, i)))
            status = error_memory(error);
    import_rings_free(ctx, &rings);
    import_field_free(ctx, &field);
    return status;
}

int main(int argc, char **argv)
{
    const field_case cases[] = {
        {"power law, b 1.7, 4 to 40 m, 90 %", power, 0.9, 10000, false},
        {"9 to 11 m, 80 %", equal, 0.8, 10000, false},
        {"9 to 11 m, 80 %", equal, 0.8, 100000, false},
        {"templates, power law, 85 %", power, 0.85, 2000, true},
    };
    double step_ms = argc > 1 ? atof(argv[1]) : 5;
    context ctx;
    context_init(&ctx);
    overlay *plane = overlay_create(&ctx);
    polygon_list templates = {0};
    fram_error error = {0};
    bool good = plane != NULL;
    if (good && argc > 2 && read_templates(&ctx, plane, argv[2], &templates, &error) != FRAM_OK) {
        fprintf(stderr, "%s: %s\n", argv[2], error.message);
        good = false;
    }
    printf("| field | floes | concentration | CPU s | steps of %.3g ms | overlap m | KS | area change "
           "| vertices changed |\n"
           "|---|---|---|---|---|---|---|---|---|\n",
           step_ms);
    for (size_t i = 0; good && i < sizeof cases / sizeof *cases; i++)
        if (!cases[i].templates || polygon_list_count(&templates) > 0)
            good = measure(&ctx, plane, &cases[i], &templates, step_ms) && good;
    polygon_list_free(&ctx, &templates);
    if (plane)
        overlay_free(plane);
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
