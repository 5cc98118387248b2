/* Ice fields of scenarios, and how they were made. */
#include "api/arguments.h"
#include "api/field_handle.h"

#include "ice/field_measure.h"
#include "sim/build.h"

#include <math.h>

_Static_assert((int)FRAM_FIELD_BINS == (int)SIZE_BINS, "one number of bins");

/* Whether a floe is of other ice than those that a file gives the same scenario. */
static bool is_other_ice(const scenario *s, const floe_traits *t)
{
    const floe_traits own = scenario_traits(s, t->thickness);
    return t->flexural_strength < own.flexural_strength || t->flexural_strength > own.flexural_strength ||
           t->crushing_strength < own.crushing_strength || t->crushing_strength > own.crushing_strength ||
           t->breakable != own.breakable;
}

static fram_status generate(fram_field *f, const scenario *s, overlay *plane, fram_error *error)
{
    context *ctx = &f->context->inner;
    fram_status status = build_outlines(ctx, s, &f->drawn, &f->window, error);
    f->source = f->drawn.source;
    f->floes = f->drawn.file;
    f->drawn.source = (import_rings){0};
    f->drawn.file = (import_field){0};
    array_clear(&f->floes.thickness); /* of the file; those of the scenario follow */
    for (int32_t i = 0; status == FRAM_OK && i < f->drawn.traits.count; i++) {
        const floe_traits *t = &f->drawn.traits.data[i];
        f->other_ice = f->other_ice || is_other_ice(s, t);
        if (!array_push(ctx, &f->floes.thickness, t->thickness))
            status = error_memory(error);
    }
    if (status != FRAM_OK)
        return status;
    f->floes.outlines = f->drawn.outlines;
    f->drawn.outlines = (polygon_list){0};
    if (s->domain.boundary == DOMAIN_FEEDING)
        f->period = vec2_sub(f->window.hi, f->window.lo);
    bool asked = s->ice.source != ICE_FILE || s->ice.populations.count > 0;
    f->tile = s->domain.boundary == DOMAIN_FEEDING;
    f->target = asked ? s->ice.concentration : (double)NAN;
    return field_describe(f, plane, NULL, error);
}

fram_status fram_field_generate(const fram_scenario *s, fram_field **out, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"scenario", s}, {"field", out});
    if (status != FRAM_OK)
        return status;
    context *ctx = &s->context->inner;
    fram_field *f = memory_array(ctx, 1, sizeof *f);
    overlay *plane = f ? overlay_create(ctx) : NULL;
    if (f) {
        *f = (fram_field){.context = s->context, .generated = true};
        fram_field_default(&f->made);
        /* The field may outlive the scenario. */
        if (s->read.count > 0)
            text_add_bytes(ctx, &f->read, s->read.data, (size_t)s->read.count);
    }
    status = plane && !f->read.failed ? generate(f, &s->inner, plane, error) : error_memory(error);
    if (plane)
        overlay_free(plane);
    if (status == FRAM_OK)
        *out = f;
    else
        fram_field_destroy(f);
    return status;
}

double fram_field_concentration(const fram_field *f, const double lo[2], const double hi[2])
{
    bool window = f && lo && hi && lo[0] < hi[0] && lo[1] < hi[1];
    if (!window || !isfinite(hi[0] - lo[0]) || !isfinite(hi[1] - lo[1]))
        return (double)NAN;
    return field_concentration(&f->floes.outlines, f->period, (box2){{lo[0], lo[1]}, {hi[0], hi[1]}});
}

bool(fram_field_making_get)(const fram_field *f, fram_field_making *making, size_t size)
{
    if (!f || !making || !f->generated || RESULT_CHECK(making, size, fram_field_making, NULL) != FRAM_OK)
        return false;
    const drawn_ice *d = &f->drawn;
    const fram_field_making full = {
        .target = f->target,
        .reached = d->report.concentration,
        .free_area = d->report.free_area,
        .largest_overlap = d->report.largest_overlap,
        .populations = d->parts.count,
        .placed = d->placed,
        .rounds = d->packed.rounds,
        .moves = d->packed.moves,
        .area_change = d->packed.area_change,
        .vertex_changes = d->packed.vertex_changes,
        .tile = f->tile,
        .tile_x = f->period.x,
        .tile_y = f->period.y,
    };
    result_give(making, size, &full);
    return true;
}

fram_status(fram_field_population_get)(const fram_field *f, int number, fram_field_population *out, fram_error *error,
                                       size_t size)
{
    fram_status status = REFUSE_NULL(error, {"field", f}, {"population", out});
    if (status == FRAM_OK)
        status = RESULT_CHECK(out, size, fram_field_population, error);
    if (status != FRAM_OK)
        return status;
    if (number < 0 || number >= f->drawn.parts.count)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "number", "expected 0 to under %d populations, found %d",
                         (int)f->drawn.parts.count, number);
    const field_population_report *p = &f->drawn.parts.data[number];
    fram_field_population full = {.floes = p->floes, .area = p->area, .size_distance = p->size_distance};
    for (int i = 0; i <= FRAM_FIELD_BINS; i++)
        full.bin_edge[i] = p->sizes.edge[i];
    for (int i = 0; i < FRAM_FIELD_BINS; i++) {
        full.bin[i] = p->sizes.bin[i];
        full.expected[i] = p->sizes.expected[i];
    }
    result_give(out, size, &full);
    return FRAM_OK;
}
